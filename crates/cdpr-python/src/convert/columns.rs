//! Answers to one case, or with one case in each row.

use crate::convert::arrays::filled;
use crate::convert::cases::Cases;
use crate::convert::error::{Answer, Failure, Raised};
use cdpr_cable::Vector2;
use numpy::{Element, IxDyn, PyArray1, PyArrayMethods};
use pyo3::prelude::*;

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
