//! Classes of answers: constant fields, which `pickle` carries to other processes and `repr` summarises.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::tuple::BoundTupleIterator;
use pyo3::types::{PyList, PyTuple};

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
        }
    };
}
pub(crate) use answer;

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

/// Summarises an answer: `<cdpr.Deflection displacement (40, 3), rms (40,), ..., reasons [40]>`.
///
/// Arrays show their shapes, lists their lengths; fields that are None are left out, and right derivatives, which
/// are shaped as the left ones.
pub(crate) fn summary(answer: &Bound<PyAny>, names: &[&str]) -> PyResult<String> {
    let class = answer.get_type();
    let module = class.module()?.to_string();
    let mut parts = Vec::new();
    for (name, value) in names.iter().zip(fields(answer, names)?) {
        let shown = if value.is_none() || name.ends_with("_right") {
            continue;
        } else if value.get_type().module()? == *module {
            value.get_type().name()?.to_string()
        } else if let Ok(shape) = value.getattr("shape") {
            shape.to_string()
        } else if let Ok(list) = value.cast::<PyList>() {
            format!("[{}]", list.len())
        } else {
            value.repr()?.to_string()
        };
        parts.push(format!("{name} {shown}"));
    }
    Ok(format!("<{} {}>", class.fully_qualified_name()?, parts.join(", ")))
}
