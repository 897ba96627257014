//! Numbers for people.

/// A number rounded to so many decimals, and never a negative zero.
pub fn rounded(value: f64, decimals: i32) -> f64 {
    let scale = 10.0_f64.powi(decimals);
    (scale * value).round() / scale + 0.0
}

/// The text of a number with this number of decimals, without the sign of a zero.
pub fn decimal(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    match text.strip_prefix('-') {
        Some(zero) if !zero.contains(|c: char| ('1'..='9').contains(&c)) => zero.to_owned(),
        _ => text,
    }
}

/// The text of a number with this many significant digits, such as `1.206`; below 1e-4 and from 1e7 on with
/// an exponent.
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

/// The text of a number with so many decimals; with 3 significant digits where the decimals would leave it
/// hardly any, as of a robot of centimetres and grams.
pub fn visible(number: f64, decimals: usize) -> String {
    let digits = decimals.clamp(2, 3) as i32;
    let least = 10.0_f64.powi(digits - 1 - decimals as i32);
    if number.abs() < least && number != 0.0 { significant(number, 3) } else { decimal(number, decimals) }
}

/// Decimals for the numbers of a column: the usual ones, more where the greatest magnitude would have fewer
/// than 3 significant digits. What is far below the greatest stays a zero.
pub fn decimals_of(numbers: impl IntoIterator<Item = f64>, usual: usize) -> usize {
    let greatest = numbers.into_iter().map(f64::abs).filter(|size| size.is_finite()).fold(0.0, f64::max);
    if greatest > 0.0 { usual.max((2.0 - greatest.log10().floor()).clamp(0.0, 15.0) as usize) } else { usual }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_do_not_hide_small_numbers() {
        for (number, decimals, text) in [
            (29.2654, 3, "29.265"),
            (0.5, 3, "0.500"),
            (0.0325, 3, "0.0325"),
            (-4.5e-6, 3, "-4.50e-6"),
            (0.0, 3, "0.000"),
            (3.26, 1, "3.3"),
            (0.0326, 1, "0.0326"),
        ] {
            assert_eq!(visible(number, decimals), text);
        }
        assert_eq!(decimals_of([900.0, 1e-12], 3), 3);
        assert_eq!(decimals_of([0.0325, -0.001, f64::NAN], 3), 4);
        assert_eq!((decimals_of([0.0], 3), decimals_of([1e-300], 3)), (3, 15));
    }

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
