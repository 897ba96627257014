//! Forces and sag of a cable over a span of 4.1 m, 1.7 m down, from taut to hanging in a loop.

#![allow(clippy::print_stdout)]

use cdpr_cable::{Cable, CableError, Vector2, end_force};

fn main() -> Result<(), CableError> {
    let cable = Cable::linear(0.9957, 1.284e6);
    let end = Vector2::new(4.1, -1.7);
    println!(
        "{:>12} {:>12} {:>12} {:>10} {:>10}",
        "length [m]", "T at A [N]", "T at B [N]", "sag [mm]", "steps"
    );
    for excess in [-1e-3, -1e-4, 0.0, 1e-4, 1e-3, 1e-2, 1e-1, 1.0] {
        let length = end.norm() * (1.0 + excess);
        let solution = end_force(&cable, length, end)?;
        let catenary = solution.catenary;
        println!(
            "{length:12.6} {:12.4} {:12.4} {:10.3} {:10}",
            catenary.anchor_tension(),
            catenary.exit_tension(),
            1e3 * catenary.sag(),
            solution.iterations
        );
    }
    Ok(())
}
