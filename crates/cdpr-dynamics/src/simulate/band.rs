//! Symmetric matrices with a narrow band.

use nalgebra::ComplexField;

/// The lower half of a symmetric matrix: row i holds the columns from `i - width` to i.
#[derive(Clone, Debug)]
pub(super) struct Band<T> {
    size: usize,
    width: usize,
    values: Vec<T>,
}

impl<T: ComplexField + Copy> Band<T> {
    pub(super) fn zeros(size: usize, width: usize) -> Self {
        Self { size, width, values: vec![T::zero(); size * (width + 1)] }
    }

    fn place(&self, i: usize, j: usize) -> usize {
        (i + 1) * self.width + j
    }

    fn first(&self, i: usize) -> usize {
        i.saturating_sub(self.width)
    }

    /// Adds to the element (i, j) and, with it, to (j, i); nothing where the column is right of the row.
    pub(super) fn add(&mut self, i: usize, j: usize, value: T) {
        if j <= i {
            let place = self.place(i, j);
            self.values[place] += value;
        }
    }

    /// The same band with other values.
    pub(super) fn map<S: ComplexField + Copy>(&self, other: &Self, of: impl Fn(T, T) -> S) -> Band<S> {
        let values = self.values.iter().zip(&other.values).map(|(one, other)| of(*one, *other)).collect();
        Band { size: self.size, width: self.width, values }
    }

    /// Adds the product with a vector to another one.
    pub(super) fn add_product<S>(&self, vector: &[S], sums: &mut [S])
    where
        S: ComplexField<RealField = T> + Copy,
    {
        for i in 0..self.size {
            let (row, own) = (&self.values[self.left(i)], vector[i]);
            let mut sum = own.scale(self.values[self.place(i, i)]);
            let left = self.first(i)..i;
            for ((value, other), product) in row.iter().zip(&vector[left.clone()]).zip(&mut sums[left]) {
                sum += other.scale(*value);
                *product += own.scale(*value);
            }
            sums[i] += sum;
        }
    }

    /// Where the elements of row i left of the diagonal are.
    fn left(&self, i: usize) -> std::ops::Range<usize> {
        self.place(i, self.first(i))..self.place(i, i)
    }

    /// L and D of `L D Lᵀ`, without exchange of rows; `None` for a pivot that is zero.
    pub(super) fn factor(mut self) -> Option<Factored<T>> {
        let (width, mut inverse_pivots) = (self.width, Vec::with_capacity(self.size));
        for i in 0..self.size {
            let first = self.first(i);
            let (before, row) = self.values.split_at_mut(i * (width + 1));
            // First L D, in the row of L.
            for j in first..i {
                let from = first.max(j.saturating_sub(width));
                let (left, right) = row.split_at_mut(j + width - i);
                let other = &before[j * (width + 1)..][from + width - j..width];
                for (one, other) in left[from + width - i..].iter().zip(other) {
                    right[0] -= *one * *other;
                }
            }
            let mut pivot = row[width];
            for (value, inverse) in row[first + width - i..width].iter_mut().zip(&inverse_pivots[first..]) {
                let scaled = *value * *inverse;
                pivot -= *value * scaled;
                *value = scaled;
            }
            if pivot == T::zero() || !pivot.is_finite() {
                return None;
            }
            inverse_pivots.push(T::one() / pivot);
        }
        Some(Factored { lower: self, inverse_pivots })
    }
}

/// The factors of a [`Band`].
#[derive(Clone, Debug)]
pub(super) struct Factored<T> {
    lower: Band<T>,
    inverse_pivots: Vec<T>,
}

impl<T: ComplexField + Copy> Factored<T> {
    /// `L⁻¹` times a vector in place, whose elements before `from` are zero.
    pub(super) fn forward(&self, vector: &mut [T], from: usize) {
        let band = &self.lower;
        for i in from..band.size {
            let first = band.first(i).max(from);
            let row = &band.values[band.place(i, first)..band.place(i, i)];
            let mut sum = vector[i];
            for (value, known) in row.iter().zip(&vector[first..i]) {
                sum -= *value * *known;
            }
            vector[i] = sum;
        }
    }

    /// `D⁻¹`, the elements of its diagonal.
    pub(super) fn inverse_pivots(&self) -> &[T] {
        &self.inverse_pivots
    }

    /// `L⁻ᵀ D⁻¹` times a vector in place.
    pub(super) fn backward(&self, vector: &mut [T]) {
        let band = &self.lower;
        for (value, inverse) in vector.iter_mut().zip(&self.inverse_pivots) {
            *value *= *inverse;
        }
        for i in (0..band.size).rev() {
            let (row, known) = (&band.values[band.left(i)], vector[i]);
            for (value, unknown) in row.iter().zip(&mut vector[band.first(i)..i]) {
                *unknown -= *value * known;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Complex;

    #[test]
    fn factors_solve_what_the_band_multiplies() {
        let (size, width) = (9, 3);
        let [mut one, mut other] = [0; 2].map(|_| Band::<f64>::zeros(size, width));
        for i in 0..size {
            for j in i.saturating_sub(width)..=i {
                let value = (3 * i + 5 * j) as f64 % 7.0 - 3.0;
                one.add(i, j, if i == j { value + 20.0 } else { value });
                other.add(i, j, 0.1 * (i * j) as f64);
            }
        }
        let right: Vec<_> = (0..size).map(|i| Complex::new(i as f64, 1.0)).collect();
        let mut found: Vec<Complex<f64>> = right.clone();
        let factored = one.map(&other, Complex::new).factor().unwrap();
        factored.forward(&mut found, 0);
        factored.backward(&mut found);
        let [mut sums, mut others] = [0; 2].map(|_| vec![Complex::new(0.0, 0.0); size]);
        one.add_product(&found, &mut sums);
        other.add_product(&found, &mut others);
        for ((sum, other), right) in sums.iter().zip(&others).zip(&right) {
            assert!((sum + Complex::<f64>::i() * other - right).norm() < 1e-13, "{sum} {other} {right}");
        }
    }
}
