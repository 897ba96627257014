//! Whether lengths and poses of a table belong together: columns that were swapped, a column in another unit
//! or with another sign, a row of another robot.

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use crate::sensor_error::size;
use cdpr_robot::{Axis, Pose, Robot, Rotation3, Vector3, significant};

/// A misfit of a column above this share of the robot's size is looked into.
const FAR: f64 = 0.05;

/// A misfit above this share of the robot's size is more than sag and tolerances make.
const SEEN: f64 = 0.01;

/// Coordinates as they are: their order and signs.
const ORDER: [usize; 3] = [0, 1, 2];
const SIGNS: [f64; 3] = [1.0; 3];

/// A length this share of the robot's size away from that of a straight cable is of another row or robot.
const ELSEWHERE: f64 = 0.25;

/// Two columns are swapped if this share of the misfit is left after they are swapped back, and if they are off
/// by more than the other share of the robot's size.
const LEFT: f64 = 0.2;
const SWAPPED: f64 = 0.002;

/// Lengths must be positive where winches count from zero.
///
/// # Errors
/// [`CalibrationError::Cell`] naming line and column.
pub(crate) fn check_signs(rows: &[Row]) -> Result<(), CalibrationError> {
    for row in rows {
        let mut lengths = row.lengths.iter().flatten().enumerate();
        if let Some((i, length)) = lengths.find(|(_, length)| **length <= 0.0) {
            let expected = "a length above zero, or offsets of the winches that are sought, length_offset";
            return Err(cell(row, i, *length, expected.to_owned()));
        }
    }
    Ok(())
}

fn cell(row: &Row, cable: usize, length: f64, expected: String) -> CalibrationError {
    let column = Quantity::Length(cable).to_string();
    CalibrationError::Cell { line: row.line, column, value: length.to_string(), expected }
}

/// A constant by which all lengths differ from those of straight cables at the measured poses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MissingLength {
    /// What would have to be added to the lengths [m].
    pub(crate) missing: f64,
    /// Root mean square of what it leaves of the differences [m].
    pub(crate) left: f64,
    cables: usize,
}

impl MissingLength {
    /// The refusal of such lengths.
    pub(crate) fn refusal(&self) -> CalibrationError {
        let Self { missing, left, cables } = *self;
        let (size, left) = (significant(missing.abs(), 3), significant(left, 2));
        let fit = format!("lengths and positions would then fit to {left} m");
        let cause = "such as the lead between winch and exit point, or where the winches count from";
        let expected = match missing > 0.0 {
            true => format!(
                "lengths that are {size} m longer, all of them: {fit}. Is a constant missing in them, \
                 {cause}?"
            ),
            false => format!(
                "lengths that are {size} m shorter, all of them: {fit}. Is a constant missing in the robot \
                 file, \
                 {cause}?"
            ),
        };
        let expected = format!("{expected} Else seek the offsets of the winches, length_offset");
        CalibrationError::Column { column: all_lengths(cables), expected }
    }
}

/// Names of the columns of lengths.
fn all_lengths(cables: usize) -> String {
    format!("{} to {}", Quantity::Length(0), Quantity::Length(cables - 1))
}

/// Compares the lengths with those of straight cables at the measured poses, which `pose` says. Sag, strain
/// and the errors that are sought change these by far less than swapped columns. The answer is the constant
/// that explains the differences, if one does: positions in another frame may do so, too.
///
/// # Errors
/// [`CalibrationError::Column`] naming two columns that fit far better the other way round, one that does
/// with the other sign, or one that fits nowhere; [`CalibrationError::Cell`] for a row that stands out in
/// this way.
pub(crate) fn check_columns(
    robot: &Robot,
    rows: &[Row],
    pose: impl Fn(&Row) -> Option<Pose>,
) -> Result<Option<MissingLength>, CalibrationError> {
    let rows: Vec<_> = rows.iter().filter_map(|row| Placed::of(row, pose(row)?)).collect();
    if rows.is_empty() {
        return Ok(None);
    }
    let placed = PlacedRows { robot, size: size(robot), rows };
    let misfit = placed.mean_misfit(ORDER, SIGNS);
    placed.check_unit(misfit)?;
    placed.check_coordinates(misfit)?;
    placed.check_rotations(misfit)?;
    placed.check_leads(misfit)?;
    placed.check_order_of_lengths(misfit)?;
    placed.check_lengths()?;
    Ok(placed.constant(misfit))
}

/// A row with a measured position and lengths.
#[derive(Clone, Copy)]
struct Placed<'a> {
    position: Vector3<f64>,
    rotation: Rotation3<f64>,
    lengths: &'a [f64],
    row: &'a Row,
}

impl<'a> Placed<'a> {
    fn of(row: &'a Row, Pose { position, rotation }: Pose) -> Option<Self> {
        Some(Self { position, rotation, lengths: row.lengths.as_ref()?, row })
    }
}

/// Length of a straight cable at a pose, with its lead and arc [m].
pub(crate) fn straight_length(robot: &Robot, pose: &Pose, cable: usize) -> f64 {
    let span = robot.span(pose, cable);
    let span = robot.gravity.level().map_or(span, |level| level * span);
    robot.cable(cable).straight_length_in_space(span)
}

/// All of these of a robot, one at least.
struct PlacedRows<'a> {
    robot: &'a Robot,
    /// Size of the robot [m].
    size: f64,
    rows: Vec<Placed<'a>>,
}

impl PlacedRows<'_> {
    /// Length of a straight cable with its lead and arc [m], with the platform of a row at a position.
    fn straight(&self, of: &Placed, position: Vector3<f64>, cable: usize) -> f64 {
        straight_length(self.robot, &Pose { position, rotation: of.rotation }, cable)
    }

    /// Misfit of column i with cable j [m], with the coordinates of the position in this order and with these
    /// signs.
    fn misfit(&self, [i, j]: [usize; 2], order: [usize; 3], sign: [f64; 3]) -> f64 {
        let square = |of: &Placed| {
            let position = Vector3::from(order.map(|k| sign[k] * of.position[k]));
            (of.lengths[i] - self.straight(of, position, j)).powi(2)
        };
        (self.rows.iter().map(square).sum::<f64>() / self.rows.len() as f64).sqrt()
    }

    /// Mean of the misfits of all columns with their own cables [m].
    fn mean_misfit(&self, order: [usize; 3], sign: [f64; 3]) -> f64 {
        let n = self.robot.cables.len();
        (0..n).map(|i| self.misfit([i, i], order, sign)).sum::<f64>() / n as f64
    }

    /// Refuses positions in m that stand for mm, and the other way.
    fn check_unit(&self, misfit: f64) -> Result<(), CalibrationError> {
        for (factor, expected) in [(1e3, "1000 times the values"), (1e-3, "the values divided by 1000")] {
            // Of positions in another frame, too, those divided by 1000 are nearer to the robot.
            let left = self.mean_misfit(ORDER, [factor; 3]);
            if misfit > FAR * self.size && left < (LEFT * misfit).min(2.0 * SEEN * self.size) {
                let [first, _, last] = Axis::ALL.map(|axis| Quantity::Position(axis).to_string());
                let expected =
                    format!("{expected}: lengths and positions would then fit. Are m and mm mixed up?");
                return Err(CalibrationError::Column { column: format!("{first} to {last}"), expected });
            }
        }
        Ok(())
    }

    /// Refuses rotations from the base frame to the platform.
    fn check_rotations(&self, misfit: f64) -> Result<(), CalibrationError> {
        let turned = self.rows.iter().map(|of| Placed { rotation: of.rotation.inverse(), ..*of });
        let inverse = PlacedRows { rows: turned.collect(), ..*self };
        if misfit > SWAPPED * self.size && inverse.mean_misfit(ORDER, SIGNS) < LEFT * misfit {
            let expected =
                "from the platform frame to the base frame: lengths and poses fit the inverse rotation";
            return Err(CalibrationError::Column {
                column: "of the rotation".into(),
                expected: expected.into(),
            });
        }
        Ok(())
    }

    /// Refuses a coordinate with the other sign, and two that are swapped.
    fn check_coordinates(&self, misfit: f64) -> Result<(), CalibrationError> {
        let name = |k: usize| Quantity::Position(Axis::ALL[k]).to_string();
        for k in ORDER.into_iter().filter(|_| misfit > SEEN * self.size) {
            let mut sign = SIGNS;
            sign[k] = -1.0;
            if self.mean_misfit(ORDER, sign) < LEFT * misfit {
                let expected = "the other sign: lengths and positions would then fit".to_owned();
                return Err(CalibrationError::Column { column: name(k), expected });
            }
        }
        for (one, other) in [(0, 1), (0, 2), (1, 2)].into_iter().filter(|_| misfit > FAR * self.size) {
            let mut order = ORDER;
            order.swap(one, other);
            if self.mean_misfit(order, SIGNS) < LEFT * misfit {
                return Err(swapped(&name(one), &name(other)));
            }
        }
        Ok(())
    }

    /// Refuses lengths that begin at the exit points of a robot with leads.
    fn check_leads(&self, misfit: f64) -> Result<(), CalibrationError> {
        let lead = |i: usize| self.robot.cables[i].lead;
        let (n, longest) =
            (self.robot.cables.len(), (0..self.robot.cables.len()).map(lead).fold(0.0, f64::max));
        let off = |of: &Placed| {
            let beyond = |i: usize| (of.lengths[i] + lead(i) - self.straight(of, of.position, i)).powi(2);
            (0..n).map(beyond).sum::<f64>()
        };
        let without = (self.rows.iter().map(off).sum::<f64>() / (n * self.rows.len()) as f64).sqrt();
        if longest == 0.0 || misfit < SEEN * self.size || without > LEFT * LEFT * misfit {
            return Ok(());
        }
        let expected = format!(
            "lengths from the winches on, with the lead of each cable, up to {longest} m: lengths and positions \
             would then fit"
        );
        Err(CalibrationError::Column { column: all_lengths(n), expected })
    }

    /// The constant that explains the misfit of all lengths, if it is more than their sag and stretch.
    fn constant(&self, misfit: f64) -> Option<MissingLength> {
        let cables = self.robot.cables.len();
        let short = |of: &Placed, i: usize| self.straight(of, of.position, i) - of.lengths[i];
        let each = self.rows.iter().flat_map(|of| (0..cables).map(move |i| short(of, i)));
        let each: Vec<f64> = each.collect();
        let missing = median(each.clone());
        let square = each.iter().map(|short| (short - missing).powi(2)).sum::<f64>();
        let left = (square / each.len() as f64).sqrt();
        // Soft cables are shorter than straight ones by their stretch.
        let stretch =
            |i: usize| self.robot.cable(i).strain(self.robot.limits(i).max) * self.rows[0].lengths[i];
        let stretch = (0..cables).map(stretch).fold(SEEN * self.size, f64::max);
        let explains = missing.abs() > stretch && left < LEFT * LEFT * misfit;
        explains.then_some(MissingLength { missing, left, cables })
    }

    /// Refuses two columns of lengths that are swapped.
    fn check_order_of_lengths(&self, misfit: f64) -> Result<(), CalibrationError> {
        let n = self.robot.cables.len();
        for (i, j) in (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))) {
            let of = |i, j| self.misfit([i, j], ORDER, SIGNS);
            let (before, after) = (of(i, i) + of(j, j), of(i, j) + of(j, i));
            // All columns must fit then: a coordinate with the wrong sign makes those of a symmetric robot
            // look swapped in pairs.
            let rest = n as f64 * misfit - before;
            if before > 2.0 * SWAPPED * self.size && rest + after < LEFT * before {
                return Err(swapped(&Quantity::Length(i).to_string(), &Quantity::Length(j).to_string()));
            }
        }
        Ok(())
    }

    /// Refuses a column, and a row, whose lengths are far from those of straight cables while most are not.
    fn check_lengths(&self) -> Result<(), CalibrationError> {
        let n = self.robot.cables.len();
        let straight = |of: &Placed, i: usize| self.straight(of, of.position, i);
        let off = |of: &Placed, i: usize| (of.lengths[i] - straight(of, i)).abs();
        let usual: Vec<f64> =
            (0..n).map(|i| median(self.rows.iter().map(|of| off(of, i)).collect())).collect();
        if median(usual.clone()) > FAR * self.size {
            return Ok(());
        }
        let elsewhere = ELSEWHERE * self.size;
        if let Some(i) = usual.iter().position(|of| *of > elsewhere) {
            let first = &self.rows[0];
            let expected = format!(
                "lengths near those of a straight cable at the measured poses, {:.4} m instead of {:.4} m \
                 in line {}: its unit or its cable may be another",
                straight(first, i),
                first.lengths[i],
                first.row.line
            );
            return Err(CalibrationError::Column { column: Quantity::Length(i).to_string(), expected });
        }
        for of in &self.rows {
            let farthest = (0..n).max_by(|i, j| off(of, *i).total_cmp(&off(of, *j)));
            if let Some(i) = farthest.filter(|i| off(of, *i) > elsewhere) {
                let expected = format!(
                    "about {:.4} m, that of a straight cable at the measured pose: the row may be of \
                     another pose or robot",
                    straight(of, i)
                );
                return Err(cell(of.row, i, of.lengths[i], expected));
            }
        }
        Ok(())
    }
}

fn swapped(one: &str, other: &str) -> CalibrationError {
    let expected = "them the other way round: lengths and positions would then fit".to_owned();
    CalibrationError::Column { column: format!("{one} and {other}"), expected }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
