//! Deflections of a robot with deviations of its parameters, many at a time.
//!
//! Robots with cables that are linear or have an elastic law, taut or sagging, at their limits or not, behind
//! leads and over pulleys or without, are observed in the lanes of the vector unit (`lanes/chain.rs`), each
//! from the tensions of the nominal robot, and with fewer cables than free motions also from its free
//! coordinates (`lanes/chain/free.rs`). Any other robot is observed by the scalar models, which decide on
//! every failure.
//!
//! Where the sum of squares of the inverse model has several local minima, a perturbed robot is observed in
//! the one that it shares with the nominal robot, as long as it exists. [`deflection`] of the same robot may
//! find another.

mod motions;
pub(crate) mod rows;
mod slopes;

use crate::error::StaticsError;
use crate::inverse::{Branch, FreeBranch, InverseSolution, PoseLengths, refuse_offsets, require_smooth};
use crate::lanes::chain::{Outcome, Stage};
use crate::lanes::level::LevelFrame;
use crate::lanes::observer::rows::Nominal;
use crate::lanes::reason::ScalarReason;
use crate::loading::{Deflection, SetPointLengths, deflection_from, lengths_at_rest};
use crate::state::{Load, Residual, WantedPose};
use cdpr_number::lanes::{MAX_LANES, Mask, Simd};
use cdpr_number::three;
use cdpr_robot::{Deviations, ParameterLayout, Perturbed, Pose, Robot, Vector3, Vector6};
pub use motions::ObservationMotion;
pub use slopes::ObservationSlopes;
use std::array::from_fn;

/// The deflection of one perturbed robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// dp = p_loaded - p_unloaded [m], Eq. (4).
    pub displacement: Vector3<f64>,
    /// Residuals of the equilibrium under the platform's own weight.
    pub unloaded: Residual,
    /// Residuals of the equilibrium with the load added.
    pub loaded: Residual,
    /// Why the scalar models found it; `None` for one found in lanes.
    pub scalar: Option<ScalarReason>,
}

impl Observation {
    /// |dp| [m], which the paper calls the RMS of the static deflection.
    pub fn magnitude(&self) -> f64 {
        self.displacement.norm()
    }

    fn of(deflection: &Deflection, why: ScalarReason) -> Self {
        Self {
            displacement: deflection.displacement(),
            unloaded: deflection.unloaded.report.residual,
            loaded: deflection.loaded.report.residual,
            scalar: Some(why),
        }
    }
}

/// What is observed of a robot: [`Observation`], [`ObservationMotion`] or [`ObservationSlopes`].
pub trait Observed: Sized {
    /// Observes the rows of a batch in lanes, or says why a row is left to the scalar models.
    #[doc(hidden)]
    fn in_lanes(batch: Batch) -> Vec<Result<Self, ScalarReason>>;

    /// Observes one row by the scalar models.
    #[doc(hidden)]
    fn by_scalar_models(
        observer: &Observer,
        deviations: &[f64],
        why: ScalarReason,
    ) -> Result<Self, StaticsError>;
}

/// A robot whose parameters deviate, observed at a wanted pose under a load.
#[derive(Clone, Debug)]
pub struct Observer<'a> {
    robot: &'a Robot,
    pose: Pose,
    load: Load,
    layout: ParameterLayout,
    wanted: Wanted,
    /// What the lanes start from, or why they would find nothing.
    nominal: Result<Nominal, ScalarReason>,
}

/// The inverse model of the nominal robot, from which that of a deviating one is found.
#[derive(Clone, Debug)]
enum Wanted {
    /// At a whole pose; `None` where it has no solution.
    Pose(Option<Branch>),
    /// Where it rests with free coordinates.
    Rest(FreeBranch),
}

impl<'a> Observer<'a> {
    /// An observer of `robot` at a wanted pose under its own weight and then loaded with `load`.
    ///
    /// Free coordinates are found where the platform rests, those of deviating robots from those of the
    /// nominal one.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a load that is not finite, for offsets, which are among the deviations,
    /// for a tension reference, which is the robot's own, and for a distribution of tensions that jumps from
    /// pose to pose; [`StaticsError::Robot`] for an invalid robot; with free coordinates those of
    /// [`crate::inverse`].
    pub fn new<'w>(
        robot: &'a Robot,
        wanted: impl Into<WantedPose<'w>>,
        load: &Load,
    ) -> Result<Self, StaticsError> {
        let WantedPose { pose, free, tension_reference, .. } = refuse_offsets(wanted.into())?;
        if let Some(given) = tension_reference {
            let value = format!("a list of {}", given.len());
            let expected = "none here: deviating robots have the reference of the robot";
            return Err(StaticsError::invalid("tension_reference".to_owned(), value, expected));
        }
        robot.validate()?;
        load.validate()?;
        let (pose, wanted, solution) = if free.is_empty() {
            require_smooth(robot)?;
            let (solution, branch) = Branch::of(robot, &pose).ok().unzip();
            let solution = solution.map(|InverseSolution { lengths, equilibrium, multipliers, .. }| {
                (PoseLengths { lengths, equilibrium }, multipliers)
            });
            (pose, Wanted::Pose(branch), solution)
        } else {
            let branch = FreeBranch::of(robot, &pose, free)?;
            let rest = branch.rest().clone();
            (rest.equilibrium.pose, Wanted::Rest(branch), Some((rest, Vector6::zeros())))
        };
        let nominal = Nominal::new(robot, load, solution, free);
        let layout = ParameterLayout::of(robot);
        Ok(Self { robot, pose, load: *load, layout, wanted, nominal })
    }

    /// The wanted pose; its free coordinates are those of the nominal robot.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The order of the parameters of the robot.
    pub fn layout(&self) -> &ParameterLayout {
        &self.layout
    }

    /// Observes a robot for each row of a table, whose deviations are added to the parameters.
    ///
    /// A result depends on its own row alone, to the last digit, and agrees with
    /// [`Observer::observe_one_by_one`] to rounding, but for one row in 10^4 of random robots: where a robot
    /// has several minima of its tensions, the scalar models take the one next to the nominal robot's, and
    /// this may take another, mostly the least of all, as [`deflection`] does.
    /// [`Observation::scalar`] says which ones were left to the scalar models, and why.
    ///
    /// A slope of [`ObservationSlopes`] times the range of its parameter agrees to 1e-11 of the longest
    /// cable. Robots in which left and right derivatives may differ are left to the scalar models, and so are
    /// those in which a tension is at its greatest value where the cable leaves a pulley.
    ///
    /// Each row of a table for robots with other parameters fails with the error of [`Deviations::check`].
    pub fn observe<T: Observed>(&self, deviations: &Deviations) -> Vec<Result<T, StaticsError>> {
        deviations.each(&self.layout, |rows| {
            let found = T::in_lanes(Batch { observer: self, deviations: deviations.values() });
            let alone =
                |(found, row): (Result<T, _>, _)| found.or_else(|why| T::by_scalar_models(self, row, why));
            found.into_iter().zip(rows).map(alone)
        })
    }

    /// The same by the scalar models, one robot after the other.
    pub fn observe_one_by_one<T: Observed>(&self, deviations: &Deviations) -> Vec<Result<T, StaticsError>> {
        let observed = |row| T::by_scalar_models(self, row, ScalarReason::OneByOne);
        deviations.each(&self.layout, |rows| rows.map(observed))
    }

    /// Deflection of a robot that deviates from this one.
    ///
    /// # Errors
    /// [`StaticsError`] says why this robot has no deflection.
    pub fn deflection(&self, perturbed: &Perturbed) -> Result<Deflection, StaticsError> {
        let Perturbed { robot, tension_offsets } = perturbed;
        let rest = |branch: &FreeBranch| branch.nearby(robot);
        let PoseLengths { lengths, equilibrium } = self.lengths(robot, tension_offsets, rest)?;
        deflection_from(robot, lengths, &self.load, &equilibrium)
    }

    /// Unstrained lengths [m] of the robot itself at the wanted pose, with `tension_offsets` [N] added to its
    /// set-points, as [`crate::set_point_lengths`] has them.
    ///
    /// # Errors
    /// Those of the inverse model.
    pub fn set_point_lengths(&self, tension_offsets: &[f64]) -> Result<Vec<f64>, StaticsError> {
        let rest = |branch: &FreeBranch| Ok(branch.rest().clone());
        Ok(self.lengths(self.robot, tension_offsets, rest)?.lengths)
    }

    /// The lengths for the set-points of a robot that deviates from this one; with free coordinates at its
    /// `rest`.
    fn lengths(
        &self,
        robot: &Robot,
        tension_offsets: &[f64],
        rest: impl FnOnce(&FreeBranch) -> Result<PoseLengths, StaticsError>,
    ) -> Result<PoseLengths, StaticsError> {
        let pose = &self.pose;
        let found = match &self.wanted {
            Wanted::Pose(Some(branch)) => {
                SetPointLengths::from(robot, pose, tension_offsets, branch.nearby(robot, pose)?)
            }
            Wanted::Pose(None) => SetPointLengths::new(robot, &WantedPose::at(pose), tension_offsets),
            Wanted::Rest(branch) => return Ok(lengths_at_rest(robot, tension_offsets, rest(branch)?)?.1),
        };
        Ok(found?.offset)
    }
}

/// Rows of deviations for the lanes.
pub struct Batch<'a> {
    observer: &'a Observer<'a>,
    deviations: &'a [f64],
}

/// The robots whose outcome is read: their level frames, where these are not the base frame, and the lanes
/// whose parameters are valid, and whose axes are upright.
struct InRows<'a, S: Simd> {
    level: Option<&'a LevelFrame<S>>,
    valid: [Mask<S>; 2],
    nominal: &'a Nominal,
}

/// The observation in each lane, or why it was left.
#[inline(always)]
fn read<S: Simd>(
    outcome: &Outcome<S>,
    &InRows { level, valid: [sound, upright], nominal }: &InRows<'_, S>,
) -> [Result<Observation, ScalarReason>; MAX_LANES] {
    let mut failures = outcome.failures;
    failures.add(Stage::Parameters, sound);
    failures.add(Stage::Axes, upright);
    let failed = failures.of_lanes();
    let displacement = match level {
        None => outcome.displacement,
        Some(level) => level.to_base(&outcome.displacement),
    };
    let displacement = three!(|k| displacement[k].to_array());
    let (unloaded, loaded) = (outcome.unloaded.norms(), outcome.loaded.norms());
    from_fn(|lane| match failed[lane] {
        Some(stage) => Err(nominal.why(stage)),
        None => Ok(Observation {
            displacement: Vector3::from_fn(|k, _| displacement[k][lane]),
            unloaded: unloaded[lane],
            loaded: loaded[lane],
            scalar: None,
        }),
    })
}
