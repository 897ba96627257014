//! CAROCA holds 50 kg in the middle of its workspace while cable 2 is lengthened: the platform moves, then
//! cables go slack.

#![allow(clippy::print_stdout)]

use cdpr_robot::{Pose, Robot};
use cdpr_statics::{DirectStart, Load, direct, inverse};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = Robot::from_library("caroca")?;
    let pose = Pose::at(0.0, 0.0, 1.75);
    let load = Load::payload(50.0);
    let wanted = inverse(&robot, &pose, &load)?;
    let mut lengths = wanted.lengths;
    let mut equilibrium = wanted.equilibrium;
    println!("{:>10} {:>24} {:>10} {:>13}  slack", "added", "moved [mm]", "T2 [N]", "residual [N]");
    for added in [0.0, 1e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1] {
        lengths[1] += added;
        let found = direct(&robot, &lengths, &load, DirectStart::Near(&equilibrium))?;
        let moved = 1e3 * (found.equilibrium.pose.position - pose.position);
        let slack: Vec<usize> = found.report.slack.iter().map(|i| i + 1).collect();
        println!(
            "{:8.1} mm {:8.3}{:8.3}{:8.3} {:10.1} {:13.1e}  {slack:?}",
            1e3 * added,
            moved.x,
            moved.y,
            moved.z,
            found.equilibrium.tensions()[1],
            found.report.residual.force
        );
        lengths[1] -= added;
        equilibrium = found.equilibrium;
    }
    Ok(())
}
