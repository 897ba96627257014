//! The matrices of Newton's method for platform and cables.
//!
//! It needs `σ² M + σ C + K` for a real and a complex σ. Each cable has a narrow band in it, which is
//! eliminated; six unknowns are left.

use super::band::Factored;
use super::cable::CableMatrices;
use super::collocation::Linearization;
use cdpr_robot::Vector6;
use nalgebra::{ComplexField, Const, LU, Matrix6};

/// Mass, stiffness and damping of platform and cables.
#[derive(Clone, Debug)]
pub(super) struct Matrices {
    pub(super) mass: Matrix6<f64>,
    pub(super) stiffness: Matrix6<f64>,
    pub(super) damping: Matrix6<f64>,
    pub(super) cables: Vec<CableMatrices>,
    pub(super) size: usize,
}

/// Factors of `σ² M + σ C + K`: L and D of each cable with `L⁻¹` times its coupling to the platform, of the
/// rows from the first that is coupled; and the platform's.
pub(super) struct Factors<T: ComplexField + Copy> {
    shift: T,
    cables: Vec<(Factored<T>, Vec<[T; 6]>)>,
    platform: LU<T, Const<6>, Const<6>>,
}

impl Linearization for Matrices {
    type Factors<T: ComplexField<RealField = f64> + Copy> = Factors<T>;

    fn factor<T: ComplexField<RealField = f64> + Copy>(&self, shift: T) -> Option<Factors<T>> {
        let real = T::from_real;
        let mut platform =
            self.mass.map(real) * (shift * shift) + self.damping.map(real) * shift + self.stiffness.map(real);
        let mut cables = Vec::with_capacity(self.cables.len());
        for cable in &self.cables {
            let mut band = cable.stiffness.map(&cable.damping, |k, c| real(k) + shift * real(c));
            for (i, mass) in cable.mass.iter().enumerate() {
                band.add(i, i, shift * shift * real(*mass));
            }
            let factored = band.factor()?;
            let mut coupling = cable.coupling(shift);
            let mut rows = vec![T::zero(); cable.mass.len()];
            for column in 0..6 {
                coupling.iter().zip(&mut rows[cable.coupled..]).for_each(|(row, value)| *value = row[column]);
                factored.forward(&mut rows, cable.coupled);
                coupling.iter_mut().zip(&rows[cable.coupled..]).for_each(|(row, value)| row[column] = *value);
            }
            for (row, inverse) in coupling.iter().zip(&factored.inverse_pivots()[cable.coupled..]) {
                for i in 0..6 {
                    for j in 0..6 {
                        platform[(i, j)] -= row[i] * *inverse * row[j];
                    }
                }
            }
            cables.push((factored, coupling));
        }
        let platform = platform.lu();
        platform.is_invertible().then_some(Factors { shift, cables, platform })
    }

    fn solve<T: ComplexField<RealField = f64> + Copy>(&self, by: &Factors<T>, right: &[T]) -> Vec<T> {
        let (real, shift, n) = (T::from_real, by.shift, self.size);
        let (rates, accelerations) = right.split_at(n);
        // (σ² M + σ C + K) x = M a + (σ M + C) r for the unknowns, σ x - r for the velocities.
        let six = |values: &[T]| Vector6::from_fn(|i, _| values[i]).map(|value: T| value);
        let mixed = six(accelerations) + six(rates) * shift;
        let mut on_platform = self.mass.map(real) * mixed + self.damping.map(real) * six(rates);
        let mut found = vec![T::zero(); 2 * n];
        for (cable, (factored, coupling)) in self.cables.iter().zip(&by.cables) {
            let size = cable.mass.len();
            let own = &rates[cable.first..cable.first + size];
            let mut load = vec![T::zero(); size];
            if cable.is_damped {
                cable.damping.add_product(own, &mut load);
            }
            for i in 0..size {
                load[i] += (accelerations[cable.first + i] + shift * own[i]).scale(cable.mass[i]);
            }
            for i in cable.coupled..size {
                for k in 0..6 {
                    let damping = real(cable.coupling[i][1][k]);
                    load[i] += damping * rates[k];
                    on_platform[k] += damping * own[i];
                }
            }
            factored.forward(&mut load, 0);
            let ends = load.iter().zip(factored.inverse_pivots()).skip(cable.coupled);
            for ((value, inverse), row) in ends.zip(coupling) {
                (0..6).for_each(|k| on_platform[k] -= row[k] * *inverse * *value);
            }
            found[cable.first..cable.first + size].copy_from_slice(&load);
        }
        let motion = by.platform.solve(&on_platform).unwrap_or_else(|| on_platform * T::from_real(f64::NAN));
        found[..6].copy_from_slice(motion.as_slice());
        for (cable, (factored, coupling)) in self.cables.iter().zip(&by.cables) {
            let own = &mut found[cable.first..cable.first + cable.mass.len()];
            for (value, row) in own[cable.coupled..].iter_mut().zip(coupling) {
                (0..6).for_each(|k| *value -= row[k] * motion[k]);
            }
            factored.backward(own);
        }
        for i in 0..n {
            found[n + i] = shift * found[i] - rates[i];
        }
        found
    }
}

impl CableMatrices {
    /// The rows of the unknowns that are coupled.
    fn coupling<T: ComplexField<RealField = f64> + Copy>(&self, shift: T) -> Vec<[T; 6]> {
        let real = T::from_real;
        let at = |[k, c]: &[Vector6<f64>; 2]| std::array::from_fn(|i| real(k[i]) + shift * real(c[i]));
        self.coupling[self.coupled..].iter().map(at).collect()
    }
}
