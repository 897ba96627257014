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
mod validate;

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
    /// Height of the ground in the base frame [m], below which no cable and no anchor point may be; `None`
    /// where it is not known.
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

    /// The axis at right angles to the plane of a planar robot, and the coordinate of P along it at which
    /// exit and anchor points are at one height in the mean [m].
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

    /// Replaces the choice of tensions by what is given of it: a reference alone chooses the nearest to it,
    /// and a norm alone drops the reference.
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

    /// Height of P [m] from which on no anchor point of a platform without rotation is below the ground
    /// ([`Robot::ground_z`]) or, under exit points that are all above it, below z = 0; -∞ where neither is
    /// known.
    pub fn floor(&self) -> f64 {
        let anchors = self.cables.iter().map(|cable| cable.anchor_point.z);
        let (lowest, exits) =
            (anchors.fold(0.0, f64::min), self.cables.iter().map(|cable| cable.exit_point.z));
        let below = exits.fold(f64::INFINITY, f64::min);
        match self.ground_z {
            Some(ground) if ground - lowest < below => ground - lowest,
            _ if below > 0.0 => (-lowest).min(below),
            _ => f64::NEG_INFINITY,
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

    /// Whether the platform rotates and `platform.inertia` is not known: then it has no natural frequencies.
    pub fn lacks_inertia(&self) -> bool {
        self.platform.inertia.is_none() && (3..6).any(|k| self.freedoms().contains(k))
    }

    /// Radius of the ball whose inertia is assumed where `platform.inertia` is not known [m]: the root mean
    /// square distance of the anchor points from the centre of mass, at least a thousandth of the longest
    /// distance between an exit point and the first one.
    pub fn assumed_radius(&self) -> f64 {
        let center = self.platform.center_of_mass;
        let sum: f64 = self.cables.iter().map(|cable| (cable.anchor_point - center).norm_squared()).sum();
        let across = self.cables.iter().map(|cable| (cable.exit_point - self.cables[0].exit_point).norm());
        (sum / self.cables.len() as f64).sqrt().max(1e-3 * across.fold(0.0, f64::max))
    }

    /// Inertia to assume where `platform.inertia` is not known [kg m²]: that of a ball with the radius
    /// [`Self::assumed_radius`] about the centre of mass.
    pub fn assumed_inertia(&self) -> Matrix3<f64> {
        Matrix3::identity() * (0.4 * self.platform.mass * self.assumed_radius().powi(2))
    }
}

/// Horizontal part of a vertical axis at most, relative to its length.
pub(crate) const VERTICAL: f64 = 1e-9;
