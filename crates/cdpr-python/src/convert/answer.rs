//! Classes of answers: constant fields, which `pickle` carries to other processes and `repr` summarizes.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::tuple::BoundTupleIterator;
use pyo3::types::{PyFloat, PyList, PyTuple};

/// Declares a struct as a Python class that is pickled and printed by its fields.
macro_rules! answer {
    ($(#[$($about:tt)*])* pub(crate) struct $class:ident {
        $($(#[$($doc:tt)*])* $field:ident: $kind:ty,)*
    }) => {
        $(#[$($about)*])*
        pub(crate) struct $class { $($(#[$($doc)*])* pub(crate) $field: $kind,)* }

        #[pyo3::pymethods]
        impl $class {
            /// Made from its fields, as `pickle` does.
            #[new]
            #[pyo3(signature = (*fields))]
            fn of_fields(fields: &pyo3::Bound<pyo3::types::PyTuple>) -> pyo3::PyResult<Self> {
                use $crate::convert::answer::next;
                let mut fields = fields.iter();
                Ok(Self { $($field: next(&mut fields, stringify!($field))?.extract()?,)* })
            }

            fn __getnewargs__<'py>(
                slf: &pyo3::Bound<'py, Self>,
            ) -> pyo3::PyResult<pyo3::Bound<'py, pyo3::types::PyTuple>> {
                $crate::convert::answer::fields(slf.as_any(), &[$(stringify!($field)),*])
            }

            fn __repr__(slf: &pyo3::Bound<Self>) -> pyo3::PyResult<String> {
                $crate::convert::answer::summary(slf.as_any(), &[$(stringify!($field)),*])
            }

            /// Makes a frame with a row for each case and columns of numbers and words.
            ///
            /// Columns have the names of the program's tables, which end in their units. Elements of arrays
            /// are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
            /// `magnitude_mm/a1.x`.
            ///
            /// Returns
            /// -------
            /// pandas.DataFrame
            ///     The frame.
            fn to_dataframe<'py>(
                slf: &pyo3::Bound<'py, Self>,
            ) -> pyo3::PyResult<pyo3::Bound<'py, pyo3::PyAny>> {
                let table = slf.py().import("cdpr._frame")?;
                table.call_method1("frame_of", (slf, [$(stringify!($field)),*]))
            }

            /// `Deflection[float]` for one case, `Deflection[NDArray]` for several: types for type checkers.
            #[classmethod]
            fn __class_getitem__<'py>(
                class: &pyo3::Bound<'py, pyo3::types::PyType>,
                number: pyo3::Bound<'py, pyo3::PyAny>,
            ) -> pyo3::PyResult<pyo3::Bound<'py, pyo3::PyAny>> {
                class.py().import("types")?.call_method1("GenericAlias", (class, number))
            }
        }
    };
}
pub(crate) use answer;

/// Declares that an answer can be drawn.
macro_rules! plotted {
    ($class:ident) => {
        #[pyo3::pymethods]
        impl $class {
            /// Draws the answer: of one case a bar for each element, of several a line over the cases.
            ///
            /// Parameters
            /// ----------
            /// ax : matplotlib.axes.Axes, optional
            ///     Where to draw; a new figure if left out.
            ///
            /// Returns
            /// -------
            /// matplotlib.figure.Figure
            ///     The figure.
            #[pyo3(signature = (*, ax = None))]
            fn plot<'py>(
                slf: &pyo3::Bound<'py, Self>,
                ax: Option<&pyo3::Bound<'py, pyo3::PyAny>>,
            ) -> pyo3::PyResult<pyo3::Bound<'py, pyo3::PyAny>> {
                slf.py().import("cdpr._figures")?.call_method1("figure_of", (slf, ax))
            }
        }
    };
}
pub(crate) use plotted;

/// Takes the value of the next field.
pub(crate) fn next<'py>(fields: &mut BoundTupleIterator<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    fields.next().ok_or_else(|| {
        PyTypeError::new_err(format!("{name} is missing: expected all fields, in their order"))
    })
}

/// The values of the fields.
pub(crate) fn fields<'py>(answer: &Bound<'py, PyAny>, names: &[&str]) -> PyResult<Bound<'py, PyTuple>> {
    let values = names.iter().map(|name| answer.getattr(*name)).collect::<PyResult<Vec<_>>>()?;
    PyTuple::new(answer.py(), values)
}

/// Summarizes an answer: `<cdpr.Deflection displacement (40, 3), magnitude (40,), ..., reasons [40]>`.
///
/// Numbers, and vectors of up to three of a single case, show their values, other arrays their shapes, lists
/// their lengths; fields that are None are left out, and right derivatives, which
/// are shaped as the left ones.
pub(crate) fn summary(answer: &Bound<PyAny>, names: &[&str]) -> PyResult<String> {
    let class = answer.get_type();
    let module = class.module()?.to_string();
    let single = answer.getattr("reasons").map_or(true, |reasons| reasons.is_none());
    let mut parts = Vec::new();
    for (name, value) in names.iter().zip(fields(answer, names)?) {
        let shown = if value.is_none() || name.ends_with("_right") {
            continue;
        } else if value.get_type().module()? == *module {
            value.get_type().name()?.to_string()
        } else if let Ok(number) = value.cast_exact::<PyFloat>() {
            shortened(number)?
        } else if let Ok(shape) = value.getattr("shape").and_then(|shape| shape.extract::<Vec<usize>>()) {
            match shape[..] {
                [1..=3] if single => {
                    let numbers = value.call_method0("tolist")?.try_iter()?;
                    let shown = numbers.map(|number| shortened(&number?)).collect::<PyResult<Vec<_>>>()?;
                    format!("[{}]", shown.join(", "))
                }
                _ => value.getattr("shape")?.to_string(),
            }
        } else if let Ok(list) = value.cast::<PyList>() {
            format!("[{}]", list.len())
        } else {
            value.repr()?.to_string()
        };
        parts.push(format!("{name} {shown}"));
    }
    Ok(format!("<{} {}>", class.fully_qualified_name()?, parts.join(", ")))
}

/// A number with six digits, or what else stands there.
fn shortened(number: &Bound<PyAny>) -> PyResult<String> {
    if number.is_exact_instance_of::<PyFloat>() {
        number.call_method1("__format__", (".6g",))?.extract()
    } else {
        Ok(number.repr()?.to_string())
    }
}
