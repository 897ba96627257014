//! Deflections of a robot with deviations of its parameters, many at a time.
//!
//! Robots with cables that are linear or have an elastic law, taut or sagging, at their limits or not, behind
//! leads and over pulleys with vertical axes or without, are observed in the lanes of the vector unit
//! (`lanes/chain.rs`), each from the tensions of the nominal robot, and with fewer cables than free motions
//! also from its free coordinates (`lanes/chain/free.rs`). Any other robot is observed by the scalar models,
//! which decide on every failure.
//!
//! Where the sum of squares of the inverse model has several local minima, a perturbed robot is observed in
//! the one that it shares with the nominal robot, as long as it exists. [`deflection`] of the same robot may
//! find another.

mod motions;
pub(crate) mod rows;
mod slopes;

use crate::error::StaticsError;
use crate::inverse::{Branch, FreeBranch, HeldPose, InverseSolution};
use crate::lanes::chain::{Outcome, observe};
use crate::lanes::level::LevelFrame;
use crate::lanes::observer::rows::{Nominal, Rows};
use crate::lanes::reason::ScalarReason;
use crate::loading::{
    Deflection, deflection, deflection_beside, deflection_near, wind, wind_near, wind_rest,
};
use crate::state::{Load, Residual};
use cdpr_number::lanes::{Lanes, MAX_LANES, Mask, Simd, WithSimd, dispatch};
use cdpr_number::three;
use cdpr_robot::{Coordinate, ParameterLayout, Perturbed, Pose, Robot, Vector3, Vector6};
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
    pub fn rms(&self) -> f64 {
        self.displacement.norm()
    }

    fn one_by_one(deflection: &Deflection) -> Self {
        Self {
            displacement: deflection.displacement(),
            unloaded: deflection.unloaded.report.residual,
            loaded: deflection.loaded.report.residual,
            scalar: Some(ScalarReason::OneByOne),
        }
    }
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
    /// At a whole pose; `None` where it has no answer.
    Pose(Option<Branch>),
    /// Where it rests with free coordinates.
    Rest(FreeBranch),
}

impl<'a> Observer<'a> {
    /// An observer of `robot`, wanted at `pose` under its own weight and then loaded with `load`.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a load that is not finite, [`StaticsError::Robot`] for an invalid robot.
    pub fn new(robot: &'a Robot, pose: &Pose, load: &Load) -> Result<Self, StaticsError> {
        robot.validate()?;
        load.validate()?;
        let (solution, branch) = Branch::of(robot, pose).ok().unzip();
        let solution = solution.map(|InverseSolution { lengths, equilibrium, multipliers, .. }| {
            (HeldPose { lengths, equilibrium }, multipliers)
        });
        let nominal = Nominal::new(robot, load, solution, &[]);
        let layout = ParameterLayout::of(robot);
        Ok(Self { robot, pose: *pose, load: *load, layout, wanted: Wanted::Pose(branch), nominal })
    }

    /// As [`Observer::new`], of a robot with fewer cables than free motions: the `free` coordinates of the
    /// pose are found where the platform rests, those of deviating robots from those of the nominal one.
    ///
    /// # Errors
    /// Those of [`Observer::new`] and of [`crate::held_at`].
    pub fn with_free(
        robot: &'a Robot,
        pose: &Pose,
        load: &Load,
        free: &[Coordinate],
    ) -> Result<Self, StaticsError> {
        if free.is_empty() {
            return Self::new(robot, pose, load);
        }
        robot.validate()?;
        load.validate()?;
        let branch = FreeBranch::of(robot, pose, free)?;
        let rest = branch.rest();
        let pose = rest.equilibrium.pose;
        let nominal = Nominal::new(robot, load, Some((rest.clone(), Vector6::zeros())), free);
        let layout = ParameterLayout::of(robot);
        Ok(Self { robot, pose, load: *load, layout, wanted: Wanted::Rest(branch), nominal })
    }

    /// The wanted pose; its free coordinates are those of the nominal robot.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Deflection of the robot with `deviations` added to its parameters, in the order of [`Parameter::of`].
    ///
    /// # Errors
    /// [`StaticsError`] says why this robot has no deflection.
    pub fn observe(&self, deviations: &[f64]) -> Result<Observation, StaticsError> {
        Ok(Observation::one_by_one(&self.deflection(&self.robot.perturbed(deviations)?)?))
    }

    /// Deflections of any number of robots: `deviations` has a row of all parameters for each, one after the
    /// other.
    ///
    /// An answer depends on its own row alone, to the last digit, and agrees with [`Observer::observe`] to
    /// rounding, but for one row in 10^4 of random robots: where a robot has several minima of its
    /// tensions, `observe` takes the one next to the nominal robot's, and this may take another, mostly the
    /// least of all, as [`deflection`] does (docs/VALIDATION.md). [`Observation::scalar`] says which
    /// ones were left to the scalar models, and why. Numbers that are not whole rows are a failure of all of
    /// them, [`RobotError::DeviationRows`].
    pub fn observe_all(&self, deviations: &[f64]) -> Vec<Result<Observation, StaticsError>> {
        self.each(deviations, dispatch, |row, why| {
            Ok(Observation { scalar: Some(why), ..self.observe(row)? })
        })
    }

    /// The answers of the lanes, and of `alone` to rows that they leave, for a reason.
    fn each<'o, T>(
        &'o self,
        deviations: &'o [f64],
        in_lanes: impl FnOnce(Batch<'o>) -> Vec<Result<T, ScalarReason>>,
        alone: impl Fn(&[f64], ScalarReason) -> Result<T, StaticsError>,
    ) -> Vec<Result<T, StaticsError>> {
        self.layout.each_row(deviations, |rows| {
            let found = in_lanes(Batch { observer: self, deviations });
            found.into_iter().zip(rows).map(|(found, row)| found.or_else(|why| alone(row, why)))
        })
    }

    /// Deflection of a robot that deviates from this one.
    ///
    /// # Errors
    /// [`StaticsError`] says why this robot has no deflection.
    pub fn deflection(&self, perturbed: &Perturbed) -> Result<Deflection, StaticsError> {
        let (robot, offsets) = (&perturbed.robot, &perturbed.tension_offsets);
        match &self.wanted {
            Wanted::Pose(Some(branch)) => deflection_near(branch, robot, &self.pose, offsets, &self.load),
            Wanted::Pose(None) => deflection(robot, &self.pose, offsets, &self.load),
            Wanted::Rest(branch) => deflection_beside(branch, robot, offsets, &self.load),
        }
    }

    /// Unstrained lengths [m] of the robot itself at the wanted pose, with `tension_offsets` [N] added to its
    /// set-points, as [`crate::wound_lengths`] has them.
    ///
    /// # Errors
    /// Those of the inverse model.
    pub fn wound_lengths(&self, tension_offsets: &[f64]) -> Result<Vec<f64>, StaticsError> {
        let robot = self.robot;
        Ok(match &self.wanted {
            Wanted::Pose(Some(branch)) => wind_near(branch, robot, &self.pose, tension_offsets)?.lengths,
            Wanted::Pose(None) => wind(robot, &self.pose, tension_offsets)?.lengths,
            Wanted::Rest(branch) => wind_rest(robot, tension_offsets, branch.rest().clone())?.1.lengths,
        })
    }
}

/// Rows of deviations for the lanes.
struct Batch<'a> {
    observer: &'a Observer<'a>,
    deviations: &'a [f64],
}

impl WithSimd for Batch<'_> {
    type Output = Vec<Result<Observation, ScalarReason>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Observer { robot, pose, load, layout, nominal, .. } = self.observer;
        let parameters = layout.count();
        let rows = self.deviations.len() / parameters;
        let nominal = match nominal {
            Ok(nominal) => nominal,
            Err(why) => return vec![Err(*why); rows],
        };
        let mut found = Vec::with_capacity(rows);
        for rows in self.deviations.chunks(Lanes::<S>::COUNT * parameters) {
            let count = rows.len() / parameters;
            let rows = Rows::new(simd, rows, layout);
            let (mut start, level, valid) = rows.robots(robot, pose, load, nominal);
            let outcome = observe(&mut start, &nominal.shared, None);
            let answers = read(&outcome, level.as_ref(), valid, nominal.no_tensions());
            found.extend(answers.into_iter().take(count));
        }
        found
    }
}

/// The observation in each lane, or the first link that failed; robots are `sound`, and their axes `upright`.
#[inline(always)]
fn read<S: Simd>(
    outcome: &Outcome<S>,
    level: Option<&LevelFrame<S>>,
    [sound, upright]: [Mask<S>; 2],
    [no_tensions, none_to_take]: [ScalarReason; 2],
) -> [Result<Observation, ScalarReason>; MAX_LANES] {
    let [converged, unfolded, held, standing, answered] = outcome.passed;
    let links = [
        (sound, ScalarReason::InvalidRobot),
        (upright, ScalarReason::Pulleys),
        (converged, no_tensions),
        (unfolded, none_to_take),
        (held, ScalarReason::Lengths),
        (standing, ScalarReason::Unloaded),
        (answered, ScalarReason::Loaded),
    ];
    let mut first = outcome.displacement[0].all(links.len() as f64);
    for (i, (passed, _)) in links.iter().enumerate().rev() {
        first = passed.select(first, first.all(i as f64));
    }
    let first_failed = first.to_array();
    let displacement = match level {
        None => outcome.displacement,
        Some(level) => level.to_base(&outcome.displacement),
    };
    let displacement = three!(|k| displacement[k].to_array());
    let (unloaded, loaded) = (outcome.unloaded.norms(), outcome.loaded.norms());
    from_fn(|lane| match links.get(first_failed[lane] as usize) {
        Some((_, why)) => Err(*why),
        None => Ok(Observation {
            displacement: Vector3::from_fn(|k, _| displacement[k][lane]),
            unloaded: unloaded[lane],
            loaded: loaded[lane],
            scalar: None,
        }),
    })
}
