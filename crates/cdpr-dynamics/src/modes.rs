//! Natural motions of platform and cables together.
//!
//! The unknowns are the motion v of the platform and amplitudes q_k of motions of the cables with held ends:
//!
//! ```text
//! [ K  0  ]          [ M  C ]
//! [ 0  Ω² ] x = ω²   [ Cᵀ 1 ] x,      x = (v, q)                                                   (N6)
//! ```
//!
//! The slow ones are taken as they are, a few replace the others, (N5). Counts by Wittrick and Williams with
//! all motions of the cables bracket every frequency; bisection finds those that they do not confirm.

pub(crate) mod swing;

use crate::cable::HeldMode;
use crate::dense::{cholesky, eigenvectors};
use crate::error::{DynamicsError, positive};
use crate::free::Rotor;
use crate::platform::MovingPlatform;
use cdpr_robot::{Robot, Vector3};
use cdpr_statics::vibration::NaturalMode;
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, Vector6, WantedPose, inverse};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Which natural motions are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// All up to a frequency [Hz].
    Below(f64),
    /// This many, the slowest.
    Number(usize),
    /// All up to twice the lowest frequency on cables without mass, or further up to the first one.
    OfPlatform,
}

/// A natural motion of platform and cables, of unit mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Natural frequency [Hz]; zero of a motion that nothing resists.
    pub frequency: f64,
    /// Greatest error of the frequency, relative to it, that the counts leave.
    pub within: f64,
    /// Translation of P [1/√kg].
    pub translation: Vector3<f64>,
    /// Rotation vector of the platform [rad/(m √kg)], in the base frame.
    pub rotation: Vector3<f64>,
    /// Share of platform and payload in the kinetic energy.
    pub platform_share: f64,
    /// Share of each cable; all shares together are one.
    pub cable_shares: Vec<f64>,
    /// Part of the platform's share that is its slowest motion on cables without mass.
    pub swing_share: f64,
}

/// Natural motions of a robot about an equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// The motions, the slowest first.
    pub modes: Vec<Mode>,
    /// The frequency up to which none is missing [Hz].
    pub complete_below: f64,
    /// How many there are below it, as the counts say: as many as are listed.
    pub counted: usize,
    /// The equilibrium.
    pub equilibrium: Equilibrium,
    /// Unstrained lengths [m].
    pub lengths: Vec<f64>,
}

/// Relative distances at which counts confirm a frequency.
const WITHIN: [f64; 3] = [1e-6, 1e-5, 1e-4];

/// Share of the greatest ω² below which one is rounding.
const ROUNDING: f64 = 1e-13;

impl Modes {
    /// Natural motions about a stable equilibrium, on winches that hold.
    ///
    /// # Errors
    /// [`DynamicsError::Invalid`] for a frequency or number that is not positive and finite;
    /// [`DynamicsError::Folded`] for a cable without tension at a point; [`DynamicsError::NotStable`] and
    /// [`DynamicsError::Statics`] for a state that is no stable equilibrium, and for a robot that rotates
    /// without `platform.inertia`.
    pub fn new(
        problem: &DirectProblem,
        equilibrium: &Equilibrium,
        wanted: Wanted,
    ) -> Result<Self, DynamicsError> {
        Self::on_winches(problem, equilibrium, wanted, None)
    }

    /// The same on winches with rotors, if there are any: the share of a cable contains that of its rotor.
    ///
    /// # Errors
    /// As [`Modes::new`] and [`MovingPlatform::on_winches`].
    pub fn on_winches(
        problem: &DirectProblem,
        equilibrium: &Equilibrium,
        wanted: Wanted,
        winches: Option<Rotor>,
    ) -> Result<Self, DynamicsError> {
        let about = About { problem, equilibrium, winches };
        // Those on cables without mass refuse unstable equilibria, and show which motions nothing resists.
        let massless = problem.modes(equilibrium)?;
        let neutral = massless.iter().filter(|mode| mode.frequency == 0.0).count();
        let slowest = massless.get(neutral).map(|mode| mode.frequency);
        let swings = swings(&massless[neutral..]);
        let (platform, bound, number) = match wanted {
            Wanted::Below(bound) => (about.platform(bound)?, bound, None),
            Wanted::OfPlatform => {
                let (platform, bound) = about.near_platform(neutral, slowest)?;
                (platform, bound, None)
            }
            Wanted::Number(number) => {
                positive("number of motions", number as f64, "one at least")?;
                let (platform, bound) = about.reach(number, slowest)?;
                (platform, bound, Some(number))
            }
        };
        let counted = platform.count(bound);
        let mut modes = platform.modes(counted, neutral, &swings)?;
        let (mut counted, mut complete_below) = (counted, bound);
        if let Some(number) = number.filter(|number| *number < counted) {
            complete_below = 0.5 * (modes[number - 1].frequency + modes[number].frequency);
            modes.truncate(number);
            counted = number;
        }
        let (equilibrium, lengths) = (equilibrium.clone(), problem.lengths().to_vec());
        Ok(Self { modes, complete_below, counted, equilibrium, lengths })
    }

    /// Those at a wanted pose under the platform's weight and `load`, on winches with rotors or without.
    ///
    /// # Errors
    /// Those of [`cdpr_statics::inverse`] and of [`Modes::on_winches`].
    pub fn at<'a>(
        robot: &Robot,
        pose: impl Into<WantedPose<'a>>,
        load: &Load,
        wanted: Wanted,
        winches: Option<Rotor>,
    ) -> Result<Self, DynamicsError> {
        let found = inverse(robot, pose.into(), load)?;
        let problem = DirectProblem::new(robot, &found.lengths, load)?;
        let rest = problem.direct(DirectStart::Near(&found.equilibrium))?;
        Self::on_winches(&problem, &rest.equilibrium, wanted, winches)
    }

    /// The slowest motion that something resists.
    pub fn lowest(&self) -> Option<&Mode> {
        self.modes.iter().find(|mode| mode.frequency > 0.0)
    }

    /// The slowest motion that something resists, and a few more.
    ///
    /// # Errors
    /// As [`Modes::new`].
    pub fn slowest(problem: &DirectProblem, equilibrium: &Equilibrium) -> Result<Self, DynamicsError> {
        let first = Self::new(problem, equilibrium, Wanted::Number(2))?;
        if first.lowest().is_some() { Ok(first) } else { Self::new(problem, equilibrium, Wanted::OfPlatform) }
    }

    /// How the platform swings: the motion that contains most of its slowest one on cables without mass.
    pub fn of_platform(&self) -> Option<&Mode> {
        self.modes.get(self.number_of_platform()?)
    }

    /// Its place among the motions.
    pub(crate) fn number_of_platform(&self) -> Option<usize> {
        let shares = self.modes.iter().enumerate().filter(|(_, mode)| mode.frequency > 0.0);
        let shares = shares.map(|(k, mode)| (k, mode.swing_share));
        Some(shares.max_by(|one, other| one.1.total_cmp(&other.1))?.0)
    }
}

/// The natural motions of a robot at a wanted pose under the platform's weight and `load`.
///
/// # Errors
/// Those of [`cdpr_statics::inverse`] and of [`Modes::new`].
pub fn modes_at<'a>(
    robot: &Robot,
    pose: impl Into<WantedPose<'a>>,
    load: &Load,
    wanted: Wanted,
) -> Result<Modes, DynamicsError> {
    Modes::at(robot, pose, load, wanted, None)
}

/// The slowest of the motions on cables without mass, and those that are as slow.
fn swings(massless: &[NaturalMode]) -> Vec<Vector6<f64>> {
    /// Relative distance of frequencies that are one for a symmetric robot.
    const SAME: f64 = 1e-3;
    let slowest = massless.first().map_or(0.0, |mode| mode.frequency);
    let same = massless.iter().take_while(|mode| mode.frequency <= (1.0 + SAME) * slowest);
    same.map(|mode| Vector6::from_iterator(mode.translation.iter().chain(&mode.rotation).copied())).collect()
}

/// What vibrates: a platform about an equilibrium, and the rotors of its winches.
struct About<'a> {
    problem: &'a DirectProblem<'a>,
    equilibrium: &'a Equilibrium,
    winches: Option<Rotor>,
}

impl About<'_> {
    /// Platform and cables for frequencies up to a bound [Hz].
    fn platform(&self, bound: f64) -> Result<MovingPlatform, DynamicsError> {
        MovingPlatform::on_winches(self.problem, self.equilibrium, bound, self.winches)
    }

    /// A platform, and a bound [Hz] beyond its `neutral` motions: twice the lowest one without cables' mass.
    fn near_platform(
        &self,
        neutral: usize,
        slowest: Option<f64>,
    ) -> Result<(MovingPlatform, f64), DynamicsError> {
        const REACH: f64 = 2.0;
        let Some(slowest) = slowest else { return self.reach(neutral + 1, None) };
        let bound = REACH * slowest;
        let platform = self.platform(bound)?;
        if platform.count(bound) > neutral {
            return Ok((platform, bound));
        }
        self.reach(neutral + 1, Some(slowest))
    }

    /// A platform, and a frequency [Hz] below which it has `number` natural motions at least.
    fn reach(&self, number: usize, slowest: Option<f64>) -> Result<(MovingPlatform, f64), DynamicsError> {
        /// Motions beyond the wanted ones that are accepted.
        const SPARE: usize = 8;
        let cables = self.problem.cable_frequencies(self.equilibrium)?;
        let first = cables.into_iter().chain([slowest]).flatten().fold(f64::INFINITY, f64::min);
        let mut bound = if first.is_finite() { 2.0 * first } else { 1.0 };
        let mut below = 0.0;
        let mut platform = self.platform(bound)?;
        while platform.count(bound) < number {
            let faster = platform.cables.iter().any(|cable| !cable.modes.is_empty());
            if !faster && platform.count(f64::MAX.sqrt() / TAU) < number {
                bound = platform.above_all();
                break;
            }
            below = bound;
            bound *= 1.5;
            platform = self.platform(bound)?;
        }
        // No more than are wanted, and a few.
        for _ in 0..20 {
            if platform.count(bound) <= number + SPARE {
                break;
            }
            let middle = 0.5 * (below + bound);
            if platform.count(middle) > number { bound = middle } else { below = middle }
        }
        Ok((platform, bound))
    }
}

impl MovingPlatform {
    /// A frequency above all of a platform on cables without mass [Hz].
    fn above_all(&self) -> f64 {
        let mut bound = 1.0;
        while self.count(bound) < self.free.len() && bound < 1e9 {
            bound *= 2.0;
        }
        bound
    }

    /// The `count` slowest natural motions; the first ones, `neutral`, are those that nothing resists.
    fn modes(
        &self,
        count: usize,
        neutral: usize,
        swings: &[Vector6<f64>],
    ) -> Result<Vec<Mode>, DynamicsError> {
        let cables = self.cables.iter().enumerate();
        let kept: Vec<(usize, &HeldMode)> =
            cables.flat_map(|(i, cable)| cable.reduced.iter().map(move |mode| (i, mode))).collect();
        let reduced = Reduced::new(self, &kept)?;
        let mode = |k: usize| {
            let (v, q) = reduced.motion(k);
            let frequency = reduced.squares[k].max(0.0).sqrt() / TAU;
            let frequency = if k < neutral { (0.0, 0.0) } else { self.confirm(k, frequency) };
            let swing_share = swings.iter().map(|swing| (swing.transpose() * self.mass * v)[0].powi(2)).sum();
            Mode { swing_share, ..self.mode(frequency, &v, &q, &kept) }
        };
        Ok((0..count.min(reduced.squares.len())).map(mode).collect())
    }

    /// The frequency with the index k [Hz], by counts: the given one and how near it is, or that which
    /// bisection finds.
    fn confirm(&self, k: usize, frequency: f64) -> (f64, f64) {
        const NARROWEST: f64 = 1e-9;
        let is_below = |frequency: f64| self.count(frequency) > k;
        for within in WITHIN {
            if !is_below(frequency * (1.0 - within)) && is_below(frequency * (1.0 + within)) {
                return (frequency, within);
            }
        }
        let (mut low, mut high) = (frequency, frequency);
        while low > 0.0 && is_below(low) {
            low = if low > 1e-6 { 0.9 * low } else { 0.0 };
        }
        while !is_below(high) && high < 1e12 {
            high = (1.1 * high).max(1e-6);
        }
        while high - low > NARROWEST * high {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if is_below(middle) { high = middle } else { low = middle }
        }
        (0.5 * (low + high), NARROWEST)
    }

    fn mode(
        &self,
        (frequency, within): (f64, f64),
        v: &Vector6<f64>,
        q: &[f64],
        kept: &[(usize, &HeldMode)],
    ) -> Mode {
        // Of the two signs, the one that makes the largest component positive.
        let sign = if v.amax() > 0.0 { v[v.iamax()].signum() } else { 1.0 };
        let platform_share = (v.transpose() * self.mass * v)[0];
        let mut cable_shares: Vec<f64> =
            self.cables.iter().map(|cable| (v.transpose() * cable.mass * v)[0]).collect();
        for ((cable, mode), amplitude) in kept.iter().zip(q) {
            cable_shares[*cable] += amplitude * (amplitude + 2.0 * mode.coupling.dot(v));
        }
        Mode {
            frequency,
            within,
            translation: v.fixed_rows::<3>(0) * sign,
            rotation: v.fixed_rows::<3>(3) * sign,
            platform_share,
            cable_shares,
            swing_share: 0.0,
        }
    }
}

/// The eigenvalues and eigenvectors of (N6).
struct Reduced<'a> {
    platform: &'a MovingPlatform,
    kept: Vec<Vector6<f64>>,
    /// Factor L of M - C Cᵀ, which leaves the unit matrix for the rest: q = y - Cᵀ v, v = L⁻ᵀ z.
    lower: DMatrix<f64>,
    /// ω² [1/s²], ascending, and the (z, y).
    squares: Vec<f64>,
    vectors: DMatrix<f64>,
}

impl<'a> Reduced<'a> {
    fn new(platform: &'a MovingPlatform, kept: &[(usize, &HeldMode)]) -> Result<Self, DynamicsError> {
        let free = &platform.free;
        let (n, size) = (free.len(), free.len() + kept.len());
        let failed = |what: &str| DynamicsError::NotStable { what: what.to_owned() };
        let whole = platform.cables.iter().fold(platform.mass, |sum, cable| sum + cable.mass);
        let mut mass = DMatrix::from_fn(n, n, |i, j| whole[(free[i], free[j])]);
        let mut stiffness = DMatrix::from_fn(n, n, |i, j| platform.stiffness[(free[i], free[j])]);
        let couplings = DMatrix::from_fn(n, kept.len(), |i, k| kept[k].1.coupling[free[i]]);
        let mut forces = DMatrix::from_fn(n, kept.len(), |i, k| couplings[(i, k)] * kept[k].1.square);
        mass -= &couplings * couplings.transpose();
        stiffness += &forces * couplings.transpose();
        let lower = cholesky(&mass).ok_or_else(|| failed("their mass is not positive definite"))?;
        lower.solve_lower_triangular_mut(&mut forces);
        lower.solve_lower_triangular_mut(&mut stiffness);
        let mut stiffness = stiffness.transpose();
        lower.solve_lower_triangular_mut(&mut stiffness);
        let matrix = DMatrix::from_fn(size, size, |i, j| match (i < n, j < n) {
            (true, true) => stiffness[(i, j)],
            (false, true) => -forces[(j, i - n)],
            (true, false) => -forces[(i, j - n)],
            (false, false) if i == j => kept[i - n].1.square,
            (false, false) => 0.0,
        });
        let (squares, vectors) = eigenvectors(&matrix).ok_or_else(|| failed("no eigenvalues are found"))?;
        let greatest = squares.last().copied().unwrap_or_default();
        if let Some(square) = squares.first().filter(|square| **square < -ROUNDING * greatest.abs()) {
            return Err(failed(&format!("the equilibrium is unstable ({square:.3e} 1/s²)")));
        }
        let kept = kept.iter().map(|(_, mode)| mode.coupling).collect();
        Ok(Self { platform, kept, lower, squares, vectors })
    }

    /// v, and q of the motions of the cables.
    fn motion(&self, k: usize) -> (Vector6<f64>, Vec<f64>) {
        let free = &self.platform.free;
        let n = free.len();
        let mut z = DVector::from_fn(n, |i, _| self.vectors[(i, k)]);
        self.lower.tr_solve_lower_triangular_mut(&mut z);
        let mut v = Vector6::zeros();
        free.iter().enumerate().for_each(|(i, component)| v[*component] = z[i]);
        let q = self.kept.iter().enumerate();
        let q = q.map(|(i, coupling)| self.vectors[(n + i, k)] - coupling.dot(&v)).collect();
        (v, q)
    }
}
