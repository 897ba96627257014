//! Tables of deviations: a row for each robot, a column for each of its parameters.

use crate::error::RobotError;
use crate::parameter::layout::ParameterLayout;
use std::borrow::Cow;
use std::slice::{ChunksExact, ChunksExactMut};

/// Deviations of robots from a nominal one, which are added to its parameters: a row for each robot, with one
/// number for each parameter of a layout, in its order and in the units of [`crate::Parameter::unit`].
///
/// The numbers are borrowed or owned, row after row.
///
/// ```
/// use cdpr_robot::{Deviations, ParameterLayout, Robot, RobotError};
///
/// let robot = Robot::from_library("caroca")?;
/// let layout = ParameterLayout::of(&robot);
/// let two_robots = Deviations::new(&layout, 62, vec![0.001; 124])?;
/// assert_eq!(two_robots.count(), 2);
///
/// let narrow = Deviations::new(&layout, 31, vec![0.001; 124]);
/// assert_eq!(narrow, Err(RobotError::DeviationCount { given: 31, parameters: 62 }));
/// # Ok::<(), RobotError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Deviations<'a> {
    layout: &'a ParameterLayout,
    values: Cow<'a, [f64]>,
}

impl<'a> Deviations<'a> {
    /// A table with `width` columns for robots with this layout.
    ///
    /// # Errors
    /// [`RobotError::DeviationCount`] for a width that is not the number of parameters;
    /// [`RobotError::DeviationRows`] for numbers that are not whole rows.
    pub fn new(
        layout: &'a ParameterLayout,
        width: usize,
        values: impl Into<Cow<'a, [f64]>>,
    ) -> Result<Self, RobotError> {
        let (parameters, values) = (layout.count(), values.into());
        if width != parameters {
            return Err(RobotError::DeviationCount { given: width, parameters });
        }
        if !values.len().is_multiple_of(parameters) {
            return Err(RobotError::DeviationRows { given: values.len(), parameters });
        }
        Ok(Self { layout, values })
    }

    /// The deviations of one robot.
    ///
    /// # Errors
    /// [`RobotError::DeviationCount`] for a list of another length than the number of parameters.
    pub fn of_one(
        layout: &'a ParameterLayout,
        values: impl Into<Cow<'a, [f64]>>,
    ) -> Result<Self, RobotError> {
        let values = values.into();
        Self::new(layout, values.len(), values)
    }

    /// A table of zeros for `count` robots.
    pub fn zeros(layout: &'a ParameterLayout, count: usize) -> Self {
        Self { layout, values: Cow::Owned(vec![0.0; count * layout.count()]) }
    }

    /// Number of robots.
    pub fn count(&self) -> usize {
        self.values.len() / self.layout.count()
    }

    /// All numbers, row after row.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The deviations of each robot.
    pub fn rows(&self) -> ChunksExact<'_, f64> {
        self.values.chunks_exact(self.layout.count())
    }

    /// The deviations of each robot, to be changed; borrowed numbers are copied first.
    pub fn rows_mut(&mut self) -> ChunksExactMut<'_, f64> {
        self.values.to_mut().chunks_exact_mut(self.layout.count())
    }

    /// The table cut into parts of `size` rows; the last one may be shorter.
    pub fn parts(&self, size: usize) -> impl ExactSizeIterator<Item = Deviations<'_>> {
        let parts = self.values.chunks(size.max(1) * self.layout.count());
        parts.map(|values| Deviations { layout: self.layout, values: Cow::Borrowed(values) })
    }

    /// Checks that the table is one for robots with `layout`.
    ///
    /// # Errors
    /// [`RobotError::DeviationCount`] for another number of parameters; [`RobotError::OtherParameter`] for as
    /// many, of which one is another.
    pub fn check(&self, layout: &ParameterLayout) -> Result<(), RobotError> {
        if self.layout == layout {
            return Ok(());
        }
        let (given, parameters) = (self.layout.count(), layout.count());
        if given != parameters {
            return Err(RobotError::DeviationCount { given, parameters });
        }
        let mut columns = self.layout.parameters().into_iter().zip(layout.parameters()).enumerate();
        match columns.find(|(_, (given, expected))| given != expected) {
            None => Ok(()),
            Some((index, (given, expected))) => {
                let (given, expected) = (given.to_string(), expected.to_string());
                Err(RobotError::OtherParameter { index, given, expected })
            }
        }
    }

    /// The answers to each row; a table for robots with another layout is refused in each of its rows.
    pub fn each<'o, T, E: From<RobotError>, I: IntoIterator<Item = Result<T, E>>>(
        &'o self,
        layout: &ParameterLayout,
        answers: impl FnOnce(ChunksExact<'o, f64>) -> I,
    ) -> Vec<Result<T, E>> {
        match self.check(layout) {
            Ok(()) => answers(self.rows()).into_iter().collect(),
            Err(error) => self.rows().map(|_| Err(error.clone().into())).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Robot;

    fn caroca() -> Robot {
        Robot::from_library("caroca").unwrap()
    }

    /// CAROCA with leads of cables `from` to 2.
    fn with_leads(from: usize) -> ParameterLayout {
        let mut robot = caroca();
        robot.cables[from..3].iter_mut().for_each(|cable| cable.lead = 1.0);
        ParameterLayout::of(&robot)
    }

    #[test]
    fn a_table_of_another_width_is_refused_though_its_length_is_that_of_whole_rows() {
        let layout = ParameterLayout::of(&caroca());
        // 93 rows of 62 numbers are 62 rows of 93 numbers.
        let values = vec![0.0; 93 * 62];
        let found = Deviations::new(&layout, 93, &values);
        assert_eq!(found, Err(RobotError::DeviationCount { given: 93, parameters: 62 }));
        let found = Deviations::new(&layout, 62, &values[1..]);
        assert_eq!(found, Err(RobotError::DeviationRows { given: 93 * 62 - 1, parameters: 62 }));
        let found = Deviations::of_one(&layout, &values[..124]);
        assert_eq!(found, Err(RobotError::DeviationCount { given: 124, parameters: 62 }));
        assert_eq!(Deviations::new(&layout, 62, &values).unwrap().count(), 93);
        assert_eq!(Deviations::new(&layout, 62, &[]).unwrap().count(), 0);
    }

    #[test]
    fn a_table_for_robots_with_other_parameters_is_refused_though_they_are_as_many() {
        let (layout, more) = (with_leads(1), with_leads(0));
        let table = Deviations::zeros(&layout, 2);
        assert_eq!(table.check(&layout), Ok(()));
        assert_eq!(table.check(&more), Err(RobotError::DeviationCount { given: 64, parameters: 65 }));

        let mut other = caroca();
        other.cables[4..6].iter_mut().for_each(|cable| cable.lead = 1.0);
        let error = table.check(&ParameterLayout::of(&other)).unwrap_err();
        let expected = "column 63 of the deviations is lead2: expected lead5, as the robot has it";
        assert_eq!(error.to_string(), expected);
    }

    #[test]
    fn parts_are_the_rows_one_after_the_other() {
        let layout = ParameterLayout::of(&caroca());
        let mut table = Deviations::zeros(&layout, 5);
        for (number, row) in table.rows_mut().enumerate() {
            row[number] = 1.0;
        }
        let parts: Vec<_> = table.parts(2).collect();
        assert_eq!(parts.iter().map(Deviations::count).collect::<Vec<_>>(), [2, 2, 1]);
        assert!(parts.iter().flat_map(Deviations::rows).eq(table.rows()));
    }
}
