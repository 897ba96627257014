//! From the wanted pose to set-points and lengths, with the derivatives on both sides of every input.
//!
//! A set-point is the greatest of `t_i + dt_i` and the lower bound of the cable. Where both are the same its
//! right derivative is the greater one of theirs, its left derivative the smaller one.

use super::optimum::{AtBound, Optimum, ROUNDING, Sides};
use crate::equations::{CableDerivatives, Inputs, Partials, Reading, Span, read, tensions};
use crate::error::StaticsError;
use crate::inverse::{ABOVE_LEAST, InverseSolution, least_allowed};
use crate::loading::Wound;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load};
use cdpr_cable::least_tension;
use cdpr_robot::{ParameterLayout, Pose, Robot, Vector3};
use cdpr_tension::Bound;
use nalgebra::{DMatrix, Matrix6xX};

/// An input whose left and right derivatives differ.
#[derive(Clone, Debug, PartialEq)]
pub struct OneSided {
    /// Column of the input.
    pub column: usize,
    /// The cables that leave a bound on one side of it.
    pub cables: Vec<AtBound>,
}

/// Derivatives of the set-points.
pub(super) struct SetPoints {
    /// Left derivatives, n x count, followed by a column for each of `one_sided`: by how much the right
    /// derivatives exceed the left ones.
    pub(super) rows: DMatrix<f64>,
    pub(super) one_sided: Vec<OneSided>,
}

/// What a set-point is.
#[derive(Clone, Copy, PartialEq)]
enum SetPoint {
    /// The tension of the inverse model with its offset.
    Offset,
    /// The cable's lower bound.
    Bound,
    /// Both, to rounding.
    Either,
}

/// From the wanted pose to the lengths.
pub(super) struct Winding<'a> {
    pub(super) robot: &'a Robot,
    pub(super) pose: &'a Pose,
    pub(super) inputs: Inputs,
    pub(super) wound: &'a Wound,
}

/// A multiplier below this share of the greatest tension may be rounding: the inverse model leaves 1e-11 of all
/// forces open, and with several cables on their bounds multipliers are known a thousand times less.
const NO_MULTIPLIER: f64 = 1e-7;

/// Whether two tensions [N] differ by rounding only.
fn same(one: f64, other: f64) -> bool {
    (one - other).abs() <= ROUNDING * one.max(other)
}

impl Winding<'_> {
    fn end(&self, i: usize) -> Span<f64> {
        Span::new(self.robot.span(self.pose, i).into())
    }

    fn cables(
        &self,
        lengths: &[f64],
        equilibrium: &Equilibrium,
    ) -> Result<Vec<CableDerivatives>, StaticsError> {
        let problem = DirectProblem::new(self.robot, lengths, &Load::none())?;
        Ok(CableDerivatives::all(&problem, self.pose, &equilibrium.cable_forces))
    }

    /// Lower bounds of all tensions [N]: the robot's, or what the weight of the cable demands.
    fn lower_bounds(&self) -> Result<Vec<f64>, StaticsError> {
        let of = |i| {
            let least = self.robot.tension_limits.min;
            least_allowed(&self.robot.cable(i), self.end(i).end.into(), least).map_err(StaticsError::cable(i))
        };
        (0..self.robot.cables.len()).map(of).collect()
    }

    /// Derivatives of the tensions of the inverse model; `bounds` has those of the lower bounds, and
    /// `lower_bounds` their values [N].
    fn tensions(
        &self,
        lower_bounds: &[f64],
        bounds: DMatrix<f64>,
    ) -> Result<(Sides, Vec<AtBound>), StaticsError> {
        let InverseSolution { lengths, active, equilibrium, multipliers, tensions, .. } = &self.wound.wanted;
        let problem = DirectProblem::new(self.robot, lengths, &Load::none())?;
        let forces = equilibrium.cable_forces.iter().enumerate();
        let rates: Vec<_> = forces
            .map(|(i, force)| {
                let catenary = problem.catenary(i, *force);
                CableDerivatives::of_tension_slope(self.robot, self.pose, i, catenary)
            })
            .collect();
        let cables = CableDerivatives::all(&problem, self.pose, &equilibrium.cable_forces);
        let cables: Vec<_> = cables.iter().map(CableDerivatives::at_tension).collect();
        let [translation, rotation]: [Vector3<f64>; 2] =
            [0, 3].map(|row| multipliers.fixed_view::<3, 1>(row, 0).into());
        let motion = |cable: &CableDerivatives| translation + rotation.cross(&cable.arm);

        let Partials { mut balance, .. } =
            Partials::new(self.robot, &self.inputs, self.pose, &Load::none(), &cables, Reading::tension);
        balance.column_mut(self.inputs.payload()).fill(0.0);
        let slopes = read(&self.inputs, self.pose, &rates, |rate| Reading {
            per_force: motion(rate),
            per_arm: rate.force.cross(&rotation),
        });
        let per_tension: Vec<_> = cables.iter().map(CableDerivatives::wrench_per_actuation).collect();
        let optimum = Optimum {
            balance,
            slopes,
            per_tension: Matrix6xX::from_columns(&per_tension),
            curvatures: rates.iter().map(|rate| 1.0 + motion(rate).dot(&rate.per_actuation)).collect(),
            bounds,
        };
        let largest = tensions.iter().copied().fold(0.0, f64::max);
        let undecided = (0..tensions.len()).filter_map(|cable| {
            let t = tensions[cable];
            let at = |bound| Some(AtBound { cable, bound });
            match active[cable] {
                // ρ_i of (D5): the reference is zero.
                Some(bound) => {
                    let slope = t + motion(&rates[cable]).dot(&rates[cable].force);
                    if slope.abs() <= NO_MULTIPLIER * largest { at(bound) } else { None }
                }
                None if same(t, lower_bounds[cable]) => at(Bound::Min),
                None if same(t, self.robot.tension_limits.max) => at(Bound::Max),
                None => None,
            }
        });
        let undecided: Vec<_> = undecided.collect();
        let on_bound: Vec<bool> = active.iter().map(Option::is_some).collect();
        Ok((optimum.sides(&on_bound, &undecided)?, undecided))
    }

    /// Derivatives of the set-points.
    pub(super) fn set_points(&self, tension_offsets: &[f64]) -> Result<SetPoints, StaticsError> {
        let Wound { wanted, .. } = self.wound;
        let n = tension_offsets.len();
        let lower_bounds = self.lower_bounds()?;
        let set_point = |i: usize| {
            let offset = wanted.tensions[i] + tension_offsets[i];
            match offset > lower_bounds[i] {
                _ if same(offset, lower_bounds[i]) => SetPoint::Either,
                true => SetPoint::Offset,
                false => SetPoint::Bound,
            }
        };
        let set_points: Vec<SetPoint> = (0..n).map(set_point).collect();
        // A bound that the weight of a cable demands changes with the inputs.
        let changes = |i: &usize| {
            let demanded = lower_bounds[*i] > self.robot.tension_limits.min;
            let meets = set_points[*i] != SetPoint::Offset || same(wanted.tensions[*i], lower_bounds[*i]);
            demanded && meets
        };
        let which: Vec<usize> = (0..n).filter(changes).collect();
        let bounds = self.least_tensions(&which)?;
        let (tensions, undecided) = self.tensions(&lower_bounds, bounds.clone())?;

        let layout = ParameterLayout::new(n);
        let side = |mut rows: DMatrix<f64>, choose: fn(f64, f64) -> f64| {
            for (i, set_point) in set_points.iter().enumerate() {
                rows[(i, layout.tension_offset(i))] += 1.0;
                match set_point {
                    SetPoint::Offset => {}
                    SetPoint::Bound => rows.set_row(i, &bounds.row(i)),
                    SetPoint::Either => {
                        rows.row_mut(i).zip_apply(&bounds.row(i), |slope, bound| {
                            *slope = choose(*slope, bound);
                        });
                    }
                }
            }
            rows
        };
        let either = (0..n).filter(|i| set_points[*i] == SetPoint::Either);
        let mut doubtful: Vec<_> = either.map(|cable| AtBound { cable, bound: Bound::Min }).collect();
        if doubtful.is_empty() && undecided.is_empty() {
            return Ok(SetPoints { rows: side(tensions.left, f64::min), one_sided: Vec::new() });
        }
        let right = side(tensions.right.unwrap_or_else(|| tensions.left.clone()), f64::max);
        let mut rows = side(tensions.left, f64::min);
        doubtful.extend(undecided.iter().filter(|at| set_points[at.cable] != SetPoint::Either));
        let count = self.inputs.count();
        let mut one_sided = Vec::new();
        for column in 0..count {
            let size = rows.column(column).amax().max(right.column(column).amax());
            let differs = |at: &&AtBound| {
                let change = right[(at.cable, column)] - rows[(at.cable, column)];
                change.abs() > ROUNDING * size
            };
            let cables: Vec<AtBound> = doubtful.iter().filter(differs).copied().collect();
            if !cables.is_empty() {
                one_sided.push(OneSided { column, cables });
            }
        }
        rows.resize_horizontally_mut(count + one_sided.len(), 0.0);
        for (k, OneSided { column, .. }) in one_sided.iter().enumerate() {
            let more = right.column(*column) - rows.column(*column);
            rows.set_column(count + k, &more);
        }
        Ok(SetPoints { rows, one_sided })
    }

    /// Derivatives of the tensions that the weights of the cables in `which` demand; zero rows for all
    /// others.
    fn least_tensions(&self, which: &[usize]) -> Result<DMatrix<f64>, StaticsError> {
        let mut rows = self.inputs.zeros(self.wound.set_points.len());
        if which.is_empty() {
            return Ok(rows);
        }
        let mut cables = self.cables(&self.wound.lengths, &self.wound.held)?;
        for &i in which {
            let catenary = least_tension(&self.robot.cable(i), self.end(i).end.into())
                .map_err(StaticsError::cable(i))?;
            cables[i] = CableDerivatives::new(self.robot, self.pose, i, &catenary);
        }
        let least = tensions(&self.inputs, self.pose, &cables);
        which.iter().for_each(|i| rows.set_row(*i, &(ABOVE_LEAST * least.row(*i))));
        Ok(rows)
    }

    /// Derivatives of the lengths, equation (D7), a column for each of `set_points`.
    pub(super) fn lengths(&self, set_points: &DMatrix<f64>) -> Result<DMatrix<f64>, StaticsError> {
        let cables = self.cables(&self.wound.lengths, &self.wound.held)?;
        let mut rows = tensions(&self.inputs, self.pose, &cables);
        rows.resize_horizontally_mut(set_points.ncols(), 0.0);
        for (i, cable) in cables.iter().enumerate() {
            let per_length = cable.direction.dot(&cable.per_actuation);
            for (slope, set_point) in rows.row_mut(i).iter_mut().zip(set_points.row(i).iter()) {
                *slope = (set_point - *slope) / per_length;
            }
        }
        Ok(rows)
    }
}
