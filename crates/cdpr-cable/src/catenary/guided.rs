//! A cable that is led to its catenary over a lead and a swivelling pulley.
//!
//! The cable enters at D, the origin, in the direction `σ e_z` (σ = 1 upwards, -1 downwards). It lies on the
//! wheel until its direction is the tangent τ of the catenary at the leave point B. The force there is
//! `f0 = (fx, V0) = T0 τ`. With the wheel's centre at (r, 0)
//!
//! ```text
//! ψ = atan2(fx, -σ V0),   B = r (1 + cos ψ, σ sin ψ),   a = r (π - ψ)                             (C19)
//! ```
//!
//! Lead d and arc a carry T0 everywhere; their weight is neglected. Of the unstrained length L
//!
//! ```text
//! Lf = L - (a + d)/(1 + ε(T0)),      V0 = fz - w Lf                                               (C20)
//! ```
//!
//! remain between B and the anchor point A, which lies at `B + (x, z)(f, Lf)`. With `m = (cos ψ, σ sin ψ)`,
//! the unit vector from the centre to B, and the flexibility C of the free part,
//!
//! ```text
//! dLf = dL + q·df0,      q = r m/((1 + ε) T0) + (a + d) ε' τ/(1 + ε)²,      β = 1 + w q_z
//! df0 = df - w e_z dLf,  dLf = (dL + q·df)/β                                                      (C21)
//! d(x, z)/df = C + κ τ (τ - γ q)ᵀ,      κ = (a + d) ε'/(1 + ε),      γ = w τ_z/β                  (C22)
//! d(x, z)/dL = (1 + ε - κ γ) τ                                                                    (C23)
//! ```
//!
//! The motion of B along the wheel cancels exactly. (C22) is symmetric but for `κ γ q`: a constant tension
//! over lead and arc is not quite conservative for a cable with weight. The asymmetry is about `w r/T0` of
//! the flexibility of lead and arc. [`Response::flexibility`] holds the symmetric part.
//!
//! With the energy V of the free part (C7) and that of lead and arc, whose elastic energy per unstrained
//! length is u,
//!
//! ```text
//! V + w Lf B_z + w σ r² cos ψ + (a + d) u(T0)/(1 + ε)                                             (C25)
//! ```
//!
//! has the force at A for its gradient but for `w B_z` times what the stretch of lead and arc adds to dLf.
//!
//! By the other quantities, at constant force and length, with d(x, z)/dL of (C23),
//!
//! ```text
//! d(x, z)/dw  = d(x, z)/dw of the free part - κ τ_z Lf/β τ
//! d(x, z)/dEA = d(x, z)/dEA of the free part - (a + d) ∂(1/(1 + ε))/∂EA d(x, z)/dL
//! d(x, z)/dd  = -1/(1 + ε) d(x, z)/dL,      d(x, z)/dr = e_x + m - (π - ψ)/(1 + ε) d(x, z)/dL     (C24)
//! ```

use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::guide::Guide;
use crate::kernel::{Real, Response};
use crate::law::ElasticLaw;
use nalgebra::Vector2;

/// A cable on its guide, for a force at A and an unstrained length, over any kind of number.
#[derive(Clone, Copy)]
pub(crate) struct Guided<T> {
    /// Unstrained length Lf beyond the leave point [m].
    pub(crate) free: T,
    /// Angle ψ of the leave point from the horizontal through the wheel's centre [rad], with m = (cos ψ, σ
    /// sin ψ).
    pub(crate) psi: T,
    m: [T; 2],
    /// Direction of the cable at the leave point.
    tangent: [T; 2],
    /// Leave point B from D [m].
    pub(crate) leave: [T; 2],
    /// (1 + cos ψ) r/fx, the lateral flexibility of the leave point [m/N].
    lateral_flexibility: T,
    /// a + d [m].
    pub(crate) guided: T,
    /// 1 + ε(T0).
    stretch: T,
    /// ε'(T0) [1/N].
    flexibility: T,
    q: [T; 2],
    beta: T,
    /// What Lf and the unstrained length of lead and arc exceed L by [m].
    excess: T,
}

impl<T: Real> Guided<T> {
    /// (C19) to (C21) for an unstrained length `free` beyond the leave point that need not fit L.
    fn with_free(cable: &Cable, guide: &Guide, numbers: &Numbers<T>, [fx, fz]: [T; 2], free: T) -> Self {
        let Numbers { weight_per_length: w, axial_flexibility, lead, radius, length } = *numbers;
        let up = guide.entry.sign();
        let v0 = fz - w * free;
        let t0 = (fx * fx + v0 * v0 + f64::MIN_POSITIVE).sqrt();
        let (alpha, flexibility) = match cable.law {
            ElasticLaw::Linear => (T::of(1.0), axial_flexibility),
            ElasticLaw::Piecewise(law) => {
                let segment = law.segment_terms(t0.value(), axial_flexibility);
                (segment.alpha, segment.flexibility)
            }
        };
        let stretch = alpha + t0 * flexibility;
        let (cos, sin) = (v0 * -up / t0, fx / t0);
        let psi = fx.atan2(v0 * -up);
        // 1 + cos ψ without cancellation.
        let one_plus_cos = if cos.value() < 0.0 { sin * sin / (-cos + 1.0) } else { cos + 1.0 };
        // A vertical cable without a pulley has no lateral flexibility to add.
        let per_fx = if radius.value() == 0.0 && fx.value() == 0.0 {
            T::of(0.0)
        } else if cos.value() < 0.0 {
            sin / (t0 * (-cos + 1.0))
        } else {
            (cos + 1.0) / fx
        };
        let (m, tangent) = ([cos, sin * up], [sin, v0 / t0]);
        let guided = lead + radius * (-psi + std::f64::consts::PI);
        let (across, along) = (radius / (stretch * t0), guided * flexibility / (stretch * stretch));
        let q = [0, 1].map(|k| across * m[k] + along * tangent[k]);
        Self {
            free,
            psi,
            m,
            tangent,
            leave: [radius * one_plus_cos, radius * sin * up],
            lateral_flexibility: radius * per_fx,
            guided,
            stretch,
            flexibility,
            q,
            beta: w * q[1] + 1.0,
            excess: free + guided / stretch - length,
        }
    }

    /// The cable with the force `force` [N] at A, (C20).
    fn new(cable: &Cable, guide: &Guide, numbers: &Numbers<T>, force: [T; 2]) -> Self {
        let (plain, plain_force) = (numbers.map(T::value), force.map(T::value));
        let at = |free| Guided::with_free(cable, guide, &plain, plain_force, free);
        // A cable that is too short has a negative free length, for which all formulas go on.
        let mut free = plain.length - guide.lead;
        for _ in 0..MAX_ITERATIONS {
            let now = at(free);
            let step = -now.excess / now.beta;
            free += step;
            if step.abs() <= 1e-9 * plain.length {
                break;
            }
        }
        // One more step squares the error and gives the number its derivatives.
        let near = Self::with_free(cable, guide, numbers, force, T::of(free));
        let free = near.free - near.excess / near.beta;
        Self::with_free(cable, guide, numbers, force, free)
    }

    /// κ of (C22) [m/N].
    fn kappa(&self) -> T {
        self.guided * self.flexibility / self.stretch
    }

    /// The response of the whole cable from that of its free part, (C22) and (C23).
    fn response(&self, w: T, free: &Response<T>) -> Response<T> {
        let Self { tangent: [tx, tz], leave, stretch, q, beta, .. } = *self;
        let kappa = self.kappa();
        let gamma = w * tz / beta;
        let [px, pz] = [tx - gamma * q[0], tz - gamma * q[1]];
        let [xx, xz, zz] = free.flexibility;
        let twist = tx * pz - tz * px;
        let mixed = xx * tz * pz + zz * tx * px - xz * (tx * pz + tz * px);
        let paid_out = stretch - kappa * gamma;
        Response {
            end: [leave[0] + free.end[0], leave[1] + free.end[1]],
            flexibility: [xx + kappa * tx * px, xz + kappa * (tx * pz + tz * px) * 0.5, zz + kappa * tz * pz],
            determinant: free.determinant + kappa * mixed - kappa * kappa * twist * twist * 0.25,
            lateral_flexibility: free.lateral_flexibility + self.lateral_flexibility,
            end_per_length: [tx * paid_out, tz * paid_out],
            ..*free
        }
    }
}

const MAX_ITERATIONS: usize = 20;

/// The response to the force `force` [N] at A of a cable on a guide.
#[cold]
pub(crate) fn response<T: Real>(
    cable: &Cable,
    guide: &Guide,
    numbers: &Numbers<T>,
    force: [T; 2],
) -> Response<T> {
    let guided = Guided::new(cable, guide, numbers, force);
    let free = cable.free_response(&Numbers { length: guided.free, ..*numbers }, force);
    guided.response(numbers.weight_per_length, &free)
}

impl Cable<'_> {
    /// Half the difference `dx/dfz - dz/dfx` of the flexibility (C22) [m/N]; `None` without a guide.
    pub(crate) fn asymmetry<T: Real>(&self, numbers: &Numbers<T>, force: [T; 2]) -> Option<T> {
        let guided = Guided::new(self, self.guide.as_ref()?, numbers, force);
        let Guided { tangent: [tx, tz], q, beta, .. } = guided;
        let gamma = numbers.weight_per_length * tz / beta;
        Some(guided.kappa() * gamma * (tz * q[0] - tx * q[1]) * 0.5)
    }
}

/// Derivatives of the end position at constant force and length, (C24).
pub(crate) struct EndSlopes {
    pub(crate) per_weight: Vector2<f64>,
    pub(crate) per_stiffness: Vector2<f64>,
    pub(crate) per_lead: Vector2<f64>,
    pub(crate) per_radius: Vector2<f64>,
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
        let numbers = self.cable.numbers(self.unstrained_length);
        self.cable.asymmetry(&numbers, self.force.into()).unwrap_or(0.0)
    }

    /// Where the cable leaves its pulley, from the entry point [m]; zero without a pulley.
    pub fn leave_point(&self) -> Vector2<f64> {
        self.cable.guide.map_or_else(Vector2::zeros, |guide| self.guided(&guide).leave.into())
    }

    /// Positions [m] of `points` points (2 at least) of the cable on its pulley, from where it enters to just
    /// before it leaves; none without a pulley.
    pub fn on_the_pulley(&self, points: usize) -> Vec<Vector2<f64>> {
        let Some(guide) = self.cable.guide.filter(|guide| guide.radius > 0.0) else { return Vec::new() };
        let (wrap, count) = (self.wrap(), points.max(2));
        let angles = (0..count).map(|k| std::f64::consts::PI - wrap * k as f64 / count as f64);
        let of = |angle: f64| Vector2::new(1.0 + angle.cos(), guide.entry.sign() * angle.sin());
        angles.map(|angle| guide.radius * of(angle)).collect()
    }

    /// Angle over which the cable lies on its pulley [rad]; zero without a pulley.
    pub fn wrap(&self) -> f64 {
        match &self.cable.guide {
            Some(guide) if guide.radius > 0.0 => std::f64::consts::PI - self.guided(guide).psi,
            _ => 0.0,
        }
    }
}

/// Potential energy [J], (C25).
#[cold]
pub(crate) fn potential_energy(catenary: &Catenary, guide: &Guide) -> f64 {
    let (at, free, w) = (catenary.guided(guide), catenary.free(), catenary.cable.weight_per_length);
    let [_, height] = at.leave;
    let led = at.guided / at.stretch * catenary.cable.elastic_energy(free.exit_tension());
    let [cos, _] = at.m;
    let over_the_wheel = w * guide.entry.sign() * guide.radius * guide.radius * cos;
    free.potential_energy() + free.weight() * height + over_the_wheel + led
}

#[cold]
pub(crate) fn end_slopes(catenary: &Catenary, guide: &Guide) -> EndSlopes {
    let at = catenary.guided(guide);
    let free = catenary.free();
    let w = catenary.cable.weight_per_length;
    let (tangent, m) = (Vector2::from(at.tangent), Vector2::from(at.m));
    let kappa = at.kappa();
    let paid_out = tangent * (at.stretch - kappa * w * tangent.y / at.beta);
    let strain_per_stiffness = -(at.stretch - 1.0) / catenary.cable.axial_stiffness;
    EndSlopes {
        per_weight: free.end_per_weight() - tangent * (kappa * tangent.y * at.free / at.beta),
        per_stiffness: free.end_per_stiffness()
            + paid_out * (at.guided * strain_per_stiffness / (at.stretch * at.stretch)),
        per_lead: -paid_out / at.stretch,
        per_radius: Vector2::x() + m - paid_out * ((std::f64::consts::PI - at.psi) / at.stretch),
    }
}
