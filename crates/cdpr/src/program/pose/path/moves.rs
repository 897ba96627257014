//! `cdpr path --with seconds=1`: a move along the poses, as set points of the winches.

mod after;
mod answer;

use crate::program::arguments::{self, UncertaintyArgument, With};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, patiently, progress};
use crate::program::pose::at_pose::RobotAtPose;
use crate::program::pose::modes::with_inertia;
use crate::program::questions;
use after::{After, is_shaped};
use answer::{Answer, Robots};
use cdpr_assess::DrawnRobots;
use cdpr_dynamics::moves::{FeedForward, Move, SetPoint, Shaper, ShaperKind, residual};
use cdpr_dynamics::simulate::Profile;
use std::ops::RangeFrom;

/// What takes the poses of a robot with few cables.
pub(super) const INSTEAD: &str = "`cdpr inverse --poses FILE --free NAMES` finds the lengths pose by pose, and \
                       `cdpr deflection`, `stiffness` and `modes` take --free, too";

/// The names of `--with`.
const NAMES: [&str; 10] = [
    "seconds",
    "profile",
    "shaper",
    "modes",
    "feed-forward",
    "rate",
    "damping",
    "residual",
    "robots",
    "seed",
];

/// Set points of which the tensions are known, at least.
const FEWEST: usize = 100;

/// Robots that are drawn where no number is given.
const ROBOTS: usize = 100;

/// What the names of `--with` say.
struct Wanted {
    seconds: f64,
    profile: Profile,
    shaper: Option<ShaperKind>,
    modes: usize,
    feed_forward: FeedForward,
    rate: f64,
    damping: f64,
    /// Whether the motion after the move is watched, and how long [s].
    residual: Option<Option<f64>>,
    robots: Option<usize>,
    seed: Option<u64>,
}

impl Wanted {
    fn read(with: &With) -> Result<Self, ProgramError> {
        with.check(&NAMES)?;
        let number =
            |name, usual: f64| with.value(name, None, arguments::number).map(|value| value.unwrap_or(usual));
        let seconds = with.value("seconds", None, arguments::number)?;
        let missing = "--with: expected seconds=S, how long the move takes [s]";
        let feed_forward = with
            .value("feed-forward", Some(FeedForward::Cables), |text| one_of(text, &FeedForward::NAMED))?
            .unwrap_or_default();
        let seed = with.value("seed", None, |text| {
            text.parse::<u64>().map_err(|_| "expected a whole number, zero or more".to_owned())
        })?;
        let profile = with.value("profile", None, |text| one_of(text, &Profile::SMOOTH))?;
        let shaper = with.value("shaper", Some(ShaperKind::Zvd), |text| one_of(text, &ShaperKind::NAMED))?;
        let modes = with.value("modes", None, arguments::count::<1, 6>)?;
        if modes.is_some() && shaper.is_none() {
            return Err(ProgramError::Usage(
                "--with modes: expected shaper, too, which is for them".to_owned(),
            ));
        }
        Ok(Self {
            seconds: seconds.ok_or_else(|| ProgramError::Usage(missing.to_owned()))?,
            profile: profile.unwrap_or_else(|| feed_forward.usual_profile()),
            shaper,
            modes: modes.unwrap_or(2),
            feed_forward,
            rate: number("rate", 200.0)?,
            damping: with.value("damping", None, |text| time(text, 0.0..))?.unwrap_or_default(),
            residual: with.value("residual", Some(None), |text| time(text, f64::MIN_POSITIVE..).map(Some))?,
            robots: with.value("robots", None, arguments::count::<1, 100_000>)?,
            seed,
        })
    }
}

/// A time in a range that has no end [s].
fn time(text: &str, range: RangeFrom<f64>) -> Result<f64, String> {
    let expected = if range.start > 0.0 { "a time above 0 s" } else { "a time of 0 s or more" };
    arguments::number(text)
        .and_then(|time| if range.contains(&time) { Ok(time) } else { Err(format!("expected {expected}")) })
}

fn one_of<T: Copy>(text: &str, named: &[(&str, T)]) -> Result<T, String> {
    let names: Vec<&str> = named.iter().map(|(name, _)| *name).collect();
    let found = named.iter().find(|(name, _)| name.eq_ignore_ascii_case(text));
    found.map(|(_, value)| *value).ok_or_else(|| format!("expected {}", names.join(", ")))
}

/// Plans the move, and simulates it where that is wanted.
pub(super) fn run(
    at: &RobotAtPose,
    errors: &UncertaintyArgument,
    with: &With,
) -> Result<Ending, ProgramError> {
    let wanted = Wanted::read(with)?;
    let usage = |reason: &str| ProgramError::Usage(reason.to_owned());
    let robot = at.robot()?;
    ProgramError::unless_chosen(&robot, || INSTEAD.to_owned())?;
    let model = errors.model(&robot)?;
    if model.is_some() && wanted.residual.is_none() {
        return Err(usage("--uncertainty: expected --with residual, what swings after the move"));
    }
    if model.is_some() && wanted.seed.is_none() {
        return Err(usage("--with: expected seed=N, from which the robots are drawn"));
    }
    if model.is_none() && (wanted.robots.is_some() || wanted.seed.is_some()) {
        return Err(usage("--with robots, seed: expected --uncertainty, too, from which robots are drawn"));
    }
    let poses = at.poses(&robot)?;
    let robot = with_inertia(&robot);
    let plain = Move {
        robot: &robot,
        load: at.load.load(),
        poses: &poses,
        seconds: wanted.seconds,
        profile: wanted.profile,
        shaper: Shaper::default(),
        feed_forward: FeedForward::None,
        rate: wanted.rate,
    };
    let mut planned = Move { feed_forward: wanted.feed_forward, ..plain.clone() };
    let mut modes = Vec::new();
    if let Some(kind) = wanted.shaper {
        (planned, modes) = planned.shaped(kind, wanted.modes, wanted.damping)?;
    }
    let set_points = planned.plan()?;
    let finer = FEWEST.div_ceil(set_points.len());
    let fine = Move { rate: wanted.rate * finer as f64, ..planned.clone() };
    let between = if finer > 1 { fine.plan()? } else { set_points.clone() };
    questions::about_curve(&robot, &poses, &between);
    let mut answer = Answer::new(&planned, wanted.shaper.map(|_| &modes[..]), &between)?;
    if let Some(seconds) = wanted.residual {
        let simulated = plain.watched(seconds, wanted.damping)?;
        let unshaped = plain.plan()?;
        let after = |points: &[SetPoint]| residual(&robot, &plain.load, points, &[], &simulated);
        // Where the move has both, the shaper has to do better than feed-forward alone.
        let has_both = is_shaped(&planned) && planned.feed_forward != FeedForward::None;
        let alone = has_both.then(|| Move { shaper: Shaper::default(), ..planned.clone() });
        let alone = alone.map(|alone| alone.plan()).transpose()?;
        let (shaped, (without, alone)) = patiently("simulating the move and what swings after it", || {
            let others = || rayon::join(|| after(&unshaped), || alone.as_deref().map(&after).transpose());
            rayon::join(|| after(&set_points), others)
        });
        let (without, alone) = (without?, alone?);
        let others = (&without, alone.as_ref());
        answer.residual = Some(After::new(&planned, &shaped?, others, simulated.until));
        if let (Some(model), Some(seed)) = (&model, wanted.seed) {
            let count = wanted.robots.unwrap_or(ROBOTS);
            let drawn = DrawnRobots { nominal: &robot, model, count, seed };
            let bar = progress(count, "robots");
            let compared =
                drawn.compare(&plain.load, [&unshaped, &set_points], &simulated, &|| bar.inc(1))?;
            bar.finish_and_clear();
            answer.robots = Some(Robots::new(&compared));
        }
    }
    answer.show(&at.printing, &robot, &set_points)?;
    Ok(answer.ending())
}
