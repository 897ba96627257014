//! Walks through the joint law of the inputs, on which Shapley effects are estimated.
//!
//! With z = L ξ the normal scores of the inputs in a random order π, L the Cholesky factor of their
//! correlation in that order, and ξ, ξ' independent standard normal vectors, row j of a walk has
//!
//! ```text
//! z_j = L (ξ_1, .. ξ_j, ξ'_(j+1), .. ξ'_k),   j = 0 .. k                  (SH1)
//! ```
//!
//! The first j inputs of row j are those of row k, and all others are drawn anew from their law given the
//! first j: L is lower triangular, so that (SH1) is Rosenblatt's transformation (M. Rosenblatt, *Remarks on a
//! multivariate transformation*, Ann. Math. Stat. 23 (1952)). Rows of one walk all have the joint law of the
//! inputs. For independent inputs the walk is that of T. Goda, *A simple algorithm for global sensitivity
//! analysis with Shapley effects*, Reliab. Eng. Syst. Saf. 213 (2021).
//!
//! With groups, π orders groups, and all inputs of a group change in the same row.

use rand::seq::SliceRandom;

use crate::design::correlated::cholesky;
use crate::design::group::{Group, Overlap, check_groups};
use crate::design::input::Input;
use crate::design::{Layout, SampleDesign, check_row};
use crate::error::{SensitivityError, check_length, check_range};
use crate::law::normal::{standard_normal_cdf, standard_normal_quantile};
use crate::sample::random::{stream, uniform};

/// Independent walks (SH1) of k + 1 rows for k inputs or groups.
#[derive(Debug, Clone)]
pub struct ShapleyDesign {
    layout: Layout,
    groups: Vec<Group>,
    seed: u64,
    /// Inputs that are correlated with another one, and the correlation matrix of these.
    tied: Vec<usize>,
    correlation: Vec<Vec<f64>>,
}

impl ShapleyDesign {
    /// Makes walks of independent inputs.
    ///
    /// # Errors
    /// [`SensitivityError::InvalidInput`] for an invalid input, [`SensitivityError::OutOfRange`] for no input
    /// or fewer than two walks.
    pub fn new(inputs: Vec<Input>, walks: usize, seed: u64) -> Result<Self, SensitivityError> {
        check_range("walks", walks as u64, 2, u64::MAX)?;
        let points = walks.saturating_mul(inputs.len() + 1);
        let layout = Layout::new(inputs, points, Some(seed))?;
        let groups = Group::singles(&layout.inputs);
        Ok(Self { layout, groups, seed, tied: Vec::new(), correlation: Vec::new() })
    }

    /// Correlates the normal scores of the inputs by a matrix, which is given row by row, as
    /// [`crate::Correlated`] does.
    ///
    /// # Errors
    /// [`SensitivityError::LengthMismatch`] unless the matrix has a row and a column for each input,
    /// [`SensitivityError::NotACorrelation`] unless it is symmetric and positive definite with ones on its
    /// diagonal.
    pub fn correlated(self, correlation: &[Vec<f64>]) -> Result<Self, SensitivityError> {
        let k = self.inputs().len();
        check_length("correlation", correlation.len(), k)?;
        correlation.iter().try_for_each(|row| check_length("row of the correlation", row.len(), k))?;
        cholesky(correlation)?;
        let is_tied = |&i: &usize| (0..k).any(|j| j != i && correlation[i][j] != 0.0);
        let tied: Vec<usize> = (0..k).filter(is_tied).collect();
        let row = |&i: &usize| tied.iter().map(|&j| correlation[i][j]).collect();
        Ok(Self { correlation: tied.iter().map(row).collect(), tied, ..self })
    }

    /// Returns a design of as many walks in which groups of inputs change together. Each input is in one
    /// group.
    ///
    /// # Errors
    /// [`SensitivityError::OutOfRange`] for no group; [`SensitivityError::WrongGroup`] for one without inputs
    /// or with one that does not exist, for an input that is twice in the groups, and for one that is in
    /// none.
    pub fn grouped(self, groups: Vec<Group>) -> Result<Self, SensitivityError> {
        check_groups(&groups, self.inputs(), Overlap::Partition)?;
        let points = self.walks() * (groups.len() + 1);
        Ok(Self { layout: Layout { points, ..self.layout }, groups, ..self })
    }

    /// What changes in a row of a walk: each input by itself, unless there are groups.
    #[must_use]
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// Number of walks.
    #[must_use]
    pub fn walks(&self) -> usize {
        self.points() / (self.groups.len() + 1)
    }

    /// Order in which the groups of a walk take the values of its last row.
    pub(crate) fn order(&self, walk: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.groups.len()).collect();
        order.shuffle(&mut stream(self.seed, 2 * walk as u64));
        order
    }
}

impl SampleDesign for ShapleyDesign {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn replicate(&self, seed: u64) -> Self {
        Self { layout: self.layout.reseeded(seed), seed, ..self.clone() }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        check_row(self, index, point)?;
        let (walk, row) = (index / (self.groups.len() + 1), index % (self.groups.len() + 1));
        let order = self.order(walk);
        let mut is_last = vec![false; point.len()];
        order[..row].iter().flat_map(|&group| &self.groups[group].inputs).for_each(|&i| is_last[i] = true);
        let mut generator = stream(self.seed, 2 * walk as u64 + 1);
        for (u, is_last) in point.iter_mut().zip(is_last) {
            let [last, other] = [uniform(&mut generator), uniform(&mut generator)];
            *u = if is_last { last } else { other };
        }
        if self.tied.is_empty() {
            return Ok(());
        }
        // Places in `tied`, in the order of the walk.
        let place = |input: &usize| self.tied.iter().position(|tied| tied == input);
        let places: Vec<usize> =
            order.iter().flat_map(|&group| &self.groups[group].inputs).filter_map(place).collect();
        let entries = |&i: &usize| places.iter().map(|&j| self.correlation[i][j]).collect();
        let factor = cholesky(&places.iter().map(entries).collect::<Vec<Vec<f64>>>())?;
        let scores: Vec<f64> =
            places.iter().map(|&i| standard_normal_quantile(point[self.tied[i]])).collect();
        for (line, &i) in factor.iter().zip(&places) {
            let z = line.iter().zip(&scores).map(|(l, score)| l * score).sum();
            point[self.tied[i]] = standard_normal_cdf(z).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON);
        }
        Ok(())
    }
}
