//! Polynomials of one element, over `x` from -1 to 1.

/// Points and weights of Gauss and Legendre's rule with `count` points over `x` from -1 to 1, exact for
/// polynomials of degree `2 count - 1`.
pub(crate) fn gauss(count: usize) -> Vec<[f64; 2]> {
    const MAX_ITERATIONS: usize = 20;
    let n = count as f64;
    let point = |k: usize| {
        let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..MAX_ITERATIONS {
            let [value, before] = legendre(count, x);
            slope = n * (before - x * value) / (1.0 - x * x);
            let step = value / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..count).map(point).collect()
}

/// Points and weights of Lobatto's rule with `degree + 1` points, ascending, both ends among them; exact for
/// polynomials of degree `2 degree - 1`.
pub(crate) fn lobatto(degree: usize) -> Vec<[f64; 2]> {
    const MAX_ITERATIONS: usize = 50;
    let n = degree as f64;
    let point = |k: usize| {
        // The inner points are the zeros of P_n'.
        let mut x = -(std::f64::consts::PI * k as f64 / n).cos();
        for _ in 0..MAX_ITERATIONS {
            if k == 0 || k == degree {
                break;
            }
            let [value, before] = legendre(degree, x);
            let slope = n * (before - x * value) / (1.0 - x * x);
            let step = slope * (1.0 - x * x) / (2.0 * x * slope - n * (n + 1.0) * value);
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        [x, 2.0 / (n * (n + 1.0) * legendre(degree, x)[0].powi(2))]
    };
    (0..=degree).map(point).collect()
}

/// Derivative by x of the polynomial through the values at Lobatto's points: row j holds, for the point j,
/// the share of each value.
pub(crate) fn lobatto_slopes(degree: usize) -> Vec<Vec<f64>> {
    let points = lobatto(degree);
    let value = |k: usize| legendre(degree, points[k][0])[0];
    let corner = 0.25 * (degree * (degree + 1)) as f64;
    let share = |j: usize, k: usize| match (j, k) {
        _ if j != k => value(j) / (value(k) * (points[j][0] - points[k][0])),
        (0, _) => -corner,
        _ if j == degree => corner,
        _ => 0.0,
    };
    (0..=degree).map(|j| (0..=degree).map(|k| share(j, k)).collect()).collect()
}

/// P_n and P_(n - 1) at x.
fn legendre(n: usize, x: f64) -> [f64; 2] {
    (0..n).fold([1.0, 0.0], |[value, before], k| {
        let k = k as f64;
        [((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0), value]
    })
}

/// The functions of an element of degree p at x, with their derivatives by `ξ = (x + 1)/2`: that which is one
/// at its beginning, that which is one at its end, and the bubbles N_k of k from 2 to p, zero at both,
///
/// ```text
/// N_k = (P_k - P_(k-2))/sqrt(2 (2k - 1)),      dN_k/dx = sqrt((2k - 1)/2) P_(k-1)                  (N1)
/// ```
pub(crate) fn functions(degree: usize, x: f64) -> Vec<[f64; 2]> {
    let mut found = vec![[0.5 * (1.0 - x), -1.0], [0.5 * (1.0 + x), 1.0]];
    let mut polynomials = [1.0, x];
    for k in 2..=degree {
        let [before, last] = polynomials;
        let order = k as f64;
        let next = ((2.0 * order - 1.0) * x * last - (order - 1.0) * before) / order;
        let odd = 2.0 * order - 1.0;
        found.push([(next - before) / (2.0 * odd).sqrt(), (2.0 * odd).sqrt() * last]);
        polynomials = [last, next];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_integrates_even_powers_exactly() {
        for count in [1, 2, 7, 40, 90] {
            for power in (0..2 * count as i32).step_by(2) {
                let sum: f64 = gauss(count).iter().map(|[x, weight]| weight * x.powi(power)).sum();
                assert!((sum - 2.0 / f64::from(power + 1)).abs() < 1e-13, "{count} {power} {sum}");
            }
        }
    }

    #[test]
    fn lobatto_integrates_and_differentiates_powers_exactly() {
        for degree in [1, 2, 3, 8, 16] {
            let (points, slopes) = (lobatto(degree), lobatto_slopes(degree));
            for power in 0..2 * degree as i32 {
                let sum: f64 = points.iter().map(|[x, weight]| weight * x.powi(power)).sum();
                let expected = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((sum - expected).abs() < 1e-13, "{degree} {power} {sum}");
                for ([x, _], row) in points.iter().zip(&slopes).filter(|_| power as usize <= degree) {
                    let slope: f64 = row.iter().zip(&points).map(|(d, [x, _])| d * x.powi(power)).sum();
                    let expected = if power == 0 { 0.0 } else { f64::from(power) * x.powi(power - 1) };
                    assert!((slope - expected).abs() < 1e-11, "{degree} {power} {slope} {expected}");
                }
            }
        }
    }

    #[test]
    fn derivatives_of_bubbles_are_orthogonal_and_bubbles_vanish_at_both_ends() {
        let degree = 12;
        for (k, [value, _]) in functions(degree, 1.0).into_iter().chain(functions(degree, -1.0)).enumerate() {
            assert!((value - f64::from(u8::from(k == 1 || k == degree + 1))).abs() < 1e-14);
        }
        for i in 2..=degree {
            for j in 2..=degree {
                let product: f64 = gauss(degree + 1)
                    .iter()
                    .map(|[x, weight]| {
                        let all = functions(degree, *x);
                        0.25 * weight * all[i][1] * all[j][1]
                    })
                    .sum();
                assert!((product - f64::from(u8::from(i == j))).abs() < 1e-13);
            }
        }
    }
}
