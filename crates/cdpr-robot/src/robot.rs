//! The robot: geometry, platform, cables, limits, and what follows from them at a pose.
//!
//! ```text
//! r_i = p + R a_i - b_i                          from exit point B_i to anchor point A_i        Eq. (1)
//! W t + w_ex = 0,  W = [ u_i ; (R a_i) x u_i ]   u_i the unit pull of cable i on the platform,  Eq. (3)
//!                                                w_ex the wrench of all other loads
//! ```
//!
//! Both equations are those of Baklouti, Caro, Courteille (CableCon 2017).

pub(crate) mod provenance;

use crate::error::RobotError;
use crate::freedoms::{Coordinate, Freedoms, Plane};
use crate::gravity::Gravity;
use crate::limits::{
    CableEnd, NamedReference, OwnLimits, TensionDistribution, TensionLimits, TensionReference,
};
use crate::pose::Pose;
use crate::robot::provenance::Provenance;
use crate::wrench::Wrench;
use cdpr_cable::{Cable, ElasticLaw, Entry, Guide, PiecewiseLaw};
use nalgebra::{Matrix3, Matrix6xX, Vector3, Vector6};

/// A cable-driven parallel robot with n cables for the m free motions of its platform.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// Name.
    pub name: String,
    /// Where the values come from.
    pub provenance: Provenance,
    /// Acceleration due to gravity.
    pub gravity: Gravity,
    /// The platform.
    pub platform: Platform,
    /// The plane of the base frame in which the platform of a planar robot moves; `None` in space.
    pub plane: Option<Plane>,
    /// Height of the ground in the base frame [m], below which no cable and no anchor point may be; `None` where
    /// it is not known.
    pub ground_z: Option<f64>,
    /// Limits of the tension of every cable that has none of its own; [`Robot::limits`] has both.
    pub tension_limits: TensionLimits,
    /// Where the greatest tension of every cable is limited that does not say so itself.
    pub max_at: CableEnd,
    /// The tensions that the inverse model comes as near to as it can; `None` for the least norm.
    pub tension_reference: Option<TensionReference>,
    /// Which tensions the inverse model chooses; with a reference the nearest to it.
    pub distribution: TensionDistribution,
    /// The cables with their points, in the order of their numbers.
    pub cables: Vec<RobotCable>,
}

/// The moving platform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Platform {
    /// Mass [kg].
    pub mass: f64,
    /// Centre of mass G in the platform frame [m].
    pub center_of_mass: Vector3<f64>,
    /// Inertia about the centre of mass in the platform frame [kg m²], if known: symmetric, positive
    /// definite. Only natural frequencies depend on it.
    pub inertia: Option<Matrix3<f64>>,
    /// Whether it is a point mass, whose rotation is held.
    pub point: bool,
}

impl Platform {
    /// A platform of this mass [kg] and centre of mass [m], whose inertia is not known.
    pub fn new(mass: f64, center_of_mass: Vector3<f64>) -> Self {
        Self { mass, center_of_mass, inertia: None, point: false }
    }

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

/// One cable of the robot and the two points it joins.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotCable {
    /// Exit point b_i in the base frame [m].
    pub exit_point: Vector3<f64>,
    /// Anchor point a_i in the platform frame [m].
    pub anchor_point: Vector3<f64>,
    /// Material of the cable.
    pub properties: CableProperties,
    /// Swivelling pulley at the exit point, which is where the cable enters it; `None` for a fixed point.
    pub pulley: Option<Pulley>,
    /// Stretched length between the winch and the exit point [m], elastic and without weight; zero where the
    /// winch stands at the exit point, or where its cable is of no interest.
    pub lead: f64,
    /// Limits of its tension that differ from the robot's.
    pub tension_limits: OwnLimits,
}

/// A pulley that swivels about an axis through the exit point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulley {
    /// Radius to the middle of the cable [m].
    pub radius: f64,
    /// Swivel axis in the base frame: the direction in which the cable travels where it enters the pulley.
    ///
    /// Its length means nothing.
    pub axis: Vector3<f64>,
}

impl RobotCable {
    /// A cable between two points, without pulley and lead, with the limits of its robot.
    pub fn between(
        exit_point: Vector3<f64>,
        anchor_point: Vector3<f64>,
        properties: CableProperties,
    ) -> Self {
        Self {
            exit_point,
            anchor_point,
            properties,
            pulley: None,
            lead: 0.0,
            tension_limits: OwnLimits::default(),
        }
    }

    /// What leads the cable to its exit point, in the level frame to which `level` rotates; `None` for one
    /// that begins there.
    #[inline(always)]
    pub fn guide(&self, level: Option<&Matrix3<f64>>) -> Option<Guide> {
        if self.lead == 0.0 && self.pulley.is_none() { None } else { self.led(level) }
    }

    #[cold]
    fn led(&self, level: Option<&Matrix3<f64>>) -> Option<Guide> {
        let radius = self.pulley.map_or(0.0, |pulley| pulley.radius);
        if radius == 0.0 && self.lead == 0.0 {
            return None;
        }
        let entry = self.pulley.map_or(Entry::Upwards, |pulley| pulley.entry(level));
        Some(Guide { lead: self.lead, radius, entry })
    }
}

impl Pulley {
    /// Horizontal part of a vertical axis at most, relative to its vertical part.
    pub const VERTICAL: f64 = VERTICAL;

    /// How the cable enters, in the level frame to which `level` rotates.
    fn entry(&self, level: Option<&Matrix3<f64>>) -> Entry {
        let axis = level.map_or(self.axis, |level| level * self.axis);
        match axis.z {
            // Without a radius the axis means nothing.
            _ if self.radius == 0.0 => Entry::Upwards,
            z if axis.xy().norm() > VERTICAL * z.abs() => Entry::Along(axis.normalize().into()),
            z if z < 0.0 => Entry::Downwards,
            _ => Entry::Upwards,
        }
    }
}

/// Section, density, modulus and elastic law of a cable.
#[derive(Clone, Debug, PartialEq)]
pub struct CableProperties {
    /// Section S that carries the tension [m²].
    pub section: f64,
    /// Mass per unstrained length rho [kg/m].
    pub linear_density: f64,
    /// Young's modulus E [Pa].
    pub youngs_modulus: f64,
    /// Diameter [m], if known.
    pub diameter: Option<f64>,
    /// Breaking force [N], if known.
    pub breaking_force: Option<f64>,
    /// Elastic law in proportion to the modulus, where the strain is not T/EA; `None` for a linear cable.
    pub law: Option<PiecewiseLaw>,
}

impl CableProperties {
    /// A linear cable of that section [m²], mass per length [kg/m] and Young's modulus [Pa].
    pub fn linear(section: f64, linear_density: f64, youngs_modulus: f64) -> Self {
        Self { section, linear_density, youngs_modulus, diameter: None, breaking_force: None, law: None }
    }

    /// Axial stiffness EA = E S [N].
    #[inline]
    pub fn axial_stiffness(&self) -> f64 {
        self.youngs_modulus * self.section
    }

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

impl Robot {
    /// Cable `i` as `cdpr-cable` has it: weight per length w = rho g, axial stiffness E S, elastic law, and
    /// what leads it to its exit point, in the level frame of [`crate::Gravity::level`].
    #[inline]
    pub fn cable(&self, i: usize) -> Cable<'_> {
        let properties = &self.cables[i].properties;
        Cable {
            weight_per_length: properties.linear_density * self.gravity.magnitude(),
            axial_stiffness: properties.axial_stiffness(),
            law: properties.law.as_ref().map_or(ElasticLaw::Linear, ElasticLaw::Piecewise),
            guide: self.cables[i].guide(self.gravity.level()),
        }
    }

    /// The free motions of the platform.
    #[inline]
    pub fn freedoms(&self) -> Freedoms {
        Freedoms::new(self.platform.point, self.plane)
    }

    /// The axis at right angles to the plane of a planar robot, and the coordinate of P along it at which exit
    /// and anchor points are at one height in the mean [m].
    pub fn plane_offset(&self) -> Option<(usize, f64)> {
        let normal = self.plane?.normal();
        let apart = self.cables.iter().map(|cable| cable.exit_point[normal] - cable.anchor_point[normal]);
        Some((normal, apart.sum::<f64>() / self.cables.len() as f64))
    }

    /// Motion (dp, dφ) of the platform per unit of a coordinate of a pose. The one rotation of a planar robot
    /// is about an axis of the base frame, however its platform stands.
    pub fn motion(&self, coordinate: Coordinate, pose: &Pose) -> Vector6<f64> {
        if self.plane.is_some() {
            return Vector6::ith(coordinate.component(), 1.0);
        }
        let (_, pitch, yaw) = pose.rotation.euler_angles();
        coordinate.motion(yaw, pitch)
    }

    /// Whether there is a cable for every free motion, n >= m: whether all coordinates of a pose can be
    /// chosen.
    #[inline]
    pub fn is_fully_actuated(&self) -> bool {
        self.cables.len() >= self.freedoms().count()
    }

    /// Whether all cables are linear.
    #[inline]
    pub fn is_linear(&self) -> bool {
        self.cables.iter().all(|cable| cable.properties.law.is_none())
    }

    /// Whether all cables are linear and begin at their exit points, without pulley and lead.
    #[inline]
    pub fn has_plain_cables(&self) -> bool {
        self.is_linear() && self.cables.iter().all(|cable| cable.guide(None).is_none())
    }

    /// Whether the base is level and all cables are linear and begin at their exit points, without pulley and
    /// lead.
    #[inline]
    pub fn is_plain(&self) -> bool {
        self.has_plain_cables() && self.gravity.level().is_none()
    }

    /// Young's modulus of cable `i` at a tension [N]: the slope of its law there [Pa].
    pub fn modulus_at(&self, i: usize, tension: f64) -> f64 {
        self.cable(i).tangent_stiffness(tension) / self.cables[i].properties.section
    }

    /// Limits of the tension of cable `i`: its own where it has them, or else the robot's.
    #[inline]
    pub fn limits(&self, i: usize) -> TensionLimits {
        let own = self.cables[i].tension_limits;
        TensionLimits {
            min: own.min.unwrap_or(self.tension_limits.min),
            max: own.max.unwrap_or(self.tension_limits.max),
        }
    }

    /// Where the greatest tension of cable `i` is limited.
    #[inline]
    pub fn max_at(&self, i: usize) -> CableEnd {
        self.cables[i].tension_limits.max_at.unwrap_or(self.max_at)
    }

    /// Replaces the choice of tensions by what is given of it: a reference alone chooses the nearest to it, and a
    /// norm alone drops the reference.
    pub fn choose(&mut self, distribution: Option<TensionDistribution>, reference: Option<TensionReference>) {
        if let Some(distribution) = distribution {
            self.distribution = distribution;
            self.tension_reference.take_if(|_| !distribution.is_nearest());
        }
        if reference.is_some() {
            self.tension_reference = reference;
            self.distribution = distribution.unwrap_or_default();
        }
    }

    /// The tension of every cable that the inverse model comes as near to as it can [N].
    pub fn reference(&self) -> Vec<f64> {
        let middle = |i: usize| 0.5 * (self.limits(i).min + self.limits(i).max);
        match &self.tension_reference {
            None => vec![0.0; self.cables.len()],
            Some(TensionReference::All(tension)) => vec![*tension; self.cables.len()],
            Some(TensionReference::Each(tensions)) => tensions.clone(),
            Some(TensionReference::Named(NamedReference::Mid)) => {
                (0..self.cables.len()).map(middle).collect()
            }
        }
    }

    /// Arm s_i = R a_i from P to anchor point i, in the base frame [m].
    #[inline]
    pub fn anchor_arm(&self, pose: &Pose, i: usize) -> Vector3<f64> {
        pose.rotation * self.cables[i].anchor_point
    }

    /// Span r_i = p + R a_i - b_i from exit point i to anchor point i, in the base frame [m], Eq. (1).
    #[inline]
    pub fn span(&self, pose: &Pose, i: usize) -> Vector3<f64> {
        // Eq. (1)
        pose.position + self.anchor_arm(pose, i) - self.cables[i].exit_point
    }

    /// Weight of the platform and of a `payload` [kg] at its centre of mass, as a wrench about P.
    #[inline]
    pub fn weight(&self, pose: &Pose, payload: f64) -> Wrench {
        let force = (self.platform.mass + payload) * self.gravity.vector();
        Wrench::of_force_at(&(pose.rotation * self.platform.center_of_mass), force)
    }

    /// Wrench matrix W of Eq. (3), 6 x n: column i is the wrench of a unit tension in cable i.
    ///
    /// Cable i pulls the platform along the unit vector `pulls[i]` in the base frame. For a sagging cable
    /// that is its end tangent, away from the platform.
    pub fn wrench_matrix(&self, pose: &Pose, pulls: &[Vector3<f64>]) -> Matrix6xX<f64> {
        let mut matrix = Matrix6xX::zeros(pulls.len());
        for (i, pull) in pulls.iter().enumerate() {
            matrix.set_column(i, &Wrench::of_force_at(&self.anchor_arm(pose, i), *pull).to_vector());
        }
        matrix
    }

    /// Root mean square distance of the anchor points from P [m].
    ///
    /// As characteristic length it makes rotations comparable with translations.
    #[inline]
    pub fn platform_size(&self) -> f64 {
        let sum: f64 = self.cables.iter().map(|cable| cable.anchor_point.norm_squared()).sum();
        (sum / self.cables.len() as f64).sqrt()
    }

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
            if !self.distribution.is_nearest() {
                let expected = "nearest, as there is a tension_reference; or no tension_reference";
                return Err(RobotError::invalid("distribution", self.distribution.name(), expected));
            }
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

/// Horizontal part of a vertical axis at most, relative to its length.
pub(crate) const VERTICAL: f64 = 1e-9;

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
