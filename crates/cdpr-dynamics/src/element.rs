//! Stiffness and mass of a cable about its shape, by polynomials.
//!
//! With the unstrained length s, the tension n(s), which points along growing s, `N = |n|`, its direction t,
//! the strain ε and the mass μ per unstrained length, a small motion `y(s) sin ωt` of the cable obeys
//!
//! ```text
//! (A y')' + μ ω² y = 0,    A⁻¹ = (1 + ε)/N (1 - t tᵀ) + dε/dN t tᵀ                                 (N2)
//! ```
//!
//! The stretch of t along s couples motions along and across the cable: no shallow sag is assumed. Those in
//! the vertical plane of the cable and those across it are independent of each other.
//!
//! On elements of the length h, with `s = s_0 + h ξ`, y is a sum of the functions (N1), which gives
//!
//! ```text
//! K = (1/h) ∫ N'ᵀ A N' dξ,     M = μ h ∫ Nᵀ N dξ                                                   (N3)
//! ```

use crate::polynomial::{functions, gauss};
use nalgebra::DMatrix;

/// A part of a cable on which its motion is one polynomial.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element {
    /// Where it begins and ends, as unstrained length from the exit [m].
    pub(crate) ends: [f64; 2],
    pub(crate) degree: usize,
}

/// Where the cable begins: motions of that point, each along a direction, with matrices whose first rows are
/// theirs; further rows are those of unknowns beyond the point. Without directions it is fixed.
#[derive(Clone, Debug)]
pub(crate) struct Beginning<const D: usize> {
    pub(crate) directions: Vec<[f64; D]>,
    pub(crate) matrices: Matrices,
}

/// Stiffness [N/m] and mass [kg] of the unknowns.
#[derive(Clone, Debug)]
pub(crate) struct Matrices {
    pub(crate) stiffness: DMatrix<f64>,
    pub(crate) mass: DMatrix<f64>,
}

impl Matrices {
    pub(crate) fn zeros(size: usize) -> Self {
        Self { stiffness: DMatrix::zeros(size, size), mass: DMatrix::zeros(size, size) }
    }
}

impl<const D: usize> Beginning<D> {
    /// A point that does not move.
    pub(crate) fn fixed() -> Self {
        Self { directions: Vec::new(), matrices: Matrices::zeros(0) }
    }

    /// A point that yields with this compliance [m/N]. Along directions with less than `rounding` it is
    /// fixed.
    pub(crate) fn yielding(compliance: [[f64; D]; D], rounding: f64) -> Self {
        let eigen = DMatrix::from_fn(D, D, |i, j| compliance[i][j]).symmetric_eigen();
        let soft: Vec<usize> = (0..D).filter(|k| eigen.eigenvalues[*k] > rounding).collect();
        let mut matrices = Matrices::zeros(soft.len());
        for (row, k) in soft.iter().enumerate() {
            matrices.stiffness[(row, row)] = eigen.eigenvalues[*k].recip();
        }
        let direction = |k: &usize| std::array::from_fn(|c| eigen.eigenvectors[(c, *k)]);
        Self { directions: soft.iter().map(direction).collect(), matrices }
    }
}

/// An unknown and the direction in which it moves the cable.
type Unknown<const D: usize> = (usize, [f64; D]);

/// The unknowns of every function of every element, and how many unknowns there are: the motion of the end
/// first, then those of the beginning.
pub(crate) fn layout<const D: usize>(
    elements: &[Element],
    beginning: &Beginning<D>,
) -> (Vec<Vec<Vec<Unknown<D>>>>, usize) {
    let hidden = beginning.matrices.stiffness.nrows();
    let along = |first: usize| -> Vec<Unknown<D>> {
        (0..D).map(|k| (first + k, std::array::from_fn(|c| f64::from(u8::from(c == k))))).collect()
    };
    let mut next = D + hidden;
    let mut before: Vec<Unknown<D>> =
        beginning.directions.iter().enumerate().map(|(k, direction)| (D + k, *direction)).collect();
    let mut all = Vec::with_capacity(elements.len());
    for (e, element) in elements.iter().enumerate() {
        let mut take = || {
            let unknowns = along(next);
            next += D;
            unknowns
        };
        let after = if e + 1 == elements.len() { along(0) } else { take() };
        let mut unknowns = vec![before, after.clone()];
        unknowns.extend((2..=element.degree).map(|_| take()));
        all.push(unknowns);
        before = after;
    }
    (all, next)
}

/// The matrices of a cable in D dimensions. The first D unknowns are the motion of its end; `modulus` is A at
/// an unstrained length [N], `density` the mass per length [kg/m].
pub(crate) fn assemble<const D: usize>(
    elements: &[Element],
    beginning: &Beginning<D>,
    density: f64,
    modulus: impl Fn(f64) -> [[f64; D]; D],
) -> Matrices {
    let hidden = beginning.matrices.stiffness.nrows();
    let (unknowns, size) = layout(elements, beginning);
    let mut all = Matrices::zeros(size);
    for j in 0..hidden {
        for i in 0..hidden {
            all.stiffness[(D + i, D + j)] += beginning.matrices.stiffness[(i, j)];
            all.mass[(D + i, D + j)] += beginning.matrices.mass[(i, j)];
        }
    }
    for (element, unknowns) in elements.iter().zip(&unknowns) {
        add(&mut all, element, unknowns, density, &modulus);
    }
    all
}

/// A point of the rule on an element: values and slopes [1/m] of its functions, its unstrained length from
/// the exit [m], and its weight [m].
pub(crate) struct Point {
    pub(crate) s: f64,
    pub(crate) weight: f64,
    pub(crate) functions: Vec<[f64; 2]>,
}

impl Element {
    /// Points for integrals over products of its functions.
    pub(crate) fn points(&self) -> Vec<Point> {
        /// Points beyond the degree: A is no polynomial.
        const MORE_POINTS: usize = 12;
        let [from, to] = self.ends;
        let length = to - from;
        let point = |[x, weight]: [f64; 2]| {
            let scaled = |[value, slope]: [f64; 2]| [value, slope / length];
            Point {
                s: from + 0.5 * (1.0 + x) * length,
                weight: 0.5 * weight * length,
                functions: functions(self.degree, x).into_iter().map(scaled).collect(),
            }
        };
        gauss(self.degree + MORE_POINTS).into_iter().map(point).collect()
    }
}

/// Adds an element: `unknowns` are those of each of its functions.
fn add<const D: usize>(
    all: &mut Matrices,
    element: &Element,
    unknowns: &[Vec<Unknown<D>>],
    density: f64,
    modulus: &impl Fn(f64) -> [[f64; D]; D],
) {
    let points: Vec<_> = element
        .points()
        .into_iter()
        .map(|Point { s, weight, functions }| {
            (functions, modulus(s).map(|row| row.map(|a| weight * a)), weight * density)
        })
        .collect();
    for (a, first) in unknowns.iter().enumerate() {
        for (b, second) in unknowns.iter().enumerate().take(a + 1) {
            let mut stiffness = [[0.0; D]; D];
            let mut mass = 0.0;
            for (functions, modulus, weight) in &points {
                let ([value, slope], [other, other_slope]) = (functions[a], functions[b]);
                mass += weight * value * other;
                let slopes = slope * other_slope;
                for (sums, row) in stiffness.iter_mut().zip(modulus) {
                    sums.iter_mut().zip(row).for_each(|(sum, a)| *sum += slopes * a);
                }
            }
            for (i, along) in first {
                for (j, other) in second {
                    let product = |c: usize| -> f64 { (0..D).map(|d| stiffness[c][d] * other[d]).sum() };
                    let k: f64 = (0..D).map(|c| along[c] * product(c)).sum();
                    let m = mass * along.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
                    all.stiffness[(*i, *j)] += k;
                    all.mass[(*i, *j)] += m;
                    if a != b {
                        all.stiffness[(*j, *i)] += k;
                        all.mass[(*j, *i)] += m;
                    }
                }
            }
        }
    }
}
