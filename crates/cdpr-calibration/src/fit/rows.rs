//! Single rows: their own unknowns at their best, and other equilibria of theirs.
//!
//! A row is stepped in its pose and tensions where cables are taut, else in its lengths
//! ([`crate::model::row`]).

use crate::error::CalibrationError;
use crate::fit::problem::Problem;
use crate::model::compare::Compared;
use crate::model::kink::Kink;
use crate::model::{RowAt, RowState, State};
use crate::solve::Eliminated;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// A row's own unknowns are at their best where a step would gain less than this share of its cost.
const OWN_GAIN: f64 = 1e-3;

/// The same share where the step of a row comes to a kink of an elastic law: it ends there, or beyond.
const GAIN_AT_KINK: f64 = 1e-14;

/// Rounding of the cost of a row, relative to one more than it.
const ROUNDING_OF_COST: f64 = 1e-10;

/// Rows whose cost exceeds its expectation by this many of its standard deviations are begun again.
const BAD: f64 = 4.0;

/// Share of a row's cost below which another equilibrium is taken.
const WORTHWHILE: f64 = 0.9;

/// Share of what a step of a row would gain, by its linearization, that it has to gain.
const GAINED: f64 = 1e-2;

/// Weight of a tension that is kept, over the greatest derivative of a residual.
const KEPT: f64 = 1e6;

/// Steps of the unknowns of a row at most.
const MOST_OWN_STEPS: usize = 20;

/// Shares of a step of the unknowns of a row that are tried.
const SHARES: [f64; 6] = [1.0, 0.5, 0.25, 0.1, 0.03, 0.01];

/// Which rows are begun again.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Look {
    All,
    /// Those that fit badly.
    Bad,
}

/// A step of a row.
pub(super) struct RowStep<'a> {
    /// Of the unknowns of all rows.
    pub(super) unknowns: &'a DVector<f64>,
    /// Of those of the row.
    pub(super) own: Vec<f64>,
    /// [`Compared::motion`] where the step begins.
    pub(super) motion: &'a DMatrix<f64>,
}

/// In which coordinates a row is stepped.
#[derive(Clone, Copy)]
pub(super) enum Way {
    Tensions,
    Lengths,
}

impl Way {
    pub(super) const ALL: [Self; 2] = [Self::Tensions, Self::Lengths];
}

impl Problem<'_> {
    /// The state with rows begun again, as they were read and with taut cables, if any of them fits better
    /// then: at an equilibrium with other slack cables a row may be trapped.
    pub(super) fn look_again(&self, from: &State, which: Look) -> Result<Option<State>, CalibrationError> {
        let shared = &from.shared;
        let robot = self.model.deviating(&shared.x)?;
        let better: Vec<Option<RowState>> = (self.rows, &from.rows)
            .into_par_iter()
            .map(|(row, state)| {
                let here = RowAt { row, shared, robot: &robot };
                let at = |state: RowState| {
                    let compared = self.model.compare(&here, &state).ok()?;
                    Some(self.at_their_best(&here, state, compared))
                };
                let now = self.row_cost(&at(state.clone())?.1);
                let numbers = row.readings.len() as f64;
                if which == Look::Bad && now < numbers + BAD * (2.0 * numbers).sqrt() {
                    return None;
                }
                let as_read = if which == Look::Bad { self.model.as_read(row, &shared.x).ok() } else { None };
                let taut = [state.pose()].into_iter().chain(as_read.as_ref().map(RowState::pose));
                let taut: Vec<_> =
                    taut.filter_map(|near| self.model.taut(row, &shared.x, near).ok()).collect();
                let tried = as_read.into_iter().chain(taut).filter_map(at);
                let (cost, best) = tried
                    .map(|(state, compared)| (self.row_cost(&compared), state))
                    .min_by(|a, b| a.0.total_cmp(&b.0))?;
                (cost < WORTHWHILE * now).then_some(best)
            })
            .collect();
        if better.iter().all(Option::is_none) {
            return Ok(None);
        }
        let rows = from.rows.iter().zip(better).map(|(row, better)| better.unwrap_or_else(|| row.clone()));
        Ok(Some(State { shared: shared.clone(), rows: rows.collect() }))
    }

    /// A row after a step of its own unknowns and of those of all rows.
    pub(super) fn moved(
        &self,
        at: &RowAt,
        from: &RowState,
        step: &RowStep,
        way: Way,
    ) -> Option<(RowState, Compared)> {
        let errors: Vec<f64> = from.own().iter().zip(&step.own).map(|(e, d)| e + d).collect();
        let state = match way {
            Way::Lengths => self.model.follow(at, from, errors).ok()?,
            Way::Tensions if step.own.is_empty() => return None,
            Way::Tensions => {
                let both = step.unknowns.iter().chain(&step.own).copied();
                let change = step.motion * DVector::from_iterator(step.motion.ncols(), both);
                self.model.follow_tensions(at, from, &errors, &change)?
            }
        };
        let compared = self.model.compare(at, &state).ok()?;
        Some((state, compared))
    }

    /// A row with its own unknowns where they suit it best, near those given.
    pub(super) fn at_their_best(
        &self,
        at: &RowAt,
        mut state: RowState,
        mut compared: Compared,
    ) -> (RowState, Compared) {
        if state.own().is_empty() {
            return (state, compared);
        }
        let unknowns = DVector::zeros(at.shared.x.len());
        let first = at.shared.x.len();
        for _ in 0..MOST_OWN_STEPS {
            let cost = self.row_cost(&compared);
            let (mut slopes, mut residuals) = (compared.per_own.clone(), compared.residuals.clone());
            for r in 0..residuals.len() {
                let weight = self.settings.loss.weight(residuals[r]).sqrt();
                residuals[r] *= weight;
                slopes.row_mut(r).iter_mut().for_each(|slope| *slope *= weight);
            }
            let count = residuals.len();
            let residuals = DMatrix::from_column_slice(count, 1, residuals.as_slice());
            let own = |of: &DMatrix<f64>| of.columns(first, slopes.ncols()).into_owned();
            let (per_own, bends) = (own(&compared.motion), own(&compared.bends));
            let all = eliminated(residuals, &slopes, &per_own, &compared.between, &bends);
            let gain = all.gain();
            let step = all.own(&DVector::zeros(0));
            let to_kinks = to_kinks(&compared, &step);
            let least = if to_kinks.is_empty() { OWN_GAIN } else { GAIN_AT_KINK };
            if gain <= least * (1.0 + cost) {
                break;
            }
            let motion = &compared.motion;
            let after = |(way, share, allowed): (Way, f64, f64)| {
                let own = step.iter().map(|of| share * of).collect();
                let moved = self.moved(at, &state, &RowStep { unknowns: &unknowns, own, motion }, way)?;
                let after = self.row_cost(&moved.1);
                (after < allowed).then_some((after, moved))
            };
            // Beyond a kink the step is of another law: the best of both sides and the kink itself.
            // The last of the way to a kink gains less than rounding.
            let rounded = cost + ROUNDING_OF_COST * (1.0 + cost);
            let at_kinks = to_kinks.into_iter().filter_map(|share| after((Way::Tensions, share, rounded)));
            let gained = |way| SHARES.map(|share| (way, share, cost - GAINED * share * gain));
            let whole = Way::ALL.into_iter().flat_map(gained).find_map(&after);
            let best = at_kinks.chain(whole).min_by(|one, other| one.0.total_cmp(&other.0));
            let Some((_, tried)) = best else { break };
            (state, compared) = tried;
        }
        (state, compared)
    }
}

/// Shares of a step of the unknowns of a row at which a tension comes to a kink of its law.
fn to_kinks(compared: &Compared, step: &[f64]) -> Vec<f64> {
    let step = DVector::from_column_slice(step);
    let share = |kink: &Kink| kink.away / (&kink.per_own * &step)[0];
    compared.kinks.iter().map(share).filter(|share| (0.0..1.0).contains(share) && *share > 0.0).collect()
}

/// A row without its own unknowns, where cables between taut and slack that would have less tension keep
/// what they have. The tensions depend by `motion` on the unknowns of `row` (its columns without the last),
/// then on those of `own`; so do `bends`, rows without residuals.
pub(super) fn eliminated(
    row: DMatrix<f64>,
    own: &DMatrix<f64>,
    motion: &DMatrix<f64>,
    between: &[usize],
    bends: &DMatrix<f64>,
) -> Eliminated {
    let count = row.ncols() - 1;
    let above = row.nrows();
    let mut row = row.resize_vertically(above + bends.nrows(), 0.0);
    let mut both = own.clone().resize_vertically(above + bends.nrows(), 0.0);
    row.view_mut((above, 0), (bends.nrows(), count)).copy_from(&bends.columns(0, count));
    both.rows_mut(above, bends.nrows()).copy_from(&bends.columns(count, own.ncols()));
    let own = &both;
    if between.is_empty() {
        return Eliminated::new(row, own);
    }
    let tension = |i: &usize| motion.row(6 + i);
    let alone = Eliminated::new(row.columns(count, 1).into_owned(), own);
    let step = DVector::from_vec(alone.own(&DVector::zeros(0)));
    let loses = |i: &&usize| tension(i).columns(count, own.ncols()).transpose().dot(&step) < 0.0;
    let kept: Vec<usize> = between.iter().filter(loses).copied().collect();
    let (rows, unknowns, weight) = (row.nrows(), own.ncols(), KEPT * own.amax());
    let mut row = row.resize_vertically(rows + kept.len(), 0.0);
    let mut own = own.clone().resize_vertically(rows + kept.len(), 0.0);
    for (k, i) in kept.iter().enumerate() {
        let slopes = tension(i) * (weight / tension(i).amax());
        row.view_mut((rows + k, 0), (1, count)).copy_from(&slopes.columns(0, count));
        own.row_mut(rows + k).copy_from(&slopes.columns(count, unknowns));
    }
    Eliminated::new(row, &own)
}
