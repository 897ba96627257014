//! The searches of a design: from every start in every configuration.

use crate::design::demand::Demand;
use crate::design::evaluation::Evaluation;
use crate::design::exhaustive::{Exhausted, exhausted, single};
use crate::design::goal::sense;
use crate::design::problem::{DesignProblem, STEP};
use crate::design::search::{Found, MET, Search};
use cdpr_robot::{Pose, significant};
use cdpr_sensitivity::Sobol;
use cdpr_statics::limits::allowed;
use cdpr_study::StudyError;
use rayon::prelude::*;

/// Points of Sobol's sequence that a start tries at most, until the robot is held there.
const DRAWS: usize = 30;

/// Where the searches of a problem ended.
pub(crate) struct Searched {
    /// Starts of the local search in each configuration; 0 where nothing has bounds.
    pub(crate) starts: usize,
    /// Searches, or single evaluations, of each configuration.
    pub(crate) each: usize,
    /// Those of one configuration after those of another.
    pub(crate) found: Vec<Option<Found>>,
    /// Evaluations of a robot at all poses.
    pub(crate) evaluations: usize,
    /// Configurations that are proven to be worse than the two best ones, and left.
    pub(crate) left: usize,
}

impl Searched {
    /// Searches from all starts, and from further values of the variables with bounds.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for more variables than Sobol's sequence has dimensions.
    pub(crate) fn of(problem: &DesignProblem, further: &[Vec<f64>]) -> Result<Self, StudyError> {
        let starts = starts(problem, further)?;
        let configurations = problem.configurations().unwrap_or(0);
        let Some(starts) = starts else {
            let Exhausted { found, evaluations, left } = exhausted(problem, configurations);
            return Ok(Self { starts: 0, each: 1, found, evaluations, left });
        };
        let each = starts.len();
        let run = |number: usize| {
            let values = problem.configuration(number / each);
            let mut evaluations = 0;
            let found = starts[number % each].iter().find_map(|start| {
                let (found, more) = Search::run(problem, values.clone(), start.clone());
                evaluations += more;
                // A robot that is held without derivatives counts, but no search goes on from it.
                let placed = || problem.placed(values.clone(), start);
                let alone = || Some(Found { residual: f64::INFINITY, ..single(problem, placed())? });
                found.or_else(alone)
            });
            (found, evaluations)
        };
        let (found, evaluations): (Vec<_>, Vec<usize>) =
            (0..configurations * each).into_par_iter().map(run).unzip();
        let evaluations = evaluations.iter().sum();
        Ok(Self { starts: each, each, found, evaluations, left: 0 })
    }

    /// The ends that meet all demands, with their numbers.
    pub(crate) fn feasible(&self) -> impl Iterator<Item = (usize, &Found)> {
        let counts = |found: &&Found| found.excess <= MET;
        self.found.iter().enumerate().filter_map(move |(k, one)| Some((k, one.as_ref().filter(counts)?)))
    }

    /// The best of them.
    pub(crate) fn best(&self) -> Option<(usize, &Found)> {
        self.feasible().min_by(|(_, a), (_, b)| a.objective.total_cmp(&b.objective))
    }

    /// Why the first start in a configuration leads to no robot that counts.
    pub(crate) fn reason(&self, problem: &DesignProblem, configuration: usize) -> String {
        let (values, step) = (problem.configuration(configuration), (self.starts > 0).then_some(STEP));
        let of = |poses: Vec<Pose>| DesignProblem { poses, ..problem.clone() };
        match problem.evaluate(&values, step) {
            Err(error) => {
                let fails = |pose: &Pose| of(vec![*pose]).evaluate(&values, step).is_err();
                let pose = problem.poses.iter().position(fails);
                pose.map_or_else(|| error.to_string(), |pose| format!("pose {}: {error}", pose + 1))
            }
            Ok(at) => passed(problem, &values, &at),
        }
    }
}

/// The demand that is passed most, in words.
fn passed(problem: &DesignProblem, values: &[f64], at: &Evaluation) -> String {
    let excesses = at.excesses.iter().map(|excess| excess.value).enumerate();
    let greatest = excesses.max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((index, excess)) = greatest.filter(|(_, excess)| *excess > MET) else {
        return "the robot there meets the limits, but the search from it ended early".to_owned();
    };
    let words = |what: String, value: f64, limit: f64, unit: &str| {
        let [value, limit] = [value, limit].map(|value| significant(value, 4));
        format!("{what} is {value} {unit}, its limit {limit} {unit}")
    };
    match problem.demand(index) {
        Demand::Output { pose, output, limit } => {
            let what = format!("at pose {} the {}", pose + 1, output.noun());
            words(what, limit * (1.0 + sense(output) * excess), limit, output.unit())
        }
        Demand::Tension { pose, cable } => {
            let limit = problem.robot_at(values).map_or(f64::NAN, |robot| allowed(&robot, cable).max);
            let what = format!("at pose {} the tension of cable {}", pose + 1, cable + 1);
            words(what, limit * (1.0 + excess), limit, "N")
        }
        Demand::Exit { pose, cable, limit } => {
            let what = format!("at pose {} the exit tension of cable {}", pose + 1, cable + 1);
            words(what, limit * (1.0 + excess), limit, "N")
        }
        Demand::Whole { of, limit } => {
            let amount = |value| of.amount(&significant(value, 4));
            let [value, limit] = [limit * (1.0 + excess), limit].map(amount);
            format!("the {} is {value}, its limit {limit}", of.noun())
        }
        Demand::Second => "the second objective does not reach its bound".to_owned(),
    }
}

/// Starts of the local search in the box between the bounds, each with the points that are tried until the
/// robot is held; `None` where nothing has bounds.
fn starts(problem: &DesignProblem, further: &[Vec<f64>]) -> Result<Option<Vec<Vec<Vec<f64>>>>, StudyError> {
    let in_box = |values: &[f64]| -> Vec<f64> {
        let place = |(j, [low, high]): (usize, [f64; 2])| ((values[j] - low) / (high - low)).clamp(0.0, 1.0);
        problem.bounded().map(place).collect()
    };
    let nominal = in_box(&problem.nominal());
    if nominal.is_empty() {
        return Ok(None);
    }
    let too_many = |_| StudyError::setting("variables", nominal.len(), "at most 2048 with bounds");
    let sobol = match problem.seed {
        Some(seed) => Sobol::scrambled(nominal.len(), seed),
        None => Sobol::new(nominal.len()),
    };
    let sobol = sobol.map_err(too_many)?;
    let point = |index: usize| {
        let mut point = vec![0.0; nominal.len()];
        sobol.point(index as u32, &mut point).map(|()| point).map_err(too_many)
    };
    let drawn = |first: usize| (first..DRAWS * problem.starts).step_by(problem.starts).map(point).collect();
    let mut starts: Vec<Vec<Vec<f64>>> = (0..problem.starts)
        .map(|k| drawn(if k == 0 { problem.starts } else { k }))
        .collect::<Result<_, _>>()?;
    starts[0].insert(0, nominal.clone());
    starts.extend(further.iter().map(|values| vec![in_box(values)]));
    Ok(Some(starts))
}
