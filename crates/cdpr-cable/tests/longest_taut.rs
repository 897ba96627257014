//! How long a taut cable can be.

use cdpr_cable::LONGEST_TAUT;

/// Tension at A over half the weight of a chord's length, of an inextensible catenary over a span of the
/// slope `z` and length one, and its length.
fn catenary(slope: f64, u: f64) -> [f64; 2] {
    let h = (1.0 + slope * slope).sqrt().recip();
    let z = slope * h;
    let length = (z * z + (h * u.sinh() / u).powi(2)).sqrt();
    let force = [h / u, z / u.tanh() + length];
    [force[0].hypot(force[1]), length]
}

#[test]
fn a_cable_whose_tension_rises_as_it_is_pulled_is_shorter_than_the_bound() {
    let mut longest: f64 = 0.0;
    for k in -400..=400 {
        let slope = (f64::from(k) * 0.02).sinh();
        // The least tension lies where it stops to fall with u.
        let us = (1..4000).map(|j| 0.002 * f64::from(j));
        let taut = us.take_while(|u| catenary(slope, u + 1e-3)[0] <= catenary(slope, *u)[0]);
        let at_least = taut.last().map_or(0.0, |u| catenary(slope, u)[1]);
        longest = longest.max(at_least);
    }
    assert!((1.257..LONGEST_TAUT).contains(&longest), "{longest}");
}
