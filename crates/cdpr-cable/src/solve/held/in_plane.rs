//! Cables that stay in the vertical plane of their ends: force and length follow from σ by
//!
//! ```text
//! x/fx = c/σ,      z = z(f, L),      fx = σ h/c                                                  (C17)
//! ```
//!
//! with x/fx of (C1), which is regular for a vertical cable. With the flexibility C and `e = (fx, V0) k`,
//! `k = 1/T0 + 1/EA` of (C9), the derivatives at held ends are
//!
//! ```text
//! fx' = h/c,      fz' = (V0 Cxx/σ - Cxz fx')/m,      L' = -det C/(σ k m),      m = Czz - V0 Cxz/fx   (C18)
//! ```
//!
//! Second derivatives are (C18) differentiated by dual numbers.

use super::{HeldCable, VERTICAL};
use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::catenary::guided::OnGuide;
use crate::catenary::spatial::{flat, lifted};
use crate::error::CableError;
use crate::kernel::Response;
use cdpr_number::{Dual, Real};
use nalgebra::{Vector2, Vector3};

/// The quantities of (C17) and (C18) over any kind of number.
#[derive(Clone, Copy)]
struct InPlane<T> {
    end: [T; 2],
    numbers: Numbers<T>,
    chord_force: T,
    fz: T,
}

impl<T: Real> InPlane<T> {
    fn chord(&self) -> T {
        (self.end[0] * self.end[0] + self.end[1] * self.end[1]).sqrt()
    }

    /// h, or what stands for it where the cable is vertical.
    fn horizontal(&self) -> T {
        let chord = self.chord();
        if self.end[0].value() > VERTICAL * chord.value() { self.end[0] } else { chord * VERTICAL }
    }

    fn fx(&self) -> T {
        self.chord_force * self.horizontal() / self.chord()
    }

    /// The response, and what it does not tell of a cable on a guide.
    fn response(&self, catenary: &Catenary) -> (Response<T>, Option<OnGuide<T>>) {
        catenary.cable.whole_response(&self.numbers, [self.fx(), self.fz])
    }

    /// c/σ - x/fx and the height that is missing, (C17).
    fn misclosure(&self, response: &Response<T>) -> [T; 2] {
        [self.chord() / self.chord_force - response.lateral_flexibility, self.end[1] - response.end[1]]
    }

    /// (fx', fz', L'), (C18).
    fn slopes(&self, (response, on_guide): &(Response<T>, Option<OnGuide<T>>)) -> [T; 3] {
        let (fx, fx_slope) = (self.fx(), self.horizontal() / self.chord());
        let ([xx, shear, zz], mut determinant) = (response.flexibility, response.determinant);
        let (mut xz, mut zx) = (shear, shear);
        if let Some(OnGuide { asymmetry, .. }) = *on_guide {
            (xz, zx) = (shear + asymmetry, shear - asymmetry);
            determinant = determinant + asymmetry * asymmetry;
        }
        // The cable enters along the tangent at B: the slope there is V0/fx.
        let [entering, rising] = response.end_per_length;
        let k = entering / fx;
        let v0 = rising / k;
        let m = (zz - v0 * xz / fx).recip();
        let fz_slope = (v0 * xx / self.chord_force - zx * fx_slope) * m;
        [fx_slope, fz_slope, -(determinant * m) / (self.chord_force * k)]
    }
}

impl InPlane<f64> {
    /// A cable between its ends, and the horizontal direction of its plane.
    fn of(catenary: &Catenary, end: Vector3<f64>, chord_force: f64) -> (Self, [f64; 2]) {
        let (end, azimuth) = flat(end);
        let numbers = catenary.cable.numbers(catenary.unstrained_length);
        (Self { end: end.into(), numbers, chord_force, fz: catenary.force.y }, azimuth)
    }

    /// The response of a cable with these numbers.
    #[inline]
    fn whole_response(&self, catenary: &Catenary) -> (Response<f64>, Option<OnGuide<f64>>) {
        match catenary.cable.guide {
            None => (catenary.response(), None),
            Some(_) => self.response(catenary),
        }
    }
}

/// The derivative of (x/fx, z) with respect to (fz, L).
struct ClosureMatrix {
    across: [f64; 2],
    height: [f64; 2],
}

impl ClosureMatrix {
    fn of(cable: &InPlane<f64>, (response, on_guide): &(Response<f64>, Option<OnGuide<f64>>)) -> Self {
        let fx = cable.fx();
        let asymmetry = on_guide.as_ref().map_or(0.0, |on_guide| on_guide.asymmetry);
        Self {
            across: [(response.flexibility[1] + asymmetry) / fx, response.end_per_length[0] / fx],
            height: [response.flexibility[2], response.end_per_length[1]],
        }
    }

    /// The change of (fz, L) that makes up for a misclosure.
    fn solve(&self, [across, height]: [f64; 2]) -> [f64; 2] {
        let ([a, b], [c, d]) = (self.across, self.height);
        let determinant = a * d - b * c;
        [(across * d - b * height) / determinant, (a * height - across * c) / determinant]
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

    /// The derivatives of a cable in its plane.
    pub(super) fn at_in_plane(catenary: Catenary<'a>, end: Vector3<f64>, chord_force: f64) -> Self {
        let (in_plane, azimuth) = InPlane::of(&catenary, end, chord_force);
        let [fx, fz, length_slope] = in_plane.slopes(&in_plane.whole_response(&catenary));
        let force_slope = lifted(Vector2::new(fx, fz), azimuth);
        Self { catenary, azimuth, end, chord_force, force_slope, length_slope }
    }

    /// d²F/dσ² [1/N].
    pub(super) fn curvature_in_plane(&self) -> Vector3<f64> {
        let (cable, _) = InPlane::of(&self.catenary, self.end, self.chord_force);
        let along = |value, slope| Dual { value, slopes: [slope] };
        let cable = InPlane::<Dual<f64, 1>> {
            end: cable.end.map(Dual::of),
            numbers: Numbers {
                length: along(cable.numbers.length, self.length_slope),
                ..cable.numbers.map(Dual::of)
            },
            chord_force: along(cable.chord_force, 1.0),
            fz: along(cable.fz, self.force_slope.z),
        };
        let [_, fz_slope, _] = cable.slopes(&cable.response(&self.catenary));
        Vector3::new(0.0, 0.0, fz_slope.slopes[0])
    }

    /// Newton's method on (C17) for fz and L.
    pub(super) fn close_in_plane(
        cable: &Cable<'a>,
        end: Vector3<f64>,
        chord_force: f64,
        (force, mut length): (Vector3<f64>, f64),
    ) -> Result<Self, CableError> {
        const MAX_ITERATIONS: usize = 50;
        let (chord, (flat, _), mut fz) = (end.norm(), flat(end), force.z);
        let fx = chord_force * flat.x.max(VERTICAL * chord) / chord;
        let mut residual = f64::INFINITY;
        for iteration in 1..=MAX_ITERATIONS {
            let catenary = Catenary { cable: *cable, unstrained_length: length, force: Vector2::new(fx, fz) };
            let numbers = cable.numbers(length);
            let in_plane = InPlane { end: flat.into(), numbers, chord_force, fz };
            let response = in_plane.whole_response(&catenary);
            let misclosure = in_plane.misclosure(&response.0);
            let before = residual;
            residual = (misclosure[0] * fx).hypot(misclosure[1]);
            let [dfz, dlength] = ClosureMatrix::of(&in_plane, &response).solve(misclosure);
            if !(dfz.is_finite() && dlength.is_finite()) {
                return Err(CableError::NotConverged { iterations: iteration, residual });
            }
            let free = response.1.map_or(length, |on_guide| on_guide.free);
            let (v0, led) = (fz - cable.weight_per_length * free, length - free);
            length = (length + dlength).clamp(0.5 * length, 2.0 * length);
            // Where the cable is nearly vertical at an end, the force there changes its sign only in small
            // steps: x/fx depends on its logarithm.
            let kept = |from: f64, to: f64| {
                if fx < 0.1 * from.abs() && to / from < 0.1 { 0.1 * from } else { to }
            };
            let weight = cable.weight_per_length * (length - led);
            fz = weight + kept(v0, kept(fz, fz + dfz) - weight);
            let forces = catenary.force.norm() + cable.weight_per_length * free;
            // Of a folded cable x/fx shows whether the forces are right: steps do not.
            let open = misclosure[0].abs() <= 1e-4 * chord / chord_force;
            let small = |limit: f64| open && dfz.abs() <= limit * forces && dlength.abs() <= limit * chord;
            // The next step squares this one, or nothing but rounding is left.
            if small(1e-8) || (small(1e-6) && residual >= 0.5 * before) {
                let catenary =
                    Catenary { unstrained_length: length, force: Vector2::new(fx, fz), ..catenary };
                return Ok(Self::at_in_plane(catenary, end, chord_force));
            }
        }
        Err(CableError::NotConverged { iterations: MAX_ITERATIONS, residual })
    }
}
