//! Samplings and surfaces of a study made ready to run.

mod weather;

use crate::error::StudyError;
use crate::file::study_file::{AxisSpec, InputSpec, SamplingSpec, SurfaceSpec};
use crate::model::error_model::{ErrorModel, Wrong};
use crate::model::nominal::NominalAt;
use crate::model::observer::{Observing, OutputObserver};
use crate::model::operating_point::{Moduli, resolved};
use crate::model::pose_set::Located;
use crate::model::study::{NominalPose, Sampling, Study, Surface, SurfaceAxis, keys};
use cdpr_robot::{Coordinate, Parameter, Pose, plausible};
use cdpr_sensitivity::{Input, SobolDesign};
use cdpr_statics::{Deflection, StaticsError};
use indexmap::IndexMap;

/// Points of one axis of a surface.
const MOST_OF_AXIS: usize = 10_000;

/// Points of a surface, which is held in memory and drawn as a whole.
const MOST_POINTS: usize = 1_000_000;

/// Observations of a sampling, for laws to be fitted.
pub(crate) const FEWEST_OBSERVATIONS: usize = 3;

impl Study {
    /// Prepares the sampling called `name`; at several poses, that at one of them: `NAME/0000`, ....
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for an unknown name or an invalid setting, [`StudyError::Nominal`] where the
    /// nominal robot cannot
    /// hold the pose.
    pub fn sampling(&self, name: &str) -> Result<Sampling<'_>, StudyError> {
        let Located { name, entry, spec, pose, field } = self.located(name)?;
        let (load, at) = (self.file.load(), spec.at(pose));
        let nominal = self.deflection(&field, &at)?;
        let (nominal_value, observer) = self.observer(&field, &at, &spec.free, &nominal)?;
        let (errors, operating_moduli, design) = self.design(entry, spec, &[&nominal])?;
        let correlation = self.correlation(entry, spec, &design)?;
        let groups = self.groups(&errors)?;
        Ok(Sampling {
            name,
            title: &spec.title,
            robot: &self.robot,
            pose,
            load,
            design,
            correlation,
            groups,
            errors,
            operating_moduli,
            nominal,
            nominal_value,
            observer,
            study: self,
        })
    }

    /// [`Study::sampling`]; `None` at one of several poses that nothing holds.
    pub(crate) fn held(&self, name: &str) -> Result<Option<Sampling<'_>>, StudyError> {
        match self.sampling(name) {
            Err(StudyError::Nominal { .. }) if name.contains('/') => Ok(None),
            sampling => sampling.map(Some),
        }
    }

    /// The error model of a sampling at the operating point of these deflections of the nominal robot, and
    /// the points at which it is observed.
    pub(crate) fn design(
        &self,
        name: &str,
        spec: &SamplingSpec,
        at: &[&Deflection],
    ) -> Result<(ErrorModel, Option<Moduli>, SobolDesign), StudyError> {
        let field = format!("samplings.{name}");
        let Some(model) = self.file.error_models.get(&spec.error_model) else {
            let expected = keys(&self.file.error_models);
            return Err(self.invalid(&format!("{field}.error_model"), &spec.error_model, &expected));
        };
        let (errors, moduli) = self.error_model(&spec.error_model, model, at)?;
        if spec.observations < FEWEST_OBSERVATIONS {
            return Err(self.invalid(
                &format!("{field}.observations"),
                spec.observations,
                "at least 3, for laws to be fitted",
            ));
        }
        let is_unbounded = |input: &Input| input.law.support().min == f64::NEG_INFINITY;
        let skips_origin = !spec.correlations.is_empty() || errors.inputs.iter().any(is_unbounded);
        let first = spec.first_index.unwrap_or_else(|| u32::from(skips_origin));
        let design = SobolDesign::new(errors.inputs.clone(), first, spec.observations)
            .map_err(|source| self.statistics(format!("{field}.first_index"), source))?;
        Ok((errors, moduli, design))
    }

    /// Prepares the surface called `name`.
    ///
    /// # Errors
    /// As [`Study::sampling`].
    pub fn surface(&self, name: &str) -> Result<Surface<'_>, StudyError> {
        let field = format!("surfaces.{name}");
        let Some((name, spec)) = self.file.surfaces.get_key_value(name) else {
            return Err(self.invalid(&field, "missing", &keys(&self.file.surfaces)));
        };
        let pose = self.pose(&format!("{field}.pose"), &spec.pose)?;
        let load = self.file.load();
        let [x, y] = self.surface_axes(name, spec)?;
        let field = format!("{field}.pose.position");
        let at = NominalAt { pose, free: spec.free.clone(), lengths: None };
        let nominal = self.deflection(&field, &at)?;
        let (nominal_value, observer) = self.observer(&field, &at, &spec.free, &nominal)?;
        let (title, robot, output) = (&spec.title, &self.robot, self.file.output);
        Ok(Surface { name, title, robot, pose, load, x, y, output, nominal, nominal_value, observer })
    }

    /// The error model called `name`, of deviations from the robot file.
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for an unknown name, and for an operating point, which only the pose and load
    /// of a sampling determine.
    pub fn tolerances(&self, name: &str) -> Result<ErrorModel, StudyError> {
        let Some(model) = self.file.error_models.get(name) else {
            return Err(self.invalid("error_models", name, &keys(&self.file.error_models)));
        };
        if let Some((key, _)) = model.iter().find(|(_, spec)| spec.operating_point.is_some()) {
            let field = format!("error_models.{name}.{key}.operating_point");
            return Err(self.invalid(
                &field,
                "given",
                "an error model without one, as there is no pose and load of a sampling",
            ));
        }
        let errors = self.error_model(name, model, &[])?.0;
        if let Some((quantity, _)) = errors.weather_terms().next() {
            let field = format!("error_models.{name}.{}", quantity.name());
            let expected = "an error model without weather, in which only studies observe robots";
            return Err(self.invalid(&field, "given", expected));
        }
        Ok(errors)
    }

    /// An error model for this robot, at the operating point of these deflections of the nominal one.
    pub(crate) fn error_model(
        &self,
        name: &str,
        model: &IndexMap<String, InputSpec>,
        at: &[&Deflection],
    ) -> Result<(ErrorModel, Option<Moduli>), StudyError> {
        let field = format!("error_models.{name}");
        let wrong = |wrong| match wrong {
            Wrong::Field { field: below, value, expected } => {
                self.invalid(&format!("{field}.{below}"), value, &expected)
            }
            Wrong::Law(source) => self.statistics(field.clone(), source),
        };
        let (model, moduli) = resolved(model, &self.robot, at).map_err(wrong)?;
        let weather = self.weather()?;
        let found = ErrorModel::new(&model, &self.robot, Some(&weather)).map_err(wrong)?;
        self.check_weather_of(&field, &found)?;
        if found.inputs.is_empty() {
            return Err(self.invalid(&field, "empty", "at least one uncertain parameter"));
        }
        Ok((found, moduli))
    }

    pub(crate) fn surface_axes(
        &self,
        name: &str,
        spec: &SurfaceSpec,
    ) -> Result<[SurfaceAxis; 2], StudyError> {
        let axis = |letter, spec| self.axis(&format!("surfaces.{name}.{letter}"), spec);
        let axes = [axis('x', &spec.x)?, axis('y', &spec.y)?];
        let (x, y) = (spec.x.points, spec.y.points);
        if x * y > MOST_POINTS {
            let expected = format!("at most {MOST_POINTS} points, such as 1000 x 1000");
            return Err(self.invalid(&format!("surfaces.{name}"), format!("{x} x {y} points"), &expected));
        }
        Ok(axes)
    }

    fn axis(&self, field: &str, spec: &AxisSpec) -> Result<SurfaceAxis, StudyError> {
        let parameters = Parameter::of(&self.robot);
        let known =
            spec.parameter.parse().ok().and_then(|p| Some((p, parameters.iter().position(|q| *q == p)?)));
        let Some((parameter, index)) = known else {
            return Err(self.invalid(
                &format!("{field}.parameter"),
                &spec.parameter,
                "a parameter of the robot",
            ));
        };
        if !(spec.min.is_finite() && spec.max.is_finite() && spec.min < spec.max) {
            let range = format!("{} to {}", spec.min, spec.max);
            return Err(self.invalid(field, range, "finite deviations, min below max"));
        }
        if !(2..=MOST_OF_AXIS).contains(&spec.points) {
            let expected = format!("at least 2, at most {MOST_OF_AXIS}");
            return Err(self.invalid(&format!("{field}.points"), spec.points, &expected));
        }
        let last = (spec.points - 1) as f64;
        // The ends are weighted, so that no overflow of their distance matters and the last point is exactly
        // `max`.
        let point = |k: usize| spec.min * ((last - k as f64) / last) + spec.max * (k as f64 / last);
        Ok(SurfaceAxis { parameter, index, deviations: (0..spec.points).map(point).collect() })
    }

    /// The nominal robot at the pose of a surface or of a sampling by its name, without the preparation of
    /// observations.
    ///
    /// # Errors
    /// As [`Study::sampling`].
    pub fn nominal(&self, name: &str) -> Result<NominalPose, StudyError> {
        let (at, field) = match self.file.surfaces.get(name) {
            Some(spec) => {
                let field = format!("surfaces.{name}.pose");
                let pose = self.pose(&field, &spec.pose)?;
                let at = NominalAt { pose, free: spec.free.clone(), lengths: None };
                (at, format!("{field}.position"))
            }
            None => self.located(name).map(|found| (found.spec.at(found.pose), found.field))?,
        };
        Ok(NominalPose { pose: at.pose, deflection: self.deflection(&field, &at)? })
    }

    fn deflection(&self, field: &str, at: &NominalAt) -> Result<Deflection, StudyError> {
        let found = self.nominals.deflection(&self.robot, at, &self.file.load());
        found.map_err(|source| self.not_held(field, &at.pose, source))
    }

    /// What observes the output at a pose, and the output of the nominal robot.
    fn observer<'a>(
        &'a self,
        field: &str,
        at: &NominalAt,
        free: &'a [Coordinate],
        nominal: &Deflection,
    ) -> Result<(f64, OutputObserver<'a>), StudyError> {
        let (robot, load, output) = (&self.robot, self.file.load(), self.file.output);
        let (pose, is_kept) = (at.pose, at.lengths.is_some());
        let amplitude = self.file.amplitude.map(|spec| spec.at());
        let weather = self.weather()?;
        let of = Observing { robot, pose, load, output, amplitude, free, is_kept, weather };
        let found = OutputObserver::new(of, nominal).and_then(|found| Ok((found.nominal_value()?, found)));
        found.map_err(|source| self.not_held(field, &pose, source))
    }

    fn not_held(&self, field: &str, pose: &Pose, source: StaticsError) -> StudyError {
        StudyError::Nominal {
            path: self.path.clone(),
            field: field.to_owned(),
            value: format!("{:?}", pose.position.as_slice()),
            meant: plausible::position(&self.robot, field, &pose.position).map(|doubt| doubt.meant),
            source: Box::new(source),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn an_axis_ends_at_its_ends_however_far_apart_they_are() {
        let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json"));
        let study = Study::open(path).unwrap();
        for (min, max) in [(-0.3, 0.1), (f64::MIN, f64::MAX), (-5e-324, 5e-324)] {
            let spec = AxisSpec { parameter: "mass".to_owned(), min, max, points: 7 };
            let points = study.axis("x", &spec).unwrap().deviations;
            assert_eq!((points[0], points[6]), (min, max));
            assert!(points.is_sorted() && points.iter().all(|point| point.is_finite()), "{points:?}");
        }
    }
}
