//! Which inputs follow several others together, though perhaps none of these alone.
//!
//! With the correlations C of the ranks of k inputs, the share of an input's ranks that a linear model of the
//! others explains, and the correlation of two inputs that the others do not explain, are
//!
//! ```text
//! R_i² = 1 - 1 / P_ii,   r_ij = -P_ij / √(P_ii P_jj),   P = C⁻¹                       (Jo1)
//! p_i = P(B >= R_i²),   B ~ Beta((k - 1) / 2, (n - k) / 2)                            (Jo2)
//! ```
//!
//! (Jo2) is that of normal values (R. A. Fisher 1928); ranks are bounded, and so nearer to it than most. It
//! is asked for where there are at least two rows for each input.

use statrs::function::beta::beta_reg;

use crate::given::evidence::Scores;
use crate::parallel::*;

/// An input that several others explain together.
pub(crate) struct Joint {
    /// p (Jo2).
    pub(crate) p_value: f64,
    /// Those that explain it most, of at most [`NAMED`].
    pub(crate) others: Vec<usize>,
}

/// Number of others that are named.
const NAMED: usize = 3;
/// Largest number of inputs: the time grows with its cube.
const MOST: usize = 200;
/// What is added to the diagonal of C, so that copies have an inverse.
const RIDGE: f64 = 1e-9;

/// How the others explain each input of ordered values; none for words, nor for more inputs than are tested.
pub(crate) fn joint(scores: &[Option<&Scores>], rows: usize) -> Vec<Option<Joint>> {
    let places: Vec<usize> = (0..scores.len()).filter(|&input| scores[input].is_some()).collect();
    let all: Vec<&Scores> = scores.iter().flatten().copied().collect();
    let k = all.len();
    let none = || scores.iter().map(|_| None).collect();
    if !(3..=MOST).contains(&k) || rows < 2 * k {
        return none();
    }
    let row = |(i, one): (usize, &&Scores)| -> Vec<f64> {
        let entry = |(j, other): (usize, &&Scores)| if i == j { 1.0 + RIDGE } else { one.product(other) };
        all.iter().enumerate().map(entry).collect()
    };
    let Some(inverse) = inverse(all.par_iter().enumerate().map(row).collect()) else { return none() };
    let mut found: Vec<Option<Joint>> = none();
    for i in 0..k {
        let explained = (1.0 - 1.0 / inverse[i][i]).clamp(0.0, 1.0);
        let [others, rest] = [(k - 1) as f64, (rows - k) as f64];
        let p_value = beta_reg(0.5 * rest, 0.5 * others, 1.0 - explained);
        let partial = |j: usize| inverse[i][j].powi(2) / inverse[j][j];
        let mut order: Vec<usize> = (0..k).filter(|&j| j != i).collect();
        order.sort_by(|&one, &other| partial(other).total_cmp(&partial(one)));
        let largest = partial(order[0]);
        let named = order.into_iter().take(NAMED).filter(|&j| partial(j) > 0.1 * largest);
        found[places[i]] = Some(Joint { p_value, others: named.map(|j| places[j]).collect() });
    }
    found
}

/// The inverse of a symmetric positive definite matrix, by Gauss and Jordan.
fn inverse(mut a: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let n = a.len();
    for pivot in 0..n {
        let of_pivot = a[pivot][pivot];
        if of_pivot.is_nan() || of_pivot <= 0.0 {
            return None;
        }
        let mut line = std::mem::take(&mut a[pivot]);
        line[pivot] = 1.0;
        line.iter_mut().for_each(|value| *value /= of_pivot);
        for other in a.iter_mut().filter(|other| !other.is_empty()) {
            let factor = std::mem::take(&mut other[pivot]);
            other.iter_mut().zip(&line).for_each(|(value, of_line)| *value -= factor * of_line);
        }
        a[pivot] = line;
    }
    Some(a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_that_is_a_sum_of_others_is_explained_by_these_and_a_copy_by_the_copied() {
        let wave = |k: f64| (0..100).map(|row| (k * f64::from(row * row)).sin()).collect::<Vec<f64>>();
        let mut columns = vec![wave(0.7), wave(1.3), wave(2.1), wave(0.4)];
        columns.push((0..100).map(|row| columns[0][row] - columns[2][row]).collect());
        let scores: Vec<Scores> = columns.iter().filter_map(|column| Scores::of_ranks(column)).collect();
        let found = joint(&scores.iter().map(Some).collect::<Vec<_>>(), 100);
        let of = |input: usize| found[input].as_ref().unwrap();
        assert!(of(4).p_value < 1e-20 && of(1).p_value > 0.01, "{} {}", of(4).p_value, of(1).p_value);
        let mut others = of(4).others.clone();
        others.sort_unstable();
        assert_eq!(others, [0, 2]);
        let copies = [&scores[0], &scores[1], &scores[0]];
        let found = joint(&copies.map(Some), 100);
        assert_eq!(
            found[0].as_ref().map(|of| (of.p_value < 1e-100, of.others.clone())),
            Some((true, vec![2]))
        );
    }
}
