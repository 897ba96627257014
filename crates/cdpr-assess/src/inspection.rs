//! Inspection of a robot file for likely mistakes: units that look wrong, limits without sense, coinciding
//! points, poses without feasible tensions. The robot is valid all the same.

mod equilibrium;
mod ground;
mod inertia;
mod pose;
mod pulley;
mod swapped;
mod symmetry;

use cdpr_robot::{Doubt, Robot, RobotCable, Vector3, counted, plausible};
pub(crate) use equilibrium::is_below_floor;
pub use equilibrium::{assumed_ground, below_floor, doubtful_rest};
use serde::Serialize;
use std::fmt;

/// Severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Probably wrong.
    Warning,
    /// Worth knowing; robots are built so.
    Note,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Warning => "warning",
            Self::Note => "note",
        })
    }
}

/// A likely mistake in a robot file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Severity.
    pub severity: Severity,
    /// Path of the field in the robot file, such as `cables[2].exit_point`.
    pub field: String,
    /// Value of the field, or a computed quantity, with its unit.
    pub value: String,
    /// Why the value is suspicious.
    pub why: String,
    /// What is expected, or what to check.
    pub remedy: String,
}

/// All findings about a robot: the doubts about its values first, then what follows from several fields, and
/// last what follows at a pose.
pub fn inspect(robot: &Robot) -> Vec<Finding> {
    let doubts = plausible::robot(robot).into_iter().map(Finding::from);
    let mut findings = Findings { robot, list: doubts.collect() };
    let doubtful = !findings.list.is_empty();
    // Of points in another unit nothing follows that would be of use.
    if findings.list.iter().any(|finding| finding.field == "cables[*].exit_point") {
        return findings.list;
    }
    findings.gravity();
    findings.inertia();
    findings.reference();
    findings.limits();
    findings.points();
    let known = findings.list.len();
    findings.ground();
    let grounded = findings.list[known..].iter().any(|finding| finding.severity == Severity::Warning);
    let doubtful = doubtful || grounded;
    let (cables, freedoms) = (robot.cables.len(), robot.freedoms().count());
    match pose::held(robot) {
        Some((pose, solution)) => findings.at_pose(&pose, &solution, doubtful),
        None if cables < freedoms => findings.add(
            Severity::Note,
            "cables",
            format!("{cables} for {freedoms} free motions"),
            &match freedoms - cables {
                1 => "one coordinate of a pose follows from the others".to_owned(),
                more => format!("{more} coordinates of a pose follow from the others"),
            },
            &pose::remedy_for_few(robot),
        ),
        // The values in doubt are the reason.
        None if doubtful => {}
        None => findings.add(
            Severity::Warning,
            "platform",
            "held nowhere, level, on the vertical through the middle of the exit points".to_owned(),
            "no tensions within the limits balance its weight there",
            "check points, mass and tension_limits; `cdpr workspace` shows what is held elsewhere",
        ),
    }
    findings.swapped_anchors();
    findings.list
}

impl From<Doubt> for Finding {
    fn from(Doubt { quantity, value, why, meant }: Doubt) -> Self {
        Self { severity: Severity::Warning, field: quantity, value, why, remedy: meant }
    }
}

/// Gravity on Earth [m/s²].
const EARTH: std::ops::Range<f64> = 9.76..9.84;

struct Findings<'a> {
    robot: &'a Robot,
    list: Vec<Finding>,
}

impl Findings<'_> {
    fn add(&mut self, severity: Severity, field: impl Into<String>, value: String, why: &str, remedy: &str) {
        self.list.push(Finding {
            severity,
            field: field.into(),
            value,
            why: why.to_owned(),
            remedy: remedy.to_owned(),
        });
    }

    fn gravity(&mut self) {
        let gravity = &self.robot.gravity;
        let tilt = gravity.tilt();
        if tilt > 0.0 {
            let upwards = tilt > std::f64::consts::FRAC_PI_2;
            let why = format!("the base is tilted by {:.2}\u{b0}", tilt.to_degrees());
            self.add(
                if upwards { Severity::Warning } else { Severity::Note },
                "gravity",
                format!("{:?} m/s\u{b2}", gravity.vector().as_slice()),
                &if upwards { format!("{why}: things fall towards +z") } else { why },
                "the direction in which things fall, in the base frame; 0,0,-9.81 where z points up",
            );
        }
        let gravity = gravity.magnitude();
        if !EARTH.contains(&gravity) {
            let value = format!("{gravity} m/s\u{b2}");
            self.add(
                Severity::Note,
                "gravity",
                value,
                "not that of the Earth's surface",
                "9.81, unless the robot works elsewhere",
            );
        }
    }

    /// Greatest tensions compared with the strength and stiffness of their cables, once where they are the
    /// robot's and all cables are the same.
    fn limits(&mut self) {
        let cables = &self.robot.cables;
        let same = |a: &RobotCable, b: &RobotCable| {
            a.properties == b.properties && a.tension_limits.max == b.tension_limits.max
        };
        for (i, cable) in cables.iter().enumerate() {
            // What was said of an earlier cable is not said again.
            if cables[..i].iter().any(|before| same(before, cable)) {
                continue;
            }
            let own = cable.tension_limits.max.map(|_| format!("cables[{i}].tension_limits.max"));
            self.greatest(&own.unwrap_or_else(|| "tension_limits.max".to_owned()), i);
        }
    }

    /// A preferred tension that a cable may not have, unless it or the limits are in doubt before.
    fn reference(&mut self) {
        let robot = self.robot;
        let tensions = robot.reference();
        let is_outside = |i: &usize| {
            let limits = robot.limits(*i);
            !(limits.min..=limits.max).contains(&tensions[*i])
        };
        let mut outside = (0..tensions.len()).filter(is_outside);
        let known = |of: &Finding| ["tension_reference", "tension_limits.max"].contains(&&of.field[..]);
        let known = self.list.iter().any(known);
        let (Some(i), false) = (outside.next(), robot.tension_reference.is_none() || known) else { return };
        let others = match outside.count() {
            0 => String::new(),
            more => format!(", and {} outside of theirs", counted(more, "other")),
        };
        let limits = robot.limits(i);
        self.add(
            Severity::Note,
            "tension_reference",
            format!("{} N for cable {}", tensions[i], i + 1),
            &format!("outside of its limits, {} N to {} N{others}", limits.min, limits.max),
            "tensions within the limits; the inverse model comes as near to others as the limits let it",
        );
    }

    /// The greatest tension of cable `i`, which stands in `field`.
    fn greatest(&mut self, field: &str, i: usize) {
        let cables = &self.robot.cables;
        let (properties, max) = (&cables[i].properties, self.robot.limits(i).max);
        let shared = cables.iter().all(|cable| cable.properties == *properties);
        let cable = if shared { "cable".to_owned() } else { format!("cables[{i}].cable") };
        if let Some(force) = properties.breaking_force {
            if max > force {
                self.add(
                    Severity::Warning,
                    field,
                    format!("{max} N"),
                    &format!("above {cable}.breaking_force, {force} N"),
                    "a limit that leaves the cable whole, with a margin",
                );
            } else if max > 0.5 * force {
                let why = format!(
                    "{:.0} % of {cable}.breaking_force: a safety factor below 2",
                    100.0 * max / force
                );
                self.add(
                    Severity::Note,
                    field,
                    format!("{max} N"),
                    &why,
                    "a limit of half the breaking force or less, where people are near",
                );
            }
        }
        if let Some(law) = &properties.law {
            /// A law is in proportion to the modulus, which is then near its slope.
            const NEAR: std::ops::Range<f64> = 0.2..5.0;
            let slopes = [self.robot.limits(i).min, max].map(|tension| law.ratio(tension));
            if slopes.iter().all(|slope| !NEAR.contains(slope)) {
                let [low, high] = slopes.map(|slope| 1e-9 * slope * properties.youngs_modulus);
                self.add(
                    Severity::Warning,
                    format!("{cable}.youngs_modulus"),
                    format!("{:.3} GPa", 1e-9 * properties.youngs_modulus),
                    &format!("the slope of its law is {low:.3} GPa at the least tension, {high:.3} GPa at the greatest"),
                    "a modulus near the slope of the law, which is in proportion to it",
                );
            }
        }
        let stiffness = properties.axial_stiffness();
        if let Some(strain) = self.robot.cable(i).overstrain(max) {
            let strain = 100.0 * strain;
            self.add(
                Severity::Warning,
                field,
                format!("{max} N"),
                &format!(
                    "strains a cable of EA = {stiffness:.3e} N by {strain:.1} %, where no model answers"
                ),
                "check youngs_modulus, section and the limit",
            );
        }
    }

    fn points(&mut self) {
        let cables = &self.robot.cables;
        let [exits, anchors]: [Vec<Vector3<f64>>; 2] = [
            cables.iter().map(|cable| cable.exit_point).collect(),
            cables.iter().map(|cable| cable.anchor_point).collect(),
        ];
        let together = cables.len() > 1 && anchors.iter().all(|point| (point - anchors[0]).norm() < 1e-9);
        if together && !self.robot.platform.point {
            self.add(
                Severity::Note,
                "cables[*].anchor_point",
                format!("{:?} m", anchors[0].as_slice()),
                "one place for all cables, which resist no rotation of the platform there",
                "\"point\": true in `platform` for a point mass, such as a camera",
            );
        }
        for (name, points) in [("exit_point", &exits), ("anchor_point", &anchors)] {
            // That of all cables has been said.
            if together && name == "anchor_point" {
                continue;
            }
            self.shared(name, points);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cdpr_robot::{CableProperties, TensionReference};

    fn robot() -> Robot {
        Robot::from_library("cogiro").unwrap()
    }

    #[test]
    fn fewer_cables_and_a_point_mass_are_no_reason_to_warn() {
        let some = |which: &[usize]| {
            let whole = robot();
            Robot { cables: which.iter().map(|i| whole.cables[*i].clone()).collect(), ..whole }
        };
        for which in [&[1][..], &[1, 3, 5, 7]] {
            let (mut few, count) = (some(which), which.len());
            few.cables.iter_mut().for_each(|cable| cable.anchor_point.z = 1.0);
            few.validate().unwrap();
            let [note] = &inspect(&few)[..] else { panic!("{:?}", inspect(&few)) };
            assert_eq!((note.severity, note.field.as_str()), (Severity::Note, "cables"));
            assert_eq!(note.value, format!("{count} for 6 free motions"));
        }
        let mut point = some(&[1, 3, 5, 7]);
        point.cables.iter_mut().for_each(|cable| cable.anchor_point = Vector3::zeros());
        point.platform.point = true;
        assert_eq!(inspect(&point), []);
    }

    fn warned(change: impl Fn(&mut Robot)) -> Vec<String> {
        let mut robot = robot();
        change(&mut robot);
        robot.validate().unwrap();
        let warnings = inspect(&robot).into_iter().filter(|finding| finding.severity == Severity::Warning);
        warnings.map(|finding| finding.field).collect()
    }

    fn cables(change: impl Fn(&mut CableProperties)) -> Vec<String> {
        warned(|robot| robot.cables.iter_mut().for_each(|cable| change(&mut cable.properties)))
    }

    #[test]
    fn nothing_is_odd_about_cogiro() {
        assert_eq!(inspect(&robot()), []);
    }

    #[test]
    fn preferred_tensions_out_of_the_limits_are_seen() {
        let said = |reference: TensionReference| {
            let mut robot = robot();
            robot.tension_reference = Some(reference);
            let found = inspect(&robot).into_iter().filter(|finding| finding.field == "tension_reference");
            found.map(|finding| (finding.severity, finding.value, finding.why)).collect::<Vec<_>>()
        };
        let limits = robot().limits(0);
        let (middle, above) = (0.5 * (limits.min + limits.max), 1.5 * limits.max);
        assert_eq!(said(TensionReference::MID), []);
        assert_eq!(said(TensionReference::All(middle)), []);
        let mut each = vec![middle; robot().cables.len()];
        (each[2], each[5]) = (above, 0.5 * limits.min);
        let [(Severity::Note, value, why)] = &said(TensionReference::Each(each))[..] else { panic!() };
        assert_eq!(*value, format!("{above} N for cable 3"));
        assert!(why.starts_with("outside of its limits") && why.ends_with(", and 1 other outside of theirs"));
        // Far above them it is more than a note, and said once.
        let far = said(TensionReference::All(10.0 * limits.max));
        assert!(matches!(&far[..], [(Severity::Warning, ..)]), "{far:?}");
    }

    #[test]
    fn other_units_are_seen() {
        assert_eq!(cables(|p| p.youngs_modulus = 100.0)[0], "cable.youngs_modulus");
        assert_eq!(cables(|p| p.linear_density = 64.0)[0], "cable.linear_density");
        assert_eq!(cables(|p| p.section = 8.2)[0], "cable.section");
        assert_eq!(cables(|p| p.breaking_force = Some(10.0))[0], "cable.breaking_force");
        assert_eq!(warned(|robot| robot.platform.mass = 3e5)[0], "platform.mass");
        let millimetres = warned(|robot| {
            for cable in &mut robot.cables {
                cable.exit_point *= 1e3;
                cable.anchor_point *= 1e3;
            }
        });
        assert!(millimetres.contains(&"cables[*].exit_point".to_owned()), "{millimetres:?}");
    }

    #[test]
    fn points_given_for_one_another_are_seen() {
        let swapped = warned(|robot| {
            robot.cables.iter_mut().for_each(|c| std::mem::swap(&mut c.exit_point, &mut c.anchor_point));
        });
        assert!(swapped.contains(&"cables[*].anchor_point".to_owned()), "{swapped:?}");
    }

    #[test]
    fn of_cables_that_touch_many_others_each_is_warned_about_once() {
        let mut robot = robot();
        // Nine copies of each cable, turned a little about the middle of its span.
        let copies = |cable: &RobotCable| {
            let copy = |k: i32| {
                let aside = 0.02 * f64::from(k) * Vector3::x();
                let mut copy = cable.clone();
                copy.exit_point += aside;
                copy.anchor_point -= aside;
                copy
            };
            (0..10).map(copy).collect::<Vec<_>>()
        };
        robot.cables = robot.cables.iter().flat_map(copies).collect();
        robot.validate().unwrap();
        let findings = inspect(&robot);
        let touching: Vec<_> =
            findings.iter().filter(|finding| finding.why.contains("as they hang")).collect();
        let fields: std::collections::BTreeSet<_> = touching.iter().map(|finding| &finding.field).collect();
        assert!(fields.len() == touching.len() && touching.len() >= 72, "{touching:?}");
        assert!(touching.iter().any(|finding| finding.value.contains("and as near to ")), "{touching:?}");
    }
}
