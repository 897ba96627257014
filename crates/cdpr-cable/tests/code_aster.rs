//! A heavy cable between two points at one height, cold and warm, as the documentation of Code_Aster has it.

use cdpr_cable::{Cable, Vector2, end_force};
use cdpr_evidence::accept;

/// Documents V6.02.114 and V6.05.116: span and length 325 m, and 39.26 K more with an expansion of
/// 2.3e-5 1/K.
#[test]
fn a_heavy_cable_sags_as_code_aster_documents_it() {
    const SECTION: f64 = 2.2783e-4;
    let cable = Cable::linear(2844.23 * 9.81 * SECTION, 5.70e10 * SECTION);
    for (warmer, sag) in [(0.0, 6.35216147), (39.26, 8.19545175)] {
        let length = 325.0 * (1.0 + 2.3e-5 * warmer);
        let found = end_force(&cable, length, Vector2::new(325.0, 0.0)).unwrap();
        accept("V-CABLE-011", (found.catenary.sag() - sag).abs());
    }
}
