//! A cable on its guide, of which the whole length is given.
//!
//! The free length Lf beyond the leave point closes (C20), by Newton's method with (C21).

use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::guide::{Entry, Guide};
use crate::kernel::{GuideTerms, GuidedInSpace, Response, SwivelAxis, Way};
use cdpr_number::Real;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::PI;

const MAX_ITERATIONS: usize = 20;

/// A cable on its guide with a force at A.
pub(crate) struct Guided<T> {
    way: Way<T>,
    /// Unstrained length beyond the leave point [m].
    pub(crate) free: T,
}

impl Entry {
    /// The swivel axis of a pulley of this radius [m], from the components of a tilted one.
    fn swivel<T: Real>(self, radius: T, tilted: [T; 3]) -> SwivelAxis<T> {
        match self {
            Self::Along(_) => SwivelAxis::Along(tilted),
            vertical => SwivelAxis::Vertical(radius * vertical.axis()[2]),
        }
    }
}

impl<T: Real> Guided<T> {
    /// The cable with the force `force` [N] at A, (C20).
    pub(crate) fn new(cable: &Cable, guide: &Guide, numbers: &Numbers<T>, force: [T; 2]) -> Self {
        let (plain, plain_force) = (numbers.map(T::value), force.map(T::value));
        // A cable that is too short has a negative free length, for which all formulas go on.
        let mut free = plain.length - guide.lead;
        for _ in 0..MAX_ITERATIONS {
            let now = way(cable, guide, &plain, free, plain_force);
            let step = (plain.length - now.length) * now.free_per_length;
            free += step;
            // The tangent turns by this angle, and the excess that is left goes with its square.
            let per_length = plain.weight_per_length * now.leave.tension_inv;
            let extent = guide.radius + now.guided;
            let left = extent * (per_length * step).powi(2);
            if extent * (per_length * left).powi(2) <= 0.1 * f64::EPSILON * plain.length {
                break;
            }
        }
        // One more step squares the error and gives the number its derivatives.
        let near = way(cable, guide, numbers, T::of(free), force);
        let free = (numbers.length - near.length) * near.free_per_length + free;
        Self { way: way(cable, guide, numbers, free, force), free }
    }

    /// The response in space, with the force `fx` [N] forwards.
    pub(crate) fn in_space(&self, fx: T, free: &Response<T>) -> GuidedInSpace<T> {
        self.way.in_space(fx, free)
    }
}

/// The way of a cable with an unstrained length `free` [m] beyond its leave point, which need not fit the
/// whole one.
pub(crate) fn way<T: Real>(
    cable: &Cable,
    guide: &Guide,
    numbers: &Numbers<T>,
    free: T,
    force: [T; 2],
) -> Way<T> {
    let Numbers { weight_per_length, lead, radius, axis, .. } = *numbers;
    let terms = GuideTerms { lead, radius, axis: guide.entry.swivel(radius, axis) };
    let leave = terms.leave_point(weight_per_length, free, force);
    terms.way(weight_per_length, free, leave, cable.material(numbers).stretch(leave.tension))
}

/// The response to the force `force` [N] at A of a cable on a guide.
#[cold]
pub(crate) fn response<T: Real>(
    cable: &Cable,
    guide: &Guide,
    numbers: &Numbers<T>,
    force: [T; 2],
) -> Response<T> {
    let Guided { way, free } = Guided::new(cable, guide, numbers, force);
    way.response(force[0], &cable.free_response(&Numbers { length: free, ..*numbers }, force))
}

impl<'a> Catenary<'a> {
    /// The cable on its guide.
    pub(crate) fn guided(&self, guide: &Guide) -> Guided<f64> {
        Guided::new(&self.cable, guide, &self.cable.numbers(self.unstrained_length), self.force.into())
    }

    /// The part of the cable beyond its leave point, as a cable of its own without a guide.
    pub fn free(&self) -> Self {
        match &self.cable.guide {
            None => *self,
            Some(guide) => Catenary {
                cable: Cable { guide: None, ..self.cable },
                unstrained_length: self.guided(guide).free,
                force: self.force,
            },
        }
    }

    /// Half the difference `dx/dfz - dz/dfx` of the flexibility [m/N], (C22); zero without a guide.
    ///
    /// [`crate::kernel::Response::flexibility`] is the symmetric part alone.
    pub fn asymmetry(&self) -> f64 {
        self.cable.guide.map_or(0.0, |guide| self.guided(&guide).way.asymmetry())
    }

    /// Where the cable leaves its pulley, from the entry point [m]; zero without a pulley.
    pub fn leave_point(&self) -> Vector2<f64> {
        let [x, _, z] = self.leave();
        Vector2::new(x, z)
    }

    /// Distance of the leave point across the plane, to the left, from the entry point [m]: other than zero
    /// for a tilted axis.
    pub fn leave_beside(&self) -> f64 {
        self.leave()[1]
    }

    fn leave(&self) -> [f64; 3] {
        self.cable.guide.map_or([0.0; 3], |guide| self.guided(&guide).way.leave_in_space())
    }

    /// Positions [m] of `points` points (2 at least) of the cable on its pulley, from where it enters to just
    /// before it leaves: forwards, across and upwards. None without a pulley.
    pub fn on_the_pulley(&self, points: usize) -> Vec<Vector3<f64>> {
        let Some(guide) = self.cable.guide.filter(|guide| guide.radius > 0.0) else { return Vec::new() };
        let (at, count) = (self.guided(&guide), points.max(2));
        let (u, axis) = (Vector3::from(at.way.away()), Vector3::from(guide.entry.axis()));
        let angles = (0..count).map(|k| PI - self.wrap() * k as f64 / count as f64);
        angles.map(|angle| guide.radius * ((1.0 + angle.cos()) * u + angle.sin() * axis)).collect()
    }

    /// Positions [m] of `points` points around the wheel of the pulley and the first one again: forwards,
    /// across and upwards. None without a pulley.
    pub fn wheel(&self, points: usize) -> Vec<Vector3<f64>> {
        let Some(guide) = self.cable.guide.filter(|guide| guide.radius > 0.0) else { return Vec::new() };
        let (u, axis) = (Vector3::from(self.guided(&guide).way.away()), Vector3::from(guide.entry.axis()));
        let angles = (0..=points).map(|k| 2.0 * PI * k as f64 / points as f64);
        angles.map(|angle| guide.radius * ((1.0 + angle.cos()) * u + angle.sin() * axis)).collect()
    }

    /// Angle over which the cable lies on its pulley [rad]; zero without a pulley.
    pub fn wrap(&self) -> f64 {
        match &self.cable.guide {
            Some(guide) if guide.radius > 0.0 => (self.guided(guide).way.guided - guide.lead) / guide.radius,
            _ => 0.0,
        }
    }
}

/// Potential energy [J], (C25).
#[cold]
pub(crate) fn potential_energy(catenary: &Catenary, guide: &Guide) -> f64 {
    let (Guided { way, .. }, free) = (catenary.guided(guide), catenary.free());
    let w = catenary.cable.weight_per_length;
    let ([_, _, height], [_, _, rise], [_, _, up]) = (way.leave_in_space(), way.away(), guide.entry.axis());
    let led = way.guided / way.stretch * catenary.cable.elastic_energy(free.exit_tension());
    let psi = PI - catenary.wrap();
    let over_the_wheel = (psi - PI + psi.sin()) * rise - psi.cos() * up;
    let square = guide.radius * guide.radius;
    free.potential_energy() + free.weight() * height + led - w * square * over_the_wheel
}
