//! Names in files that carry the unit of the output: `magnitude_mm`, `mean_mm`, ... of deflections,
//! `frequency_hz`, `mean_hz`, ... of frequencies. Results are serialized under the names that deflections
//! have; here they take those of other outputs, and back.

use crate::file::output::Output;
use serde::ser::Error;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value};

/// The names that change, as deflections have them.
const NAMES: [&str; 13] = [
    "magnitude_mm",
    "signed_effects_mm",
    "nominal_mm",
    "mean_mm",
    "std_mm",
    "min_mm",
    "max_mm",
    "dominant_effect_mm",
    "signed_effect_mm",
    "morris_mean_absolute_mm",
    "morris_low_mm",
    "morris_high_mm",
    "morris_std_mm",
];

/// Where names are changed to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum To {
    /// Those of files.
    File,
    /// Those of deflections.
    Memory,
}

/// Serializes the results of the parts of a study under the names of files.
pub(crate) fn in_file<T: Serialize, S: Serializer>(studies: &T, serializer: S) -> Result<S::Ok, S::Error> {
    let mut studies = serde_json::to_value(studies).map_err(Error::custom)?;
    To::File.studies(&mut studies);
    studies.serialize(serializer)
}

impl To {
    fn name(self, output: Output, name: &str) -> String {
        let known = |known: &&&str| match self {
            Self::File => **known == name,
            Self::Memory => output.named(known) == name,
        };
        match (NAMES.iter().find(known), self) {
            (Some(known), Self::File) => output.named(known),
            (Some(known), Self::Memory) => (*known).to_owned(),
            (None, _) => name.to_owned(),
        }
    }

    /// Changes the names in results of the parts of a study; returns whether there is another output than
    /// deflections.
    pub(crate) fn studies(self, studies: &mut Value) -> bool {
        let mut other = false;
        let Some(studies) = studies.as_object_mut() else { return other };
        for study in studies.values_mut() {
            let output = study.get("output").and_then(|output| serde_json::from_value(output.clone()).ok());
            let (Some(output), Some(fields)) = (output, study.as_object_mut()) else { continue };
            other = true;
            self.fields(output, fields);
            let Some(sensitivity) = fields.get_mut("sensitivity") else { continue };
            for list in ["inputs", "groups"] {
                let measured = sensitivity.get_mut(list).and_then(Value::as_array_mut);
                for of in measured.into_iter().flatten().filter_map(Value::as_object_mut) {
                    self.fields(output, of);
                }
            }
            let measures = sensitivity.pointer_mut("/agreement/measures").and_then(Value::as_array_mut);
            for measure in measures.into_iter().flatten() {
                if let Value::String(name) = measure {
                    *name = self.name(output, name);
                }
            }
        }
        other
    }

    fn fields(self, output: Output, fields: &mut Map<String, Value>) {
        let named = std::mem::take(fields).into_iter();
        *fields = named.map(|(name, value)| (self.name(output, &name), value)).collect();
    }

    /// A table with other names in its header.
    pub(crate) fn table(self, output: Output, text: &str) -> String {
        let (header, rows) = text.split_once('\n').unwrap_or((text, ""));
        let names: Vec<_> = header.split(',').map(|name| self.name(output, name)).collect();
        format!("{}\n{rows}", names.join(","))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_every_output_are_found_again() {
        let platform = [Output::PlatformFrequency, Output::Amplitude];
        let others = [Output::Deflection, Output::Position, Output::Frequency, Output::Stiffness];
        for output in others.into_iter().chain(platform) {
            for name in NAMES.into_iter().chain(["title", "nominal", "displacement_mm"]) {
                let in_file = To::File.name(output, name);
                assert!(output != Output::Deflection || in_file == name);
                assert_eq!(To::Memory.name(output, &in_file), name, "{output}");
            }
        }
        assert_eq!(To::File.name(Output::Frequency, "mean_mm"), "mean_hz");
        assert_eq!(To::File.name(Output::Frequency, "magnitude_mm"), "frequency_hz");
    }
}
