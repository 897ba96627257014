//! Arrays of numbers in and out.

use crate::convert::error::{Answer, Raised};
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
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
