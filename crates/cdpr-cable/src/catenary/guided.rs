//! A cable that is led to its catenary over a lead and a swivelling pulley.
//!
//! The cable enters at D, the origin, in the direction k, the swivel axis. It lies on the wheel until its
//! direction is the tangent τ of the catenary at the leave point B, where the force is `F0 = T0 τ`. The plane
//! of the wheel contains k and τ; u is its direction normal to k, and n is normal to it:
//!
//! ```text
//! n sin ψ = k x τ,   u = n x k,   cos ψ = -τ·k,   m = cos ψ u + sin ψ k
//! B = r (u + m),     a = r (π - ψ)                                                               (C19)
//! ```
//!
//! Lead d and arc a carry T0 everywhere; their weight is neglected. Of the unstrained length L
//!
//! ```text
//! Lf = L - (a + d)/(1 + ε(T0)),      F0 = F - w Lf e_z                                            (C20)
//! ```
//!
//! remain between B and the anchor point A, where the force is F. A lies at B + P(F, Lf), with P that of the
//! free part. With its flexibility C in space,
//!
//! ```text
//! dLf = dL + q·dF0,      q = r m/((1 + ε) T0) + (a + d) ε' τ/(1 + ε)²,      β = 1 + w q_z
//! dF0 = dF - w e_z dLf,  dLf = (dL + q·dF)/β                                                      (C21)
//! dA/dF = C + κ τ (τ - γ q)ᵀ + μ n (n - δ q)ᵀ,      κ = (a + d) ε'/(1 + ε),   γ = w τ_z/β
//!                                                   μ = r (1 + cos ψ)/(T0 sin ψ),   δ = w n_z/β   (C22)
//! dA/dL = (1 + ε - κ γ) τ - μ δ n                                                                 (C23)
//! ```
//!
//! The motion of B along the wheel cancels exactly. (C22) is symmetric but for `κ γ q` and `μ δ q`: a
//! constant tension over lead and arc is not quite conservative for a cable with weight. The asymmetry is
//! about `w r/T0` of the flexibility of lead and arc. [`Response::flexibility`] holds the symmetric part.
//! For a vertical axis n is normal to the cable's plane: in the plane the terms with μ vanish, and across it
//! μ adds to the lateral flexibility.
//!
//! With the energy V of the free part (C7) and that of lead and arc, whose elastic energy per unstrained
//! length is u(T0),
//!
//! ```text
//! V + w Lf B_z + (a + d) u(T0)/(1 + ε) - w r² ((ψ - π + sin ψ) u_z - cos ψ k_z)                   (C25)
//! ```
//!
//! has the force at A for its gradient but for `w B_z` times what the stretch of lead and arc adds to dLf,
//! and for `w r²` times the turn of u out of the level plane.
//!
//! By the other quantities, at constant force and length, with dA/dL of (C23),
//!
//! ```text
//! dA/dw  = dP/dw - (κ τ_z τ + μ n_z n) Lf/β
//! dA/dEA = dP/dEA - (a + d) ∂(1/(1 + ε))/∂EA dA/dL
//! dA/dd  = -1/(1 + ε) dA/dL,      dA/dr = u + m - (π - ψ)/(1 + ε) dA/dL                           (C24)
//! ```

use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::guide::{Entry, Guide};
use crate::kernel::Response;
use crate::law::ElasticLaw;
use cdpr_number::Real;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::PI;

/// The way of a cable over its wheel, for a force at A and an unstrained length beyond the leave point that
/// need not fit the whole one, over any kind of number. Vectors are in the axes of the cable's plane:
/// forwards, across and upwards.
#[derive(Clone, Copy)]
pub(crate) struct Way<T> {
    /// Unstrained length Lf beyond the leave point [m].
    pub(crate) free: T,
    /// Angle ψ between the way in and the way back out [rad]: the cable lies on the wheel for π - ψ.
    pub(crate) psi: T,
    cos: T,
    sin: T,
    u: [T; 3],
    n: [T; 3],
    k: [T; 3],
    /// T0 [N].
    tension: T,
    /// Direction τ of the cable at the leave point, in its plane.
    tangent: [T; 2],
    /// a + d [m].
    pub(crate) guided: T,
    /// 1 + ε(T0).
    stretch: T,
    /// ε'(T0) [1/N].
    flexibility: T,
    /// q = across m + along τ [m/N].
    across: T,
    along: T,
    beta: T,
    /// What Lf and the unstrained length of lead and arc exceed L by [m].
    excess: T,
}

/// A cable on its guide.
#[derive(Clone, Copy)]
pub(crate) struct Guided<T> {
    pub(crate) way: Way<T>,
    m: [T; 3],
    /// Leave point B from D [m].
    pub(crate) leave: [T; 3],
    /// μ [m/N].
    mu: T,
    q: [T; 3],
}

/// An angle ψ [rad] with its cosine and sine.
type Angle<T> = [T; 3];

/// Sine of a turn up to which [`turned_from`] has all digits.
const SMALL_TURN: f64 = 1e-2;

impl<T: Real> Way<T> {
    /// (C19) to (C21) for an unstrained length `free` beyond the leave point; ψ is known nearby, or not yet.
    #[inline(always)]
    fn new(
        cable: &Cable,
        guide: &Guide,
        numbers: &Numbers<T>,
        [fx, fz]: [T; 2],
        free: T,
        nearby: Option<&Angle<T>>,
    ) -> Self {
        let Numbers { weight_per_length: w, axial_flexibility, lead, radius, length, axis } = *numbers;
        let (zero, one) = (T::of(0.0), T::of(1.0));
        let v0 = fz - w * free;
        let t0 = (fx * fx + v0 * v0 + f64::MIN_POSITIVE).sqrt();
        let (alpha, flexibility) = match cable.law {
            ElasticLaw::Linear => (one, axial_flexibility),
            ElasticLaw::Piecewise(law) => {
                let segment = law.segment_terms(t0.value(), axial_flexibility);
                (segment.alpha, segment.flexibility)
            }
        };
        let stretch = alpha + t0 * flexibility;
        let (tx, tz) = (fx / t0, v0 / t0);
        let ([cos, sin], u, n, k) = match guide.entry {
            Entry::Along(_) => {
                let [kx, ky, kz] = axis;
                let across = [ky * tz, kz * tx - kx * tz, -(ky * tx)];
                let sin = (across[0] * across[0] + across[1] * across[1] + across[2] * across[2]).sqrt();
                let [nx, ny, nz] = across.map(|component| component / sin);
                let u = [ny * kz - nz * ky, nz * kx - nx * kz, nx * ky - ny * kx];
                ([-(tx * kx + tz * kz), sin], u, [nx, ny, nz], axis)
            }
            vertical => {
                let up = T::of(vertical.axis()[2]);
                ([-(tz * up), tx], [one, zero, zero], [zero, up, zero], [zero, zero, up])
            }
        };
        let psi = nearby.and_then(|angle| turned_from(angle, cos, sin)).unwrap_or_else(|| sin.atan2(cos));
        let guided = lead + radius * (-psi + PI);
        let (across, along) = (radius / (stretch * t0), guided * flexibility / (stretch * stretch));
        Self {
            free,
            psi,
            cos,
            sin,
            u,
            n,
            k,
            tension: t0,
            tangent: [tx, tz],
            guided,
            stretch,
            flexibility,
            across,
            along,
            beta: w * (across * (cos * u[2] + sin * k[2]) + along * tz) + 1.0,
            excess: free + guided / stretch - length,
        }
    }

    fn angle(&self) -> Angle<T> {
        [self.psi, self.cos, self.sin]
    }
}

/// ψ of this cosine and sine, from an angle nearby; `None` where it is farther away than [`SMALL_TURN`].
#[inline(always)]
fn turned_from<T: Real>(&[psi, cos, sin]: &Angle<T>, new_cos: T, new_sin: T) -> Option<T> {
    let turn = new_sin * cos - new_cos * sin;
    let forwards = (new_cos * cos + new_sin * sin).value() > 0.0;
    // The series of the arcsine: what follows is below 4e-18 of the turn.
    let square = turn * turn;
    let series = square * (square * (square * (15.0 / 336.0) + 3.0 / 40.0) + 1.0 / 6.0) + 1.0;
    (forwards && turn.value().abs() <= SMALL_TURN).then(|| psi + turn * series)
}

impl<T: Real> Guided<T> {
    /// The cable with the force `force` [N] at A, (C20).
    pub(crate) fn new(cable: &Cable, guide: &Guide, numbers: &Numbers<T>, force: [T; 2]) -> Self {
        let (plain, plain_force) = (numbers.map(T::value), force.map(T::value));
        // A cable that is too short has a negative free length, for which all formulas go on.
        let mut free = plain.length - guide.lead;
        let mut angle = None;
        for _ in 0..MAX_ITERATIONS {
            let now = Way::new(cable, guide, &plain, plain_force, free, angle.as_ref());
            let step = -now.excess / now.beta;
            free += step;
            angle = Some(now.angle());
            // The tangent turns by this angle, and the excess that is left goes with its square.
            let per_length = plain.weight_per_length / now.tension;
            let extent = guide.radius + now.guided;
            let left = extent * (per_length * step).powi(2);
            if extent * (per_length * left).powi(2) <= 0.1 * f64::EPSILON * plain.length {
                break;
            }
        }
        // One more step squares the error and gives the number its derivatives.
        let angle = angle.map(|angle| angle.map(T::of));
        let near = Way::new(cable, guide, numbers, force, T::of(free), angle.as_ref());
        let free = near.free - near.excess / near.beta;
        Self::over(Way::new(cable, guide, numbers, force, free, Some(&near.angle())), numbers.radius)
    }

    /// What follows from the way over a wheel of this radius [m].
    #[inline(always)]
    fn over(way: Way<T>, radius: T) -> Self {
        let Way { cos, sin, u, k, tension: t0, tangent: [tx, tz], across, along, .. } = way;
        // 1 + cos ψ, and its share of sin ψ, without cancellation. A cable that goes straight on has no
        // wheel's plane: without a pulley that adds no flexibility.
        let backwards = cos.value() < 0.0;
        let one_plus_cos = if backwards { sin * sin / (-cos + 1.0) } else { cos + 1.0 };
        let mu = if radius.value() == 0.0 && sin.value() == 0.0 {
            T::of(0.0)
        } else if backwards {
            radius * sin / (t0 * (-cos + 1.0))
        } else {
            radius * (cos + 1.0) / (t0 * sin)
        };
        let m = [0, 1, 2].map(|i| cos * u[i] + sin * k[i]);
        Self {
            way,
            m,
            leave: [0, 1, 2].map(|i| radius * (one_plus_cos * u[i] + sin * k[i])),
            mu,
            q: [across * m[0] + along * tx, across * m[1], across * m[2] + along * tz],
        }
    }

    /// κ of (C22) [m/N].
    fn kappa(&self) -> T {
        self.way.guided * self.way.flexibility / self.way.stretch
    }

    /// τ in space.
    fn along(&self) -> [T; 3] {
        [self.way.tangent[0], T::of(0.0), self.way.tangent[1]]
    }

    /// The vectors by which κ τ and μ n are multiplied in (C22): τ - γ q and n - δ q.
    fn coupled(&self, w: T) -> [[T; 3]; 2] {
        let Way { tangent, n, beta, .. } = self.way;
        let [gamma, delta] = [tangent[1], n[2]].map(|z| w * z / beta);
        let along = self.along();
        [[0, 1, 2].map(|i| along[i] - gamma * self.q[i]), [0, 1, 2].map(|i| n[i] - delta * self.q[i])]
    }

    /// The response of the whole cable in its plane from that of its free part, (C22) and (C23).
    fn response(&self, w: T, free: &Response<T>) -> Response<T> {
        let Self { way: Way { tangent: [tx, tz], n: [nx, ny, nz], stretch, beta, .. }, leave, mu, .. } =
            *self;
        let kappa = self.kappa();
        let [[px, _, pz], [ox, oy, oz]] = self.coupled(w);
        let [xx, xz, zz] = free.flexibility;
        let twist = tx * pz - tz * px;
        let mixed = xx * tz * pz + zz * tx * px - xz * (tx * pz + tz * px);
        let mut flexibility =
            [xx + kappa * tx * px, xz + kappa * (tx * pz + tz * px) * 0.5, zz + kappa * tz * pz];
        let mut determinant = free.determinant + kappa * mixed - kappa * kappa * twist * twist * 0.25;
        let delta = w * nz / beta;
        let paid_out = stretch - kappa * w * tz / beta;
        let mut end_per_length = [tx * paid_out, tz * paid_out];
        if nx.value() != 0.0 || nz.value() != 0.0 {
            let more = [nx * ox, (nx * oz + nz * ox) * 0.5, nz * oz];
            flexibility = [0, 1, 2].map(|i| flexibility[i] + mu * more[i]);
            determinant = flexibility[0] * flexibility[2] - flexibility[1] * flexibility[1];
            end_per_length = [end_per_length[0] - mu * delta * nx, end_per_length[1] - mu * delta * nz];
        }
        Response {
            end: [leave[0] + free.end[0], leave[2] + free.end[1]],
            flexibility,
            determinant,
            lateral_flexibility: free.lateral_flexibility + mu * ny * oy,
            end_per_length,
            ..*free
        }
    }

    /// The response of the whole cable in space: end position, flexibility dA/dF, rows first, and dA/dL,
    /// (C22) and (C23).
    pub(crate) fn in_space(&self, w: T, free: &Response<T>) -> ([T; 3], [[T; 3]; 3], [T; 3]) {
        let Self { way: Way { tangent, n, stretch, beta, .. }, leave, mu, .. } = *self;
        let (kappa, along) = (self.kappa(), self.along());
        let [p, o] = self.coupled(w);
        let ([xx, xz, zz], zero) = (free.flexibility, T::of(0.0));
        let own = [[xx, zero, xz], [zero, free.lateral_flexibility, zero], [xz, zero, zz]];
        let axes = [0, 1, 2];
        let entry = |i: usize, j: usize| own[i][j] + kappa * along[i] * p[j] + mu * n[i] * o[j];
        let [gamma, delta] = [tangent[1], n[2]].map(|z| w * z / beta);
        let paid_out = stretch - kappa * gamma;
        (
            [leave[0] + free.end[0], leave[1], leave[2] + free.end[1]],
            axes.map(|i| axes.map(|j| entry(i, j))),
            axes.map(|i| along[i] * paid_out - mu * delta * n[i]),
        )
    }

    /// Half the difference `dx/dfz - dz/dfx` of the flexibility (C22) in the cable's plane [m/N].
    fn asymmetry(&self, w: T) -> T {
        let [[px, _, pz], [ox, _, oz]] = self.coupled(w);
        let ([tx, tz], [nx, _, nz]) = (self.way.tangent, self.way.n);
        (self.kappa() * (tx * pz - tz * px) + self.mu * (nx * oz - nz * ox)) * 0.5
    }
}

const MAX_ITERATIONS: usize = 20;

/// What a response does not tell of a cable on a guide.
pub(crate) struct OnGuide<T> {
    /// Half the difference `dx/dfz - dz/dfx` of the flexibility (C22) [m/N].
    pub(crate) asymmetry: T,
    /// Unstrained length beyond the leave point [m].
    pub(crate) free: T,
}

/// The response to the force `force` [N] at A of a cable on a guide.
#[cold]
pub(crate) fn response<T: Real>(
    cable: &Cable,
    guide: &Guide,
    numbers: &Numbers<T>,
    force: [T; 2],
) -> (Response<T>, OnGuide<T>) {
    let guided = Guided::new(cable, guide, numbers, force);
    let free = cable.free_response(&Numbers { length: guided.way.free, ..*numbers }, force);
    let w = numbers.weight_per_length;
    let on_guide = OnGuide { asymmetry: guided.asymmetry(w), free: guided.way.free };
    (guided.response(w, &free), on_guide)
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
                unstrained_length: self.guided(guide).way.free,
                force: self.force,
            },
        }
    }

    /// Half the difference `dx/dfz - dz/dfx` of the flexibility [m/N], (C22); zero without a guide.
    ///
    /// [`crate::kernel::Response::flexibility`] is the symmetric part alone.
    pub fn asymmetry(&self) -> f64 {
        self.cable.guide.map_or(0.0, |guide| self.guided(&guide).asymmetry(self.cable.weight_per_length))
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
        self.cable.guide.map_or([0.0; 3], |guide| self.guided(&guide).leave)
    }

    /// Positions [m] of `points` points (2 at least) of the cable on its pulley, from where it enters to just
    /// before it leaves: forwards, across and upwards. None without a pulley.
    pub fn on_the_pulley(&self, points: usize) -> Vec<Vector3<f64>> {
        let Some(guide) = self.cable.guide.filter(|guide| guide.radius > 0.0) else { return Vec::new() };
        let (at, count) = (self.guided(&guide), points.max(2));
        let (u, axis) = (Vector3::from(at.way.u), Vector3::from(guide.entry.axis()));
        let angles = (0..count).map(|k| PI - self.wrap() * k as f64 / count as f64);
        angles.map(|angle| guide.radius * ((1.0 + angle.cos()) * u + angle.sin() * axis)).collect()
    }

    /// Positions [m] of `points` points around the wheel of the pulley and the first one again: forwards,
    /// across and upwards. None without a pulley.
    pub fn wheel(&self, points: usize) -> Vec<Vector3<f64>> {
        let Some(guide) = self.cable.guide.filter(|guide| guide.radius > 0.0) else { return Vec::new() };
        let (u, axis) = (Vector3::from(self.guided(&guide).way.u), Vector3::from(guide.entry.axis()));
        let angles = (0..=points).map(|k| 2.0 * PI * k as f64 / points as f64);
        angles.map(|angle| guide.radius * ((1.0 + angle.cos()) * u + angle.sin() * axis)).collect()
    }

    /// Angle over which the cable lies on its pulley [rad]; zero without a pulley.
    pub fn wrap(&self) -> f64 {
        match &self.cable.guide {
            Some(guide) if guide.radius > 0.0 => PI - self.guided(guide).way.psi,
            _ => 0.0,
        }
    }
}

/// Potential energy [J], (C25).
#[cold]
pub(crate) fn potential_energy(catenary: &Catenary, guide: &Guide) -> f64 {
    let (Guided { way: at, leave, .. }, free) = (catenary.guided(guide), catenary.free());
    let w = catenary.cable.weight_per_length;
    let ([_, _, height], [_, _, rise], [_, _, up]) = (leave, at.u, guide.entry.axis());
    let led = at.guided / at.stretch * catenary.cable.elastic_energy(free.exit_tension());
    let over_the_wheel = (at.psi - PI + at.psi.sin()) * rise - at.cos * up;
    let square = guide.radius * guide.radius;
    free.potential_energy() + free.weight() * height + led - w * square * over_the_wheel
}

#[cold]
pub(crate) fn end_slopes(catenary: &Catenary, guide: &Guide) -> EndSlopes {
    let (guided, free) = (catenary.guided(guide), catenary.free());
    let (at, w) = (guided.way, catenary.cable.weight_per_length);
    let tangent = Vector2::from(at.tangent);
    let [u, m, n] = [at.u, guided.m, at.n].map(|[x, _, z]| Vector2::new(x, z));
    let (along, across) = (guided.kappa() * tangent.y * tangent, guided.mu * n.y * n);
    let paid_out = tangent * at.stretch - (along + across) * (w / at.beta);
    let strain_per_stiffness = -(at.stretch - 1.0) / catenary.cable.axial_stiffness;
    EndSlopes {
        per_weight: free.end_per_weight() - (along + across) * (at.free / at.beta),
        per_stiffness: free.end_per_stiffness()
            + paid_out * (at.guided * strain_per_stiffness / (at.stretch * at.stretch)),
        per_lead: -paid_out / at.stretch,
        per_radius: u + m - paid_out * ((PI - at.psi) / at.stretch),
    }
}
