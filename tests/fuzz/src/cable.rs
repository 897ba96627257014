//! What must hold for a cable, whatever the numbers.

use cdpr_cable::{
    Cable, CableError, Catenary, ElasticLaw, Entry, FromLeavePoint, Guide, MAX_STRAIN, PiecewiseLaw, Segment,
    Solution, Vector2,
};

/// `w, EA, L, x, z`: an equilibrium with an honest residual, or a typed error.
pub fn end_force([weight_per_length, axial_stiffness, length, x, z]: [f64; 5]) {
    let cable = Cable::linear(weight_per_length, axial_stiffness);
    let end = Vector2::new(x, z);
    match cdpr_cable::end_force(&cable, length, end) {
        Ok(solution) => {
            honest(&solution, &cable, end);
            assert_eq!(solution.catenary.unstrained_length, length);
            assert!(solution.iterations <= 200, "{} iterations", solution.iterations);
        }
        Err(error) => typed(&error, &[weight_per_length, axial_stiffness, length, x, z]),
    }
}

/// `w, EA, L, x, z, T_1, κ_0, κ_1`: an equilibrium on a law of two pieces with an honest residual, or a typed
/// error.
pub fn law([weight_per_length, axial_stiffness, length, x, z, kink, soft, stiff]: [f64; 8]) {
    let segments = [Segment { tension: 0.0, ratio: soft }, Segment { tension: kink, ratio: stiff }];
    let law = match PiecewiseLaw::new(0.0, &segments) {
        Ok(law) => law,
        Err(error) => return typed(&error, &[kink, soft, stiff]),
    };
    let cable =
        Cable { law: ElasticLaw::Piecewise(&law), ..Cable::linear(weight_per_length, axial_stiffness) };
    let end = Vector2::new(x, z);
    match cdpr_cable::end_force(&cable, length, end) {
        Ok(Solution { catenary, residual, .. }) => {
            finite("force", catenary.force.as_slice());
            if !catenary.is_slack_and_weightless() {
                finite("stiffness", catenary.in_plane_stiffness().as_slice());
            }
            let strain = catenary.cable.strain(catenary.anchor_tension() + catenary.weight());
            let size = length * (1.0 + strain) + end.norm();
            assert!(residual <= 1e-12 * size, "residual {residual:e} is accepted for a size of {size:e}");
        }
        Err(error) => typed(&error, &[weight_per_length, axial_stiffness, length, x, z]),
    }
}

/// `w, EA, L, x, z, d, r`: an equilibrium over a lead and a pulley with a vertical axis, with an honest
/// residual, or a typed error.
pub fn pulley([weight_per_length, axial_stiffness, length, x, z, lead, radius]: [f64; 7]) {
    let entry = if z > 0.0 { Entry::Downwards } else { Entry::Upwards };
    let guide = Some(Guide { lead, radius, entry });
    let cable = Cable { guide, ..Cable::linear(weight_per_length, axial_stiffness) };
    let end = Vector2::new(x, z);
    // Of lengths far from each other, and of a cable that its own weight stretches by a tenth, no digits are
    // left for an answer.
    let lengths = [length, x.hypot(z), lead, radius].map(|length| length == 0.0 || ordinary(length));
    let sound = ordinary(axial_stiffness) && 10.0 * weight_per_length * length <= axial_stiffness;
    let ordinary = sound && lengths == [true; 4];
    match cdpr_cable::end_force(&cable, length, end) {
        Ok(Solution { catenary, residual, .. }) => {
            finite("force", catenary.force.as_slice());
            assert!(catenary.force.x >= 0.0, "fx {:e}", catenary.force.x);
            if ordinary && !catenary.is_slack_and_weightless() {
                finite("stiffness", catenary.in_plane_stiffness().as_slice());
                finite("leave_point", catenary.leave_point().as_slice());
            }
            let strain = catenary.cable.strain(catenary.anchor_tension() + catenary.weight().abs());
            let size = length * (1.0 + strain) + end.norm() + lead + 4.0 * radius;
            let largest = if ordinary { 1e-9 * size } else { size };
            assert!(residual <= largest, "residual {residual:e} is accepted for a size of {size:e}");
        }
        Err(CableError::NotConverged { residual, .. }) => assert!(!ordinary, "not converged: {residual:e}"),
        // Two lengths of 1e30 m add up to more than is admissible.
        Err(_) if [x, z, radius].iter().any(|length| length.abs() > 0.1 * LARGEST) => {}
        Err(error) => typed(&error, &[weight_per_length, axial_stiffness, length, x, z, lead, radius]),
    }
}

fn ordinary(number: f64) -> bool {
    (1e-3..=1e6).contains(&number)
}

/// `w, EA, x, z, tension`: a length with an honest residual and the wanted tension, or a typed error.
pub fn length_for_tension([weight_per_length, axial_stiffness, x, z, tension]: [f64; 5]) {
    let cable = Cable::linear(weight_per_length, axial_stiffness);
    let end = Vector2::new(x, z);
    match cdpr_cable::length_for_tension(&cable, end, tension) {
        Ok(solution) => {
            honest(&solution, &cable, end);
            let Catenary { unstrained_length: length, .. } = solution.catenary;
            assert!(length.is_finite() && length > 0.0, "length {length:e}");
            // A unit in the last place of the length, or of the end position, is worth this tension.
            let stiffness = axial_stiffness / length;
            let rounding = 32.0 * f64::EPSILON * stiffness * (length + end.norm());
            let off = (solution.catenary.anchor_tension() - tension).abs();
            assert!(off <= 1e-8 * tension + rounding, "tension off by {off:e} of {tension:e}");
        }
        Err(error) => typed(&error, &[weight_per_length, axial_stiffness, x, z, tension]),
    }
}

/// `w, EA, L, fx, fz, s`: all that a valid catenary is asked, at the arc length `s`, is finite.
pub fn catenary([weight_per_length, axial_stiffness, unstrained_length, fx, fz, s]: [f64; 6]) {
    let cable = Cable::linear(weight_per_length, axial_stiffness);
    let ordinary = |value: f64| (SMALLEST..=LARGEST).contains(&value);
    let positive = [axial_stiffness, unstrained_length].into_iter().all(ordinary);
    // A weightless cable with next to no tension has next to no stiffness across, and no digits of it.
    let tension = fx.hypot(fz);
    let taut = weight_per_length > 0.0 || tension == 0.0 || tension >= SMALLEST;
    let forces = taut && (0.0..=LARGEST).contains(&fx) && fz.abs() <= LARGEST;
    if cable.validate().is_err() || !positive || !forces || s.is_nan() {
        return;
    }
    let catenary = Catenary { cable, unstrained_length, force: Vector2::new(fx, fz) };
    finite("anchor_tension", &[catenary.anchor_tension()]);
    finite("exit_tension", &[catenary.exit_tension()]);
    finite("in_plane_stiffness", catenary.in_plane_stiffness().as_slice());
    finite("stiffness", catenary.stiffness(Vector2::new(0.6, 0.8)).as_slice());
    if catenary.is_slack_and_weightless() {
        return;
    }
    finite("end_position", catenary.end_position().as_slice());
    let response = catenary.response();
    finite("response.end", &response.end);
    finite("response.flexibility", &response.flexibility);
    finite("response.lateral_flexibility", &[response.lateral_flexibility]);
    finite("response.end_per_length", &response.end_per_length);
    finite("complementary_energy", &[catenary.complementary_energy()]);
    finite("potential_energy", &[catenary.potential_energy()]);
    finite("sag", &[catenary.sag()]);
    finite("point", catenary.point(FromLeavePoint(s)).as_slice());
    finite("tension", &[catenary.tension(FromLeavePoint(s))]);
    finite("lowest_arc_length", &[catenary.lowest_arc_length().0]);
    finite("lowest_point", catenary.lowest_point().as_slice());
    for point in catenary.profile(5) {
        finite("profile", point.as_slice());
    }
}

/// Magnitudes (SI) between which no product of a few overflows and no quotient: what is asked of a catenary
/// has an answer there. Beyond, the functions that check their inputs refuse them.
const SMALLEST: f64 = 1e-30;
const LARGEST: f64 = 1e30;

fn honest(solution: &Solution, cable: &Cable, end: Vector2<f64>) {
    let Solution { catenary, residual, .. } = solution;
    finite("force", catenary.force.as_slice());
    finite("residual", &[*residual]);
    assert!(catenary.force.x >= 0.0, "fx {:e}", catenary.force.x);
    assert_eq!(catenary.cable.axial_stiffness, cable.axial_stiffness);
    // A limp cable has no shape, and its end is anywhere within its length.
    if catenary.is_slack_and_weightless() {
        assert!(
            end.norm() <= catenary.unstrained_length * (1.0 + 4.0 * f64::EPSILON),
            "a limp cable ends beyond its length"
        );
        return;
    }
    // What the sums of the end position are made of: the cable, its stretch by tension and weight, the wanted
    // end.
    let strain = (catenary.anchor_tension() + catenary.weight()) / cable.axial_stiffness;
    let size = catenary.unstrained_length * (1.0 + strain) + end.norm();
    let open = (catenary.end_position() - end).norm();
    assert!((open - residual).abs() <= 8.0 * f64::EPSILON * size, "residual {residual:e} is {open:e}");
    assert!(*residual <= 1e-12 * size, "residual {residual:e} is accepted for a size of {size:e}");
}

fn typed(error: &CableError, inputs: &[f64]) {
    assert!(!error.to_string().is_empty());
    match error {
        // What is refused is indeed none of the inputs, or their combination.
        CableError::InvalidInput { field, value, .. } => {
            assert!(
                *field == "end" || inputs.iter().any(|input| input.to_bits() == value.to_bits()),
                "{field} {value:e}"
            );
        }
        CableError::AtPulley { distance } => assert!(distance.is_finite() && *distance >= 0.0, "{error}"),
        CableError::TensionTooSmall { tension, least } => {
            assert!(tension.is_finite() && least.is_finite(), "{error}");
            assert!(least >= tension, "{least:e} is refused for being more than {tension:e}");
        }
        CableError::Overstrained { tension, strain } => {
            assert!(*tension > 0.0 && *strain > MAX_STRAIN, "{error}");
        }
        CableError::NotConverged { residual, .. } => panic!("not converged: {residual:e}"),
    }
}

fn finite(what: &str, numbers: &[f64]) {
    assert!(numbers.iter().all(|number| number.is_finite()), "{what} is {numbers:?}");
}
