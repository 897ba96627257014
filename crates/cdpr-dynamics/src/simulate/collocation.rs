//! Implicit methods with step control (E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*,
//! second edition, 1996, section IV.8), for motions whose Newton matrix has a structure of its own.

mod method;

pub(super) use method::Method;

use nalgebra::{Complex, ComplexField};

/// Equations of motion `y' = f(t, y)`.
pub(super) trait Equations {
    /// What Newton's method needs of f at a state.
    type Linearization: Linearization;
    /// What an evaluation leaves for the next one to write over.
    type Memory: Default;

    /// f at a time [s] and a state.
    fn slopes(&self, time: f64, state: &[f64], memory: &mut Self::Memory, slopes: &mut [f64]);

    /// The derivative of f by the state.
    fn linearize(&self, time: f64, state: &[f64]) -> Self::Linearization;

    /// The error of each component that is accepted.
    fn scale(&self) -> &[f64];
}

/// The derivative J of f, approximately.
pub(super) trait Linearization {
    /// Factors of `σ - J`.
    type Factors<T: ComplexField<RealField = f64> + Copy>;

    /// Factors of `σ - J`; `None` for a singular matrix.
    fn factor<T: ComplexField<RealField = f64> + Copy>(&self, shift: T) -> Option<Self::Factors<T>>;

    /// x of `(σ - J) x = right`.
    fn solve<T: ComplexField<RealField = f64> + Copy>(&self, by: &Self::Factors<T>, right: &[T]) -> Vec<T>;
}

const MOST_ITERATIONS: usize = 6;
/// Linearizations within a step before it is halved.
const MOST_LINEARIZATIONS: usize = 2;
/// Newton's method ends at this share of the error that is accepted.
const NEWTON_TOLERANCE: f64 = 0.01;
/// Newton's method is taken to converge as fast as when that was last seen, with this power for each step
/// since then.
const FORGETTING: f64 = 0.8;
const LEAST_FACTOR: f64 = 0.2;
const GREATEST_FACTOR: f64 = 8.0;
/// Shortest step, relative to the time that a solution has run [s].
const SHORTEST: f64 = 1e-13;

/// A solution in progress.
pub(super) struct Collocation<S: Equations> {
    pub(super) time: f64,
    pub(super) state: Vec<f64>,
    /// Step that the errors allow [s].
    step: f64,
    slopes: Vec<f64>,
    newton: Option<Newton<S::Linearization>>,
    is_current: bool,
    /// How fast the last Newton's method converged: the share of its last step that was left.
    left: f64,
    /// What the last evaluations left, at the stages and at the state.
    pub(super) memories: [S::Memory; 4],
    pub(super) method: &'static Method,
    /// The last step [s], its stages and its error.
    last: Option<(f64, [Vec<f64>; 3], f64)>,
    room: Room,
    pub(super) work: Work,
}

/// What a solution took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Steps that were accepted.
    pub steps: usize,
    /// Steps that were repeated.
    pub rejected: usize,
    /// Evaluations of the equations of motion.
    pub evaluations: usize,
    /// Factorizations of the matrices of Newton's method.
    pub factorizations: usize,
}

/// States of the three stages of a step, minus that at its begin.
type Stages = [Vec<f64>; 3];

/// The step [s] and the factors of its two matrices.
type Factors<L> = (f64, <L as Linearization>::Factors<f64>, <L as Linearization>::Factors<Complex<f64>>);

/// What iterations write over.
#[derive(Default)]
struct Room {
    state: Vec<f64>,
    slopes: Stages,
    transformed: Stages,
    right: Vec<f64>,
    complex: Vec<Complex<f64>>,
}

struct Newton<L: Linearization> {
    at: L,
    factors: Option<Factors<L>>,
}

/// A step that was accepted: its length [s] and the states of its three stages.
pub(super) struct Step {
    pub(super) length: f64,
    pub(super) stages: Stages,
}

/// No step is short enough.
pub(super) struct Stalled;

impl<S: Equations> Collocation<S> {
    pub(super) fn new(method: &'static Method, equations: &S, time: f64, state: Vec<f64>, step: f64) -> Self {
        let (mut memories, mut slopes): ([S::Memory; 4], _) = (Default::default(), vec![0.0; state.len()]);
        equations.slopes(time, &state, &mut memories[3], &mut slopes);
        let work = Work { evaluations: 1, ..Work::default() };
        let (newton, last, room) = (None, None, Room::default());
        let is_current = false;
        Self { time, state, step, slopes, newton, is_current, left: 1.0, memories, method, last, room, work }
    }

    /// One step, not beyond `until` [s].
    pub(super) fn advance(&mut self, equations: &S, until: f64) -> Result<Step, Stalled> {
        let mut was_rejected = false;
        let mut tried = None;
        let (mut linearized, mut has_failed) = (0, false);
        loop {
            let left = until - self.time;
            let h = left / (left / self.step - 1e-9).ceil().max(1.0);
            if h < SHORTEST * (1.0 + self.time.abs()) || !h.is_finite() {
                return Err(Stalled);
            }
            let Some(newton) = self.newton(equations, h) else {
                self.step = 0.5 * h;
                continue;
            };
            let start = tried.take().unwrap_or_else(|| self.guess(h));
            let (stages, iterations, rate) = match self.stages(equations, &newton, h, start) {
                Ok(solved) => solved,
                Err(last) => {
                    self.work.rejected += 1;
                    has_failed = true;
                    if let (Some(last), true) = (last, linearized < MOST_LINEARIZATIONS) {
                        linearized += 1;
                        self.newton = Some(self.linearized_at(equations, h, &last[1]));
                        tried = Some(last);
                    } else if self.is_current {
                        (self.step, linearized) = (0.5 * h, 0);
                        self.newton = Some(newton);
                    } else {
                        self.newton = None;
                    }
                    continue;
                }
            };
            let mut error = self.error(equations, &newton, &stages, h, false);
            if error > 1.0 && was_rejected {
                error = self.error(equations, &newton, &stages, h, true);
            }
            let most = MOST_ITERATIONS as f64;
            let safety = 0.9 * (2.0 * most + 1.0) / (2.0 * most + iterations as f64);
            let factor = safety * self.factor(h, error);
            if error.is_nan() || error > 1.0 {
                self.step = h * if error.is_nan() { LEAST_FACTOR } else { factor.max(LEAST_FACTOR) };
                self.newton = Some(newton);
                self.work.rejected += 1;
                was_rejected = true;
                continue;
            }
            let renew = iterations > 2 && rate > 1e-3;
            self.newton = (!renew).then_some(newton);
            self.is_current = false;
            if renew || !(0.9..=1.2).contains(&factor) {
                // A step that was tried again is not followed by a longer one.
                self.step = h * factor.min(if has_failed || was_rejected { 1.0 } else { GREATEST_FACTOR });
            }
            return Ok(self.accept(equations, h, stages, error));
        }
    }

    fn accept(&mut self, equations: &S, h: f64, stages: Stages, error: f64) -> Step {
        let at = |k: usize| self.state.iter().zip(&stages[k]).map(|(y, z)| y + z).collect();
        let step = Step { length: h, stages: [at(0), at(1), at(2)] };
        self.time += h;
        let end = self.method.end();
        for (i, y) in self.state.iter_mut().enumerate() {
            *y += end[0] * stages[0][i] + end[1] * stages[1][i] + end[2] * stages[2][i];
        }
        equations.slopes(self.time, &self.state, &mut self.memories[3], &mut self.slopes);
        self.last = Some((h, stages, error));
        self.work.steps += 1;
        self.work.evaluations += 1;
        step
    }

    /// The linearization with the factors for a step, the ones at hand where they serve.
    fn newton(&mut self, equations: &S, h: f64) -> Option<Newton<S::Linearization>> {
        let mut newton = self.newton.take().unwrap_or_else(|| {
            self.is_current = true;
            Newton { at: equations.linearize(self.time, &self.state), factors: None }
        });
        let serves = newton.factors.as_ref().is_some_and(|(at, ..)| (at / h - 1.0).abs() < 1e-6);
        if !serves {
            self.work.factorizations += 1;
            let real = newton.at.factor(self.method.real / h)?;
            newton.factors = Some((h, real, newton.at.factor(self.method.complex / h)?));
        }
        Some(newton)
    }

    /// The stages minus the state, the iterations and their rate; the last stages where they do not
    /// converge.
    fn stages(
        &mut self,
        equations: &S,
        newton: &Newton<S::Linearization>,
        h: f64,
        mut z: Stages,
    ) -> Result<(Stages, usize, f64), Option<Stages>> {
        let (n, scale, method) = (self.state.len(), equations.scale(), self.method);
        let Some((_, real, complex)) = &newton.factors else { return Err(None) };
        let mut w = Stages::default();
        combine(&method.from_stages, &z, &mut w);
        let (mut before, mut rate) = (None, 0.0_f64);
        let Room { state, slopes, transformed, right, complex: both } = &mut self.room;
        for slopes in slopes.iter_mut() {
            slopes.resize(n, 0.0);
        }
        for iteration in 1..=MOST_ITERATIONS {
            for k in 0..3 {
                state.clear();
                state.extend(self.state.iter().zip(&z[k]).map(|(y, z)| y + z));
                let time = self.time + method.stages[k] * h;
                equations.slopes(time, state, &mut self.memories[k], &mut slopes[k]);
            }
            self.work.evaluations += 3;
            if slopes.iter().flatten().any(|slope| !slope.is_finite()) {
                return Err(None);
            }
            combine(&method.from_stages, slopes, transformed);
            let [first, second, third] = &*transformed;
            right.clear();
            right.extend(first.iter().zip(&w[0]).map(|(slope, w)| slope - method.real / h * w));
            let by = method.complex / h;
            both.clear();
            both.extend(
                (0..n).map(|i| Complex::new(second[i], third[i]) - by * Complex::new(w[1][i], w[2][i])),
            );
            let first = newton.at.solve(real, right);
            let others = newton.at.solve(complex, both);
            let mut square = 0.0;
            for i in 0..n {
                let share = 1.0 / scale[i];
                square += share * share * (first[i] * first[i] + others[i].norm_sqr());
                w[0][i] += first[i];
                w[1][i] += others[i].re;
                w[2][i] += others[i].im;
            }
            let norm = (square / (3 * n) as f64).sqrt();
            combine(&method.to_stages, &w, &mut z);
            if let Some(before) = before {
                rate = norm / before;
                let more = (MOST_ITERATIONS - iteration) as i32;
                if rate.is_nan()
                    || rate >= 1.0
                    || f64::powi(rate, more) / (1.0 - rate) * norm > NEWTON_TOLERANCE
                {
                    return Err(norm.is_finite().then_some(z));
                }
                self.left = rate / (1.0 - rate);
            } else if !norm.is_finite() {
                return Err(None);
            } else {
                self.left = self.left.max(f64::EPSILON).powf(FORGETTING);
            }
            if self.left * norm < NEWTON_TOLERANCE {
                return Ok((z, iteration, rate));
            }
            before = Some(norm);
        }
        Err(Some(z))
    }

    /// The linearization where Newton's method came to, at the second of its stages: where cables go slack or
    /// taut within a step, that at its begin does not serve.
    fn linearized_at(&mut self, equations: &S, h: f64, stage: &[f64]) -> Newton<S::Linearization> {
        self.is_current = true;
        let state: Vec<f64> = self.state.iter().zip(stage).map(|(y, z)| y + z).collect();
        Newton { at: equations.linearize(self.time + self.method.stages[1] * h, &state), factors: None }
    }

    /// Where the polynomial of the last step leads.
    fn guess(&self, h: f64) -> Stages {
        let n = self.state.len();
        let Some((last, stages, _)) = &self.last else { return std::array::from_fn(|_| vec![0.0; n]) };
        let share = |k: usize, x: f64| {
            let [one, two, three] = self.method.polynomial[k];
            x * (one + x * (two + x * three))
        };
        std::array::from_fn(|to| {
            let x = 1.0 + self.method.stages[to] * h / last;
            let shares: [f64; 3] = std::array::from_fn(|k| share(k, x) - share(k, 1.0));
            (0..n).map(|i| (0..3).map(|k| shares[k] * stages[k][i]).sum()).collect()
        })
    }

    /// Root mean square of the error estimate, relative to what is accepted.
    fn error(
        &mut self,
        equations: &S,
        newton: &Newton<S::Linearization>,
        stages: &[Vec<f64>; 3],
        h: f64,
        again: bool,
    ) -> f64 {
        let n = self.state.len();
        let Some((_, real, _)) = &newton.factors else { return f64::NAN };
        let begin = self.method.polynomial.map(|shares| shares[0] / h);
        let sum = |i: usize| -(0..3).map(|k| begin[k] * stages[k][i]).sum::<f64>();
        let right: Vec<f64> = (0..n).map(|i| self.slopes[i] + sum(i)).collect();
        let mut error = newton.at.solve(real, &right);
        if again {
            let state: Vec<f64> = self.state.iter().zip(&error).map(|(y, e)| y + e).collect();
            let mut slopes = vec![0.0; n];
            equations.slopes(self.time, &state, &mut self.memories[3], &mut slopes);
            self.work.evaluations += 1;
            let right: Vec<f64> = (0..n).map(|i| slopes[i] + sum(i)).collect();
            error = newton.at.solve(real, &right);
        }
        let squares = error.iter().zip(equations.scale()).map(|(error, scale)| (error / scale).powi(2));
        (squares.sum::<f64>() / n as f64).sqrt()
    }

    /// By how much the step may change (K. Gustafsson's predictive control).
    fn factor(&self, h: f64, error: f64) -> f64 {
        let error = error.max(1e-10);
        let predicted = self
            .last
            .as_ref()
            .map_or(1.0, |(last, _, before)| h / last * (before.max(1e-10) / error).powf(0.25));
        predicted.min(1.0) * error.powf(-0.25)
    }
}

/// Linear combinations of three vectors.
fn combine(matrix: &[[f64; 3]; 3], parts: &Stages, sums: &mut Stages) {
    let [one, two, three] = parts;
    for (sum, [a, b, c]) in sums.iter_mut().zip(matrix) {
        sum.clear();
        sum.extend(one.iter().zip(two).zip(three).map(|((one, two), three)| a * one + b * two + c * three));
    }
}
