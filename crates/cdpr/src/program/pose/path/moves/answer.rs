//! What is printed of a move.

use crate::program::answer::OutOfLimits;
use crate::program::arguments::Printing;
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence};
use crate::program::pose::at_pose::numbered;
use crate::program::pose::path::moves::after::{After, mm, percent};
use cdpr_assess::{Compared, ratio_of_best};
use cdpr_dynamics::DynamicsError;
use cdpr_dynamics::moves::{Excited, Move, SetPoint};
use cdpr_robot::{Robot, counted, shown, significant};
use serde::Serialize;

/// A move as a whole.
#[derive(Serialize)]
pub(super) struct Answer {
    seconds: f64,
    /// Length of the curve along which P moves.
    way_m: f64,
    /// Greatest speed of P.
    speed_m_per_s: f64,
    /// Time [s] and amplitude of each impulse of the shaper.
    impulses: Vec<[f64; 2]>,
    /// Motions that the shaper is for.
    shaped: Vec<Shaped>,
    /// Whether a shaper was wanted and none makes the platform swing less.
    #[serde(skip)]
    is_unshaped: bool,
    least_tension_n: f64,
    greatest_exit_tension_n: f64,
    /// Greatest difference of a length to that at rest.
    feed_forward_m: f64,
    /// Tensions that leave their limits at a time.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
    /// When each of them is [s].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits_at_s: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) residual: Option<After>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) robots: Option<Robots>,
    columns: Vec<String>,
}

#[derive(Serialize)]
struct Whole<'a> {
    #[serde(flatten)]
    answer: &'a Answer,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    set_points: Vec<Vec<f64>>,
}

#[derive(Serialize)]
struct Shaped {
    frequency_hz: f64,
    damping_ratio: f64,
    platform_share: f64,
}

/// What robots leave that are drawn from the error model.
#[derive(Serialize)]
pub(super) struct Robots {
    drawn: usize,
    /// Robots that do not hold a pose or cannot be followed; the reason of the first one.
    failed: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// Robots of which a cable loses its tension.
    slack: usize,
    /// As many leave at most `ratio` of what they leave without shaper and feed-forward.
    best: usize,
    /// `null` where fewer could be followed.
    ratio: Option<f64>,
    worst_ratio: Option<f64>,
    /// Greatest amplitude that a robot leaves, with and without.
    worst_amplitude_m: f64,
    worst_unshaped_amplitude_m: f64,
}

impl Robots {
    pub(super) fn new(compared: &[Compared]) -> Self {
        let drawn = compared.len();
        // 95 of 100.
        let best = drawn - drawn / 20;
        let finite = |count| ratio_of_best(compared, count).filter(|ratio| ratio.is_finite());
        let followed = || compared.iter().filter_map(|one| one.as_ref().ok());
        let worst = |k: usize| followed().map(|both| both[k].amplitude).fold(0.0, f64::max);
        Self {
            drawn,
            failed: drawn - followed().count(),
            reason: compared.iter().find_map(|one| one.as_ref().err().map(ToString::to_string)),
            slack: followed().filter(|both| !both[1].slack.is_empty()).count(),
            best,
            ratio: finite(best),
            worst_ratio: finite(drawn),
            worst_amplitude_m: worst(1),
            worst_unshaped_amplitude_m: worst(0),
        }
    }

    fn print(&self) {
        let Self { drawn, failed, slack, best, .. } = self;
        match self.ratio {
            Some(ratio) => {
                let worst = self.worst_ratio;
                let worst =
                    worst.map_or_else(String::new, |worst| format!(", the worst one {} %", percent(worst)));
                let left = percent(ratio);
                print_sentence(&format!(
                    "{best} of {drawn} robots leave {left} % or less of what they leave without both{worst}. \
                     They swing by up to {} mm, without both by up to {} mm.",
                    mm(self.worst_amplitude_m),
                    mm(self.worst_unshaped_amplitude_m)
                ));
            }
            None => println!("Fewer than {best} of {drawn} robots could be followed."),
        }
        if *slack > 0 {
            println!("Robots of which a cable loses its tension: {slack}.");
        }
        if let Some(reason) = &self.reason {
            print_sentence(&format!(
                "{} could not be followed, the first one: {reason}",
                counted(*failed, "robot")
            ));
        }
    }
}

impl Answer {
    /// With the motions of the shaper, if one is wanted; the set points may lie closer than those of the
    /// move, so that their tensions miss no peak.
    pub(super) fn new(
        planned: &Move,
        modes: Option<&[Excited]>,
        set_points: &[SetPoint],
    ) -> Result<Self, DynamicsError> {
        let cables = planned.robot.cables.len();
        let own = ["t_s", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"].map(str::to_owned);
        let of_cables = [("length", "m"), ("feed_forward", "m"), ("tension", "n"), ("exit_tension", "n")];
        let of_cables = of_cables.into_iter().flat_map(|(name, unit)| numbered(name, unit, cables));
        let all = |of: fn(&SetPoint) -> &Vec<f64>| set_points.iter().flat_map(of).copied();
        let ends = |point: &SetPoint| {
            let both = point.tensions.iter().zip(&point.exit_tensions);
            both.map(|(anchor, exit)| [*anchor, *exit]).collect()
        };
        let ends: Vec<Vec<[f64; 2]>> = set_points.iter().map(ends).collect();
        let out_of_limits = OutOfLimits::of_tensions(planned.robot, &ends);
        let when = |one: &OutOfLimits| {
            let mut points = set_points.iter().zip(&ends);
            points.find(|(_, ends)| one.is_of(&ends[one.cable - 1])).map_or(f64::NAN, |(point, _)| point.time)
        };
        let out_of_limits_at_s = out_of_limits.iter().map(when).collect();
        let speed = |pair: &[SetPoint]| {
            (pair[1].pose.position - pair[0].pose.position).norm() / (pair[1].time - pair[0].time)
        };
        let shaped = |mode: &Excited| Shaped {
            frequency_hz: mode.frequency,
            damping_ratio: mode.damping_ratio,
            platform_share: mode.platform_share,
        };
        Ok(Self {
            seconds: planned.seconds,
            way_m: planned.way_length()?,
            speed_m_per_s: set_points.windows(2).map(speed).fold(0.0, f64::max),
            impulses: planned.shaper.impulses.clone(),
            shaped: modes.unwrap_or_default().iter().map(shaped).collect(),
            is_unshaped: modes.is_some_and(<[Excited]>::is_empty),
            least_tension_n: all(|point| &point.tensions).fold(f64::INFINITY, f64::min),
            greatest_exit_tension_n: all(|point| &point.exit_tensions).fold(0.0, f64::max),
            feed_forward_m: all(|point| &point.feed_forward).fold(0.0, |most: f64, one| most.max(one.abs())),
            out_of_limits,
            out_of_limits_at_s,
            residual: None,
            robots: None,
            columns: own.into_iter().chain(of_cables).collect(),
        })
    }

    pub(super) fn ending(&self) -> Ending {
        let failed = self.robots.as_ref().is_some_and(|robots| robots.failed > 0);
        let is_worse = self.residual.as_ref().is_some_and(After::is_worse);
        let ending = if failed || is_worse { Ending::SomethingWrong } else { Ending::Well };
        ending.and(OutOfLimits::ending(&self.out_of_limits))
    }

    pub(super) fn show(
        &self,
        printing: &Printing,
        robot: &Robot,
        set_points: &[SetPoint],
    ) -> Result<(), ProgramError> {
        let (name, records) = (shown(&robot.name), set_points.iter().map(record).collect());
        let whole = |set_points| Whole { answer: self, set_points };
        printing.with_table(&self.columns, records, whole, || self.print(&name, set_points.len()))
    }

    fn print(&self, name: &str, set_points: usize) {
        self.residual.iter().for_each(|after| after.print(name));
        self.robots.iter().for_each(Robots::print);
        let [way, speed] =
            [(self.way_m, 4), (self.speed_m_per_s, 3)].map(|(of, digits)| significant(of, digits));
        let (seconds, points) = (self.seconds, counted(set_points, "set point"));
        print_sentence(&format!("{name}: {way} m in {seconds} s, at up to {speed} m/s, {points}"));
        if let ([.., [duration, _]], false) = (&self.impulses[..], self.shaped.is_empty()) {
            // A motion may have several, which makes the shaper less sensitive.
            let mut of: Vec<(String, usize)> = Vec::new();
            for mode in &self.shaped {
                let name = significant(mode.frequency_hz, 4);
                match of.iter_mut().find(|(known, _)| *known == name) {
                    Some((_, times)) => *times += 1,
                    None => of.push((name, 1)),
                }
            }
            let of = of
                .into_iter()
                .map(|(name, times)| if times > 1 { format!("{name} ({times} times)") } else { name });
            let of: Vec<_> = of.collect();
            let impulses = counted(self.impulses.len(), "impulse");
            print_sentence(&format!(
                "Shaper for {} Hz: {impulses} in {} s.",
                of.join(" and "),
                significant(*duration, 3)
            ));
        }
        if self.is_unshaped {
            print_sentence(&format!(
                "No shaper: of those that take less than {seconds} s none leaves less that swings."
            ));
        }
        let of = if self.feed_forward_m == 0.0 {
            "lengths of a platform at rest".to_owned()
        } else {
            format!("feed-forward up to {} mm", mm(self.feed_forward_m))
        };
        print_sentence(&format!(
            "In motion tensions are {} N at the platform to {} N at the exits; {of}.",
            significant(self.least_tension_n, 3),
            significant(self.greatest_exit_tension_n, 4)
        ));
        OutOfLimits::print(&self.out_of_limits);
        let at =
            |(one, at): (&OutOfLimits, &f64)| format!("cable {} at {} s", one.cable, significant(*at, 4));
        let when: Vec<String> = self.out_of_limits.iter().zip(&self.out_of_limits_at_s).map(at).collect();
        if !when.is_empty() {
            print_sentence(&format!("This is in {}.", when.join(", in ")));
        }
    }
}

/// A set point as a row.
fn record(point: &SetPoint) -> Vec<f64> {
    let SetPoint { time, pose, lengths, feed_forward, tensions, exit_tensions } = point;
    let of_cables = lengths.iter().chain(feed_forward).chain(tensions).chain(exit_tensions);
    let place = pose.position.iter().copied().chain(pose.quaternion());
    [*time].into_iter().chain(place).chain(of_cables.copied()).collect()
}
