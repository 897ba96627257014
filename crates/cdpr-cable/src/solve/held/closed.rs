//! Cables at a chord force: Newton's method for their closure, and the derivatives by that force.
//!
//! With the horizontal force `fx = σ h/c` of (C16) the derivatives between fixed ends are those by fx, (C38),
//! times h/c: a cable over a tilted axis swings its plane, others stay in that of their ends. A vertical
//! cable has a share of the chord for its horizontal distance that is far below rounding.
//!
//! Second derivatives are (C38) differentiated by dual numbers.

use super::{HeldCable, VERTICAL, per_horizontal};
use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::catenary::guided::way;
use crate::catenary::spatial::{flat, lifted};
use crate::error::CableError;
use crate::kernel::AtFixedEnds;
use cdpr_number::{Dual, Real};
use nalgebra::{Matrix3, RowVector3, Vector2, Vector3};

/// A cable with a smaller share of its chord for its horizontal distance is vertical to rounding.
const NEARLY_VERTICAL: f64 = 1e-8;

/// A cable with a force in a vertical plane, over any kind of number.
struct AtForce<T> {
    /// The length is that beyond the leave point.
    numbers: Numbers<T>,
    /// Horizontal direction of the plane.
    azimuth: [T; 2],
    /// (fx, fz) [N].
    force: [T; 2],
}

/// What closes a cable.
struct Closing<T> {
    terms: AtFixedEnds<T>,
    /// Misclosure forwards, across and upwards [m].
    open: [T; 3],
    /// Whole unstrained length [m], and its derivative by fx.
    whole: [T; 2],
}

impl<T: Real> AtForce<T> {
    /// What closes the cable to `end`, which lies forwards, across and upwards from its exit point [m].
    #[inline]
    fn closing(&self, cable: &Cable, end: [T; 3]) -> Closing<T> {
        let (Self { numbers, azimuth: [c, s], force }, zero) = (self, T::of(0.0));
        let free = cable.free_response(numbers, *force);
        let Some(guide) = &cable.guide else {
            let [x, z] = [end[0] - free.end[0], end[2] - free.end[1]];
            let terms = AtFixedEnds::in_plane(&free, [x, z], force[0] / end[0]);
            return Closing { open: [x, zero, z], whole: [numbers.length, terms.per_force[2]], terms };
        };
        let [kx, ky, kz] = numbers.axis;
        let turned = Numbers { axis: [*c * kx + *s * ky, *c * ky - *s * kx, kz], ..*numbers };
        let way = way(cable, guide, &turned, numbers.length, *force);
        let space = way.in_space(force[0], &free);
        let open = [end[0] - space.end[0], end[1] - space.end[1], end[2] - space.end[2]];
        let terms = AtFixedEnds::in_space(&space, way.free_per_length, open);
        let ([q, across, upwards], [swung, rise, longer]) = (space.free_per_force, terms.per_force);
        let paid_out = (longer - q - across * swung - upwards * rise) / way.free_per_length;
        Closing { terms, open, whole: [way.length, paid_out] }
    }

    /// The whole length, and dF/dfx in space, dL/dfx and that of the length beyond the leave point.
    #[inline]
    fn slopes(&self, cable: &Cable) -> (T, [T; 3], [T; 2]) {
        let Closing { terms, whole: [whole, paid_out], .. } = self.closing(cable, [T::of(1.0); 3]);
        let ([across, rise, longer], [c, s]) = (terms.per_force, self.azimuth);
        (whole, [c - s * across, s + c * across, rise], [paid_out, longer])
    }
}

/// A cable's end in the axes of a vertical plane: forwards, across and upwards [m].
fn seen_in([c, s]: [f64; 2], end: Vector3<f64>, is_tilted: bool) -> [f64; 3] {
    match is_tilted {
        true => [c * end.x + s * end.y, c * end.y - s * end.x, end.z],
        false => [flat(end).0.x.max(VERTICAL * end.norm()), 0.0, end.z],
    }
}

impl<'a> HeldCable<'a> {
    /// Force [N] and length [m] of the inextensible catenary of a plain cable with this horizontal force.
    pub(super) fn inextensible(cable: &Cable, end: Vector3<f64>, chord_force: f64) -> (Vector3<f64>, f64) {
        let (chord, (flat, _)) = (end.norm(), flat(end));
        let u = 0.5 * cable.weight_per_length * chord / chord_force;
        let (sinh_ratio, u_coth) = if u < 1e-4 { (1.0, 1.0) } else { (u.sinh() / u, u / u.tanh()) };
        let length = flat.y.hypot(flat.x * sinh_ratio) / (1.0 + cable.strain(chord_force));
        let fz = chord_force / chord * flat.y * u_coth + 0.5 * cable.weight_per_length * length;
        (Vector3::new(0.0, 0.0, fz), length)
    }

    /// A cable that is closed, with its derivatives: in the plane of this direction, with the vertical force
    /// fz [N] and the length beyond its guide [m].
    pub(super) fn at(
        cable: &Cable<'a>,
        (end, chord_force): (Vector3<f64>, f64),
        azimuth: [f64; 2],
        [fz, free_length]: [f64; 2],
    ) -> Self {
        let per_chord_force = 1.0 / per_horizontal(end);
        let force = [chord_force * per_chord_force, fz];
        let at = AtForce { numbers: cable.numbers(free_length), azimuth, force };
        let (unstrained_length, force_slope, slopes) = at.slopes(cable);
        let [length_slope, free_slope] = slopes.map(|slope| slope * per_chord_force);
        Self {
            catenary: Catenary { cable: *cable, unstrained_length, force: force.into() },
            azimuth,
            end,
            chord_force,
            force_slope: Vector3::from(force_slope) * per_chord_force,
            length_slope,
            free_length,
            free_slope,
        }
    }

    /// d²F/dσ² [1/N].
    pub fn force_curvature(&self) -> Vector3<f64> {
        let Catenary { cable, force, .. } = self.catenary;
        let along = |value: f64, slope: f64| Dual { value, slopes: [slope] };
        let (per_chord_force, [c, s]) = (1.0 / per_horizontal(self.end), self.azimuth);
        let fx = self.chord_force * per_chord_force;
        let swung = c * self.force_slope.y - s * self.force_slope.x;
        let turn = if cable.leaves_its_plane() { swung / fx } else { 0.0 };
        let length = along(self.free_length, self.free_slope);
        let state = AtForce::<Dual<f64, 1>> {
            numbers: Numbers { length, ..cable.numbers(self.free_length).map(Dual::of) },
            azimuth: [along(c, -s * turn), along(s, c * turn)],
            force: [along(fx, per_chord_force), along(force.y, self.force_slope.z)],
        };
        let (_, slopes, _) = state.slopes(&cable);
        Vector3::from(slopes.map(|slope| slope.slopes[0])) * per_chord_force
    }

    /// dF/dr by the position r of A at the same chord force [N/m].
    pub fn force_per_end(&self) -> Matrix3<f64> {
        let Self { catenary: Catenary { cable, force, .. }, azimuth, end, .. } = *self;
        let ([c, s], chord, (flat_end, direction)) = (azimuth, end.norm(), flat(end));
        let per_chord_force = 1.0 / per_horizontal(end);
        let numbers = cable.numbers(self.free_length);
        let state = AtForce { numbers, azimuth, force: [self.chord_force * per_chord_force, force.y] };
        let seen = seen_in(azimuth, end, cable.leaves_its_plane());
        let [across, rise, _] = state.closing(&cable, seen).terms.per_end;
        let axes = Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
        let at_force =
            Matrix3::from_rows(&[RowVector3::zeros(), RowVector3::from(across), RowVector3::from(rise)]);
        // By the change of fx = σ h/c.
        let forwards = lifted(Vector2::x(), direction) - end * (flat_end.x / (chord * chord));
        let per_force = self.force_slope * (self.chord_force / (per_chord_force * chord));
        let mut slopes = axes * at_force * axes.transpose() + per_force * forwards.transpose();
        if flat_end.x <= NEARLY_VERTICAL * chord {
            // By symmetry.
            (slopes[(2, 0)], slopes[(2, 1)]) = (0.0, 0.0);
        }
        slopes
    }

    /// Newton's method for force [N] and length beyond the guide [m] at a chord force; over a tilted axis for
    /// the azimuth of the plane, too.
    pub(super) fn close(
        cable: &Cable<'a>,
        end: Vector3<f64>,
        chord_force: f64,
        (force, mut length): (Vector3<f64>, f64),
    ) -> Result<Self, CableError> {
        const MAX_ITERATIONS: usize = 50;
        let is_tilted = cable.leaves_its_plane();
        let (chord, fx) = (end.norm(), chord_force / per_horizontal(end));
        let (_, mut azimuth) = flat(if is_tilted { force } else { end });
        let (mut fz, mut residual) = (force.z, f64::INFINITY);
        for iteration in 1..=MAX_ITERATIONS {
            let now = AtForce { numbers: cable.numbers(length), azimuth, force: [fx, fz] };
            let Closing { terms, open, .. } = now.closing(cable, seen_in(azimuth, end, is_tilted));
            let before = residual;
            residual = Vector3::from(open).norm();
            let [swung, dfz, longer] = terms.closing;
            if !terms.closing.iter().all(|change| change.is_finite()) {
                return Err(CableError::NotConverged { iterations: iteration, residual });
            }
            let weight = cable.weight_per_length * length;
            let (forces, v0) = (fx.hypot(fz) + weight, fz - weight);
            length = (length + longer).clamp(0.5 * length, 2.0 * length);
            // Where the cable is nearly vertical at an end, the force there changes its sign only in small
            // steps: x/fx depends on its logarithm.
            let kept = |from: f64, to: f64| {
                if fx < 0.1 * from.abs() && to / from < 0.1 { 0.1 * from } else { to }
            };
            let weight = cable.weight_per_length * length;
            fz = weight + kept(v0, kept(fz, fz + dfz) - weight);
            if is_tilted {
                let [c, s] = azimuth;
                (_, azimuth) = flat(Vector3::new(c * fx - s * swung, s * fx + c * swung, 0.0));
            }
            // Of a folded cable x/fx shows whether the forces are right: steps do not.
            let fits = open[0].abs() <= 1e-4 * chord / chord_force * fx;
            let change = dfz.hypot(swung);
            let small = |limit: f64| fits && change <= limit * forces && longer.abs() <= limit * chord;
            // The next step squares this one, or nothing but rounding is left.
            if small(1e-8) || (small(1e-6) && residual >= 0.5 * before) {
                return Ok(Self::at(cable, (end, chord_force), azimuth, [fz, length]));
            }
        }
        Err(CableError::NotConverged { iterations: MAX_ITERATIONS, residual })
    }
}
