//! Which robots are valid: every value, and whether the points can hold a platform.

use crate::error::RobotError;
use crate::limits::TensionLimits;
use crate::robot::{CableProperties, Platform, Pulley, Robot, RobotCable};
use nalgebra::Vector3;

impl Robot {
    /// Checks every value and that the points can hold a platform.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] names the field as in the robot file, its value and what would be right.
    pub fn validate(&self) -> Result<(), RobotError> {
        let named = |name: &'static str| move || name.to_owned();
        self.gravity.validate()?;
        self.platform.validate()?;
        let TensionLimits { min, max } = self.tension_limits;
        require(named("tension_limits.min"), min, min > 0.0, "a finite, positive tension [N]")?;
        require(named("tension_limits.max"), max, max > min, "a finite tension above tension_limits.min")?;
        if self.cables.is_empty() {
            return Err(RobotError::invalid("cables", "an empty list", "at least one cable"));
        }
        if self.cables.len() > MOST_CABLES {
            return Err(RobotError::invalid(
                "cables",
                format!("a list of {}", self.cables.len()),
                format!("at most {MOST_CABLES} cables"),
            ));
        }
        for (i, cable) in self.cables.iter().enumerate() {
            finite(|| format!("cables[{i}].exit_point"), &cable.exit_point)?;
            finite(|| format!("cables[{i}].anchor_point"), &cable.anchor_point)?;
            cable.validate_guide(i)?;
            cable.properties.validate(|name| self.field(i, name))?;
            self.validate_limits(i)?;
        }
        if let Some(ground) = self.ground_z {
            require(named("ground_z"), ground, true, "a finite height in the base frame [m]")?;
        }
        if let Some(reference) = &self.tension_reference {
            reference.validate(self.cables.len())?;
        }
        self.validate_points()
    }

    /// Checks the limits of a cable that are not the robot's.
    fn validate_limits(&self, i: usize) -> Result<(), RobotError> {
        let own = self.cables[i].tension_limits;
        let TensionLimits { min, max } = self.limits(i);
        let field = |name: &'static str| move || format!("cables[{i}].tension_limits.{name}");
        if own.max.is_some() {
            require(field("max"), max, max > min, &format!("a finite tension above its least one, {min} N"))?;
        }
        if own.min.is_some() {
            let expected = format!("a finite, positive tension below its greatest one, {max} N");
            require(field("min"), min, min > 0.0 && min < max, &expected)?;
        }
        Ok(())
    }

    /// Path of a property of cable i: those that all cables share stand in the common entry of the file.
    pub(crate) fn field(&self, i: usize, name: &str) -> String {
        let properties = &self.cables[i].properties;
        let shared = self.cables.iter().all(|cable| cable.properties == *properties);
        if shared { format!("cable.{name}") } else { format!("cables[{i}].cable.{name}") }
    }

    /// Refuses cables that cannot do what their number promises: two with the same points, or six and more
    /// for a platform in space with all points on one line.
    fn validate_points(&self) -> Result<(), RobotError> {
        let same = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).norm() < 1e-9;
        for (j, second) in self.cables.iter().enumerate() {
            for (i, first) in self.cables[..j].iter().enumerate() {
                if same(&first.exit_point, &second.exit_point)
                    && same(&first.anchor_point, &second.anchor_point)
                {
                    return Err(RobotError::invalid(
                        format!("cables[{j}]"),
                        "coincident with another cable",
                        format!("exit or anchor point different from those of cable {}", i + 1),
                    ));
                }
            }
        }
        if !(self.freedoms().are_all() && self.is_fully_actuated()) {
            return Ok(());
        }
        let exits: Vec<_> = self.cables.iter().map(|cable| cable.exit_point).collect();
        let anchors: Vec<_> = self.cables.iter().map(|cable| cable.anchor_point).collect();
        for (name, points) in [("exit_point", exits), ("anchor_point", anchors)] {
            if on_one_line(&points) {
                return Err(RobotError::invalid(
                    format!("cables[*].{name}"),
                    "on one line",
                    "points that span a plane at least: no cable could resist a moment about that line",
                ));
            }
        }
        Ok(())
    }
}

impl Platform {
    fn validate(&self) -> Result<(), RobotError> {
        let Self { mass, center_of_mass, inertia, point: _ } = self;
        require(|| "platform.mass".to_owned(), *mass, *mass > 0.0, "a finite, positive mass [kg]")?;
        finite(|| "platform.center_of_mass".to_owned(), center_of_mass)?;
        let Some(inertia) = inertia else { return Ok(()) };
        let refused = |value: String, expected: &str| {
            Err(RobotError::invalid("platform.inertia".to_owned(), value, expected.to_owned()))
        };
        let rows: Vec<[f64; 3]> = inertia.row_iter().map(|row| [row[0], row[1], row[2]]).collect();
        if !inertia.iter().all(|entry| entry.is_finite()) {
            return refused(format!("{rows:?}"), "finite numbers [kg m²]");
        }
        if (inertia - inertia.transpose()).norm() > 1e-9 * inertia.norm() {
            return refused(format!("{rows:?}"), "a symmetric matrix [kg m²]");
        }
        let [a, b, c]: [f64; 3] = inertia.symmetric_eigenvalues().into();
        let least = a.min(b).min(c);
        // No body has a moment of inertia above the sum of the two others; products with the opposite sign
        // and rounded figures come close to it.
        let greatest = a.max(b).max(c);
        if !(least > 0.0 && greatest <= (a + b + c - greatest) * (1.0 + 1e-3)) {
            return refused(
                format!("one with the principal moments {a}, {b}, {c} kg m²"),
                "positive principal moments, none above the sum of the others, as every body has them",
            );
        }
        Ok(())
    }
}

impl CableProperties {
    /// Checks every value; `path` makes the path in the file of a name.
    pub(crate) fn validate(&self, path: impl Fn(&str) -> String) -> Result<(), RobotError> {
        let path = &path;
        let field = |name: &'static str| move || path(name);
        let (rho, e) = (self.linear_density, self.youngs_modulus);
        require(field("section"), self.section, self.section > 0.0, "a finite, positive section [m²]")?;
        require(field("linear_density"), rho, rho >= 0.0, "a finite mass per length, zero or more [kg/m]")?;
        require(field("youngs_modulus"), e, e > 0.0, "a finite, positive modulus [Pa]")?;
        let diameter = self.diameter.unwrap_or(f64::MIN_POSITIVE);
        require(field("diameter"), diameter, diameter > 0.0, "a finite, positive diameter [m]")?;
        let force = self.breaking_force.unwrap_or(f64::MIN_POSITIVE);
        require(field("breaking_force"), force, force > 0.0, "a finite, positive force [N]")
    }
}

impl RobotCable {
    fn validate_guide(&self, i: usize) -> Result<(), RobotError> {
        let field = |name: &'static str| move || format!("cables[{i}].{name}");
        let expected = "a finite length between winch and exit point, zero or more [m]";
        require(field("lead"), self.lead, self.lead >= 0.0, expected)?;
        let Some(Pulley { radius, axis }) = self.pulley else { return Ok(()) };
        require(field("pulley.radius"), radius, radius >= 0.0, "a finite radius, zero or more [m]")?;
        let length = axis.norm();
        if length > 0.0 && length.is_finite() {
            return Ok(());
        }
        Err(RobotError::invalid(
            format!("cables[{i}].pulley.axis"),
            format!("{:?}", axis.as_slice()),
            "the direction in which the cable enters the pulley, finite and not zero; [0, 0, 1] from below",
        ))
    }
}

/// Cables of a robot at most: the inverse model of more takes seconds where they hold no pose.
const MOST_CABLES: usize = 200;

/// Checks a value of a field.
///
/// `field` is asked for its name only if the value is invalid, because every perturbed robot is validated.
fn require(
    field: impl Fn() -> String,
    value: f64,
    admissible: bool,
    expected: &str,
) -> Result<(), RobotError> {
    if value.is_finite() && admissible { Ok(()) } else { Err(RobotError::invalid(field(), value, expected)) }
}

fn finite(field: impl Fn() -> String, point: &Vector3<f64>) -> Result<(), RobotError> {
    for (axis, value) in point.iter().enumerate() {
        require(|| format!("{}[{axis}]", field()), *value, true, "a finite number [m]")?;
    }
    Ok(())
}

fn on_one_line(points: &[Vector3<f64>]) -> bool {
    let spread = |from: &Vector3<f64>| {
        points.iter().map(move |p| p - from).max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))
    };
    let Some(first) = points.first() else { return true };
    let Some(longest) = spread(first) else { return true };
    let length = longest.norm();
    length < 1e-9 || points.iter().all(|p| (p - first).cross(&longest).norm() < 1e-9 * length * length)
}
