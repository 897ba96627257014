//! A load cycle on cables that dissipate energy: a payload is put on and taken off again.
//!
//! A cable follows its loading curve while its tension grows, and an unloading curve while it falls. Which of
//! them it follows is decided at the turning points of the load: under its own weight (A) the platform has
//! been loaded; the payload is added up to B and removed again to C. At a turning point (ε*, T*) the law of a
//! cable becomes
//!
//! ```text
//! ε(T) = ε* - [U(T*) - U(T)]  for T < T*,      ε(T) = ε* + [L(T) - L(T*)]  for T > T*
//! ```
//!
//! with L and U the strains of the loading and unloading curves: each continues from where the cable is
//! ([`Unloading`] says which part of U). One law is that of a whole cable; T* is its mean tension, over lead
//! and arc of a guide, which carry T0, and over the free part, whose ends differ from its middle by half its
//! weight. With the mean, a turn keeps the length of the cable although its parts do not turn at once.
//!
//! The energy that the payload gives is the area `∮ m g dz` of payload over the height of its centre; the
//! energy that a cable dissipates is the area `∮ T dε L`, closed by a straight line from C to A, over which
//! all tensions together do no work on a payload. Both sums agree to second order in how much the tension
//! varies along a cable.

use crate::direct::{DirectSolution, DirectStart, follow_load};
use crate::error::StaticsError;
use crate::inverse::{PoseLengths, lengths_at, refuse_offsets};
use crate::loading::friction::{PulleyFriction, PulleyState, Wheels};
use crate::problem::{DirectProblem, Unstable};
use crate::state::{Equilibrium, Load, WantedPose};
use cdpr_cable::{CableError, PiecewiseLaw, Segment};
use cdpr_robot::{Robot, Vector2, Vector3};

/// The loading and unloading curves of a cable, with strains in proportion to the robot's modulus.
#[derive(Clone, Debug, PartialEq)]
pub struct HysteresisLaw {
    /// Strain while the tension grows.
    pub loading: PiecewiseLaw,
    /// Strain while it falls, from `turning_tension` down.
    pub unloading: PiecewiseLaw,
    /// Tension from which the unloading curve was measured [N].
    pub turning_tension: f64,
    /// Which part of the unloading curve is taken.
    pub unloading_from: Unloading,
}

/// Which part of the unloading curve a cable follows from a turning point below that of the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unloading {
    /// The part at the same tensions: the modulus is a function of tension and direction.
    SameTension,
    /// The first part, whatever the tension: the modulus is a function of the distance from the turning point
    /// (Masing's rule).
    TurningPoint,
}

/// The cycle of a payload that is put on and taken off.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadCycle {
    /// Unstrained lengths [m].
    pub lengths: Vec<f64>,
    /// Steps from own weight to the whole payload.
    pub loading: Vec<CycleStep>,
    /// Steps back to own weight; the first is the last one of loading.
    pub unloading: Vec<CycleStep>,
    /// Mean tension of each cable under own weight, with the payload, and without it again [N].
    pub tensions: Vec<[f64; 3]>,
    /// Energy dissipated by each cable [J]: the area of its loop.
    pub dissipated: Vec<f64>,
    /// Energy that the payload gave [J].
    pub payload_work: f64,
}

/// One equilibrium of a load cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleStep {
    /// Payload [kg].
    pub payload: f64,
    /// The equilibrium, with the lengths of [`CycleStep::lengths`].
    pub solution: DirectSolution,
    /// The pulley of every cable; empty without friction.
    pub pulleys: Vec<PulleyState>,
}

impl CycleStep {
    /// Unstrained lengths [m] of cables that have the free parts of this step without friction, from those at
    /// the winches: L + Δ of (F4).
    pub fn lengths(&self, at_winches: &[f64]) -> Vec<f64> {
        let mut lengths = at_winches.to_vec();
        lengths.iter_mut().zip(&self.pulleys).for_each(|(length, pulley)| *length += pulley.longer);
        lengths
    }
}

impl LoadCycle {
    /// Displacement that remains after the cycle [m].
    pub fn residual(&self) -> Vector3<f64> {
        self.ends(&self.unloading)
    }

    /// Displacement by the whole payload [m].
    pub fn deflection(&self) -> Vector3<f64> {
        self.ends(&self.loading)
    }

    /// Greatest distance between the positions of the two ways at the same payload [m].
    pub fn gap(&self) -> f64 {
        let position = |step: &CycleStep| step.solution.equilibrium.pose.position;
        let pairs = self.loading.iter().zip(self.unloading.iter().rev());
        pairs.map(|(up, down)| (position(down) - position(up)).norm()).fold(0.0, f64::max)
    }

    fn ends(&self, way: &[CycleStep]) -> Vector3<f64> {
        let position = |at: Option<&CycleStep>| {
            at.map_or_else(Vector3::zeros, |step| step.solution.equilibrium.pose.position)
        };
        position(way.last()) - position(self.loading.first())
    }
}

impl HysteresisLaw {
    /// The law of a cable of constant modulus.
    ///
    /// # Errors
    /// Those of [`PiecewiseLaw::new`].
    pub fn linear() -> Result<Self, CableError> {
        Ok(Self::elastic(PiecewiseLaw::new(0.0, &[Segment { tension: 0.0, ratio: 1.0 }])?))
    }

    /// A law that unloads as it loads: a cable that dissipates no energy.
    pub fn elastic(law: PiecewiseLaw) -> Self {
        let unloading = law.clone();
        Self { loading: law, unloading, turning_tension: 0.0, unloading_from: Unloading::SameTension }
    }

    /// The law of a cable that is at `tension` [N] on the law `now`.
    fn turned(&self, now: &PiecewiseLaw, tension: f64) -> Result<PiecewiseLaw, CableError> {
        let moved = match self.unloading_from {
            Unloading::SameTension => 0.0,
            Unloading::TurningPoint => (self.turning_tension - tension).max(0.0),
        };
        // Each segment begins at `moved` less than on its curve; what lies below zero is cut off.
        let below = self.unloading.segments().map(|at| Segment { tension: at.tension - moved, ..at });
        let below = below.filter(|segment| 0.0 < segment.tension);
        let above = self.loading.segments().filter(|segment| segment.tension > tension);
        let segments: Vec<_> = [Segment { tension: 0.0, ratio: self.unloading.ratio(moved) }]
            .into_iter()
            .chain(below)
            // A slack cable without weight has nothing to unload.
            .filter(|segment| segment.tension < tension)
            .chain([Segment { tension, ratio: self.loading.ratio(tension) }])
            .chain(above)
            .collect();
        let back = self.unloading.scaled_strain(tension + moved) - self.unloading.scaled_strain(moved);
        let at_rest = now.scaled_strain(tension) - back;
        PiecewiseLaw::new(at_rest, &segments)
    }
}

/// Greatest number of steps each way: their results are kept.
const MOST_STEPS: usize = 100_000;

/// The load cycle of a payload [kg] at a wanted pose that the inverse model holds under the platform's own
/// weight, in `steps` steps each way.
///
/// There is one law for each cable; the laws of the robot's own cables are ignored.
///
/// # Errors
/// [`StaticsError::Invalid`] for a payload that is not positive, too few or too many steps, or another
/// number of laws than of cables; those of the inverse and the direct model.
pub fn load_cycle<'a>(
    robot: &Robot,
    wanted: impl Into<WantedPose<'a>>,
    laws: &[HysteresisLaw],
    payload: f64,
    steps: usize,
) -> Result<LoadCycle, StaticsError> {
    load_cycle_over_pulleys(robot, wanted, laws, payload, steps, PulleyFriction::default())
}

/// The same with friction at the pulleys, none of which slips before the cycle: tensions are those of the
/// inverse model on both sides.
///
/// # Errors
/// Those of [`load_cycle`]; [`StaticsError::Invalid`] for coefficients out of their ranges, and for friction
/// on a robot without pulleys.
pub fn load_cycle_over_pulleys<'a>(
    robot: &Robot,
    wanted: impl Into<WantedPose<'a>>,
    laws: &[HysteresisLaw],
    payload: f64,
    steps: usize,
    friction: PulleyFriction,
) -> Result<LoadCycle, StaticsError> {
    let wanted = refuse_offsets(wanted.into())?;
    check(robot, laws, payload, steps)?;
    let mut robot = with_laws(robot, laws.iter().map(|law| law.loading.clone()).collect());
    let mut wheels = Wheels::new(&robot, friction)?;
    let (lengths, first) = start(&robot, &wanted, &Load::none())?;
    let pulleys = wheels.as_ref().map(|wheels| wheels.begin(&robot, &lengths, &first.equilibrium));
    let pulleys = pulleys.transpose()?.unwrap_or_default();
    let mut here = CycleStep { payload: 0.0, solution: first, pulleys };
    let mut means = vec![mean_tensions(&robot, &lengths, &here)?];
    let mut energies = vec![0.0; laws.len()];
    let mut ways = Vec::with_capacity(2);
    for up in [true, false] {
        let from = &means[means.len() - 1];
        let turned = laws
            .iter()
            .enumerate()
            .map(|(i, law)| law.turned(law_of(&robot, i, law), from[i]).map_err(StaticsError::cable(i)));
        robot = with_laws(&robot, turned.collect::<Result<_, _>>()?);
        let mut way = vec![here];
        for step in 1..=steps {
            let share = step as f64 / steps as f64;
            let to = payload * if up { share } else { 1.0 - share };
            let last = way[way.len() - 1].payload;
            let loads = [last, to].map(Load::payload);
            let next = next_step(&robot, &lengths, &way[way.len() - 1], wheels.as_mut(), &loads);
            let of_all = |share: f64| (last + share * (to - last)) / payload;
            way.push(next.map_err(|error| error.with_share(of_all))?);
        }
        here = way[way.len() - 1].clone();
        let to = mean_tensions(&robot, &lengths, &here)?;
        for (i, energy) in energies.iter_mut().enumerate() {
            // ∫ T dε = [T ε] - ∫ ε dT, in multiples of 1/EA
            let law = law_of(&robot, i, &laws[i]);
            let [begin, end] = [from[i], to[i]].map(|t| t * law.scaled_strain(t) - law.scaled_energy(t));
            *energy += end - begin;
        }
        means.push(to);
        ways.push(way);
    }
    let dissipated = (0..laws.len()).map(|i| {
        let (begin, end) = (means[0][i], means[2][i]);
        let last = law_of(&robot, i, &laws[i]);
        let strained = laws[i].loading.scaled_strain(begin) - last.scaled_strain(end);
        let around = energies[i] + 0.5 * (begin + end) * strained;
        around * lengths[i] / robot.cables[i].properties.axial_stiffness()
    });
    let dissipated = dissipated.collect();
    let payload_work = payload_work(&robot, &ways);
    let tensions = (0..laws.len()).map(|i| [means[0][i], means[1][i], means[2][i]]).collect();
    let (unloading, loading) = (ways.pop().unwrap_or_default(), ways.pop().unwrap_or_default());
    Ok(LoadCycle { lengths, loading, unloading, tensions, dissipated, payload_work })
}

/// A robot under one load after another while its winches stand still, over pulleys with friction.
///
/// Cables unload as they load, by the laws of the robot file.
#[derive(Debug)]
pub struct LoadHistory<'a> {
    robot: &'a Robot,
    /// Unstrained lengths at the winches [m].
    pub lengths: Vec<f64>,
    wheels: Wheels,
    load: Load,
    /// The equilibrium under the last load.
    pub now: CycleStep,
}

impl<'a> LoadHistory<'a> {
    /// A history that begins at a wanted pose under a load, where no wheel slips.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for coefficients out of their ranges and a robot without pulleys; those of
    /// the inverse and the direct model.
    pub fn begin<'b>(
        robot: &'a Robot,
        wanted: impl Into<WantedPose<'b>>,
        load: &Load,
        friction: PulleyFriction,
    ) -> Result<Self, StaticsError> {
        let wanted = refuse_offsets(wanted.into())?;
        friction.validate()?;
        let wheels = Wheels::on_pulleys(robot, friction)?;
        let (lengths, solution) = start(robot, &wanted, load)?;
        let pulleys = wheels.begin(robot, &lengths, &solution.equilibrium)?;
        let now = CycleStep { payload: load.payload, solution, pulleys };
        Ok(Self { robot, lengths, wheels, load: *load, now })
    }

    /// The equilibrium under the next load.
    ///
    /// # Errors
    /// Those of the direct model; [`StaticsError::BranchEnds`] where the platform falls.
    pub fn follow(&mut self, load: &Load) -> Result<&CycleStep, StaticsError> {
        let (loads, wheels) = ([self.load, *load], Some(&mut self.wheels));
        self.now = next_step(self.robot, &self.lengths, &self.now, wheels, &loads)?;
        self.load = *load;
        Ok(&self.now)
    }
}

fn check(robot: &Robot, laws: &[HysteresisLaw], payload: f64, steps: usize) -> Result<(), StaticsError> {
    let invalid = |field: &str, value: String, expected: &str| {
        Err(StaticsError::invalid(field.to_owned(), value, expected))
    };
    if !(payload.is_finite() && payload > 0.0) {
        return invalid("payload", payload.to_string(), "a finite, positive mass [kg]");
    }
    if !(1..=MOST_STEPS).contains(&steps) {
        return invalid("steps", steps.to_string(), &format!("1 to {MOST_STEPS} steps"));
    }
    let n = robot.cables.len();
    if laws.len() != n {
        return invalid("laws", format!("a list of {}", laws.len()), &format!("{n}, one a cable"));
    }
    Ok(())
}

/// Lengths [m] for a wanted pose under a load, and the stable equilibrium there.
fn start(
    robot: &Robot,
    wanted: &WantedPose,
    load: &Load,
) -> Result<(Vec<f64>, DirectSolution), StaticsError> {
    let PoseLengths { lengths, equilibrium } = lengths_at(robot, wanted, load)?;
    let problem = DirectProblem::new(robot, &lengths, load)?.with_unstable(Unstable::Refused);
    let solution = problem.direct(DirectStart::Near(&equilibrium))?;
    Ok((lengths, solution))
}

/// The step after `last`, from the first load to the second one.
fn next_step(
    robot: &Robot,
    lengths: &[f64],
    last: &CycleStep,
    wheels: Option<&mut Wheels>,
    [begin, end]: &[Load; 2],
) -> Result<CycleStep, StaticsError> {
    let solution = follow_load(robot, &last.lengths(lengths), (begin, &last.solution), end)?;
    let (solution, pulleys) = match wheels {
        None => (solution, Vec::new()),
        Some(wheels) => wheels.next(robot, lengths, end, solution, &last.pulleys)?,
    };
    Ok(CycleStep { payload: end.payload, solution, pulleys })
}

/// Work of gravity on the payload along the ways of a cycle [J], by the trapezoidal rule.
fn payload_work(robot: &Robot, ways: &[Vec<CycleStep>]) -> f64 {
    let center = |solution: &DirectSolution| {
        let pose = &solution.equilibrium.pose;
        pose.position + pose.rotation * robot.platform.center_of_mass
    };
    let steps = ways.iter().flat_map(|way| way.windows(2));
    let work = steps.map(|pair| {
        let [a, b] = [&pair[0], &pair[1]];
        let weight = 0.5 * (a.payload + b.payload) * robot.gravity.vector();
        weight.dot(&(center(&b.solution) - center(&a.solution)))
    });
    work.sum()
}

fn with_laws(robot: &Robot, laws: Vec<PiecewiseLaw>) -> Robot {
    let mut robot = robot.clone();
    for (cable, law) in robot.cables.iter_mut().zip(laws) {
        cable.properties.law = Some(law);
    }
    robot
}

fn law_of<'a>(robot: &'a Robot, i: usize, law: &'a HysteresisLaw) -> &'a PiecewiseLaw {
    robot.cables[i].properties.law.as_ref().unwrap_or(&law.loading)
}

/// Mean tension of each cable [N].
fn mean_tensions(robot: &Robot, lengths: &[f64], step: &CycleStep) -> Result<Vec<f64>, StaticsError> {
    let (free, Equilibrium { pose, cable_forces }) = (step.lengths(lengths), &step.solution.equilibrium);
    let problem = DirectProblem::new(robot, &free, &Load::none())?;
    let forces = cable_forces.iter().enumerate();
    let mean = |(i, force): (usize, &Vector2<f64>)| {
        let mean = problem.catenary_at(pose, i, *force).mean_tension();
        step.pulleys.get(i).map_or(mean, |pulley| {
            (mean * free[i] - pulley.tension * pulley.longer + pulley.excess) / lengths[i]
        })
    };
    Ok(forces.map(mean).collect())
}
