//! Arrays in and out: one case, or one case a row.

use crate::error::{Answer, Raised};
use cdpr_robot::{Pose, Vector3, Wrench};
use cdpr_statics::{Load, StaticsError};
use numpy::{
    AllowTypeChange, Element, IxDyn, PyArray1, PyArrayLikeDyn, PyArrayMethods, PyUntypedArrayMethods,
};
use pyo3::prelude::*;

/// Anything that NumPy makes an array of numbers of.
pub(crate) type Numbers<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

/// An argument: a row of numbers for all cases, or one for each.
pub(crate) struct Rows {
    name: &'static str,
    values: Vec<f64>,
    width: usize,
    /// `None` for one row, without an axis of cases.
    count: Option<usize>,
}

/// How many cases there are.
#[derive(Clone, Copy)]
pub(crate) struct Cases {
    pub(crate) count: usize,
    /// Whether no argument has an axis of cases: then neither has the answer.
    pub(crate) single: bool,
}

impl Rows {
    /// Rows of numbers, one row (`dimensions` axes in all) or one for each case (an axis more).
    fn new(name: &'static str, array: &Numbers, dimensions: usize, expected: &str) -> Answer<Self> {
        let shape = array.shape();
        let values = array.as_array().iter().copied().collect();
        let width = shape.last().copied().unwrap_or(1);
        match shape.len() {
            d if d == dimensions => {
                Ok(Self { name, values, width: if dimensions == 0 { 1 } else { width }, count: None })
            }
            d if d == dimensions + 1 => Ok(Self {
                name,
                values,
                width: if dimensions == 0 { 1 } else { width },
                count: Some(shape[0]),
            }),
            _ => Err(Raised::Input(format!("{name} has the shape {shape:?}: expected {expected}"))),
        }
    }

    /// Vectors of any number of components.
    pub(crate) fn vectors(name: &'static str, array: &Numbers) -> Answer<Self> {
        Self::new(name, array, 1, "a row of numbers, or one row for each case")
    }

    /// Vectors of `N` components; zeros where none are given.
    pub(crate) fn components<const N: usize>(name: &'static str, array: Option<&Numbers>) -> Answer<Self> {
        let Some(array) = array else {
            return Ok(Self { name, values: vec![0.0; N], width: N, count: None });
        };
        let rows = Self::vectors(name, array)?;
        if rows.width == N {
            Ok(rows)
        } else {
            Err(Raised::Input(format!("{name} has {} numbers a row: expected {N}", rows.width)))
        }
    }

    /// Poses: x, y, z [m], or x, y, z, qw, qx, qy, qz.
    pub(crate) fn poses(name: &'static str, array: &Numbers) -> Answer<Self> {
        let rows = Self::vectors(name, array)?;
        if matches!(rows.width, 3 | 7) {
            Ok(rows)
        } else {
            let width = rows.width;
            Err(Raised::Input(format!(
                "{name} has {width} numbers a row: expected x,y,z [m] or x,y,z,qw,qx,qy,qz"
            )))
        }
    }

    /// Numbers, one or one for each case.
    pub(crate) fn scalars(name: &'static str, array: &Numbers) -> Answer<Self> {
        Self::new(name, array, 0, "a number, or one for each case")
    }

    /// A number for all cases.
    pub(crate) fn constant(name: &'static str, value: f64) -> Self {
        Self { name, values: vec![value], width: 1, count: None }
    }

    /// Numbers a row.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    /// All rows, one after the other.
    pub(crate) fn all(&self) -> &[f64] {
        &self.values
    }

    /// The row of a case.
    pub(crate) fn row(&self, case: usize) -> &[f64] {
        let case = if self.count.is_some() { case } else { 0 };
        &self.values[case * self.width..(case + 1) * self.width]
    }

    /// The number of a case.
    pub(crate) fn scalar(&self, case: usize) -> f64 {
        self.row(case)[0]
    }

    /// The pose of a case.
    pub(crate) fn pose(&self, case: usize) -> Result<Pose, StaticsError> {
        let row = self.row(case);
        let position = Vector3::new(row[0], row[1], row[2]);
        // The quaternion of no rotation makes the very matrix of `Pose::at`.
        let quaternion = if let [_, _, _, w, i, j, k] = *row { [w, i, j, k] } else { [1.0, 0.0, 0.0, 0.0] };
        Pose::with_quaternion(position, quaternion).ok_or_else(|| StaticsError::Invalid {
            field: self.name.to_owned(),
            value: format!("{row:?}"),
            expected: "finite numbers, and a quaternion that can be normalised".to_owned(),
        })
    }

    /// The vector of a case, of as many components as were asked for.
    pub(crate) fn vector<const N: usize>(&self, case: usize) -> [f64; N] {
        let row = self.row(case);
        std::array::from_fn(|k| row[k])
    }
}

impl Cases {
    /// As many as the arguments have.
    pub(crate) fn of(arguments: &[&Rows]) -> Answer<Self> {
        let mut counts = arguments.iter().filter_map(|rows| Some((rows.name, rows.count?)));
        let Some((name, count)) = counts.next() else { return Ok(Self { count: 1, single: true }) };
        match counts.find(|(_, other)| *other != count) {
            None => Ok(Self { count, single: false }),
            Some((other, rows)) => Err(Raised::Input(format!(
                "{other} has {rows} rows: expected one for all cases, or {count} as {name}"
            ))),
        }
    }
}

/// What acts on the platform besides its own weight.
pub(crate) struct Loads {
    pub(crate) force: Rows,
    pub(crate) moment: Rows,
    pub(crate) payload: Rows,
}

impl Loads {
    pub(crate) fn new(
        force: Option<&Numbers>,
        moment: Option<&Numbers>,
        payload: Option<&Numbers>,
    ) -> Answer<Self> {
        let force = Rows::components::<3>("force", force)?;
        let moment = Rows::components::<3>("moment", moment)?;
        let payload = match payload {
            Some(payload) => Rows::scalars("payload", payload)?,
            None => Rows::constant("payload", 0.0),
        };
        match payload.values.iter().find(|mass| **mass < 0.0) {
            None => Ok(Self { force, moment, payload }),
            Some(mass) => {
                Err(Raised::Input(format!("payload is {mass}: expected a mass, zero or more [kg]")))
            }
        }
    }

    pub(crate) fn rows(&self) -> [&Rows; 3] {
        [&self.force, &self.moment, &self.payload]
    }

    pub(crate) fn load(&self, case: usize) -> Load {
        let wrench = Wrench {
            force: self.force.vector::<3>(case).into(),
            moment: self.moment.vector::<3>(case).into(),
        };
        Load { payload: self.payload.scalar(case), wrench }
    }
}

/// The answers to all cases, `None` where there is none.
pub(crate) struct Columns<'py, 'a, T> {
    py: Python<'py>,
    single: bool,
    rows: Vec<Option<&'a T>>,
}

impl<'py, 'a, T> Columns<'py, 'a, T> {
    /// Of the outcomes of all cases. A single case without an answer raises.
    pub(crate) fn new<E>(py: Python<'py>, cases: Cases, outcomes: &'a [Result<T, E>]) -> Answer<Self>
    where
        Raised: From<&'a E>,
    {
        if cases.single
            && let Some(Err(error)) = outcomes.first()
        {
            return Err(error.into());
        }
        Ok(Self { py, single: cases.single, rows: outcomes.iter().map(|row| row.as_ref().ok()).collect() })
    }

    /// What `part` is of each answer.
    pub(crate) fn part<U>(&self, part: impl Fn(&'a T) -> &'a U) -> Columns<'py, 'a, U> {
        let rows = self.rows.iter().map(|row| row.map(&part)).collect();
        Columns { py: self.py, single: self.single, rows }
    }

    /// An array of numbers of the shape `inner` for each case, NaN where there is no answer; a number where both axes are missing.
    pub(crate) fn numbers(&self, inner: &[usize], fill: impl Fn(&T, &mut [f64])) -> PyResult<Py<PyAny>> {
        self.array(f64::NAN, inner, fill)
    }

    /// The same of one number each.
    pub(crate) fn number(&self, value: impl Fn(&T) -> f64) -> PyResult<Py<PyAny>> {
        self.numbers(&[], |row, out| out[0] = value(row))
    }

    /// The same of a vector each.
    pub(crate) fn vector<const N: usize>(&self, value: impl Fn(&T) -> [f64; N]) -> PyResult<Py<PyAny>> {
        self.numbers(&[N], |row, out| out.copy_from_slice(&value(row)))
    }

    /// An array of anything, `missing` where there is no answer.
    pub(crate) fn array<E: Element + Copy>(
        &self,
        missing: E,
        inner: &[usize],
        fill: impl Fn(&T, &mut [E]),
    ) -> PyResult<Py<PyAny>> {
        let size: usize = inner.iter().product();
        let mut values = vec![missing; size * self.rows.len()];
        for (out, row) in values.chunks_mut(size.max(1)).zip(&self.rows) {
            if let Some(row) = row {
                fill(row, out);
            }
        }
        let mut shape = if self.single { Vec::new() } else { vec![self.rows.len()] };
        shape.extend_from_slice(inner);
        let array = PyArray1::from_vec(self.py, values).reshape(IxDyn(&shape))?;
        Ok(if shape.is_empty() { array.call_method0("item")?.unbind() } else { array.into_any().unbind() })
    }

    /// A word for each case, `None` where there is no answer: a list unless there is a single case.
    pub(crate) fn words(&self, word: impl Fn(&T) -> &'static str) -> PyResult<Py<PyAny>> {
        let words: Vec<Option<&str>> = self.rows.iter().map(|row| row.map(&word)).collect();
        let object = if self.single {
            words[0].into_pyobject(self.py)?.into_any()
        } else {
            words.into_pyobject(self.py)?
        };
        Ok(object.unbind())
    }
}

/// Why each case has no answer, `None` for those that have one; `None` for a single case, which raises.
pub(crate) fn reasons<T, E: ToString>(
    cases: Cases,
    outcomes: &[Result<T, E>],
) -> Option<Vec<Option<String>>> {
    let reason = |outcome: &Result<T, E>| outcome.as_ref().err().map(ToString::to_string);
    (!cases.single).then(|| outcomes.iter().map(reason).collect())
}
