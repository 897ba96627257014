//! The shape of a cable in equilibrium, along its unstrained arc length `s` from the exit point B or, with a
//! pulley, from its leave point.
//!
//! The piece of cable between B and `s` is itself a catenary of unstrained length `s` that carries
//! `(fx, V0 + w s)` at its end: every point comes from the same equations (C1)-(C2) as the end.

use crate::catenary::Catenary;
use nalgebra::Vector2;

/// Unstrained arc length [m] from B, the exit point or the leave point of a pulley: from where the free part
/// of a cable begins.
///
/// A whole unstrained length begins at the winch and includes lead and arc: the two must not be mixed.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct FromLeavePoint(pub f64);

impl<'a> Catenary<'a> {
    /// The piece of a cable without a guide between B and the unstrained arc length `s`, which is clamped to
    /// `[0, Lf]`.
    fn up_to(&self, s: f64) -> Catenary<'a> {
        let s = s.clamp(0.0, self.unstrained_length);
        let vertical = self.exit_vertical_force() + self.cable.weight_per_length * s;
        Catenary { unstrained_length: s, force: Vector2::new(self.force.x, vertical), ..*self }
    }

    fn free_point(&self, s: f64) -> Vector2<f64> {
        if s <= 0.0 { Vector2::zeros() } else { self.up_to(s).end_position() }
    }

    /// Position `(x, z)` [m] of the point at `s` of the free part, which is clamped to its two ends.
    ///
    /// With a guide the origin is where the cable enters it.
    pub fn point(&self, FromLeavePoint(s): FromLeavePoint) -> Vector2<f64> {
        self.leave_point() + self.free().free_point(s)
    }

    /// Tension [N] at `s` of the free part, which is clamped to its two ends.
    pub fn tension(&self, FromLeavePoint(s): FromLeavePoint) -> f64 {
        self.free().up_to(s).anchor_tension()
    }

    /// Mean tension along the whole cable [N]: lead and arc carry T0, the free part nearly the tension of its
    /// middle.
    pub fn mean_tension(&self) -> f64 {
        let free = self.free();
        let middle = free.up_to(0.5 * free.unstrained_length).anchor_tension();
        let led = 1.0 - free.unstrained_length / self.unstrained_length;
        middle + led * (free.exit_tension() - middle)
    }

    /// Positions [m] of `points` points (2 at least) from B to A, at equal unstrained distances.
    pub fn profile(&self, points: usize) -> Vec<Vector2<f64>> {
        let last = points.max(2) - 1;
        let (leave, free) = (self.leave_point(), self.free());
        (0..=last).map(|k| leave + free.free_point(free.unstrained_length * k as f64 / last as f64)).collect()
    }

    /// The lowest point along the cable: where it is level, or its lower end.
    pub fn lowest_arc_length(&self) -> FromLeavePoint {
        let (w, free) = (self.cable.weight_per_length, self.free());
        let v0 = free.exit_vertical_force();
        FromLeavePoint(if w > 0.0 {
            (-v0 / w).clamp(0.0, free.unstrained_length)
        } else if v0 < 0.0 {
            free.unstrained_length
        } else {
            0.0
        })
    }

    /// The lowest point of the cable [m].
    pub fn lowest_point(&self) -> Vector2<f64> {
        self.point(self.lowest_arc_length())
    }

    /// Sag [m]: the greatest distance of the cable across its chord (Irvine 1981, section 2.5).
    pub fn sag(&self) -> f64 {
        let free = self.free();
        let end = free.end_position();
        let chord = end.norm();
        if self.cable.weight_per_length == 0.0 || chord == 0.0 {
            return 0.0;
        }
        let point = free.parallel_point(end);
        (point.x * end.y - point.y * end.x).abs() / chord
    }

    /// Vertical sag [m]: the greatest height of the chord above the cable.
    ///
    /// Where the two ends lie one above the other it is how far the cable hangs below the lower of them.
    pub fn vertical_sag(&self) -> f64 {
        let free = self.free();
        let end = free.end_position();
        if self.cable.weight_per_length == 0.0 {
            0.0
        } else if end.x > f64::EPSILON * end.norm() {
            let point = free.parallel_point(end);
            (point.x / end.x * end.y - point.y).max(0.0)
        } else {
            end.y.min(0.0) - free.lowest_point().y
        }
    }

    /// The point where a cable with weight is parallel to its chord from the origin to `end`: V/fx = z/x.
    fn parallel_point(&self, end: Vector2<f64>) -> Vector2<f64> {
        let v = if end.x > 0.0 { self.force.x * end.y / end.x } else { 0.0 };
        self.free_point((v - self.exit_vertical_force()) / self.cable.weight_per_length)
    }
}

#[cfg(test)]
mod tests {
    use crate::{Cable, Catenary, Entry, FromLeavePoint, Guide, Vector2, end_force};
    use approx::assert_relative_eq;

    const CABLE: Cable = Cable::linear(2.0, 1e6);

    fn hanging(length: f64, x: f64, z: f64) -> Catenary<'static> {
        end_force(&CABLE, length, Vector2::new(x, z)).unwrap().catenary
    }

    #[test]
    fn the_profile_runs_from_exit_to_anchor_point() {
        let catenary = hanging(6.0, 4.0, 1.0);
        let profile = catenary.profile(11);
        assert_eq!(profile.len(), 11);
        assert_eq!(profile[0], Vector2::zeros());
        assert_relative_eq!(profile[10], Vector2::new(4.0, 1.0), epsilon = 1e-13);
    }

    #[test]
    fn a_level_span_is_lowest_in_the_middle_by_its_sag() {
        let catenary = hanging(6.0, 5.0, 0.0);
        assert_relative_eq!(catenary.lowest_arc_length().0, 3.0, epsilon = 1e-12);
        assert_relative_eq!(catenary.lowest_point().y, -catenary.sag(), max_relative = 1e-12);
    }

    #[test]
    fn a_shallow_cable_has_the_sag_of_a_parabola() {
        let catenary = hanging(3.0 - 1e-3, 3.0, 0.0);
        let parabola = 2.0 * 3.0 * 3.0 / (8.0 * catenary.force.x);
        assert_relative_eq!(catenary.sag(), parabola, max_relative = 1e-3);
    }

    #[test]
    fn no_point_lies_farther_from_the_chord_than_the_sag() {
        let catenary = hanging(7.0, 3.0, -2.0);
        let chord = catenary.end_position().normalize();
        let distances = catenary.profile(1001).into_iter().map(|p| (p.x * chord.y - p.y * chord.x).abs());
        let greatest = distances.fold(0.0, f64::max);
        assert!(greatest <= catenary.sag() * (1.0 + 1e-12));
        assert_relative_eq!(greatest, catenary.sag(), max_relative = 1e-5);
    }

    #[test]
    fn no_point_lies_lower_under_the_chord_than_the_vertical_sag() {
        for (x, z) in [(3.0, -2.0), (3.0, 2.0), (1e-3, 4.0), (6.9, 0.0)] {
            let catenary = hanging(7.0, x, z);
            let depths = catenary.profile(10_001).into_iter().map(|p| p.x / x * z - p.y);
            let greatest = depths.fold(0.0, f64::max);
            assert!(greatest <= catenary.vertical_sag() * (1.0 + 1e-12));
            assert_relative_eq!(greatest, catenary.vertical_sag(), max_relative = 1e-3);
        }
    }

    #[test]
    fn a_vertical_cable_sags_by_its_loop_and_a_taut_one_not_at_all() {
        // 7 m over 4 m of height leave a loop of 1.5 m below the lower end, up to the strain by the weight.
        assert_relative_eq!(hanging(7.0, 0.0, 4.0).vertical_sag(), 1.5, epsilon = 1e-4);
        assert_relative_eq!(hanging(7.0, 0.0, -4.0).vertical_sag(), 1.5, epsilon = 1e-4);
        assert_eq!(hanging(3.9, 0.0, -4.0).vertical_sag(), 0.0);
    }

    #[test]
    fn the_tension_along_the_cable_ends_with_the_tensions_at_b_and_a() {
        let catenary = hanging(7.0, 3.0, -2.0);
        assert_relative_eq!(
            catenary.tension(FromLeavePoint(0.0)),
            catenary.exit_tension(),
            max_relative = 1e-15
        );
        assert_relative_eq!(
            catenary.tension(FromLeavePoint(7.0)),
            catenary.anchor_tension(),
            max_relative = 1e-13
        );
    }

    #[test]
    fn the_mean_tension_is_that_over_lead_arc_and_free_part() {
        let guide = Guide { lead: 4.0, radius: 0.1, entry: Entry::Upwards };
        let cable = Cable { guide: Some(guide), ..Cable::linear(2.0, 1e6) };
        let end = Vector2::new(3.0, -3.5);
        let length = 0.9999 * cable.straight_length(end);
        let catenary = end_force(&cable, length, end).unwrap().catenary;
        let (free, parts) = (catenary.free_length(), 20_000);
        let ds = free / f64::from(parts);
        let along: f64 =
            (0..parts).map(|k| ds * catenary.tension(FromLeavePoint(ds * (f64::from(k) + 0.5)))).sum();
        let mean = (along + (length - free) * catenary.exit_tension()) / length;
        assert_relative_eq!(catenary.mean_tension(), mean, max_relative = 1e-3);
        assert!(catenary.mean_tension() > catenary.tension(FromLeavePoint(0.5 * free)) * 1.01);
    }

    #[test]
    fn a_taut_vertical_cable_has_no_sag_whichever_way_it_is_found() {
        for z in [-10.0, 10.0] {
            let end = Vector2::new(0.0, z);
            let by_tension = crate::length_for_tension(&CABLE, end, 60.0).unwrap().catenary;
            let by_length = hanging(by_tension.unstrained_length, 0.0, z);
            assert_eq!(
                [by_tension.vertical_sag(), by_length.vertical_sag()].map(|sag| sag < 1e-12),
                [true; 2]
            );
        }
    }

    #[test]
    fn a_cable_is_slack_where_an_end_carries_less_than_its_weight() {
        // 14 N/m times 7 m hang below 3 m; 100 times that is a load.
        assert!(hanging(7.0, 3.0, 0.0).is_slack() && hanging(7.0, 0.0, 4.0).is_slack());
        let loaded = hanging(7.004, 7.0, 0.0);
        assert!(loaded.length_at_rest() > 7.0 && !loaded.is_slack(), "{}", loaded.anchor_tension());
        // A level cable that is just slack sags by a seventh of its span.
        let slack = |length: f64| hanging(length, 5.0, 0.0).is_slack();
        let (mut short, mut long) = (5.0, 6.0);
        for _ in 0..50 {
            let middle = 0.5 * (short + long);
            if slack(middle) { long = middle } else { short = middle }
        }
        assert_relative_eq!(hanging(long, 5.0, 0.0).sag() / 5.0, 1.0 / 7.0, max_relative = 0.02);
    }

    #[test]
    fn a_cable_vibrates_like_a_chain_of_small_masses_across_its_plane() {
        const MASSES: usize = 120;
        for (length, x, z, accuracy) in
            [(5.0005, 4.0, -3.0, 0.01), (4.99, 3.0, 4.0, 0.01), (5.05, 5.0, 0.0, 0.02)]
        {
            let catenary = hanging(length, x, z);
            // Across the plane T(s) holds each mass, per stretched distance of its neighbours.
            let ds = length / MASSES as f64;
            let density = 2.0 / 9.81;
            let tension = |k: usize| catenary.tension(FromLeavePoint(ds * (k as f64 + 0.5)));
            let spring = |k: usize| tension(k) / (ds * (1.0 + tension(k) / 1e6));
            let matrix = nalgebra::DMatrix::from_fn(MASSES - 1, MASSES - 1, |i, j| match i.abs_diff(j) {
                0 => spring(i) + spring(i + 1),
                1 => -spring(i.max(j)),
                _ => 0.0,
            });
            let least = matrix.symmetric_eigenvalues().min() / (density * ds);
            let chain = least.sqrt() / std::f64::consts::TAU;
            let mean = 0.5 * (catenary.anchor_tension() + catenary.exit_tension());
            let found = catenary.cable.lowest_frequency(density, length, mean).unwrap();
            assert_relative_eq!(found, chain, max_relative = accuracy);
        }
        assert_eq!(CABLE.lowest_frequency(0.0, 5.0, 100.0), None);
    }

    #[test]
    fn the_potential_energy_is_elastic_energy_plus_lifted_weight() {
        let catenary = hanging(7.0, 3.0, -2.0);
        let parts = 20_000;
        let ds = catenary.unstrained_length / f64::from(parts);
        let energy: f64 = (0..parts)
            .map(|k| FromLeavePoint(ds * (f64::from(k) + 0.5)))
            .map(|s| ds * (catenary.tension(s).powi(2) / (2.0 * 1e6) + 2.0 * catenary.point(s).y))
            .sum();
        assert_relative_eq!(catenary.potential_energy(), energy, max_relative = 1e-7);
    }
}
