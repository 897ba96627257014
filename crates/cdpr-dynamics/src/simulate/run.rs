//! A motion from its events to its samples.

use super::cable::Start;
use super::event::{Change, CutAt, Event};
use super::radau::{Equations, Linearization, Radau, WEIGHTS, Work};
use super::setting::{Discretization, Settings};
use super::system::System;
use super::winch::Reeling;
use crate::error::DynamicsError;
use cdpr_robot::{Pose, Vector3, Vector6};
use cdpr_statics::{DirectProblem, Equilibrium};

/// The platform and its cables at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Time [s].
    pub time: f64,
    /// Pose.
    pub pose: Pose,
    /// Velocity of P [m/s] and angular velocity [rad/s] in the base frame.
    pub velocity: Vector6<f64>,
    /// Tension of each cable at its exit and at its anchor point [N]; zero where it has parted.
    pub tensions: Vec<[f64; 2]>,
}

/// Energy of platform and cables.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Greatest kinetic energy [J].
    pub kinetic: f64,
    /// Work of winches and forces, with the energy of payloads and cables that came and went [J].
    pub given: f64,
    /// What damping took [J].
    pub lost: f64,
    /// What is missing at the end, or too much [J]: the error of the steps.
    pub drift: f64,
}

/// Greatest differences between two discretizations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Of the position of P [m].
    pub position: f64,
    /// Of the rotation [rad].
    pub rotation: f64,
    /// Of a tension [N].
    pub tension: f64,
}

/// A motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its samples, ascending.
    pub samples: Vec<Sample>,
    /// Greatest differences to a coarser computation: what is left of the error is smaller.
    pub difference: Difference,
    /// Energy.
    pub energy: Energy,
    /// Greatest acceleration of a point at rest before the first event [m/s²].
    pub residual: f64,
    /// Greatest tension of each cable, at its exit or its anchor point, at any step [N], and when [s].
    pub peaks: Vec<(f64, f64)>,
    /// Whether each cable lost its elastic tension at one of its points.
    pub slack: Vec<bool>,
    /// What it took.
    pub work: Work,
    /// Elements of each cable.
    pub discretization: Discretization,
}

impl Series {
    /// The greatest differences to the same motion computed otherwise.
    pub(super) fn difference_to(&self, other: &Self) -> Difference {
        let mut difference = Difference::default();
        for (one, other) in self.samples.iter().zip(&other.samples) {
            let motion = one.pose.motion_to(&other.pose);
            difference.position = difference.position.max(motion.fixed_rows::<3>(0).norm());
            difference.rotation = difference.rotation.max(motion.fixed_rows::<3>(3).norm());
            for (one, other) in one.tensions.iter().flatten().zip(other.tensions.iter().flatten()) {
                difference.tension = difference.tension.max((one - other).abs());
            }
        }
        difference
    }
}

/// First step after a change [s].
const FIRST_STEP: f64 = 1e-5;

/// A motion in progress.
struct Run<'a> {
    system: System<'a>,
    radau: Radau<System<'a>>,
    events: Vec<Event>,
    series: Series,
    /// Energy that there should be [J].
    before: f64,
    ends_at_slack: bool,
}

/// The motion with one discretization, up to where a cable goes slack if it ends there.
pub(super) fn run(
    problem: &DirectProblem,
    rest: &Equilibrium,
    events: &[Event],
    settings: &Settings,
    (discretization, ends_at_slack): (Discretization, bool),
) -> Result<Series, DynamicsError> {
    let mut events = events.to_vec();
    events.sort_by(|one, other| one.time.total_cmp(&other.time));
    let (mut system, mut state) = settings.system(problem, rest, discretization)?;
    let residual = system.relax(&mut state, true);
    for event in &events {
        if let Change::Displace(motion) = &event.change {
            let from = Pose { position: Vector3::from_column_slice(&state[..3]), rotation: system.rotation };
            let pose = from.moved(motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
            let held = problem.cables_at(&pose)?;
            let at_rest = system;
            (system, state) = settings.system(problem, &held, discretization)?;
            system.keep_leads(&at_rest, &mut state);
            system.relax(&mut state, false);
        }
    }
    let cables = rest.cable_forces.len();
    let radau = Radau::new(&system, 0.0, state, FIRST_STEP);
    let mut run = Run {
        system,
        radau,
        events,
        series: Series {
            samples: Vec::new(),
            difference: Difference::default(),
            energy: Energy::default(),
            residual,
            peaks: vec![(0.0, 0.0); cables],
            slack: vec![false; cables],
            work: Work::default(),
            discretization,
        },
        before: 0.0,
        ends_at_slack,
    };
    run.before = run.energy();
    run.all(settings)?;
    Ok(run.series)
}

impl Run<'_> {
    fn all(&mut self, settings: &Settings) -> Result<(), DynamicsError> {
        let count = (settings.until * settings.rate * (1.0 + 1e-12)).floor() as usize;
        let samples = (0..=count).map(|k| (k as f64 / settings.rate).min(settings.until));
        let mut kinks: Vec<f64> = Vec::new();
        for event in &self.events {
            kinks.push(event.time);
            match &event.change {
                Change::Shorten { over, .. } => kinks.push(event.time + over),
                Change::Lengths(table) => kinks.push(event.time + table.duration()),
                _ => {}
            }
        }
        kinks.retain(|time| *time <= settings.until);
        kinks.sort_by(f64::total_cmp);
        let mut kinks = kinks.into_iter().peekable();
        let mut applied = 0;
        // The motion goes on to its end, whether that is a sample or not.
        for (sample, is_sample) in samples.map(|time| (time, true)).chain([(settings.until, false)]) {
            while let Some(kink) = kinks.next_if(|kink| *kink <= sample) {
                self.until(kink)?;
                let state = self.radau.state.clone();
                self.restart(state, &mut applied);
            }
            self.until(sample)?;
            if is_sample {
                self.sample();
            }
            if !self.may_go_on() {
                break;
            }
        }
        self.series.energy.drift = self.energy() - self.before;
        self.series.work = self.radau.work;
        Ok(())
    }

    /// Applies the events up to now and begins with a short step.
    fn restart(&mut self, mut state: Vec<f64>, applied: &mut usize) {
        let time = self.radau.time;
        let before = self.energy();
        while let Some(event) = self.events.get(*applied).filter(|event| event.time <= time) {
            self.system.change(event, &mut state);
            *applied += 1;
        }
        let work = self.radau.work;
        self.radau = Radau::new(&self.system, time, state, FIRST_STEP);
        self.radau.work.add(work);
        self.watch();
        // What came and went is no error.
        let change = self.energy() - before;
        self.before += change;
        self.series.energy.given += change;
    }

    fn may_go_on(&self) -> bool {
        !(self.ends_at_slack && self.series.slack.contains(&true))
    }

    fn energy(&self) -> f64 {
        let power = self.system.power(self.radau.time, &self.radau.state);
        power.kinetic + power.stored
    }

    fn until(&mut self, time: f64) -> Result<(), DynamicsError> {
        while time - self.radau.time > 1e-12 * (1.0 + time) {
            let stalled = DynamicsError::Stalled { time: self.radau.time };
            let step = self.radau.advance(&self.system, time).map_err(|_| stalled)?;
            for (weight, (at, state)) in WEIGHTS.iter().zip(&step.stages) {
                let power = self.system.power(*at, state);
                let energy = &mut self.series.energy;
                energy.given += weight * step.length * power.given;
                energy.lost += weight * step.length * power.lost;
                energy.kinetic = energy.kinetic.max(power.kinetic);
                self.before += weight * step.length * (power.given - power.lost);
            }
            self.system.turn(&mut self.radau.state);
            self.watch();
            if !self.may_go_on() {
                return Ok(());
            }
        }
        // Without the rounding of the steps.
        self.radau.time = time;
        Ok(())
    }

    /// Keeps the greatest tensions.
    fn watch(&mut self) {
        let (time, state) = (self.radau.time, &self.radau.state);
        for (index, [exit, anchor], is_slack) in self.system.tensions(time, state) {
            let peak = &mut self.series.peaks[index];
            if exit.max(anchor) > peak.0 {
                *peak = (exit.max(anchor), time);
            }
            self.series.slack[index] |= is_slack;
        }
    }

    fn sample(&mut self) {
        let state = &self.radau.state;
        let n = state.len() / 2;
        let mut tensions = vec![[0.0; 2]; self.series.peaks.len()];
        for (index, both, _) in self.system.tensions(self.radau.time, state) {
            tensions[index] = both;
        }
        self.series.samples.push(Sample {
            time: self.radau.time,
            pose: Pose { position: Vector3::from_column_slice(&state[..3]), rotation: self.system.rotation },
            velocity: Vector6::from_column_slice(&state[n..n + 6]),
            tensions,
        });
    }
}

impl Work {
    fn add(&mut self, other: Self) {
        self.steps += other.steps;
        self.rejected += other.rejected;
        self.evaluations += other.evaluations;
        self.factorizations += other.factorizations;
    }
}

impl System<'_> {
    /// Newton's method for the rest of the discrete cables, with the platform free or held; the greatest
    /// acceleration that is left [m/s²].
    fn relax(&mut self, state: &mut Vec<f64>, is_free: bool) -> f64 {
        const LEAST_STEPS: usize = 5;
        const MOST_STEPS: usize = 30;
        /// Angular frequency that keeps the matrix regular [1/s].
        const SHIFT: f64 = 1e-3;
        let n = self.size();
        let free = self.free;
        if !is_free {
            self.free = [false; 6];
        }
        let greatest =
            |slopes: &[f64]| slopes[n..].iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let mut best = greatest(&self.slopes(0.0, state));
        let mut found = (state.clone(), self.rotation);
        self.cables.iter_mut().for_each(|cable| cable.material.relaxing = Some(cable.least_tension));
        for step in 0..MOST_STEPS {
            let slopes = self.slopes(0.0, state);
            let residual = greatest(&slopes);
            if residual < best {
                best = residual;
                found = (state.clone(), self.rotation);
            } else if step > LEAST_STEPS {
                break;
            }
            let matrices = self.linearize(0.0, state);
            let Some(factors) = matrices.factor(SHIFT) else { break };
            let mut right = slopes;
            right[..n].fill(0.0);
            let step = matrices.solve(&factors, &right);
            state.iter_mut().zip(&step[..n]).for_each(|(value, step)| *value += step);
            self.turn(state);
        }
        (*state, self.rotation) = found;
        self.free = free;
        self.cables.iter_mut().for_each(|cable| cable.material.relaxing = None);
        greatest(&self.slopes(0.0, state))
    }

    /// After the platform was displaced: the leads are those of the rest, and their ends are where they fit
    /// the tension.
    fn keep_leads(&mut self, rest: &Self, state: &mut [f64]) {
        for (cable, before) in self.cables.iter_mut().zip(&rest.cables) {
            if let (Start::Led(lead), Start::Led(now)) = (before.start, cable.start) {
                cable.length = before.length;
                cable.start = Start::Led(lead);
                if cable.mesh.is_some() {
                    state[cable.first] = lead.longer_for(&now);
                }
            }
        }
    }

    /// Applies a change; the unknowns follow.
    fn change(&mut self, event: &Event, state: &mut Vec<f64>) {
        let from = event.time;
        match &event.change {
            Change::Displace(_) => {}
            Change::Payload(payload) => self.body.mass += payload,
            Change::Wrench { force, moment } => {
                let wrench = &mut self.body.wrench;
                *wrench = [wrench[0], *force, wrench[2], *moment];
            }
            Change::Shorten { cable, by, over, profile } => {
                let ramp = Reeling::Ramp { from, over: *over, by: *by, profile: *profile };
                let winch = self.cables.iter_mut().find(|one| one.index == *cable);
                winch.into_iter().for_each(|one| one.reeling.push(ramp.clone()));
            }
            Change::Lengths(lengths) => {
                for one in &mut self.cables {
                    let (cable, lengths) = (one.index, lengths.clone());
                    one.reeling.push(Reeling::Table { from, cable, lengths });
                }
            }
            Change::Cut { cable, at } => self.cut(*cable, *at, from, state),
        }
    }

    fn cut(&mut self, index: usize, at: CutAt, time: f64, state: &mut Vec<f64>) {
        let Some(place) = self.cables.iter().position(|cable| cable.index == index) else { return };
        let is_gone = at == CutAt::Anchor || self.cables[place].mesh.is_none();
        let before = self.cables.clone();
        let n = self.size();
        let begin = self.beginning(time, state, place);
        if is_gone {
            self.cables.remove(place);
        } else {
            let cable = &mut self.cables[place];
            cable.length = cable.length_at(time).0;
            cable.reeling.clear();
            cable.start = Start::Loose;
        }
        let (old, scale) = (state.clone(), self.scale.clone());
        let parts = [&old[..n], &old[n..]];
        let mut halves = parts.map(|half| half[..6].to_vec());
        let mut scales = [scale[..6].to_vec(), scale[n..n + 6].to_vec()];
        for cable in &mut self.cables {
            let Some(was) = before.iter().find(|was| was.index == cable.index) else { continue };
            cable.first = halves[0].len();
            let range = was.first..was.first + was.size(&self.rule);
            for k in 0..2 {
                let own = &parts[k][range.clone()];
                let more = cable.size(&self.rule) + usize::from(matches!(was.start, Start::Led(_)));
                if more > own.len()
                    && matches!(cable.start, Start::Loose)
                    && !matches!(was.start, Start::Loose)
                {
                    halves[k].extend(begin[k].iter());
                    halves[k].extend(&own[usize::from(matches!(was.start, Start::Led(_)))..]);
                } else {
                    halves[k].extend(own);
                }
                let usual = if k == 0 { scale[n - 1] } else { scale[2 * n - 1] };
                let size = halves[k].len();
                scales[k].resize(size, usual);
            }
        }
        *state = halves.concat();
        self.scale = scales.concat();
    }
}
