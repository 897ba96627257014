//! A motion from its events to its samples.

use super::event::{Change, Event};
use super::radau::Work;
use super::series::{Difference, Energy, Excursion, Sample, Series};
use super::setting::{Discretization, Settings};
use super::solver::Solver;
use super::system::System;
use crate::error::DynamicsError;
use cdpr_robot::{Pose, Vector3, Vector6, Wrench};
use cdpr_statics::{DirectProblem, Equilibrium};

/// What a control decides at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// This wrench at P in the base frame acts until the next sample, besides that of the load and of events.
    Wrench(Wrench),
    /// The motion ends here.
    Stop,
}

/// Decides at each sample what acts until the next one. Each computation of a motion calls it with its own
/// samples, from the beginning: it must depend on its argument alone.
pub type Control<'a> = dyn Fn(&Sample) -> Command + Sync + 'a;

/// A motion that is wanted.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub(super) problem: &'a DirectProblem<'a>,
    pub(super) rest: &'a Equilibrium,
    pub(super) events: &'a [Event],
    pub(super) settings: &'a Settings,
    pub(super) control: &'a Control<'a>,
}

/// A motion in progress.
struct Run<'a> {
    system: System<'a>,
    solver: Solver<'a>,
    events: Vec<Event>,
    series: Series,
    /// Where the platform rests before the first event.
    rest: Pose,
    /// Time [s] and place of P [m] at each step.
    places: Vec<(f64, Vector3<f64>)>,
    /// What earlier solutions took.
    spent: Work,
    /// Energy that there should be [J].
    before: f64,
    /// Elements of all cables once one goes slack, where they get others.
    slack: Option<Discretization>,
    /// Whether each cable, cut or not, lost its elastic tension at one of its points.
    loose: Vec<bool>,
}

/// The motion with one discretization, and with another one from the step on in which a cable goes slack.
pub(super) fn run(
    Wanted { problem, rest, events, settings, control }: Wanted,
    (discretization, slack): (Discretization, Option<Discretization>),
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
    let solver = Solver::new(&system, 0.0, state, false);
    let mut run = Run {
        system,
        solver,
        events,
        series: Series {
            samples: Vec::new(),
            difference: Difference::default(),
            energy: Energy::default(),
            residual,
            peaks: vec![(0.0, 0.0); cables],
            end_peaks: vec![[0.0; 2]; cables],
            excursion: Excursion::default(),
            slack: vec![false; cables],
            work: Work::default(),
            discretizations: vec![Discretization { elements: 1, degree: 1 }; cables],
        },
        rest: rest.pose,
        places: Vec::new(),
        spent: Work::default(),
        before: 0.0,
        slack,
        loose: vec![false; cables],
    };
    run.before = run.energy();
    run.count_elements();
    run.all(settings, control)?;
    run.series.excursion.swing = swing(&run.places);
    Ok(run.series)
}

impl Run<'_> {
    fn all(&mut self, settings: &Settings, control: &Control) -> Result<(), DynamicsError> {
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
                self.restart(|system, events, state| {
                    while let Some(event) = events.get(applied).filter(|event| event.time <= kink) {
                        system.change(event, state);
                        applied += 1;
                    }
                });
            }
            self.until(sample)?;
            if is_sample && !self.sample(control) {
                break;
            }
        }
        self.series.energy.drift = self.energy() - self.before;
        self.series.work = self.spent;
        self.series.work.add(self.solver.work());
        Ok(())
    }

    /// Applies a change and begins with a short step.
    fn restart(&mut self, change: impl FnOnce(&mut System, &[Event], &mut Vec<f64>)) {
        let (before, mut state) = (self.energy(), self.solver.state().to_vec());
        let (time, work) = (self.solver.time(), self.solver.work());
        change(&mut self.system, &self.events, &mut state);
        let is_slack = self.slack.is_some() && self.loose.contains(&true);
        self.solver = Solver::new(&self.system, time, state, is_slack);
        self.spent.add(work);
        self.watch();
        // What came and went is no error.
        let change = self.energy() - before;
        self.before += change;
        self.series.energy.given += change;
    }

    /// Puts all cables on the elements for slack ones once one is.
    fn refine(&mut self) {
        let (Some(elements), time) = (self.slack, self.solver.time()) else { return };
        if self.loose.contains(&true) && !self.system.is_refined(elements, &self.loose) {
            let loose = self.loose.clone();
            self.restart(|system, _, state| system.refine(time, elements, &loose, state));
            self.count_elements();
        }
    }

    fn count_elements(&mut self) {
        for cable in &self.system.cables {
            if let Some(mesh) = &cable.mesh {
                self.series.discretizations[cable.index] =
                    Discretization { elements: mesh.elements(), degree: mesh.rule.degree };
            }
        }
    }

    fn energy(&self) -> f64 {
        let at = self.solver.snapshot(&self.system);
        self.system.energy(&at, self.solver.state())
    }

    fn until(&mut self, time: f64) -> Result<(), DynamicsError> {
        while time - self.solver.time() > 1e-12 * (1.0 + time) {
            self.refine();
            let stalled = DynamicsError::Stalled { time: self.solver.time() };
            let spent = self.solver.advance(&mut self.system, time).map_err(|_| stalled)?;
            let energy = &mut self.series.energy;
            energy.given += spent.given;
            energy.lost += spent.lost;
            energy.kinetic = energy.kinetic.max(spent.kinetic);
            self.before += spent.given - spent.lost;
            self.watch();
        }
        // Without the rounding of the steps.
        self.solver.set_time(time);
        Ok(())
    }

    /// Keeps the greatest tensions, and how far the platform is from its rest.
    fn watch(&mut self) {
        let time = self.solver.time();
        let at = self.solver.last_snapshot();
        for (index, ends, is_slack) in self.system.tensions(at) {
            let [exit, anchor] = ends;
            let peak = &mut self.series.peaks[index];
            if exit.max(anchor) > peak.0 {
                *peak = (exit.max(anchor), time);
            }
            let peaks = self.series.end_peaks[index].iter_mut().zip(ends);
            peaks.for_each(|(peak, tension)| *peak = peak.max(tension));
            self.loose[index] |= is_slack;
            self.series.slack[index] |=
                is_slack && !self.events.iter().any(|event| event.has_cut(index, time));
        }
        let pose = self.pose();
        let motion = self.rest.motion_to(&pose);
        let [distance, rotation] = [0, 3].map(|first| motion.fixed_rows::<3>(first).norm());
        let excursion = &mut self.series.excursion;
        if distance > excursion.distance {
            (excursion.distance, excursion.time) = (distance, time);
        }
        excursion.rotation = excursion.rotation.max(rotation);
        self.places.push((time, pose.position));
    }

    fn pose(&self) -> Pose {
        let position = Vector3::from_column_slice(&self.solver.state()[..3]);
        Pose { position, rotation: self.system.rotation }
    }

    /// Keeps a sample and applies what the control decides there; false where it ends the motion.
    fn sample(&mut self, control: &Control) -> bool {
        let state = self.solver.state();
        let n = state.len() / 2;
        let mut tensions = vec![[0.0; 2]; self.series.peaks.len()];
        for (index, both, _) in self.system.tensions(&self.solver.snapshot(&self.system)) {
            tensions[index] = both;
        }
        let sample = Sample {
            time: self.solver.time(),
            pose: self.pose(),
            velocity: Vector6::from_column_slice(&state[n..n + 6]),
            tensions,
        };
        let command = control(&sample);
        self.series.samples.push(sample);
        let Command::Wrench(wrench) = command else { return false };
        if wrench != self.system.body.control {
            self.restart(|system, _, _| system.body.control = wrench);
        }
        true
    }
}

/// Greatest distance from the mean place over the last quarter of the time [m].
fn swing(places: &[(f64, Vector3<f64>)]) -> f64 {
    let begin = 0.75 * places.last().map_or(0.0, |(time, _)| *time);
    let next = places.partition_point(|(time, _)| *time < begin);
    let mut last = places[next..].to_vec();
    if let (Some((before, from)), Some((after, to))) =
        (next.checked_sub(1).map(|k| places[k]), places.get(next))
    {
        last.insert(0, (begin, from.lerp(to, (begin - before) / (after - before))));
    }
    let (mut time, mut sum) = (0.0, Vector3::zeros());
    for pair in last.windows(2) {
        let step = pair[1].0 - pair[0].0;
        time += step;
        sum += (pair[0].1 + pair[1].1) * (0.5 * step);
    }
    if time == 0.0 {
        return 0.0;
    }
    last.iter().map(|(_, place)| (place - sum / time).norm()).fold(0.0, f64::max)
}

impl Work {
    fn add(&mut self, other: Self) {
        self.steps += other.steps;
        self.rejected += other.rejected;
        self.evaluations += other.evaluations;
        self.factorizations += other.factorizations;
    }
}
