//! Young's modulus at the operating point: the secant modulus of the cables' law between the tensions under
//! own weight and with the load.
//!
//! Tensions differ from cable to cable, and a law differs between loading and unloading. With E_i the modulus
//! of cable i in the robot file, the deviation from it lies between
//!
//! ```text
//! min over i and both ways of E_i(T_own weight .. T_load) - E_i     and the greatest of these,
//! ```
//!
//! where E_i(..) is the secant modulus between the two tensions, for unloading at the same tensions. The
//! uniform law of an entry, which stands for the measurement, is added to both ends.

use crate::file::study_file::InputSpec;
use crate::model::error_model::Wrong;
use cdpr_robot::Robot;
use cdpr_sensitivity::Law;
use cdpr_statics::Deflection;
use cdpr_statics::hysteresis::Unloading;
use indexmap::IndexMap;

/// Least and greatest secant modulus of all cables [Pa].
pub(crate) type Moduli = [f64; 2];

/// The error model with all deviations relative to the robot file, and the moduli at the operating point if
/// an entry asks for them. Without a deflection of the nominal robot the entries are only checked.
pub(crate) fn resolved(
    model: &IndexMap<String, InputSpec>,
    robot: &Robot,
    at: &[&Deflection],
) -> Result<(IndexMap<String, InputSpec>, Option<Moduli>), Wrong> {
    let (mut model, mut found) = (model.clone(), None);
    for (key, spec) in &mut model {
        let Some(law) = &spec.operating_point else { continue };
        let wrong = |value: &str, expected| Wrong::field(format!("{key}.operating_point"), value, expected);
        if key != "youngs_modulus" || spec.parameters.is_some() {
            return Err(wrong("given", "an operating point of `youngs_modulus` alone"));
        }
        if !robot.is_linear() {
            return Err(wrong(
                "given",
                "a robot with linear cables: others have the modulus of their tension in the model",
            ));
        }
        if let Some((field, value, expected)) = law.invalid() {
            return Err(Wrong::field(format!("{key}.operating_point.{field}"), value, expected));
        }
        let Law::Uniform { min, max } = spec.law else {
            let expected = "a uniform law, which a range of moduli can widen";
            return Err(Wrong::field(format!("{key}.law"), format!("{:?}", spec.law), expected));
        };
        let range = |range: [f64; 2], value: f64| [range[0].min(value), range[1].max(value)];
        let nothing = [f64::INFINITY, f64::NEG_INFINITY];
        let (mut moduli, mut deviations) = (nothing, nothing);
        for (i, cable) in robot.cables.iter().enumerate() {
            let nominal = cable.properties.youngs_modulus;
            let curves = law.curves(&cable.properties, Unloading::SameTension).map_err(|error| {
                wrong(&error.to_string(), "a law in some proportion to the robot's modulus")
            })?;
            for deflection in at {
                let [from, to] = [&deflection.unloaded, &deflection.loaded]
                    .map(|solution| solution.equilibrium.cable_forces[i].norm());
                for curve in [&curves.loading, &curves.unloading] {
                    let modulus = nominal * curve.secant_ratio(from, to);
                    (moduli, deviations) = (range(moduli, modulus), range(deviations, modulus - nominal));
                }
            }
        }
        if !at.is_empty() {
            spec.law = Law::Uniform { min: min + deviations[0], max: max + deviations[1] };
            found = Some(moduli);
        }
    }
    Ok((model, found))
}
