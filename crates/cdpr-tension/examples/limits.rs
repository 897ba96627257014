//! Tensions of CAROCA at one pose for a rising least tension, up to one that no distribution respects.

#![allow(clippy::print_stdout)]

use cdpr_robot::{Pose, Robot, TensionLimits};
use cdpr_tension::{Problem, distribute};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json"))?;
    let pose = Pose::at(1.0, 0.5, 2.0);
    let pulls: Vec<_> = (0..8).map(|i| -robot.span(&pose, i).normalize()).collect();
    let wrench_matrix = robot.wrench_matrix(&pose, &pulls);
    let wrench = robot.weight(&pose, 0.0).to_vector();
    for min in [1.0, 200.0, 400.0, 600.0, 800.0] {
        let limits = &[TensionLimits { min, max: 10290.0 }; 8];
        match distribute(&Problem { wrench_matrix: &wrench_matrix, wrench, reference: &[0.0; 8], limits }) {
            Ok(solution) => println!("at least {min} N, {:?}: {:.1?}", solution.method, solution.tensions),
            Err(error) => println!("at least {min} N: {error}"),
        }
    }
    Ok(())
}
