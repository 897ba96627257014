//! Numbers, points, laws and steps as text.

use cdpr_robot::{Vector3, Wrench, decimal};
use cdpr_sensitivity::{Law, Steps};
use cdpr_statics::Load;
use serde::Serialize;
use serde_json::Value;

/// Number with this many significant digits, without zeros at its end. Very large and very small numbers have
/// a power of ten.
pub(crate) fn digits(value: f64, digits: usize) -> String {
    let text = figures(value, digits);
    if !text.contains('.') {
        return text;
    }
    // The zeros stand before the power of ten, if there is one.
    let (mantissa, power) = text.split_at(text.find('\u{d7}').unwrap_or(text.len()));
    mantissa.trim_end_matches('0').trim_end_matches('.').to_owned() + power
}

/// Number with this many significant digits, with zeros at its end, as columns of numbers need.
pub(crate) fn figures(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { value.to_string() };
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if !(-4..7).contains(&exponent) {
        let mantissa = mantissa.parse().unwrap_or(value);
        return format!("{}\u{d7}10{}", number(mantissa, digits.saturating_sub(1)), superscript(exponent));
    }
    number(value, usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0))
}

/// A text with a capital at its start.
pub(crate) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Number with this many decimals. It has a minus sign instead of a hyphen, and no negative zero.
pub(crate) fn number(value: f64, decimals: usize) -> String {
    decimal(value, decimals).replacen('-', "\u{2212}", 1)
}

/// Exponent in superscript digits.
pub(crate) fn superscript(exponent: i32) -> String {
    let raised = |c: char| match c {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        c => char::from_u32(0x2070 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
    };
    exponent.to_string().chars().map(raised).collect()
}

/// Coordinates of a point, as in `(0, 0, 1.75)`.
pub(crate) fn point(coordinates: &[f64]) -> String {
    let coordinates: Vec<String> = coordinates.iter().map(|value| digits(*value, 5)).collect();
    format!("({})", coordinates.join(", "))
}

/// The force and moment of a load that has them, as in `the force (0, 0, −10) N`.
pub(crate) fn wrench_words(load: &Load) -> Option<String> {
    let Wrench { force, moment } = load.wrench;
    let of = |name: &str, vector: Vector3<f64>, unit: &str| {
        (vector != Vector3::zeros()).then(|| format!("the {name} {} {unit}", point(vector.as_slice())))
    };
    let words: Vec<_> =
        [of("force", force, "N"), of("moment", moment, "N m")].into_iter().flatten().collect();
    (!words.is_empty()).then(|| words.join(" and "))
}

/// Displacements below a nanometre are rounding errors of two equilibria [mm].
const ROUNDING_MM: f64 = 1e-6;

/// A displacement [mm], zero where it is a rounding error.
pub(crate) fn beyond_rounding(millimetres: f64) -> f64 {
    if millimetres.abs() < ROUNDING_MM { 0.0 } else { millimetres }
}

/// What a load is called: a payload, a force or a moment where it is nothing else.
pub(crate) fn load_word(load: &Load) -> &'static str {
    let Wrench { force, moment } = load.wrench;
    match (load.payload > 0.0, force != Vector3::zeros(), moment != Vector3::zeros()) {
        (true, false, false) => "payload",
        (false, true, false) => "force",
        (false, false, true) => "moment",
        _ => "load",
    }
}

/// A load in words, as in `50 kg and the force (0, 0, −10) N`; `its own weight` without one.
pub(crate) fn load_words(load: &Load) -> String {
    let payload = (load.payload > 0.0).then(|| format!("{} kg", load.payload));
    let words: Vec<String> = [payload, wrench_words(load)].into_iter().flatten().collect();
    if words.is_empty() { "its own weight".to_owned() } else { words.join(" and ") }
}

/// Law in words. Its parameters are multiplied by `scale`.
pub(crate) fn law(law: &Law, scale: f64) -> String {
    match *law {
        Law::Uniform { min, max } if min == -max => format!("uniform, \u{b1}{}", digits(scale * max, 4)),
        Law::Uniform { min, max } => {
            format!("uniform, {} to {}", digits(scale * min, 4), digits(scale * max, 4))
        }
        Law::Normal { mean, std } => {
            format!("normal, mean {}, standard deviation {}", digits(scale * mean, 4), digits(scale * std, 4))
        }
        _ => fields(law),
    }
}

/// Whether [`law`] multiplies the parameters of a law. Shapes and logarithms have no unit that could be
/// changed.
pub(crate) fn is_scaled(law: &Law) -> bool {
    matches!(law, Law::Uniform { .. } | Law::Normal { .. })
}

/// Steps in words. They are multiplied by `scale`.
pub(crate) fn steps(steps: Option<&Steps>, scale: f64) -> String {
    match steps {
        None => "continuous".to_owned(),
        Some(Steps::Nearest { step }) => format!("{}, to the nearest level", digits(scale * step, 4)),
        Some(Steps::EqualMass { step }) => format!("{}, levels of equal mass", digits(scale * step, 4)),
    }
}

/// Fields of a value in words: `{"beta": {"min": 1.0, ..}}` becomes `beta: min 1, ..`, and a plain word
/// stays.
pub(crate) fn fields(value: &impl Serialize) -> String {
    let text_of = |value: &Value| match value {
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), |value| digits(value, 5)),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    match serde_json::to_value(value) {
        Ok(Value::Object(map)) => {
            let parts = map.iter().map(|(name, value)| match value {
                Value::Object(inner) => {
                    let inner: Vec<_> =
                        inner.iter().map(|(name, value)| format!("{name} {}", text_of(value))).collect();
                    format!("{}: {}", name.replace('_', " "), inner.join(", "))
                }
                value => format!("{name} {}", text_of(value)),
            });
            parts.collect::<Vec<_>>().join("; ")
        }
        Ok(value) => text_of(&value),
        Err(error) => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_errors_are_no_displacement() {
        assert_eq!([3e-13, -4e-7, 0.0].map(beyond_rounding), [0.0; 3]);
        assert_eq!([2e-6, -0.5].map(beyond_rounding), [2e-6, -0.5]);
    }

    #[test]
    fn a_load_has_the_words_of_its_parts() {
        let of = |payload, force: [f64; 3], moment: [f64; 3]| Load {
            payload,
            wrench: Wrench { force: force.into(), moment: moment.into() },
        };
        let (none, down) = ([0.0; 3], [0.0, 0.0, -10.0]);
        for (load, word, words) in [
            (of(50.0, none, none), "payload", "50 kg"),
            (of(0.0, down, none), "force", "the force (0, 0, \u{2212}10) N"),
            (of(0.0, none, down), "moment", "the moment (0, 0, \u{2212}10) N m"),
            (of(5.0, down, none), "load", "5 kg and the force (0, 0, \u{2212}10) N"),
            (of(0.0, none, none), "load", "its own weight"),
        ] {
            assert_eq!((load_word(&load), load_words(&load).as_str()), (word, words));
        }
    }

    #[test]
    fn numbers_have_significant_digits_only() {
        let cases =
            [(0.0, "0"), (1.33125, "1.331"), (-0.015, "\u{2212}0.015"), (102.2, "102.2"), (730.0, "730")];
        for (value, text) in cases {
            assert_eq!(digits(value, 4), text);
        }
        assert_eq!(digits(12_345.6, 3), "12346");
        assert_eq!((figures(1.13, 4), figures(0.0, 4)), ("1.130".to_owned(), "0".to_owned()));
        assert_eq!(digits(f64::NAN, 3), "NaN");
        assert_eq!(digits(1.022e11, 4), "1.022\u{d7}10\u{b9}\u{b9}");
        assert_eq!(digits(-3e-5, 3), "\u{2212}3\u{d7}10\u{207b}\u{2075}");
    }

    #[test]
    fn laws_are_written_in_words() {
        assert_eq!(law(&Law::Uniform { min: -1.8e10, max: 1.8e10 }, 1e-9), "uniform, \u{b1}18");
        assert_eq!(law(&Law::Uniform { min: 0.0, max: 0.5 }, 1.0), "uniform, 0 to 0.5");
        let triangular = Law::Triangular { min: 0.0, mode: 0.25, max: 1.0 };
        assert_eq!(law(&triangular, 1e3), "triangular: min 0, mode 0.25, max 1");
    }
}
