//! What an output is to satisfy.

use crate::program::arguments::number;
use cdpr_study::{Output, OutputLimit};

/// Name of the position error, the same in limits and in tables.
pub(crate) const POSITION: &str = Output::Position.name();

/// A column and its limit, such as `magnitude_mm<1.4`: the name of the column states the unit.
pub(crate) fn limit(text: &str) -> Result<(String, OutputLimit), String> {
    let expected = || "expected COLUMN<VALUE, with <, <=, > or >=".to_owned();
    let at = text.find(['<', '>']).filter(|at| *at > 0).ok_or_else(expected)?;
    let (column, rest) = text.split_at(at);
    type Of = fn(f64) -> OutputLimit;
    let relations: [(&str, Of); 4] = [
        ("<=", OutputLimit::AtMost),
        (">=", OutputLimit::AtLeast),
        ("<", OutputLimit::Below),
        (">", OutputLimit::Above),
    ];
    let found = relations.into_iter().find_map(|(sign, of)| Some((rest.strip_prefix(sign)?, of)));
    let (value, of) = found.ok_or_else(expected)?;
    Ok((column.trim().to_owned(), of(number(value)?)))
}

/// The least upper limit of a quantity that has one of these names [the unit of the name].
pub(crate) fn upper<'a>(
    (column, limit): &(String, OutputLimit),
    names: &[&'a str],
) -> Result<(&'a str, f64), String> {
    let expected = || format!("--limit {column}: expected {} < a number", names.join(" or "));
    let name = names.iter().find(|name| **name == column.as_str()).ok_or_else(expected)?;
    match limit {
        OutputLimit::Below(value) | OutputLimit::AtMost(value) => Ok((name, *value)),
        OutputLimit::Above(_) | OutputLimit::AtLeast(_) => Err(expected()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_a_column_a_sign_and_a_number() {
        assert_eq!(limit("magnitude_mm<1.4").unwrap(), ("magnitude_mm".to_owned(), OutputLimit::Below(1.4)));
        assert_eq!(limit("f >= -2e3").unwrap(), ("f".to_owned(), OutputLimit::AtLeast(-2e3)));
        for text in ["", "magnitude", "<1", "magnitude<", "magnitude<x", "magnitude=1"] {
            assert!(limit(text).is_err(), "{text}");
        }
        let names = ["deflection_mm", "position_error_mm"];
        assert_eq!(
            upper(&limit("position_error_mm <= 0.9").unwrap(), &names),
            Ok(("position_error_mm", 0.9))
        );
        for text in ["position<1", "position_error_mm>1"] {
            let refused = upper(&limit(text).unwrap(), &names).unwrap_err();
            assert!(refused.contains("expected deflection_mm or position_error_mm < a number"), "{refused}");
        }
    }
}
