//! A cable of a robot between its two points, with the force it carries and how it answers.
//!
//! The mechanics of a cable are those of the level frame, whose z axis points against gravity. Where the base
//! frame is tilted, spans are rotated into the level frame and forces back. Over a pulley with a tilted axis
//! the cable hangs in a plane that does not contain the entry point: its azimuth is that with which the cable
//! meets its anchor point across the plane, for the force and length that it has.

use crate::equations::cable::{CablePlane, LinearizedCable, Span, between};
use crate::equations::vector::{dot, wrench};
use crate::problem::DirectProblem;
use cdpr_cable::kernel::{Real, Response, closure_of_limp, response};
use cdpr_cable::{
    CableError, Catenary, Guide, HeldCable, HeldSpatialCable, SpatialCable, SpatialResponse, SpatialSlopes,
    SpatialTensionSlope, end_force, end_force_near, spatial_end_force,
};
use cdpr_robot::{Matrix3, Pose, Robot, Vector2, Vector3};

/// A cable with a force that need not fit its two points.
pub(crate) struct SpannedCable<'a, T> {
    /// s_i = R a_i [m].
    pub(crate) anchor_arm: [T; 3],
    /// The span in the level frame, in the plane that the cable hangs in.
    pub(crate) span: Span<T>,
    /// (fx, fz) on the cable at A [N].
    pub(crate) force: [T; 2],
    /// How its end answers to forces in its plane; `None` for a slack cable without weight, which has no
    /// shape, and for one over a tilted axis.
    pub(crate) response: Option<Response<T>>,
    /// How the end of a cable over a tilted axis answers, in the level frame.
    spatial: Option<Box<SpatialResponse>>,
    /// Length without tension and weight [m].
    length_at_rest: f64,
    guide: Option<Guide>,
    level: Option<&'a Matrix3<f64>>,
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

impl<'a> SpannedCable<'a, f64> {
    /// Cable i of a robot at a pose, in the shape of `catenary`.
    #[inline(always)]
    pub(crate) fn of(robot: &'a Robot, pose: &Pose, i: usize, catenary: &Catenary) -> Self {
        let (limp, anchor_arm) = (catenary.is_limp(), robot.anchor_arm(pose, i).into());
        let leaves = catenary.cable.leaves_its_plane();
        let level = robot.gravity.level();
        let r = between(&pose.position.into(), &anchor_arm, &robot.cables[i].exit_point.into());
        let cable = Self {
            anchor_arm,
            span: Span::new(to_level(level, r)),
            force: catenary.force.into(),
            response: (!limp && !leaves).then(|| catenary.response()),
            spatial: None,
            length_at_rest: if limp { catenary.length_at_rest() } else { catenary.unstrained_length },
            guide: catenary.cable.guide,
            level,
        };
        if limp || !leaves { cable } else { cable.in_space(catenary, to_level(level, r).into()) }
    }

    /// The cable over a tilted axis to `end` [m] in the level frame, in the plane in which it hangs.
    #[cold]
    fn in_space(self, catenary: &Catenary, end: Vector3<f64>) -> Self {
        const MAX_ITERATIONS: usize = 30;
        let mut plane = self.span.plane;
        let mut best: Option<(f64, CablePlane<f64>, SpatialResponse)> = None;
        for _ in 0..MAX_ITERATIONS {
            let cable = SpatialCable {
                cable: catenary.cable,
                unstrained_length: catenary.unstrained_length,
                force: plane.lift(self.force).into(),
            };
            let response = cable.response();
            let way = (end - response.leave).xy();
            let forwards = Vector2::from(plane.azimuth);
            let across = Vector2::new(-forwards.y, forwards.x);
            let beside = across.dot(&way);
            if best.is_some_and(|(least, ..)| beside.abs() >= least) {
                break;
            }
            best = Some((beside.abs(), plane, response));
            // What a turn of the plane by an angle moves across it: nearly the distance from the leave point.
            let sideways = Vector3::new(across.x, across.y, 0.0);
            let swing = self.force[0] * (response.flexibility * sideways).dot(&sideways);
            let reach = forwards.dot(&(end - response.end).xy()) + swing;
            let towards = if forwards.dot(&way) > 0.0 && reach > 0.0 {
                forwards + across * (beside / reach)
            } else {
                way
            };
            let Some(azimuth) = towards.try_normalize(0.0) else { break };
            plane = CablePlane { azimuth: azimuth.into() };
        }
        let Some((_, plane, response)) = best else { return self };
        let span = Span { end: plane.project(end.into()), plane };
        Self { span, spatial: Some(Box::new(response)), ..self }
    }

    /// The misclosure in space of a cable over a tilted axis [m], in the level frame.
    fn open(&self) -> Vector3<f64> {
        self.span.plane.lift(self.misclosure()).into()
    }

    /// The cable linearised about its force; `None` for a slack cable without weight, which resists nothing.
    #[inline(always)]
    pub(crate) fn linearized(&self) -> Option<SpannedStiffness<'a>> {
        if self.level.is_some() || self.response.is_none() {
            return self.turned();
        }
        self.planar().map(SpannedStiffness::Level)
    }

    #[cold]
    fn turned(&self) -> Option<SpannedStiffness<'a>> {
        let (plane, level) = (self.span.plane, self.level);
        let (predicted, stiffness) = match (self.planar(), &self.spatial) {
            (Some(planar), _) => (plane.lift(planar.predicted).into(), planar.stiffness_in_space().into()),
            (None, Some(spatial)) => {
                let stiffness = spatial.flexibility.try_inverse().unwrap_or_else(Matrix3::zeros);
                let predicted = Vector3::from(plane.lift(self.force)) + stiffness * self.open();
                (predicted, 0.5 * (stiffness + stiffness.transpose()))
            }
            (None, None) => return None,
        };
        let leaves = self.spatial.is_some();
        Some(SpannedStiffness::Turned(Box::new(Turned { plane, predicted, stiffness, leaves, level })))
    }

    /// Skew part of the stiffness in space [N/m], in the base frame, besides the symmetric one of
    /// [`SpannedStiffness::stiffness`]: of a cable over a guide, whose flexibility is not quite symmetric
    /// (C22).
    pub(crate) fn skew_stiffness(&self, catenary: &Catenary) -> Option<Matrix3<f64>> {
        catenary.cable.guide?;
        let skew = match (&self.response, &self.spatial) {
            (Some(response), _) => {
                let asymmetry = catenary.asymmetry();
                let determinant = response.determinant + asymmetry * asymmetry;
                let forwards = Vector3::from(self.span.plane.lift([1.0, 0.0]));
                let up = Vector3::z();
                (up * forwards.transpose() - forwards * up.transpose()) * (asymmetry / determinant)
            }
            (None, Some(spatial)) => {
                let stiffness = spatial.flexibility.try_inverse()?;
                0.5 * (stiffness - stiffness.transpose())
            }
            (None, None) => return None,
        };
        Some(self.based_matrix(&skew))
    }

    /// The position of the free end of the cable per unstrained length at constant force [m/m], in the base
    /// frame; zero for a slack cable without weight.
    pub(crate) fn end_per_length(&self) -> Vector3<f64> {
        let slope = match (&self.response, &self.spatial) {
            (Some(response), _) => self.span.plane.lift(response.end_per_length),
            (None, Some(spatial)) => spatial.end_per_length.into(),
            (None, None) => [0.0; 3],
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
    pub(crate) fn tension_slopes(&self, catenary: &Catenary<'a>, end: Vector3<f64>) -> SpatialTensionSlope {
        if let Some(cable) = self.over_a_pulley(catenary) {
            let slopes = HeldSpatialCable::of(cable, end).tension_slopes();
            return SpatialTensionSlope {
                force_per_tension: self.based(slopes.force_per_tension),
                per_tension: self.based(slopes.per_tension),
                per_end: self.based_matrix(&slopes.per_end),
                per_weight: self.based(slopes.per_weight),
                per_stiffness: self.based(slopes.per_stiffness),
                per_lead: self.based(slopes.per_lead),
                per_radius: self.based(slopes.per_radius),
                per_axis: self.based_matrix(&slopes.per_axis),
            };
        }
        let held = HeldCable::of(*catenary, self.span.end.into());
        let slopes = held.tension_slopes();
        let lift = |v: Vector2<f64>| self.based(self.span.plane.lift(v.into()).into());
        let (forwards, up) = (lift(Vector2::x()), lift(Vector2::y()));
        let across = up.cross(&forwards);
        // v_x/h
        let lateral = 1.0 / (self.span.chord() * held.tension_slope());
        let [per_h, per_z] = slopes.per_end.map(lift);
        SpatialTensionSlope {
            force_per_tension: lift(slopes.force_per_tension),
            per_tension: lift(slopes.per_tension),
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

    /// The cable in space, in the level frame, if it runs over a pulley: only there do derivatives leave its
    /// plane.
    fn over_a_pulley(&self, catenary: &Catenary<'a>) -> Option<SpatialCable<'a>> {
        let Catenary { cable, unstrained_length, .. } = *catenary;
        let force = self.span.plane.lift(self.force).into();
        cable.guide.filter(|guide| guide.radius > 0.0)?;
        Some(SpatialCable { cable, unstrained_length, force })
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
    plane: CablePlane<f64>,
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

    /// The force (fx, fz) on the cable [N] after a displacement of A in space [m], in its plane before.
    #[inline(always)]
    pub(crate) fn force_after(&self, displacement: [f64; 3]) -> [f64; 2] {
        match self {
            Self::Level(cable) => cable.force_after(displacement),
            Self::Turned(cable) => cable.force_after(displacement),
        }
    }

    /// A force (fx, fz) on the cable [N], in the level frame.
    pub(crate) fn lift(&self, force: [f64; 2]) -> [f64; 3] {
        match self {
            Self::Level(cable) => cable.plane.lift(force),
            Self::Turned(cable) => cable.plane.lift(force),
        }
    }
}

impl Turned<'_> {
    #[cold]
    fn stiffness(&self) -> [[f64; 3]; 3] {
        self.level.map_or(self.stiffness, |level| level.transpose() * self.stiffness * level).into()
    }

    #[cold]
    fn force_after(&self, displacement: [f64; 3]) -> [f64; 2] {
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
        let answer = || match (&p.law, catenary.cable.guide) {
            (None, None) => {
                let weight = T::of(p.linear_density) * T::of(problem.robot.gravity.magnitude());
                let stiffness = T::of(p.youngs_modulus) * T::of(p.section);
                response(weight, stiffness.recip(), T::of(problem.lengths[i]), force)
            }
            // Only doubles come here: certificates refuse such a cable.
            _ => catenary.response().map(T::of),
        };
        let r =
            to_level(level, between(&position, &anchor_arm, &<[f64; 3]>::from(cable.exit_point).map(T::of)));
        let (limp, leaves) = (catenary.is_limp(), catenary.cable.leaves_its_plane());
        let shaped = Self {
            anchor_arm,
            span: Span::new(r),
            force,
            response: (!limp && !leaves).then(answer),
            spatial: None,
            length_at_rest: catenary.length_at_rest(),
            guide: catenary.cable.guide,
            level,
        };
        if leaves && !limp {
            let found = shaped.plain().in_space(&catenary, r.map(T::value).into());
            let plane = CablePlane { azimuth: found.span.plane.azimuth.map(T::of) };
            return Self { span: Span { end: plane.project(r), plane }, spatial: found.spatial, ..shaped };
        }
        shaped
    }

    /// The same cable in doubles, without how it answers.
    fn plain(&self) -> SpannedCable<'a, f64> {
        let Self { length_at_rest, guide, level, .. } = *self;
        let plane = CablePlane { azimuth: self.span.plane.azimuth.map(T::value) };
        SpannedCable {
            anchor_arm: self.anchor_arm.map(T::value),
            span: Span { plane, end: self.span.end.map(T::value) },
            force: self.force.map(T::value),
            response: None,
            spatial: None,
            length_at_rest,
            guide,
            level,
        }
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

    /// The cable linearised about its force, of a cable that stays in the plane of its span.
    #[inline(always)]
    pub(crate) fn planar(&self) -> Option<LinearizedCable<T>> {
        self.response.as_ref().map(|response| LinearizedCable::new(&self.span, self.force, response))
    }

    /// Misclosure [m]: from the end of the cable to its anchor point.
    #[inline(always)]
    pub(crate) fn misclosure(&self) -> [T; 2] {
        match (&self.response, &self.spatial) {
            (Some(response), _) => self.span.misclosure(response.end),
            (None, Some(spatial)) => {
                let end = <[f64; 3]>::from(spatial.end).map(T::of);
                self.span.misclosure(self.span.plane.project(end))
            }
            (None, None) => match &self.guide {
                None => closure_of_limp(self.span.end, T::of(self.length_at_rest)),
                Some(guide) => {
                    let end = self.span.plane.lift(self.span.end).map(T::value);
                    let open = guide.closure_of_limp(end.into(), self.length_at_rest);
                    self.span.plane.project(<[f64; 3]>::from(open).map(T::of))
                }
            },
        }
    }
}

/// The vector from exit point i to anchor point i at a pose [m], in the level frame.
pub(crate) fn end(robot: &Robot, pose: &Pose, i: usize) -> Vector3<f64> {
    to_level(robot.gravity.level(), robot.span(pose, i).into()).into()
}

impl<'a> DirectProblem<'a> {
    /// The span of cable i at a pose, in the level frame: that of a cable without pulley.
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
        let (cable, length, span) = (self.cable(i), self.lengths[i], self.span(pose, i));
        if cable.leaves_its_plane() {
            let near = near.map(|(pose, force)| {
                let near = SpannedCable::of(self.robot, pose, i, &self.catenary(i, *force));
                near.span.plane.lift(near.force).into()
            });
            let force = spatial_end_force(&cable, length, end(self.robot, pose, i), near)?.force;
            return Ok(Vector2::new(force.xy().norm(), force.z));
        }
        let solution = match near {
            None => end_force(&cable, length, span.end.into())?,
            Some((before, force)) => {
                let mut near = self.catenary(i, *force);
                let way = Vector2::from(span.end) - Vector2::from(self.span(before, i).end);
                let predicted = force + near.in_plane_stiffness() * way;
                if (0.3 * force.x..3.0 * force.x).contains(&predicted.x) {
                    near.force = predicted;
                }
                end_force_near(&near, span.end.into())?
            }
        };
        Ok(solution.catenary.force)
    }

    /// Cable i in its vertical plane, with the force (fx, fz) [N] at a pose.
    pub(crate) fn catenary_at(&self, pose: &Pose, i: usize, force: Vector2<f64>) -> Catenary<'a> {
        let catenary = self.catenary(i, force);
        if !catenary.cable.leaves_its_plane() {
            return catenary;
        }
        let plane = SpannedCable::of(self.robot, pose, i, &catenary).span.plane;
        Catenary { cable: catenary.cable.turned(plane.azimuth), ..catenary }
    }
}
