//! One cable in each lane: where it runs and how it answers.
//!
//! The length of a cable over a pulley is that beyond its leave point, which closes with the force in the
//! same iteration: at the force F and the whole length L that it was given,
//!
//! ```text
//! dLf = (L - L(F, Lf))/β + q·dF/β,      A(F, L) = A(F, Lf) + dA/dL (L - L(F, Lf))                   (L12)
//! ```
//!
//! with (C21) to (C23) of `cdpr_cable`; what is left out is of second order.

use crate::equations::{LinearizedCable, Span, between};
use crate::state::Equilibrium;
use cdpr_cable::kernel::{GuideTerms, LaneEnd, LawSegment, LeavePoint, Material, Response, Way};
use cdpr_cable::{Catenary, MAX_STRAIN};
use cdpr_number::Number;
use cdpr_number::dense::{Lanes2, Lanes3, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd, WithSimd};
use cdpr_robot::{Robot, Vector2};

/// A cable of every robot, or several cables of one.
#[derive(Clone)]
pub(crate) struct LaneCable<'a, S: Simd> {
    /// Segments of the elastic law, the same in all lanes; none of a linear cable.
    pub(crate) law: &'a [LawSegment],
    /// Weight per length [N/m].
    pub(crate) weight_per_length: Lanes<S>,
    /// 1/EA [1/N].
    pub(crate) axial_flexibility: Lanes<S>,
    /// Exit point [m].
    pub(crate) exit_point: Lanes3<S>,
    /// s = R a [m].
    pub(crate) anchor_arm: Lanes3<S>,
    /// Unstrained length beyond the exit point, or beyond the leave point of a pulley [m].
    pub(crate) length: Lanes<S>,
    /// Force at A [N].
    pub(crate) force: Lanes2<S>,
    /// What leads it to its exit point. Most cables have none.
    pub(crate) guided: Option<Box<Guided<S>>>,
}

/// What a cable that is nearly a parabola keeps when its ends move; of a guided one, its part beyond the
/// leave point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape<T> {
    /// Direction of the cable where it leaves its exit point or guide.
    pub(crate) tangent: [T; 2],
    /// σ [N].
    pub(crate) chord_force: T,
    /// Vertical force at A beyond that along the chord [N].
    pub(crate) sag_force: T,
    /// Unstrained length less the chord [m].
    pub(crate) longer: T,
}

impl Shape<f64> {
    /// That of cable `i` where a robot is held.
    pub(crate) fn of(robot: &Robot, i: usize, unstrained_length: f64, held: &Equilibrium) -> Self {
        let force = held.cable_forces[i];
        let cable = Catenary { cable: robot.cable(i), unstrained_length, force };
        let span = robot.span(&held.pose, i);
        let (mut chord, mut height) =
            (span.norm(), robot.gravity.level().map_or(span, |level| level * span).z);
        let free = cable.free();
        if cable.cable.guide.is_some() {
            let across = (span.norm_squared() - height * height).max(0.0).sqrt();
            let end = Vector2::new(across, height) - cable.leave_point();
            (chord, height) = (end.norm(), end.y);
        }
        let chord_force = chord / free.response().lateral_flexibility;
        Self {
            tangent: [force.x / free.exit_tension(), free.exit_vertical_force() / free.exit_tension()],
            chord_force,
            sag_force: force.y - chord_force * height / chord,
            longer: free.unstrained_length - chord,
        }
    }

    /// The same in all lanes.
    #[inline(always)]
    pub(crate) fn all<S: Simd>(&self, lanes: Lanes<S>) -> Shape<Lanes<S>> {
        let [x, z] = self.tangent;
        Shape {
            tangent: [lanes.all(x), lanes.all(z)],
            chord_force: lanes.all(self.chord_force),
            sag_force: lanes.all(self.sag_force),
            longer: lanes.all(self.longer),
        }
    }
}

/// A guide, and the cable that was given to it.
#[derive(Clone)]
pub(crate) struct Guided<S: Simd> {
    pub(crate) guide: GuideTerms<Lanes<S>>,
    /// Unstrained length L, lead and arc included [m].
    pub(crate) whole_length: Lanes<S>,
}

/// Lanes leave cables with q² above this, which hang folded, to the scalar models.
pub(crate) const FOLDED: f64 = 1.0 - 1e-6;

/// Horizontal distance of a cable's end from its leave point, in radii of its wheel, within which a slack
/// cable may hang from either side of the wheel.
const BESIDE_WHEEL: f64 = 4.0;

/// How the length beyond the leave point follows the force, (L12).
#[derive(Clone, Copy)]
pub(crate) struct FreeLength<S: Simd> {
    /// (L - L(F, Lf))/β [m].
    missing: Lanes<S>,
    /// q/β [m/N].
    per_force: Lanes2<S>,
}

impl<S: Simd> FreeLength<S> {
    /// No length that changes.
    #[inline(always)]
    pub(crate) fn fixed(zero: Lanes<S>) -> Self {
        Self { missing: zero, per_force: [zero; 2] }
    }

    /// Takes over another one in the lanes that are `going`.
    #[inline(always)]
    pub(crate) fn replace(&mut self, other: &Self, going: Mask<S>) {
        self.revise(other.missing, going);
        replace(&mut self.per_force, &other.per_force, going);
    }

    /// Takes over a missing length in the lanes that are `going`.
    #[inline(always)]
    pub(crate) fn revise(&mut self, missing: Lanes<S>, going: Mask<S>) {
        self.missing.replace(missing, going);
    }

    /// dLf for a change of the force.
    #[inline(always)]
    pub(crate) fn change(&self, from: &Lanes2<S>, to: &Lanes2<S>) -> Lanes<S> {
        self.missing + self.per_force[0] * (to[0] - from[0]) + self.per_force[1] * (to[1] - from[1])
    }
}

impl<S: Simd> Guided<S> {
    /// Where the cable leaves its guide.
    #[inline(always)]
    pub(crate) fn leave_point(&self, cable: &LaneCable<'_, S>) -> LeavePoint<Lanes<S>> {
        self.guide.leave_point(cable.weight_per_length, cable.length, cable.force)
    }

    /// The lanes in which it has no pulley, and the leave point does not move.
    #[inline(always)]
    pub(crate) fn fixed(&self) -> Mask<S> {
        self.guide.radius.less_or_equal(self.guide.radius.all(0.0))
    }

    #[inline(always)]
    pub(crate) fn way(&self, cable: &LaneCable<'_, S>) -> Way<Lanes<S>> {
        let leave = self.leave_point(cable);
        let stretch = cable.material().stretch(leave.tension);
        self.guide.way(cable.weight_per_length, cable.length, leave, stretch)
    }

    /// Linearizes the whole cable of this guide in the lanes that are `going`, with the end of (L12).
    #[cold]
    #[inline(never)]
    pub(crate) fn linearize(
        &self,
        cable: &LaneCable<'_, S>,
        span: &Span<Lanes<S>>,
        linearized: &mut LinearizedCable<Lanes<S>>,
        free: &mut FreeLength<S>,
        going: Mask<S>,
    ) {
        cable.length.apart(Linearize { guided: self, cable, span: *span, linearized, free, going });
    }

    /// The lanes in which the cable ends within [`BESIDE_WHEEL`] radii of its leave point, with the platform
    /// at `position`.
    #[cold]
    #[inline(never)]
    pub(crate) fn is_beside(&self, cable: &LaneCable<'_, S>, position: &Lanes3<S>) -> Mask<S> {
        cable.length.apart(IsBeside(self, cable, position))
    }

    /// The end of the whole cable of this guide, (L12), and the missing length beyond its leave point. A
    /// cable that is too short for its guide has a slackness of 2.
    #[cold]
    #[inline(never)]
    pub(crate) fn end(&self, cable: &LaneCable<'_, S>) -> (LaneEnd<Lanes<S>>, Lanes<S>) {
        cable.length.apart(WholeEnd(self, cable))
    }
}

struct Linearize<'a, 'b, S: Simd> {
    guided: &'a Guided<S>,
    cable: &'a LaneCable<'b, S>,
    span: Span<Lanes<S>>,
    linearized: &'a mut LinearizedCable<Lanes<S>>,
    free: &'a mut FreeLength<S>,
    going: Mask<S>,
}

impl<S: Simd> WithSimd for Linearize<'_, '_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) {
        let Self { guided, cable, span, linearized, free, going } = self;
        let way = guided.way(cable);
        let response = way.response(cable.force[0], &cable.response());
        let missing = guided.whole_length - way.length;
        let response = Response { end: moved(response.end, &way, missing), ..response };
        linearized.replace(&LinearizedCable::new(&span, cable.force, &response), going);
        let change = FreeLength { missing: missing * way.free_per_length, per_force: way.free_per_force };
        free.replace(&change, going);
    }
}

struct IsBeside<'a, 'b, S: Simd>(&'a Guided<S>, &'a LaneCable<'b, S>, &'a Lanes3<S>);

impl<S: Simd> WithSimd for IsBeside<'_, '_, S> {
    type Output = Mask<S>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Mask<S> {
        let Self(guided, cable, position) = self;
        let [beyond, _] = cable.held_end(&cable.span(position));
        beyond.less_or_equal(guided.guide.radius * BESIDE_WHEEL)
    }
}

struct WholeEnd<'a, 'b, S: Simd>(&'a Guided<S>, &'a LaneCable<'b, S>);

impl<S: Simd> WithSimd for WholeEnd<'_, '_, S> {
    type Output = (LaneEnd<Lanes<S>>, Lanes<S>);

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Self::Output {
        let Self(guided, cable) = self;
        let (way, LaneEnd { end: [x, z], tension, slackness }) = (guided.way(cable), cable.end());
        let missing = guided.whole_length - way.length;
        let [from_x, from_z] = way.leave.position;
        let end = moved([from_x + x, from_z + z], &way, missing);
        let zero = cable.length.all(0.0);
        let slackness = zero.less_or_equal(cable.length).select(slackness, zero.all(2.0));
        (LaneEnd { end, tension, slackness }, missing * way.free_per_length)
    }
}

#[inline(always)]
fn moved<S: Simd>([x, z]: Lanes2<S>, way: &Way<Lanes<S>>, missing: Lanes<S>) -> Lanes2<S> {
    [x + way.end_per_length[0] * missing, z + way.end_per_length[1] * missing]
}

impl<S: Simd> LaneCable<'_, S> {
    /// Gives a guided cable the whole length that it has.
    #[inline(always)]
    pub(crate) fn keep_length(&mut self) {
        let length = self.guided.as_ref().map(|guided| guided.way(self).length);
        if let (Some(guided), Some(length)) = (&mut self.guided, length) {
            guided.whole_length = length;
        }
    }

    #[inline(always)]
    pub(crate) fn material(&self) -> Material<'_, Lanes<S>> {
        let Self { law, weight_per_length, axial_flexibility, .. } = *self;
        Material { law, weight_per_length, axial_flexibility }
    }

    /// The end of the part beyond the guide.
    #[inline(always)]
    pub(crate) fn end(&self) -> LaneEnd<Lanes<S>> {
        let (material, length, force) = (self.material(), self.length, self.force);
        match material.law {
            [] => material.end(length, force),
            _ => length.apart(LawEnd(material, length, force)),
        }
    }

    /// Strain at a tension [N].
    #[inline(always)]
    pub(crate) fn strain(&self, tension: Lanes<S>) -> Lanes<S> {
        self.material().strain(tension)
    }

    /// The lanes in which this tension at the platform [N] may strain the cable beyond [`MAX_STRAIN`] at one
    /// of its ends.
    #[inline(always)]
    pub(crate) fn may_be_overstrained(&self, tension: Lanes<S>) -> Mask<S> {
        let strain = self.strain(tension + self.weight_per_length * self.length);
        !strain.less_or_equal(tension.all(MAX_STRAIN))
    }

    /// The integral of the strain over the tension up to `tension`, both in newtons.
    #[inline(always)]
    pub(crate) fn energy(&self, tension: Lanes<S>) -> Lanes<S> {
        self.material().energy(tension)
    }

    /// Takes a shape over `span`.
    #[inline(always)]
    pub(crate) fn take(&mut self, shape: &Shape<Lanes<S>>, span: &Span<Lanes<S>>) {
        let end = match &self.guided {
            None => span.end,
            Some(guided) => span.misclosure(guided.guide.leave_position(shape.tangent)),
        };
        let chord = Span { plane: span.plane, end }.chord();
        let per_length = chord.recip() * shape.chord_force;
        self.force = [end[0] * per_length, end[1] * per_length + shape.sag_force];
        self.length = chord + shape.longer;
    }

    /// The shape that it has over `span`.
    #[inline(always)]
    pub(crate) fn shape(&self, span: &Span<Lanes<S>>) -> Shape<Lanes<S>> {
        let (tangent, end) = match &self.guided {
            None => ([self.length.all(0.0); 2], span.end),
            Some(guided) => {
                let leave = guided.leave_point(self);
                (leave.tangent, span.misclosure(leave.position))
            }
        };
        let chord = Span { plane: span.plane, end }.chord();
        let per_length = self.force[0] / end[0];
        Shape {
            tangent,
            chord_force: per_length * chord,
            sag_force: self.force[1] - per_length * end[1],
            longer: self.length - chord,
        }
    }

    /// The span of the cable with the platform at `position`.
    #[inline(always)]
    pub(crate) fn span(&self, position: &Lanes3<S>) -> Span<Lanes<S>> {
        // Eq. (1)
        Span::oblique(between(position, &self.anchor_arm, &self.exit_point))
    }

    /// Horizontal distance and height of A from the exit point, or from the leave point of a pulley [m].
    #[inline(always)]
    pub(crate) fn held_end(&self, span: &Span<Lanes<S>>) -> Lanes2<S> {
        match &self.guided {
            None => span.end,
            Some(guided) => span.misclosure(guided.leave_point(self).position),
        }
    }

    /// In lanes that are `far` from the shape that the cable had: takes over the vertical force and the
    /// length of the inextensible catenary to `end` with its horizontal force, stretched by its tension.
    ///
    /// With u = w h/(2 fx) and S = sinh u/u, `u coth u = sqrt(u² + 1/S²)` in (L4). A cable beyond
    /// [`STEEPEST`], where the series of S² ends, keeps what it has.
    #[inline(always)]
    pub(crate) fn hang(&mut self, [h, z]: Lanes2<S>, far: Mask<S>) {
        let [fx, _] = self.force;
        let half_weight = self.weight_per_length * 0.5;
        let u = half_weight * h / fx;
        let square = u * u;
        let mut stretch = square.all(SINH_SQUARES[0]);
        for coefficient in &SINH_SQUARES[1..] {
            stretch = stretch * square + *coefficient;
        }
        let length = (z * z + h * h * stretch).sqrt();
        let fz = fx * z / h * (square + stretch.recip()).sqrt() + half_weight * length;
        let tension = (fx * fx + fz * fz).sqrt();
        let unstrained = length / (self.strain(tension) + 1.0);
        let far = far & u.less_or_equal(u.all(STEEPEST));
        self.force[1].replace(fz, far);
        self.length.replace(unstrained, far);
    }

    /// How the part beyond the guide answers.
    #[inline(always)]
    pub(crate) fn response(&self) -> Response<Lanes<S>> {
        let (material, length, force) = (self.material(), self.length, self.force);
        match material.law {
            [] => material.response(length, force),
            _ => length.apart(LawResponse(material, length, force)),
        }
    }
}

/// Coefficients of S² = sinh²u/u² = sum 2 (2u)^2k/(2k + 2)! for u², the highest first.
const SINH_SQUARES: [f64; 6] = [2.0 / 467_775.0, 2.0 / 14_175.0, 1.0 / 315.0, 2.0 / 45.0, 1.0 / 3.0, 1.0];

/// u up to which [`SINH_SQUARES`] gives S² to a hundredth.
const STEEPEST: f64 = 2.5;

/// A cable with a law: its material, its length, and the force at A. It is evaluated in functions of their
/// own: most robots have linear cables, and their code is faster without it.
struct LawResponse<'a, S: Simd>(Material<'a, Lanes<S>>, Lanes<S>, Lanes2<S>);

struct LawEnd<'a, S: Simd>(Material<'a, Lanes<S>>, Lanes<S>, Lanes2<S>);

impl<S: Simd> WithSimd for LawResponse<'_, S> {
    type Output = Response<Lanes<S>>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Self::Output {
        let Self(material, length, force) = self;
        material.response(length, force)
    }
}

impl<S: Simd> WithSimd for LawEnd<'_, S> {
    type Output = LaneEnd<Lanes<S>>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Self::Output {
        let Self(material, length, force) = self;
        material.end(length, force)
    }
}

impl<S: Simd> LinearizedCable<Lanes<S>> {
    /// Takes over another one in the lanes that are `going`.
    #[inline(always)]
    pub(crate) fn replace(&mut self, other: &Self, going: Mask<S>) {
        replace(&mut self.plane.azimuth, &other.plane.azimuth, going);
        replace(&mut self.predicted, &other.predicted, going);
        replace(&mut self.stiffness, &other.stiffness, going);
        self.lateral_stiffness.replace(other.lateral_stiffness, going);
    }
}
