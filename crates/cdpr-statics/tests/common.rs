//! Robots of several tests.

use cdpr_robot::{Deviations, Plane, Pose, Robot, RobotCable, Vector3};
use cdpr_statics::batch::Observed;
use cdpr_statics::{Observer, StaticsError};

/// Observes rows of deviations, one after the other, in lanes.
pub(crate) fn observed<T: Observed>(observer: &Observer, rows: &[f64]) -> Vec<Result<T, StaticsError>> {
    let layout = observer.layout();
    observer.observe(&Deviations::new(layout, layout.count(), rows).unwrap())
}

/// Observes one row by the scalar models.
pub(crate) fn alone<T: Observed>(observer: &Observer, row: &[f64]) -> Result<T, StaticsError> {
    observer.observe_one_by_one(&Deviations::of_one(observer.layout(), row).unwrap()).remove(0)
}

pub(crate) fn caroca() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap()
}

pub(crate) fn cogiro() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap()
}

/// CAROCA, CoGiRo, and robots of a stadium, a hall and a telescope, each with a pose that it holds.
pub(crate) fn robots() -> [(Robot, Pose); 5] {
    [
        (caroca(), Pose::at(0.4, -0.3, 1.6)),
        (cogiro(), Pose::at(1.0, -0.5, 2.0)),
        (stadium(), Pose::at(3.0, -2.0, 10.0)),
        (ipanema(), Pose::at(0.2, 0.1, 1.0)),
        (fast(), Pose::at(10.0, 5.0, 100.0)),
    ]
}

/// [`robots`] as point masses, and with platforms that move in a plane.
pub(crate) fn points_and_planar() -> Vec<(Robot, Pose)> {
    let held = |(robot, pose): (Robot, Pose)| {
        let (mut point, mut planar) = (robot.clone(), robot);
        point.platform.point = true;
        point.name += " as a point";
        planar.plane = Some(Plane::Xz);
        planar.name += " in a plane";
        [(point, pose), (planar, pose)]
    };
    robots().into_iter().flat_map(held).collect()
}

/// A light robot whose cables hold the platform from all sides.
pub(crate) fn ipanema() -> Robot {
    Robot::from_json(include_str!("../../../data/reference/robots/ipanema.json")).unwrap()
}

/// A camera robot of 100 m, whose cables sag strongly.
pub(crate) fn stadium() -> Robot {
    Robot::from_json(include_str!("../../../data/reference/robots/stadium.json")).unwrap()
}

/// Eight cables that hang a platform, whose equilibrium ends under great moments.
pub(crate) fn suspended() -> Robot {
    Robot::from_json(include_str!("../../../data/reference/robots/suspended.json")).unwrap()
}

/// Six cables of 300 m that hold the receiver of a telescope.
pub(crate) fn fast() -> Robot {
    Robot::from_json(include_str!("../../../data/reference/robots/fast.json")).unwrap()
}

/// Cables of CAROCA that alternate between the upper and the lower rim of a drum, from a ring of exit points;
/// `jitter` moves both [m].
pub(crate) fn ring(n: usize, mut jitter: impl FnMut() -> f64) -> Vec<RobotCable> {
    let properties = caroca().cables[0].properties.clone();
    let cable = |i: usize| {
        let around = std::f64::consts::TAU * i as f64 / n as f64;
        let (a, b, c) = (jitter(), jitter(), jitter());
        let (anchor, height) = if i.is_multiple_of(2) { (around + 0.5, 0.3) } else { (around - 0.5, -0.3) };
        RobotCable::between(
            Vector3::new((5.0 + a) * around.cos(), (5.0 + b) * around.sin(), 4.0 + c),
            Vector3::new((0.5 + 0.1 * b) * anchor.cos(), 0.5 * anchor.sin(), height + 0.1 * a),
            properties.clone(),
        )
    };
    (0..n).map(cable).collect()
}
