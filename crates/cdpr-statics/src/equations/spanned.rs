//! A cable of a robot between its two points, with the force it carries and how it answers.
//!
//! The mechanics of a cable are those of the level frame, whose z axis points against gravity. Where the base
//! frame is tilted, spans are rotated into the level frame and forces back. Over a pulley with a tilted axis
//! the cable hangs in a plane that does not contain the entry point: its azimuth is that with which the cable
//! meets its anchor point across the plane, for the force and length that it has.

use crate::equations::cable::{CablePlane, LinearizedCable, Span, between};
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_cable::kernel::{Response, closure_of_limp, response};
use cdpr_cable::{
    CableError, Catenary, ElasticLaw, Guide, HeldCable, HeldSlopes, HeldSpatialCable, SpatialCable,
    SpatialResponse, SpatialSlopes, end_force, end_force_near, spatial_end_force,
};
use cdpr_number::Real;
use cdpr_number::vector::{dot, wrench};
use cdpr_robot::{Matrix3, Pose, Robot, Vector2, Vector3};

/// A cable with a force that need not fit its two points.
pub(crate) struct SpannedCable<'a, T> {
    /// s_i = R a_i [m].
    pub(crate) anchor_arm: [T; 3],
    /// The span in the level frame, in the plane that the cable hangs in.
    pub(crate) span: Span<T>,
    /// (fx, fz) on the cable at A [N].
    pub(crate) force: [T; 2],
    answer: Answer<T>,
    level: Option<&'a Matrix3<f64>>,
}

/// How the end of a cable answers to forces.
enum Answer<T> {
    /// In its plane.
    Planar(Response<T>),
    /// Over a tilted axis, in the level frame.
    Spatial(Box<SpatialResponse>),
    /// A slack cable without weight has no shape: its length without tension [m], and its guide.
    Limp(Box<(f64, Option<Guide>)>),
}

/// A vector of the level frame in the base frame.
#[inline(always)]
pub(crate) fn to_base<T: Real>(level: Option<&Matrix3<f64>>, v: [T; 3]) -> [T; 3] {
    match level {
        None => v,
        Some(level) => turned(&level.transpose(), v),
    }
}

/// A vector of the base frame in the level frame.
#[inline(always)]
pub(crate) fn to_level<T: Real>(level: Option<&Matrix3<f64>>, v: [T; 3]) -> [T; 3] {
    match level {
        None => v,
        Some(level) => turned(level, v),
    }
}

#[cold]
fn turned<T: Real>(rotation: &Matrix3<f64>, v: [T; 3]) -> [T; 3] {
    [0, 1, 2].map(|row| dot(&[0, 1, 2].map(|column| T::of(rotation[(row, column)])), &v))
}

/// How a cable answers over the vector r [m] in the level frame; its span is that of the plane it hangs in.
#[inline(always)]
fn answer<T: Real>(
    catenary: &Catenary,
    span: Span<T>,
    r: [T; 3],
    response: impl FnOnce() -> Response<T>,
) -> (Span<T>, Answer<T>) {
    if catenary.is_limp() {
        return (span, Answer::Limp(Box::new((catenary.length_at_rest(), catenary.cable.guide))));
    }
    if catenary.cable.leaves_its_plane() {
        let azimuth = span.plane.azimuth.map(T::value);
        let (azimuth, response) = hanging(catenary, azimuth.into(), r.map(T::value).into());
        let plane = CablePlane { azimuth: <[f64; 2]>::from(azimuth).map(T::of) };
        return (Span { end: plane.project(r), plane }, Answer::Spatial(Box::new(response)));
    }
    (span, Answer::Planar(response()))
}

/// Azimuth of the plane in which a cable over a tilted axis hangs to `end` [m] with its force, and how it
/// answers there.
#[cold]
fn hanging(
    catenary: &Catenary,
    mut forwards: Vector2<f64>,
    end: Vector3<f64>,
) -> (Vector2<f64>, SpatialResponse) {
    const MAX_ITERATIONS: usize = 30;
    const ROUNDING: f64 = 1e-15;
    let [fx, fz] = catenary.force.into();
    let at = |forwards: Vector2<f64>| {
        let force = Vector3::new(fx * forwards.x, fx * forwards.y, fz);
        let Catenary { cable, unstrained_length, .. } = *catenary;
        let response = SpatialCable { cable, unstrained_length, force }.response();
        let way = (end - response.leave).xy();
        // From forwards, to the left.
        (response, way, forwards.perp(&way))
    };
    let (mut response, mut way, mut beside) = at(forwards);
    for _ in 0..MAX_ITERATIONS {
        if beside.abs() <= ROUNDING * way.norm() {
            break;
        }
        // What a turn of the plane by an angle moves across it: nearly the distance from the leave point.
        let across = Vector3::new(-forwards.y, forwards.x, 0.0);
        let swing = fx * (response.flexibility * across).dot(&across);
        let reach = forwards.dot(&(end - response.end).xy()) + swing;
        let towards = if forwards.dot(&way) > 0.0 && reach > 0.0 {
            forwards + across.xy() * (beside / reach)
        } else {
            way
        };
        let Some(next) = towards.try_normalize(0.0) else { break };
        let turned = at(next);
        if turned.2.abs() >= beside.abs() {
            break;
        }
        forwards = next;
        (response, way, beside) = turned;
    }
    (forwards, response)
}

impl<'a> SpannedCable<'a, f64> {
    /// [`SpannedCable::of`] for a cable without guide that carries a force, on a level base.
    #[inline(always)]
    pub(crate) fn plain(robot: &'a Robot, pose: &Pose, i: usize, catenary: &Catenary) -> Option<Self> {
        let Catenary { cable, unstrained_length: length, force } = *catenary;
        if robot.gravity.level().is_some() || cable.guide.is_some() || force == Vector2::zeros() {
            return None;
        }
        let anchor_arm = robot.anchor_arm(pose, i).into();
        let r = between(&pose.position.into(), &anchor_arm, &robot.cables[i].exit_point.into());
        let force = force.into();
        let response = match cable.law {
            ElasticLaw::Linear => {
                response(cable.weight_per_length, 1.0 / cable.axial_stiffness, length, force)
            }
            ElasticLaw::Piecewise(_) => catenary.response(),
        };
        let answer = Answer::Planar(response);
        Some(Self { anchor_arm, span: Span::new(r), force, answer, level: None })
    }

    /// Cable i of a robot at a pose, in the shape of `catenary`.
    #[inline(always)]
    pub(crate) fn of(robot: &'a Robot, pose: &Pose, i: usize, catenary: &Catenary) -> Self {
        let anchor_arm = robot.anchor_arm(pose, i).into();
        let level = robot.gravity.level();
        let r =
            to_level(level, between(&pose.position.into(), &anchor_arm, &robot.cables[i].exit_point.into()));
        let (span, answer) = answer(catenary, Span::new(r), r, || catenary.response());
        Self { anchor_arm, span, force: catenary.force.into(), answer, level }
    }

    /// The misclosure in space of a cable over a tilted axis [m], in the level frame.
    fn open(&self) -> Vector3<f64> {
        self.span.plane.lift(self.misclosure()).into()
    }

    /// The cable linearised about its force; `None` for a slack cable without weight, which resists nothing.
    #[inline(always)]
    pub(crate) fn linearized(&self) -> Option<SpannedStiffness<'a>> {
        match &self.answer {
            Answer::Planar(response) if self.level.is_none() => {
                Some(SpannedStiffness::Level(LinearizedCable::new(&self.span, self.force, response)))
            }
            _ => self.turned(),
        }
    }

    #[cold]
    fn turned(&self) -> Option<SpannedStiffness<'a>> {
        let (plane, level) = (self.span.plane, self.level);
        let (predicted, stiffness) = match &self.answer {
            Answer::Planar(response) => {
                let planar = LinearizedCable::new(&self.span, self.force, response);
                (plane.lift(planar.predicted).into(), planar.stiffness_in_space().into())
            }
            Answer::Spatial(spatial) => {
                let stiffness = spatial.flexibility.try_inverse().unwrap_or_else(Matrix3::zeros);
                let predicted = Vector3::from(plane.lift(self.force)) + stiffness * self.open();
                (predicted, 0.5 * (stiffness + stiffness.transpose()))
            }
            Answer::Limp(_) => return None,
        };
        let leaves = matches!(self.answer, Answer::Spatial(_));
        Some(SpannedStiffness::Turned(Box::new(Turned { plane, predicted, stiffness, leaves, level })))
    }

    /// Skew part of the stiffness in space [N/m], in the base frame, besides the symmetric one of
    /// [`SpannedStiffness::stiffness`]: of a cable over a guide, whose flexibility is not quite symmetric
    /// (C22).
    pub(crate) fn skew_stiffness(&self, catenary: &Catenary) -> Option<Matrix3<f64>> {
        catenary.cable.guide?;
        let skew = match &self.answer {
            Answer::Planar(response) => {
                let asymmetry = catenary.asymmetry();
                let determinant = response.determinant + asymmetry * asymmetry;
                let forwards = Vector3::from(self.span.plane.lift([1.0, 0.0]));
                let up = Vector3::z();
                (up * forwards.transpose() - forwards * up.transpose()) * (asymmetry / determinant)
            }
            Answer::Spatial(spatial) => {
                let stiffness = spatial.flexibility.try_inverse()?;
                0.5 * (stiffness - stiffness.transpose())
            }
            Answer::Limp(_) => return None,
        };
        Some(self.based_matrix(&skew))
    }

    /// The position of the free end of the cable per unstrained length at constant force [m/m], in the base
    /// frame; zero for a slack cable without weight.
    pub(crate) fn end_per_length(&self) -> Vector3<f64> {
        let slope = match &self.answer {
            Answer::Planar(response) => self.span.plane.lift(response.end_per_length),
            Answer::Spatial(spatial) => spatial.end_per_length.into(),
            Answer::Limp(_) => [0.0; 3],
        };
        self.based(slope.into())
    }

    /// How the free end of the cable moves with what the cable and its guide are, at constant force and
    /// length, in the base frame.
    pub(crate) fn end_slopes(&self, catenary: &Catenary<'a>) -> SpatialSlopes {
        if let Some(cable) = self.over_a_pulley(catenary) {
            let SpatialSlopes { per_weight, per_stiffness, per_lead, per_radius, per_axis } = cable.slopes();
            return SpatialSlopes {
                per_weight: self.based(per_weight),
                per_stiffness: self.based(per_stiffness),
                per_lead: self.based(per_lead),
                per_radius: self.based(per_radius),
                per_axis: self.based_matrix(&per_axis),
            };
        }
        let lift = |end: Vector2<f64>| self.based(self.span.plane.lift(end.into()).into());
        let per_lead = catenary.end_per_guide().map_or_else(Vector3::zeros, |[lead, _]| lift(lead));
        SpatialSlopes {
            per_weight: lift(catenary.end_per_weight()),
            per_stiffness: lift(catenary.end_per_stiffness()),
            per_lead,
            per_radius: Vector3::zeros(),
            per_axis: Matrix3::zeros(),
        }
    }

    /// Second derivatives of the force on the cable, which must fit its points, between its held ends, in the
    /// base frame; `end` [m] leads from its exit to its anchor point in the level frame.
    pub(crate) fn tension_slopes(&self, catenary: &Catenary<'a>, end: Vector3<f64>) -> HeldSlopes {
        if let Some(cable) = self.over_a_pulley(catenary) {
            return self.based_slopes(&HeldSpatialCable::of(cable, end).tension_slopes());
        }
        let held = HeldCable::of(*catenary, self.span.end.into());
        let slopes = held.tension_slopes();
        let lift = |v: Vector2<f64>| self.based(self.span.plane.lift(v.into()).into());
        let (forwards, up) = (lift(Vector2::x()), lift(Vector2::y()));
        let across = up.cross(&forwards);
        // v_x/h
        let lateral = 1.0 / (self.span.chord() * held.tension_slope());
        let [per_h, per_z] = slopes.per_end.map(lift);
        HeldSlopes {
            value: lift(slopes.force_per_tension),
            per_actuation: lift(slopes.per_tension),
            per_end: per_h * forwards.transpose()
                + per_z * up.transpose()
                + across * across.transpose() * lateral,
            per_weight: lift(slopes.per_weight),
            per_stiffness: lift(slopes.per_stiffness),
            per_lead: lift(slopes.per_guide[0]),
            per_radius: Vector3::zeros(),
            per_axis: Matrix3::zeros(),
        }
    }

    /// The force K3 d on the cable by which it answers to the unit motion `d` of its anchor point, with its
    /// derivatives between held ends, in the base frame.
    pub(crate) fn stiffness_slopes(&self, catenary: &Catenary<'a>, d: Vector3<f64>) -> HeldSlopes {
        let d = to_level(self.level, d.into()).into();
        self.based_slopes(&self.in_space(catenary).stiffness_slopes(d))
    }

    /// The force on the cable where it leaves its guide, with its derivatives between held ends, in the base
    /// frame.
    pub(crate) fn leave_force_slopes(&self, catenary: &Catenary<'a>) -> HeldSlopes {
        self.based_slopes(&self.in_space(catenary).leave_force_slopes())
    }

    /// The cable in space, in the level frame, if it runs over a pulley: only there do derivatives leave its
    /// plane.
    fn over_a_pulley(&self, catenary: &Catenary<'a>) -> Option<SpatialCable<'a>> {
        catenary.cable.guide.filter(|guide| guide.radius > 0.0)?;
        Some(self.in_space(catenary))
    }

    /// The cable in space, in the level frame.
    fn in_space(&self, catenary: &Catenary<'a>) -> SpatialCable<'a> {
        let Catenary { cable, unstrained_length, .. } = *catenary;
        SpatialCable { cable, unstrained_length, force: self.span.plane.lift(self.force).into() }
    }

    fn based_slopes(&self, slopes: &HeldSlopes) -> HeldSlopes {
        HeldSlopes {
            value: self.based(slopes.value),
            per_actuation: self.based(slopes.per_actuation),
            per_end: self.based_matrix(&slopes.per_end),
            per_weight: self.based(slopes.per_weight),
            per_stiffness: self.based(slopes.per_stiffness),
            per_lead: self.based(slopes.per_lead),
            per_radius: self.based(slopes.per_radius),
            per_axis: self.based_matrix(&slopes.per_axis),
        }
    }

    fn based(&self, v: Vector3<f64>) -> Vector3<f64> {
        to_base(self.level, v.into()).into()
    }

    fn based_matrix(&self, matrix: &Matrix3<f64>) -> Matrix3<f64> {
        self.level.map_or(*matrix, |level| level.transpose() * matrix * level)
    }
}

/// The stiffness of a cable in space, with the force on which it bears.
pub(crate) enum SpannedStiffness<'a> {
    /// In the vertical plane of its span, on a level base.
    Level(LinearizedCable<f64>),
    /// Any other.
    Turned(Box<Turned<'a>>),
}

/// A cable in the level frame, and the way to the base frame.
pub(crate) struct Turned<'a> {
    pub(crate) plane: CablePlane<f64>,
    /// Force on the cable at A [N].
    predicted: Vector3<f64>,
    /// Symmetric part of the stiffness [N/m].
    stiffness: Matrix3<f64>,
    /// Whether the plane depends on the force.
    leaves: bool,
    level: Option<&'a Matrix3<f64>>,
}

impl SpannedStiffness<'_> {
    /// Stiffness K3 [N/m] in the base frame, equation (S3): a symmetric matrix.
    #[inline(always)]
    pub(crate) fn stiffness(&self) -> [[f64; 3]; 3] {
        match self {
            Self::Level(cable) => cable.stiffness_in_space(),
            Self::Turned(cable) => cable.stiffness(),
        }
    }

    /// The force on the platform that the cable would have if it fitted its points [N].
    #[inline(always)]
    pub(crate) fn predicted(&self) -> [f64; 3] {
        match self {
            Self::Level(cable) => cable.plane.force_on_platform(cable.predicted),
            Self::Turned(cable) => to_base(cable.level, (-cable.predicted).into()),
        }
    }
}

impl Turned<'_> {
    #[cold]
    fn stiffness(&self) -> [[f64; 3]; 3] {
        self.level.map_or(self.stiffness, |level| level.transpose() * self.stiffness * level).into()
    }

    /// The force (fx, fz) on the cable [N] after a displacement of A in space [m].
    #[cold]
    pub(crate) fn force_after(&self, displacement: [f64; 3]) -> [f64; 2] {
        let force = self.predicted + self.stiffness * Vector3::from(to_level(self.level, displacement));
        if self.leaves { [force.xy().norm(), force.z] } else { self.plane.project(force.into()) }
    }
}

impl<'a, T: Real> SpannedCable<'a, T> {
    /// Cable i with its anchor point at `position + anchor_arm` [m].
    pub(crate) fn new(
        problem: &DirectProblem<'a>,
        position: [T; 3],
        anchor_arm: [T; 3],
        force: [T; 2],
        i: usize,
    ) -> Self {
        let cable = &problem.robot.cables[i];
        let p = &cable.properties;
        let catenary = problem.catenary(i, Vector2::from(force.map(T::value)));
        let level = problem.robot.gravity.level();
        let response = || match (&p.law, catenary.cable.guide) {
            (None, None) => {
                let weight = T::of(p.linear_density) * T::of(problem.robot.gravity.magnitude());
                let stiffness = T::of(p.youngs_modulus) * T::of(p.section);
                response(weight, stiffness.recip(), T::of(problem.lengths[i]), force)
            }
            // Only doubles come here: certificates refuse such a cable.
            _ => catenary.response().map(T::of),
        };
        let exit_point = <[f64; 3]>::from(cable.exit_point).map(T::of);
        let r = to_level(level, between(&position, &anchor_arm, &exit_point));
        let (span, answer) = answer(&catenary, Span::new(r), r, response);
        Self { anchor_arm, span, force, answer, level }
    }

    /// F_i [N], the force on the platform.
    #[inline(always)]
    pub(crate) fn force_on_platform(&self) -> [T; 3] {
        to_base(self.level, self.span.plane.force_on_platform(self.force))
    }

    /// [F_i; s_i x F_i] [N, N m], the wrench on the platform.
    #[inline(always)]
    pub(crate) fn wrench(&self) -> [T; 6] {
        wrench(&self.anchor_arm, &self.force_on_platform())
    }

    /// How its end answers to forces in the plane of its span; `None` for a slack cable without weight, and
    /// for one over a tilted axis.
    #[inline(always)]
    pub(crate) fn response(&self) -> Option<&Response<T>> {
        if let Answer::Planar(response) = &self.answer { Some(response) } else { None }
    }

    /// The cable linearised about its force, of a cable that stays in the plane of its span.
    #[inline(always)]
    pub(crate) fn planar(&self) -> Option<LinearizedCable<T>> {
        self.response().map(|response| LinearizedCable::new(&self.span, self.force, response))
    }

    /// Misclosure [m]: from the end of the cable to its anchor point.
    #[inline(always)]
    pub(crate) fn misclosure(&self) -> [T; 2] {
        match &self.answer {
            Answer::Planar(response) => self.span.misclosure(response.end),
            Answer::Spatial(spatial) => {
                let end = <[f64; 3]>::from(spatial.end).map(T::of);
                self.span.misclosure(self.span.plane.project(end))
            }
            Answer::Limp(limp) => match &**limp {
                (rest, None) => closure_of_limp(self.span.end, T::of(*rest)),
                (rest, Some(guide)) => {
                    let end = self.span.plane.lift(self.span.end).map(T::value);
                    let open = guide.closure_of_limp(end.into(), *rest);
                    self.span.plane.project(<[f64; 3]>::from(open).map(T::of))
                }
            },
        }
    }
}

/// The vector from exit point i to anchor point i at a pose [m], in the level frame.
#[inline(always)]
pub(crate) fn end(robot: &Robot, pose: &Pose, i: usize) -> Vector3<f64> {
    to_level(robot.gravity.level(), robot.span(pose, i).into()).into()
}

impl<'a> DirectProblem<'a> {
    /// The span of cable i at a pose, in the level frame: that of a cable without pulley.
    #[inline]
    pub(crate) fn span(&self, pose: &Pose, i: usize) -> Span<f64> {
        Span::new(end(self.robot, pose, i).into())
    }

    /// The force (fx, fz) [N] of cable i in its own equilibrium at a pose, searched from a force at a pose
    /// nearby.
    pub(crate) fn force_at(
        &self,
        pose: &Pose,
        i: usize,
        near: Option<(&Pose, &Vector2<f64>)>,
    ) -> Result<Vector2<f64>, CableError> {
        let mut catenary = self.catenary(i, near.map_or_else(Vector2::zeros, |(_, force)| *force));
        if catenary.cable.leaves_its_plane() {
            return self.spatial_force_at(pose, i, near);
        }
        let span = self.span(pose, i);
        let Some((before, force)) = near else {
            return Ok(end_force(&catenary.cable, self.lengths[i], span.end.into())?.catenary.force);
        };
        let way = Vector2::from(span.end) - Vector2::from(self.span(before, i).end);
        let predicted = force + catenary.in_plane_stiffness() * way;
        if (0.3 * force.x..3.0 * force.x).contains(&predicted.x) {
            catenary.force = predicted;
        }
        Ok(end_force_near(&catenary, span.end.into())?.catenary.force)
    }

    #[cold]
    fn spatial_force_at(
        &self,
        pose: &Pose,
        i: usize,
        near: Option<(&Pose, &Vector2<f64>)>,
    ) -> Result<Vector2<f64>, CableError> {
        let near = near.map(|(pose, force)| {
            let near = SpannedCable::of(self.robot, pose, i, &self.catenary(i, *force));
            near.span.plane.lift(near.force).into()
        });
        let force = spatial_end_force(&self.cable(i), self.lengths[i], end(self.robot, pose, i), near)?.force;
        Ok(Vector2::new(force.xy().norm(), force.z))
    }

    /// Cable i in its vertical plane, with the force (fx, fz) [N] at a pose.
    #[inline]
    pub(crate) fn catenary_at(&self, pose: &Pose, i: usize, force: Vector2<f64>) -> Catenary<'a> {
        in_its_plane(self.robot, pose, i, self.catenary(i, force))
    }
}

/// Cable i of a robot at a pose, its pulley seen in the plane that it hangs in.
#[inline]
fn in_its_plane<'a>(robot: &Robot, pose: &Pose, i: usize, catenary: Catenary<'a>) -> Catenary<'a> {
    if !catenary.cable.leaves_its_plane() {
        return catenary;
    }
    let plane = SpannedCable::of(robot, pose, i, &catenary).span.plane;
    Catenary { cable: catenary.cable.turned(plane.azimuth), ..catenary }
}

impl Equilibrium {
    /// Tension of every cable at its exit point [N], for the robot and unstrained lengths [m] that it is an
    /// equilibrium of; over a pulley where the cable leaves it.
    pub fn exit_tensions(&self, robot: &Robot, lengths: &[f64]) -> Vec<f64> {
        let each = self.cable_forces.iter().zip(lengths).enumerate();
        each.map(|(i, (force, length))| {
            let catenary = Catenary { cable: robot.cable(i), unstrained_length: *length, force: *force };
            in_its_plane(robot, &self.pose, i, catenary).exit_tension()
        })
        .collect()
    }
}
