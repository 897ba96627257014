//! The weather of a study, checked with its robot, its output and its error models.

use crate::error::StudyError;
use crate::file::study_file::{InputSpec, SamplingSpec};
use crate::file::weather::{NominalWeather, WeatherQuantity};
use crate::model::error_model::ErrorModel;
use crate::model::study::Study;
use cdpr_statics::StaticsError;
use indexmap::IndexMap;

impl Study {
    /// The weather of all observations, before any of its numbers deviate.
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for the first wrong field.
    pub(crate) fn weather(&self) -> Result<NominalWeather, StudyError> {
        let spec = self.file.weather.clone().unwrap_or_default();
        NominalWeather::new(&spec, &self.robot).map_err(|error| match error {
            StaticsError::Invalid { field, value, expected } if field.starts_with("cables") => {
                self.invalid(&format!("{field} of the robot"), value, &expected)
            }
            StaticsError::Invalid { field, value, expected } => {
                self.invalid(&format!("weather.{field}"), value, &expected)
            }
            source => self.invalid("weather", "given", &source.to_string()),
        })
    }

    /// Whether the weather moves the platform in all parts, be it that of the study or that of their error
    /// models.
    pub(crate) fn is_in_weather(&self) -> Result<bool, StudyError> {
        let file = &self.file;
        let deviates = |spec: &SamplingSpec| {
            let model = file.error_models.get(&spec.error_model);
            model.is_some_and(|model| quantities(model).next().is_some())
        };
        let all = file.surfaces.is_empty() && file.samplings.values().all(deviates);
        Ok(all || !self.weather()?.is_nothing())
    }

    /// The output and the robot have this weather, and a temperature has an expansion by which it acts.
    pub(crate) fn check_weather(&self) -> Result<(), StudyError> {
        let (weather, output) = (self.weather()?, self.file.output);
        if weather.is_nothing() {
            let mut deviating = self.file.error_models.values().flat_map(quantities);
            if weather.expands() && !deviating.any(|quantity| quantity == WeatherQuantity::Warmer) {
                let expected = "a difference of temperature together with the expansion of cables, frame or \
                                both, in `weather` or as an uncertain input";
                return Err(self.invalid("weather.warmer", 0.0, expected));
            }
            return Ok(());
        }
        if !output.is_length() {
            let expected = "output deflection or position, or a study without weather: other outputs are not \
                            observed in it";
            return Err(self.invalid("weather", format!("given with output {output}"), expected));
        }
        let blows = weather.numbers[WeatherQuantity::WindSpeed as usize] > 0.0;
        if blows { self.check_diameters("weather", WeatherQuantity::WindSpeed) } else { Ok(()) }
    }

    /// The same for the numbers of the weather that an error model has.
    pub(crate) fn check_weather_of(&self, field: &str, errors: &ErrorModel) -> Result<(), StudyError> {
        for (quantity, term) in errors.weather_terms() {
            let field = format!("{field}.{}", errors.entries[term.input]);
            if !self.file.output.is_length() {
                let expected = "output deflection or position: others are not observed in weather";
                return Err(self.invalid(
                    &field,
                    format!("given with output {}", self.file.output),
                    expected,
                ));
            }
            if quantity.needs_diameter() {
                self.check_diameters(&field, quantity)?;
            }
        }
        // A base that is tilted by its gravity has no heights along z.
        let profiled = self.file.weather.as_ref().is_some_and(|spec| spec.wind_profile.is_some());
        let tilts = |entry: &&String| entry.starts_with("gravity") && *entry != "gravity.z";
        if let Some(entry) = errors.entries.iter().find(tilts).filter(|_| profiled) {
            let expected = "no `wind_profile` with an uncertain direction of gravity, which tilts the base: \
                            gravity.z alone, or a wind that is the same everywhere";
            return Err(self.invalid(&format!("{field}.{entry}"), "given", expected));
        }
        Ok(())
    }

    fn check_diameters(&self, field: &str, of: WeatherQuantity) -> Result<(), StudyError> {
        let bare = self.robot.cables.iter().position(|cable| cable.properties.diameter.is_none());
        let Some(i) = bare else { return Ok(()) };
        let expected = format!(
            "a robot whose cables have a `diameter` [m], on which {} acts: cable {} has none",
            of.name(),
            i + 1
        );
        Err(self.invalid(field, of.name(), &expected))
    }
}

/// The numbers of the weather that deviate in an error model of a study file.
fn quantities(model: &IndexMap<String, InputSpec>) -> impl Iterator<Item = WeatherQuantity> {
    let named =
        model.iter().flat_map(|(key, spec)| spec.parameters.iter().flat_map(|of| of.keys()).chain([key]));
    named.filter_map(|name| WeatherQuantity::named(name))
}
