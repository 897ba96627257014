//! Doubts about what is typed besides a robot: positions, loads, lengths.

use super::doubt::{
    Doubt, Doubts, capacity, four_digits, frame, frame_size, in_other_unit, is_possible, reach,
};
use super::{cable, file};
use crate::number::significant;
use crate::pose::Pose;
use crate::pose::quaternion::{QuaternionError, rotation_in_order};
use crate::robot::Robot;
use crate::wrench::Wrench;
use cdpr_cable::short;
use nalgebra::{Rotation3, Vector3};
use std::f64::consts::PI;

/// Distance of a position from the frame over the frame's size, beyond which it is in another unit.
const FAR: f64 = 10.0;
/// Length of a cable over the size of the frame, beyond which it is in another unit.
const LONG: f64 = 20.0;
/// The scalar of a rotation by 20 degrees. A file that names its columns is believed beyond it.
const NEARLY_LEVEL: f64 = 0.985;
/// A whole turn [degrees].
const TURN: f64 = 360.0;
/// Depth below the ground that is an error of surveying, over the size of the frame.
const SURVEYED: f64 = 1e-4;
/// Distance of a pose from the plane of the cables over the size of the frame up to which it is in it.
const OUT_OF_PLANE: f64 = 0.01;
/// Angle by which a platform is turned out of the plane by rounding of its quaternion, at most [rad].
const OUT_OF_PLANE_TURN: f64 = 0.01;
/// What cables may stretch: beyond it two of them do not reach each other's exit points.
const STRETCH: f64 = 1.2;
/// Parts of a half turn, and how near an angle in radians is typed [rad]: 3.14 for a half turn, but 0.5236
/// for a sixth of it.
const TYPED_RADIANS: [(f64, f64); 5] = [(1.0, 2e-3), (2.0, 2e-3), (4.0, 2e-3), (3.0, 1e-4), (6.0, 1e-4)];
/// Units that lengths and positions are typed in by mistake.
const MILLIMETRES: [(&str, f64); 2] = [("mm", 1e-3), ("cm", 1e-2)];

/// Doubts about the mass of a platform [kg] with all it carries, which replaces the one of the robot file.
pub fn mass(robot: &Robot, quantity: &str, value: f64) -> Option<Doubt> {
    let own = robot.platform.mass;
    file::mass(quantity, value).or_else(|| {
        let less = format!("less than half of the platform's own {} kg", four_digits(own));
        let meant = format!("a payload, which is added to the {} kg", four_digits(own));
        (value < 0.5 * own).then(|| Doubt::new(quantity, format!("{} kg", four_digits(value)), less, meant))
    })
}

/// Doubts about a Young's modulus [Pa].
pub fn modulus(quantity: &str, value: f64) -> Option<Doubt> {
    cable::modulus(quantity, value)
}

/// A position of the platform far away from the robot.
pub fn position(robot: &Robot, quantity: &str, position: &Vector3<f64>) -> Option<Doubt> {
    let (frame, size) = (frame(robot), frame_size(robot));
    let away = |position: &Vector3<f64>| {
        let beyond = |k: usize| (frame[k][0] - position[k]).max(position[k] - frame[k][1]).max(0.0);
        Vector3::from([0, 1, 2].map(beyond)).norm() / size
    };
    if size == 0.0 || away(position) <= FAR {
        return None;
    }
    // Only the coordinates that are far away are in another unit.
    let scaled = |factor: f64| {
        let is_far = |k: usize| position[k] < frame[k][0] - size || position[k] > frame[k][1] + size;
        Vector3::from([0, 1, 2].map(|k| if is_far(k) { factor * position[k] } else { position[k] }))
    };
    let meant = MILLIMETRES.iter().find(|(_, factor)| away(&scaled(*factor)) < 1.0);
    let texts = |position: &Vector3<f64>| position.map(four_digits).data.0[0].join(", ");
    Some(Doubt::new(
        quantity,
        format!("({}) m", texts(position)),
        format!(
            "{} times the size of the frame, {} m, away from its exit points",
            four_digits(away(position)),
            four_digits(size)
        ),
        meant.map_or_else(
            || "a position in m in the base frame".to_owned(),
            |(unit, factor)| format!("({}) m, if it is in {unit}", texts(&scaled(*factor))),
        ),
    ))
}

/// A pose with an anchor point, or P, below the ground of the robot file.
pub fn in_ground(robot: &Robot, quantity: &str, pose: &Pose) -> Option<Doubt> {
    let ground = robot.ground_z?;
    let anchors = robot.cables.iter().map(|cable| (pose.rotation * cable.anchor_point).z);
    let lowest = pose.position.z + anchors.fold(0.0, f64::min);
    (lowest < ground - SURVEYED * frame_size(robot)).then(|| {
        Doubt::new(
            quantity,
            format!("at z = {} m", four_digits(pose.position.z)),
            format!(
                "its lowest point is at {} m, below the ground, ground_z = {} m",
                four_digits(lowest),
                four_digits(ground)
            ),
            format!("z of {} m or more", four_digits(pose.position.z + ground - lowest)),
        )
    })
}

/// Steps of time and way beyond this many times their medians are gaps.
const GAP: f64 = 5.0;

/// A time [s] of a path that is not later than the one before, or that is much later, with a platform that
/// has moved far meanwhile. `lines` are those of a file, and `name` is that of the column.
pub fn times(name: &str, lines: &[usize], times: &[f64], poses: &[Pose]) -> Option<Doubt> {
    let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let ways: Vec<f64> = poses.windows(2).map(|pair| (pair[1].position - pair[0].position).norm()).collect();
    let doubt = |k: usize, why: String, meant: &str| {
        let quantity = format!("line {}: {name}", lines[k + 1]);
        Doubt::new(quantity, format!("{} s", short(times[k + 1])), why, meant)
    };
    if let Some(k) = steps.iter().position(|step| *step <= 0.0) {
        let why =
            format!("the line before has {} s, and the poses of a path follow each other", short(times[k]));
        return Some(doubt(k, why, "each pose once, in the order of time"));
    }
    let [step, way] = [&steps, &ways].map(|all| median(all));
    let k = (0..steps.len()).find(|k| steps[*k] > GAP * step && ways[*k] > GAP * way)?;
    let why = format!(
        "the line before is {} s earlier, where {} s are usual, and the platform moves {} m meanwhile",
        significant(steps[k], 3),
        significant(step, 3),
        significant(ways[k], 3)
    );
    Some(doubt(k, why, "all poses of the path, also those between these two"))
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

/// A pose of a planar robot at which its cables leave the plane in which it moves, or its platform is turned
/// out of it.
pub fn out_of_plane(robot: &Robot, quantity: &str, pose: &Pose) -> Option<Doubt> {
    let plane = robot.plane?;
    let (normal, cables) = (plane.normal(), &robot.cables);
    let axis = ["x", "y", "z"][normal];
    // A platform whose frame is another one than that of the base has one of its axes there all the same.
    let nearest = (0..3).map(|k| pose.rotation.matrix()[(normal, k)].abs()).fold(0.0, f64::max);
    if nearest < OUT_OF_PLANE_TURN.cos() {
        let angle = four_digits(nearest.min(1.0).acos().to_degrees());
        return Some(Doubt::new(
            quantity,
            format!("turned out of the plane by {angle} degrees"),
            format!("the platform moves in the plane {}", plane.name()),
            format!("a rotation about {axis} alone"),
        ));
    }
    let offsets = cables.iter().map(|of| of.exit_point[normal] - (pose.rotation * of.anchor_point)[normal]);
    let offsets: Vec<f64> = offsets.collect();
    let at = offsets.iter().sum::<f64>() / offsets.len() as f64;
    // Cables may be side by side, and the tool behind all of them.
    let apart = offsets
        .iter()
        .map(|offset| 3.0 * (offset - at).abs())
        .fold(OUT_OF_PLANE * frame_size(robot), f64::max);
    let off = pose.position[normal] - at;
    (off.abs() > apart).then(|| {
        Doubt::new(
            quantity,
            format!("at {axis} = {} m", four_digits(pose.position[normal])),
            format!(
                "out of the plane {} of its cables, where {axis} is {} m, by {} m",
                plane.name(),
                four_digits(at),
                four_digits(off.abs())
            ),
            format!("{axis} = {} m; a table of poses may leave {axis} out", four_digits(at)),
        )
    })
}

/// Angles [degrees] of more than a turn, or that are 180, 90, 60, 45 or 30 degrees in radians.
pub fn angles(quantity: &str, angles: [f64; 3]) -> Option<Doubt> {
    let typed = angles.map(four_digits).join(", ");
    let in_radians = |angle: f64| {
        let near = |(part, distance): &(f64, f64)| (angle.abs() - PI / part).abs() < *distance;
        TYPED_RADIANS.into_iter().find(near).map(|(part, _)| 180.0 / part)
    };
    if let Some((angle, degrees)) = angles.iter().find_map(|angle| Some((angle, in_radians(*angle)?))) {
        let why = format!("{} is an angle of {degrees} degrees in radians", four_digits(*angle));
        let meant = format!("angles in degrees, {} for it", degrees.copysign(*angle));
        return Some(Doubt::new(quantity, format!("{typed} degrees"), why, meant));
    }
    let angle = angles.into_iter().find(|angle| angle.abs() > TURN)?;
    let within = four_digits((angle + 0.5 * TURN).rem_euclid(TURN) - 0.5 * TURN);
    let why = format!("{} degrees are more than a turn", four_digits(angle));
    let meant = format!("angles in degrees; {within} degrees are the same rotation");
    Some(Doubt::new(quantity, format!("{typed} degrees"), why, meant))
}

/// Why a quaternion that a file states as (w, x, y, z) is probably (x, y, z, w): then it is nearly level.
pub fn quaternion(quantity: &str, rotation: &Rotation3<f64>) -> Option<Doubt> {
    let given = Pose { position: Vector3::zeros(), rotation: *rotation }.quaternion();
    let error @ QuaternionError::Order { .. } = rotation_in_order(given).err()? else { return None };
    if given[3].abs() < NEARLY_LEVEL {
        return None;
    }
    let why = format!("it {}", error.fault());
    Some(Doubt::new(quantity, error.value(), why, error.expected()))
}

/// A point of the platform far away from its anchor points.
pub fn on_platform(robot: &Robot, quantity: &str, point: &Vector3<f64>) -> Option<Doubt> {
    let size = if reach(robot) > 0.0 { reach(robot) } else { frame_size(robot) };
    (size > 0.0 && point.norm() > FAR * size).then(|| {
        let meant = in_other_unit(point.norm(), "m", &MILLIMETRES, |distance| distance < 2.0 * size);
        Doubt::new(
            quantity,
            format!("{} m from P", four_digits(point.norm())),
            format!("the anchor points are {} m from P at most", four_digits(size)),
            meant.unwrap_or_else(|| "coordinates in m in the platform frame".to_owned()),
        )
    })
}

/// A payload [kg] or a wrench that all cables together cannot bear.
pub fn load(robot: &Robot, payload: f64, wrench_of_load: &Wrench) -> Doubts {
    let (most, gravity) = (capacity(robot), robot.gravity.magnitude());
    let heavy = (payload * gravity > most).then(|| {
        let meant = in_other_unit(payload, "kg", &[("g", 1e-3)], |mass| mass * gravity < most);
        Doubt::new(
            "payload",
            format!("{} kg, {} N", four_digits(payload), four_digits(payload * gravity)),
            format!(
                "all cables at their greatest tensions, drawn straight up, carry {} N",
                four_digits(most)
            ),
            meant.unwrap_or_else(|| "a mass in kg".to_owned()),
        )
    });
    heavy.into_iter().chain(wrench(robot, "", wrench_of_load)).collect()
}

/// A wrench that all cables together cannot bear, or a moment on a point mass; `of` comes before the names of
/// its parts.
pub fn wrench(robot: &Robot, of: &str, wrench: &Wrench) -> Doubts {
    let most = capacity(robot);
    let size = if reach(robot) > 0.0 { reach(robot) } else { frame_size(robot) };
    let part = |name: &str, value: f64, unit: &str, other: &str, most: f64| {
        (value > most && most > 0.0).then(|| {
            let meant = in_other_unit(value, unit, &[(other, 1e-3)], |value| value < most);
            Doubt::new(
                format!("{of}{name}"),
                format!("{} {unit}", four_digits(value)),
                format!("all cables at their greatest tensions make {} {unit} at most", four_digits(most)),
                meant.unwrap_or_else(|| format!("a {name} in {unit}")),
            )
        })
    };
    let force = part("force", wrench.force.norm(), "N", "mN", most);
    let moment = if robot.platform.point && wrench.moment.norm() > 0.0 {
        let value = format!("{} N m", four_digits(wrench.moment.norm()));
        let why = "the platform is a point mass, which no moment turns";
        Some(Doubt::new(format!("{of}moment"), value, why, "a force alone, or a platform that is no point"))
    } else {
        part("moment", wrench.moment.norm(), "N m", "N mm", most * size)
    };
    force.into_iter().chain(moment).chain(held_by_plane(robot, of, wrench)).collect()
}

/// The parts of a wrench that a planar robot does not feel.
fn held_by_plane(robot: &Robot, of: &str, wrench: &Wrench) -> Option<Doubt> {
    let (plane, freedoms) = (robot.plane?, robot.freedoms());
    let vector = wrench.to_vector();
    let names = ["force x", "force y", "force z", "moment x", "moment y", "moment z"];
    let components = if robot.platform.point { 0..3 } else { 0..6 };
    let k = components.into_iter().find(|k| vector[*k] != 0.0 && !freedoms.contains(*k))?;
    let (name, unit) = (names[k], if k < 3 { "N" } else { "N m" });
    Some(Doubt::new(
        format!("{of}{name}"),
        format!("{} {unit}", four_digits(vector[k])),
        format!("the robot moves in the plane {} alone, whose guide takes it up", plane.name()),
        "forces in the plane, and a moment about its normal",
    ))
}

/// Unstrained lengths [m] in another unit, or without their leads, or too short to reach the platform.
pub fn lengths(robot: &Robot, lengths: &[f64]) -> Option<Doubt> {
    let size = frame_size(robot) + reach(robot);
    let cables = &robot.cables;
    let are_possible = lengths.iter().copied().all(is_possible);
    if size == 0.0 || lengths.len() != cables.len() || !are_possible {
        return None;
    }
    let doubt = |i: usize, why: String, meant: String| {
        Doubt::new(format!("length {}", i + 1), format!("{} m", four_digits(lengths[i])), why, meant)
    };
    let own = |i: usize| lengths[i] - cables[i].lead;
    let long = (0..cables.len()).find(|i| own(*i) > LONG * size);
    if let Some(i) = long {
        let why =
            format!("{} times the size of the robot, {} m", four_digits(own(i) / size), four_digits(size));
        let meant = in_other_unit(lengths[i], "m", &MILLIMETRES, |length| length < LONG * size);
        return Some(doubt(i, why, meant.unwrap_or_else(|| "unstrained lengths in m".to_owned())));
    }
    let pairs = || (0..cables.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
    let short = |free: &dyn Fn(usize) -> f64| {
        pairs().find(|(i, j)| {
            let apart = (cables[*i].exit_point - cables[*j].exit_point).norm();
            let across = (cables[*i].anchor_point - cables[*j].anchor_point).norm();
            apart > STRETCH * (free(*i).max(0.0) + free(*j).max(0.0)) + across
        })
    };
    let (i, j) = short(&own)?;
    let apart = (cables[i].exit_point - cables[j].exit_point).norm();
    let across = (cables[i].anchor_point - cables[j].anchor_point).norm();
    let why = format!(
        "with length {}, {} m, {} m too short to join exit points {} m apart",
        j + 1,
        four_digits(lengths[j]),
        four_digits(apart - across - own(i).max(0.0) - own(j).max(0.0)),
        four_digits(apart)
    );
    let led = cables.iter().any(|cable| cable.lead > 0.0);
    let meant = if led && short(&|i| lengths[i]).is_none() {
        format!(
            "{} m: a length has its lead in it, {} m",
            four_digits(lengths[i] + cables[i].lead),
            cables[i].lead
        )
    } else {
        "unstrained lengths in m, leads included, in the order of the file".to_owned()
    };
    Some(doubt(i, why, meant))
}

/// Unstrained lengths [m] that are too short for the pose at which the platform was expected to rest: of the
/// cable that lacks most, and how many do.
pub fn lengths_at(robot: &Robot, lengths: &[f64], pose: &Pose) -> Option<Doubt> {
    let cables = robot.cables.iter().zip(lengths).enumerate();
    let short = cables.filter_map(|(i, (cable, length))| {
        let chord = (pose.position + pose.rotation * cable.anchor_point - cable.exit_point).norm();
        let own = (length - cable.lead).max(0.0);
        (STRETCH * own < chord).then_some((i, chord, chord - own))
    });
    let short: Vec<_> = short.collect();
    let (i, chord, lacking) = *short.iter().max_by(|a, b| a.2.total_cmp(&b.2))?;
    let others = match short.len() {
        1 => String::new(),
        count => format!("; {count} of {} cables are too short", robot.cables.len()),
    };
    Some(Doubt::new(
        format!("length {}", i + 1),
        format!("{} m", four_digits(lengths[i])),
        format!(
            "at position ({}) m the points of cable {} are {} m apart, {} m more than its cable has{others}",
            pose.position.map(four_digits).data.0[0].join(", "),
            i + 1,
            four_digits(chord),
            four_digits(lacking)
        ),
        "the lengths that the inverse model has for this pose, in m, leads included, or another pose",
    ))
}
