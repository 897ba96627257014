//! The motions of a cable with its end held, and how they are coupled to its end.
//!
//! The unknowns inside of the cable are replaced by its static shapes, of unit motions of its end, and by its
//! natural motions with the end held. With K_s, M_s the stiffness and mass of the former, ω_k the natural
//! frequencies of the latter, of unit mass, and c_k their coupling, the dynamic stiffness of the end is
//!
//! ```text
//! K_dyn(ω) = K_s - ω² M_s - ω⁴ sum c_k c_kᵀ/(ω_k² - ω²)                                            (N4)
//! ```

use crate::dense::{cholesky, eigenvectors};
use crate::element::Matrices;
use nalgebra::{DMatrix, DVector};

/// A natural motion of a cable whose end is held.
#[derive(Clone, Debug)]
pub(crate) struct Clamped<const D: usize> {
    /// ω_k² [1/s²].
    pub(crate) square: f64,
    /// c_k [√kg].
    pub(crate) coupling: [f64; D],
}

/// A cable seen from its end. K_s is that of the static models.
#[derive(Clone, Debug)]
pub(crate) struct Condensed<const D: usize> {
    /// M_s [kg].
    pub(crate) mass: [[f64; D]; D],
    /// The motions with the end held, the slowest first.
    pub(crate) modes: Vec<Clamped<D>>,
    /// The unknowns but the end, by motions of the end: the static shapes.
    shapes: DMatrix<f64>,
    /// L of the stiffness `K = L Lᵀ`, and the eigenvectors w of the squares of the periods, the fastest
    /// first.
    lower: DMatrix<f64>,
    vectors: DMatrix<f64>,
}

impl<const D: usize> Condensed<D> {
    /// From matrices whose first D unknowns are the motion of the end; `None` where the rest of the stiffness
    /// is not positive definite.
    ///
    /// The squares of the periods are the eigenvalues: then the slowest motions are the most accurate ones.
    pub(crate) fn new(matrices: &Matrices) -> Option<Self> {
        let size = matrices.stiffness.nrows() - D;
        let inside = |matrix: &DMatrix<f64>| matrix.view((D, D), (size, size)).into_owned();
        let to_end = |matrix: &DMatrix<f64>| matrix.view((D, 0), (size, D)).into_owned();
        let (stiffness, mass) = (inside(&matrices.stiffness), inside(&matrices.mass));
        let lower = cholesky(&stiffness)?;
        // With K = L Lᵀ the static shapes -K⁻¹ K_e are -L⁻ᵀ L⁻¹ K_e.
        let mut shapes = -to_end(&matrices.stiffness);
        lower.solve_lower_triangular_mut(&mut shapes);
        lower.tr_solve_lower_triangular_mut(&mut shapes);
        let mass_to_end = to_end(&matrices.mass);
        let inertia = &mass * &shapes + &mass_to_end;
        let of_end = matrices.mass.view((0, 0), (D, D));
        let static_mass = of_end + shapes.tr_mul(&inertia) + mass_to_end.tr_mul(&shapes);
        let mut periods = mass;
        lower.solve_lower_triangular_mut(&mut periods);
        let mut periods = periods.transpose();
        lower.solve_lower_triangular_mut(&mut periods);
        let (values, vectors) = eigenvectors(&periods)?;
        let mut forces = inertia;
        lower.solve_lower_triangular_mut(&mut forces);
        let couplings = vectors.tr_mul(&forces);
        let mode = |k: usize| {
            let period = values[k];
            let coupling = std::array::from_fn(|c| couplings[(k, c)] / period.sqrt());
            Clamped { square: period.recip(), coupling }
        };
        // Massless unknowns have no period.
        let modes = (0..size).rev().filter(|k| values[*k] > f64::EPSILON * values[size - 1]).map(mode);
        let mass = std::array::from_fn(|i| {
            std::array::from_fn(|j| 0.5 * (static_mass[(i, j)] + static_mass[(j, i)]))
        });
        Some(Self { modes: modes.collect(), mass, shapes, lower, vectors })
    }

    /// How far an unknown moves with the end, its place behind those of the end, and how far by a force on it
    /// while the end is held [m/N].
    pub(crate) fn yielding(&self, unknown: usize) -> ([f64; D], f64) {
        let mut force = DVector::zeros(self.shapes.nrows());
        force[unknown] = 1.0;
        self.lower.solve_lower_triangular_mut(&mut force);
        (std::array::from_fn(|k| self.shapes[(unknown, k)]), force.norm_squared())
    }

    /// All unknowns of a motion of the end with amplitudes of the motions with the end held.
    ///
    /// That with the frequency ω_k is `ω_k L⁻ᵀ w_k`.
    pub(crate) fn unknowns(&self, end: [f64; D], amplitudes: &[f64]) -> Vec<f64> {
        let mut inside = DVector::zeros(self.lower.nrows());
        let last = self.vectors.ncols();
        for (k, (mode, amplitude)) in self.modes.iter().zip(amplitudes).enumerate() {
            inside.axpy(amplitude * mode.square.sqrt(), &self.vectors.column(last - 1 - k), 1.0);
        }
        self.lower.tr_solve_lower_triangular_mut(&mut inside);
        inside += &self.shapes * DVector::from_column_slice(&end);
        end.into_iter().chain(inside.iter().copied()).collect()
    }

    /// The motions up to `square` = ω² [1/s²], and D more that act on slow motions as all faster ones do:
    /// with
    ///
    /// ```text
    /// R = sum c cᵀ/ω_k² = G Gᵀ,    S = sum c cᵀ/ω_k⁴,    G⁺ S G⁺ᵀ = Q W⁻² Qᵀ                       (N5)
    /// ```
    ///
    /// over the faster ones they have the frequencies W and the couplings `G Q W`, which leaves R and S as
    /// they are.
    pub(crate) fn reduced(&self, square: f64) -> Vec<Clamped<D>> {
        const ROUNDING: f64 = 1e-14;
        let (slow, fast) = self.modes.split_at(self.modes.partition_point(|mode| mode.square < square));
        let [mut r, mut s] = [DMatrix::zeros(D, D), DMatrix::zeros(D, D)];
        for Clamped { square, coupling } in fast {
            let coupling = DVector::from_column_slice(coupling);
            let product = &coupling * coupling.transpose() / *square;
            s += &product / *square;
            r += product;
        }
        let mut found = slow.to_vec();
        let eigen = r.symmetric_eigen();
        let greatest = eigen.eigenvalues.amax();
        let ranked: Vec<_> = (0..D).filter(|k| eigen.eigenvalues[*k] > ROUNDING * greatest).collect();
        let column = |k: &usize| eigen.eigenvectors.column(*k) * eigen.eigenvalues[*k].sqrt();
        let columns: Vec<_> = ranked.iter().map(column).collect();
        if columns.is_empty() {
            return found;
        }
        let factor = DMatrix::from_columns(&columns);
        let inverse = DMatrix::from_fn(ranked.len(), D, |i, j| factor[(j, i)] / eigen.eigenvalues[ranked[i]]);
        let periods = (&inverse * s * inverse.transpose()).symmetric_eigen();
        let couplings = factor * &periods.eigenvectors;
        for (k, period) in periods.eigenvalues.iter().enumerate() {
            let coupling = std::array::from_fn(|c| couplings[(c, k)] / period.sqrt());
            found.push(Clamped { square: period.recip(), coupling });
        }
        found
    }
}
