//! One cable in each lane: where it runs and how it responds.

use crate::equations::{
    CablePlane, LinearizedCable, Span, SpannedCable, between, end as end_in_level_frame, in_its_plane,
};
use crate::local::free::FreeCable;
use crate::local::guided::Guided;
use crate::state::Equilibrium;
use cdpr_cable::kernel::{LaneEnd, LawSegment, Material, Response};
use cdpr_cable::{Catenary, MAX_STRAIN, PiecewiseLaw};
use cdpr_number::Number;
use cdpr_number::dense::{Lanes2, Lanes3, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_robot::{Robot, RobotCable, Vector2};

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
    pub(crate) guided: Option<Guided<S>>,
}

/// What a cable that is nearly a parabola keeps when its ends move; of a guided one, its part beyond the
/// leave point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape<T> {
    /// Azimuth of its plane from that of its two points, as cosine and sine; they differ under a tilted axis.
    pub(crate) turn: [T; 2],
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
    /// Shape of cable `i` of a robot in an equilibrium.
    pub(crate) fn of(robot: &Robot, i: usize, unstrained_length: f64, at: &Equilibrium) -> Self {
        let force = at.cable_forces[i];
        let catenary = Catenary { cable: robot.cable(i), unstrained_length, force };
        let Span { plane, end } = SpannedCable::of(robot, &at.pose, i, &catenary).span;
        let of_points = Span::new(end_in_level_frame(robot, &at.pose, i).into()).plane;
        let forwards = plane.lift([1.0, 0.0]);
        let cable = in_its_plane(robot, &at.pose, i, catenary);
        let free = cable.free();
        let beyond = Vector2::from(end) - cable.leave_point();
        let (chord, height) = (beyond.norm(), beyond.y);
        let chord_force = chord / free.response().lateral_flexibility;
        Self {
            turn: [of_points.project(forwards)[0], of_points.across(forwards)],
            tangent: [force.x / free.exit_tension(), free.exit_vertical_force() / free.exit_tension()],
            chord_force,
            sag_force: force.y - chord_force * height / chord,
            longer: free.unstrained_length - chord,
        }
    }

    /// The same in all lanes.
    #[inline(always)]
    pub(crate) fn all<S: Simd>(&self, lanes: Lanes<S>) -> Shape<Lanes<S>> {
        Shape::of_numbers(self.numbers().map(|number| lanes.all(number)))
    }
}

impl<T: Copy> Shape<T> {
    /// Its numbers; cables without guide have only the first three.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> [T; 7] {
        let ([c, s], [x, z]) = (self.turn, self.tangent);
        [self.chord_force, self.sag_force, self.longer, c, s, x, z]
    }

    #[inline(always)]
    pub(crate) fn of_numbers([chord_force, sag_force, longer, c, s, x, z]: [T; 7]) -> Self {
        Self { turn: [c, s], tangent: [x, z], chord_force, sag_force, longer }
    }
}

/// Lanes leave cables with q² above this, which hang folded, to the scalar models.
pub(crate) const FOLDED: f64 = 1.0 - 1e-6;

impl<S: Simd> LaneCable<'_, S> {
    /// Gives a guided cable the whole length that it has.
    #[inline(always)]
    pub(crate) fn keep_length(&mut self) {
        let length = self.guided.as_ref().map(|guided| guided.way(&self.free()).length);
        if let (Some(guided), Some(length)) = (&mut self.guided, length) {
            guided.whole_length = length;
        }
    }

    /// The part beyond the guide.
    #[inline(always)]
    pub(crate) fn free(&self) -> FreeCable<'_, Lanes<S>> {
        FreeCable { material: self.material(), length: self.length, force: self.force }
    }

    #[inline(always)]
    pub(crate) fn material(&self) -> Material<'_, Lanes<S>> {
        let Self { law, weight_per_length, axial_flexibility, .. } = *self;
        Material { law, weight_per_length, axial_flexibility }
    }

    /// The end of the part beyond the guide.
    #[inline(always)]
    pub(crate) fn end(&self) -> LaneEnd<Lanes<S>> {
        self.free().end()
    }

    /// How the part beyond the guide responds.
    #[inline(always)]
    pub(crate) fn response(&self) -> Response<Lanes<S>> {
        self.free().response()
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
        let end = match &mut self.guided {
            None => span.end,
            Some(guided) => {
                guided.turn(shape.turn, &span.plane);
                let (span, _) = guided.seen(span);
                span.misclosure(guided.in_plane().leave_position(shape.tangent))
            }
        };
        let chord = Span { plane: span.plane, end }.chord();
        let per_length = chord.recip() * shape.chord_force;
        self.force = [end[0] * per_length, end[1] * per_length + shape.sag_force];
        self.length = chord + shape.longer;
    }

    /// The shape that it has over `span`.
    #[inline(always)]
    pub(crate) fn shape(&self, span: &Span<Lanes<S>>) -> Shape<Lanes<S>> {
        let zero = self.length.all(0.0);
        let (turn, tangent, end) = match &self.guided {
            None => ([zero + 1.0, zero], [zero; 2], span.end),
            Some(guided) => {
                let leave = guided.leave_point(&self.free());
                let (seen, _) = guided.seen(span);
                let forwards = seen.plane.lift([zero + 1.0, zero]);
                let turn = [span.plane.project(forwards)[0], span.plane.across(forwards)];
                (turn, leave.tangent, seen.misclosure(leave.position))
            }
        };
        let chord = Span { plane: span.plane, end }.chord();
        let per_length = self.force[0] / end[0];
        Shape {
            turn,
            tangent,
            chord_force: per_length * chord,
            sag_force: self.force[1] - per_length * end[1],
            longer: self.length - chord,
        }
    }

    /// Whether it runs over a pulley whose axis is tilted, in any lane.
    #[inline(always)]
    pub(crate) fn is_tilted(&self) -> bool {
        self.guided.as_ref().is_some_and(Guided::is_tilted)
    }

    /// The plane that it hangs in over `span`.
    #[inline(always)]
    pub(crate) fn plane(&self, span: &Span<Lanes<S>>) -> CablePlane<Lanes<S>> {
        match &self.guided {
            Some(guided) if guided.is_tilted() => guided.plane(),
            _ => span.plane,
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
    pub(crate) fn free_end(&self, span: &Span<Lanes<S>>) -> Lanes2<S> {
        match &self.guided {
            None => span.end,
            Some(guided) => guided.seen(span).0.misclosure(guided.leave_point(&self.free()).position),
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
}

/// Coefficients of S² = sinh²u/u² = sum 2 (2u)^2k/(2k + 2)! for u², the highest first.
const SINH_SQUARES: [f64; 6] = [2.0 / 467_775.0, 2.0 / 14_175.0, 1.0 / 315.0, 2.0 / 45.0, 1.0 / 3.0, 1.0];

/// u up to which [`SINH_SQUARES`] gives S² to a hundredth.
const STEEPEST: f64 = 2.5;

impl<S: Simd> LinearizedCable<Lanes<S>> {
    /// Assigns another one in the lanes that are `active`.
    #[inline(always)]
    pub(crate) fn replace(&mut self, other: &Self, active: Mask<S>) {
        replace(&mut self.plane.azimuth, &other.plane.azimuth, active);
        replace(&mut self.predicted, &other.predicted, active);
        replace(&mut self.stiffness, &other.stiffness, active);
        self.lateral_stiffness.replace(other.lateral_stiffness, active);
    }
}

/// Segments of the elastic law of a cable; none of a linear one.
#[inline]
pub(crate) fn law(cable: &RobotCable) -> &[LawSegment] {
    cable.properties.law.as_ref().map_or(&[], PiecewiseLaw::terms)
}
