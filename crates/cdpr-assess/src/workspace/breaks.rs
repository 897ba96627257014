//! Positions of a map with each cable broken: the greatest utilization, and how far the platform moves.

use crate::safety::factored::{FactoredCase, Situation, Utilization, factored_cases, governing};
use crate::safety::factors::PartialFactors;
use crate::safety::winds::winds;
use crate::safety::{Breaks, safety_at};
use crate::workspace::question::Workspace;
use cdpr_robot::Pose;
use cdpr_statics::{StaticsError, WantedPose};

/// What becomes of a position when cables break there.
#[derive(Clone, Debug, PartialEq)]
pub struct AfterBreaks {
    /// The greatest utilization of a cable, and its case; `None` where a case is open and none exceeds the
    /// resistance.
    pub utilization: Option<(Utilization, Situation)>,
    /// Why the utilization of a case is not known, in words.
    pub open: Option<String>,
    /// The greatest distance of P from where it was after a break [m], and the broken cables (from 0).
    pub farthest: Option<(f64, Vec<usize>)>,
}

/// A position with the whole robot, each cable broken alone, and the worst wind if the map has weather. The
/// winches hold it under the load.
pub(super) fn after_breaks(
    workspace: &Workspace,
    pose: &Pose,
    factors: &PartialFactors,
) -> Result<AfterBreaks, StaticsError> {
    let Workspace { robot, ref load, free, ref further, .. } = *workspace;
    let held = safety_at(robot, WantedPose::at(pose).free(free), load, Breaks::default())?;
    let blown = further.weather.as_ref().map(|weather| {
        let blown = winds(robot, &held.lengths, load, [&held.pose, &held.pose], weather)?;
        Ok::<_, StaticsError>((weather, blown))
    });
    let blown = blown.transpose()?;
    let weather = blown.as_ref().map(|(weather, blown)| (*weather, blown));
    let cases = factored_cases(robot, &held, load, factors, weather)?;
    let moved =
        held.broken.iter().filter_map(|one| Some((one.rest.as_ref().ok()?.moved, one.cables.clone())));
    Ok(AfterBreaks {
        utilization: governing(&cases).map(|(case, most)| (most, case.situation.clone())),
        open: cases.iter().find_map(in_words),
        farthest: moved.max_by(|a, b| a.0.total_cmp(&b.0)),
    })
}

/// Why a case is open.
fn in_words(case: &FactoredCase) -> Option<String> {
    let open = case.open()?;
    Some(match &case.situation {
        Situation::Broken(cables) => {
            let names: Vec<String> = cables.iter().map(|i| (i + 1).to_string()).collect();
            format!("without cable {}: {open}", names.join(", "))
        }
        Situation::Weather(_) => format!("in the weather: {open}"),
        Situation::Intact => open,
    })
}
