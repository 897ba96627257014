//! How numbers are printed in messages.

/// A number with six significant digits: `15000.8`, `-2.2`, `1e308`. Integers below 1e9 keep all theirs.
pub fn short(number: f64) -> String {
    if !number.is_finite() || number.fract() == 0.0 && number.abs() < 1e9 {
        return (number + 0.0).to_string();
    }
    let scientific = format!("{number:.5e}");
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let trimmed = |text: &str| text.trim_end_matches('0').trim_end_matches('.').to_owned();
    match exponent.parse::<i32>() {
        Ok(exponent @ -4..=5) => trimmed(&format!("{number:.*}", (5 - exponent) as usize)),
        _ => format!("{}e{exponent}", trimmed(mantissa)),
    }
}

/// A text in which long numbers are [`short`]; integers that a user may have typed stay.
pub fn shortened(text: &str) -> String {
    const LONG: usize = 10;
    // A number next to a whole one, such as 0.9999999999, would look as if it were that one.
    let is_near_whole = |value: f64| {
        let is_whole = |text: String| text.parse::<f64>().is_ok_and(|near| near.fract() == 0.0);
        value.fract() != 0.0 && value.abs() < 1e5 && is_whole(short(value))
    };
    let is_integer = |number: &str| number.len() <= 20 && !number.contains(['.', 'e']);
    let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | '-' | '+');
    let mut found = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(is_of_number) {
        let (before, from) = rest.split_at(start);
        let (number, behind) = from.split_at(from.find(|c| !is_of_number(c)).unwrap_or(from.len()));
        let is_word = before.ends_with(char::is_alphanumeric) || behind.starts_with(char::is_alphanumeric);
        found.push_str(before);
        match number.parse::<f64>() {
            Ok(value) if number.len() > LONG && !is_word && !is_integer(number) && !is_near_whole(value) => {
                found.push_str(&short(value));
            }
            _ => found.push_str(number),
        }
        rest = behind;
    }
    found + rest
}

/// A count with its noun: `1 iteration`, `2 iterations`.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_are_printed_and_no_more() {
        for (number, text) in [
            (15000.762518559593, "15000.8"),
            (-2.1999999999999997, "-2.2"),
            (f64::MAX, "1.79769e308"),
            (1e-7, "1e-7"),
            (0.00012345678, "0.000123457"),
            (999999.7, "1e6"),
            (1e30, "1e30"),
            (10290.0, "10290"),
            (123456789.0, "123456789"),
            (-0.0, "0"),
            (0.1 + 0.2, "0.3"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(short(number), text);
        }
    }

    #[test]
    fn long_numbers_within_a_text_are_short_and_the_rest_stays() {
        for (text, expected) in [
            ("(-2.98, -2.1999999999999997, 1.2) m", "(-2.98, -2.2, 1.2) m"),
            ("15000.762518559593 N", "15000.8 N"),
            ("results-2024-01-01-and-more", "results-2024-01-01-and-more"),
            ("id123456789.0123x", "id123456789.0123x"),
            ("18446744073709551615", "18446744073709551615"),
            ("0.9999999999999999", "0.9999999999999999"),
            ("", ""),
            ("1.5, e - + .", "1.5, e - + ."),
        ] {
            assert_eq!(shortened(text), expected);
        }
        assert_eq!(shortened(&format!("{:.0}", f64::MAX)), "1.79769e308");
        assert_eq!([counted(1, "iteration"), counted(0, "iteration")], ["1 iteration", "0 iterations"]);
    }
}
