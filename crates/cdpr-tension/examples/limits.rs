//! Tensions of CAROCA at one pose for a rising least tension, up to one that no distribution respects.

#![allow(clippy::print_stdout)]

use cdpr_robot::{Pose, Robot, TensionLimits};
use cdpr_tension::{Objective, Problem, distribute};
use nalgebra::{DMatrix, DVector};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = Robot::from_library("caroca")?;
    let pose = Pose::at(1.0, 0.5, 2.0);
    let pulls: Vec<_> = (0..8).map(|i| -robot.span(&pose, i).normalize()).collect();
    let wrench_matrix = DMatrix::from_column_slice(6, 8, robot.wrench_matrix(&pose, &pulls).as_slice());
    let wrench = DVector::from_column_slice(robot.weight(&pose, 0.0).to_vector().as_slice());
    for min in [1.0, 200.0, 400.0, 600.0, 800.0] {
        let limits = &[TensionLimits { min, max: 10290.0 }; 8];
        let problem = Problem { wrench_matrix: &wrench_matrix, wrench: &wrench, limits };
        for objective in [Objective::Nearest(&[0.0; 8]), Objective::LeastSum, Objective::LeastGreatest] {
            match distribute(&problem, objective) {
                Ok(found) => println!("at least {min} N, {objective:?}: {:.1?}", found.tensions),
                Err(error) => println!("at least {min} N: {error}"),
            }
        }
    }
    Ok(())
}
