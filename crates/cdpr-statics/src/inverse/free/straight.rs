//! Where straight cables without weight hold a platform with free coordinates.
//!
//! With u_i the unit pulls along the chords, (I6) becomes
//!
//! ```text
//! sum [u_i; s_i x u_i] t_i + w_ex = 0            n tensions t_i of either sign, m - n coordinates q     (I9)
//! ```
//!
//! Its slopes are (I8) with `∂(u_i t_i)/∂r_i = t_i (u_i u_iᵀ - 1)/c_i` over a chord c_i. Steps of Levenberg
//! and Marquardt in (t, q) start from many places. A root with a negative tension is one with a cable that
//! would have to push: it is kept to say so.

use super::search::{SAME, Search, Unknowns};
use crate::inverse::cable::Pull;
use crate::inverse::problem::InverseProblem;
use cdpr_robot::{Matrix3, Vector6};
use nalgebra::Matrix6;

/// A pose that straight cables hold.
pub(super) struct StraightRoot {
    /// Changes of the free coordinates from the given ones.
    pub(super) changes: Vec<f64>,
    /// Tensions; one that is negative pushes [N].
    pub(super) tensions: Vec<f64>,
    /// Distance of the pose from the given one, in radians and longest spans.
    pub(super) distance: f64,
    /// Whether a motion of the free coordinates changes nothing.
    is_neutral: bool,
}

/// Starts of the search, a third of them in each box of [`REACHES`].
pub(super) const STRAIGHT_STARTS: usize = 150;

/// How far starts are from the given angles [rad], and from its position relative to the longest span: near,
/// as far as platforms usually tilt, and all around.
const REACHES: [[f64; 2]; 3] = [[0.26, 0.08], [1.3, 0.4], [std::f64::consts::PI, 1.0]];

const MAX_ITERATIONS: usize = 60;

/// A residual below this, relative to wrench and tensions, is a root.
const BALANCED: f64 = 1e-11;

/// Greatest change of an angle [rad] in one step, or of a position relative to the longest span.
const GREATEST_STEP: f64 = 0.5;

/// A motion with a singular value below this, relative to the largest, is neutral.
const NEUTRAL: f64 = 1e-8;

/// Residual and slopes of (I9), forces relative to the external wrench.
struct Equations {
    residual: Vector6<f64>,
    /// Columns of tensions, then of free coordinates; the rest is zero.
    slopes: Matrix6<f64>,
    /// The wrenches of the cables and of the load, added up.
    size: f64,
}

impl Search<'_> {
    /// Different roots of straight cables, the nearest to the given pose first.
    pub(super) fn straight_roots(&self) -> Vec<StraightRoot> {
        let mut roots: Vec<StraightRoot> = Vec::new();
        for start in 0..STRAIGHT_STARTS {
            let Some(root) = self.straight_root(self.start(start, REACHES[start % 3])) else { continue };
            if !roots.iter().any(|known| self.are_same(known, &root)) {
                roots.push(root);
            }
        }
        roots.sort_by(|one, other| one.distance.total_cmp(&other.distance));
        roots
    }

    fn are_same(&self, one: &StraightRoot, other: &StraightRoot) -> bool {
        let near = |a: f64, b: f64, size: f64| (a - b).abs() <= SAME * size;
        let force = self.problem.external.norm();
        let [at, to] = [one, other].map(|root| self.pose(&root.changes));
        // Along its neutral motions a root is the same.
        let neutral = || {
            let chord = |pose, i| self.problem.robot.span(pose, i).norm();
            let cables = 0..self.problem.cables();
            one.is_neutral
                && one.tensions.iter().zip(&other.tensions).all(|(a, b)| near(*a, *b, force))
                && cables.into_iter().all(|i| near(chord(&at, i), chord(&to, i), self.size))
        };
        self.distance(&at, &to) <= 10.0 * SAME || neutral()
    }

    /// The root that steps lead to from these changes of the free coordinates.
    pub(super) fn straight_root(&self, mut changes: Vec<f64>) -> Option<StraightRoot> {
        let cables = self.problem.cables();
        let mut tensions = self.least_squares(&changes);
        let mut at = self.straight_equations(&changes, &tensions);
        let mut damping = 1e-3;
        for _ in 0..MAX_ITERATIONS {
            let norm = at.residual.norm();
            if norm <= BALANCED * at.size {
                break;
            }
            let normal = at.slopes.transpose() * at.slopes;
            let right = -(at.slopes.transpose() * at.residual);
            let greatest = normal.diagonal().max();
            let mut is_less = false;
            while damping < 1e8 && !is_less {
                let shift = Matrix6::from_diagonal_element((damping * greatest).max(1e-14 * greatest));
                let step = (normal + shift).cholesky()?.solve(&right);
                let largest = step.rows(cables, self.free.len()).amax() / GREATEST_STEP;
                let step = step / largest.max(1.0);
                let moved: Vec<f64> =
                    changes.iter().zip(&step.as_slice()[cables..]).map(|(a, b)| a + b).collect();
                let force = self.problem.external.norm();
                let pulls: Vec<f64> =
                    tensions.iter().zip(step.as_slice()).map(|(t, change)| t + force * change).collect();
                let next = self.straight_equations(&moved, &pulls);
                if next.residual.norm() < norm {
                    (changes, tensions, at, is_less) = (moved, pulls, next, true);
                } else {
                    damping = (10.0 * damping).max(1e-12);
                }
            }
            damping *= if damping > 1e-6 { 0.1 } else { 1e-3 };
            if !is_less {
                break;
            }
        }
        self.accepted_root(changes, tensions, &at)
    }

    fn accepted_root(&self, changes: Vec<f64>, tensions: Vec<f64>, at: &Equations) -> Option<StraightRoot> {
        let is_root = at.residual.norm() <= 1e3 * BALANCED * at.size;
        if !is_root {
            return None;
        }
        let unknowns = self.problem.cables() + self.free.len();
        let values = at.slopes.singular_values();
        let is_neutral = values[unknowns - 1] <= NEUTRAL * values[0];
        let distance = self.distance(self.problem.pose, &self.pose(&changes));
        Some(StraightRoot { changes, tensions, distance, is_neutral })
    }

    /// Tensions of straight cables that hold the pose best, of either sign [N].
    fn least_squares(&self, changes: &[f64]) -> Vec<f64> {
        let cables = self.problem.cables();
        let at = self.straight_equations(changes, &vec![0.0; cables]);
        let mut columns = at.slopes;
        (cables..6).for_each(|k| columns.column_mut(k).fill(0.0));
        let normal = columns.transpose() * columns + Matrix6::from_diagonal_element(1e-9);
        let force = self.problem.external.norm();
        let found = normal.cholesky().map(|factor| factor.solve(&-(columns.transpose() * at.residual)));
        (0..cables).map(|i| found.map_or(0.0, |found| force * found[i])).collect()
    }

    fn straight_equations(&self, changes: &[f64], tensions: &[f64]) -> Equations {
        let InverseProblem { robot, load, .. } = self.problem;
        let (pose, unit) = (self.pose(changes), self.problem.external.norm());
        let external = load.total(robot, &pose);
        let external = self.scaled(external.force, external.moment) / unit;
        let (mut residual, mut size, mut slopes) = (external, external.norm(), Matrix6::zeros());
        let mut pulls = Vec::with_capacity(tensions.len());
        for (i, tension) in tensions.iter().enumerate() {
            let (lever_arm, span) = (robot.anchor_arm(&pose, i), robot.span(&pose, i));
            let (chord, pull) = (span.norm(), -span.normalize());
            let column = self.scaled(pull, lever_arm.cross(&pull));
            slopes.set_column(i, &column);
            residual += column * (tension / unit);
            size += (column * (tension / unit)).norm();
            let per_motion = (pull * pull.transpose() - Matrix3::identity()) * (tension / chord);
            pulls.push(Pull { lever_arm, force: pull * *tension, per_motion });
        }
        for (k, slope) in self.per_coordinate(&pose, changes, &pulls).enumerate() {
            slopes.set_column(tensions.len() + k, &(slope / unit));
        }
        Equations { residual, slopes, size }
    }
}

impl StraightRoot {
    /// Where a search among sagging cables starts, with no chord force below `least` [N].
    pub(super) fn unknowns(&self, least: f64) -> Unknowns {
        let chord_forces = self.tensions.iter().map(|tension| tension.max(least)).collect();
        Unknowns { changes: self.changes.clone(), chord_forces }
    }

    /// The cable that pulls least, and its tension [N].
    pub(super) fn slackest(&self) -> (usize, f64) {
        let each = self.tensions.iter().copied().enumerate();
        each.min_by(|one, other| one.1.total_cmp(&other.1)).unwrap_or((0, 0.0))
    }
}
