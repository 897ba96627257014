//! A cable in wind, whose load per length depends on its direction.
//!
//! Of a wind v the component across the cable exerts a drag, per stretched length (Hoerner 1965, chapter 3,
//! section 7: the flow along a cylinder does not count)
//!
//! ```text
//! q = ½ ρ c d |v_n| v_n,      v_n = v - (v·t) t                                                (C39)
//! ```
//!
//! with the density ρ of the air, the drag coefficient c, the diameter d of the cable and its direction t.
//! With the force n that the part beyond exerts on the part before, along t and of the tension T = |n|,
//! weight w and drag give over the unstrained length s from the leave point
//!
//! ```text
//! dr/ds = (1 + ε(T)) t,      dn/ds = -w - (1 + ε(T)) q,      t = n/T                           (C40)
//! ```
//!
//! Newton's method finds the n(0) with which the cable ends at A; dual numbers carry the derivatives by n(0).
//! A step of the integration is Gragg's modified midpoint rule with several numbers of substeps, extrapolated
//! in the square of their lengths (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 1993,
//! II.9): of order 12 where the drag is smooth.
//!
//! The wind may grow with the height z above the ground (P. J. Richards, R. P. Hoxey, Appropriate boundary
//! conditions for computational wind engineering models, J. Wind Eng. Ind. Aerodyn. 46-47, 1993; for heights
//! far above z0 it is the law of EN 1991-1-4:2005, Eq. (4.4)):
//!
//! ```text
//! v(z) = v(z_ref) ln(1 + z/z0)/ln(1 + z_ref/z0),      v = 0 below the ground                    (C41)
//! ```
//!
//! With A fixed, r(n(0), θ) does not change, so that for whatever θ the force depends on
//!
//! ```text
//! dn(A)/dθ = ∂n/∂θ - ∂n/∂n(0) (∂r/∂n(0))⁻¹ ∂r/∂θ                                                 (C42)
//! ```

mod integration;

use crate::cable::Cable;
use crate::error::CableError;
use cdpr_number::{Dual, Real};
use nalgebra::{Matrix3, SMatrix, Vector3};

/// Equal steps with which every cable has an end that Newton's method finds, or none.
const FINE_STEPS: usize = 16;

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
    /// How the wind grows with height; `None` for the same velocity everywhere.
    pub profile: Option<WindOverHeight>,
}

/// A wind that grows with the height above the ground, (C41).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindOverHeight {
    /// Roughness length z0 of the ground [m].
    pub roughness: f64,
    /// Height z_ref at which the wind has its velocity [m].
    pub reference: f64,
    /// Height of the leave point [m].
    pub height: f64,
}

/// What the force of such a cable on its anchor depends on while both its ends are fixed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InWindSlopes {
    /// Derivative of n(A) by the weight per unstrained length as a vector.
    pub per_weight: Matrix3<f64>,
    /// By ½ ρ c d.
    pub per_drag: Vector3<f64>,
    /// By the unstrained length [N/m].
    pub per_length: Vector3<f64>,
    /// By the axial stiffness EA.
    pub per_axial_stiffness: Vector3<f64>,
    /// By the stretched length before the leave point [N/m].
    pub per_guided: Vector3<f64>,
    /// By the height of the whole cable above the ground [N/m].
    pub per_height: Vector3<f64>,
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
    /// Steps of the coarser one, shorter where the wind along the cable or the ground bends its drag.
    pub steps: usize,
}

/// Position r [m] and force n [N] at a point of the cable.
type State<T> = [[T; 3]; 2];

/// What an integration depends on besides the law of the cable and the velocity of the wind.
struct Given<T> {
    force: [T; 3],
    weight: [T; 3],
    drag: T,
    length: T,
    axial_flexibility: T,
    guided: T,
    height: T,
}

impl CableInWind<'_> {
    /// The cable held at `end` [m], searched from the force `near` at the leave point [N].
    ///
    /// # Errors
    /// [`CableError::NotConverged`], and [`CableError::Overstrained`] beyond [`crate::MAX_STRAIN`].
    pub fn held_at(&self, end: Vector3<f64>, near: Vector3<f64>) -> Result<HeldInWind, CableError> {
        let (mut least, mut accuracy, mut start) = (1, ACCURACY, near);
        loop {
            let steps = self.steps(start, least, accuracy)?;
            let held = match self.closed(end, start, &steps) {
                // Long steps may have no such end.
                Err(_) if least < FINE_STEPS => {
                    least *= 2;
                    continue;
                }
                closed => closed?,
            };
            if held.error <= ACCURACY * self.unstrained_length {
                return self.checked(held);
            }
            // The steps are those of the force that was found.
            (accuracy, start) = (0.25 * accuracy, held.exit_force);
        }
    }

    fn checked(&self, held: HeldInWind) -> Result<HeldInWind, CableError> {
        let tension = held.exit_force.norm().max(held.anchor_force.norm());
        match self.cable.overstrain(tension) {
            Some(strain) => Err(CableError::Overstrained { tension, strain }),
            None => Ok(held),
        }
    }

    /// Newton's method with these steps of the integration.
    fn closed(
        &self,
        end: Vector3<f64>,
        start: Vector3<f64>,
        steps: &[f64],
    ) -> Result<HeldInWind, CableError> {
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

    /// The cable with the force `start` at its leave point, and the change of that force which would end it
    /// at `end` if the cable were linear.
    fn ended(&self, end: Vector3<f64>, start: Vector3<f64>, steps: &[f64]) -> (HeldInWind, Vector3<f64>) {
        let given = Given { force: [0, 1, 2].map(|k| Dual::<f64, 3>::input(start[k], k)), ..self.given() };
        let ([r, n], error) = self.extrapolated(&given, steps);
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
            steps: steps.len(),
        };
        (held, per_end * open)
    }

    /// Derivatives of the force of the cable on its anchor with both its ends fixed, (C42).
    ///
    /// # Errors
    /// [`CableError::NotConverged`] where the end does not follow the force at the leave point.
    pub fn slopes(&self, held: &HeldInWind) -> Result<InWindSlopes, CableError> {
        const INPUTS: usize = 11;
        let input = |value: f64, k: usize| Dual::<f64, INPUTS>::input(value, k);
        let own = self.given::<f64>();
        let given = Given {
            force: [0, 1, 2].map(|k| input(held.exit_force[k], k)),
            weight: [0, 1, 2].map(|k| input(own.weight[k], 3 + k)),
            drag: input(own.drag, 6),
            length: input(own.length, 7),
            axial_flexibility: input(own.axial_flexibility, 8),
            guided: input(own.guided, 9),
            height: input(own.height, 10),
        };
        let (state, _) = self.extrapolated(&given, &self.steps(held.exit_force, 1, ACCURACY)?);
        let [r, n] = state.map(|of| SMatrix::<f64, 3, INPUTS>::from_fn(|row, column| of[row].slopes[column]));
        let start = |of: &SMatrix<f64, 3, INPUTS>| of.fixed_columns::<3>(0).into_owned();
        let per_end = start(&r).try_inverse().filter(|inverse| inverse.iter().all(|x| x.is_finite()));
        let Some(per_end) = per_end else {
            return Err(CableError::NotConverged { iterations: 0, residual: held.closure });
        };
        let all = n - start(&n) * per_end * r;
        let column = |k: usize| Vector3::from(all.column(k));
        Ok(InWindSlopes {
            per_weight: all.fixed_columns::<3>(3).into_owned(),
            per_drag: column(6),
            per_length: column(7),
            per_axial_stiffness: -column(8) * own.axial_flexibility.powi(2),
            per_guided: column(9),
            per_height: column(10),
        })
    }

    /// The numbers of this cable, with no force at the leave point yet.
    fn given<T: Real>(&self) -> Given<T> {
        Given {
            force: [T::of(0.0); 3],
            weight: [0, 1, 2].map(|k| T::of(self.weight[k])),
            drag: T::of(self.drag),
            length: T::of(self.unstrained_length),
            axial_flexibility: T::of(1.0 / self.cable.axial_stiffness),
            guided: T::of(self.guided),
            height: T::of(self.profile.map_or(0.0, |profile| profile.height)),
        }
    }

    /// Unstrained length beyond the leave point with this tension there [N].
    fn free_length(&self, tension: f64) -> f64 {
        let given = self.given::<f64>();
        given.length - given.guided / self.material(&given).stretch(tension)[0]
    }

    /// The end of the cable by the shorter of two step sizes, with the error of its position [m], as if it
    /// were of the fourth power of the step: where the drag has a kink, the order is less than the method's.
    fn extrapolated<const N: usize>(
        &self,
        given: &Given<Dual<f64, N>>,
        steps: &[f64],
    ) -> (State<Dual<f64, N>>, f64) {
        let values = Given { force: given.force.map(|of| of.value), ..self.given::<f64>() };
        let (coarse, fine) = (self.integrated(&values, steps, 1), self.integrated(given, steps, 2));
        let apart = |k: usize| (fine[0][k].value - coarse[0][k]) / 15.0;
        (fine, Vector3::from([0, 1, 2].map(apart)).norm())
    }
}
