//! Arrays in and out: one case, or one case in each row.

use crate::convert::error::{Answer, Failure, Raised};
use crate::convert::question::{question, warn};
use cdpr_cable::Vector2;
use cdpr_robot::{Pose, QuaternionError, Robot, Vector3, Wrench, plausible, rotation_in_order, rotation_of};
use cdpr_statics::{Load, StaticsError};
use numpy::{Element, IxDyn, PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Anything that NumPy makes an array of real numbers of.
pub(crate) type Numbers<'py> = Bound<'py, PyAny>;

/// Real numbers of any shape, row by row.
pub(crate) struct Array {
    pub(crate) shape: Vec<usize>,
    pub(crate) values: Vec<f64>,
}

impl Array {
    /// The numbers of an argument, which errors name.
    ///
    /// NumPy copies what is not contiguous or not aligned, such as a field of records: rust-numpy 0.30 views
    /// these with truncated strides.
    pub(crate) fn new(name: &str, numbers: &Numbers) -> Answer<Self> {
        let py = numbers.py();
        let refused = |found: String| Raised::Input(format!("{name} is {found}: expected real numbers"));
        let unless_refused = |error: PyErr| {
            if error.is_instance_of::<PyValueError>(py) || error.is_instance_of::<PyTypeError>(py) {
                refused(format!("not an array of numbers ({})", error.value(py)))
            } else {
                Raised::Python(error)
            }
        };
        let numpy = py.import("numpy")?;
        let array = numpy.call_method1("asarray", (numbers,)).map_err(unless_refused)?;
        let kind = array.getattr("dtype")?;
        // NumPy would parse text and drop imaginary parts.
        if !"biufO".contains(&kind.getattr("kind")?.extract::<String>()?) {
            return Err(refused(format!("an array of {kind}")));
        }
        let array = numpy.call_method1("require", (array, "f8", ("C", "A"))).map_err(unless_refused)?;
        let array = array.cast_into::<PyArrayDyn<f64>>().map_err(PyErr::from)?;
        Ok(Self { shape: array.shape().to_vec(), values: array.to_vec().map_err(PyErr::from)? })
    }
}

/// A whole number that is not negative.
pub(crate) fn whole<T: TryFrom<u64>>(name: &str, number: &Bound<PyAny>) -> Answer<T> {
    let found = number.extract().ok().and_then(|number: u64| T::try_from(number).ok());
    found.ok_or_else(|| {
        let bits = 8 * size_of::<T>();
        Raised::Input(format!("{name} is {number}: expected a whole number from 0 to 2^{bits} - 1"))
    })
}

/// A vector of `N` numbers.
pub(crate) fn components<const N: usize>(name: &'static str, numbers: &Numbers) -> Answer<[f64; N]> {
    let Array { shape, values } = Array::new(name, numbers)?;
    values
        .try_into()
        .ok()
        .filter(|_| shape.len() == 1)
        .ok_or_else(|| Raised::Input(format!("{name} has the shape {shape:?}: expected {N} numbers")))
}

/// The values of an array of this shape, all the same. Raises MemoryError.
pub(crate) fn filled<E: Copy>(shape: &[usize], value: E) -> Answer<Vec<E>> {
    let mut values = Vec::new();
    let size = shape.iter().try_fold(1_usize, |size, length| size.checked_mul(*length));
    let Some(size) = size.filter(|size| values.try_reserve_exact(*size).is_ok()) else {
        let message = format!("an array of the shape {shape:?} does not fit in memory");
        return Err(Raised::Python(PyMemoryError::new_err(message)));
    };
    values.resize(size, value);
    Ok(values)
}

/// An argument: a row of numbers for all cases, or one for each.
pub(crate) struct Rows {
    name: &'static str,
    values: Vec<f64>,
    width: usize,
    /// `None` for one row, without an axis of cases.
    count: Option<usize>,
}

/// The number of cases of a call.
#[derive(Clone, Copy)]
pub(crate) struct Cases {
    pub(crate) count: usize,
    /// Whether no argument has an axis of cases, so that the answer has none either.
    pub(crate) single: bool,
}

impl Rows {
    /// Rows of numbers, one row (`dimensions` axes in all) or one for each case (an axis more).
    fn new(name: &'static str, numbers: &Numbers, dimensions: usize, expected: &str) -> Answer<Self> {
        let Array { shape, values } = Array::new(name, numbers)?;
        let count = match shape.len().checked_sub(dimensions) {
            Some(0) => None,
            Some(1) => Some(shape[0]),
            _ => return Err(Raised::Input(format!("{name} has the shape {shape:?}: expected {expected}"))),
        };
        // A number has no axis, and a width of one.
        let width = shape[shape.len() - dimensions..].iter().product();
        Ok(Self { name, values, width, count })
    }

    /// Vectors with any number of components.
    pub(crate) fn vectors(name: &'static str, numbers: &Numbers) -> Answer<Self> {
        Self::new(name, numbers, 1, "a row of numbers, or one row for each case")
    }

    /// A number for each cable.
    pub(crate) fn of_cables(name: &'static str, numbers: &Numbers, cables: usize) -> Answer<Self> {
        let rows = Self::vectors(name, numbers)?;
        if rows.width == cables {
            Ok(rows)
        } else {
            let width = rows.width;
            Err(Raised::Input(format!(
                "{name} is a list of {width}: expected one value for each of the {cables} cables"
            )))
        }
    }

    /// Vectors of `N` components; zeros where none are given.
    pub(crate) fn components<const N: usize>(name: &'static str, numbers: Option<&Numbers>) -> Answer<Self> {
        let Some(numbers) = numbers else {
            return Ok(Self { name, values: vec![0.0; N], width: N, count: None });
        };
        let rows = Self::vectors(name, numbers)?;
        if rows.width == N {
            Ok(rows)
        } else {
            Err(Raised::Input(format!("{name} has {} numbers a row: expected {N}", rows.width)))
        }
    }

    /// Poses: x, y, z [m], or x, y, z, qw, qx, qy, qz.
    pub(crate) fn poses(name: &'static str, numbers: &Numbers, robot: &Robot) -> Answer<Self> {
        let rows = Self::vectors(name, numbers)?;
        if matches!(rows.width, 3 | 7) {
            rows.question_order()?;
            let position = |row: &[f64]| Vector3::new(row[0], row[1], row[2]);
            let mut positions = rows.values.chunks_exact(rows.width).map(position);
            question(positions.find_map(|place| plausible::position(robot, name, &place)))?;
            Ok(rows)
        } else {
            let width = rows.width;
            Err(Raised::Input(format!(
                "{name} has {width} numbers a row: expected x,y,z [m] or x,y,z,qw,qx,qy,qz"
            )))
        }
    }

    /// Warns of the first quaternion that looks like x, y, z, w.
    fn question_order(&self) -> Answer<()> {
        if self.width != 7 {
            return Ok(());
        }
        let question = self.values.chunks_exact(7).find_map(|row| match *row {
            [_, _, _, w, i, j, k] => {
                rotation_in_order([w, i, j, k]).err().filter(|e| matches!(e, QuaternionError::Order { .. }))
            }
            _ => None,
        });
        let Some(question) = question else { return Ok(()) };
        let message = format!("{}: {question}; it is taken as given", self.name);
        warn(&message)
    }

    /// The first answer of a row.
    pub(crate) fn first<T>(&self, of: impl Fn(&[f64]) -> Option<T>) -> Option<T> {
        self.values.chunks_exact(self.width.max(1)).find_map(of)
    }

    /// Numbers, one or one for each case.
    pub(crate) fn scalars(name: &'static str, numbers: &Numbers) -> Answer<Self> {
        Self::new(name, numbers, 0, "a number, or one for each case")
    }

    /// A number for all cases.
    pub(crate) fn constant(name: &'static str, value: f64) -> Self {
        Self { name, values: vec![value], width: 1, count: None }
    }

    /// Numbers in a row.
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

    /// Number of rows.
    pub(crate) fn number(&self) -> usize {
        self.count.unwrap_or(1)
    }

    /// The pose of a case.
    pub(crate) fn pose(&self, case: usize) -> Result<Pose, StaticsError> {
        let row = self.row(case);
        let position = Vector3::new(row[0], row[1], row[2]);
        let invalid =
            |value, expected| StaticsError::Invalid { field: self.name.to_owned(), value, expected };
        if !position.iter().all(|component| component.is_finite()) {
            return Err(invalid(format!("{row:?}"), "finite numbers".to_owned()));
        }
        // The quaternion (1, 0, 0, 0) makes the same matrix as `Pose::at`.
        let quaternion = if let [_, _, _, w, i, j, k] = *row { [w, i, j, k] } else { [1.0, 0.0, 0.0, 0.0] };
        let rotation = rotation_of(quaternion).map_err(|error| {
            invalid(format!("{row:?}, whose quaternion {}", error.fault()), error.expected())
        })?;
        Ok(Pose { position, rotation })
    }

    /// The vector of a case, with the number of components that was asked for.
    pub(crate) fn vector<const N: usize>(&self, case: usize) -> [f64; N] {
        let row = self.row(case);
        std::array::from_fn(|k| row[k])
    }
}

impl Cases {
    /// The number of cases that the arguments have.
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

/// The loads: what acts on the platform besides its own weight.
pub(crate) struct Loads {
    pub(crate) force: Rows,
    pub(crate) moment: Rows,
    pub(crate) payload: Rows,
}

impl Loads {
    /// Loads that may all be left out.
    pub(crate) fn new(
        force: Option<&Numbers>,
        moment: Option<&Numbers>,
        payload: Option<&Numbers>,
        robot: &Robot,
    ) -> Answer<Self> {
        let force = Rows::components::<3>("force", force)?;
        let moment = Rows::components::<3>("moment", moment)?;
        let payload = match payload {
            Some(payload) => Rows::scalars("payload", payload)?,
            None => Rows::constant("payload", 0.0),
        };
        let loads = Self { force, moment, payload };
        loads.question(robot)?;
        Ok(loads)
    }

    /// Warns of the first load that all cables together cannot bear.
    fn question(&self, robot: &Robot) -> Answer<()> {
        let rows = [&self.force, &self.moment, &self.payload].map(|rows| rows.count);
        let cases = rows.into_iter().flatten().min().unwrap_or(1);
        let doubts = |load: Load| plausible::load(robot, load.payload, &load.wrench);
        let mut doubts = (0..cases).filter_map(|case| self.load(case).ok()).map(doubts);
        question(doubts.find(|doubts| !doubts.is_empty()).unwrap_or_default())
    }

    /// Loads of which at least one must be given.
    pub(crate) fn given(
        force: Option<&Numbers>,
        moment: Option<&Numbers>,
        payload: Option<&Numbers>,
        robot: &Robot,
    ) -> Answer<Self> {
        if [force, moment, payload].iter().all(Option::is_none) {
            let message = "nothing displaces the platform: expected payload, force or moment";
            return Err(Raised::Input(message.to_owned()));
        }
        Self::new(force, moment, payload, robot)
    }

    /// The number of cases that the load has together with other arguments.
    pub(crate) fn cases<'a>(&'a self, others: impl IntoIterator<Item = &'a Rows>) -> Answer<Cases> {
        let arguments: Vec<_> =
            [&self.force, &self.moment, &self.payload].into_iter().chain(others).collect();
        Cases::of(&arguments)
    }

    /// The load of a case.
    pub(crate) fn load(&self, case: usize) -> Result<Load, StaticsError> {
        let payload = self.payload.scalar(case);
        if payload < 0.0 {
            return Err(StaticsError::Invalid {
                field: self.payload.name.to_owned(),
                value: payload.to_string(),
                expected: "a mass, zero or more [kg]".to_owned(),
            });
        }
        let wrench = Wrench {
            force: self.force.vector::<3>(case).into(),
            moment: self.moment.vector::<3>(case).into(),
        };
        Ok(Load { payload, wrench })
    }
}

/// The answers to all cases, `None` for a case without an answer.
pub(crate) struct Columns<'py, 'a, T> {
    py: Python<'py>,
    single: bool,
    rows: Vec<Option<&'a T>>,
    /// Why each case has no answer: a list; `None` for a single case, which raises.
    reasons: Py<PyAny>,
    /// The kinds of these failures, in the same form.
    kinds: Py<PyAny>,
}

impl<'py, 'a, T> Columns<'py, 'a, T> {
    /// The columns of all outcomes. A single case without an answer raises.
    pub(crate) fn new<E: Failure>(py: Python<'py>, cases: Cases, outcomes: &'a [Result<T, E>]) -> Answer<Self>
    where
        Raised: From<&'a E>,
    {
        if cases.single
            && let Some(Err(error)) = outcomes.first()
        {
            return Err(error.into());
        }
        let errors = || outcomes.iter().map(|outcome| outcome.as_ref().err());
        let reasons: Option<Vec<_>> =
            (!cases.single).then(|| errors().map(|error| error.map(ToString::to_string)).collect());
        let kinds: Option<Vec<_>> =
            (!cases.single).then(|| errors().map(|error| error.map(Failure::kind)).collect());
        Ok(Self {
            py,
            single: cases.single,
            rows: outcomes.iter().map(|row| row.as_ref().ok()).collect(),
            reasons: reasons.into_pyobject(py)?.unbind(),
            kinds: kinds.into_pyobject(py)?.unbind(),
        })
    }

    /// The columns of a part of each answer.
    pub(crate) fn part<U>(&self, part: impl Fn(&'a T) -> &'a U) -> Columns<'py, 'a, U> {
        let rows = self.rows.iter().map(|row| row.map(&part)).collect();
        Columns { py: self.py, single: self.single, rows, reasons: self.reasons(), kinds: self.kinds() }
    }

    /// Why each case has no answer, `None` for a case with one; `None` for a single case.
    pub(crate) fn reasons(&self) -> Py<PyAny> {
        self.reasons.clone_ref(self.py)
    }

    /// The kind of each failure, in the same form.
    pub(crate) fn kinds(&self) -> Py<PyAny> {
        self.kinds.clone_ref(self.py)
    }

    /// An array of the shape `inner` for each case, NaN where there is no answer.
    ///
    /// For a single case and an empty shape it is a number.
    pub(crate) fn numbers(&self, inner: &[usize], fill: impl Fn(&T, &mut [f64])) -> Answer<Py<PyAny>> {
        self.array(f64::NAN, inner, fill)
    }

    /// One number for each case.
    pub(crate) fn number(&self, value: impl Fn(&T) -> f64) -> Answer<Py<PyAny>> {
        self.numbers(&[], |row, out| out[0] = value(row))
    }

    /// A vector for each case.
    pub(crate) fn vector<const N: usize>(&self, value: impl Fn(&T) -> [f64; N]) -> Answer<Py<PyAny>> {
        self.numbers(&[N], |row, out| out.copy_from_slice(&value(row)))
    }

    /// An array of pairs for each case.
    pub(crate) fn pairs(&self, count: usize, pairs: impl Fn(&T) -> &[Vector2<f64>]) -> Answer<Py<PyAny>> {
        self.numbers(&[count, 2], |row, out| {
            for (out, pair) in out.chunks_exact_mut(2).zip(pairs(row)) {
                out.copy_from_slice(pair.as_slice());
            }
        })
    }

    /// An array of any element for each case, `missing` where there is no answer.
    pub(crate) fn array<E: Element + Copy>(
        &self,
        missing: E,
        inner: &[usize],
        fill: impl Fn(&T, &mut [E]),
    ) -> Answer<Py<PyAny>> {
        let mut shape = if self.single { Vec::new() } else { vec![self.rows.len()] };
        shape.extend_from_slice(inner);
        let mut values = filled(&shape, missing)?;
        let size: usize = inner.iter().product();
        for (out, row) in values.chunks_mut(size.max(1)).zip(&self.rows) {
            if let Some(row) = row {
                fill(row, out);
            }
        }
        let array = PyArray1::from_vec(self.py, values).reshape(IxDyn(&shape))?;
        Ok(if shape.is_empty() { array.call_method0("item")?.unbind() } else { array.into_any().unbind() })
    }

    /// A list of words for each case, `None` where there is no answer; a list of these unless there is one
    /// case.
    pub(crate) fn lists(&self, list: impl Fn(&T) -> Vec<String>) -> PyResult<Py<PyAny>> {
        let lists: Vec<Option<Vec<String>>> = self.rows.iter().map(|row| row.map(&list)).collect();
        let object = if self.single {
            lists[0].as_deref().into_pyobject(self.py)?.into_any()
        } else {
            lists.into_pyobject(self.py)?
        };
        Ok(object.unbind())
    }

    /// A word for each case, `None` where there is no answer; a list unless there is a single case.
    pub(crate) fn words(&self, word: impl Fn(&T) -> String) -> PyResult<Py<PyAny>> {
        let words: Vec<Option<String>> = self.rows.iter().map(|row| row.map(&word)).collect();
        let object = if self.single {
            words[0].as_deref().into_pyobject(self.py)?.into_any()
        } else {
            words.into_pyobject(self.py)?
        };
        Ok(object.unbind())
    }
}
