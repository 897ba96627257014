//! A cable in wind, whose load per length depends on its direction.
//!
//! Of a wind v the component across the cable exerts a drag, per stretched length (Hoerner 1965, chapter 3,
//! section 7: the flow along a cylinder does not count)
//!
//! ```text
//! q = ½ ρ c d |v_n| v_n,      v_n = v - (v·t) t                                                (C39)
//! ```
//!
//! with the density ρ of the air, the drag coefficient c, the diameter d of the cable and its direction t. With
//! the force n that the part beyond exerts on the part before, along t and of the tension T = |n|, weight w and
//! drag give over the unstrained length s from the leave point
//!
//! ```text
//! dr/ds = (1 + ε(T)) t,      dn/ds = -w - (1 + ε(T)) q,      t = n/T                           (C40)
//! ```
//!
//! Newton's method finds the n(0) with which the cable ends at A. The integration is the classical Runge-Kutta
//! method with Richardson's extrapolation; dual numbers carry the derivatives by n(0).

use crate::cable::Cable;
use crate::error::CableError;
use crate::kernel::Material;
use cdpr_number::vector::dot;
use cdpr_number::{Dual, Lanewise, Real};
use nalgebra::{Matrix3, Vector3};

/// Most steps of an integration.
const MOST_STEPS: usize = 8192;

/// Accuracy of the integration, relative to the length of the cable.
const ACCURACY: f64 = 1e-11;

/// Misclosure that is rounding, relative to the length of the cable.
const ROUNDING: f64 = 1e-13;

/// A cable in wind, between the point where it leaves its exit or pulley, the origin, and its anchor point.
#[derive(Clone, Copy, Debug)]
pub struct CableInWind<'a> {
    /// The cable.
    pub cable: Cable<'a>,
    /// Its weight per unstrained length, as a vector [N/m].
    pub weight: Vector3<f64>,
    /// Velocity of the wind [m/s].
    pub velocity: Vector3<f64>,
    /// ½ ρ c d, drag per length and square of the velocity across [N s²/m³].
    pub drag: f64,
    /// Unstrained length L from the winch on [m].
    pub unstrained_length: f64,
    /// Stretched length before the leave point, which has the tension there [m].
    pub guided: f64,
}

/// Such a cable in equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldInWind {
    /// n at the leave point [N].
    pub exit_force: Vector3<f64>,
    /// n at A, the force on the cable there; the platform receives the opposite [N].
    pub anchor_force: Vector3<f64>,
    /// Force of the wind on the cable beyond the leave point [N].
    pub drag: Vector3<f64>,
    /// Derivative of the force at A by the position of A [N/m].
    pub stiffness: Matrix3<f64>,
    /// Distance between the end of the cable and A [m].
    pub closure: f64,
    /// Error of the integration in the position of the end [m], as two step sizes show it.
    pub error: f64,
}

/// Position r [m] and force n [N] at a point of the cable.
type State<T> = [[T; 3]; 2];

impl CableInWind<'_> {
    /// The cable held at `end` [m], searched from the force `near` at the leave point [N].
    ///
    /// # Errors
    /// [`CableError::NotConverged`], and [`CableError::Overstrained`] beyond [`crate::MAX_STRAIN`].
    pub fn held_at(&self, end: Vector3<f64>, near: Vector3<f64>) -> Result<HeldInWind, CableError> {
        let (mut steps, mut start) = (8, near);
        loop {
            let held = self.closed(end, start, steps)?;
            if held.error <= ACCURACY * self.unstrained_length {
                return self.checked(held);
            }
            if steps >= MOST_STEPS {
                return Err(CableError::NotConverged { iterations: steps, residual: held.error });
            }
            (steps, start) = (2 * steps, held.exit_force);
        }
    }

    fn checked(&self, held: HeldInWind) -> Result<HeldInWind, CableError> {
        let tension = held.exit_force.norm().max(held.anchor_force.norm());
        match self.cable.overstrain(tension) {
            Some(strain) => Err(CableError::Overstrained { tension, strain }),
            None => Ok(held),
        }
    }

    /// Newton's method with this number of steps of the integration.
    fn closed(&self, end: Vector3<f64>, start: Vector3<f64>, steps: usize) -> Result<HeldInWind, CableError> {
        const MAX_ITERATIONS: usize = 60;
        let mut best = self.ended(end, start, steps);
        for _ in 0..MAX_ITERATIONS {
            let (held, change) = &best;
            if held.closure <= ROUNDING * self.unstrained_length {
                return Ok(*held);
            }
            // A step that does not bring the end nearer is halved.
            let shorter = (0..30).map(|halvings| held.exit_force + change * 0.5_f64.powi(halvings));
            let tried = shorter.map(|force| self.ended(end, force, steps));
            match tried.into_iter().find(|(next, _)| next.closure < held.closure) {
                Some(next) => best = next,
                None if held.closure <= 1e3 * ROUNDING * self.unstrained_length => return Ok(*held),
                None => break,
            }
        }
        Err(CableError::NotConverged { iterations: MAX_ITERATIONS, residual: best.0.closure })
    }

    /// The cable with the force `start` at its leave point, and the change of that force which would end it at
    /// `end` if the cable were linear.
    fn ended(&self, end: Vector3<f64>, start: Vector3<f64>, steps: usize) -> (HeldInWind, Vector3<f64>) {
        let force = [0, 1, 2].map(|k| Dual::<f64, 3>::input(start[k], k));
        let (coarse, fine) = (self.integrated(force, steps), self.integrated(force, 2 * steps));
        let apart = |k: usize| (fine[0][k].value - coarse[0][k].value) / 15.0;
        let error = Vector3::from([0, 1, 2].map(apart)).norm();
        let [r, n] =
            [0, 1].map(|of| [0, 1, 2].map(|k| fine[of][k] + (fine[of][k] - coarse[of][k]) * (1.0 / 15.0)));
        let values = |of: [Dual<f64, 3>; 3]| Vector3::from(of.map(|component| component.value));
        let slopes = |of: [Dual<f64, 3>; 3]| Matrix3::from_fn(|row, column| of[row].slopes[column]);
        let open = end - values(r);
        let per_end = slopes(r).try_inverse().unwrap_or_else(|| Matrix3::repeat(f64::NAN));
        let held = HeldInWind {
            exit_force: start,
            anchor_force: values(n),
            drag: start - values(n) - self.weight * self.free_length(start.norm()),
            stiffness: slopes(n) * per_end,
            closure: open.norm(),
            error,
        };
        (held, per_end * open)
    }

    /// Unstrained length beyond the leave point with this tension there [N].
    fn free_length<T: Real>(&self, tension: T) -> T {
        self.material::<T>().stretch(tension)[0].recip() * -self.guided + self.unstrained_length
    }

    /// The end of the cable, (C40).
    fn integrated<T: Real>(&self, force: [T; 3], steps: usize) -> State<T> {
        let step = self.free_length(dot(&force, &force).sqrt()) * (1.0 / steps as f64);
        let mut state = [[T::of(0.0); 3], force];
        for _ in 0..steps {
            state = self.stepped(state, step);
        }
        state
    }

    /// A step of the classical Runge-Kutta method.
    fn stepped<T: Real>(&self, state: State<T>, step: T) -> State<T> {
        let half = step * 0.5;
        let first = self.slope(&state[1]);
        let second = self.slope(&moved(&state, &first, half)[1]);
        let third = self.slope(&moved(&state, &second, half)[1]);
        let fourth = self.slope(&moved(&state, &third, step)[1]);
        let mean = [0, 1].map(|of| {
            [0, 1, 2]
                .map(|k| (first[of][k] + (second[of][k] + third[of][k]) * 2.0 + fourth[of][k]) * (1.0 / 6.0))
        });
        moved(&state, &mean, step)
    }

    /// dr/ds and dn/ds, (C39) and (C40).
    fn slope<T: Real>(&self, force: &[T; 3]) -> State<T> {
        let tension = dot(force, force).sqrt();
        let per_tension = tension.recip();
        let stretch = self.material::<T>().stretch(tension)[0];
        let t = force.map(|component| component * per_tension);
        let velocity = [0, 1, 2].map(|k| T::of(self.velocity[k]));
        let along = dot(&velocity, &t);
        let across = [0, 1, 2].map(|k| velocity[k] - along * t[k]);
        // The root has no derivative at zero.
        let speed = (dot(&across, &across) + f64::MIN_POSITIVE).sqrt();
        let drag = stretch * speed * self.drag;
        [t.map(|component| stretch * component), [0, 1, 2].map(|k| -(across[k] * drag) + -self.weight[k])]
    }

    fn material<T: Lanewise + Real>(&self) -> Material<'_, T> {
        let Cable { weight_per_length, axial_stiffness, .. } = self.cable;
        let [weight_per_length, axial_flexibility] = [weight_per_length, 1.0 / axial_stiffness].map(T::of);
        Material { law: self.cable.law.terms(), weight_per_length, axial_flexibility }
    }
}

fn moved<T: Real>(state: &State<T>, slope: &State<T>, by: T) -> State<T> {
    [0, 1].map(|of| [0, 1, 2].map(|k| state[of][k] + slope[of][k] * by))
}
