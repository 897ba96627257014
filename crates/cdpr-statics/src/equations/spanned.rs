//! A cable of a robot between its two points, with the force it carries and how it responds.
//!
//! The mechanics of a cable are those of the level frame, whose z axis points against gravity. Where the base
//! frame is tilted, spans are rotated into the level frame and forces back. Over a pulley with a tilted axis
//! the cable hangs in a plane that does not contain the entry point: its azimuth is that with which the cable
//! meets its anchor point across the plane, for the force and length that it has.

mod alone;
mod slopes;
mod stiffness;

use crate::equations::cable::{CablePlane, LinearizedCable, Span, between};
use crate::problem::DirectProblem;
pub(crate) use alone::{guided_place, in_its_plane};
use cdpr_cable::kernel::{Response, closure_of_slack, response};
use cdpr_cable::{Catenary, Guide, SpatialCable, SpatialResponse};
use cdpr_number::Real;
use cdpr_number::vector::{dot, wrench};
use cdpr_robot::{Matrix3, Pose, Robot, Vector2, Vector3};
pub(crate) use stiffness::LinearizedInSpace;

/// A cable with a force that need not fit its two points.
pub(crate) struct SpannedCable<'a, T> {
    /// s_i = R a_i [m].
    pub(crate) anchor_arm: [T; 3],
    /// The span in the level frame, in the plane that the cable hangs in.
    pub(crate) span: Span<T>,
    /// (fx, fz) on the cable at A [N].
    pub(crate) force: [T; 2],
    response: EndResponse<T>,
    level: Option<&'a Matrix3<f64>>,
}

/// How the end of a cable responds to forces.
enum EndResponse<T> {
    /// In its plane.
    Planar(Response<T>),
    /// Over a tilted axis, in the level frame.
    Spatial(Box<SpatialResponse>),
    /// A slack cable without weight has no shape: its length without tension [m], and its guide.
    Slack(Box<(f64, Option<Guide>)>),
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

/// How a cable responds over the vector r [m] in the level frame; its span is that of the plane it hangs in.
#[inline(always)]
fn end_response<T: Real>(
    catenary: &Catenary,
    span: Span<T>,
    r: [T; 3],
    response: impl FnOnce() -> Response<T>,
) -> (Span<T>, EndResponse<T>) {
    if catenary.is_slack_and_weightless() {
        return (span, EndResponse::Slack(Box::new((catenary.length_at_rest(), catenary.cable.guide))));
    }
    if catenary.cable.leaves_its_plane() {
        let azimuth = span.plane.azimuth.map(T::value);
        let (azimuth, response) = hanging(catenary, azimuth.into(), r.map(T::value).into());
        let plane = CablePlane { azimuth: <[f64; 2]>::from(azimuth).map(T::of) };
        return (Span { end: plane.project(r), plane }, EndResponse::Spatial(Box::new(response)));
    }
    (span, EndResponse::Planar(response()))
}

/// Azimuth of the plane in which a cable over a tilted axis hangs to `end` [m] with its force, and how it
/// responds there.
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
    let (mut response, mut way, mut sideways) = at(forwards);
    for _ in 0..MAX_ITERATIONS {
        if sideways.abs() <= ROUNDING * way.norm() {
            break;
        }
        // What a turn of the plane by an angle moves across it: nearly the distance from the leave point.
        let across = Vector3::new(-forwards.y, forwards.x, 0.0);
        let swing = fx * (response.flexibility * across).dot(&across);
        let reach = forwards.dot(&(end - response.end).xy()) + swing;
        let towards = if forwards.dot(&way) > 0.0 && reach > 0.0 {
            forwards + across.xy() * (sideways / reach)
        } else {
            way
        };
        let Some(next) = towards.try_normalize(0.0) else { break };
        let turned = at(next);
        if turned.2.abs() >= sideways.abs() {
            break;
        }
        forwards = next;
        (response, way, sideways) = turned;
    }
    (forwards, response)
}

impl<'a> SpannedCable<'a, f64> {
    /// Cable i of a robot at a pose, in the shape of `catenary`.
    #[inline(always)]
    pub(crate) fn of(robot: &'a Robot, pose: &Pose, i: usize, catenary: &Catenary) -> Self {
        let anchor_arm = robot.anchor_arm(pose, i).into();
        let level = robot.gravity.level();
        let r =
            to_level(level, between(&pose.position.into(), &anchor_arm, &robot.cables[i].exit_point.into()));
        let (span, response) = end_response(catenary, Span::new(r), r, || catenary.response());
        Self { anchor_arm, span, force: catenary.force.into(), response, level }
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
        let (span, response) = end_response(&catenary, Span::new(r), r, response);
        Self { anchor_arm, span, force, response, level }
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

    /// How its end responds to forces in the plane of its span; `None` for a slack cable without weight, and
    /// for one over a tilted axis.
    #[inline(always)]
    pub(crate) fn response(&self) -> Option<&Response<T>> {
        if let EndResponse::Planar(response) = &self.response { Some(response) } else { None }
    }

    /// The cable linearized about its force, of a cable that stays in the plane of its span.
    #[inline(always)]
    pub(crate) fn planar(&self) -> Option<LinearizedCable<T>> {
        self.response().map(|response| LinearizedCable::new(&self.span, self.force, response))
    }

    /// Misclosure [m]: from the end of the cable to its anchor point.
    #[inline(always)]
    pub(crate) fn misclosure(&self) -> [T; 2] {
        match &self.response {
            EndResponse::Planar(response) => self.span.misclosure(response.end),
            EndResponse::Spatial(spatial) => {
                let end = <[f64; 3]>::from(spatial.end).map(T::of);
                self.span.misclosure(self.span.plane.project(end))
            }
            EndResponse::Slack(slack) => match &**slack {
                (rest, None) => closure_of_slack(self.span.end, T::of(*rest)),
                (rest, Some(guide)) => {
                    let end = self.span.plane.lift(self.span.end).map(T::value);
                    let open = guide.closure_of_slack(end.into(), *rest);
                    self.span.plane.project(<[f64; 3]>::from(open).map(T::of))
                }
            },
        }
    }
}

/// Azimuth of the plane that cable i hangs in at a pose, in the shape of `catenary`.
pub(crate) fn azimuth(robot: &Robot, pose: &Pose, i: usize, catenary: &Catenary) -> [f64; 2] {
    let end = end(robot, pose, i);
    let of_points = Span::new(end.into()).plane.azimuth;
    match catenary.cable.leaves_its_plane() && !catenary.is_slack_and_weightless() {
        true => hanging(catenary, of_points.into(), end).0.into(),
        false => of_points,
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
}
