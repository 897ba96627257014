//! What follows from the force at the end of a cable: its end position, flexibility, stiffness and energy.
//!
//! The equations of a linear cable are in `kernel/response.rs`, those of one with a piecewise linear law in
//! `kernel/material.rs`.

use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::catenary::guided;
use crate::kernel::{Material, Response, Terms, stiffness_in_space};
use crate::law::ElasticLaw;
use cdpr_number::Real;
use nalgebra::{Matrix2, Matrix3, Vector2};

impl Cable<'_> {
    /// The response to the force `force` [N] at A of a cable with this law, over any kind of number: see
    /// [`crate::kernel::response`].
    #[inline]
    pub(crate) fn response<T: Real>(&self, numbers: &Numbers<T>, force: [T; 2]) -> Response<T> {
        match &self.guide {
            None => self.free_response(numbers, force),
            Some(guide) => guided::response(self, guide, numbers, force),
        }
    }

    /// The response of a cable without its guide.
    #[inline]
    pub(crate) fn free_response<T: Real>(&self, numbers: &Numbers<T>, force: [T; 2]) -> Response<T> {
        self.material(numbers).any_response(numbers.length, force)
    }
}

impl Catenary<'_> {
    /// Position `(x, z)` of A relative to B [m], (C1)-(C2).
    pub fn end_position(&self) -> Vector2<f64> {
        match (&self.cable.guide, self.cable.law) {
            (None, ElasticLaw::Linear) => self.terms().end_position().into(),
            (None, ElasticLaw::Piecewise(_)) => self.response().end.into(),
            (Some(_), _) => self.leave_point() + self.free().end_position(),
        }
    }

    /// Closure residual [m] of an anchor point at `end = (x, z)` [m]: the vector from the computed end to it.
    ///
    /// A slack cable without weight has no end position; its residual is what it is too short
    /// ([`closure_of_slack`]).
    pub fn closure(&self, end: Vector2<f64>) -> Vector2<f64> {
        if self.is_slack_and_weightless() {
            self.cable.closure_of_slack(end.into(), self.length_at_rest()).into()
        } else {
            end - self.end_position()
        }
    }

    /// End position, flexibility and tension, as [`crate::kernel::response`] gives them for a linear cable.
    #[inline]
    pub fn response(&self) -> Response<f64> {
        self.cable.response(&self.cable.numbers(self.unstrained_length), self.force.into())
    }

    /// In-plane stiffness `d(fx, fz)/d(x, z)` [N/m], `C⁻¹`; zero for a slack cable without weight.
    #[inline]
    pub fn in_plane_stiffness(&self) -> Matrix2<f64> {
        if self.is_slack_and_weightless() { Matrix2::zeros() } else { self.response().stiffness_matrix() }
    }

    /// Stiffness `dF/dr` [N/m] of the end force in three dimensions, `z` up.
    ///
    /// `azimuth` is the horizontal unit vector from B towards A (any unit vector if A is right above or below
    /// B).
    #[inline]
    pub fn stiffness(&self, azimuth: Vector2<f64>) -> Matrix3<f64> {
        if self.is_slack_and_weightless() {
            return Matrix3::zeros();
        }
        let response = self.response();
        let lateral = 1.0 / response.lateral_flexibility;
        stiffness_in_space(response.in_plane_stiffness(), lateral, azimuth.into()).into()
    }

    /// Complementary energy U*(f) [J], (C6): strictly convex, with the end position for its gradient.
    pub fn complementary_energy(&self) -> f64 {
        match (&self.cable.guide, self.cable.law) {
            (None, ElasticLaw::Linear) => self.terms().complementary_energy(),
            (None, ElasticLaw::Piecewise(_)) => self.material().complementary_energy(&self.terms()),
            (Some(_), _) => self.force.dot(&self.end_position()) - self.potential_energy(),
        }
    }

    /// Potential energy V [J], (C7): elastic energy plus the work done against gravity.
    ///
    /// It is zero for a cable at rest with its weight at the height of B. As a function of the end position
    /// it has the force at A for its gradient; with a guide but for the part that is not conservative (C25).
    pub fn potential_energy(&self) -> f64 {
        match (&self.cable.guide, self.cable.law) {
            (None, ElasticLaw::Linear) => self.terms().potential_energy(),
            (None, ElasticLaw::Piecewise(_)) => self.material().potential_energy(&self.terms()),
            (Some(guide), _) => guided::potential_energy(self, guide),
        }
    }

    fn material(&self) -> Material<'_, f64> {
        self.cable.material(&self.cable.numbers(self.unstrained_length))
    }

    /// The quantities that the equations of a cable share.
    fn terms(&self) -> Terms<f64> {
        self.material().any_terms(self.unstrained_length, self.force.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::CableError;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    const CABLE: Cable = Cable::linear(0.995_715, 1.284_283e6);

    fn catenary(cable: Cable<'static>, length: f64, fx: f64, fz: f64) -> Catenary<'static> {
        Catenary { cable, unstrained_length: length, force: Vector2::new(fx, fz) }
    }

    #[test]
    fn a_catenary_without_a_defined_end_is_refused() {
        let refused = |cable, length, fx, fz| match Catenary::new(cable, length, Vector2::new(fx, fz)) {
            Err(CableError::InvalidInput { field, .. }) => field,
            other => panic!("{other:?}"),
        };
        assert_eq!(refused(CABLE, 0.0, 1.0, 1.0), "unstrained_length");
        assert_eq!(refused(CABLE, 1.0, -1.0, 1.0), "force.x");
        assert_eq!(refused(CABLE, 1.0, 1.0, f64::NAN), "force.z");
        assert_eq!(refused(Cable { weight_per_length: 0.0, ..CABLE }, 1.0, 0.0, 0.0), "force");
        assert_eq!(refused(Cable { axial_stiffness: -1.0, ..CABLE }, 1.0, 1.0, 0.0), "axial_stiffness");
        assert!(Catenary::new(CABLE, 1.0, Vector2::zeros()).is_ok());
    }

    #[test]
    fn a_weightless_cable_is_a_spring() {
        let cable = Cable::linear(0.0, 1e4);
        let spring = catenary(cable, 2.0, 30.0, 40.0);
        let expected = Vector2::new(0.6, 0.8) * 2.0 * (1.0 + 50.0 / 1e4);
        assert_relative_eq!(spring.end_position(), expected, max_relative = 1e-15);
        assert_relative_eq!(spring.potential_energy(), 0.5 * 50.0 * 50.0 * 2.0 / 1e4, max_relative = 1e-10);
    }

    #[test]
    fn the_textbook_form_agrees_where_it_does_not_cancel() {
        let (w, ea, length, fx, fz) = (20.0, 1e5, 6.0, 50.0, 90.0);
        let v0: f64 = fz - w * length;
        let x = fx * length / ea + fx / w * ((fz / fx).asinh() - (v0 / fx).asinh());
        let z = (fz - w * length / 2.0) * length / ea + (fz.hypot(fx) - v0.hypot(fx)) / w;
        let end = catenary(Cable::linear(w, ea), length, fx, fz).end_position();
        assert_relative_eq!(end, Vector2::new(x, z), max_relative = 1e-14);
    }

    #[test]
    fn a_straight_spring_is_as_stiff_across_as_its_tension_makes_it() {
        let spring = catenary(Cable::linear(0.0, 1e6), 10.0, 1e-11, 1e-11);
        // EA/L along and T/L across the direction (1, 1).
        let k = spring.in_plane_stiffness();
        assert_relative_eq!(k, Matrix2::new(5e4, 5e4, 5e4, 5e4), max_relative = 1e-12);
    }

    #[test]
    fn a_stiff_taut_cable_keeps_the_digits_of_its_energy() {
        // f·r and U* are 1e5 J each; 40-digit arithmetic gives their difference.
        let cable = Cable::linear(1e-3, 1e9);
        let taut = catenary(cable, 100.0, 800.0, 600.0);
        assert_relative_eq!(taut.potential_energy(), 3.0497866520994881, max_relative = 1e-14);
    }

    #[test]
    fn a_vertical_folded_cable_is_regular() {
        let folded = catenary(CABLE, 5.0, 0.0, 3.0);
        let response = folded.response();
        assert_eq!(response.end[0], 0.0);
        assert!(response.flexibility.iter().all(|c| c.is_finite()));
        assert!(response.lateral_flexibility > 0.0);
        assert!(folded.stiffness(Vector2::x()).iter().all(|k| k.is_finite()));
    }

    #[test]
    fn a_limp_cable_has_no_stiffness() {
        let limp = catenary(Cable::linear(0.0, 1e4), 2.0, 0.0, 0.0);
        assert_eq!(limp.stiffness(Vector2::x()), Matrix3::zeros());
    }

    /// Cables from taut to folded: weights, stiffnesses, lengths and forces over many decades.
    fn any_catenary() -> impl Strategy<Value = Catenary<'static>> {
        (-2.0..2.0f64, 4.0..8.0f64, -0.3..2.0f64, -2.0..3.0f64, -3.0..3.0f64).prop_map(
            |(w, ea, l, fx, fz)| {
                let cable = Cable::linear(10f64.powf(w), 10f64.powf(ea));
                let length = 10f64.powf(l);
                let weight = cable.weight_per_length * length;
                catenary(cable, length, weight * 10f64.powf(fx), weight * fz.sinh())
            },
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn the_gradient_of_the_complementary_energy_is_the_end_position(c in any_catenary()) {
            let step = 1e-5 * (c.anchor_tension() + c.weight());
            let slope = |d: Vector2<f64>| {
                let at = |h: f64| Catenary { force: c.force + d * h, ..c }.complementary_energy();
                (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step)
            };
            prop_assume!(c.force.x > 100.0 * step);
            let end = c.end_position();
            let scale = end.norm() + c.unstrained_length;
            prop_assert!((slope(Vector2::x()) - end.x).abs() < 1e-8 * scale);
            prop_assert!((slope(Vector2::y()) - end.y).abs() < 1e-8 * scale);
        }

        #[test]
        fn the_flexibility_is_the_derivative_of_the_end_position(c in any_catenary()) {
            let step = 1e-4 * c.force.x;
            let flexibility = c.response().flexibility_matrix();
            for (j, direction) in [Vector2::x(), Vector2::y()].into_iter().enumerate() {
                let at = |h: f64| Catenary { force: c.force + direction * h, ..c }.end_position();
                let differences = 8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step));
                let slope = differences / (12.0 * step);
                let rounding = 20.0 * f64::EPSILON * c.end_position().norm().max(c.unstrained_length) / step;
                let error = (slope - flexibility.column(j)).norm();
                let size = flexibility.norm();
                prop_assert!(error < 1e-7 * size + rounding, "{error:e} of {size:e}");
            }
        }

        #[test]
        fn the_flexibility_is_positive_definite(c in any_catenary()) {
            let f = c.response().flexibility_matrix();
            prop_assert!(f.m11 > 0.0 && f.m22 > 0.0 && f.determinant() > 0.0);
            let products = f.m11 * f.m22 + f.m12 * f.m21;
            prop_assert!((c.response().determinant - f.determinant()).abs() < 1e-14 * products);
        }

        #[test]
        fn the_lateral_stiffness_is_the_horizontal_force_over_the_distance(c in any_catenary()) {
            let response = c.response();
            prop_assert!((response.end[0] / response.lateral_flexibility / c.force.x - 1.0).abs() < 1e-13);
        }

        #[test]
        fn paying_out_cable_between_held_ends_changes_the_force_as_its_derivative_says(c in any_catenary()) {
            let end = c.end_position();
            prop_assume!(end.x > 1e-3 * end.norm() && c.exit_tension() > 1e-2 * c.weight());
            let step = 1e-5 * c.anchor_tension().min(c.weight()) / c.response().force_per_length().norm();
            let solve = |h: f64| crate::end_force(&c.cable, c.unstrained_length + h, end).unwrap();
            let at = |h: f64| solve(h).catenary.force;
            let slope = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
            // The force itself is known to the rounding of the end position times the stiffness.
            let rounding = 1e-14 * c.in_plane_stiffness().norm() * (end.norm() + c.unstrained_length) / step;
            prop_assert!((slope - c.response().force_per_length()).norm() < 1e-4 * slope.norm() + rounding);
        }

        #[test]
        fn a_little_more_cable_at_b_moves_a_along_the_tangent_at_b(c in any_catenary()) {
            let step = 1e-4 * c.unstrained_length;
            let at = |h: f64| Catenary { unstrained_length: c.unstrained_length + h, ..c }.end_position();
            let slope = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
            prop_assume!(c.exit_tension() > 1e-2 * c.weight());
            prop_assert!((slope - Vector2::from(c.response().end_per_length)).norm() < 1e-6);
        }
    }
}
