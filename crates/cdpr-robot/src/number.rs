//! Numbers for people.

/// A number rounded to so many decimals, and never a negative zero.
pub fn rounded(value: f64, decimals: i32) -> f64 {
    let scale = 10.0_f64.powi(decimals);
    (scale * value).round() / scale + 0.0
}

/// The text of a number with so many decimals, without the sign of a zero.
pub fn decimal(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    match text.strip_prefix('-') {
        Some(zero) if !zero.contains(|c: char| ('1'..='9').contains(&c)) => zero.to_owned(),
        _ => text,
    }
}

/// The text of a number with this many significant digits, such as `1.206`; below 1e-4 and from 1e7 on with an
/// exponent.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { value.to_string() };
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match exponent {
        Some(exponent) if (-4..7).contains(&exponent) => {
            format!("{value:.*}", usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0))
        }
        _ => scientific,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_are_those_of_the_rounded_number() {
        let cases = [
            (0.0, "0"),
            (1.33125, "1.331"),
            (-12345.6, "-12346"),
            (9.9999e6, "1.000e7"),
            (1.2e-9, "1.200e-9"),
            (0.99999, "1.000"),
            (f64::INFINITY, "inf"),
        ];
        for (value, text) in cases {
            assert_eq!(significant(value, 4), text);
        }
    }
}
