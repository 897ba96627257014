//! A motion from its events to its samples.

use super::collocation::Work;
use super::event::{Change, Event};
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
/// samples, from the beginning or from the step in which a cable becomes slack: it must depend on its
/// argument alone.
pub type Control<'a> = dyn Fn(&Sample) -> Command + Sync + 'a;

/// A motion that is wanted.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub(super) problem: &'a DirectProblem<'a>,
    pub(super) rest: &'a Equilibrium,
    pub(super) events: &'a [Event],
    pub(super) settings: Settings,
    pub(super) control: &'a Control<'a>,
}

/// A motion in progress.
pub(super) struct Run<'a> {
    system: System<'a>,
    solver: Solver<'a>,
    settings: Settings,
    control: &'a Control<'a>,
    events: Vec<Event>,
    /// Events that were applied.
    applied: usize,
    /// Times [s] at which a motion begins again, ascending, and how many of them have passed.
    kinks: Vec<f64>,
    passed: usize,
    /// Samples that were kept.
    kept: usize,
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

/// The motion with one discretization, to its end; or to the step in which a cable goes slack, where cables
/// get other elements then.
pub(super) fn begin<'a>(
    Wanted { problem, rest, events, settings, control }: Wanted<'a>,
    (discretization, slack): (Discretization, Option<Discretization>),
) -> Result<Run<'a>, DynamicsError> {
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
        settings,
        control,
        kinks: kinks(&events, settings.until),
        events,
        applied: 0,
        passed: 0,
        kept: 0,
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
    run.go_on(true)?;
    Ok(run)
}

/// Times at which events begin and winches stop, ascending.
fn kinks(events: &[Event], until: f64) -> Vec<f64> {
    let mut kinks = Vec::new();
    for event in events {
        kinks.push(event.time);
        match &event.change {
            Change::Shorten { over, .. } => kinks.push(event.time + over),
            Change::Lengths(table) => kinks.push(event.time + table.duration()),
            _ => {}
        }
    }
    kinks.retain(|time| *time <= until);
    kinks.sort_by(f64::total_cmp);
    kinks
}

impl<'a> Run<'a> {
    /// The motion to its end, with these elements of all cables from the step on in which one goes slack.
    pub(super) fn end(&self, slack: Option<Discretization>) -> Result<Series, DynamicsError> {
        let mut run = self.copy();
        run.slack = slack;
        run.go_on(false)?;
        let Self { mut series, places, .. } = run;
        series.excursion.swing = swing(&places);
        Ok(series)
    }

    fn copy(&self) -> Self {
        let mut spent = self.spent;
        spent.add(self.solver.work());
        Self {
            system: self.system.clone(),
            solver: Solver::new(&self.system, self.solver.time(), self.solver.state().to_vec(), false),
            events: self.events.clone(),
            kinks: self.kinks.clone(),
            series: self.series.clone(),
            places: self.places.clone(),
            loose: self.loose.clone(),
            spent,
            ..*self
        }
    }

    /// Whether cables need other elements, because one is slack.
    fn is_to_refine(&self) -> bool {
        let is_refined = |elements| self.system.is_refined(elements, &self.loose);
        self.loose.contains(&true) && self.slack.is_some_and(|elements| !is_refined(elements))
    }

    /// Goes on to the end, or to the step in which a cable goes slack.
    fn go_on(&mut self, pauses: bool) -> Result<(), DynamicsError> {
        let Settings { until, rate, .. } = self.settings;
        let count = (until * rate * (1.0 + 1e-12)).floor() as usize;
        // The motion goes on to its end, whether that is a sample or not.
        while self.kept <= count + 1 {
            let sample = if self.kept > count { until } else { (self.kept as f64 / rate).min(until) };
            while let Some(kink) = self.kinks.get(self.passed).copied().filter(|kink| *kink <= sample) {
                if !self.until(kink, pauses)? {
                    return Ok(());
                }
                let now = self.events[self.applied..].iter().take_while(|event| event.time <= kink).count();
                let range = self.applied..self.applied + now;
                self.applied = range.end;
                self.passed += 1;
                self.restart(|system, events, state| {
                    events[range].iter().for_each(|event| system.change(event, state));
                });
            }
            if !self.until(sample, pauses)? {
                return Ok(());
            }
            let goes_on = self.kept > count || self.sample();
            self.kept = if goes_on { self.kept + 1 } else { usize::MAX };
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

    /// Puts all cables on the elements for slack ones.
    fn refine(&mut self) {
        let (Some(elements), time) = (self.slack, self.solver.time()) else { return };
        let loose = self.loose.clone();
        self.restart(|system, _, state| system.refine(time, elements, &loose, state));
        self.count_elements();
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

    /// Goes on to a time [s]; false where it pauses before, because cables need other elements.
    fn until(&mut self, time: f64, pauses: bool) -> Result<bool, DynamicsError> {
        while time - self.solver.time() > 1e-12 * (1.0 + time) {
            if self.is_to_refine() {
                if pauses {
                    return Ok(false);
                }
                self.refine();
            }
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
        Ok(true)
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
    fn sample(&mut self) -> bool {
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
        let command = (self.control)(&sample);
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
