//! What is found of a robot at a pose with a load on it, in lanes or by the scalar models.

use crate::derivatives::derivatives_from;
use crate::error::StaticsError;
use crate::inverse::InverseSolution;
use crate::lanes::reason::ScalarReason;
use crate::loading::{Deflection, deflection_from};
use crate::state::{Load, Residual};
use cdpr_robot::{ParameterLayout, Robot, Vector3};

/// A robot at a pose with a load on it that its cables, of kept lengths, yield to.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadedPose {
    /// dp, Eq. (4) [m].
    pub displacement: Vector3<f64>,
    /// Tension of every cable at the platform and at its exit point, over a pulley where the cable leaves it
    /// [N]: without the load, and with it.
    pub tensions: [Vec<[f64; 2]>; 2],
    /// Residuals of both equilibria.
    pub residuals: [Residual; 2],
    /// Stiffness of the softest motion with the load [N/m], see [`crate::Stability::least_stiffness`].
    pub least_stiffness: f64,
    /// Cables (from 0) that are slack with the load.
    pub slack: Vec<usize>,
    /// Why the scalar models found it; `None` for one found in lanes.
    pub scalar: Option<ScalarReason>,
}

impl LoadedPose {
    /// That of a deflection, by the scalar models.
    pub fn of(robot: &Robot, deflection: &Deflection) -> Self {
        let Deflection { lengths, unloaded, loaded } = deflection;
        Self {
            displacement: deflection.displacement(),
            tensions: [unloaded, loaded].map(|solution| solution.equilibrium.end_tensions(robot, lengths)),
            residuals: [unloaded, loaded].map(|solution| solution.report.residual),
            least_stiffness: loaded.stability.least_stiffness(),
            slack: loaded.report.slack.clone(),
            scalar: Some(ScalarReason::OneByOne),
        }
    }
}

/// A loaded robot at a pose with the derivatives of its deflection.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseSlopes {
    /// The robot. [`LoadedPose::scalar`] says why its derivatives were left to the scalar models.
    pub loaded: LoadedPose,
    /// Derivatives of |dp| by every parameter, in the order of [`cdpr_robot::Parameter::of`] [m per unit];
    /// `None` where |dp| is not differentiable.
    pub magnitude: Option<Vec<f64>>,
}

/// What is found of a robot at a pose with a load on it: [`LoadedPose`] or [`PoseSlopes`].
pub trait Loaded: Sized {
    /// Whether the derivatives are among it.
    #[doc(hidden)]
    const WITH_SLOPES: bool;

    /// Its part of all that is found.
    #[doc(hidden)]
    fn part_of(found: PoseSlopes) -> Self;
}

impl Loaded for LoadedPose {
    const WITH_SLOPES: bool = false;

    fn part_of(found: PoseSlopes) -> Self {
        found.loaded
    }
}

impl Loaded for PoseSlopes {
    const WITH_SLOPES: bool = true;

    fn part_of(found: PoseSlopes) -> Self {
        found
    }
}

impl PoseSlopes {
    /// Those of the scalar models, without derivatives unless they are asked for.
    pub(super) fn by_scalar_models(
        robot: &Robot,
        wanted: &InverseSolution,
        load: &Load,
        (why, with_slopes): (ScalarReason, bool),
    ) -> Result<Self, StaticsError> {
        let derivatives = || derivatives_from(robot, wanted.equilibrium.pose, load, wanted.clone());
        let (deflection, magnitude) = match with_slopes.then(derivatives) {
            Some(Ok(found)) => {
                let parameters = ParameterLayout::of(robot).count();
                let slopes = found.magnitude().ok();
                (found.deflection, slopes.map(|slopes| slopes.into_iter().take(parameters).collect()))
            }
            // A pose without a derivative is solved nevertheless.
            None | Some(Err(StaticsError::NoDerivative { .. })) => {
                (deflection_from(robot, wanted.lengths.clone(), load, &wanted.equilibrium)?, None)
            }
            Some(Err(error)) => return Err(error),
        };
        Ok(Self { loaded: LoadedPose { scalar: Some(why), ..LoadedPose::of(robot, &deflection) }, magnitude })
    }
}
