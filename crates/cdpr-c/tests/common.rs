//! Results of the Rust interface as bits, in the order of `tests/c/digits.c`.

use cdpr_c::{CdprLoad, CdprPose};
use cdpr_robot::library::{ROBOTS, named};
use cdpr_robot::{Pose, Robot, Vector3, Wrench};
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::{
    DirectProblem, DirectReport, DirectStart, Equilibrium, InversePath, InverseSolution, Load, Residual,
    Tracker, deflection, derivatives, direct, inverse,
};
use std::fmt::Write;

/// Robots with a pose that each holds [m].
pub(crate) const ROBOTS_AT: [(&str, [f64; 3]); 5] = [
    ("caroca", [0.25, -0.125, 1.75]),
    ("cogiro", [0.5, -0.25, 1.75]),
    ("fast", [2.0, 1.0, 140.0]),
    ("ipanema-1", [0.125, 0.0625, 1.0]),
    ("ipanema-3", [0.25, 0.125, 1.25]),
];

/// Steps of the tracker.
pub(crate) const STEPS: usize = 200;

pub(crate) const LOAD: CdprLoad =
    CdprLoad { payload: 2.0, force: [1.0, -2.0, 3.0], moment: [0.25, 0.5, -0.25] };

/// The pose at a position, level.
pub(crate) fn level(position: [f64; 3]) -> CdprPose {
    CdprPose { position, quaternion: [1.0, 0.0, 0.0, 0.0] }
}

pub(crate) fn robot(name: &str) -> Robot {
    Robot::from_json(named(ROBOTS, name).unwrap().text).unwrap()
}

pub(crate) fn load() -> Load {
    let wrench = Wrench { force: LOAD.force.into(), moment: LOAD.moment.into() };
    Load { payload: LOAD.payload, wrench }
}

/// The x coordinate of step number `k` of a path [m].
pub(crate) fn x_of_step(start: f64, k: usize) -> f64 {
    let along = if k % 400 < 200 { k % 400 } else { 400 - k % 400 };
    start + 0.0005 * along as f64
}

/// Lines of names and bits.
#[derive(Default)]
pub(crate) struct Digits(pub(crate) String);

impl Digits {
    pub(crate) fn line<'a>(&mut self, name: &str, values: impl IntoIterator<Item = &'a f64>) {
        self.0 += name;
        for value in values {
            write!(self.0, " {:016x}", value.to_bits()).unwrap();
        }
        self.0 += "\n";
    }

    fn residual(&mut self, Residual { closure, force, moment }: Residual, iterations: usize, jump: bool) {
        let jump = f64::from(u8::from(jump));
        self.line("report", &[closure, force, moment, iterations as f64, jump]);
    }

    fn report(&mut self, report: &DirectReport) {
        self.residual(report.residual, report.iterations, false);
    }

    fn pose(&mut self, pose: &Pose) {
        self.line("position", &pose.position);
        self.line("quaternion", &pose.quaternion());
    }
}

/// What the program `digits` prints, by the Rust interface.
pub(crate) fn expected(name: &str, position: [f64; 3]) -> String {
    let (robot, load, none) = (robot(name), load(), Load::none());
    let pose = Pose::with_quaternion(position.into(), [1.0, 0.0, 0.0, 0.0]).unwrap();
    let mut digits = Digits::default();
    let wanted = inverse(&robot, &pose, &none).unwrap();
    digits.line("lengths", &wanted.lengths);
    digits.line("tensions", &wanted.tensions);
    digits.residual(wanted.residual, wanted.iterations, false);
    let found = direct(&robot, &wanted.lengths, &load, DirectStart::Pose(&pose)).unwrap();
    digits.pose(&found.equilibrium.pose);
    digits.line("tensions", &found.equilibrium.tensions());
    digits.report(&found.report);
    let deflected = deflection(&robot, &pose, &load).unwrap();
    digits.line("translation", deflected.motion().fixed_rows::<3>(0));
    digits.line("rotation", deflected.motion().fixed_rows::<3>(3));
    digits.report(&deflected.loaded.report);
    let stiffness = stiffness_at(&robot, pose, &load).unwrap();
    digits.line("stiffness", stiffness.matrix.transpose().as_slice());
    digits.line("least", &[stiffness.stability.least_stiffness()]);
    let problem = DirectProblem::new(&robot, &stiffness.lengths, &load).unwrap();
    digits.residual(problem.residual(&stiffness.equilibrium).unwrap(), 0, false);
    let slopes = derivatives(&robot, &pose, &load).unwrap();
    digits.line("lengths", slopes.lengths.transpose().as_slice());
    digits.line("tensions", slopes.set_points.transpose().as_slice());
    digits.line("displacement", slopes.displacement().transpose().as_slice());
    digits.line("magnitude", &slopes.magnitude().unwrap());
    digits.report(&slopes.deflection.loaded.report);
    along_path(&robot, position, &mut digits);
    digits.0
}

fn along_path(robot: &Robot, position: [f64; 3], digits: &mut Digits) {
    let (load, none, mut at) = (load(), Load::none(), Vector3::from(position));
    let pose = |at: Vector3<f64>| Pose::with_quaternion(at, [1.0, 0.0, 0.0, 0.0]).unwrap();
    let mut path = InversePath::new(robot);
    let first = path.solve(pose(at), &none).unwrap().solution;
    let start = direct(robot, &first.lengths, &load, DirectStart::Pose(&pose(at))).unwrap().equilibrium;
    let mut tracker = Tracker::new(robot, &first.lengths, &load, &start).unwrap();
    for k in 1..=STEPS {
        at.x = x_of_step(position[0], k);
        let next = path.solve(pose(at), &none).unwrap();
        digits.line("lengths", &next.solution.lengths);
        digits.residual(next.solution.residual, next.solution.iterations, next.jump);
        let step = tracker.step(&next.solution.lengths, &load).unwrap();
        assert!(step.converged);
        digits.residual(tracker.residual(), step.iterations, false);
        digits.pose(&tracker.equilibrium().pose);
        digits.line("tensions", &tracker.equilibrium().tensions());
    }
}

/// The solution of the inverse model at a position, and the states of a tracker from its lengths on: first at
/// rest, then after `still` steps with these lengths, and after [`STEPS`] that reel in the first cable.
pub(crate) fn followed(name: &str, position: [f64; 3], still: usize) -> (InverseSolution, Vec<Equilibrium>) {
    let (robot, load) = (robot(name), load());
    let pose = Pose::with_quaternion(position.into(), [1.0, 0.0, 0.0, 0.0]).unwrap();
    let wanted = inverse(&robot, &pose, &Load::none()).unwrap();
    let mut lengths = wanted.lengths.clone();
    let start = direct(&robot, &lengths, &load, DirectStart::Pose(&pose)).unwrap().equilibrium;
    let mut tracker = Tracker::new(&robot, &lengths, &load, &start).unwrap();
    let mut states = vec![tracker.equilibrium().clone()];
    for k in 0..still + STEPS {
        lengths[0] -= if k < still { 0.0 } else { 1e-5 };
        assert!(tracker.step(&lengths, &load).unwrap().converged);
        states.push(tracker.equilibrium().clone());
    }
    (wanted, states)
}
