//! Grids of positions: a plane or a box of the base frame.

use crate::error::StudyError;
use crate::file::grid::{GridAxis, GridSpec};
use cdpr_robot::{Axis, Coordinate, Pose, Robot, frame};
use serde::{Deserialize, Serialize};

/// Level positions on a grid of the base frame, x slowest and z fastest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    x: GridAxis,
    y: GridAxis,
    z: GridAxis,
}

/// What is given of the coordinates along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GridSpan {
    /// First coordinate [m].
    pub min: Option<f64>,
    /// Last coordinate [m].
    pub max: Option<f64>,
    /// Number of coordinates.
    pub points: Option<usize>,
}

impl GridSpan {
    /// Positions along an axis of a plane or line for which no number is given.
    pub const IN_PLANE: usize = 41;
    /// The same of a box.
    pub const IN_BOX: usize = 11;

    /// Whether nothing is said of it.
    fn is_left_out(&self) -> bool {
        self.min.is_none() && self.max.is_none() && self.points.is_none_or(|points| points == 1)
    }

    /// Whether it is a single coordinate.
    fn is_point(&self) -> bool {
        self.points == Some(1) || self.min.is_some() && self.min == self.max
    }
}

/// Positions of a grid, whose results are held in memory as a whole.
const MOST: usize = 4_000_000;

/// Exit points that differ by less than this share of the frame's size along an axis lie in a plane across
/// it.
const FLAT: f64 = 0.1;

/// An invalid axis or grid: axis, value, what is expected.
pub(crate) type Wrong = (Option<Axis>, String, String);

impl Grid {
    /// From the coordinates along x, y and z.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for invalid coordinates, and for more positions than fit in memory.
    pub fn new([x, y, z]: [GridAxis; 3]) -> Result<Self, StudyError> {
        Self::of(&GridSpec { x, y, z }).map_err(|(axis, value, expected)| {
            let field = axis.map_or("grid".to_owned(), |axis| format!("grid along {axis}"));
            StudyError::Setting { field, value, expected }
        })
    }

    /// The same of a study file.
    pub(crate) fn of(&GridSpec { x, y, z }: &GridSpec) -> Result<Self, Wrong> {
        let axes = [x, y, z];
        if let Some((axis, name)) = axes.iter().zip(Axis::ALL).find(|(axis, _)| !axis.is_sound()) {
            let GridAxis { min, max, points } = axis;
            let expected =
                "min:max:points in [m], min below max and two points or more, or one point at min = max";
            return Err((Some(name), format!("{min}:{max}:{points}"), expected.to_owned()));
        }
        let count = axes.iter().try_fold(1_usize, |count, axis| count.checked_mul(axis.points));
        if count.is_none_or(|count| count > MOST) {
            let value = axes.map(|axis| axis.points.to_string()).join(" x ");
            return Err((None, value, format!("at most {MOST} positions")));
        }
        Ok(Self { x, y, z })
    }

    /// The plane in which the coordinate along `normal` is `value` [m], over the frame: the ranges of the
    /// exit points' other two coordinates, with so many points each. Where all exit points are at about one
    /// height, heights begin at the floor of the base frame, z = 0.
    ///
    /// # Errors
    /// [`StudyError::Setting`] where the exit points do not span the plane, and as [`Grid::new`].
    pub fn over_frame(
        robot: &Robot,
        normal: Axis,
        value: f64,
        points: [usize; 2],
    ) -> Result<Self, StudyError> {
        let mut points = points.into_iter();
        let span = |axis: Axis| match axis == normal {
            true => GridSpan { min: Some(value), max: Some(value), points: Some(1) },
            false => GridSpan { points: points.next(), ..GridSpan::default() },
        };
        Self::within(robot, Axis::ALL.map(span))
    }

    /// The positions between these ends along x, y and z. A missing end is that of the frame, the ranges of
    /// the exit points; where all exit points are at about one height, heights begin at the floor of the base
    /// frame, z = 0. Missing numbers of positions are [`GridSpan::IN_PLANE`] where the region is a plane or a
    /// line, else [`GridSpan::IN_BOX`]. A planar robot stays in its plane where nothing is said of that axis.
    ///
    /// # Errors
    /// [`StudyError::Setting`] where the exit points do not span a missing range, and as [`Grid::new`].
    pub fn within(robot: &Robot, spans: [GridSpan; 3]) -> Result<Self, StudyError> {
        let frame = frame(robot);
        let size = frame.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
        // The frame says little about the plane of a planar robot: its pulleys may be next to it.
        let plane = robot.plane_offset().filter(|(normal, _)| spans[*normal].is_left_out());
        let is_flat = plane.is_some() || spans.iter().any(GridSpan::is_point);
        let usual = if is_flat { GridSpan::IN_PLANE } else { GridSpan::IN_BOX };
        let mut axes = [GridAxis { min: 0.0, max: 0.0, points: 1 }; 3];
        for ((axis, span), [low, high]) in Axis::ALL.into_iter().zip(spans).zip(frame) {
            if let Some((_, at)) = plane.filter(|(normal, _)| *normal == axis.index()) {
                axes[axis as usize] = GridAxis { min: at, max: at, points: 1 };
                continue;
            }
            let flat = high - low < FLAT * size;
            let low = if flat && axis == Axis::Z { 0.0 } else { low };
            if (span.min.is_none() || span.max.is_none()) && high - low < FLAT * size {
                let expected = "min:max [m]: the exit points do not span this axis";
                return Err(StudyError::setting(format!("region along {axis}"), "without ends", expected));
            }
            let (min, max) = (span.min.unwrap_or(low), span.max.unwrap_or(high));
            let points = span.points.unwrap_or(if span.is_point() { 1 } else { usual });
            axes[axis as usize] = GridAxis { min, max, points };
        }
        Self::new(axes)
    }

    /// The coordinates along an axis.
    pub fn axis(&self, axis: Axis) -> &GridAxis {
        match axis {
            Axis::X => &self.x,
            Axis::Y => &self.y,
            Axis::Z => &self.z,
        }
    }

    /// The normal axis if the grid is a plane: the only axis with a single coordinate.
    pub fn normal(&self) -> Option<Axis> {
        let mut across = Axis::ALL.into_iter().filter(|axis| self.axis(*axis).points == 1);
        across.next().filter(|_| across.next().is_none())
    }

    /// The first free coordinate along which the positions differ, and what is expected: see [`free_along`].
    pub fn of_free(&self, free: &[Coordinate]) -> Option<(Coordinate, String)> {
        free_along(free, |axis| self.axis(axis).points > 1)
    }

    /// Number of positions.
    pub fn count(&self) -> usize {
        self.x.points * self.y.points * self.z.points
    }

    /// The level pose at a position, by its index.
    pub fn pose(&self, number: usize) -> Pose {
        let (column, k) = (number / self.z.points, number % self.z.points);
        Pose::at(
            self.x.coordinate(column / self.y.points),
            self.y.coordinate(column % self.y.points),
            self.z.coordinate(k),
        )
    }

    /// The first and the last position as level poses: two opposite corners.
    pub fn corners(&self) -> [Pose; 2] {
        [self.pose(0), self.pose(self.count() - 1)]
    }

    /// All positions as level poses.
    pub fn poses(&self) -> Vec<Pose> {
        (0..self.count()).map(|number| self.pose(number)).collect()
    }
}

/// The first free coordinate along which a map has positions, and what is expected: the same rest would be
/// found from all of them.
pub fn free_along(free: &[Coordinate], has_positions: impl Fn(Axis) -> bool) -> Option<(Coordinate, String)> {
    let is_mapped = |one: &&Coordinate| !one.is_angle() && has_positions(Axis::ALL[one.component()]);
    let one = free.iter().find(is_mapped)?;
    Some((*one, format!("coordinates that are not those of the positions: {one} is given at each of them")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(min: f64, max: f64, points: usize) -> GridAxis {
        GridAxis { min, max, points }
    }

    #[test]
    fn a_grid_runs_from_end_to_end_with_z_fastest() {
        let grid = Grid::new([axis(-0.3, 0.1, 3), axis(0.0, 0.0, 1), axis(2.0, 3.0, 2)]).unwrap();
        let poses = grid.poses();
        assert_eq!(poses.len(), 6);
        assert_eq!((poses[0], poses[1]), (Pose::at(-0.3, 0.0, 2.0), Pose::at(-0.3, 0.0, 3.0)));
        assert_eq!(poses[5], Pose::at(0.1, 0.0, 3.0));
        assert_eq!(grid.normal(), Some(Axis::Y));
    }

    #[test]
    fn the_grid_of_a_planar_robot_is_in_its_plane_unless_another_coordinate_is_stated() {
        let robot = planar();
        let along = |min, max, points| GridSpan { min: Some(min), max: Some(max), points: Some(points) };
        let [x, z] = [along(0.5, 1.5, 3), along(1.0, 1.0, 1)];
        let grid = Grid::within(&robot, [x, GridSpan::default(), z]).unwrap();
        assert_eq!((grid.count(), grid.pose(0)), (3, Pose::at(0.5, 0.4, 1.0)));
        let stated = Grid::within(&robot, [x, along(0.1, 0.1, 1), z]).unwrap();
        assert_eq!(stated.pose(0), Pose::at(0.5, 0.1, 1.0));
        assert_eq!(Grid::within(&robot, [GridSpan::default(); 3]).unwrap().normal(), Some(Axis::Y));
    }

    /// A robot in the plane xz, its anchor points at y = 0.1 m and its exit points at y = 0.5 m.
    fn planar() -> Robot {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let cable = |[x, z]: [f64; 2]| {
            let [a, c] = [0.1 * (0.5 * x - 0.5), 0.08 * (0.5 - 0.5 * z)];
            format!("{{\"exit_point\": [{x}, 0.5, {z}], \"anchor_point\": [{a}, 0.1, {c}]}}")
        };
        let text = format!(
            "{{\"format\": \"cdpr-robot/1\", \"name\": \"wall\", \"plane\": \"xz\", \"gravity\": 9.81,
            \"platform\": {{\"mass\": 1.2, \"center_of_mass\": [0, 0, 0]}},
            \"cable\": {{\"diameter\": 0.001, \"youngs_modulus\": 5e10, \"linear_density\": 0.0006}},
            \"tension_limits\": {{\"min\": 5, \"max\": 150}}, \"cables\": [{}]}}",
            corners.map(cable).join(", ")
        );
        Robot::from_json(&text).unwrap()
    }

    #[test]
    fn an_invalid_grid_is_refused_with_its_numbers() {
        let fine = axis(0.0, 1.0, 2);
        for (bad, value) in [
            (axis(1.0, 0.0, 2), "1:0:2"),
            (axis(0.0, 1.0, 1), "0:1:1"),
            (axis(0.0, 0.0, 0), "0:0:0"),
            (axis(f64::NAN, 1.0, 2), "NaN:1:2"),
        ] {
            let message = Grid::new([fine, bad, fine]).unwrap_err().to_string();
            assert!(
                message.starts_with(&format!("grid along y is {value}: expected min:max:points")),
                "{message}"
            );
        }
        let large = Grid::new([axis(0.0, 1.0, usize::MAX); 3]).unwrap_err().to_string();
        assert!(large.ends_with("expected at most 4000000 positions"), "{large}");
    }

    #[test]
    fn a_plane_covers_the_frame_and_a_suspended_robot_hangs_over_the_floor() {
        let robot = Robot::from_library("caroca").unwrap();
        let level = Grid::over_frame(&robot, Axis::Z, 1.75, [5, 3]).unwrap();
        assert_eq!(
            (level.x, level.y, level.z),
            (axis(-3.5, 3.5, 5), axis(-2.0, 2.0, 3), axis(1.75, 1.75, 1))
        );
        let upright = Grid::over_frame(&robot, Axis::X, 0.5, [5, 3]).unwrap();
        assert_eq!(
            (upright.x, upright.y, upright.z),
            (axis(0.5, 0.5, 1), axis(-2.0, 2.0, 5), axis(0.0, 3.5, 3))
        );
        let mut sunk = robot.clone();
        sunk.cables.iter_mut().for_each(|cable| cable.exit_point.z -= 3.5);
        let message = Grid::over_frame(&sunk, Axis::X, 0.0, [5, 3]).unwrap_err().to_string();
        assert!(message.starts_with("region along z is without ends: expected min:max"), "{message}");
    }

    #[test]
    fn what_is_not_given_of_a_region_is_that_of_the_frame() {
        let robot = Robot::from_library("caroca").unwrap();
        let open = GridSpan::default();
        let at = GridSpan { min: Some(1.75), max: Some(1.75), points: None };
        let plane = Grid::within(&robot, [open, GridSpan { points: Some(7), ..open }, at]).unwrap();
        assert_eq!(
            (plane.x, plane.y, plane.z),
            (axis(-3.5, 3.5, GridSpan::IN_PLANE), axis(-2.0, 2.0, 7), axis(1.75, 1.75, 1))
        );
        let inner = GridSpan { min: Some(1.0), max: Some(2.0), points: None };
        let inside = Grid::within(&robot, [open, open, inner]).unwrap();
        assert_eq!(inside.z, axis(1.0, 2.0, GridSpan::IN_BOX));
        assert_eq!(inside.x, axis(-3.5, 3.5, GridSpan::IN_BOX));
    }

    #[test]
    fn a_map_has_no_positions_along_a_free_coordinate() {
        use Coordinate::{Pitch, Roll, X, Z};
        let grid = Grid::new([axis(-0.3, 0.1, 3), axis(0.0, 1.0, 2), axis(2.0, 2.0, 1)]).unwrap();
        assert_eq!(grid.of_free(&[Roll, Pitch]), None);
        assert_eq!(grid.of_free(&[Z, Pitch]), None);
        let (one, expected) = grid.of_free(&[Roll, X]).unwrap();
        assert_eq!(one, X);
        assert!(expected.ends_with("x is given at each of them"), "{expected}");
    }
}
