//! Steps for chains of straight elements of which some are slack. Those lose their tension and regain it so
//! often that no step of a high order could be long. The tensions alone are stiff and far from linear: they
//! are those at the middle of the step, (X6), with the directions that are expected there.
//!
//! ```text
//! q̂ = q + g v,    v⁺ = v + δ/θ,    q⁺ = q + h (v + δ),    g = θ h
//! ```
//!
//! With θ = 1/2 it is the midpoint rule.

use super::cable::CableInMotion;
use super::collocation::{Stalled, Work};
use super::links::Links;
use super::system::{Snapshot, System};
use cdpr_robot::Vector6;
use nalgebra::Matrix6;

/// A solution in progress.
pub(super) struct Midpoint {
    pub(super) time: f64,
    pub(super) state: Vec<f64>,
    /// The system within the last step.
    pub(super) at: Snapshot,
    slopes: Vec<f64>,
    /// What material that flows past adds to the rates.
    flow: Vec<f64>,
    stage: Vec<f64>,
    links: Vec<Links>,
    pub(super) work: Work,
}

/// What a step took and left: work of winches and forces, energy lost, and greatest kinetic energy [J].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spent {
    pub(super) given: f64,
    pub(super) lost: f64,
    pub(super) kinetic: f64,
}

/// θ.
const SHARE: f64 = 0.5;
/// Longest step, relative to 1/ω of the fastest motion of the platform, and to the time in which a wave
/// across a cable passes an element. Steps of a quarter of that move the platform otherwise by some tenth of
/// what half as many elements do.
const LONGEST: [f64; 2] = [0.08, 0.5];
const MOST_ITERATIONS: usize = 20;
/// Error of a tension, relative to the modulus, at which Newton's method ends.
const ACCURATE: f64 = 1e-9;

impl Midpoint {
    /// The solution from a state on, where the method serves.
    pub(super) fn new(system: &System, time: f64, state: &[f64]) -> Option<Self> {
        if system.cables.is_empty() || !system.cables.iter().all(CableInMotion::is_chain) {
            return None;
        }
        let n = state.len() / 2;
        let at = system.snapshot(time, state);
        let mut slopes = vec![0.0; state.len()];
        system.slopes_at(&at, state, &mut slopes);
        let flow = (0..n).map(|i| slopes[i] - state[n + i]).collect();
        let (state, stage) = (state.to_vec(), state.to_vec());
        let links = vec![Links::default(); system.cables.len()];
        let work = Work { evaluations: 1, ..Work::default() };
        Some(Self { time, state, at, slopes, flow, stage, links, work })
    }

    /// One step, not beyond `until` [s].
    pub(super) fn advance(&mut self, system: &mut System, until: f64) -> Result<Spent, Stalled> {
        let left = until - self.time;
        let h = left / (left / longest(system, &self.at) - 1e-9).ceil().max(1.0);
        let (g, n) = (SHARE * h, self.flow.len());
        for i in 0..n {
            self.stage[i] = self.state[i] + g * (self.state[n + i] + self.flow[i]);
            self.stage[n + i] = self.state[n + i];
        }
        system.look(self.time + g, &self.stage, &mut self.at);
        system.slopes_at(&self.at, &self.stage, &mut self.slopes);
        for i in 6..n {
            self.flow[i] = self.slopes[i] - self.stage[n + i];
        }
        self.pull(system, g);
        let mut sum = 0.0;
        for i in 0..n {
            let change = g * self.slopes[n + i];
            self.stage[n + i] += change;
            self.state[i] += h * (self.stage[n + i] + self.flow[i]);
            self.state[n + i] += change / SHARE;
            sum += self.state[i] + self.state[n + i];
        }
        if !sum.is_finite() {
            return Err(Stalled);
        }
        self.time += h;
        self.work.steps += 1;
        self.work.evaluations += 1;
        let kinetic = system.kinetic(&self.at, &self.stage);
        let [given, lost] = system.powers(&self.at, &self.stage).map(|power| h * power);
        system.turn(&mut self.state);
        Ok(Spent { given, lost, kinetic })
    }

    /// Adds to the accelerations what the changes of the tensions within the step do.
    fn pull(&mut self, system: &System, g: f64) {
        let n = self.flow.len();
        let motion = Vector6::from_column_slice(&self.slopes[n..n + 6]);
        let levers: Vec<_> = (0..self.links.len()).map(|k| self.at.cables[k].0.lever).collect();
        for (k, (cable, links)) in system.cables.iter().zip(&mut self.links).enumerate() {
            let [linear, turning] = [0, 3].map(|first| motion.fixed_rows::<3>(first).into_owned());
            let anchor = linear + turning.cross(&levers[k]);
            let own = &self.slopes[n + cable.first..][..cable.size()];
            links.prepare(cable, &self.at.cables[k].1, (own, &anchor), g);
        }
        let ways: Vec<Vector6<f64>> =
            self.links.iter().zip(&levers).map(|(links, lever)| system.way(&links.last(), lever)).collect();
        let mut faster = Vector6::zeros();
        for iteration in 0..MOST_ITERATIONS {
            let mut off = 0.0_f64;
            for (k, (cable, links)) in system.cables.iter().zip(&mut self.links).enumerate() {
                let own = system.own(cable, &self.stage);
                off = off.max(links.pull(cable, &self.at.cables[k].1, own, g));
            }
            if iteration > 0 && off < ACCURATE {
                break;
            }
            self.work.factorizations += 1;
            let (mut matrix, mut right): (Matrix6<f64>, Vector6<f64>) = (self.at.mass, Vector6::zeros());
            for (links, way) in self.links.iter_mut().zip(&ways) {
                let [tension, slope] = links.eliminate(g);
                matrix += way * way.transpose() * (g * slope);
                right -= way * (g * tension);
            }
            faster = matrix.cholesky().map_or_else(Vector6::zeros, |factors| factors.solve(&right));
            for (links, way) in self.links.iter_mut().zip(&ways) {
                links.solve(g, way.dot(&faster));
            }
        }
        for (k, (cable, links)) in system.cables.iter().zip(&self.links).enumerate() {
            let own = &mut self.slopes[n + cable.first..][..cable.size()];
            links.apply(cable, &mut self.at.cables[k].1, own, g);
        }
        (0..6).for_each(|k| self.slopes[n + k] += faster[k] / g);
    }
}

/// The longest step [s] that resolves the fastest motion of the platform, and waves across cables.
fn longest(system: &System, at: &Snapshot) -> f64 {
    let lightness = at.mass.cholesky().map_or_else(Matrix6::zeros, |factors| factors.inverse());
    let (mut stiffness, mut passing) = (Matrix6::zeros(), f64::INFINITY);
    for (cable, (end, at)) in system.cables.iter().zip(&at.cables) {
        let (Some(mesh), Some(last)) = (&cable.mesh, at.forces.pulls.last()) else { continue };
        let way = system.way(&last.along, &end.lever);
        let modulus = cable.material.cable.tangent_stiffness(last.elastic);
        stiffness += way * way.transpose() * (modulus / at.length.0);
        let most = at.forces.pulls.iter().map(|pull| pull.tension.abs()).fold(f64::MIN_POSITIVE, f64::max);
        let element = at.length.0 / mesh.elements() as f64;
        passing = passing.min(element * (cable.material.density / most).sqrt());
    }
    (LONGEST[0] / fastest(&(lightness * stiffness))).min(LONGEST[1] * passing)
}

/// A bound of the largest angular frequency, for squares that are the eigenvalues of a matrix: of their
/// eighth powers, the eighth root of the sum.
fn fastest(squares: &Matrix6<f64>) -> f64 {
    let scale = squares.trace();
    let scaled = squares / scale.max(f64::MIN_POSITIVE);
    let second = scaled * scaled;
    let fourth = second * second;
    (scale * fourth.component_mul(&fourth.transpose()).sum().powf(0.125)).sqrt()
}
