//! Arguments of one case, or with one case in each row.

use crate::convert::arrays::{Array, Numbers};
use crate::convert::error::{Answer, Raised};
use crate::convert::question::{question, warn};
use cdpr_robot::{Pose, QuaternionError, Robot, Vector3, Wrench, plausible, rotation_in_order, rotation_of};
use cdpr_statics::{Load, StaticsError};

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

    /// The same, if all of them are finite.
    pub(crate) fn finite(self) -> Answer<Self> {
        match self.values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(Raised::Input(format!("{} has {value}: expected finite numbers", self.name))),
            None => Ok(self),
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
