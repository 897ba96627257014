//! Prints the random robots of the tests of the inverse model, one line of JSON each, for an independent
//! program: `cargo run -p cdpr-statics --example drawn_robots -- 200`.

#![allow(clippy::print_stdout)]

#[path = "../tests/drawn.rs"]
mod drawn;

use drawn::{Drawn, drawn};
use serde_json::json;

fn main() -> Result<(), std::num::ParseIntError> {
    let count = std::env::args().nth(1).map_or(Ok(200), |count| count.parse())?;
    let all = (0..).filter_map(|seed| Some((seed, drawn(seed)?)));
    for (seed, Drawn { robot, pose, load, tensions }) in all.take(count) {
        let cables = robot.cables.iter().map(|cable| {
            let properties = &cable.properties;
            json!({
                "exit": cable.exit_point.as_slice(),
                "anchor": cable.anchor_point.as_slice(),
                "weight": robot.gravity.magnitude() * properties.linear_density,
                "stiffness": properties.youngs_modulus * properties.section,
            })
        });
        let line = json!({
            "seed": seed,
            "gravity": robot.gravity.magnitude(),
            "mass": robot.platform.mass,
            "center_of_mass": robot.platform.center_of_mass.as_slice(),
            "limits": [robot.tension_limits.min, robot.tension_limits.max],
            "position": pose.position.as_slice(),
            // Row by row.
            "rotation": pose.rotation.matrix().transpose().as_slice(),
            "force": load.wrench.force.as_slice(),
            "moment": load.wrench.moment.as_slice(),
            "cables": cables.collect::<Vec<_>>(),
            "drawn": tensions,
        });
        println!("{line}");
    }
    Ok(())
}
