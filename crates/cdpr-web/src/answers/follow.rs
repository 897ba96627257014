//! Where the platform goes while cables are wound or the load changes.

use crate::answers::failure::Failure;
use crate::answers::state::State;
use crate::question::Follow;
use cdpr_robot::Robot;
use cdpr_statics::continuation::{LossKind, Setting, follow};
use cdpr_statics::{DirectSolution, DirectStart};
use serde::Serialize;

/// The way between two settings.
#[derive(Serialize)]
pub(crate) struct Way {
    /// The equilibrium at the second setting, after all jumps; absent if the way ends before.
    state: Option<State>,
    /// Positions of P on the way [m].
    path: Vec<[f64; 3]>,
    /// The jumps on the way, in their order.
    jumps: Vec<Jump>,
    /// Why the way ends before the second setting.
    reason: Option<String>,
}

/// An equilibrium that is lost.
#[derive(Serialize)]
struct Jump {
    /// Share of the change at which it is lost.
    share: f64,
    kind: &'static str,
    before: State,
    /// The equilibrium that the platform jumps to.
    after: Option<State>,
}

/// A way with more jumps than this is not followed to its end.
const MOST_JUMPS: usize = 4;

pub(crate) fn wind(robot: &Robot, given: Follow) -> Result<Way, Failure> {
    let Follow { lengths: [before, after], load: [first, second], start } = given;
    let mut from = Setting { lengths: before, load: first.load() };
    let to = Setting { lengths: after, load: second.load() };
    let mut way = Way { state: None, path: Vec::new(), jumps: Vec::new(), reason: None };
    let start = start.pose()?;
    let mut found = follow(robot, &from, &to, DirectStart::Pose(&start))?;
    // The share of the whole change at which the part that is followed begins.
    let mut begun = 0.0;
    loop {
        way.path.extend(found.steps.iter().map(|step| place(&step.solution)));
        let Some(lost) = found.lost else {
            let last =
                found.steps.last().map(|step| State::new(robot, &to.lengths, &to.load, &step.solution));
            way.state = last.transpose()?;
            return Ok(way);
        };
        let at = between(&from, &to, lost.share);
        let beyond = between(&from, &to, (lost.share + BEYOND).min(1.0));
        let after = lost.after.as_ref();
        way.jumps.push(Jump {
            share: begun + (1.0 - begun) * lost.share,
            kind: name(lost.kind),
            before: State::new(robot, &at.lengths, &at.load, &lost.before)?,
            after: after
                .ok()
                .map(|after| State::new(robot, &beyond.lengths, &beyond.load, after))
                .transpose()?,
        });
        let landed = match &lost.after {
            Ok(landed) => landed,
            Err(error) => {
                way.reason = Some(error.to_string());
                return Ok(way);
            }
        };
        if way.jumps.len() == MOST_JUMPS {
            way.reason = Some(format!("the platform jumps more than {MOST_JUMPS} times"));
            return Ok(way);
        }
        begun += (1.0 - begun) * (lost.share + BEYOND).min(1.0);
        from = beyond;
        found = follow(robot, &from, &to, DirectStart::Near(&landed.equilibrium))?;
    }
}

/// Share of the change behind a loss at which the next equilibrium is searched, as [`follow`] does.
const BEYOND: f64 = 1e-6;

fn place(found: &DirectSolution) -> [f64; 3] {
    found.equilibrium.pose.position.into()
}

fn between(from: &Setting, to: &Setting, share: f64) -> Setting {
    let mix = |a: f64, b: f64| a + share * (b - a);
    let mut load = from.load;
    load.payload = mix(from.load.payload, to.load.payload);
    load.wrench.force += (to.load.wrench.force - from.load.wrench.force) * share;
    load.wrench.moment += (to.load.wrench.moment - from.load.wrench.moment) * share;
    let lengths = from.lengths.iter().zip(&to.lengths).map(|(a, b)| mix(*a, *b)).collect();
    Setting { lengths, load }
}

fn name(kind: LossKind) -> &'static str {
    match kind {
        LossKind::TurningPoint => "turning_point",
        LossKind::Bifurcation => "bifurcation",
        LossKind::Overstrained => "overstrained",
        LossKind::StepLimit => "step_limit",
    }
}
