//! Texts of numbers and names, for readers.

use cdpr_sensitivity::{Law, Steps};
use serde::Serialize;
use serde_json::Value;

/// The number with so many significant digits, without zeros at its end; powers of ten where it is very large or small.
pub(crate) fn digits(value: f64, digits: usize) -> String {
    let text = figures(value, digits);
    if !text.contains('.') {
        return text;
    }
    // The zeros stand before a power of ten, if there is one.
    let (mantissa, power) = text.split_at(text.find('\u{d7}').unwrap_or(text.len()));
    mantissa.trim_end_matches('0').trim_end_matches('.').to_owned() + power
}

/// The same with its zeros, for columns of numbers.
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

/// The number with so many decimals, with a true minus sign.
pub(crate) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.contains(|c: char| ('1'..='9').contains(&c)) => format!("\u{2212}{digits}"),
        Some(zero) => zero.to_owned(),
        None => text,
    }
}

fn superscript(exponent: i32) -> String {
    let raised = |c: char| match c {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        c => char::from_u32(0x2070 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
    };
    exponent.to_string().chars().map(raised).collect()
}

/// A point: `(0, 0, 1.75)`.
pub(crate) fn point(coordinates: &[f64]) -> String {
    let coordinates: Vec<String> = coordinates.iter().map(|value| digits(*value, 5)).collect();
    format!("({})", coordinates.join(", "))
}

/// A law in words, its parameters times `scale`.
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

/// Whether [`law`] scales the parameters of a law; shapes and logarithms have no unit to change.
pub(crate) fn is_scaled(law: &Law) -> bool {
    matches!(law, Law::Uniform { .. } | Law::Normal { .. })
}

/// Steps in words, times `scale`.
pub(crate) fn steps(steps: Option<&Steps>, scale: f64) -> String {
    match steps {
        None => "continuous".to_owned(),
        Some(Steps::Nearest { step }) => format!("{}, to the nearest level", digits(scale * step, 4)),
        Some(Steps::EqualMass { step }) => format!("{}, levels of equal mass", digits(scale * step, 4)),
    }
}

/// `{"beta": {"min": 1.0, ..}}` as `beta: min 1, ..`; a plain word as it is.
pub(crate) fn fields(value: &impl Serialize) -> String {
    let said = |value: &Value| match value {
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), |value| digits(value, 5)),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    match serde_json::to_value(value) {
        Ok(Value::Object(map)) => {
            let parts = map.iter().map(|(name, value)| match value {
                Value::Object(inner) => {
                    let inner: Vec<_> =
                        inner.iter().map(|(name, value)| format!("{name} {}", said(value))).collect();
                    format!("{}: {}", name.replace('_', " "), inner.join(", "))
                }
                value => format!("{name} {}", said(value)),
            });
            parts.collect::<Vec<_>>().join("; ")
        }
        Ok(value) => said(&value),
        Err(error) => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_say_something() {
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
    fn laws_are_said_in_words() {
        assert_eq!(law(&Law::Uniform { min: -1.8e10, max: 1.8e10 }, 1e-9), "uniform, \u{b1}18");
        assert_eq!(law(&Law::Uniform { min: 0.0, max: 0.5 }, 1.0), "uniform, 0 to 0.5");
        let triangular = Law::Triangular { min: 0.0, mode: 0.25, max: 1.0 };
        assert_eq!(law(&triangular, 1e3), "triangular: min 0, mode 0.25, max 1");
    }
}
