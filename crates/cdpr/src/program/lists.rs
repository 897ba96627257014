//! Poses and wrenches as files list them, one a line: which column is which quantity, and in which unit.

mod answers;
mod lengths;

pub(crate) use lengths::{LengthTable, length_file, winch_file};

use crate::program::arguments::poses::pose_of;
use crate::program::error::ProgramError;
use crate::program::questions;
use cdpr_robot::{Pose, Robot, Vector3, counted, plausible, rotation_by_angles, rotation_of, short};
use cdpr_study::{Column, Dimension, InputKind, StudyError, Table, TableError, check_table, read_bytes};
use std::path::Path;

/// Names of positions, quaternions and angles, as `Quantities` finds them.
const POSITION: [&str; 3] = ["x", "y", "z"];
const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];
const ANGLES: [&str; 3] = ["roll", "pitch", "yaw"];

/// Names of the components of a wrench.
const WRENCH: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

/// Poses of a table, and its further columns.
pub(crate) struct PoseTable {
    pub(crate) poses: Vec<Pose>,
    /// Names and cells, which the answer has, too.
    pub(crate) further: Vec<(String, Vec<String>)>,
    /// Their lines in the file, if it is a table.
    pub(crate) lines: Option<Vec<usize>>,
    /// Name and numbers of its column of times [s], if it has one.
    pub(crate) times: Option<(String, Vec<f64>)>,
}

/// Why a line, or the names, are no list.
type Reason = Box<dyn std::fmt::Display>;

/// Poses from a file, one a line: x, y, z, and a quaternion or angles. Three or seven plain numbers need no
/// names. A planar robot needs no coordinate out of its plane. Or those of answers in JSON.
pub(crate) fn pose_file(path: &Path, robot: &Robot) -> Result<PoseTable, ProgramError> {
    let bytes = read_bytes(path, InputKind::Poses)?;
    if let Err(StudyError::Table { source: TableError::NoText { .. }, .. }) =
        check_table(path, &bytes, InputKind::Poses)
    {
        let refused = |reason| ProgramError::List { option: "--poses", path: path.to_owned(), reason };
        let poses = answers::poses(&String::from_utf8_lossy(&bytes)).map_err(refused)?;
        return Ok(PoseTable { poses, further: Vec::new(), lines: None, times: None });
    }
    listed("--poses", (path, bytes), "a pose", |table| {
        let lines = Some(table.lines.clone());
        let Some(header) = table.header else {
            let row = |row: &[f64]| {
                let pose = match (row.len(), robot.plane_offset()) {
                    (2, Some(plane)) => pose_of(&completed(row, plane)),
                    _ => pose_of(row),
                };
                pose.map_err(|error| Box::new(error) as Reason)
            };
            let columns: Vec<_> = table.columns.iter().map(|column| (column, 1.0)).collect();
            let poses = rows(table, &columns, row)?;
            return Ok(PoseTable { poses, further: Vec::new(), lines, times: None });
        };
        let (poses, further) = named_poses(table, header, robot)?;
        let times = further.iter().find_map(|column| times(table, column));
        let further = further.into_iter().map(|column| passed(table, column)).collect();
        Ok(PoseTable { poses, further, lines, times })
    })
}

/// Two coordinates of a planar robot, and the third one, which is that of its plane.
fn completed(two: &[f64], (normal, at): (usize, f64)) -> Vec<f64> {
    let mut all = two.to_vec();
    all.insert(normal, at);
    all
}

/// The poses of a table whose columns have names, and its further columns.
fn named_poses<'a>(
    table: &'a Table,
    header: usize,
    robot: &Robot,
) -> Result<(Vec<Pose>, Vec<&'a Column>), String> {
    let of = |reason| at(header, &reason);
    let found = Quantities::of(table, &[&POSITION[..], &QUATERNION, &ANGLES].concat(), POSES).map_err(of)?;
    let plane = robot.plane_offset().filter(|(normal, _)| found.get(POSITION[*normal]).is_none());
    let place = match plane {
        Some((normal, _)) => {
            let names = POSITION.iter().enumerate().filter(|(k, _)| *k != normal);
            found.all(&names.map(|(_, name)| *name).collect::<Vec<_>>())
        }
        None => found.all(&POSITION),
    };
    let place = place.ok_or_else(|| of(found.lacking(POSES)))?;
    // Position, and what is behind it.
    let columns = place.len();
    let split = |row: &[f64]| {
        let (place, rest) = row.split_at(columns);
        let place = plane.map_or_else(|| place.to_vec(), |plane| completed(place, plane));
        (Vector3::from_column_slice(&place), rest.to_vec())
    };
    // Numbers of `--rpy` are degrees, too.
    let angle = |name: &&str| found.get(name).map(|(column, factor)| (column, factor / 1f64.to_radians()));
    let angles: Vec<Option<(&Column, f64)>> = ANGLES.iter().map(angle).collect();
    if let Some((column, _)) = angles.iter().flatten().find(|(column, _)| column.quantity().1.is_none()) {
        let name = &column.name;
        return Err(of(format!("column {name} has no unit: expected {name}_deg or {name}_rad")));
    }
    let poses = match (found.all(&QUATERNION), angles.iter().all(Option::is_none)) {
        (Some(quaternion), true) => {
            let poses = rows(table, &[place, quaternion].concat(), |row| {
                let (position, q) = split(row);
                let rotation = rotation_of([q[0], q[1], q[2], q[3]]);
                let rotation = rotation.map_err(|error| Box::new(error) as Reason)?;
                Ok(Pose { position, rotation })
            })?;
            // The names of the columns state the order; the numbers may have another one.
            let doubt = |(line, pose): (&usize, &Pose)| {
                plausible::quaternion(&format!("line {line}: qw,qx,qy,qz"), &pose.rotation)
            };
            questions::ask(table.lines.iter().zip(&poses).find_map(doubt));
            poses
        }
        (None, _) if !QUATERNION.iter().any(|name| found.get(name).is_some()) => {
            let columns = place.into_iter().chain(angles.iter().flatten().copied()).collect::<Vec<_>>();
            rows(table, &columns, |row| by_angles(split(row), &angles))?
        }
        _ => return Err(of(found.lacking(POSES))),
    };
    Ok((poses, found.further))
}

/// Name and numbers [s] of a column that has the time of each pose.
fn times(table: &Table, column: &Column) -> Option<(String, Vec<f64>)> {
    const NAMES: [&str; 4] = ["t", "time", "timestamp", "stamp"];
    let (quantity, unit) = column.quantity();
    let is_time = unit.is_none_or(|unit| unit.dimension == Dimension::Time);
    let values = table.finite(column).ok().filter(|_| is_time && NAMES.contains(&quantity.as_str()))?;
    let factor = unit.map_or(1.0, |unit| unit.factor);
    Some((column.name.clone(), values.iter().map(|value| in_si(*value, factor)).collect()))
}

/// Name and cells of a column.
fn passed(table: &Table, column: &Column) -> (String, Vec<String>) {
    (column.name.clone(), (0..table.rows()).map(|row| column.text(row)).collect())
}

/// The pose of a position [m] and of those angles [degrees] that have a column; the others are zero.
fn by_angles(
    (position, given): (Vector3<f64>, Vec<f64>),
    columns: &[Option<(&Column, f64)>],
) -> Result<Pose, Reason> {
    let mut given = given.iter();
    let mut angles = [0.0; 3];
    for ((angle, column), name) in angles.iter_mut().zip(columns).zip(ANGLES) {
        let Some((_, factor)) = column else { continue };
        *angle = given.next().copied().unwrap_or_default();
        if *factor != 1.0 && angle.abs() > 360.0 {
            let value = short(*angle / factor);
            let reason =
                format!("{name} is {value}: expected less than a turn; degrees are called {name}_deg");
            return Err(Box::new(reason));
        }
    }
    Ok(Pose { position, rotation: rotation_by_angles(angles) })
}

/// Wrenches from a file, one a line: fx, fy, fz [N], mx, my, mz [N m].
pub(crate) fn wrench_file(path: &Path) -> Result<Vec<[f64; 6]>, ProgramError> {
    listed("--wrench", (path, read_bytes(path, InputKind::Poses)?), "a wrench", |table| {
        let columns = match table.header {
            Some(header) => {
                let found = Quantities::of(table, &WRENCH, WRENCHES).map_err(|reason| at(header, &reason))?;
                if let Some(column) = found.further.iter().find(|column| !column.is_aside()) {
                    let reason = format!("column {}: expected {WRENCHES}, texts and a time t", column.name);
                    return Err(at(header, &reason));
                }
                found.all(&WRENCH).ok_or_else(|| at(header, &found.lacking(WRENCHES)))?
            }
            None => table.columns.iter().map(|column| (column, 1.0)).collect(),
        };
        rows(table, &columns, |row| {
            let wrench = <[f64; 6]>::try_from(row);
            wrench.map_err(|_| {
                Box::new(format!("{}: expected {WRENCHES}", counted(row.len(), "number"))) as Reason
            })
        })
    })
}

/// What the columns of a list are.
const POSES: &str = "x_m,y_m,z_m, then none, qw,qx,qy,qz or any of roll_deg,pitch_deg,yaw_deg";
const WRENCHES: &str = "fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";

/// A list from the table of a file, its path and bytes.
fn listed<T>(
    option: &'static str,
    (path, bytes): (&Path, Vec<u8>),
    what: &str,
    read: impl FnOnce(&Table) -> Result<T, String>,
) -> Result<T, ProgramError> {
    let refused = |reason: String| ProgramError::List { option, path: path.to_owned(), reason };
    match check_table(path, &bytes, InputKind::Poses) {
        Err(StudyError::Table { source, .. }) => return Err(refused(source.to_string())),
        checked => checked?,
    }
    let table = Table::read(&bytes).map_err(|source| refused(source.to_string()))?;
    let list = read(&table).map_err(refused)?;
    if table.rows() == 0 {
        let found = if table.columns.is_empty() { "the file is empty" } else { "nothing but a header" };
        let empty = format!("{option} {}: {found}, expected {what} on each line", path.display());
        return Err(ProgramError::Usage(empty));
    }
    Ok(list)
}

/// What `row` makes of the numbers of each line, in SI units.
fn rows<T>(
    table: &Table,
    columns: &[(&Column, f64)],
    row: impl Fn(&[f64]) -> Result<T, Reason>,
) -> Result<Vec<T>, String> {
    let numbers = |&(column, factor)| Ok((table.finite(column)?, factor));
    let columns: Vec<_> =
        columns.iter().map(numbers).collect::<Result<_, TableError>>().map_err(|error| error.to_string())?;
    let line = |k: usize| {
        let numbers: Vec<f64> = columns.iter().map(|(values, factor)| in_si(values[k], *factor)).collect();
        row(&numbers).map_err(|reason| at(table.lines[k], &reason))
    };
    (0..table.rows()).map(line).collect()
}

/// A number times the factor of its unit; divided where the unit is a whole part, so that 1380 mm are 1.38 m.
fn in_si(value: f64, factor: f64) -> f64 {
    let parts = factor.recip();
    if parts > 1.0 && parts.fract() == 0.0 { value / parts } else { value * factor }
}

/// A reason with its line.
fn at(line: usize, reason: &dyn std::fmt::Display) -> String {
    format!("line {line}: {reason}")
}

/// The columns of a table by the names of their quantities, with the factors to SI units.
struct Quantities<'a> {
    found: Vec<(String, &'a Column, f64)>,
    further: Vec<&'a Column>,
    names: Vec<&'a str>,
}

impl<'a> Quantities<'a> {
    /// Finds the quantities of these names. All other columns are further ones, unless their names are those
    /// of rotations or nearly those of a wanted quantity: what is meant by them must not be left out.
    fn of(table: &'a Table, wanted: &[&str], expected: &str) -> Result<Self, String> {
        let mut found: Vec<(String, &Column, f64)> = Vec::new();
        let mut further = Vec::new();
        // A series of `simulate` has a rotation vector from its rest next to the orientation.
        let named = |quantity: &str| table.columns.iter().any(|column| column.quantity().0 == quantity);
        let has_rotation = named("qw") || ANGLES.iter().any(|name| named(name));
        let has_quaternion = named("qw");
        for column in &table.columns {
            let (quantity, unit) = column.quantity();
            let name = &column.name;
            if wanted.contains(&quantity.as_str()) {
                if let Some(unit) = unit.filter(|unit| Some(unit.dimension) != dimension(&quantity)) {
                    let of = format!("column {name}: {quantity} in a unit of {}", unit.dimension.name());
                    return Err(format!("{of}: expected {expected}"));
                }
                if found.iter().any(|(known, ..)| *known == quantity) {
                    return Err(format!("column {name}: {quantity} is there twice"));
                }
                found.push((quantity, column, unit.map_or(1.0, |unit| unit.factor)));
            } else if has_quaternion && VECTOR.contains(&quantity.as_str()) {
                further.push(column);
            } else if is_rotation(&quantity) || wanted.iter().any(|wanted| is_near(wanted, &quantity)) {
                return Err(format!(
                    "column {name}: expected {expected}; give it another name if it is not of these"
                ));
            } else if unit.is_some_and(|unit| unit.dimension == Dimension::Angle) && !has_rotation {
                return Err(format!(
                    "column {name}: an angle, and no rotation is named: expected {expected}; leave it out if it is \
                     none of these"
                ));
            } else {
                further.push(column);
            }
        }
        let names = table.columns.iter().map(|column| column.name.as_str()).collect();
        Ok(Self { found, further, names })
    }

    fn get(&self, name: &str) -> Option<(&'a Column, f64)> {
        self.found.iter().find(|(known, ..)| known == name).map(|(_, column, factor)| (*column, *factor))
    }

    /// The columns of all of these names, or nothing.
    fn all(&self, names: &[&str]) -> Option<Vec<(&'a Column, f64)>> {
        names.iter().map(|name| self.get(name)).collect()
    }

    fn lacking(&self, expected: &str) -> String {
        let names = self.names.join(",");
        // A known quantity in an unknown unit: `x_ft`.
        let unknown = self.names.iter().find_map(|name| {
            let (quantity, unit) = name.split_once('_')?;
            (POSITION.contains(&quantity) && self.get(quantity).is_none()).then_some((name, unit))
        });
        let why = unknown.map_or_else(String::new, |(name, unit)| {
            format!(": {name} has the unit {unit}, which is not known")
        });
        format!("columns {names}{why}: expected {expected}")
    }
}

/// Components of a rotation vector.
const VECTOR: [&str; 3] = ["rx", "ry", "rz"];

/// Whether a name is that of a part of a rotation.
fn is_rotation(name: &str) -> bool {
    const NAMES: [&str; 5] = ["phi", "theta", "psi", "heading", "azimuth"];
    let component = name.strip_prefix('q').map(|rest| rest.trim_start_matches('_'));
    let is_component = |rest: &str| rest.len() == 1 && rest.ends_with(|c: char| "wxyzijk0123".contains(c));
    VECTOR.contains(&name)
        || NAMES.contains(&name)
        || name.contains("quat")
        || component.is_some_and(is_component)
}

/// Whether two names of three letters or more differ in one letter, or by one that is missing.
fn is_near(wanted: &str, name: &str) -> bool {
    let (one, other): (Vec<char>, Vec<char>) = (wanted.chars().collect(), name.chars().collect());
    if one.len() < 3 || one.len().abs_diff(other.len()) > 1 {
        return false;
    }
    let same_start = one.iter().zip(&other).take_while(|(a, b)| a == b).count();
    let ends =
        |a: &[char], b: &[char]| a.iter().rev().zip(b.iter().rev()).take_while(|(a, b)| a == b).count();
    let same_end = ends(&one[same_start..], &other[same_start..]);
    same_start + same_end + 1 >= one.len().max(other.len())
}

/// What a quantity measures.
fn dimension(quantity: &str) -> Option<Dimension> {
    Some(match quantity {
        name if POSITION.contains(&name) => Dimension::Length,
        name if ANGLES.contains(&name) => Dimension::Angle,
        name if WRENCH[..3].contains(&name) => Dimension::Force,
        name if WRENCH[3..].contains(&name) => Dimension::Moment,
        _ => return None,
    })
}
