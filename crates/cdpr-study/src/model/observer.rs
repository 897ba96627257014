//! The output of a study for one robot whose parameters deviate.
//!
//! Deflections without weather are observed in lanes ([`Observer`]); all else by the scalar models, one robot
//! at a time.

mod note;
mod position;
mod weather;

use crate::file::output::{Output, Recorded};
use crate::file::weather::NominalWeather;
use crate::model::error_model::ErrorModel;
use crate::model::observed::{Measured, MeasuredQuantity};
use cdpr_dynamics::{AmplitudeAt, AmplitudeDerivatives, FrequencyDerivatives, Modes, Swing};
use cdpr_robot::{Coordinate, Deviations, Perturbed, Pose, Robot, Vector3, Vector6};
use cdpr_statics::batch::{Observation, ObservationMotion, ObservationSlopes, ScalarReason};
use cdpr_statics::{
    Deflection, Derivatives, DirectProblem, DirectSolution, DirectStart, Load, Matrix3xX, Observer,
    StaticsError, WantedPose, deflection_from, derivatives, direct,
};
pub use position::position_slopes;
use std::borrow::Cow;

/// Observes the output of a study.
#[derive(Clone, Debug)]
pub struct OutputObserver<'a> {
    robot: &'a Robot,
    /// The wanted pose; its free coordinates are those of the nominal robot.
    pose: Pose,
    load: Load,
    output: Output,
    /// Which amplitude, where the output is one.
    amplitude: Option<AmplitudeAt>,
    free: &'a [Coordinate],
    /// Whether every robot has the lengths of the nominal one, instead of its own for the pose.
    is_kept: bool,
    weather: NominalWeather,
    /// The nominal robot.
    nominal: Deflection,
    /// Observes deflections.
    lanes: Observer<'a>,
}

/// What is observed, and of which robot.
pub(crate) struct Observing<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) pose: Pose,
    pub(crate) load: Load,
    pub(crate) output: Output,
    pub(crate) amplitude: Option<AmplitudeAt>,
    pub(crate) free: &'a [Coordinate],
    pub(crate) is_kept: bool,
    pub(crate) weather: NominalWeather,
}

impl<'a> OutputObserver<'a> {
    /// # Errors
    /// Those of [`Observer::new`].
    pub(crate) fn new(of: Observing<'a>, nominal: &Deflection) -> Result<Self, StaticsError> {
        let Observing { robot, pose, load, output, amplitude, free, is_kept, weather } = of;
        let lanes = Observer::new(robot, WantedPose::at(&pose).free(free), &load)?;
        Ok(Self {
            robot,
            pose: *lanes.pose(),
            load,
            output,
            amplitude,
            free,
            is_kept,
            weather,
            nominal: nominal.clone(),
            lanes,
        })
    }

    /// The output of the nominal robot in its unit.
    ///
    /// # Errors
    /// [`StaticsError`] says why it has none.
    pub(crate) fn nominal_value(&self) -> Result<f64, StaticsError> {
        match self.output {
            _ if !self.weather.is_nothing() => Ok(1e3 * self.nominal_in_weather()?),
            Output::Position => Ok(0.0),
            _ => Ok(self.of_deflection(self.robot, &self.nominal)?.value()),
        }
    }

    /// Observes a robot for each row of a table, in the weather of the study. A robot without the output is
    /// an error with the reason.
    pub fn observe(&self, deviations: &Deviations) -> Vec<Result<Measured, StaticsError>> {
        if !self.weather.is_nothing() {
            return self.observe_in_weather(deviations, Recorded::Output);
        }
        if self.is_in_lanes() {
            let outcomes = self.lanes.observe::<Observation>(deviations).into_iter();
            return outcomes.map(|found| found.map(Measured::from)).collect();
        }
        let observed = |row: &[f64]| {
            let perturbed = self.robot.perturbed(row)?;
            let quantity = match self.output {
                Output::Position => MeasuredQuantity::Displacement(self.displaced(&perturbed)?),
                _ => self.of_deflection(&perturbed.robot, &self.deflection(&perturbed)?)?.quantity,
            };
            Ok(Measured { quantity, scalar: Some(ScalarReason::Output) })
        };
        deviations.each(self.lanes.layout(), |rows| rows.map(observed))
    }

    /// Whether the output is what lanes observe: the deflection with the lengths of each robot for the pose.
    fn is_in_lanes(&self) -> bool {
        self.output == Output::Deflection && !self.is_kept
    }

    /// The deflection of a robot, with its own lengths for the pose or on those of the nominal robot.
    fn deflection(&self, perturbed: &Perturbed) -> Result<Deflection, StaticsError> {
        if !self.is_kept {
            return self.lanes.deflection(perturbed);
        }
        let Deflection { lengths, unloaded, .. } = &self.nominal;
        deflection_from(&perturbed.robot, lengths.clone(), &self.load, &unloaded.equilibrium)
    }

    /// The same with the rotation of the platform, for an output that is a length.
    pub(crate) fn observe_motions(&self, deviations: &Deviations) -> Vec<Result<Measured, StaticsError>> {
        let moved =
            |motion, scalar| Measured { quantity: MeasuredQuantity::Motion(Box::new(motion)), scalar };
        if self.is_in_lanes() {
            let in_lanes = |found: ObservationMotion| {
                let Observation { displacement: p, scalar, .. } = found.observation;
                let r = found.rotation;
                moved(Vector6::new(p.x, p.y, p.z, r.x, r.y, r.z), scalar)
            };
            let outcomes = self.lanes.observe(deviations).into_iter();
            return outcomes.map(|found| found.map(in_lanes)).collect();
        }
        let observed = |row: &[f64]| {
            let perturbed = self.robot.perturbed(row)?;
            let motion = match self.output {
                Output::Position => self.moved(&perturbed)?,
                _ => self.deflection(&perturbed)?.motion(),
            };
            Ok(moved(motion, Some(ScalarReason::Output)))
        };
        deviations.each(self.lanes.layout(), |rows| rows.map(observed))
    }

    /// Displacements under the load [m] of any number of robots without weather, whatever the output is.
    pub fn displacements(&self, deviations: &Deviations) -> Vec<Result<Vector3<f64>, StaticsError>> {
        if self.is_kept {
            let displaced = |row: &[f64]| Ok(self.deflection(&self.robot.perturbed(row)?)?.displacement());
            return deviations.each(self.lanes.layout(), |rows| rows.map(displaced));
        }
        let outcomes = self.lanes.observe::<Observation>(deviations).into_iter();
        outcomes.map(|found| found.map(|found| found.displacement)).collect()
    }

    /// By which rotations are measured [m]: of the nominal robot, whatever robot is observed.
    fn characteristic_length(&self) -> f64 {
        self.nominal.loaded.stability.characteristic_length()
    }

    /// The deflection of a robot for the pose with its derivatives.
    fn derivatives(&self, perturbed: &Perturbed) -> Result<Derivatives, StaticsError> {
        derivatives(
            &perturbed.robot,
            WantedPose::at(&self.pose).free(self.free).tension_offsets(&perturbed.tension_offsets),
            &self.load,
        )
    }

    /// |dp| [m] of a robot under the load without weather, and its derivatives by the parameters.
    ///
    /// # Errors
    /// As [`cdpr_statics::derivatives`]; [`StaticsError::NoDerivative`] where dp is zero.
    pub fn magnitude_slopes(&self, perturbed: &Perturbed) -> Result<(f64, Vec<f64>), StaticsError> {
        if !self.is_kept {
            let found = self.derivatives(perturbed)?;
            return Ok((found.deflection.magnitude(), found.magnitude()?));
        }
        let found = self.deflection(perturbed)?;
        // The lengths are constants: dp' = p_loaded' - p_unloaded'.
        let slopes = |load: &Load, at: &DirectSolution| -> Result<Matrix3xX<f64>, StaticsError> {
            let problem = DirectProblem::new(&perturbed.robot, &found.lengths, load)?;
            Ok(problem.derivatives(&at.equilibrium)?.pose.fixed_rows::<3>(0).into())
        };
        let slopes = slopes(&self.load, &found.loaded)? - slopes(&Load::none(), &found.unloaded)?;
        self.length_slopes(&found.displacement(), &slopes)
    }

    /// The length of a displacement [m], and its derivatives from those of the displacement.
    fn length_slopes(
        &self,
        displaced: &Vector3<f64>,
        slopes: &Matrix3xX<f64>,
    ) -> Result<(f64, Vec<f64>), StaticsError> {
        if displaced.norm() <= self.nominal.rounding(self.robot) {
            let reason = "it is the length of a displacement, which is zero here";
            return Err(StaticsError::NoDerivative { quantity: self.output.label(), reason });
        }
        Ok((displaced.norm(), (displaced.normalize().transpose() * slopes).as_slice().to_vec()))
    }

    /// The output of a robot that is deflected by the load; not its position.
    fn of_deflection(&self, robot: &Robot, found: &Deflection) -> Result<Measured, StaticsError> {
        let at = &found.loaded.equilibrium;
        let problem = DirectProblem::new(robot, &found.lengths, &self.load);
        let quantity = match self.output {
            Output::Deflection | Output::Position => MeasuredQuantity::Displacement(found.displacement()),
            Output::Stiffness => {
                let problem = problem?.with_characteristic_length(self.characteristic_length());
                MeasuredQuantity::Number(problem.stability(at)?.least_stiffness())
            }
            Output::Frequency => {
                let found = Modes::slowest(&problem?, at)?;
                MeasuredQuantity::Number(found.lowest().map_or(0.0, |mode| mode.frequency))
            }
            Output::PlatformFrequency => MeasuredQuantity::Number(Swing::new(&problem?, at)?.platform),
            Output::Amplitude => MeasuredQuantity::Number(1e3 * self.shaken()?.of(&problem?, at)?),
        };
        Ok(Measured { quantity, scalar: Some(ScalarReason::OneByOne) })
    }

    /// Which amplitude is observed.
    fn shaken(&self) -> Result<AmplitudeAt, StaticsError> {
        self.amplitude.ok_or_else(|| StaticsError::Invalid {
            field: "amplitude".to_owned(),
            value: "missing".to_owned(),
            expected: "the frequency of the force that shakes the platform".to_owned(),
        })
    }

    /// Displacement of P [m] of a robot without the load that is given the nominal robot's lengths, from
    /// where the nominal robot stands. Offsets of tension set-points are in these lengths.
    ///
    /// # Errors
    /// Those of the models.
    pub fn displaced(&self, perturbed: &Perturbed) -> Result<Vector3<f64>, StaticsError> {
        Ok(self.moved(perturbed)?.fixed_rows::<3>(0).into())
    }

    /// The same with the rotation vector [rad].
    fn moved(&self, perturbed: &Perturbed) -> Result<Vector6<f64>, StaticsError> {
        let rest = &self.nominal.unloaded.equilibrium;
        let lengths = self.lengths(perturbed)?;
        let found = direct(&perturbed.robot, &lengths, &Load::none(), DirectStart::Near(rest))?;
        Ok(rest.pose.motion_to(&found.equilibrium.pose))
    }

    /// [`OutputObserver::displaced`] with its derivatives with respect to the parameters [m per unit]; those
    /// of the tension set-points only where an error model has them.
    ///
    /// # Errors
    /// Those of the models and of their derivatives.
    pub fn displaced_slopes(
        &self,
        perturbed: &Perturbed,
        errors: &ErrorModel,
    ) -> Result<(Vector3<f64>, Matrix3xX<f64>), StaticsError> {
        let rest = &self.nominal.unloaded.equilibrium;
        let (none, lengths) = (Load::none(), self.lengths(perturbed)?);
        let problem = DirectProblem::new(&perturbed.robot, &lengths, &none)?;
        let found = problem.direct(DirectStart::Near(rest))?.equilibrium;
        // Offsets act through the lengths alone, which are those of the nominal robot.
        let at_offsets = || {
            let wanted = WantedPose::at(&self.pose).free(self.free);
            derivatives(self.robot, wanted.tension_offsets(&perturbed.tension_offsets), &self.load)
        };
        let of_offsets = errors.has_offsets().then(at_offsets).transpose()?;
        let slopes = position_slopes(&problem, &found, of_offsets.as_ref())?;
        Ok((found.pose.position - rest.pose.position, slopes))
    }

    /// The output of the nominal robot in its unit, and its derivatives by the inputs of an error model; of a
    /// position error those of each component of the displacement.
    ///
    /// # Errors
    /// Those of the models and of their derivatives.
    pub(crate) fn to_first_order(
        &self,
        errors: &ErrorModel,
    ) -> Result<(Vec<f64>, Vec<Vec<f64>>), StaticsError> {
        let none = vec![0.0; errors.inputs.len()];
        if self.output == Output::Position && !self.is_in_weather(errors) {
            let perturbed = self.robot.perturbed(errors.deviations(&none).values())?;
            let (displaced, slopes) = self.displaced_slopes(&perturbed, errors)?;
            let row = |axis| {
                let slopes: Vec<f64> = slopes.row(axis).iter().copied().collect();
                scaled(1e3, errors.gradient(&slopes))
            };
            return Ok((displaced.iter().map(|x| 1e3 * x).collect(), [0, 1, 2].map(row).to_vec()));
        }
        let found = self.slopes(errors, &none).pop();
        let (value, gradient) = found.ok_or(StaticsError::NoDerivative {
            quantity: self.output.label(),
            reason: "there is no nominal robot",
        })??;
        Ok((vec![value], vec![gradient]))
    }

    /// Lengths of the nominal robot for the wanted pose, with the offsets of a deviating one.
    fn lengths(&self, perturbed: &Perturbed) -> Result<Cow<'_, [f64]>, StaticsError> {
        let offsets = &perturbed.tension_offsets;
        if offsets.iter().all(|offset| *offset == 0.0) {
            return Ok(Cow::Borrowed(&self.nominal.lengths));
        }
        self.lanes.set_point_lengths(offsets).map(Cow::Owned)
    }

    /// The outputs of robots in their unit for rows of the inputs of an error model, and their derivatives
    /// with respect to these. A robot without the output or without derivatives is an error with the reason:
    /// [`StaticsError::NoDerivative`] where a length is zero or two motions are the softest; those of the
    /// models.
    pub(crate) fn slopes(
        &self,
        errors: &ErrorModel,
        rows: &[f64],
    ) -> Vec<Result<(f64, Vec<f64>), StaticsError>> {
        if self.is_in_weather(errors) {
            let rows = rows.chunks_exact(errors.inputs.len());
            return rows.filter_map(|row| self.slopes_in_weather(errors, row, self.output)).collect();
        }
        let deviations = &errors.deviations(rows);
        if self.is_in_lanes() && self.free.is_empty() {
            let in_unit = |found: ObservationSlopes| {
                (1e3 * found.observation.magnitude(), scaled(1e3, errors.gradient(&found.magnitude)))
            };
            let outcomes = self.lanes.observe(deviations).into_iter();
            return outcomes.map(|found| found.map(in_unit)).collect();
        }
        deviations.each(self.lanes.layout(), |rows| rows.map(|row| self.slopes_one_by_one(row, errors)))
    }

    fn slopes_one_by_one(
        &self,
        deviations: &[f64],
        errors: &ErrorModel,
    ) -> Result<(f64, Vec<f64>), StaticsError> {
        let perturbed = self.robot.perturbed(deviations)?;
        let (robot, of_pose) = (&perturbed.robot, || self.derivatives(&perturbed));
        let ((value, slopes), per_unit) = match self.output {
            Output::Deflection => (self.magnitude_slopes(&perturbed)?, 1e3),
            Output::Position => {
                let (displaced, slopes) = self.displaced_slopes(&perturbed, errors)?;
                (self.length_slopes(&displaced, &slopes)?, 1e3)
            }
            Output::Frequency => {
                let found = of_pose()?;
                let of = FrequencyDerivatives::lowest_of_deflection(robot, &self.load, &found)?;
                ((of.frequency, of.with_lengths(&found.lengths)), 1.0)
            }
            Output::PlatformFrequency => {
                let found = of_pose()?;
                let of = FrequencyDerivatives::of_deflection(robot, &self.load, &found)?;
                ((of.frequency, of.with_lengths(&found.lengths)), 1.0)
            }
            Output::Amplitude => {
                let (found, at) = (of_pose()?, self.shaken()?);
                let of = AmplitudeDerivatives::of_deflection(robot, &self.load, &found, &at)?;
                ((of.amplitude, of.with_lengths(&found.lengths)), 1e3)
            }
            Output::Stiffness => {
                let length = self.characteristic_length();
                (of_pose()?.least_stiffness_with(robot, &self.load, length)?, 1.0)
            }
        };
        Ok((per_unit * value, scaled(per_unit, errors.gradient(&slopes))))
    }
}

impl From<Observation> for Measured {
    fn from(found: Observation) -> Self {
        Self { quantity: MeasuredQuantity::Displacement(found.displacement), scalar: found.scalar }
    }
}

fn scaled(per_unit: f64, slopes: Vec<f64>) -> Vec<f64> {
    slopes.into_iter().map(|slope| per_unit * slope).collect()
}
