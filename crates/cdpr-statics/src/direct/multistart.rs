//! Equilibria from many starts.

use crate::direct::search::{Start, direct, direct_any};
use crate::direct::solution::DirectSolution;
use crate::error::StaticsError;
use crate::model::Model;
use crate::state::Load;
use cdpr_robot::{Pose, Robot, Vector3};

/// Starts around a pose: the pose itself, then points of a sequence that fills the box of displacements evenly (Roberts 2018, the
/// additive recurrence of the generalised golden ratio in six dimensions). The same settings give the same starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Starts {
    /// The pose in the middle.
    pub center: Pose,
    /// Displacement along each axis, at most [m].
    pub reach: f64,
    /// Component of the rotation vector about each axis, at most [rad].
    pub turn: f64,
    /// Number of starts.
    pub count: usize,
}

/// An equilibrium with the number of starts that led to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The equilibrium.
    pub solution: DirectSolution,
    /// How many searches ended here.
    pub hits: usize,
}

/// All equilibria that a set of starts led to.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibria {
    /// Different equilibria: stable ones first, by hits.
    pub found: Vec<Found>,
    /// What the other searches ended with.
    pub failed: Vec<StaticsError>,
}

/// The root of x⁷ = x + 1, the golden ratio of six dimensions.
const GOLDEN: f64 = 1.112_775_684_278_705_5;

/// Two answers are the same equilibrium within this share of the robot's size.
const SAME: f64 = 1e-7;

impl Starts {
    /// Start number `index`.
    pub fn pose(&self, index: usize) -> Pose {
        if index == 0 {
            return self.center;
        }
        let share = |axis: i32| 2.0 * (0.5 + index as f64 * GOLDEN.powi(-axis - 1)).fract() - 1.0;
        self.center.moved(
            self.reach * Vector3::new(share(0), share(1), share(2)),
            self.turn * Vector3::new(share(3), share(4), share(5)),
        )
    }
}

/// The equilibria for given unstrained lengths [m] and a load that are reached from a set of starts: from each, the stable one
/// downhill, and whatever Newton's method converges to, unstable ones included. No number of starts proves that there are no
/// more.
///
/// # Errors
/// [`StaticsError::Invalid`] for inputs that are none. What single searches fail with stands in the answer.
pub fn direct_all(
    robot: &Robot,
    lengths: &[f64],
    load: &Load,
    starts: &Starts,
) -> Result<Equilibria, StaticsError> {
    let model = Model::new(robot, lengths, load)?;
    if !starts.center.is_finite() {
        return Err(StaticsError::Invalid {
            field: "starts.center".to_owned(),
            value: format!("{:?}", starts.center.position.as_slice()),
            expected: "a finite pose".to_owned(),
        });
    }
    for (field, value) in [("starts.reach", starts.reach), ("starts.turn", starts.turn)] {
        if !(value.is_finite() && value >= 0.0) {
            let expected = "a finite number, zero or more [m, rad]".to_owned();
            return Err(StaticsError::Invalid {
                field: field.to_owned(),
                value: value.to_string(),
                expected,
            });
        }
    }
    if starts.count == 0 {
        let expected = "one start or more".to_owned();
        return Err(StaticsError::Invalid {
            field: "starts.count".to_owned(),
            value: "0".to_owned(),
            expected,
        });
    }
    let mut equilibria = Equilibria { found: Vec::new(), failed: Vec::new() };
    for index in 0..starts.count {
        let start = starts.pose(index);
        let any = direct_any(robot, lengths, load, Start::Pose(&start));
        // What Newton's method found may stand uphill.
        if any.as_ref().is_ok_and(|solution| !solution.stability.is_stable()) {
            equilibria.add(&model, direct(robot, lengths, load, Start::Pose(&start)));
        }
        equilibria.add(&model, any);
    }
    equilibria
        .found
        .sort_by_key(|found| (!found.solution.stability.is_stable(), std::cmp::Reverse(found.hits)));
    Ok(equilibria)
}

impl Equilibria {
    fn add(&mut self, model: &Model, answer: Result<DirectSolution, StaticsError>) {
        let solution = match answer {
            Ok(solution) => solution,
            Err(error) => return self.failed.push(error),
        };
        let same = |found: &&mut Found| {
            let motion = found.solution.equilibrium.pose.motion_to(&solution.equilibrium.pose);
            motion.fixed_rows::<3>(0).norm() <= SAME * model.size()
                && motion.fixed_rows::<3>(3).norm() * model.arm() <= SAME * model.size()
        };
        match self.found.iter_mut().find(same) {
            Some(found) => found.hits += 1,
            None => self.found.push(Found { solution, hits: 1 }),
        }
    }
}
