//! The forces with which cables pull at both ends, and their derivatives.

use crate::common::{caroca, cogiro, stadium};
use crate::pulleys::{led, tilted};
use cdpr_robot::{CableEnd, Parameter, Pose, Robot, Vector3, Wrench};
use cdpr_statics::derivatives::ForceDerivatives;
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, deflection};
use nalgebra::DVector;

const ENDS: [CableEnd; 2] = [CableEnd::Anchor, CableEnd::Exit];

/// A loaded robot at rest, with its lengths.
struct AtRest {
    robot: Robot,
    load: Load,
    lengths: Vec<f64>,
    equilibrium: Equilibrium,
}

impl AtRest {
    fn at(robot: Robot, pose: Pose) -> Self {
        let wrench = Wrench { force: Vector3::new(40.0, -30.0, 10.0), moment: Vector3::zeros() };
        let load = Load { payload: 0.1 * robot.platform.mass, wrench };
        let found = deflection(&robot, &pose, &load).unwrap();
        Self { robot, load, lengths: found.lengths, equilibrium: found.loaded.equilibrium }
    }

    /// The forces at an end after one input, a parameter or the length of a cable, has moved.
    fn moved(&self, column: usize, step: f64, end: CableEnd) -> DVector<f64> {
        let (mut robot, mut lengths) = (self.robot.clone(), self.lengths.clone());
        let parameters = Parameter::of(&robot).len();
        if column < parameters {
            let mut deviations = vec![0.0; parameters];
            deviations[column] = step;
            robot = robot.perturbed(&deviations).unwrap().robot;
        } else {
            lengths[column - parameters - 7] += step;
        }
        let problem = DirectProblem::new(&robot, &lengths, &self.load).unwrap();
        let found = problem.direct(DirectStart::Near(&self.equilibrium)).unwrap().equilibrium;
        column_of(&problem.force_derivatives(&found, end).unwrap())
    }
}

fn column_of(found: &ForceDerivatives) -> DVector<f64> {
    DVector::from_iterator(
        3 * found.forces.len(),
        found.forces.iter().flat_map(|force| force.iter().copied()),
    )
}

fn robots() -> [AtRest; 5] {
    let lawful = include_str!("../../../data/robots/caroca-law.json");
    [
        AtRest::at(caroca(), Pose::at(0.6, -0.4, 1.6)),
        AtRest::at(led(Robot::from_json(lawful).unwrap(), 0.045, 3.0), Pose::at(0.6, -0.4, 1.4)),
        AtRest::at(tilted(led(caroca(), 0.1, 3.0)), Pose::at(0.6, -0.4, 1.6)),
        AtRest::at(tilted(led(cogiro(), 0.1, 1.0)), Pose::at(1.0, -2.0, 2.0)),
        AtRest::at(stadium(), Pose::at(-8.0, -4.667, 10.0)),
    ]
}

#[test]
fn a_cable_pulls_at_its_ends_with_the_tensions_there_and_their_difference_is_its_free_weight() {
    for AtRest { robot, load, lengths, equilibrium } in robots() {
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        let [anchor, exit] = ENDS.map(|end| problem.force_derivatives(&equilibrium, end).unwrap().forces);
        let exit_tensions = equilibrium.exit_tensions(&robot, &lengths);
        let down = robot.gravity.vector().normalize();
        for i in 0..lengths.len() {
            let tension = exit_tensions[i];
            assert!((exit[i].norm() - tension).abs() < 1e-12 * tension, "{}, cable {}", robot.name, i + 1);
            let weight = anchor[i] + exit[i];
            assert!(weight.cross(&down).norm() < 1e-12 * tension);
            let whole = robot.cable(i).weight_per_length * lengths[i];
            assert!(weight.dot(&down) > 0.0 && weight.dot(&down) < whole + 1e-12 * tension);
        }
    }
}

#[test]
fn forces_at_both_ends_change_with_every_parameter_and_length_as_differences_say() {
    for case in robots() {
        let problem = DirectProblem::new(&case.robot, &case.lengths, &case.load).unwrap();
        let parameters = Parameter::of(&case.robot);
        for end in ENDS {
            let exact = problem.force_derivatives(&case.equilibrium, end).unwrap();
            let size = exact.forces.iter().fold(0.0, |size: f64, force| size.max(force.norm()));
            for column in (0..parameters.len()).chain(parameters.len() + 7..exact.per_input.ncols()) {
                let nominal = parameters.get(column).map_or(0.0, |parameter| parameter.nominal(&case.robot));
                // A step that changes forces by about a thousandth, and no number to twice its value.
                let slope = exact.per_input.column(column);
                let step = (1e-3 * size / slope.amax().max(1e-30)).min(1e-4 * nominal.abs().max(1.0));
                let by = |h: f64| (case.moved(column, h, end) - case.moved(column, -h, end)) / (2.0 * h);
                let difference = (by(0.5 * step) * 4.0 - by(step)) / 3.0;
                let error = (difference - slope).amax();
                assert!(
                    error < 1e-6 * slope.amax() + 1e-9 * size / step,
                    "{} {end:?} input {column}: {error:e} of {:e}, step {step:e}",
                    case.robot.name,
                    slope.amax()
                );
            }
        }
    }
}
