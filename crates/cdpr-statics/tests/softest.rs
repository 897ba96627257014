//! Derivatives of the lowest stiffness against central differences.

use crate::common::{caroca, cogiro, robots};
use crate::free_derivatives::with_few_cables;
use crate::pulleys::{led, tilted};
use cdpr_robot::{
    CableProperties, Coordinate, Parameter, Platform, Pose, Robot, RobotCable, Vector3, Vector6,
};
use cdpr_statics::{
    Derivatives, DirectProblem, Load, StaticsError, WantedPose, deflection, derivatives, inverse,
};

struct Case {
    robot: Robot,
    pose: Pose,
    payload: f64,
    free: Vec<Coordinate>,
}

impl Case {
    fn of(robot: Robot, pose: Pose, payload: f64) -> Self {
        // No two motions are alike at an oblique pose.
        let turn = if robot.plane.is_some() { Vector3::zeros() } else { Vector3::new(4e-3, -6e-3, 3e-3) };
        Self { robot, pose: pose.moved(Vector3::zeros(), turn), payload, free: Vec::new() }
    }

    fn derivatives(&self) -> Result<Derivatives, StaticsError> {
        derivatives(&self.robot, WantedPose::at(&self.pose).free(&self.free), &Load::payload(self.payload))
    }

    /// Least stiffness [N/m] in (dp, `length` dφ), if one input is moved.
    fn softest(&self, length: f64, column: usize, step: f64) -> f64 {
        let parameters = Parameter::of(&self.robot).len();
        let mut deviations = vec![0.0; parameters];
        let (mut payload, mut motion) = (self.payload, Vector6::zeros());
        match column.checked_sub(parameters) {
            None => deviations[column] = step,
            Some(0) => payload += step,
            Some(k) => motion[k - 1] = step,
        }
        let moved = self.robot.perturbed(&deviations).unwrap();
        let load = Load::payload(payload);
        let pose = self.pose.moved(motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
        let found = deflection(
            &moved.robot,
            WantedPose::at(&pose).free(&self.free).tension_offsets(&moved.tension_offsets),
            &load,
        )
        .unwrap();
        let problem = DirectProblem::new(&moved.robot, &found.lengths, &load).unwrap();
        let problem = problem.with_characteristic_length(length);
        problem.stability(&found.loaded.equilibrium).unwrap().least_stiffness()
    }

    fn step(&self, column: usize) -> f64 {
        let parameters = Parameter::of(&self.robot);
        match parameters.get(column) {
            Some(one @ (Parameter::Mass | Parameter::LinearDensity | Parameter::YoungsModulus)) => {
                3e-3 * one.nominal(&self.robot)
            }
            Some(Parameter::TensionOffset(_)) => 1e-3 * self.robot.platform.mass,
            Some(Parameter::Tilt(..)) => 1e-3,
            Some(Parameter::Gravity(_)) => 3e-3,
            None if column == parameters.len() => 3e-3 * self.robot.platform.mass,
            _ => 3e-4 * self.robot.platform_size().clamp(0.1, 1.0),
        }
    }
}

/// Six differences, twice extrapolated, and what they leave open.
fn difference(case: &Case, length: f64, column: usize, h: f64) -> (f64, f64) {
    let slope = |h: f64| (case.softest(length, column, h) - case.softest(length, column, -h)) / (2.0 * h);
    let [wide, middle, narrow] = [h, 0.5 * h, 0.25 * h].map(slope);
    let (once, again) = ((4.0 * middle - wide) / 3.0, (4.0 * narrow - middle) / 3.0);
    ((16.0 * again - once) / 15.0, (again - once).abs())
}

/// How many derivatives of a case the differences tell to 1e-4, and the largest relative error of these.
fn check(case: &Case) -> (usize, f64) {
    let name = &case.robot.name;
    let load = Load::payload(case.payload);
    let found = case.derivatives().unwrap();
    let (value, slopes) = found.least_stiffness(&case.robot, &load).unwrap();
    let length = found.deflection.loaded.stability.characteristic_length();
    let alone = case.softest(length, 0, 0.0);
    let (mut compared, mut worst) = (0, 0.0_f64);
    // Eigenvalues are known to the rounding of the greatest stiffness.
    assert!((value - alone).abs() <= 1e-10 * value.abs(), "{name}: {value} {alone}");
    assert_eq!(slopes.len(), found.inputs.count());
    let parameters = &found.inputs.parameters;
    for (column, exact) in slopes.iter().copied().enumerate() {
        let held =
            column > parameters.len() && !case.robot.freedoms().contains(column - parameters.len() - 1);
        if held || found.one_sided.iter().any(|one| one.column == column) {
            continue;
        }
        let h = case.step(column);
        let (difference, open) = difference(case, length, column, h);
        let rounding = 1e-10 * value.abs() / h;
        let input = parameters.get(column).map_or_else(|| format!("{column}"), ToString::to_string);
        let error = (difference - exact).abs();
        assert!(
            error <= open + rounding + 1e-7 * exact.abs(),
            "{name} {input}: {exact} and not {difference}, error {error:e}, open {open:e}"
        );
        if open + rounding <= 1e-4 * exact.abs() {
            compared += 1;
            worst = worst.max(error / exact.abs());
        }
    }
    println!("{name}: {compared} of {} compared, worst {worst:.1e}", found.inputs.count());
    (compared, worst)
}

#[test]
fn the_stiffness_of_five_robots_changes_as_differences_say() {
    for (robot, pose) in robots() {
        let payload = 0.2 * robot.platform.mass;
        let (compared, _) = check(&Case::of(robot, pose, payload));
        assert!(compared >= 38, "{compared}");
    }
}

#[test]
fn it_changes_over_pulleys_and_on_a_base_that_is_not_level_as_differences_say() {
    for robot in [led(caroca(), 0.1, 3.0), led(cogiro(), 0.1, 3.0)] {
        for robot in [robot.clone(), tilted(robot)] {
            let (compared, _) = check(&Case::of(robot, Pose::at(0.8, -0.5, 1.9), 20.0));
            assert!(compared >= 38, "{compared}");
        }
    }
}

#[test]
fn it_changes_with_few_cables_as_differences_say() {
    for (robot, pose, free, payload) in with_few_cables() {
        // Beside a rest of the platform the search is short.
        let rest =
            inverse(&robot, WantedPose::at(&pose).free(&free), &Load::none()).unwrap().equilibrium.pose;
        let (compared, _) = check(&Case { free, ..Case::of(robot, rest, payload) });
        assert!(compared >= 15, "{compared}");
    }
}

#[test]
fn a_cable_that_hangs_vertically_has_derivatives() {
    // A point mass below its exit point on one cable, beside three that hold it aside.
    let rope = CableProperties::linear(1.0, 0.5, 4e4);
    let exits = [[0.0, 0.0], [3.0, 0.5], [-2.0, 2.0], [-1.5, -2.0]];
    let cables =
        exits.map(|[x, y]| RobotCable::between(Vector3::new(x, y, 5.0), Vector3::zeros(), rope.clone()));
    let platform = Platform { point: true, ..Platform::new(30.0, Vector3::zeros()) };
    let robot = Robot { platform, cables: cables.to_vec(), ..cogiro() };
    let case = Case { robot, pose: Pose::at(0.0, 0.0, 2.0), payload: 5.0, free: Vec::new() };
    let (compared, _) = check(&case);
    assert!(compared >= 10, "{compared}");
}

#[test]
fn two_motions_of_one_stiffness_have_no_derivative() {
    // A point mass on one cable swings in all directions alike.
    let rope = CableProperties::linear(1.0, 0.5, 4e4);
    let cable = RobotCable::between(Vector3::new(0.0, 0.0, 5.0), Vector3::zeros(), rope);
    let platform = Platform { point: true, ..Platform::new(30.0, Vector3::zeros()) };
    let robot = Robot { platform, cables: vec![cable], ..cogiro() };
    let free = vec![Coordinate::X, Coordinate::Y];
    let case = Case { robot, pose: Pose::at(0.0, 0.0, 2.0), payload: 5.0, free };
    let error = case.derivatives().unwrap().least_stiffness(&case.robot, &Load::payload(5.0)).unwrap_err();
    assert!(error.to_string().contains("two motions"), "{error}");
}
