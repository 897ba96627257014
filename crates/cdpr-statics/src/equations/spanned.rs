//! A cable of a robot between its two points, with the force it carries and how it answers.

use crate::equations::cable::{LinearizedCable, Span, between};
use crate::equations::vector::wrench;
use crate::problem::DirectProblem;
use cdpr_cable::kernel::{Real, Response, closure_of_limp, response};
use cdpr_cable::{Catenary, Guide};
use cdpr_robot::{Matrix3, Pose, Robot, Vector2, Vector3};

/// A cable with a force that need not fit its two points.
#[derive(Clone, Copy)]
pub(crate) struct SpannedCable<T> {
    /// s_i = R a_i [m].
    pub(crate) anchor_arm: [T; 3],
    pub(crate) span: Span<T>,
    /// (fx, fz) on the cable at A [N].
    pub(crate) force: [T; 2],
    /// How its end answers to forces; `None` for a slack cable without weight, which has no shape.
    pub(crate) response: Option<Response<T>>,
    /// Length without tension and weight [m].
    length_at_rest: f64,
    guide: Option<Guide>,
}

impl SpannedCable<f64> {
    /// Cable i of a robot at a pose, in the shape of `catenary`.
    #[inline(always)]
    pub(crate) fn of(robot: &Robot, pose: &Pose, i: usize, catenary: &Catenary) -> Self {
        let (limp, anchor_arm) = (catenary.is_limp(), robot.anchor_arm(pose, i).into());
        Self {
            anchor_arm,
            span: Span::new(between(&pose.position.into(), &anchor_arm, &robot.cables[i].exit_point.into())),
            force: catenary.force.into(),
            response: (!limp).then(|| catenary.response()),
            length_at_rest: if limp { catenary.length_at_rest() } else { catenary.unstrained_length },
            guide: catenary.cable.guide,
        }
    }
}

impl SpannedCable<f64> {
    /// Skew part of the stiffness in space [N/m], besides [`LinearizedCable::stiffness_in_space`]: of a cable
    /// over a guide, whose flexibility is not quite symmetric (C22).
    pub(crate) fn skew_stiffness(&self, catenary: &Catenary) -> Option<Matrix3<f64>> {
        catenary.cable.guide?;
        let asymmetry = catenary.asymmetry();
        let determinant = self.response?.determinant + asymmetry * asymmetry;
        let forwards = Vector3::from(self.span.plane.lift([1.0, 0.0]));
        let up = Vector3::z();
        Some((up * forwards.transpose() - forwards * up.transpose()) * (asymmetry / determinant))
    }
}

impl<T: Real> SpannedCable<T> {
    /// Cable i with its anchor point at `position + anchor_arm` [m].
    pub(crate) fn new(
        problem: &DirectProblem,
        position: [T; 3],
        anchor_arm: [T; 3],
        force: [T; 2],
        i: usize,
    ) -> Self {
        let cable = &problem.robot.cables[i];
        let p = &cable.properties;
        let catenary = problem.catenary(i, Vector2::from(force.map(T::value)));
        let answer = || match (&p.law, catenary.cable.guide) {
            (None, None) => {
                let weight = T::of(p.linear_density) * T::of(problem.robot.gravity.magnitude());
                let stiffness = T::of(p.youngs_modulus) * T::of(p.section);
                response(weight, stiffness.recip(), T::of(problem.lengths[i]), force)
            }
            // Only doubles come here: certificates refuse such a cable.
            _ => catenary.response().map(T::of),
        };
        Self {
            anchor_arm,
            span: Span::new(between(&position, &anchor_arm, &<[f64; 3]>::from(cable.exit_point).map(T::of))),
            force,
            response: (!catenary.is_limp()).then(answer),
            length_at_rest: catenary.length_at_rest(),
            guide: catenary.cable.guide,
        }
    }

    /// F_i [N], the force on the platform.
    #[inline(always)]
    pub(crate) fn force_on_platform(&self) -> [T; 3] {
        self.span.plane.force_on_platform(self.force)
    }

    /// [F_i; s_i x F_i] [N, N m], the wrench on the platform.
    #[inline(always)]
    pub(crate) fn wrench(&self) -> [T; 6] {
        wrench(&self.anchor_arm, &self.force_on_platform())
    }

    /// Misclosure [m]: from the end of the cable to its anchor point.
    #[inline(always)]
    pub(crate) fn misclosure(&self) -> [T; 2] {
        match &self.response {
            Some(response) => self.span.misclosure(response.end),
            None => match &self.guide {
                None => closure_of_limp(self.span.end, T::of(self.length_at_rest)),
                Some(guide) => {
                    guide.closure_of_limp(self.span.end.map(T::value), self.length_at_rest).map(T::of)
                }
            },
        }
    }

    /// The cable linearised about its force; `None` for a slack cable without weight, which resists nothing.
    #[inline(always)]
    pub(crate) fn linearized(&self) -> Option<LinearizedCable<T>> {
        self.response.as_ref().map(|response| LinearizedCable::new(&self.span, self.force, response))
    }
}

impl DirectProblem<'_> {
    /// The span of cable i at a pose.
    pub(crate) fn span(&self, pose: &Pose, i: usize) -> Span<f64> {
        Span::new(self.robot.span(pose, i).into())
    }
}
