//! Quadratic programs with a diagonal Hessian, bounds and six equations, by their dual, one in each lane.
//!
//! ```text
//! minimize  sum (c_i d_i + h_i d_i²/2)   subject to   J d + F = 0,   l_i <= d_i <= u_i             (T4)
//! ```
//!
//! The dual has six unknowns λ, however many unknowns d there are: for given λ each d_i is alone,
//!
//! ```text
//! d_i(λ) = -(c_i + J_i·λ)/h_i, but l_i or u_i beyond them,      g(λ) = J d(λ) + F = 0              (T5)
//! ```
//!
//! and g is the gradient of a concave function, quadratic between the points at which a bound becomes
//! active. Newton's method with an exact search along its direction ends after finitely many steps (J. S.
//! Pang, L. Qi, *A globally convergent Newton method for convex SC1 minimization problems*, 1995). Its
//! matrix is `sum J_i J_iᵀ/h_i` over the unknowns within their bounds, plus a small elasticity (R. T.
//! Rockafellar, *Monotone operators and the proximal point algorithm*, 1976). Where bounds leave too few
//! unknowns for the equations, multipliers grow until one of them is free, or, where no d solves the
//! equations, until the residual is nearly the least.
//!
//! [`BoxProblem`] is one program in doubles. Programs in lanes are [`BoundedUnknown`]s, each lane with a
//! problem of its own: no other lane changes its digits.

use cdpr_number::dense::{Lanes2, Lanes6, Lanes6x6, SymmetricFactors};
use cdpr_number::lanes::{Lanes, Mask, Scalar, Simd};
use cdpr_number::vector::dot;
use cdpr_number::{Number, six};
use nalgebra::Vector6;

/// One unknown of the program (T4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxUnknown {
    /// Gradient c_i.
    pub gradient: f64,
    /// Element h_i of the Hessian, positive.
    pub curvature: f64,
    /// Column J_i.
    pub column: Vector6<f64>,
    /// Least and greatest value.
    pub bounds: [f64; 2],
}

/// The program (T4).
#[derive(Clone, Copy, Debug)]
pub struct BoxProblem<'a> {
    /// The unknowns.
    pub unknowns: &'a [BoxUnknown],
    /// F.
    pub residual: Vector6<f64>,
    /// λ where Newton's method starts.
    pub multipliers: Vector6<f64>,
}

/// The solution of a [`BoxProblem`]; of an infeasible one the point within the bounds that comes nearest to
/// one.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxSolution {
    /// d.
    pub values: Vec<f64>,
    /// λ.
    pub multipliers: Vector6<f64>,
}

impl BoxProblem<'_> {
    /// The solution.
    pub fn solve(&self) -> BoxSolution {
        const MAX_ITERATIONS: usize = 100;
        let all = |value: f64| Lanes::splat(Scalar, value);
        let (balance, start) = (six!(|k| all(self.residual[k])), six!(|k| all(self.multipliers[k])));
        let each = self.unknowns.iter().map(|unknown| {
            let column = six!(|k| all(unknown.column[k]));
            let curvature_inv = all(unknown.curvature).recip();
            let free = BoundedUnknown::new(column, all(unknown.gradient), curvature_inv, &start);
            BoundedUnknown { bounds: unknown.bounds.map(all), ..free }
        });
        let mut unknowns: Vec<_> = each.collect();
        let everywhere = balance[0].less_or_equal(balance[0]);
        let (change, _) = solve_within_bounds(&mut unknowns, &balance, everywhere, MAX_ITERATIONS);
        BoxSolution {
            values: unknowns.iter().map(|unknown| unknown.value().first()).collect(),
            multipliers: self.multipliers + Vector6::from(six!(|k| change[k].first())),
        }
    }
}

/// One unknown of a program in each lane, as a function (T5) of the multipliers.
#[derive(Clone, Copy)]
pub struct BoundedUnknown<S: Simd> {
    /// Column J.
    pub column: Lanes6<S>,
    /// 1/h.
    curvature_inv: Lanes<S>,
    /// -(c + J·λ)/h, the value without bounds.
    pub free: Lanes<S>,
    /// J·dλ/h, by which a change of the multipliers lowers this value.
    pub change: Lanes<S>,
    /// Least and greatest value.
    pub bounds: Lanes2<S>,
    /// The lanes in which either bound is active.
    pub active: [Mask<S>; 2],
}

/// Elasticity of the equations, relative to the diagonal of their matrix with all unknowns free.
const ELASTICITY: f64 = 1e-10;

impl<S: Simd> BoundedUnknown<S> {
    /// An unknown of column J, gradient c and 1/h, at the multipliers λ; its bounds are still to be set.
    #[inline(always)]
    pub fn new(
        column: Lanes6<S>,
        gradient: Lanes<S>,
        curvature_inv: Lanes<S>,
        multipliers: &Lanes6<S>,
    ) -> Self {
        let zero = gradient.all(0.0);
        let never = !zero.less_or_equal(zero);
        let free = -((gradient + dot(&column, multipliers)) * curvature_inv);
        Self { column, curvature_inv, free, change: zero, bounds: [zero; 2], active: [never; 2] }
    }

    /// Prepares a change of the multipliers.
    #[inline(always)]
    pub fn prepare(&mut self, step: &Lanes6<S>) {
        self.change = dot(&self.column, step) * self.curvature_inv;
    }

    /// The value within the bounds after `share` of the change.
    #[inline(always)]
    fn after(&self, share: Lanes<S>) -> Lanes<S> {
        let d = self.free - share * self.change;
        let d = self.bounds[0].less_or_equal(d).select(d, self.bounds[0]);
        d.less_or_equal(self.bounds[1]).select(d, self.bounds[1])
    }

    /// The value within the bounds.
    #[inline(always)]
    fn value(&self) -> Lanes<S> {
        self.active[0].select(self.bounds[0], self.active[1].select(self.bounds[1], self.free))
    }

    /// The value that was found: within the bounds in the lanes that are `bounded`, after the change in the
    /// others.
    #[inline(always)]
    pub fn solution(&self, bounded: Mask<S>) -> Lanes<S> {
        bounded.select(self.value(), self.free - self.change)
    }

    /// The lanes in which a value lies beyond either bound.
    #[inline(always)]
    fn beyond(&self, d: Lanes<S>) -> [Mask<S>; 2] {
        let low = !self.bounds[0].less_or_equal(d);
        [low, !low & !d.less_or_equal(self.bounds[1])]
    }
}

/// Newton's step of the multipliers where no bound is active.
#[inline(always)]
pub fn unbounded_step<S: Simd>(unknowns: &[BoundedUnknown<S>], balance: &Lanes6<S>) -> Lanes6<S> {
    let (matrix, gradient) = normal_equations(unknowns, balance);
    let elasticity = elasticity(&six!(|k| matrix[k][k]));
    elastic_step(matrix, &gradient, &elasticity)
}

/// The matrix of Newton's method, its upper triangle, and g.
// Indices as in the formula; iterators that skip would keep the matrix in memory.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
fn normal_equations<S: Simd>(
    unknowns: &[BoundedUnknown<S>],
    balance: &Lanes6<S>,
) -> (Lanes6x6<S>, Lanes6<S>) {
    let zero = balance[0].all(0.0);
    let mut matrix = [[zero; 6]; 6];
    let mut gradient = *balance;
    for unknown in unknowns {
        let free_inv = (unknown.active[0] | unknown.active[1]).select(zero, unknown.curvature_inv);
        let d = unknown.value();
        for k in 0..6 {
            let c = unknown.column[k] * free_inv;
            gradient[k] += unknown.column[k] * d;
            for column in k..6 {
                matrix[k][column] += c * unknown.column[column];
            }
        }
    }
    (matrix, gradient)
}

/// Elasticity of the forces and of the moments, by the diagonal of the matrix with all unknowns free.
#[inline(always)]
fn elasticity<S: Simd>(diagonal: &Lanes6<S>) -> Lanes2<S> {
    // A point takes no moments at all: its rotations then do not change.
    let [x, y, z, mx, my, mz] = *diagonal;
    [(x + y + z) * ELASTICITY, (mx + my + mz) * ELASTICITY + f64::MIN_POSITIVE]
}

// Indices as in the formula.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
fn elastic_step<S: Simd>(mut matrix: Lanes6x6<S>, gradient: &Lanes6<S>, elasticity: &Lanes2<S>) -> Lanes6<S> {
    for k in 0..3 {
        matrix[k][k] += elasticity[0];
        matrix[3 + k][3 + k] += elasticity[1];
    }
    SymmetricFactors::new(matrix).solve(gradient)
}

/// Solves the program in the lanes that are `open`, in at most this many iterations. Returns the change of
/// the multipliers and the lanes in which the solution was found.
#[inline(always)]
// Loops over arrays by value take the compiler minutes.
#[allow(clippy::needless_range_loop)]
pub fn solve_within_bounds<S: Simd>(
    unknowns: &mut [BoundedUnknown<S>],
    balance: &Lanes6<S>,
    open: Mask<S>,
    max_iterations: usize,
) -> (Lanes6<S>, Mask<S>) {
    let zero = balance[0].all(0.0);
    let mut raised = [zero; 6];
    let mut going = open;
    let mut diagonal = [zero; 6];
    for unknown in unknowns.iter_mut() {
        for k in 0..6 {
            diagonal[k] += unknown.column[k] * unknown.curvature_inv * unknown.column[k];
        }
        // Elsewhere no bound is active, and every step is the same again.
        let [low, high] = unknown.beyond(unknown.free);
        unknown.active = [open & low, open & high];
    }
    let elasticity = elasticity(&diagonal);
    for _ in 0..max_iterations {
        let (matrix, gradient) = normal_equations(unknowns, balance);
        let step = elastic_step(matrix, &gradient, &elasticity);
        let mut same = going;
        for unknown in unknowns.iter_mut() {
            unknown.prepare(&step);
            let [low, high] = unknown.beyond(unknown.free - unknown.change);
            let [was_low, was_high] = unknown.active;
            same = same & !((low & !was_low) | (!low & was_low) | (high & !was_high) | (!high & was_high));
        }
        let share = search(unknowns, &step, balance, -dot(&gradient, &step), same);
        let moving = going.select(share, zero);
        raised = six!(|k| raised[k] + step[k] * moving);
        for unknown in unknowns.iter_mut() {
            unknown.free -= unknown.change * moving;
            let [low, high] = unknown.beyond(unknown.free);
            unknown.active = [
                (going & !same & low) | (!(going & !same) & unknown.active[0]),
                (going & !same & high) | (!(going & !same) & unknown.active[1]),
            ];
        }
        going = going & !same;
        if !going.any() {
            break;
        }
    }
    (raised, open & !going)
}

/// The share of a step at which the dual is least along it: all of it in lanes that are `whole`.
#[inline(always)]
fn search<S: Simd>(
    unknowns: &[BoundedUnknown<S>],
    step: &Lanes6<S>,
    balance: &Lanes6<S>,
    falling: Lanes<S>,
    whole: Mask<S>,
) -> Lanes<S> {
    let zero = falling.all(0.0);
    let one = zero.all(1.0);
    let constant = -dot(balance, step);
    let (mut near, mut far) = ([zero, falling], [one, slope_at(unknowns, step, constant, one)]);
    let overshot = !whole & !far[1].less_or_equal(zero);
    if !overshot.any() {
        return one;
    }
    for unknown in unknowns {
        for bound in unknown.bounds {
            let share = (unknown.free - bound) / unknown.change;
            let inside = !share.less_or_equal(near[0]) & !far[0].less_or_equal(share);
            let inside = inside & share.less_or_equal(share);
            if inside.any() {
                let slope = slope_at(unknowns, step, constant, share);
                let falls = slope.less_or_equal(zero);
                let (nearer, farther) = (inside & falls, inside & !falls);
                near = [nearer.select(share, near[0]), nearer.select(slope, near[1])];
                far = [farther.select(share, far[0]), farther.select(slope, far[1])];
            }
        }
    }
    let between = near[0] - (far[0] - near[0]) * near[1] / (far[1] - near[1]);
    overshot.select(between, one)
}

/// Derivative of the dual along a step, after a share of it.
#[inline(always)]
fn slope_at<S: Simd>(
    unknowns: &[BoundedUnknown<S>],
    step: &Lanes6<S>,
    constant: Lanes<S>,
    share: Lanes<S>,
) -> Lanes<S> {
    let mut slope = constant;
    for unknown in unknowns {
        slope -= dot(&unknown.column, step) * unknown.after(share);
    }
    slope
}
