//! What a robot is made of, from the arguments of its constructor.

use crate::convert::{Answer, Array, Numbers, Raised, components};
use cdpr_robot::{CableEnd, Gravity, OwnLimits, Plane, TensionLimits, TensionReference, Vector3};
use pyo3::types::PyAnyMethods;

/// The plane of this name.
pub(super) fn plane_of(name: &str) -> Answer<Plane> {
    match name {
        "xy" => Ok(Plane::Xy),
        "xz" => Ok(Plane::Xz),
        "yz" => Ok(Plane::Yz),
        _ => Err(Raised::Input(format!("plane is {name:?}: expected \"xy\", \"xz\" or \"yz\""))),
    }
}

/// The end of this name.
pub(super) fn end_of(name: &str) -> Answer<CableEnd> {
    match name {
        "anchor" => Ok(CableEnd::Anchor),
        "exit" => Ok(CableEnd::Exit),
        _ => Err(Raised::Input(format!("max_at is {name:?}: expected \"anchor\" or \"exit\""))),
    }
}

/// Points, one in each row.
pub(super) fn points(name: &str, array: &Numbers) -> Answer<Vec<Vector3<f64>>> {
    let Array { shape, values } = Array::new(name, array)?;
    if !matches!(shape[..], [_, 3]) {
        return Err(Raised::Input(format!(
            "{name} has the shape {shape:?}: expected (n, 3), one point for each cable"
        )));
    }
    Ok(values.chunks_exact(3).map(Vector3::from_column_slice).collect())
}

/// Limits of all cables, and those that differ from them: of one row, or of one row for each cable.
pub(super) fn limits(array: &Numbers, cables: usize) -> Answer<(TensionLimits, Vec<OwnLimits>)> {
    const NAME: &str = "tension_limits";
    let Array { shape, values } = Array::new(NAME, array)?;
    if shape.len() < 2 {
        let [min, max] = components(NAME, array)?;
        return Ok((TensionLimits { min, max }, vec![OwnLimits::default(); cables]));
    }
    if shape != [cables, 2] {
        return Err(Raised::Input(format!(
            "{NAME} has the shape {shape:?}: expected (2,), or ({cables}, 2), one row for each cable"
        )));
    }
    let shared = TensionLimits { min: values[0], max: values[1] };
    let own = values.chunks_exact(2).map(|row| OwnLimits {
        min: Some(row[0]).filter(|min| *min != shared.min),
        max: Some(row[1]).filter(|max| *max != shared.max),
        max_at: None,
    });
    Ok((shared, own.collect()))
}

pub(super) fn reference(given: &Numbers) -> Answer<TensionReference> {
    if let Ok(word) = given.extract::<String>() {
        return Ok(word.parse()?);
    }
    let Array { shape, values } = Array::new("tension_reference", given)?;
    match shape[..] {
        [] => Ok(TensionReference::All(values[0])),
        [_] => Ok(TensionReference::Each(values)),
        _ => Err(Raised::Input(format!(
            "tension_reference has the shape {shape:?}: expected a number, or one for each cable"
        ))),
    }
}

/// Gravity on Earth [m/s²].
pub(super) const EARTH: f64 = 9.81;

/// Gravity as a number or a vector.
pub(super) fn gravity(given: &Numbers) -> Answer<Gravity> {
    let Array { shape, values } = Array::new("gravity", given)?;
    match (&shape[..], &values[..]) {
        ([], [number]) => Ok((*number).into()),
        ([_], [x, y, z]) => Ok(Vector3::new(*x, *y, *z).into()),
        _ => {
            let expected = "a number along -z, or a vector of three numbers";
            Err(Raised::Input(format!("gravity has the shape {shape:?}: expected {expected}")))
        }
    }
}

/// A number for each cable.
pub(super) fn of_cables(name: &str, array: &Numbers, cables: usize) -> Answer<Vec<f64>> {
    let Array { shape, values } = Array::new(name, array)?;
    match shape[..] {
        [] => Ok(vec![values[0]; cables]),
        [count] if count == cables => Ok(values),
        _ => Err(Raised::Input(format!(
            "{name} has the shape {shape:?}: expected a number, or one for each of the {cables} cables"
        ))),
    }
}
