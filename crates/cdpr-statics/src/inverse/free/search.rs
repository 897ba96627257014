//! Steps to a solution of the balance with free coordinates, (I6).
//!
//! In chord forces (`cdpr_cable::HeldCable`) the elasticity of the cables does not appear in the slopes, and
//! the equations are nearly those of straight strings. Steps of Levenberg and Marquardt in (ln σ, q) make |F|
//! least. A coordinate q moves anchor point i by d_i and turns its lever arm by ds_i. At the same chord
//! force, with the derivative of F_i by (C38) of `cdpr_cable`,
//!
//! ```text
//! dF/dq = sum [ ∂F_i/∂r_i d_i; s_i x ∂F_i/∂r_i d_i + ds_i x F_i ] + [0; dRc x F_w]                 (I8)
//! ```

use crate::error::StaticsError;
use crate::inverse::PoseLengths;
use crate::inverse::cable::{CableAtPose, Pull, Row};
use crate::inverse::problem::InverseProblem;
use crate::rest_fault::RestFault;
use crate::state::Load;
use cdpr_robot::{Coordinate, Plane, Pose, Robot, Rotation3, Vector3, Vector6};
use cdpr_tension::{BoxProblem, BoxUnknown};
use nalgebra::{DMatrix, DVector};

/// Iterations for the singular values of a matrix; a few for each of them are usual.
pub(super) const SINGULAR_VALUES: usize = 1000;

const MAX_ITERATIONS: usize = 80;

/// A residual below this, relative to wrench and tensions, is rounding.
pub(super) const ROUNDING: f64 = 1e-15;

/// A residual below this, relative to wrench and tensions, is a solution as far as rounding lets it be.
pub(super) const SOLVED: f64 = 1e-11;

/// Solutions nearer than this, in radians and relative to the longest span, are the same.
pub(super) const SAME: f64 = 1e-7;

/// Greatest change of an angle [rad] in one step, or of a position relative to the longest span.
const GREATEST_STEP: f64 = 0.3;

/// A robot with a pose of which some coordinates are looked for.
pub(super) struct Search<'a> {
    pub(super) problem: InverseProblem<'a>,
    pub(super) free: &'a [Coordinate],
    /// roll, pitch and yaw of the given pose [rad].
    angles: [f64; 3],
    /// The longest span [m].
    pub(super) size: f64,
}

/// A pose of the search with the wrench of its cables.
pub(super) struct Point {
    pub(super) found: PoseLengths,
    rows: Vec<Row>,
    /// F, moments divided by the characteristic length [N].
    pub(super) residual: Vector6<f64>,
    /// The forces that the residual is compared with [N].
    pub(super) forces: f64,
}

/// Unknowns of (I6).
#[derive(Clone, Debug)]
pub(super) struct Unknowns {
    /// Changes of the free coordinates from the given ones, in their units.
    pub(super) changes: Vec<f64>,
    /// σ [N].
    pub(super) chord_forces: Vec<f64>,
}

/// How a search ends.
pub(super) enum Outcome {
    Found(Point, Unknowns, usize),
    /// Where |F| is least.
    Stuck(Point),
    /// Where a cable has no shape.
    Lost,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        robot: &'a Robot,
        pose: &'a Pose,
        load: &'a Load,
        free: &'a [Coordinate],
    ) -> Result<Self, StaticsError> {
        let problem = InverseProblem::with_platform_limits(robot, pose, load, None)?;
        let (roll, pitch, yaw) = pose.rotation.euler_angles();
        let size = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
        Ok(Self { problem, free, angles: [roll, pitch, yaw], size })
    }

    /// roll, pitch and yaw [rad] where the free coordinates differ by `changes` from the given ones.
    fn angles(&self, changes: &[f64]) -> [f64; 3] {
        let mut angles = self.angles;
        for (coordinate, change) in self.free.iter().zip(changes).filter(|(one, _)| one.is_angle()) {
            angles[coordinate.component() - 3] += change;
        }
        angles
    }

    /// The pose whose free coordinates differ by `changes`, in their units, from the given ones.
    pub(super) fn pose(&self, changes: &[f64]) -> Pose {
        let mut pose = *self.problem.pose;
        for (coordinate, change) in self.free.iter().zip(changes).filter(|(one, _)| !one.is_angle()) {
            pose.position[coordinate.component()] += change * self.size;
        }
        let angles = self.angles(changes);
        if angles == self.angles {
            return pose;
        }
        let [roll, pitch, yaw] = angles;
        pose.rotation = match self.problem.robot.plane.map(Plane::normal) {
            None => Rotation3::from_euler_angles(roll, pitch, yaw),
            // The one rotation of a planar robot is about an axis of the base frame.
            Some(axis) => {
                Rotation3::new(Vector3::ith(axis, angles[axis] - self.angles[axis])) * pose.rotation
            }
        };
        pose
    }

    /// Whether the pitch is beyond a right angle: the pose is then that of another roll, pitch and yaw, of
    /// which those that are given have other values. Where all three are free, none is given.
    pub(super) fn is_turned_about(&self, changes: &[f64]) -> bool {
        let [_, pitch, _] = self.angles(changes);
        let free = |coordinate| self.free.contains(&coordinate);
        let are_all_free = [Coordinate::Roll, Coordinate::Pitch, Coordinate::Yaw].into_iter().all(free);
        let is_of_others = free(Coordinate::Pitch) && !are_all_free;
        self.problem.robot.plane.is_none() && is_of_others && pitch.cos() < 0.0
    }

    /// Motion (dp, dφ) of the platform per unit of a free coordinate.
    pub(super) fn motion(&self, coordinate: Coordinate, changes: &[f64]) -> Vector6<f64> {
        let [_, pitch, yaw] = self.angles(changes);
        match (coordinate.is_angle(), self.problem.robot.plane) {
            (false, _) => Vector6::ith(coordinate.component(), self.size),
            (true, Some(_)) => Vector6::ith(coordinate.component(), 1.0),
            (true, None) => coordinate.motion(yaw, pitch),
        }
    }

    fn problem_at<'b>(&'b self, pose: &'b Pose) -> InverseProblem<'b> {
        self.problem.nearby(pose, self.problem.load, self.problem.reference.clone())
    }

    /// The cables at a pose with given chord forces [N]; `None` where one of them has no shape.
    pub(super) fn point(&self, changes: &[f64], chord_forces: &[f64]) -> Option<Point> {
        let pose = self.pose(changes);
        let cables = cables(&self.problem_at(&pose), chord_forces)?;
        let row = |cable: &CableAtPose| cable.row(&cable.fixed, self.problem.characteristic_length);
        let rows: Vec<Row> = cables.iter().map(row).collect();
        let external = self.problem.load.total(self.problem.robot, &pose);
        let external = self.scaled(external.force, external.moment);
        let residual = rows.iter().fold(external, |sum, row| sum + row.wrench);
        let forces = external.norm() + rows.iter().map(|row| row.wrench.norm()).sum::<f64>();
        let catenaries: Vec<_> = cables.iter().map(|cable| cable.fixed.catenary).collect();
        let found = PoseLengths::new(&pose, &catenaries);
        residual.iter().all(|entry| entry.is_finite()).then_some(Point { found, rows, residual, forces })
    }

    /// dF/d(ln σ, q), with q in units; `None` where it is not finite, as for a force near zero.
    pub(super) fn slopes(
        &self,
        changes: &[f64],
        chord_forces: &[f64],
        point: &Point,
    ) -> Option<DMatrix<f64>> {
        let mut slopes = DMatrix::zeros(6, chord_forces.len() + changes.len());
        for (i, (row, force)) in point.rows.iter().zip(chord_forces).enumerate() {
            slopes.set_column(i, &(row.slope * *force));
        }
        let pose = self.pose(changes);
        let cables = cables(&self.problem_at(&pose), chord_forces)?;
        let pulls: Vec<Pull> = cables.iter().map(CableAtPose::pull).collect();
        for (k, slope) in self.per_coordinate(&pose, changes, &pulls).enumerate() {
            slopes.set_column(chord_forces.len() + k, &slope);
        }
        slopes.iter().all(|slope| slope.is_finite()).then_some(slopes)
    }

    /// A wrench with its moment divided by the characteristic length, along the motions of the platform.
    pub(super) fn scaled(&self, force: Vector3<f64>, moment: Vector3<f64>) -> Vector6<f64> {
        let InverseProblem { robot, characteristic_length, .. } = self.problem;
        let moment = moment / characteristic_length;
        robot.freedoms().of_vector(&Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z))
    }

    /// Derivatives (I8) of the balance by the free coordinates.
    pub(super) fn per_coordinate(
        &self,
        pose: &Pose,
        changes: &[f64],
        pulls: &[Pull],
    ) -> impl Iterator<Item = Vector6<f64>> {
        let InverseProblem { robot, load, .. } = self.problem;
        let weight = robot.weight(pose, load.payload).force;
        let center = pose.rotation * robot.platform.center_of_mass;
        self.free.iter().map(move |coordinate| {
            let motion = self.motion(*coordinate, changes);
            let [shift, turn]: [Vector3<f64>; 2] = [0, 3].map(|row| motion.fixed_rows::<3>(row).into());
            let (mut force, mut moment) = (Vector3::zeros(), turn.cross(&center).cross(&weight));
            for Pull { lever_arm, force: pull, per_motion } in pulls {
                let turned = turn.cross(lever_arm);
                let change = per_motion * (shift + turned);
                force += change;
                moment += lever_arm.cross(&change) + turned.cross(pull);
            }
            self.scaled(force, moment)
        })
    }

    /// Chord forces of the straight cables that hold the pose best within their limits [N]: fewer cables than
    /// free motions balance the wrench at few poses only.
    pub(super) fn straight_forces(&self, changes: &[f64]) -> Vec<f64> {
        let pose = self.pose(changes);
        let problem = self.problem_at(&pose);
        let matrix = problem.straight_matrix();
        let each = matrix.column_iter().zip(&problem.reference).zip(&problem.limits);
        let unknowns: Vec<BoxUnknown> = each
            .map(|((column, reference), limits)| BoxUnknown {
                gradient: -reference,
                curvature: 1.0,
                column: problem.robot.freedoms().of_vector(&column.into()),
                bounds: [limits.min, limits.max],
            })
            .collect();
        let (residual, multipliers) = (problem.external, Vector6::zeros());
        let program = BoxProblem { unknowns: &unknowns, residual, multipliers };
        program.solve().values.into_iter().map(|t| t.max(self.least_force())).collect()
    }

    /// The least chord force that a search starts from [N].
    pub(super) fn least_force(&self) -> f64 {
        1e-2 * self.problem.external.norm() / self.problem.cables() as f64
    }

    /// The solution that the steps lead to from these unknowns.
    pub(super) fn descend(&self, Unknowns { mut changes, mut chord_forces }: Unknowns) -> Outcome {
        let Some(mut point) = self.point(&changes, &chord_forces) else { return Outcome::Lost };
        let mut damping = 1e-3;
        for iteration in 0..MAX_ITERATIONS {
            if point.residual.norm() <= ROUNDING * point.forces {
                return Outcome::Found(point, Unknowns { changes, chord_forces }, iteration);
            }
            let next = self.slopes(&changes, &chord_forces, &point);
            let next =
                next.and_then(|slopes| self.improved(&changes, &chord_forces, &point, &slopes, &mut damping));
            let Some(next) = next else {
                return self.ended(point, Unknowns { changes, chord_forces }, iteration);
            };
            (changes, chord_forces, point) = next;
            damping *= 0.1;
        }
        self.ended(point, Unknowns { changes, chord_forces }, MAX_ITERATIONS)
    }

    fn ended(&self, point: Point, unknowns: Unknowns, iterations: usize) -> Outcome {
        if point.residual.norm() <= SOLVED * point.forces {
            Outcome::Found(point, unknowns, iterations)
        } else {
            Outcome::Stuck(point)
        }
    }

    /// The point after a step that makes |F| less, with the damping that it takes.
    fn improved(
        &self,
        changes: &[f64],
        chord_forces: &[f64],
        point: &Point,
        slopes: &DMatrix<f64>,
        damping: &mut f64,
    ) -> Option<(Vec<f64>, Vec<f64>, Point)> {
        let norm = point.residual.norm();
        let normal = slopes.transpose() * slopes;
        let right = -(slopes.transpose() * point.residual);
        let greatest = normal.diagonal().max();
        while *damping < 1e6 {
            let shift = greatest * if norm <= 1e-6 * point.forces { 1e-3 * *damping } else { *damping };
            let step = if norm <= 1e-3 * point.forces && *damping < 1e-6 {
                // Near the solution, whose equations are not squared.
                newton_step(slopes, &point.residual)
            } else {
                let mut matrix = normal.clone();
                (0..matrix.nrows()).for_each(|k| matrix[(k, k)] += shift);
                matrix.cholesky().map(|factor| factor.solve(&right))
            };
            let moved = step.and_then(|step| self.moved(changes, chord_forces, &step));
            if let Some(moved) = moved
                && moved.2.residual.norm() < norm
            {
                return Some(moved);
            }
            if norm <= SOLVED * point.forces {
                return None;
            }
            *damping = (10.0 * *damping).max(1e-9);
        }
        None
    }

    /// The point after a step in (ln σ, q), shortened where it leads far.
    pub(super) fn moved(
        &self,
        changes: &[f64],
        chord_forces: &[f64],
        step: &DVector<f64>,
    ) -> Option<(Vec<f64>, Vec<f64>, Point)> {
        let (n, k) = (chord_forces.len(), changes.len());
        let largest = step.rows(0, n).amax().max(step.rows(n, k).amax() / GREATEST_STEP);
        let share = if largest > 1.0 { 1.0 / largest } else { 1.0 };
        let forces: Vec<f64> =
            chord_forces.iter().enumerate().map(|(i, force)| force * (share * step[i]).exp()).collect();
        let changes: Vec<f64> =
            changes.iter().enumerate().map(|(j, change)| change + share * step[n + j]).collect();
        let point = self.point(&changes, &forces)?;
        Some((changes, forces, point))
    }

    /// Changes of the free coordinates at start number `index`: none, then points that fill a box evenly
    /// (additive recurrence of the generalized golden ratio), `reach` from its middle [rad, longest spans].
    pub(super) fn start(&self, index: usize, reach: [f64; 2]) -> Vec<f64> {
        let dimension = self.free.len() as i32;
        let mut golden = 1.5_f64;
        for _ in 0..50 {
            golden = (1.0 + golden).powf(1.0 / f64::from(dimension + 1));
        }
        let share = |axis: usize| {
            if index == 0 {
                return 0.0;
            }
            2.0 * (0.5 + index as f64 * golden.powi(-(axis as i32) - 1)).fract() - 1.0
        };
        let reach = |coordinate: &Coordinate| reach[usize::from(!coordinate.is_angle())];
        self.free.iter().enumerate().map(|(axis, coordinate)| reach(coordinate) * share(axis)).collect()
    }

    /// What an attempt leaves of the balance.
    pub(super) fn left(&self, point: &Point) -> RestFault {
        let [force, moment] = [0, 3].map(|row| point.residual.fixed_rows::<3>(row).norm());
        RestFault::Residual { force, moment: moment * self.problem.characteristic_length }
    }

    /// What no attempt leaves of it: all of the load.
    pub(super) fn unbalanced(&self) -> RestFault {
        let [force, moment] = [0, 3].map(|row| self.problem.external.fixed_rows::<3>(row).norm());
        RestFault::Residual { force, moment: moment * self.problem.characteristic_length }
    }

    /// Distance of two poses in radians and longest spans.
    pub(super) fn distance(&self, one: &Pose, other: &Pose) -> f64 {
        let motion = one.motion_to(other);
        (motion.fixed_rows::<3>(0) / self.size).norm().hypot(motion.fixed_rows::<3>(3).norm())
    }
}

/// The cables with these chord forces [N]; `None` where one of them has no shape.
fn cables<'a>(problem: &InverseProblem<'a>, chord_forces: &[f64]) -> Option<Vec<CableAtPose<'a>>> {
    let cable = |(i, force): (usize, &f64)| CableAtPose::near(problem, i, *force, None).ok();
    chord_forces.iter().enumerate().map(cable).collect()
}

/// Newton's step in (ln σ, q), the least one where the slopes are singular.
pub(super) fn newton_step(slopes: &DMatrix<f64>, residual: &Vector6<f64>) -> Option<DVector<f64>> {
    // Unlimited, the iterations for singular values need not end.
    let svd = slopes.clone().try_svd(true, true, f64::EPSILON, SINGULAR_VALUES)?;
    svd.solve(&-residual, 1e-13 * svd.singular_values.max()).ok()
}
