//! The searches of a design: from every start in every configuration.

use crate::design::evaluation::sense;
use crate::design::problem::{DesignProblem, STEP};
use crate::design::search::{Found, MET, Search, excess, objective};
use cdpr_sensitivity::Sobol;
use cdpr_study::StudyError;
use rayon::prelude::*;

/// Where the searches of a problem ended.
pub(crate) struct Searched {
    /// Starts of the local search in each configuration; 0 where nothing has bounds.
    pub(crate) starts: usize,
    /// Searches, or single evaluations, of each configuration.
    pub(crate) each: usize,
    /// Those of one configuration after those of another.
    pub(crate) found: Vec<Option<Found>>,
}

impl Searched {
    /// Searches from all starts, and from further values of the variables with bounds.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for more variables than Sobol's sequence has dimensions.
    pub(crate) fn of(problem: &DesignProblem, further: &[Vec<f64>]) -> Result<Self, StudyError> {
        let starts = starts(problem, further)?;
        let each = starts.as_ref().map_or(1, Vec::len);
        let run = |number: usize| {
            let values = problem.configuration(number / each);
            match &starts {
                Some(starts) => Search::run(problem, values, starts[number % each].clone()),
                None => single(problem, values),
            }
        };
        let count = problem.configurations().unwrap_or(0) * each;
        let found = (0..count).into_par_iter().map(run).collect();
        Ok(Self { starts: starts.map_or(0, |starts| starts.len()), each, found })
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

    /// Evaluations of a robot at all poses.
    pub(crate) fn evaluations(&self) -> usize {
        self.found.iter().flatten().map(|one| one.evaluations).sum()
    }

    /// Why the first start leads to no robot that counts.
    pub(crate) fn reason(&self, problem: &DesignProblem) -> String {
        match problem.evaluate(&problem.configuration(0), (self.starts > 0).then_some(STEP)) {
            Err(error) => error.to_string(),
            Ok(at) => format!("a limit is passed by {:.1} %", 100.0 * excess(&at)),
        }
    }
}

/// Starts of the local search in the box between the bounds; `None` where nothing has bounds.
fn starts(problem: &DesignProblem, further: &[Vec<f64>]) -> Result<Option<Vec<Vec<f64>>>, StudyError> {
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
    let others: Vec<Vec<f64>> = (1..problem.starts).map(point).collect::<Result<_, _>>()?;
    let further = further.iter().map(|values| in_box(values));
    Ok(Some([nominal.clone()].into_iter().chain(others).chain(further).collect()))
}

/// A configuration where nothing has bounds.
fn single(problem: &DesignProblem, values: Vec<f64>) -> Option<Found> {
    let at = problem.evaluate(&values, None).ok()?;
    let objective = objective(problem.over, &at.outputs, sense(problem.output));
    let excess = excess(&at);
    let (gradient, active) = (Vec::new(), Vec::new());
    Some(Found {
        values,
        objective,
        excess,
        residual: 0.0,
        gradient_error: None,
        gradient,
        active,
        evaluations: 1,
    })
}
