//! The inverse model of a robot with fewer cables than free motions.
//!
//! n cables prescribe n of the m coordinates of a pose. The others are free: they are unknowns beside the
//! lengths, and the balance of the free motions is as many equations,
//!
//! ```text
//! F(σ, q) = sum w_i(σ_i, q) + w_ex(q) = 0,      n chord forces σ_i,      m - n free coordinates q      (I6)
//! ```
//!
//! In chord forces (`cdpr_cable::HeldCable`) the elasticity of the cables does not appear in the slopes, and
//! the equations are nearly those of straight strings. Steps of Levenberg and Marquardt in (ln σ, q) make |F|
//! least. Slopes with respect to q are central differences: their error changes the rate of convergence and
//! not the solution.
//!
//! (I6) may have several solutions, stable and unstable ones. They are looked for from the given coordinates
//! and from others that fill two boxes around them evenly. Each is an equilibrium for its lengths, and the
//! stiffness with these lengths held says whether it is stable.

mod nearby;

use super::feasible::straight;
use super::held::{Row, Strand};
use super::question::Question;
use super::{HeldPose, inverse};
use crate::direct::Stability;
use crate::error::StaticsError;
use crate::out_of_limits::out_of_limits;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual};
use cdpr_robot::{Coordinate, Plane, Pose, Robot, Rotation3, Vector3, Vector6};
use nalgebra::{DMatrix, DVector};
pub(crate) use nearby::FreeBranch;

/// Lengths with which the platform rests where some coordinates are those of a wanted pose.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeSolution {
    /// Unstrained length of every cable [m].
    pub lengths: Vec<f64>,
    /// Tension of every cable at the platform [N]; limits do not bound it.
    pub tensions: Vec<f64>,
    /// The pose with the cables' forces.
    pub equilibrium: Equilibrium,
    /// Whether the platform stays there with these lengths.
    pub stability: Stability,
    /// Residuals of all equations.
    pub residual: Residual,
    /// Iterations of the search that found it.
    pub iterations: usize,
}

/// The solutions that were found.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeSolutions {
    /// The nearest to the given pose of the stable ones within the limits of tension; if none was found, of
    /// the stable ones, then of the unstable ones.
    pub first: FreeSolution,
    /// The others, in the same order.
    pub others: Vec<FreeSolution>,
}

/// The unstrained lengths with which the platform rests under its weight and `load` at a pose whose
/// coordinates are those of `pose` except for the `free` ones.
///
/// The free coordinates start from `pose`. A robot with n cables for m free motions has m - n of them; with a
/// cable for every free motion there are no free coordinates, and the answer is that of [`inverse`].
///
/// ```
/// use cdpr_robot::{Coordinate, Pose, Robot};
/// use cdpr_statics::{Load, inverse_free};
///
/// let mut robot = Robot::from_json(include_str!("../../../../data/robots/cogiro.json"))?;
/// robot.cables = [1, 3, 5, 7].map(|i| robot.cables[i].clone()).to_vec();
/// let free = [Coordinate::Roll, Coordinate::Yaw];
/// let found = inverse_free(&robot, &Pose::at(1.0, 0.5, 2.0), &Load::none(), &free)?.first;
/// assert!(found.stability.is_stable() && found.residual.force < 1e-8);
/// assert_eq!(found.equilibrium.pose.position.z, 2.0);
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
///
/// # Errors
/// - [`StaticsError::FreeCoordinates`] where `free` has not m - n names.
/// - [`StaticsError::NoRest`] where no solution was found.
/// - [`StaticsError::Invalid`] for a coordinate that is named twice or held, and a pose or load that is not
///   finite.
pub fn inverse_free(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
    free: &[Coordinate],
) -> Result<FreeSolutions, StaticsError> {
    check_free(robot, free)?;
    if free.is_empty() {
        let found = inverse(robot, pose, load, None)?;
        let first = FreeSolution::new(robot, load, found.lengths, found.equilibrium, found.iterations)?;
        return Ok(FreeSolutions { first, others: Vec::new() });
    }
    Search::new(robot, pose, load, free)?.solutions()
}

/// As many coordinates are free as cables are missing, each of them once and none that is held.
fn check_free(robot: &Robot, free: &[Coordinate]) -> Result<(), StaticsError> {
    let (cables, freedoms) = (robot.cables.len(), robot.freedoms());
    if free.len() != freedoms.count().saturating_sub(cables) {
        return Err(StaticsError::FreeCoordinates { cables, freedoms: freedoms.count(), named: free.len() });
    }
    for (k, coordinate) in free.iter().enumerate() {
        let refused = |expected: &str| StaticsError::invalid("free".to_owned(), coordinate, expected);
        if free[..k].contains(coordinate) {
            return Err(refused("each coordinate once"));
        }
        if !freedoms.contains(coordinate.component()) {
            return Err(refused("a coordinate that is not held"));
        }
    }
    Ok(())
}

/// Starts of the search.
const STARTS: usize = 32;

/// How far starts are from the given angles [rad], and from its position relative to the longest span.
const REACH: [f64; 2] = [1.3, 0.4];

/// Every other start is within this share of the reach.
const NEAR: f64 = 0.2;

/// Iterations for the singular values of a matrix; a few for each of them are usual.
const SINGULAR_VALUES: usize = 1000;

const MAX_ITERATIONS: usize = 80;

/// A residual below this, relative to wrench and tensions, is rounding.
const ROUNDING: f64 = 1e-15;

/// A residual below this, relative to wrench and tensions, is a solution as far as rounding lets it be.
const SOLVED: f64 = 1e-11;

/// Solutions nearer than this, in radians and relative to the longest span, are the same.
const SAME: f64 = 1e-7;

/// A stable solution nearer to the given pose than this, in radians and relative to the longest span, is
/// taken for the nearest.
pub(crate) const BESIDE: f64 = 0.03;

/// Half of a difference of an angle [rad], or of a position relative to the longest span.
const DIFFERENCE: f64 = 1e-5;

/// Greatest change of an angle [rad] in one step, or of a position relative to the longest span.
const GREATEST_STEP: f64 = 0.3;

struct Search<'a> {
    question: Question<'a>,
    free: &'a [Coordinate],
    /// roll, pitch and yaw of the given pose [rad].
    angles: [f64; 3],
    /// The longest span [m].
    size: f64,
}

/// A pose of the search with the wrench of its cables.
struct Point {
    held: HeldPose,
    rows: Vec<Row>,
    /// F, moments divided by the arm [N].
    residual: Vector6<f64>,
    /// The forces that the residual is compared with [N].
    forces: f64,
}

impl<'a> Search<'a> {
    fn new(
        robot: &'a Robot,
        pose: &'a Pose,
        load: &'a Load,
        free: &'a [Coordinate],
    ) -> Result<Self, StaticsError> {
        let question = Question::new(robot, pose, load, None)?;
        let (roll, pitch, yaw) = pose.rotation.euler_angles();
        let size = (0..robot.cables.len()).map(|i| robot.span(pose, i).norm()).fold(0.0, f64::max);
        Ok(Self { question, free, angles: [roll, pitch, yaw], size })
    }

    /// The pose whose free coordinates differ by `changes`, in their units, from the given ones.
    fn pose(&self, changes: &[f64]) -> Pose {
        let mut pose = *self.question.pose;
        let mut angles = self.angles;
        for (coordinate, change) in self.free.iter().zip(changes) {
            match coordinate {
                Coordinate::X | Coordinate::Y | Coordinate::Z => {
                    pose.position[coordinate.component()] += change * self.size;
                }
                _ => angles[coordinate.component() - 3] += change,
            }
        }
        if angles == self.angles {
            return pose;
        }
        let [roll, pitch, yaw] = angles;
        pose.rotation = match self.question.robot.plane.map(Plane::normal) {
            None => Rotation3::from_euler_angles(roll, pitch, yaw),
            // The one rotation of a planar robot is about an axis of the base frame.
            Some(axis) => {
                Rotation3::new(Vector3::ith(axis, angles[axis] - self.angles[axis])) * pose.rotation
            }
        };
        pose
    }

    fn question_at<'b>(&'b self, pose: &'b Pose) -> Question<'b> {
        self.question.nearby(pose, self.question.load, self.question.reference.clone())
    }

    /// The cables at a pose with given chord forces [N]; `None` where one of them has no shape.
    fn point(&self, changes: &[f64], chord_forces: &[f64]) -> Option<Point> {
        let pose = self.pose(changes);
        let arm = self.question.arm;
        let question = self.question_at(&pose);
        let strand = |(i, force): (usize, &f64)| Strand::near(&question, i, *force, None).ok();
        let strands: Vec<Strand> = chord_forces.iter().enumerate().map(strand).collect::<Option<_>>()?;
        let rows: Vec<Row> = strands.iter().map(|strand| strand.row(&strand.held, arm)).collect();
        let mut external = self.question.load.total(self.question.robot, &pose).to_vector();
        external.fixed_rows_mut::<3>(3).unscale_mut(arm);
        let external = self.question.robot.freedoms().of_vector(&external);
        let residual = rows.iter().fold(external, |sum, row| sum + row.wrench);
        let forces = external.norm() + rows.iter().map(|row| row.wrench.norm()).sum::<f64>();
        let catenaries: Vec<_> = strands.iter().map(|strand| strand.held.catenary()).collect();
        let held = HeldPose::new(&pose, &catenaries);
        residual.iter().all(|entry| entry.is_finite()).then_some(Point { held, rows, residual, forces })
    }

    /// dF/d(ln σ, q), with q in units; `None` where it is not finite, as for a force near zero.
    fn slopes(&self, changes: &[f64], chord_forces: &[f64], point: &Point) -> Option<DMatrix<f64>> {
        let mut slopes = DMatrix::zeros(6, chord_forces.len() + changes.len());
        for (i, (row, force)) in point.rows.iter().zip(chord_forces).enumerate() {
            slopes.set_column(i, &(row.slope * *force));
        }
        let mut moved = changes.to_vec();
        for k in 0..changes.len() {
            let mut at = |change: f64| {
                moved[k] = changes[k] + change;
                let residual = self.point(&moved, chord_forces).map(|point| point.residual);
                moved[k] = changes[k];
                residual
            };
            let slope = (at(DIFFERENCE)? - at(-DIFFERENCE)?) / (2.0 * DIFFERENCE);
            slopes.set_column(chord_forces.len() + k, &slope);
        }
        slopes.iter().all(|slope| slope.is_finite()).then_some(slopes)
    }

    /// The solution that the steps lead to from these changes of the free coordinates.
    fn descend(&self, mut changes: Vec<f64>) -> Outcome {
        let start = self.pose(&changes);
        let question = self.question_at(&start);
        let least = 1e-2 * self.question.external.norm() / self.question.cables() as f64;
        let mut chord_forces: Vec<f64> = straight(&question).0.into_iter().map(|t| t.max(least)).collect();
        let Some(mut point) = self.point(&changes, &chord_forces) else { return Outcome::Lost };
        let mut damping = 1e-3;
        for iteration in 0..MAX_ITERATIONS {
            let norm = point.residual.norm();
            if norm <= ROUNDING * point.forces {
                return Outcome::Found(point, iteration);
            }
            let Some(slopes) = self.slopes(&changes, &chord_forces, &point) else {
                return Outcome::Stuck(point);
            };
            let normal = slopes.transpose() * &slopes;
            let right = -(slopes.transpose() * point.residual);
            let greatest = normal.diagonal().max();
            let mut next = None;
            while damping < 1e6 {
                let shift = greatest * if norm <= 1e-6 * point.forces { 1e-3 * damping } else { damping };
                let mut matrix = normal.clone();
                (0..matrix.nrows()).for_each(|k| matrix[(k, k)] += shift);
                let step = if norm <= 1e-3 * point.forces && damping < 1e-6 {
                    // Near the solution Newton's step, whose equations are not squared.
                    // Unlimited, the iterations for singular values need not end.
                    let svd = slopes.clone().try_svd(true, true, f64::EPSILON, SINGULAR_VALUES);
                    svd.and_then(|svd| svd.solve(&-point.residual, 1e-13 * greatest.sqrt()).ok())
                } else {
                    matrix.cholesky().map(|factor| factor.solve(&right))
                };
                let moved = step.and_then(|step| self.moved(&changes, &chord_forces, &step));
                if let Some(moved) = moved
                    && moved.2.residual.norm() < norm
                {
                    next = Some(moved);
                    break;
                }
                if norm <= SOLVED * point.forces {
                    break;
                }
                damping = (10.0 * damping).max(1e-9);
            }
            let Some(next) = next else {
                return if norm <= SOLVED * point.forces {
                    Outcome::Found(point, iteration)
                } else {
                    Outcome::Stuck(point)
                };
            };
            (changes, chord_forces, point) = next;
            damping *= 0.1;
        }
        if point.residual.norm() <= SOLVED * point.forces {
            return Outcome::Found(point, MAX_ITERATIONS);
        }
        Outcome::Stuck(point)
    }

    /// The point after a step in (ln σ, q), shortened where it leads far.
    fn moved(
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

    /// The solution that the search leads to from the given coordinates, if it is stable, within the limits
    /// of tension and so close that no other needs to be looked for.
    fn beside(&self) -> Result<Option<FreeSolution>, StaticsError> {
        let Outcome::Found(point, iterations) = self.descend(self.start(0)) else { return Ok(None) };
        self.accepted(point, iterations)
    }

    /// A solution, if it is stable, within the limits of tension and so close to the given coordinates that
    /// no other needs to be looked for.
    fn accepted(&self, point: Point, iterations: usize) -> Result<Option<FreeSolution>, StaticsError> {
        let Question { robot, pose, load, .. } = self.question;
        let HeldPose { lengths, equilibrium } = point.held;
        if self.distance(pose, &equilibrium.pose) > BESIDE {
            return Ok(None);
        }
        let found = FreeSolution::new(robot, load, lengths, equilibrium, iterations)?;
        let within = out_of_limits(robot, &found.lengths, &[&found.equilibrium]).is_empty();
        Ok(Some(found).filter(|found| found.stability.is_stable() && within))
    }

    fn solutions(&self) -> Result<FreeSolutions, StaticsError> {
        let Question { robot, pose, load, .. } = self.question;
        let mut found: Vec<FreeSolution> = Vec::new();
        let mut nearest: Option<Point> = None;
        for start in 0..STARTS {
            let (point, iterations) = match self.descend(self.start(start)) {
                Outcome::Found(point, iterations) => (point, iterations),
                Outcome::Stuck(point) => {
                    let share = |point: &Point| point.residual.norm() / point.forces;
                    if nearest.as_ref().is_none_or(|nearest| share(&point) < share(nearest)) {
                        nearest = Some(point);
                    }
                    continue;
                }
                Outcome::Lost => continue,
            };
            let known = |found: &FreeSolution| {
                self.distance(&found.equilibrium.pose, &point.held.equilibrium.pose) <= SAME
            };
            if found.iter().any(known) {
                continue;
            }
            let HeldPose { lengths, equilibrium } = point.held;
            let new = FreeSolution::new(robot, load, lengths, equilibrium, iterations)?;
            // Along its neutral motions a solution is the same.
            let same = |found: &FreeSolution| {
                let same = |(one, other): (&f64, &f64)| (one - other).abs() <= SAME * self.size;
                !found.stability.neutral().is_empty() && found.lengths.iter().zip(&new.lengths).all(same)
            };
            if !found.iter().any(same) {
                found.push(new);
            }
        }
        found.sort_by(|one, other| {
            let rank = |found: &FreeSolution| {
                let FreeSolution { stability, lengths, equilibrium, .. } = found;
                (!stability.is_stable(), !out_of_limits(robot, lengths, &[equilibrium]).is_empty())
            };
            let away = |found: &FreeSolution| self.distance(pose, &found.equilibrium.pose);
            rank(one).cmp(&rank(other)).then(away(one).total_cmp(&away(other)))
        });
        if found.is_empty() {
            let best = nearest.map_or_else(|| self.question.external, |point| point.residual);
            return Err(StaticsError::NoRest {
                starts: STARTS,
                force: best.fixed_rows::<3>(0).norm(),
                moment: best.fixed_rows::<3>(3).norm() * self.question.arm,
            });
        }
        let first = found.remove(0);
        Ok(FreeSolutions { first, others: found })
    }

    /// Changes of the free coordinates at start number `index`: none, then points that fill two boxes evenly
    /// (additive recurrence of the generalised golden ratio).
    fn start(&self, index: usize) -> Vec<f64> {
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
        let near = if index.is_multiple_of(2) { NEAR } else { 1.0 };
        let reach = |coordinate: &Coordinate| near * REACH[usize::from(!coordinate.is_angle())];
        self.free.iter().enumerate().map(|(axis, coordinate)| reach(coordinate) * share(axis)).collect()
    }

    /// Distance of two poses in radians and longest spans.
    fn distance(&self, one: &Pose, other: &Pose) -> f64 {
        let motion = one.motion_to(other);
        (motion.fixed_rows::<3>(0) / self.size).norm().hypot(motion.fixed_rows::<3>(3).norm())
    }
}

/// How a search ends.
enum Outcome {
    Found(Point, usize),
    /// Where |F| is least.
    Stuck(Point),
    /// Where a cable has no shape.
    Lost,
}

impl FreeSolution {
    fn new(
        robot: &Robot,
        load: &Load,
        lengths: Vec<f64>,
        equilibrium: Equilibrium,
        iterations: usize,
    ) -> Result<Self, StaticsError> {
        let problem = DirectProblem::new(robot, &lengths, load)?;
        let hessian = problem.linearize(&equilibrium)?.symmetric_stiffness();
        Ok(Self {
            tensions: equilibrium.tensions(),
            stability: Stability::new(&problem, &equilibrium, &hessian),
            residual: Residual::of(&problem, &equilibrium),
            lengths,
            equilibrium,
            iterations,
        })
    }
}

/// Unstrained lengths that hold the platform at a pose whose `free` coordinates are found: those of
/// [`inverse_free`], or of [`inverse`] where there is a cable for every free motion. A stable solution close
/// to the given pose is taken without a search for others.
///
/// # Errors
/// Those of [`inverse_free`].
pub fn held_at(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
    free: &[Coordinate],
) -> Result<HeldPose, StaticsError> {
    if free.is_empty() {
        let found = inverse(robot, pose, load, None)?;
        return Ok(HeldPose { lengths: found.lengths, equilibrium: found.equilibrium });
    }
    check_free(robot, free)?;
    let search = Search::new(robot, pose, load, free)?;
    let FreeSolution { lengths, equilibrium, .. } = match search.beside()? {
        Some(found) => found,
        None => search.solutions()?.first,
    };
    Ok(HeldPose { lengths, equilibrium })
}
