//! A cable that is led to its catenary over a lead and a swivelling pulley, over any kind of number.
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
//! μ adds to the lateral flexibility. With α the elevation of τ, and ρ the radius r with the sign of k_z,
//! positive for a cable that enters from below,
//!
//! ```text
//! B = (r - ρ τ_z, ρ τ_x),      a = r π/2 - ρ α,      r m = ρ (-τ_z, τ_x),      μ = B_x/fx        (C30)
//! ```
//!
//! The unknowns here are the force F and the free length Lf, from which all else follows without iteration.
//! Only the angle needs more than a root or a quotient.
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
//!
//! If a vertical axis k turns by dκ within the plane, towards the cable, u turns by -k dκ and ψ by dκ; m
//! stays normal to τ. If k turns across the plane, u and m turn with it by cos ψ/sin ψ and 1/sin ψ of its
//! angle:
//!
//! ```text
//! dA/dκ = -ρ e_z + r/(1 + ε) dA/dL  in the plane,      r (1 + cos ψ)/sin ψ = B_x/τ_x  across it  (C31)
//! ```

mod wheel;

use super::response::Response;
use super::series::elevation;
use cdpr_number::Lanewise;
use std::f64::consts::FRAC_PI_2;
use wheel::{Swung, Wheel};

/// A lead and a pulley after it.
#[derive(Clone, Copy, Debug)]
pub struct GuideTerms<T> {
    /// Stretched length d between winch and D [m].
    pub lead: T,
    /// Radius r of the pulley [m]; zero without one.
    pub radius: T,
    /// The swivel axis.
    pub axis: SwivelAxis<T>,
}

/// The swivel axis k of a pulley, along which the cable enters.
#[derive(Clone, Copy, Debug)]
pub enum SwivelAxis<T> {
    /// It is vertical: ρ [m], the radius, negative for a cable that enters from above.
    Vertical(T),
    /// This unit vector: forwards in the cable's plane, across it to the left, and upwards.
    Along([T; 3]),
}

/// Where a cable leaves its pulley.
#[derive(Clone, Copy, Debug)]
pub struct LeavePoint<T> {
    /// Position B from D in the cable's plane [m].
    pub position: [T; 2],
    /// Direction τ of the cable.
    pub tangent: [T; 2],
    /// T0 [N].
    pub tension: T,
    /// 1/T0 [1/N].
    pub tension_inv: T,
    /// The wheel that is not in the cable's plane.
    wheel: Option<Wheel<T>>,
}

/// The way of a cable over its guide.
#[derive(Clone, Copy, Debug)]
pub struct Way<T> {
    /// Where it leaves.
    pub leave: LeavePoint<T>,
    /// Unstrained length L, lead and arc included [m].
    pub length: T,
    /// dLf/dF at constant L, q/β of (C21) [m/N].
    pub free_per_force: [T; 2],
    /// dLf/dL at constant F, 1/β.
    pub free_per_length: T,
    /// dA/dL at constant F, (C23).
    pub end_per_length: [T; 2],
    /// κ [m/N] and τ - γ q of (C22).
    kappa: T,
    coupled: [T; 2],
    /// Elevation of the cable above the wheel's level [rad]: it lies on it for π/2 less this angle, with the
    /// sign of k_z.
    elevation: T,
    /// a + d [m].
    pub(crate) guided: T,
    /// 1 + ε(T0), and its inverse.
    pub(crate) stretch: T,
    stretch_inv: T,
    swung: Option<Swung<T>>,
}

/// Derivatives of the end of a cable over a guide at constant force and length, (C24) and (C31).
#[derive(Clone, Copy, Debug)]
pub struct GuidedEndSlopes<T> {
    /// Per weight per length [m²/N].
    pub per_weight: [T; 2],
    /// Per axial flexibility 1/EA [N m].
    pub per_flexibility: [T; 2],
    /// Per lead [m/m].
    pub per_lead: [T; 2],
    /// Per radius of the pulley [m/m].
    pub per_radius: [T; 2],
    /// Per turn of the axis k towards the cable, in its plane [m/rad].
    pub per_axis: [T; 2],
    /// Across the plane, per turn of k across it [m/rad].
    pub across_per_axis: T,
}

/// The response of a cable over a guide in space: the axes are forwards, across to the left and upwards.
pub struct GuidedInSpace<T> {
    /// B from D [m].
    pub leave: [T; 3],
    /// A from D [m].
    pub end: [T; 3],
    /// Rows of dA/dF at constant length [m/N], (C22).
    pub flexibility: [[T; 3]; 3],
    /// dA/dL at constant force, (C23).
    pub end_per_length: [T; 3],
    /// dLf/dF at constant length, q/β of (C21) [m/N].
    pub free_per_force: [T; 3],
}

impl<T: Lanewise> GuideTerms<T> {
    /// ρ of a vertical axis [m].
    #[inline(always)]
    pub fn signed_radius(&self) -> T {
        match self.axis {
            SwivelAxis::Vertical(signed) => signed,
            SwivelAxis::Along([_, _, up]) => up * self.radius,
        }
    }

    /// B for the direction τ of a cable, in its plane: (C30) under a vertical axis, else (C19).
    #[inline(always)]
    pub fn leave_position(&self, [tx, tz]: [T; 2]) -> [T; 2] {
        match self.axis {
            SwivelAxis::Vertical(signed) => [self.radius - signed * tz, signed * tx],
            SwivelAxis::Along(axis) => {
                let [x, _, z] = Wheel::new(self.radius, axis, [tx, tz]).leave(self.radius, axis);
                [x, z]
            }
        }
    }

    /// Where a cable of weight `w` [N/m] and unstrained length `free` [m] beyond its leave point leaves it,
    /// with the force `[fx, fz]` [N] at A.
    #[inline(always)]
    pub fn leave_point(&self, w: T, free: T, [fx, fz]: [T; 2]) -> LeavePoint<T> {
        let v0 = fz - w * free;
        let tension = (fx * fx + v0 * v0 + f64::MIN_POSITIVE).sqrt();
        let tension_inv = tension.recip();
        let tangent = [fx * tension_inv, v0 * tension_inv];
        match self.axis {
            SwivelAxis::Vertical(_) => {
                let position = self.leave_position(tangent);
                LeavePoint { position, tangent, tension, tension_inv, wheel: None }
            }
            SwivelAxis::Along(axis) => {
                let wheel = Wheel::new(self.radius, axis, tangent);
                let position = wheel.leave(self.radius, axis);
                let wheel = Some(Wheel { leave_across: position[1], ..wheel });
                LeavePoint { position: [position[0], position[2]], tangent, tension, tension_inv, wheel }
            }
        }
    }

    /// The way of the cable of [`GuideTerms::leave_point`]; `stretch` has 1 + ε(T0) and ε'(T0) [1/N].
    #[inline(always)]
    pub fn way(&self, w: T, free: T, leave: LeavePoint<T>, [stretch, flexibility]: [T; 2]) -> Way<T> {
        let LeavePoint { tangent: [tx, tz], tension_inv, wheel, .. } = leave;
        // ρ with (-τ_z, τ_x), or r with m.
        let (elevation, size, [mx, mz]) = match wheel {
            None => (elevation([tx, tz]), self.signed_radius(), [-tz, tx]),
            Some(Wheel { sin, cos, m, .. }) => (-elevation([sin, cos]), self.radius, [m[0], m[2]]),
        };
        let guided = self.lead + self.radius * FRAC_PI_2 - size * elevation;
        let stretch_inv = stretch.recip();
        let across = size * stretch_inv * tension_inv;
        let kappa = guided * flexibility * stretch_inv;
        let along = kappa * stretch_inv;
        let [qx, qz] = [along * tx + across * mx, along * tz + across * mz];
        let free_per_length = (w * qz + 1.0).recip();
        let gamma = w * tz * free_per_length;
        let paid_out = stretch - kappa * gamma;
        let mut end_per_length = [tx * paid_out, tz * paid_out];
        let swung = wheel.map(|wheel| {
            let (n, qy) = (wheel.n, across * wheel.m[1]);
            let (mu, delta) = (wheel.mu(self.radius, tension_inv), w * n[2] * free_per_length);
            end_per_length[0] = end_per_length[0] - mu * delta * n[0];
            end_per_length[1] = end_per_length[1] - mu * delta * n[2];
            let coupled = [n[0] - delta * qx, n[1] - delta * qy, n[2] - delta * qz];
            let free_across = qy * free_per_length;
            Swung { wheel, mu, delta, coupled, coupled_across: -(gamma * qy), free_across }
        });
        Way {
            leave,
            length: free + guided * stretch_inv,
            free_per_force: [qx * free_per_length, qz * free_per_length],
            free_per_length,
            end_per_length,
            kappa,
            coupled: [tx - gamma * qx, tz - gamma * qz],
            elevation,
            guided,
            stretch,
            stretch_inv,
            swung,
        }
    }

    /// k_z of a vertical axis: 1 for a cable that enters from below, -1 from above, 0 without a pulley.
    #[inline(always)]
    pub fn upwards(&self) -> T {
        T::select(self.radius.at_most(0.0), self.radius * 0.0, self.signed_radius() / self.radius)
    }

    /// How the end moves with what the cable of `way` and this guide are, under a vertical axis. The part
    /// beyond the leave point has the unstrained length `free` [m], and an end that moves by `heavier` per
    /// weight per length and by `softer` per axial flexibility.
    #[inline(always)]
    pub fn end_slopes(
        &self,
        way: &Way<T>,
        [axial_flexibility, free]: [T; 2],
        [heavier, softer]: [[T; 2]; 2],
    ) -> GuidedEndSlopes<T> {
        let Way { leave: LeavePoint { position, tangent: [tx, tz], .. }, stretch_inv, .. } = *way;
        let [ex, ez] = way.end_per_length;
        let hung = way.kappa * tz * free * way.free_per_length;
        let strained = (way.stretch + -1.0) / axial_flexibility;
        let softened = way.guided * strained * stretch_inv * stretch_inv;
        let upwards = self.upwards();
        let wrapped = (-(upwards * way.elevation) + FRAC_PI_2) * stretch_inv;
        let paid_out = self.radius * stretch_inv;
        GuidedEndSlopes {
            per_weight: [heavier[0] - hung * tx, heavier[1] - hung * tz],
            per_flexibility: [softer[0] + softened * ex, softer[1] + softened * ez],
            per_lead: [-(ex * stretch_inv), -(ez * stretch_inv)],
            per_radius: [-(upwards * tz) + 1.0 - wrapped * ex, upwards * tx - wrapped * ez],
            per_axis: [paid_out * ex, paid_out * ez - self.signed_radius()],
            across_per_axis: position[0] / tx,
        }
    }
}

impl<T: Lanewise> Way<T> {
    /// Half the difference `dx/dfz - dz/dfx` of the flexibility (C22) [m/N].
    #[inline(always)]
    pub fn asymmetry(&self) -> T {
        let Self { leave: LeavePoint { tangent: [tx, tz], .. }, kappa, coupled: [px, pz], .. } = *self;
        let in_plane = kappa * (tx * pz - tz * px) * 0.5;
        match self.swung {
            None => in_plane,
            Some(Swung { wheel: Wheel { n, .. }, mu, coupled: [ox, _, oz], .. }) => {
                in_plane + mu * (n[0] * oz - n[2] * ox) * 0.5
            }
        }
    }

    /// The response of the whole cable from that of its free part to `fx` [N] forwards, (C22), (C23).
    #[inline(always)]
    pub fn response(&self, fx: T, free: &Response<T>) -> Response<T> {
        let Self { leave: LeavePoint { position, tangent: [tx, tz], .. }, kappa, coupled: [px, pz], .. } =
            *self;
        let [xx, xz, zz] = free.flexibility;
        let twist = kappa * (tx * pz - tz * px) * 0.5;
        let mixed = (tx * pz + tz * px) * 0.5;
        let more = xx * tz * pz + zz * tx * px - xz * mixed * 2.0;
        let response = Response {
            end: [position[0] + free.end[0], position[1] + free.end[1]],
            flexibility: [xx + kappa * tx * px, xz + kappa * mixed, zz + kappa * tz * pz],
            determinant: free.determinant + kappa * more - twist * twist,
            end_per_length: self.end_per_length,
            ..*free
        };
        match self.swung {
            None => Response { lateral_flexibility: free.lateral_flexibility + self.lateral(fx), ..response },
            Some(Swung { wheel: Wheel { n: [nx, ny, nz], .. }, mu, coupled: [ox, oy, oz], .. }) => {
                let [xx, xz, zz] = response.flexibility;
                let xx = xx + mu * nx * ox;
                let xz = xz + mu * (nx * oz + nz * ox) * 0.5;
                let zz = zz + mu * nz * oz;
                Response {
                    flexibility: [xx, xz, zz],
                    determinant: xx * zz - xz * xz,
                    lateral_flexibility: free.lateral_flexibility + mu * ny * oy,
                    ..response
                }
            }
        }
    }

    /// μ of a vertical axis [m/N], (C30).
    #[inline(always)]
    fn lateral(&self, fx: T) -> T {
        let [x, _] = self.leave.position;
        T::select(x.at_most(0.0), x * 0.0, x / fx)
    }

    /// The response of the whole cable in space from that of its free part to `fx` [N] forwards, (C22) and
    /// (C23).
    #[inline(always)]
    pub fn in_space(&self, fx: T, free: &Response<T>) -> GuidedInSpace<T> {
        let Self { leave, kappa, coupled: [px, pz], end_per_length: [ex, ez], .. } = *self;
        let ([tx, tz], zero, [qx, qz]) = (leave.tangent, fx * 0.0, self.free_per_force);
        let ([xx, xz, zz], across) = (free.flexibility, free.lateral_flexibility);
        let (py, mu, n, o, delta, qy, leave_across) = match self.swung {
            None => {
                let across = [zero, zero + 1.0, zero];
                (zero, self.lateral(fx), across, across, zero, zero, zero)
            }
            Some(Swung { wheel, mu, coupled, coupled_across, delta, free_across }) => {
                (coupled_across, mu, wheel.n, coupled, delta, free_across, wheel.leave_across)
            }
        };
        let (t, p) = ([tx, zero, tz], [px, py, pz]);
        let mut flexibility = [[xx, zero, xz], [zero, across, zero], [xz, zero, zz]];
        for i in 0..3 {
            for j in 0..3 {
                flexibility[i][j] = flexibility[i][j] + kappa * t[i] * p[j] + mu * n[i] * o[j];
            }
        }
        GuidedInSpace {
            leave: [leave.position[0], leave_across, leave.position[1]],
            end: [leave.position[0] + free.end[0], leave_across, leave.position[1] + free.end[1]],
            flexibility,
            end_per_length: [ex, -(mu * delta * n[1]), ez],
            free_per_force: [qx, qy, qz],
        }
    }

    /// Across the plane, the position of B from D [m] and dA/dL.
    #[inline(always)]
    pub fn across(&self) -> [T; 2] {
        match self.swung {
            None => [self.length * 0.0; 2],
            Some(Swung { wheel, mu, delta, .. }) => [wheel.leave_across, -(mu * delta * wheel.n[1])],
        }
    }

    /// B from D [m], forwards, across and upwards.
    pub(crate) fn leave_in_space(&self) -> [T; 3] {
        let [x, z] = self.leave.position;
        [x, self.leave.wheel.map_or(x * 0.0, |wheel| wheel.leave_across), z]
    }

    /// u, away from the swivel axis in the plane of the wheel.
    pub(crate) fn away(&self) -> [T; 3] {
        let zero = self.length * 0.0;
        self.leave.wheel.map_or([zero + 1.0, zero, zero], |wheel| wheel.u)
    }
}
