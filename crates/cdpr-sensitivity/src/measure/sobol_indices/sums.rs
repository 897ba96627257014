//! Sums over blocks of the terms that the indices average.

use crate::design::saltelli::{Order, SaltelliDesign};
use crate::measure::linear_part::Line;

/// Pairs i < j of k inputs.
pub(super) fn pairs(k: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..k).flat_map(move |i| (i + 1..k).map(move |j| (i, j)))
}

/// Counts and sums of the terms that (Si1) to (Si4) average.
#[derive(Default)]
pub(super) struct Sums {
    components: usize,
    /// The two of V for each component, then those of all `S_i`, `T_i`, `S_ij`.
    terms: Vec<[f64; 2]>,
}

impl Sums {
    /// No terms yet of an output with these components.
    pub(super) fn of(components: usize) -> Self {
        Self { components, terms: Vec::new() }
    }

    /// Adds the terms of one component of a block. Those that need a failed output are left out.
    pub(super) fn observe(
        &mut self,
        block: &[Option<f64>],
        mean: f64,
        component: usize,
        design: &SaltelliDesign,
        line: Option<Line>,
    ) {
        let k = design.groups().len();
        let of_line = line.as_ref().map_or_else(|| vec![0.0; block.len()], |line| line.values(block.len()));
        let rest = block.iter().zip(of_line).map(|(output, of_line)| Some((*output)? - mean - of_line));
        let rest: Vec<Option<f64>> = rest.collect();
        let known = |i: usize| line.as_ref().map_or(0.0, |line| line.variance(i));
        let (a, b) = (rest[0], rest[rest.len() - 1]);
        let ab = &rest[1..=k];
        let first: Vec<Option<f64>> = ab.iter().map(|ab| Some(b? * ((*ab)? - a?))).collect();
        let total = ab.iter().map(|ab| Some(0.5 * (a? - (*ab)?).powi(2)));
        let mut terms: Vec<Option<f64>> = first.iter().copied().chain(total).collect();
        for (index, term) in terms.iter_mut().enumerate() {
            *term = term.map(|term| term + known(index % k));
        }
        if design.order() == Order::Second {
            let ba = &rest[k + 1..=2 * k];
            let second = |(i, j): (usize, usize)| Some(ba[i]? * ab[j]? - a? * b? - first[i]? - first[j]?);
            terms.extend(pairs(k).map(second));
        }
        let moments = 2 * self.components;
        self.terms.resize(moments + terms.len(), [0.0; 2]);
        let known: f64 = (0..k).map(known).sum();
        for x in [a, b].into_iter().flatten() {
            for (moment, value) in self.terms[2 * component..].iter_mut().zip([x, x * x + known]) {
                *moment = [moment[0] + 1.0, moment[1] + value];
            }
        }
        for (sum, term) in self.terms[moments..].iter_mut().zip(terms) {
            // All components of an observation fail together.
            *sum = term.map_or([0.0; 2], |term| [1.0, sum[1] + term]);
        }
    }

    /// Adds the sums of others `times` times.
    pub(super) fn add(&mut self, times: u32, other: &Self) {
        self.components = other.components;
        self.terms.resize(other.terms.len(), [0.0; 2]);
        for (sum, term) in self.terms.iter_mut().flatten().zip(other.terms.iter().flatten()) {
            *sum += f64::from(times) * term;
        }
    }

    /// Number of blocks behind an index.
    pub(super) fn count(&self, index: usize) -> usize {
        self.terms[2 * self.components + index][0] as usize
    }

    /// V and the indices. An index without terms is NaN.
    pub(super) fn quotients(&self) -> (f64, Vec<f64>) {
        let mean = |[n, sum]: &[f64; 2]| sum / n;
        let (moments, terms) = self.terms.split_at(2 * self.components);
        let variance: f64 = moments.chunks(2).map(|of| mean(&of[1]) - mean(&of[0]).powi(2)).sum();
        (variance, terms.iter().map(|term| mean(term) / variance).collect())
    }
}
