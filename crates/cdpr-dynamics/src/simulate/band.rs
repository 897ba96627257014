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

    /// Product with a vector.
    pub(super) fn times<S>(&self, vector: &[S], scale: impl Fn(T, S) -> S) -> Vec<S>
    where
        S: ComplexField + Copy,
    {
        let mut product = vec![S::zero(); self.size];
        for i in 0..self.size {
            for j in self.first(i)..=i {
                let value = self.values[self.place(i, j)];
                product[i] += scale(value, vector[j]);
                if j < i {
                    product[j] += scale(value, vector[i]);
                }
            }
        }
        product
    }

    /// The same band with other values.
    pub(super) fn map<S: ComplexField + Copy>(&self, other: &Self, of: impl Fn(T, T) -> S) -> Band<S> {
        let values = self.values.iter().zip(&other.values).map(|(one, other)| of(*one, *other)).collect();
        Band { size: self.size, width: self.width, values }
    }

    /// L and D of `L D Lᵀ`, without exchange of rows; `None` for a pivot that is zero.
    pub(super) fn factor(mut self) -> Option<Factored<T>> {
        for i in 0..self.size {
            // First L D, in the row of L.
            for j in self.first(i)..i {
                let mut value = self.values[self.place(i, j)];
                for k in self.first(i)..j {
                    if k >= self.first(j) {
                        value -= self.values[self.place(i, k)] * self.values[self.place(j, k)];
                    }
                }
                let place = self.place(i, j);
                self.values[place] = value;
            }
            let diagonal = self.place(i, i);
            for j in self.first(i)..i {
                let (place, pivot) = (self.place(i, j), self.values[self.place(j, j)]);
                let value = self.values[place];
                self.values[place] = value / pivot;
                self.values[diagonal] -= value * (value / pivot);
            }
            if self.values[diagonal] == T::zero() || !self.values[diagonal].is_finite() {
                return None;
            }
        }
        Some(Factored(self))
    }
}

/// The factors of a [`Band`].
#[derive(Clone, Debug)]
pub(super) struct Factored<T>(Band<T>);

impl<T: ComplexField + Copy> Factored<T> {
    /// Solves for a right side in place.
    pub(super) fn solve(&self, vector: &mut [T]) {
        let band = &self.0;
        for i in 0..band.size {
            for j in band.first(i)..i {
                let product = band.values[band.place(i, j)] * vector[j];
                vector[i] -= product;
            }
        }
        for i in (0..band.size).rev() {
            vector[i] /= band.values[band.place(i, i)];
        }
        for i in (0..band.size).rev() {
            for j in band.first(i)..i {
                let product = band.values[band.place(i, j)] * vector[i];
                vector[j] -= product;
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
        let mut band = Band::zeros(size, width);
        for i in 0..size {
            for j in i.saturating_sub(width)..=i {
                let value = Complex::new((3 * i + 5 * j) as f64 % 7.0 - 3.0, 0.1 * (i * j) as f64);
                band.add(i, j, if i == j { value + 20.0 } else { value });
            }
        }
        let right: Vec<_> = (0..size).map(|i| Complex::new(i as f64, 1.0)).collect();
        let mut found = right.clone();
        band.clone().factor().unwrap().solve(&mut found);
        for (one, other) in band.times(&found, |value, x| value * x).iter().zip(&right) {
            assert!((one - other).norm() < 1e-13, "{one} {other}");
        }
    }
}
