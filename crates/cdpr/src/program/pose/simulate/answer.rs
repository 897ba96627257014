//! What a motion is as a whole, as JSON and in words.

use crate::program::answer::OutOfLimits;
use crate::program::arguments::poses::pose_numbers;
use crate::program::output::{Ending, print_sentence, table};
use cdpr_assess::below_floor;
use cdpr_dynamics::simulate::{Change, Event, Excursion, Sample, Series};
use cdpr_robot::{Pose, Robot, counted, rounded, significant};
use serde::Serialize;

/// What a motion is as a whole.
#[derive(Serialize)]
pub(super) struct Answer {
    /// Pose at rest, and unstrained lengths [m].
    start: [f64; 7],
    lengths: Vec<f64>,
    /// Greatest distance of P from that pose [m], when [s], and the greatest rotation from it [rad].
    greatest_distance_m: f64,
    at_s: f64,
    greatest_rotation_rad: f64,
    /// Greatest distance of P from its mean place in the last quarter of the time [m].
    swing_m: f64,
    cables: Vec<CableAnswer>,
    #[serde(skip_serializing_if = "Option::is_none")]
    below_ground: Option<BelowGround>,
    /// Greatest differences to a coarser computation.
    difference: Difference,
    energy: Energy,
    /// Elements of each cable at the end, and the degree of the polynomial on them.
    elements: Vec<usize>,
    degree: Vec<usize>,
    steps: usize,
    /// Whether the motion begins away from the rest.
    #[serde(skip)]
    displaced: bool,
    /// Whether the platform is a point mass, which does not turn.
    #[serde(skip)]
    is_point: bool,
    pub(super) columns: Vec<String>,
}

#[derive(Serialize)]
struct CableAnswer {
    /// At the begin and at most, at the end that is pulled more.
    rest_n: f64,
    greatest_n: f64,
    at_s: f64,
    /// Whether it carries no tension at a point at some time before it is cut.
    slack: bool,
    /// When it is cut, at either end.
    #[serde(skip_serializing_if = "Option::is_none")]
    cut_at_s: Option<f64>,
    /// What the greatest tension is above: a breaking force or a greatest tension [N].
    #[serde(skip_serializing_if = "Option::is_none")]
    above: Option<Above>,
}

#[derive(Clone, Copy, Serialize)]
struct Above {
    limit: &'static str,
    value_n: f64,
}

/// The first sample at which the platform is below the ground.
#[derive(Serialize)]
struct BelowGround {
    at_s: f64,
    /// How deep its lowest point is, and below what.
    reason: String,
}

#[derive(Serialize)]
struct Difference {
    position_m: f64,
    rotation_rad: f64,
    tension_n: f64,
}

#[derive(Serialize)]
struct Energy {
    /// Greatest kinetic energy.
    kinetic_j: f64,
    /// Work of winches and forces, with the energy of what came and went.
    given_j: f64,
    /// What damping dissipates.
    lost_j: f64,
    /// What is missing or too much at the end.
    drift_j: f64,
}

impl Answer {
    pub(super) fn new(
        robot: &Robot,
        rest: &Pose,
        (lengths, events): (&[f64], &[Event]),
        series: &Series,
    ) -> Self {
        let ends = series.end_peaks.iter().map(|[exit, anchor]| [*anchor, *exit]).collect();
        let beyond = OutOfLimits::of_tensions(robot, &[ends]);
        let above = |i: usize| {
            let of_cable = beyond.iter().filter(|one| one.cable == i + 1 && one.is_too_much());
            let first = of_cable.min_by_key(|one| one.limit != "breaking_force")?;
            let limit = if first.limit == "breaking_force" { first.limit } else { "tension_limits.max" };
            Some(Above { limit, value_n: first.value })
        };
        let end = series.samples.last().map_or(0.0, |last| last.time);
        let cuts =
            |i: usize| events.iter().filter(move |event| event.has_cut(i, end)).map(|event| event.time);
        let cables = series.peaks.iter().enumerate().map(|(i, (peak, at))| {
            let [exit, anchor] = series.samples[0].tensions[i];
            CableAnswer {
                rest_n: exit.max(anchor),
                greatest_n: *peak,
                at_s: *at,
                slack: series.slack[i],
                cut_at_s: cuts(i).min_by(f64::total_cmp),
                above: above(i),
            }
        });
        let below = |sample: &Sample| {
            below_floor(robot, Some(rest), &sample.pose)
                .map(|(_, reason)| BelowGround { at_s: sample.time, reason })
        };
        let pose = ["t_s", "x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad"].map(str::to_owned);
        let tensions = (1..=lengths.len()).flat_map(|i| [format!("t_exit_{i}_n"), format!("t_anchor_{i}_n")]);
        let cdpr_dynamics::simulate::Difference { position, rotation: turn, tension } = series.difference;
        let cdpr_dynamics::simulate::Energy { kinetic, given, lost, drift } = series.energy;
        let Excursion { distance, time, rotation, swing } = series.excursion;
        Self {
            start: pose_numbers(rest),
            lengths: lengths.to_vec(),
            greatest_distance_m: distance,
            at_s: time,
            greatest_rotation_rad: rotation,
            swing_m: swing,
            cables: cables.collect(),
            below_ground: series.samples.iter().find_map(below),
            difference: Difference { position_m: position, rotation_rad: turn, tension_n: tension },
            energy: Energy { kinetic_j: kinetic, given_j: given, lost_j: lost, drift_j: drift },
            elements: series.discretizations.iter().map(|of| of.elements).collect(),
            degree: series.discretizations.iter().map(|of| of.degree).collect(),
            steps: series.work.steps,
            is_point: robot.platform.point,
            displaced: events.iter().any(|event| matches!(event.change, Change::Displace(_))),
            columns: pose
                .into_iter()
                .chain(tensions)
                .chain(["qw", "qx", "qy", "qz"].map(str::to_owned))
                .collect(),
        }
    }

    pub(super) fn ending(&self) -> Ending {
        let is_well = self.below_ground.is_none() && self.cables.iter().all(|cable| cable.above.is_none());
        if is_well { Ending::Well } else { Ending::SomethingWrong }
    }

    pub(super) fn print(&self, name: &str, rest: &Pose, until: f64) {
        let mm = |metres: f64| significant(1e3 * metres, 3);
        let [x, y, z] = <[f64; 3]>::from(rest.position).map(|value| rounded(value, 4));
        // What is said of a rotation, which a point mass does not have.
        let turn = |said: String| if self.is_point { String::new() } else { said };
        let turned = turn(format!(", turned by {} deg", significant(rest.rotation.angle().to_degrees(), 3)));
        let rotation = significant(self.greatest_rotation_rad.to_degrees(), 3);
        // After a cut or a winch it rests elsewhere; a displaced platform does not start at its rest.
        let from = if self.displaced { "rest" } else { "start" };
        print_sentence(&format!(
            "{name} moves up to {} mm{} from its {from}, at {} s.",
            mm(self.greatest_distance_m),
            turn(format!(" and {rotation} deg")),
            significant(self.at_s, 3)
        ));
        print_sentence(&format!("Its {from} is at ({x}, {y}, {z}) m{turned}."));
        println!(
            "In the last quarter of {until} s it swings by up to {} mm about its mean place.",
            mm(self.swing_m)
        );
        if let Some(BelowGround { at_s, reason }) = &self.below_ground {
            let at = significant(*at_s, 3);
            print_sentence(&format!("The platform comes below the ground: at {at} s {reason}."));
        }
        let mut rows = table(&["cable", "at 0 s [N]", "greatest [N]", "at [s]", "slack", "above"]);
        for (i, cable) in self.cables.iter().enumerate() {
            let above = |above: Above| format!("{} {}", above.limit, significant(above.value_n, 4));
            rows.add_row([
                (i + 1).to_string(),
                format!("{:.1}", cable.rest_n),
                format!("{:.1}", cable.greatest_n),
                format!("{:.3}", cable.at_s),
                format!(
                    "{}{}",
                    if cable.slack { "yes" } else { "no" },
                    if cable.cut_at_s.is_some() { ", cut" } else { "" }
                ),
                cable.above.map_or_else(String::new, above),
            ]);
        }
        println!("{rows}");
        println!("tensions: of the end of the cable that is pulled more");
        if self.cables.iter().any(|cable| cable.cut_at_s.is_some()) {
            println!("slack: no tension at a point of the cable, before it is cut");
        }
        let Difference { position_m, rotation_rad, tension_n } = &self.difference;
        println!(
            "A coarser computation differs by up to {} mm{} and {} N.",
            mm(*position_m),
            turn(format!(", {} deg", significant(rotation_rad.to_degrees(), 2))),
            significant(*tension_n, 2)
        );
        let Energy { drift_j, kinetic_j, lost_j, .. } = self.energy;
        print_sentence(&format!("{} a cable, {}.", self.elements(), counted(self.steps, "step")));
        let of_chains = if self.degree.contains(&1) { ", with that which chains need," } else { "" };
        let lost = match lost_j > 0.0 {
            true => format!(", damping{of_chains} dissipates {} J", significant(lost_j, 3)),
            false => String::new(),
        };
        print_sentence(&format!(
            "Energy: the kinetic one is at most {} J{lost}, and the balance at the end is off by {} J.",
            significant(kinetic_j, 3),
            significant(drift_j, 2)
        ));
    }

    /// Elements of a cable in words, those of most cables first.
    fn elements(&self) -> String {
        let all = || self.elements.iter().zip(&self.degree);
        let mut kinds: Vec<_> = all().collect();
        kinds.sort_by_key(|kind| (std::cmp::Reverse(all().filter(|of| of == kind).count()), *kind));
        kinds.dedup();
        let words = |(elements, degree): &(&usize, &usize)| {
            format!("{} of degree {degree}", counted(**elements, "element"))
        };
        kinds.iter().map(words).collect::<Vec<_>>().join(" or ")
    }
}
