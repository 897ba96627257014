//! How a cable responds to its ends, its material and its guide, for the adjoint of an observation.
//!
//! At constant force and length the end of a cable moves by `e_w dw + e_f dφ` with its weight per length w
//! and its axial flexibility `φ = 1/EA`. With `y = d(h, z) - e_w dw - e_f dφ`, C the flexibility, K its
//! inverse and e the end per length, the force at A changes by
//!
//! ```text
//! df = K (y - e dL)   in the plane,      k_l dl   across it                                           (L8)
//! ```
//!
//! where the length is given. Where the tension is, the force can only turn: with u its direction, n̂ across
//! it in the plane, `N = C n̂` and `Δ = e x N`,
//!
//! ```text
//! df = n̂ (e x y)/Δ + f_t dt,      dL = (y x N - det C dt)/Δ,      f_t = u - n̂ (e x C u)/Δ        (L9)
//! ```
//!
//! Over a guide y also loses what lead, radius and axis move, (C24) and (C31), and with the weight of the
//! cable C has the skew part `a = (dx/dfz - dz/dfx)/2` of (C22). So does K:
//!
//! ```text
//! K = K_s + k_a (e_z e_hᵀ - e_h e_zᵀ),      k_a = a/det C                                         (L17)
//! ```

use crate::local::cable::LaneCable;
use crate::local::free::FreeCable;
use crate::local::guided::Guided;
use cdpr_cable::kernel::{GuideTerms, GuidedEndSlopes, Material, Response, SwivelAxis};
use cdpr_number::dense::Lanes3;
use cdpr_number::lanes::{Lanes, Simd};
use cdpr_number::vector::dot;
use cdpr_number::{Dual, Lanewise, apart};

/// A cable that is given its force and its length.
pub(super) struct CableResponse<T> {
    /// The response, with the determinant of the whole C.
    pub(super) response: Response<T>,
    /// e_w.
    pub(super) per_weight: [T; 2],
    /// e_f.
    pub(super) per_flexibility: [T; 2],
    /// What a guide adds.
    pub(super) guide: Option<Box<GuideResponse<T>>>,
}

/// How a cable responds to what guides it.
pub(super) struct GuideResponse<T> {
    /// a [m/N].
    asymmetry: T,
    pub(super) end: GuidedEndSlopes<T>,
}

impl<T: Lanewise> GuideResponse<T> {
    /// dx/dfz and dz/dfx from their mean.
    #[inline(always)]
    fn mixed(&self, mean: T) -> [T; 2] {
        [mean + self.asymmetry, mean - self.asymmetry]
    }
}

/// The response of a cable without guide.
#[inline(always)]
fn of_free<T: Lanewise>(FreeCable { material, length, force }: FreeCable<'_, T>) -> CableResponse<T> {
    let response = material.response(length, force);
    let material = Material {
        law: material.law,
        weight_per_length: Dual::<_, 2>::input(material.weight_per_length, 0),
        axial_flexibility: Dual::input(material.axial_flexibility, 1),
    };
    let force = [Dual::constant(force[0]), Dual::constant(force[1])];
    let [x, z] = material.end(Dual::constant(length), force).end;
    CableResponse {
        response,
        per_weight: [x.slopes[0], z.slopes[0]],
        per_flexibility: [x.slopes[1], z.slopes[1]],
        guide: None,
    }
}

impl<S: Simd> CableResponse<Lanes<S>> {
    /// The response of a cable to the force and the length that it has.
    #[inline(always)]
    pub(super) fn of(cable: &LaneCable<'_, S>) -> Self {
        match &cable.guided {
            None => without_guide(cable.free(), cable.length),
            Some(guided) => over_guide(guided.guide, cable.free(), cable.length),
        }
    }

    /// k_a of a cable over a guide [N/m].
    #[inline(always)]
    pub(super) fn skew_stiffness(&self) -> Option<Lanes<S>> {
        let guide = self.guide.as_ref()?;
        Some(guide.asymmetry / self.response.determinant)
    }
}

impl<S: Simd> CableResponse<Dual<Lanes<S>, 1>> {
    /// The response of a cable between fixed ends with its derivatives by the tension.
    #[inline(always)]
    pub(super) fn along_tension(cable: &LaneCable<'_, S>) -> Self {
        let [x, z, longer] = match &cable.guided {
            None => {
                let response = cable.response();
                let [_, mixed, _] = response.flexibility;
                let first = AtTension::of_flexibility(&response, [mixed, mixed]);
                [first.force_per_tension[0], first.force_per_tension[1], first.length_per_tension]
            }
            Some(guided) => first_over_guide(guided, cable),
        };
        let along = |value, slope| Dual { value, slopes: [slope] };
        let material = Material {
            law: cable.law,
            weight_per_length: Dual::constant(cable.weight_per_length),
            axial_flexibility: Dual::constant(cable.axial_flexibility),
        };
        let force = [along(cable.force[0], x), along(cable.force[1], z)];
        let given = FreeCable { material, length: along(cable.length, longer), force };
        match &cable.guided {
            None => without_guide(given, cable.length),
            Some(guided) => {
                let GuideTerms { lead, radius, .. } = guided.guide;
                let signed_radius = guided.guide.signed_radius();
                let guide = GuideTerms {
                    lead: Dual::constant(lead),
                    radius: Dual::constant(radius),
                    axis: SwivelAxis::Vertical(Dual::constant(signed_radius)),
                };
                over_guide(guide, given, cable.length)
            }
        }
    }
}

apart! {
    #[inline(always)]
    on(lanes) fn without_guide<'a, S: Simd, T: Lanewise>(
        given: FreeCable<'a, T>,
        lanes: Lanes<S>,
    ) -> CableResponse<T> {
        of_free(given)
    }

    /// The response of a cable over a guide, whose length is that beyond its leave point; `lanes` are those
    /// of the vector unit.
    #[cold]
    #[inline(never)]
    on(lanes) fn over_guide<'a, S: Simd, T: Lanewise>(
        guide: GuideTerms<T>,
        given: FreeCable<'a, T>,
        lanes: Lanes<S>,
    ) -> CableResponse<T> {
        let FreeCable { material, length: free, force } = given;
        let w = material.weight_per_length;
        let beyond = of_free(given);
        let leave = guide.leave_point(w, free, force);
        let way = guide.way(w, free, leave, material.stretch(leave.tension));
        let end = guide.end_slopes(
            &way,
            [material.axial_flexibility, free],
            [beyond.per_weight, beyond.per_flexibility],
        );
        let (response, asymmetry) = (way.response(force[0], &beyond.response), way.asymmetry());
        let determinant = response.determinant + asymmetry * asymmetry;
        CableResponse {
            response: Response { determinant, ..response },
            per_weight: end.per_weight,
            per_flexibility: end.per_flexibility,
            guide: Some(Box::new(GuideResponse { asymmetry, end })),
        }
    }
}

apart! {
    /// How the force at A and the length beyond the leave point change with the tension of a cable between
    /// fixed ends: f_t of (L9), and dLf by (C21).
    #[cold]
    #[inline(never)]
    on(cable.length) fn first_over_guide<'a, 'b, S: Simd>(
        guided: &'a Guided<S>,
        cable: &'a LaneCable<'b, S>,
    ) -> Lanes3<S> {
        let way = guided.way(&cable.free());
        let (response, a) = (way.response(cable.force[0], &cable.response()), way.asymmetry());
        let [_, mixed, _] = response.flexibility;
        let determinant = response.determinant + a * a;
        let response = Response { determinant, ..response };
        let at_tension = AtTension::of_flexibility(&response, [mixed + a, mixed - a]);
        let [x, z] = at_tension.force_per_tension;
        let longer = way.free_per_length * at_tension.length_per_tension;
        [x, z, longer + dot(&way.free_per_force, &at_tension.force_per_tension)]
    }
}

/// A cable between fixed ends whose tension is given, equation (L9).
pub(super) struct AtTension<T> {
    /// n̂.
    pub(super) normal: [T; 2],
    /// (-e_z, e_x)/Δ, by which the end turns the force.
    pub(super) turn_per_end: [T; 2],
    /// (N_z, -N_x)/Δ.
    pub(super) length_per_end: [T; 2],
    /// f_t.
    pub(super) force_per_tension: [T; 2],
    /// -det C/Δ.
    pub(super) length_per_tension: T,
}

impl<T: Lanewise> AtTension<T> {
    #[inline(always)]
    pub(super) fn of(found: &CableResponse<T>) -> Self {
        let CableResponse { response, guide, .. } = found;
        let [_, mixed, _] = response.flexibility;
        match guide {
            None => Self::of_flexibility(response, [mixed, mixed]),
            Some(guide) => Self::of_flexibility(response, guide.mixed(mixed)),
        }
    }

    /// The cable with this response, dx/dfz and dz/dfx.
    #[inline(always)]
    fn of_flexibility(response: &Response<T>, [xz, zx]: [T; 2]) -> Self {
        let ([xx, _, zz], [ux, uz]) = (response.flexibility, response.direction);
        let [ex, ez] = response.end_per_length;
        let across = [xz * ux - xx * uz, zz * ux - zx * uz];
        let inverse = (ex * across[1] - ez * across[0]).recip();
        let stretched = [xx * ux + xz * uz, zx * ux + zz * uz];
        let turned = (ez * stretched[0] - ex * stretched[1]) * inverse;
        Self {
            normal: [-uz, ux],
            turn_per_end: [-(ez * inverse), ex * inverse],
            length_per_end: [across[1] * inverse, -(across[0] * inverse)],
            force_per_tension: [ux - uz * turned, uz + ux * turned],
            length_per_tension: -(response.determinant * inverse),
        }
    }
}
