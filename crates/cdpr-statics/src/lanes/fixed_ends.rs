//! A cable at its fixed ends, one in each lane.

use crate::equations::Span;
use crate::local::cable::LaneCable;
use crate::local::guided::Guided;
use cdpr_cable::kernel::{AtFixedEnds, LeavePoint, Response, TAUT};
use cdpr_number::dense::{Lanes2, Lanes3, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd, WithSimd};
use cdpr_number::{Lanewise, Number};

/// Part of a tension by which it has to exceed the least one of the span, as its slope and curvature tell.
/// The scalar models keep cables at 0.001, which the estimate meets within a few percent.
const NEAR_LEAST: f64 = 0.0015;

/// The same of a cable that is not let below the least tension of its span.
const AT_LEAST: f64 = 0.0005;

/// q² up to which the force of a cable that is being closed turns nearly as its chord.
const NEARLY_CHORD: f64 = 0.1;

/// Greatest part of its horizontal force that a step takes away from a cable.
const GREATEST_LOSS: f64 = 0.9;

/// A cable at its fixed ends, equation (L1).
#[derive(Clone, Copy)]
pub(crate) struct FixedEnds<S: Simd> {
    /// t, and that with the closing force.
    pub(crate) tension: Lanes<S>,
    pub(crate) closed: Lanes<S>,
    /// û_x, the part of the force that is horizontal.
    pub(crate) flatness: Lanes<S>,
    /// q².
    pub(crate) slackness: Lanes<S>,
    /// dz and dL.
    pub(crate) closing: Lanes2<S>,
    /// g.
    pub(crate) rise: Lanes<S>,
    /// L'.
    pub(crate) length_slope: Lanes<S>,
    /// t'.
    pub(crate) tension_slope: Lanes<S>,
    /// t'' and fz''; over a tilted axis those of the part beyond the leave point.
    pub(crate) curvatures: Lanes2<S>,
    /// Force across the plane by which a cable over a tilted axis closes, and by fx, (L19); else zero.
    pub(crate) across: Lanes2<S>,
}

impl<S: Simd> FixedEnds<S> {
    /// A cable between its ends.
    #[inline(always)]
    pub(crate) fn new(cable: &LaneCable<'_, S>, span: &Span<Lanes<S>>) -> Self {
        match &cable.guided {
            None => Self::plain(cable, span, &cable.response()),
            Some(guided) => Self::leaving(guided, cable, span),
        }
    }

    /// A cable over a pulley.
    #[cold]
    #[inline(never)]
    fn over_pulley(guided: &Guided<S>, cable: &LaneCable<'_, S>, span: &Span<Lanes<S>>) -> Self {
        cable.length.apart(Leaving { guided, cable, span })
    }

    /// A cable over a pulley. Its numbers are taken one by one: those of plain cables stay in registers.
    #[inline(always)]
    pub(crate) fn leaving(guided: &Guided<S>, cable: &LaneCable<'_, S>, span: &Span<Lanes<S>>) -> Self {
        let fixed = Self::over_pulley(guided, cable, span);
        Self {
            tension: fixed.tension,
            closed: fixed.closed,
            flatness: fixed.flatness,
            slackness: fixed.slackness,
            closing: [fixed.closing[0], fixed.closing[1]],
            rise: fixed.rise,
            length_slope: fixed.length_slope,
            tension_slope: fixed.tension_slope,
            curvatures: [fixed.curvatures[0], fixed.curvatures[1]],
            across: [fixed.across[0], fixed.across[1]],
        }
    }

    /// A cable without guide, from its response.
    #[inline(always)]
    pub(crate) fn plain(
        cable: &LaneCable<'_, S>,
        span: &Span<Lanes<S>>,
        response: &Response<Lanes<S>>,
    ) -> Self {
        let [ux, uz] = response.direction;
        let AtFixedEnds { closing: [_, rising, longer], per_force: [_, here, length_slope], .. } =
            plain(cable, span, response);
        let closing = [rising, longer];
        // Closing turns the force, and g ≈ z/h with the chord: from fz = fx z/h + w L/2.
        let fx_inv = cable.force[0].recip();
        let turns = response.slackness.at_most(NEARLY_CHORD);
        let tilt = turns.select(closing[0] * response.tension_inv, here.all(0.0));
        let turn = (closing[0] - cable.weight_per_length * closing[1] * 0.5) * fx_inv;
        let rise = here + turns.select(turn, here.all(0.0));
        let across = ux * here - uz;
        let tension_slope = ux + uz * rise + across * ux * tilt;
        let bent = response.slackness * (here * (2.0 / 3.0) - across * ux) * fx_inv;
        let mut fixed = Self {
            tension: response.tension,
            closed: response.tension + uz * closing[0],
            flatness: ux,
            slackness: response.slackness,
            closing,
            rise,
            length_slope,
            tension_slope,
            curvatures: [bent, bent],
            across: [fx_inv.all(0.0); 2],
        };
        let taut = response.slackness.at_most(TAUT);
        if !<Lanes<S> as Lanewise>::all(taut) {
            fixed.curvatures[1] = taut.select(bent, fixed.curvature(cable, span));
        }
        // |n̂·f'|²/t = (|f'|² - t'²)/t
        fixed.curvatures[0] = across * across * response.tension_inv + uz * fixed.curvatures[1];
        fixed
    }

    /// fz'' of the inextensible catenary. With u = w h/(2 fx), q = tanh u, φ = u/q and S = sinh u/u,
    ///
    /// ```text
    /// fz = fx (z/h) u coth u + w L/2,     L² = z² + h² S²                                           (L4)
    /// fz'' = (2 z/(h fx)) φ² (1 - q²) (φ - 1) + (w/2) L''
    /// L' = -h² S² (φ - 1)/(fx L),     L L'' = h² S² ((φ - 1)² + u²)/fx² - L'²
    /// ```
    ///
    /// Its first terms, (u²/fx) (2 z/(3 h) + u h/L), are that of a taut cable.
    #[inline(always)]
    fn curvature(&self, cable: &LaneCable<'_, S>, span: &Span<Lanes<S>>) -> Lanes<S> {
        let [h, z] = span.end;
        let fx_inv = cable.force[0].recip();
        let u = cable.weight_per_length * h * fx_inv * 0.5;
        let q = self.slackness.sqrt();
        let phi = u / q;
        let more = phi + -1.0;
        let narrow = phi * phi * (-self.slackness + 1.0);
        let wide = h * h / narrow;
        let length = (z * z + wide).sqrt();
        let slope = wide * more / length;
        let of_length = (wide * (more * more + u * u) - slope * slope) / length * fx_inv;
        (z / h * narrow * more * 2.0 + cable.weight_per_length * 0.5 * of_length) * fx_inv
    }

    /// Where the tension falls as cable is paid out, and is above the least one that the span demands by
    /// `share` of itself.
    ///
    /// Newton's step towards the least tension, over ln fx, lowers it by half of
    /// `(fx t')²/(fx t' + fx² t'')`.
    #[inline(always)]
    pub(crate) fn exceeds_least(&self, cable: &LaneCable<'_, S>, share: Lanes<S>) -> Mask<S> {
        let fx = cable.force[0];
        let slope = fx * self.tension_slope;
        let curvature = slope + fx * fx * self.curvatures[0];
        slope.all(0.0).less_or_equal(slope)
            & (curvature * self.tension * share * 2.0).less_or_equal(slope * slope)
    }

    /// The same, not next to the least tension, at which the scalar models keep a cable; it is known where it
    /// is `demanded`.
    #[inline(always)]
    pub(crate) fn is_taut(&self, cable: &LaneCable<'_, S>, demanded: Mask<S>) -> Mask<S> {
        let zero = cable.length.all(0.0);
        self.exceeds_least(cable, demanded.select(zero.all(AT_LEAST), zero.all(NEAR_LEAST)))
    }

    /// The change of fx that brings the tension to `tension`.
    #[inline(always)]
    pub(crate) fn way_to(&self, tension: Lanes<S>) -> Lanes<S> {
        (tension - self.closed) / self.tension_slope
    }

    /// The force of the closed cable on the platform [N].
    #[inline(always)]
    pub(crate) fn pull(&self, cable: &LaneCable<'_, S>, span: &Span<Lanes<S>>) -> Lanes3<S> {
        let [fx, fz] = cable.force;
        self.in_space(cable, span, [fx, fz + self.closing[0]], self.across[0])
    }

    /// Its derivative by fx.
    #[inline(always)]
    pub(crate) fn pull_slope(&self, cable: &LaneCable<'_, S>, span: &Span<Lanes<S>>) -> Lanes3<S> {
        self.in_space(cable, span, [self.rise.all(1.0), self.rise], self.across[1])
    }

    #[inline(always)]
    fn in_space(
        &self,
        cable: &LaneCable<'_, S>,
        span: &Span<Lanes<S>>,
        force: Lanes2<S>,
        across: Lanes<S>,
    ) -> Lanes3<S> {
        let plane = cable.plane(span);
        let mut pull = plane.force_on_platform(force);
        if cable.is_tilted() {
            pull[0] += across * plane.azimuth[1];
            pull[1] -= across * plane.azimuth[0];
        }
        pull
    }

    /// Whether the steps that follow the change `d` of fx change no force by more than about `share` of
    /// itself. With y the relative change of force and length, closing included, they are y² of what is not
    /// linear, and y q² of the sag that is neglected in t' and w''. Over a tilted axis w'' is not known so
    /// well.
    #[inline(always)]
    pub(crate) fn is_last(&self, cable: &LaneCable<'_, S>, d: Lanes<S>, share: f64) -> Mask<S> {
        let ([fx, _], length) = (cable.force, cable.length);
        if cable.is_tilted() {
            return !fx.less_or_equal(fx);
        }
        let whole = fx * length;
        let change = (d.abs() + self.closing[0].abs()) * length + self.closing[1].abs() * fx;
        let sag = self.slackness.at_most(NEARLY_CHORD).select(self.slackness, fx.all(1.0));
        (change * (change + sag * whole)).less_or_equal(whole * whole * share)
    }

    /// Changes fx by `d` where `active`. Returns the largest relative change made.
    #[inline(always)]
    pub(crate) fn change(
        &self,
        cable: &mut LaneCable<'_, S>,
        d: Lanes<S>,
        active: Mask<S>,
        [tension, size]: [f64; 2],
    ) -> Lanes<S> {
        let [fx, fz] = cable.force;
        let d = d.max(fx * -GREATEST_LOSS);
        let rise = self.closing[0] + self.rise * d;
        let longer = self.closing[1] + self.length_slope * d;
        replace(&mut cable.force, &[fx + d, fz + rise], active);
        cable.length.replace(cable.length + longer, active);
        let mut force = d.abs() + rise.abs();
        if let Some(guided) = cable.guided.as_mut().filter(|guided| guided.is_tilted()) {
            let across = self.across[0] + self.across[1] * d;
            guided.swing(across / (fx + d), active);
            force += across.abs();
        }
        (force * (1.0 / tension)).max(longer.abs() * (1.0 / size))
    }
}

/// What closes a cable without guide, from its response, (L1).
#[inline(always)]
fn plain<S: Simd>(
    cable: &LaneCable<'_, S>,
    span: &Span<Lanes<S>>,
    response: &Response<Lanes<S>>,
) -> AtFixedEnds<Lanes<S>> {
    AtFixedEnds::in_plane(response, span.misclosure(response.end), cable.force[0] / span.end[0])
}

impl<S: Simd> FixedEnds<S> {
    /// A cable between its ends, with the rows of [`AtFixedEnds::per_end`].
    #[inline(always)]
    pub(crate) fn with_end_slopes(cable: &LaneCable<'_, S>, span: &Span<Lanes<S>>) -> (Self, [Lanes3<S>; 3]) {
        let response = cable.response();
        match &cable.guided {
            None => (Self::plain(cable, span, &response), plain(cable, span, &response).per_end),
            Some(guided) if guided.is_tilted() => Leaving { guided, cable, span }.in_space(&response),
            Some(guided) => Leaving { guided, cable, span }.leave(&response),
        }
    }
}

/// A cable over a pulley. With `e = |d(x, z)/dLf|` of the part beyond the leave point, τ the direction there
/// and ρ the radius with its sign, a turn α of τ winds ρ α off the wheel, along τ: forces are those of
/// the part with a fixed leave point, and
///
/// ```text
/// T0 dα = τ_x dfz - τ_z dfx - w τ_x dLf,      dLf = dLf|B + (ρ/e) dα                             (L13)
/// fz'' = fz''|B - ρ α' α'|B/(τ x C_z)
/// ```
///
/// where `|B` stands for a fixed leave point and C_z for the second column of the flexibility. A motion of A
/// at constant fx changes lengths in the same way.
struct Leaving<'a, 'b, S: Simd> {
    guided: &'a Guided<S>,
    cable: &'a LaneCable<'b, S>,
    span: &'a Span<Lanes<S>>,
}

impl<S: Simd> WithSimd for Leaving<'_, '_, S> {
    type Output = FixedEnds<S>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> FixedEnds<S> {
        let response = self.cable.response();
        match self.guided.is_tilted() {
            true => self.in_space(&response).0,
            false => self.leave(&response).0,
        }
    }
}

impl<S: Simd> Leaving<'_, '_, S> {
    #[inline(always)]
    fn leave(&self, response: &Response<Lanes<S>>) -> (FixedEnds<S>, [Lanes3<S>; 3]) {
        let Self { guided, cable, span } = self;
        let LeavePoint { position, tangent: [tx, tz], tension_inv, .. } = guided.leave_point(&cable.free());
        let [across, rise, mut length] = plain(cable, span, response).per_end;
        let span = Span { plane: span.plane, end: span.misclosure(position) };
        let mut fixed = FixedEnds::plain(cable, &span, response);
        let ([_, xz, zz], [ex, ez]) = (response.flexibility, response.end_per_length);
        let signed = guided.guide.signed_radius();
        let per_turn = signed / (ex * tx + ez * tz);
        let falling = cable.weight_per_length * tx * tension_inv;
        let whole = (per_turn * falling + 1.0).recip();
        let [dz, longer] = fixed.closing;
        fixed.closing[1] += per_turn * whole * (tx * tension_inv * dz - falling * longer);
        for k in [0, 2] {
            let turn = tx * tension_inv * rise[k] - falling * length[k];
            length[k] += per_turn * whole * turn;
        }
        let turn = (tx * fixed.rise - tz) * tension_inv - falling * fixed.length_slope;
        fixed.length_slope += per_turn * whole * turn;
        let bend = signed * whole * turn * turn / (tx * zz - tz * xz);
        let [_, uz] = response.direction;
        fixed.curvatures[0] -= uz * bend;
        fixed.curvatures[1] -= bend;
        (fixed, [across, rise, length])
    }

    /// The same over a tilted axis, (L19).
    #[inline(always)]
    fn in_space(&self, response: &Response<Lanes<S>>) -> (FixedEnds<S>, [Lanes3<S>; 3]) {
        let Self { guided, cable, span } = self;
        let way = guided.way(&cable.free());
        let space = way.in_space(cable.force[0], response);
        let (span, across) = guided.seen(span);
        let open = [span.end[0] - space.end[0], across - space.end[1], span.end[1] - space.end[2]];
        let AtFixedEnds { closing, per_force, per_end } =
            AtFixedEnds::in_space(&space, way.free_per_length, open);
        let beyond = Span { plane: span.plane, end: span.misclosure(way.leave.position) };
        let fixed = FixedEnds::plain(cable, &beyond, response);
        let [ux, uz] = response.direction;
        let fixed = FixedEnds {
            closed: response.tension + uz * closing[1],
            closing: [closing[1], closing[2]],
            rise: per_force[1],
            length_slope: per_force[2],
            tension_slope: ux + uz * per_force[1],
            across: [closing[0], per_force[0]],
            ..fixed
        };
        (fixed, per_end)
    }
}
