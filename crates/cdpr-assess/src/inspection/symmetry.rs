//! Layouts that would be symmetric if two anchor points were exchanged: most robots are symmetric about a
//! vertical axis or plane, and two exchanged cables are not, even where the robot holds as much either way.

use cdpr_robot::{Robot, Vector3};

/// Distance of an exit point from its image over the size of the frame: frames are surveyed, not drawn.
const EXIT: f64 = 0.05;
/// Distance of an anchor point from its image over the largest distance of two of them.
const ANCHOR: f64 = 0.1;

/// Half a turn and a quarter of a turn about the vertical, and mirrors in two vertical planes: what they do
/// to x and y, as the rows of a matrix.
const IMAGES: [[[f64; 2]; 2]; 4] = [
    [[-1.0, 0.0], [0.0, -1.0]],
    [[0.0, -1.0], [1.0, 0.0]],
    [[-1.0, 0.0], [0.0, 1.0]],
    [[1.0, 0.0], [0.0, -1.0]],
];

/// Exit and anchor points of a cable, from the middle of all exit and all anchor points [m].
type Ends = [Vector3<f64>; 2];

/// The pairs of cables with exchanged anchor points with which a robot without a symmetry has one.
pub(super) fn broken(robot: &Robot) -> Vec<(usize, usize)> {
    let layout = Layout::of(robot);
    if layout.is_symmetric() {
        return Vec::new();
    }
    let n = layout.ends.len();
    let pairs = (0..n).flat_map(|j| (0..j).map(move |i| (i, j)));
    pairs.filter(|&(i, j)| layout.exchanged(i, j).is_symmetric()).collect()
}

#[derive(Clone)]
struct Layout {
    ends: Vec<Ends>,
    /// Greatest distances of a point from an image [m]: of exit points, of anchor points.
    near: [f64; 2],
}

impl Layout {
    fn of(robot: &Robot) -> Self {
        let points: Vec<Ends> =
            robot.cables.iter().map(|cable| [cable.exit_point, cable.anchor_point]).collect();
        let middle = |k: usize| points.iter().map(|ends| ends[k]).sum::<Vector3<f64>>() / points.len() as f64;
        let middles = [middle(0), middle(1)];
        let size = |k: usize| {
            let apart =
                |one: &Ends| points.iter().map(|other| (one[k] - other[k]).norm()).fold(0.0, f64::max);
            points.iter().map(apart).fold(0.0, f64::max)
        };
        let near = [EXIT * size(0), ANCHOR * size(1)];
        let ends = points.iter().map(|ends| [ends[0] - middles[0], ends[1] - middles[1]]).collect();
        Self { ends, near }
    }

    fn exchanged(&self, i: usize, j: usize) -> Self {
        let mut other = self.clone();
        (other.ends[i][1], other.ends[j][1]) = (self.ends[j][1], self.ends[i][1]);
        other
    }

    /// Whether one of the images of each cable is a cable.
    fn is_symmetric(&self) -> bool {
        let image = |[x, y]: &[[f64; 2]; 2], point: &Vector3<f64>| {
            Vector3::new(x[0] * point.x + x[1] * point.y, y[0] * point.x + y[1] * point.y, point.z)
        };
        let is_cable = |ends: &Ends| {
            let is_same = |other: &Ends| (0..2).all(|k| (ends[k] - other[k]).norm() <= self.near[k]);
            self.ends.iter().any(is_same)
        };
        IMAGES.iter().any(|of| self.ends.iter().all(|ends| is_cable(&ends.map(|point| image(of, &point)))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cdpr_robot::library::{ROBOTS, named};

    fn robot(name: &str) -> Robot {
        Robot::from_json(named(ROBOTS, name).unwrap().text).unwrap()
    }

    #[test]
    fn no_robot_of_the_library_would_be_symmetric_with_two_cables_exchanged() {
        for file in ROBOTS {
            assert_eq!(broken(&robot(file.name)), [], "{}", file.name);
        }
    }

    #[test]
    fn two_exchanged_cables_of_a_symmetric_robot_are_found() {
        let mut cogiro = robot("cogiro");
        let (first, third) = (cogiro.cables[0].anchor_point, cogiro.cables[2].anchor_point);
        (cogiro.cables[0].anchor_point, cogiro.cables[2].anchor_point) = (third, first);
        assert!(broken(&cogiro).contains(&(0, 2)), "{:?}", broken(&cogiro));
    }
}
