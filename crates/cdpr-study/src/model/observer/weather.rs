//! Observations in weather: by the scalar models, one robot at a time.
//!
//! The lengths are those of the robot without weather. It comes after the load, so that the displacement is
//! that from the pose without load and weather, as [`cdpr_statics::weather::in_weather`] has it; of a
//! position it is that from where the nominal robot rests without weather.

use crate::file::output::{Output, Recorded};
use crate::file::weather::{WeatherNumbers, WeatherQuantity};
use crate::model::error_model::ErrorModel;
use crate::model::observed::{Measured, MeasuredQuantity};
use crate::model::observer::OutputObserver;
use cdpr_robot::{Deviations, Vector3, Vector6};
use cdpr_statics::batch::ScalarReason;
use cdpr_statics::weather::{rest_in_weather, weather_derivatives};
use cdpr_statics::{Load, Matrix3xX, StaticsError, WantedPose};

/// What is known of each robot.
type Outcomes<T> = Vec<Result<T, StaticsError>>;

impl OutputObserver<'_> {
    /// Observes a robot for each of `rows` of inputs, vectors one after the other.
    pub(crate) fn observe_inputs(
        &self,
        errors: &ErrorModel,
        rows: &[f64],
        recorded: Recorded,
    ) -> Outcomes<Measured> {
        let deviations = errors.deviations(rows);
        match (self.weathers(errors, rows), recorded) {
            (None, Recorded::Output) => self.observe(&deviations),
            (None, Recorded::Motion) => self.observe_motions(&deviations),
            (Some(weathers), _) => self.observe_in(&deviations, &weathers, recorded),
        }
    }

    /// Displacements [m] of robots with these inputs under the load, or with output position without it, on
    /// the lengths of the nominal robot and from where that rests; whatever the output of the study is.
    pub fn displacements_of(
        &self,
        errors: &ErrorModel,
        rows: &[f64],
        output: Output,
    ) -> Outcomes<Vector3<f64>> {
        let deviations = errors.deviations(rows);
        match (self.weathers(errors, rows), output) {
            (Some(weathers), _) => {
                self.motions_in(&deviations, &weathers, output, |motion| position(&motion))
            }
            (None, Output::Position) => deviations.each(self.lanes.layout(), |rows| {
                rows.map(|row| self.displaced(&self.robot.perturbed(row)?))
            }),
            (None, _) => self.displacements(&deviations),
        }
    }

    /// Whether robots with these inputs are observed in weather.
    pub fn is_in_weather(&self, errors: &ErrorModel) -> bool {
        !self.weather.is_nothing() || errors.weather_terms().next().is_some()
    }

    /// In weather, the length of the displacement [mm] for a row of inputs, as [`Self::displacements_of`] has
    /// it, and its derivatives by the inputs; `None` without weather.
    ///
    /// # Errors
    /// [`StaticsError::NoDerivative`] for a position, on lengths that are given, and for cables over pulleys
    /// in wind; those of [`weather_derivatives`].
    pub fn slopes_in_weather(
        &self,
        errors: &ErrorModel,
        row: &[f64],
        output: Output,
    ) -> Option<Result<(f64, Vec<f64>), StaticsError>> {
        let found = self.is_in_weather(errors).then(|| self.slopes_in(row, errors, output))?;
        Some(found.map(|(size, slopes)| (1e3 * size, slopes.into_iter().map(|slope| 1e3 * slope).collect())))
    }

    /// How far the nominal robot is displaced in the weather of the study [m].
    pub(super) fn nominal_in_weather(&self) -> Result<f64, StaticsError> {
        let none = vec![0.0; self.lanes.layout().count()];
        let motion = self.motion_in(&none, &[0.0; WeatherQuantity::ALL.len()], self.output)?;
        Ok(position(&motion).norm())
    }

    /// Observes robots in the weather of the study.
    pub(super) fn observe_in_weather(
        &self,
        deviations: &Deviations,
        recorded: Recorded,
    ) -> Outcomes<Measured> {
        let weathers = vec![[0.0; WeatherQuantity::ALL.len()]; deviations.count()];
        self.observe_in(deviations, &weathers, recorded)
    }

    /// Deviations of the numbers of the weather for each row of inputs; `None` without weather.
    fn weathers(&self, errors: &ErrorModel, rows: &[f64]) -> Option<Vec<WeatherNumbers>> {
        self.is_in_weather(errors)
            .then(|| rows.chunks_exact(errors.inputs.len()).map(|row| errors.of_weather(row)).collect())
    }

    fn observe_in(
        &self,
        deviations: &Deviations,
        weathers: &[WeatherNumbers],
        recorded: Recorded,
    ) -> Outcomes<Measured> {
        self.motions_in(deviations, weathers, self.output, |motion| {
            let quantity = match recorded {
                Recorded::Output => MeasuredQuantity::Displacement(position(&motion)),
                Recorded::Motion => MeasuredQuantity::Motion(Box::new(motion)),
            };
            Measured { quantity, scalar: Some(ScalarReason::Weather) }
        })
    }

    fn motions_in<T>(
        &self,
        deviations: &Deviations,
        weathers: &[WeatherNumbers],
        output: Output,
        of: impl Fn(Vector6<f64>) -> T,
    ) -> Outcomes<T> {
        deviations.each(self.lanes.layout(), |rows| {
            rows.zip(weathers).map(|(row, weather)| self.motion_in(row, weather, output).map(&of))
        })
    }

    /// Motion [m, rad] of a robot with these deviations of its parameters and of the weather.
    fn motion_in(
        &self,
        deviations: &[f64],
        weather: &WeatherNumbers,
        output: Output,
    ) -> Result<Vector6<f64>, StaticsError> {
        let weather = self.weather.deviating(weather)?;
        let perturbed = self.robot.perturbed(deviations)?;
        let robot = &perturbed.robot;
        if output == Output::Position {
            let (rest, lengths) = (&self.nominal.unloaded.equilibrium.pose, self.lengths(&perturbed)?);
            let found = rest_in_weather(robot, &lengths, &Load::none(), rest, &weather)?;
            return Ok(rest.motion_to(&found.pose));
        }
        let still = self.deflection(&perturbed)?;
        let loaded = &still.loaded.equilibrium.pose;
        let found = rest_in_weather(robot, &still.lengths, &self.load, loaded, &weather)?;
        Ok(still.unloaded.equilibrium.pose.motion_to(&found.pose))
    }

    /// The same in metres.
    fn slopes_in(
        &self,
        row: &[f64],
        errors: &ErrorModel,
        output: Output,
    ) -> Result<(f64, Vec<f64>), StaticsError> {
        if output == Output::Position || self.is_kept {
            let reason = "in weather they are known for the lengths of each robot alone";
            return Err(StaticsError::NoDerivative { quantity: output.label(), reason });
        }
        let weather = self.weather.deviating(&errors.of_weather(row))?;
        let perturbed = self.robot.perturbed(errors.deviations(row).values())?;
        let turns = errors.weather_terms().any(|(quantity, _)| quantity == WeatherQuantity::WindFrom);
        if turns && perturbed.robot.gravity != self.robot.gravity {
            let reason = "the direction of the wind turns about the vertical of the nominal robot";
            return Err(StaticsError::NoDerivative { quantity: output.label(), reason });
        }
        let wanted = WantedPose::at(&self.pose).free(self.free).tension_offsets(&perturbed.tension_offsets);
        let found = weather_derivatives(&perturbed.robot, wanted, &self.load, &weather)?;
        let displaced = found.displaced();
        let slopes: Matrix3xX<f64> = found.displacement.columns(0, errors.parameters()).into_owned();
        let (size, slopes) = self.length_slopes(&displaced, &slopes)?;
        let mut gradient = errors.gradient(&slopes);
        let towards = displaced.normalize();
        for (quantity, term) in errors.weather_terms() {
            let (of, per_unit) = quantity.of_models();
            let slope = found.per_weather[of as usize].as_ref().map_err(Clone::clone)?;
            gradient[term.input] += term.factor * per_unit * towards.dot(slope);
        }
        Ok((size, gradient))
    }
}

fn position(motion: &Vector6<f64>) -> Vector3<f64> {
    motion.fixed_rows::<3>(0).into()
}
