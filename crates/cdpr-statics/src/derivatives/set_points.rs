//! From the wanted pose to set-points and lengths, with the derivatives on both sides of every input.
//!
//! A set-point is `t_i + dt_i` between the lower and the upper bound of the cable. Where it reaches the lower
//! one its right derivative is the greater one of theirs, its left derivative the smaller one; at the upper
//! bound it is the other way round.

use super::optimum::{AtBound, Optimum, ROUNDING, Sides};
use super::rest::{cables_with, lengths_of};
use crate::equations::{ABOVE_LEAST, CableDerivatives, Ends, Inputs, Partials, Reading, read, tensions};
use crate::error::StaticsError;
use crate::inverse::InverseSolution;
use crate::loading::SetPointLengths;
use crate::problem::DirectProblem;
use crate::state::Load;
use cdpr_robot::{CableEnd, ParameterLayout, Pose, Robot, TensionLimits, Vector3};
use cdpr_tension::Bound;
use nalgebra::{DMatrix, Matrix6xX, RowDVector};

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

impl SetPoints {
    /// The left derivatives, and by how much the right ones exceed them where a cable of `doubtful` leaves a
    /// bound on one side.
    fn of_sides(left: DMatrix<f64>, right: &DMatrix<f64>, doubtful: &[AtBound]) -> Self {
        let (mut rows, count) = (left, right.ncols());
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
        Self { rows, one_sided }
    }
}

/// What a set-point is.
#[derive(Clone, Copy, PartialEq)]
enum SetPoint {
    /// The tension of the inverse model with its offset.
    Offset,
    /// A bound of the cable.
    Bound(Bound),
    /// Both, to rounding.
    Either(Bound),
}

/// The bounds of all tensions, and how they change.
struct Bounds {
    /// Lower and upper bound of each cable [N].
    values: Vec<[f64; 2]>,
    /// Derivatives of the lower and of the upper bounds, n x count each.
    rows: [DMatrix<f64>; 2],
}

impl Bounds {
    fn value(&self, i: usize, bound: Bound) -> f64 {
        self.values[i][bound as usize]
    }

    fn row(&self, i: usize, bound: Bound) -> RowDVector<f64> {
        self.rows[bound as usize].row(i).into_owned()
    }
}

/// From the wanted pose to the lengths.
pub(super) struct AtSetPoints<'a> {
    pub(super) robot: &'a Robot,
    pub(super) pose: &'a Pose,
    /// Tensions that are preferred [N]; `None` for the robot's own.
    pub(super) reference: Option<&'a [f64]>,
    pub(super) inputs: Inputs,
    pub(super) cables: &'a SetPointLengths,
}

/// A multiplier below this share of the greatest tension may be rounding: the inverse model leaves 1e-11 of
/// all forces open, and with several cables on their bounds multipliers are known a thousand times less.
const NO_MULTIPLIER: f64 = 1e-7;

/// Whether two tensions [N] differ by rounding only.
fn same(one: f64, other: f64) -> bool {
    (one - other).abs() <= ROUNDING * one.max(other)
}

impl AtSetPoints<'_> {
    /// Bounds of all tensions [N]: the limits, or what the weight of the cable demands.
    fn bound_values(&self) -> Result<Vec<[f64; 2]>, StaticsError> {
        let of = |(i, limits): (usize, &TensionLimits)| {
            let ends = Ends::of(self.robot, self.pose, i);
            let least = ends.least_allowed(limits.min).map_err(StaticsError::cable(i))?;
            Ok([least, limits.max])
        };
        self.cables.limits.iter().enumerate().map(of).collect()
    }

    /// Derivatives of the tensions of the inverse model.
    fn tensions(&self, bounds: &Bounds) -> Result<(Sides, Vec<AtBound>), StaticsError> {
        let InverseSolution { lengths, active, equilibrium, multipliers, tensions, .. } = &self.cables.wanted;
        let problem = DirectProblem::new(self.robot, lengths, &Load::none())?;
        let forces = equilibrium.cable_forces.iter().enumerate();
        let rates: Vec<_> = forces
            .map(|(i, force)| {
                let catenary = problem.catenary(i, *force);
                CableDerivatives::of_tension_slope(self.robot, self.pose, i, &catenary)
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
        let freedoms = self.robot.freedoms();
        let per_tension: Vec<_> =
            cables.iter().map(|cable| freedoms.of_vector(&cable.wrench_per_actuation())).collect();
        if !freedoms.are_all() {
            balance.column_iter_mut().for_each(|mut column| {
                let free = freedoms.of_vector(&column.clone_owned());
                column.copy_from(&free);
            });
        }
        // The bound that each cable is on, or could come to be on.
        let bound = |i: usize| match active[i] {
            Some(bound) => Some(bound),
            None => [Bound::Min, Bound::Max].into_iter().find(|at| same(tensions[i], bounds.value(i, *at))),
        };
        let mut rows = self.inputs.zeros(tensions.len());
        for i in 0..tensions.len() {
            if let Some(bound) = bound(i) {
                rows.set_row(i, &bounds.row(i, bound));
            }
        }
        let optimum = Optimum {
            balance,
            slopes,
            per_tension: Matrix6xX::from_columns(&per_tension),
            curvatures: rates.iter().map(|rate| 1.0 + motion(rate).dot(&rate.per_actuation)).collect(),
            bounds: rows,
            freedoms,
        };
        let reference = self.reference.map_or_else(|| self.robot.reference(), <[f64]>::to_vec);
        let largest = tensions.iter().copied().fold(0.0, f64::max);
        let undecided = (0..tensions.len()).filter_map(|cable| {
            let bound = bound(cable)?;
            // ρ_i of (D5).
            let slope = tensions[cable] - reference[cable] + motion(&rates[cable]).dot(&rates[cable].force);
            let kept = active[cable].is_some() && slope.abs() > NO_MULTIPLIER * largest;
            (!kept).then_some(AtBound { cable, bound })
        });
        let undecided: Vec<_> = undecided.collect();
        let on_bound: Vec<bool> = active.iter().map(Option::is_some).collect();
        Ok((optimum.sides(&on_bound, &undecided)?, undecided))
    }

    /// Derivatives of the set-points.
    pub(super) fn set_points(&self, tension_offsets: &[f64]) -> Result<SetPoints, StaticsError> {
        let SetPointLengths { wanted, .. } = self.cables;
        let n = tension_offsets.len();
        let values = self.bound_values()?;
        let set_point = |i: usize| {
            let (offset, [least, greatest]) = (wanted.tensions[i] + tension_offsets[i], values[i]);
            match () {
                () if same(offset, least) => SetPoint::Either(Bound::Min),
                () if same(offset, greatest) => SetPoint::Either(Bound::Max),
                () if offset < least => SetPoint::Bound(Bound::Min),
                () if offset > greatest => SetPoint::Bound(Bound::Max),
                () => SetPoint::Offset,
            }
        };
        let set_points: Vec<SetPoint> = (0..n).map(set_point).collect();
        let meets = |i: usize, bound: Bound| {
            let by_offset = [SetPoint::Bound(bound), SetPoint::Either(bound)].contains(&set_points[i]);
            by_offset
                || wanted.active[i] == Some(bound)
                || same(wanted.tensions[i], values[i][bound as usize])
        };
        // A bound that the weight of a cable demands, or one at its exit point, changes with the inputs.
        let demanded = |i: &usize| values[*i][0] > self.cables.limits[*i].min && meets(*i, Bound::Min);
        let at_exit = |i: &usize| self.robot.max_at(*i) == CableEnd::Exit && meets(*i, Bound::Max);
        let [least, greatest]: [Vec<usize>; 2] =
            [(0..n).filter(demanded).collect(), (0..n).filter(at_exit).collect()];
        let rows = [self.least_tensions(&least)?, self.exit_limits(&greatest)?];
        let bounds = Bounds { values, rows };
        let (tensions, undecided) = self.tensions(&bounds)?;

        let layout = ParameterLayout::of(self.robot);
        let side = |mut rows: DMatrix<f64>, [at_least, at_greatest]: [fn(f64, f64) -> f64; 2]| {
            for (i, set_point) in set_points.iter().enumerate() {
                rows[(i, layout.tension_offset(i))] += 1.0;
                match set_point {
                    SetPoint::Offset => {}
                    SetPoint::Bound(bound) => rows.set_row(i, &bounds.row(i, *bound)),
                    SetPoint::Either(bound) => {
                        let choose = if *bound == Bound::Min { at_least } else { at_greatest };
                        rows.row_mut(i).zip_apply(&bounds.row(i, *bound), |slope, bound| {
                            *slope = choose(*slope, bound);
                        });
                    }
                }
            }
            rows
        };
        let mut doubtful: Vec<_> = (0..n)
            .filter_map(|cable| match set_points[cable] {
                SetPoint::Either(bound) => Some(AtBound { cable, bound }),
                _ => None,
            })
            .collect();
        let (left, right) =
            ([f64::min as fn(f64, f64) -> f64, f64::max], [f64::max as fn(f64, f64) -> f64, f64::min]);
        if doubtful.is_empty() && undecided.is_empty() {
            return Ok(SetPoints { rows: side(tensions.left, left), one_sided: Vec::new() });
        }
        let right = side(tensions.right.unwrap_or_else(|| tensions.left.clone()), right);
        let left = side(tensions.left, left);
        let decided = |at: &&AtBound| !matches!(set_points[at.cable], SetPoint::Either(_));
        doubtful.extend(undecided.iter().filter(decided));
        Ok(SetPoints::of_sides(left, &right, &doubtful))
    }

    /// Derivatives of the tensions that the weights of the cables in `which` demand; zero rows for all
    /// others.
    fn least_tensions(&self, which: &[usize]) -> Result<DMatrix<f64>, StaticsError> {
        let rows = self.rows_of(which, |i| {
            let ends = Ends::of(self.robot, self.pose, i);
            let catenary = ends.at_least_tension().map_err(StaticsError::cable(i))?.catenary;
            Ok(CableDerivatives::new(self.robot, self.pose, i, &catenary))
        })?;
        Ok(ABOVE_LEAST * rows)
    }

    /// Derivatives of the tensions that the limits at the exit points leave to the cables in `which`; zero
    /// rows for all others.
    fn exit_limits(&self, which: &[usize]) -> Result<DMatrix<f64>, StaticsError> {
        self.rows_of(which, |i| {
            if self.robot.cables[i].pulley.is_some() {
                let reason = "the limit is that of a cable on a pulley, at its leave point";
                return Err(StaticsError::NoDerivative {
                    quantity: "a tension on its greatest value",
                    reason,
                });
            }
            Ok(CableDerivatives::of_exit_limit(self.robot, self.pose, i, self.cables.limits[i].max))
        })
    }

    /// Derivatives of the tensions of `cable` in the rows of these cables; zero rows for all others.
    fn rows_of(
        &self,
        which: &[usize],
        cable: impl Fn(usize) -> Result<CableDerivatives, StaticsError>,
    ) -> Result<DMatrix<f64>, StaticsError> {
        let mut rows = self.inputs.zeros(self.robot.cables.len());
        if which.is_empty() {
            return Ok(rows);
        }
        let mut cables = cables_with(self.robot, &self.cables.offset)?;
        for i in which {
            cables[*i] = cable(*i)?;
        }
        let each = tensions(&self.inputs, self.pose, &cables);
        which.iter().for_each(|i| rows.set_row(*i, &each.row(*i)));
        Ok(rows)
    }

    /// Derivatives of the lengths, equation (D7), a column for each of `set_points`.
    pub(super) fn lengths(&self, set_points: &DMatrix<f64>) -> Result<DMatrix<f64>, StaticsError> {
        let cables = cables_with(self.robot, &self.cables.offset)?;
        let mut rows = tensions(&self.inputs, self.pose, &cables);
        rows.resize_horizontally_mut(set_points.ncols(), 0.0);
        Ok(lengths_of(set_points, rows, &cables))
    }
}
