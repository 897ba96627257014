//! The quadratic program of a step of the tensions, one robot in each lane.
//!
//! With the gradient c, the curvature h and the slope J of the wrench of each cable, its step d minimises
//!
//! ```text
//! sum (c d + h d²/2),   sum J d + F = 0,   low <= d <= high                                          (L5)
//! ```
//!
//! Its dual in the multipliers λ is convex, with pieces of second degree: the step of a cable follows by
//!
//! ```text
//! d(λ) = -(c + J·λ)/h, but low or high beyond them,     G(λ) = F + sum J d(λ) = 0                   (L6)
//! ```
//!
//! Newton's method for G = 0 with an exact search along its direction ends after finitely many steps:
//! R. T. Rockafellar, *Monotone operators and the proximal point algorithm* (1976); J. S. Pang, L. Qi, *A
//! globally convergent Newton method for convex SC1 minimization problems* (1995).

use cdpr_number::dense::{Lanes2, Lanes6, SymmetricFactors};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::six;
use cdpr_number::vector::dot;

/// A cable in the program.
#[derive(Clone, Copy)]
pub(crate) struct Row<S: Simd> {
    /// J.
    pub(crate) slope: Lanes6<S>,
    /// 1/h.
    curvature_inv: Lanes<S>,
    /// -(c + J·λ)/h, the step without limits.
    pub(crate) wanted: Lanes<S>,
    /// J·dλ/h, by which a change of the multipliers lowers this step.
    pub(crate) change: Lanes<S>,
    /// The steps to the limits.
    pub(crate) ways: Lanes2<S>,
    /// Whether the step ends at either limit.
    pub(crate) sides: [Mask<S>; 2],
}

/// Elasticity of the balance, relative to the diagonal of its matrix: where cables at their limits leave too
/// few others, multipliers grow until one of them is set free.
const ELASTICITY: f64 = 1e-10;

const MAX_ITERATIONS: usize = 16;

impl<S: Simd> Row<S> {
    /// A cable of slope J, gradient c and 1/h, at the multipliers λ.
    #[inline(always)]
    pub(crate) fn new(
        slope: Lanes6<S>,
        gradient: Lanes<S>,
        curvature_inv: Lanes<S>,
        multipliers: &Lanes6<S>,
    ) -> Self {
        let zero = gradient.all(0.0);
        let none = !zero.less_or_equal(zero);
        let wanted = -((gradient + dot(&slope, multipliers)) * curvature_inv);
        Self { slope, curvature_inv, wanted, change: zero, ways: [zero; 2], sides: [none; 2] }
    }

    /// Prepares a change of the multipliers.
    #[inline(always)]
    pub(crate) fn raise(&mut self, step: &Lanes6<S>) {
        self.change = dot(&self.slope, step) * self.curvature_inv;
    }

    /// The step within the limits after `share` of the change.
    #[inline(always)]
    fn after(&self, share: Lanes<S>) -> Lanes<S> {
        let d = self.wanted - share * self.change;
        let d = self.ways[0].less_or_equal(d).select(d, self.ways[0]);
        d.less_or_equal(self.ways[1]).select(d, self.ways[1])
    }

    /// The step within the limits.
    #[inline(always)]
    fn value(&self) -> Lanes<S> {
        self.sides[0].select(self.ways[0], self.sides[1].select(self.ways[1], self.wanted))
    }

    /// The step that was found: within the limits in the lanes that are `bounded`.
    #[inline(always)]
    pub(crate) fn taken(&self, bounded: Mask<S>) -> Lanes<S> {
        bounded.select(self.value(), self.wanted - self.change)
    }

    /// The lanes in which a step lies beyond either limit.
    #[inline(always)]
    fn beyond(&self, d: Lanes<S>) -> [Mask<S>; 2] {
        let low = !self.ways[0].less_or_equal(d);
        [low, !low & !d.less_or_equal(self.ways[1])]
    }
}

/// Newton's step of the multipliers, in which the cables that are at no side change, and G before it.
// Indices as in the formula; iterators that skip would keep the matrix in memory.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
pub(crate) fn newton<S: Simd>(rows: &[Row<S>], balance: &Lanes6<S>) -> (Lanes6<S>, Lanes6<S>) {
    let zero = balance[0].all(0.0);
    let mut matrix = [[zero; 6]; 6];
    let mut right = *balance;
    for row in rows {
        let free_inv = (row.sides[0] | row.sides[1]).select(zero, row.curvature_inv);
        let d = row.value();
        for k in 0..6 {
            let c = row.slope[k] * free_inv;
            right[k] += row.slope[k] * d;
            for column in k..6 {
                matrix[k][column] += c * row.slope[column];
            }
        }
    }
    let forces = (matrix[0][0] + matrix[1][1] + matrix[2][2]) * ELASTICITY;
    // A point takes no moments at all: its rotations then do not change.
    let moments = (matrix[3][3] + matrix[4][4] + matrix[5][5]) * ELASTICITY + f64::MIN_POSITIVE;
    for k in 0..3 {
        matrix[k][k] += forces;
        matrix[3 + k][3 + k] += moments;
    }
    (SymmetricFactors::new(matrix).solve(&right), right)
}

/// Solves the program in the lanes that are `open`. Returns the change of the multipliers and the lanes in
/// which it was found.
#[inline(always)]
pub(crate) fn within_limits<S: Simd>(
    rows: &mut [Row<S>],
    balance: &Lanes6<S>,
    open: Mask<S>,
) -> (Lanes6<S>, Mask<S>) {
    let zero = balance[0].all(0.0);
    let mut raised = [zero; 6];
    let mut active = open;
    // Elsewhere steps end at no limit, and every one of them is the same again.
    for row in rows.iter_mut() {
        let [low, high] = row.beyond(row.wanted);
        row.sides = [open & low, open & high];
    }
    for _ in 0..MAX_ITERATIONS {
        let (step, before) = newton(rows, balance);
        let mut same = active;
        for row in rows.iter_mut() {
            row.raise(&step);
            let [low, high] = row.beyond(row.wanted - row.change);
            let [was_low, was_high] = row.sides;
            same = same & !((low & !was_low) | (!low & was_low) | (high & !was_high) | (!high & was_high));
        }
        let share = search(rows, &step, balance, -dot(&before, &step), same);
        let moving = active.select(share, zero);
        raised = six!(|k| raised[k] + step[k] * moving);
        for row in rows.iter_mut() {
            row.wanted -= row.change * moving;
            let [low, high] = row.beyond(row.wanted);
            row.sides = [
                (active & !same & low) | (!(active & !same) & row.sides[0]),
                (active & !same & high) | (!(active & !same) & row.sides[1]),
            ];
        }
        active = active & !same;
        if !active.any() {
            break;
        }
    }
    (raised, open & !active)
}

/// The share of a step at which the dual is least along it: all of it in lanes that are `whole`.
#[inline(always)]
fn search<S: Simd>(
    rows: &[Row<S>],
    step: &Lanes6<S>,
    balance: &Lanes6<S>,
    falling: Lanes<S>,
    whole: Mask<S>,
) -> Lanes<S> {
    let zero = falling.all(0.0);
    let one = zero.all(1.0);
    let constant = -dot(balance, step);
    let (mut near, mut far) = ([zero, falling], [one, slope_at(rows, step, constant, one)]);
    let overshot = !whole & !far[1].less_or_equal(zero);
    if !overshot.any() {
        return one;
    }
    for row in rows {
        for way in row.ways {
            let share = (row.wanted - way) / row.change;
            let inside = !share.less_or_equal(near[0]) & !far[0].less_or_equal(share);
            let inside = inside & share.less_or_equal(share);
            if inside.any() {
                let slope = slope_at(rows, step, constant, share);
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
fn slope_at<S: Simd>(rows: &[Row<S>], step: &Lanes6<S>, constant: Lanes<S>, share: Lanes<S>) -> Lanes<S> {
    let mut slope = constant;
    for row in rows {
        slope -= dot(&row.slope, step) * row.after(share);
    }
    slope
}
