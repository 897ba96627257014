//! Inspection of a robot at a pose: cables that cross, wrenches that are hardly resisted, unstable
//! equilibria.

use super::{Findings, Severity};
use crate::clearance::{HangingCables, TOUCHING};
use cdpr_robot::{Plane, Pose, Robot, Vector3, frame};
use cdpr_statics::{DirectProblem, DirectStart, InverseSolution, Load, Unstable, inverse};

/// Weight of the cables, as a share of the platform's weight, beyond which sag shapes the robot.
const CABLE_WEIGHT: f64 = 0.5;
/// Ratio of the extreme singular values of the wrench matrix beyond which it hardly resists some wrench.
const CONDITION: f64 = 100.0;

impl Findings<'_> {
    /// Findings at a pose with feasible tensions. Where values are in doubt, they are the reason for an
    /// equilibrium that is unstable.
    pub(super) fn at_pose(&mut self, pose: &Pose, solution: &InverseSolution, are_doubtful: bool) {
        let robot = self.robot;
        let [x, y, z] = pose.position.into();
        let at = format!("at ({x:.3}, {y:.3}, {z:.3}) m");
        let cables = 0..robot.cables.len();
        // Leads have no weight.
        let weight = |i| robot.cable(i).weight_per_length * (solution.lengths[i] - robot.cables[i].lead);
        let weight: f64 = cables.clone().map(weight).sum();
        let share = weight / (robot.platform.mass * robot.gravity.magnitude());
        if share > CABLE_WEIGHT {
            self.add(
                Severity::Note,
                "cable.linear_density",
                format!("such that the cables weigh {weight:.1} N {at}"),
                &format!("{:.0} % of the platform's weight: they sag much", 100.0 * share),
                "nothing, if they are so heavy; else linear_density in kg/m",
            );
        }
        let spans: Vec<_> = cables.clone().map(|i| robot.span(pose, i)).collect();
        let arm = robot.platform_size();
        let mut matrix =
            robot.wrench_matrix(pose, &spans.iter().map(|span| -span.normalize()).collect::<Vec<_>>());
        if arm > 0.0 {
            matrix.rows_mut(3, 3).unscale_mut(arm);
        }
        // The singular values of a matrix that is not finite, as for a span of zero, are never found.
        let condition = if matrix.iter().all(|entry| entry.is_finite()) {
            let values = matrix.select_rows(&robot.freedoms().components()).singular_values();
            values.max() / values.min()
        } else {
            f64::NAN
        };
        if condition.is_nan() || condition > CONDITION {
            self.add(
                Severity::Warning,
                "cables",
                format!("condition {condition:.3e} {at}"),
                "the wrench matrix, its moments over the platform's size, is nearly singular: some wrench \
                 is hardly resisted",
                "anchor and exit points that let the cables pull in all directions",
            );
        }
        let held = DirectProblem::new(robot, &solution.lengths, &Load::none()).and_then(|problem| {
            problem.with_unstable(Unstable::Accepted).direct(DirectStart::Near(&solution.equilibrium))
        });
        if !are_doubtful && held.is_ok_and(|held| !held.stability.is_stable()) {
            self.add(
                Severity::Warning,
                "platform.center_of_mass",
                format!("unstable {at}"),
                "the platform is held there but would turn over",
                "check the centre of mass and the heights of the anchor and exit points",
            );
        }
        self.pulleys(solution, &at);
        // Without lengths there are no shapes.
        if let Ok(hanging) = HangingCables::new(robot, &solution.lengths, &solution.equilibrium) {
            for j in cables {
                self.crossings(&hanging, j, &at);
                self.through_the_platform(&hanging, j, &at);
            }
        }
    }

    /// Which of the cables before this one pass it within their thickness: one finding, with the nearest of
    /// them.
    fn crossings(&mut self, hanging: &HangingCables, j: usize, at: &str) {
        let touching: Vec<_> = (0..j).filter_map(|i| Some((hanging.touching(i, j)?, i))).collect();
        let Some((distance, i)) = touching.iter().copied().min_by(|one, other| one.0.total_cmp(&other.0))
        else {
            return;
        };
        let others = match touching.len() - 1 {
            0 => String::new(),
            more => format!(" and as near to {more} cables more"),
        };
        // Cables of a planar robot may have planes of their own.
        let (severity, remedy) = match self.robot.plane {
            Some(_) => (Severity::Note, "nothing, if they pass each other out of the plane"),
            None => (
                Severity::Warning,
                "check the order of the points: each exit_point with the anchor_point of the same cable",
            ),
        };
        self.add(
            severity,
            format!("cables[{j}]"),
            format!("{:.1} mm from cable {}{others} {at}", 1e3 * distance.max(0.0), i + 1),
            if distance <= TOUCHING {
                "these cables touch, as they hang"
            } else {
                "these cables, as they hang, pass within their thickness"
            },
            remedy,
        );
    }

    /// A cable that passes through the hull of the anchor points.
    fn through_the_platform(&mut self, hanging: &HangingCables, i: usize, at: &str) {
        if hanging.platform(i).is_some_and(|distance| distance <= 0.0) {
            self.add(
                Severity::Note,
                format!("cables[{i}]"),
                format!("0 mm from the hull of the other anchor points {at}"),
                "this cable passes through the platform, if that fills the hull of its anchor points",
                "nothing, if the platform is open there; else check the order of the points",
            );
        }
    }
}

/// A level pose with feasible tensions, on the vertical through the middle of the exit points. Where the exit
/// points have one height, it is as near as possible to half of the frame's size below them; otherwise it is
/// as near as possible to the middle of their heights. The platform stays above `ground_z`; without it, under
/// exit points that are all above z = 0, above this floor.
pub(super) fn held(robot: &Robot) -> Option<(Pose, InverseSolution)> {
    let sides = frame(robot);
    let size = sides.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    let mut middle = Vector3::from(sides.map(|[low, high]| 0.5 * (low + high)));
    let normal = robot.plane.map(Plane::normal);
    if let Some(k) = normal {
        let heights = robot.cables.iter().map(|cable| cable.exit_point[k] - cable.anchor_point[k]);
        middle[k] = heights.sum::<f64>() / robot.cables.len() as f64;
    }
    // Upwards and downwards, or along y where the plane is level.
    let (along, floor) = if normal == Some(2) { (1, f64::NEG_INFINITY) } else { (2, robot.floor()) };
    let [low, high] = sides[along];
    if along == 2 && high - low <= 0.1 * size {
        middle.z = (low - 0.5 * size).max(0.5 * (floor + low));
    }
    (0..=20).find_map(|k| {
        let mut place = middle;
        place[along] += 0.05 * size * f64::from((k + 1) / 2) * if k % 2 == 0 { 1.0 } else { -1.0 };
        let pose = Pose::at(place.x, place.y, place.z);
        let is_above = place[along] >= floor;
        is_above.then(|| inverse(robot, &pose, &Load::none()).ok()).flatten().map(|solution| (pose, solution))
    })
}

/// What to do where a robot has fewer cables than motions: its file may lack the plane in which it moves.
pub(super) fn remedy_for_few(robot: &Robot) -> String {
    let flat = |k: usize| {
        let mut points = robot.cables.iter().flat_map(|cable| [cable.exit_point[k], cable.anchor_point[k]]);
        points.all(|coordinate| coordinate == robot.cables[0].exit_point[k])
    };
    let planes = [(2, "xy"), (1, "xz"), (0, "yz")];
    match planes.into_iter().find(|(k, _)| robot.plane.is_none() && !robot.platform.point && flat(*k)) {
        Some((_, plane)) => {
            format!("\"plane\": \"{plane}\" if it moves in this plane alone; else name them as free in poses")
        }
        None => "nothing, for a suspended platform; name them as free where a pose is given".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cdpr_robot::library;

    #[test]
    fn a_planar_robot_below_exits_of_one_height_is_held() {
        let text = r#"{ "format": "cdpr-robot/1", "name": "Two cables", "gravity": 9.81, "plane": "xz",
            "platform": { "mass": 5, "center_of_mass": [0, 0, 0], "point": true },
            "cable": { "diameter": 0.002, "youngs_modulus": 1e11, "linear_density": 0.015 },
            "tension_limits": { "min": 1, "max": 500 },
            "cables": [{ "exit_point": [-2, 0, 3], "anchor_point": [0, 0, 0] },
                { "exit_point": [2, 0, 3], "anchor_point": [0, 0, 0] }] }"#;
        let (pose, solution) = held(&Robot::from_json(text).unwrap()).unwrap();
        assert_eq!(pose.position.xy(), Vector3::zeros().xy());
        assert!((0.0..3.0).contains(&pose.position.z) && solution.tensions[0] > 1.0, "{pose:?}");
    }

    #[test]
    fn the_pose_of_a_planar_robot_is_in_its_plane() {
        let robot = |plane: &str, swap: [usize; 3]| {
            let point = |xy: [f64; 2]| {
                let own = [xy[0], xy[1], 0.3];
                format!("{:?}", swap.map(|k| own[k]))
            };
            let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
            let cables = corners.map(|[x, y]| {
                let anchor = point([0.1 * (x - 0.5), 0.08 * (0.5 - y)]);
                format!("{{\"exit_point\": {}, \"anchor_point\": {anchor}}}", point([x, y]))
            });
            let text = format!(
                "{{\"format\": \"cdpr-robot/1\", \"name\": \"table\", \"plane\": \"{plane}\",
                \"gravity\": 9.81,
                \"platform\": {{\"mass\": 1.2, \"center_of_mass\": [0, 0, 0]}},
                \"cable\": {{\"diameter\": 0.001, \"youngs_modulus\": 5e10, \"linear_density\": 0.0006}},
                \"tension_limits\": {{\"min\": 5, \"max\": 150}}, \"cables\": [{}]}}",
                cables.join(", ")
            );
            Robot::from_json(&text).unwrap()
        };
        for (plane, swap, normal) in [("xy", [0, 1, 2], 2), ("xz", [0, 2, 1], 1), ("yz", [2, 0, 1], 0)] {
            let (pose, _) = held(&robot(plane, swap)).unwrap();
            assert!(pose.position[normal].abs() < 1e-15, "{plane}: {pose:?}");
        }
    }

    #[test]
    fn no_pose_that_is_suggested_is_below_the_ground() {
        let mut held_above = 0;
        for file in library::ROBOTS {
            let mut robot = Robot::from_json(file.text).unwrap();
            let [_, _, [lowest, _]] = frame(&robot);
            for ground in [0.0, lowest - 0.5] {
                robot.ground_z = Some(ground).filter(|ground| *ground < lowest);
                let (Some(ground), Some((pose, _))) = (robot.ground_z, held(&robot)) else { continue };
                let anchors = robot.cables.iter().map(|cable| pose.position.z + cable.anchor_point.z);
                assert!(anchors.fold(pose.position.z, f64::min) >= ground, "{} {pose:?}", robot.name);
                held_above += 1;
            }
        }
        assert!(held_above > 15, "{held_above}");
    }
}
