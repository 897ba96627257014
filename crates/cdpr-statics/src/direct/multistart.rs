//! Equilibria from a set of starts (multistart).

use crate::direct::search::DirectStart;
use crate::direct::solution::DirectSolution;
use crate::error::StaticsError;
use crate::problem::{DirectProblem, Unstable};
use cdpr_robot::{Pose, Vector3};

/// Starts around a pose: the pose itself, then points that fill a box of displacements evenly.
///
/// The points are those of the additive recurrence of the generalized golden ratio in six dimensions (Roberts
/// 2018). The same values give the same starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Starts {
    /// The pose in the middle.
    pub center: Pose,
    /// Largest displacement along each axis [m].
    pub reach: f64,
    /// Largest component of the rotation vector about each axis [rad].
    pub rotation: f64,
    /// Number of starts.
    pub count: usize,
}

/// An equilibrium with the number of starts that led to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The equilibrium.
    pub solution: DirectSolution,
    /// Number of searches that ended here.
    pub hits: usize,
}

/// All equilibria that a set of starts led to.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibria {
    /// The different equilibria: stable ones first, by hits.
    pub found: Vec<Found>,
    /// The failures of the other searches.
    pub failed: Vec<StaticsError>,
}

/// The root of x⁷ = x + 1, the golden ratio of six dimensions.
const GOLDEN: f64 = 1.112_775_684_278_705_5;

/// Two solutions closer than this share of the robot's size are the same equilibrium.
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
            self.rotation * Vector3::new(share(3), share(4), share(5)),
        )
    }

    fn validate(&self) -> Result<(), StaticsError> {
        let Self { center, reach, rotation, count } = *self;
        StaticsError::finite_pose("starts.center", &center)?;
        for (field, value) in [("reach", reach), ("rotation", rotation)] {
            if !(value.is_finite() && value >= 0.0) {
                let expected = "a finite number, zero or more [m, rad]";
                return Err(StaticsError::invalid(format!("starts.{field}"), value, expected));
            }
        }
        if count == 0 {
            return Err(StaticsError::invalid("starts.count".to_owned(), count, "one start or more"));
        }
        Ok(())
    }
}

impl DirectProblem<'_> {
    /// The equilibria that are reached from a set of starts.
    ///
    /// Each start leads to the stable equilibrium downhill and to whatever Newton's method converges to,
    /// unstable equilibria included. No number of starts proves that there are no more.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for starts that are not finite, or none. Failures of single searches are
    /// listed in the result.
    pub fn equilibria(&self, starts: &Starts) -> Result<Equilibria, StaticsError> {
        starts.validate()?;
        let mut equilibria = Equilibria { found: Vec::new(), failed: Vec::new() };
        for index in 0..starts.count {
            let start = self.allowed(&starts.center, starts.pose(index));
            let any = self.with_unstable(Unstable::Accepted).direct(DirectStart::Pose(&start));
            // What Newton's method found may be uphill.
            if any.as_ref().is_ok_and(|solution| !solution.stability.is_stable()) {
                equilibria.add(self, self.with_unstable(Unstable::Left).direct(DirectStart::Pose(&start)));
            }
            equilibria.add(self, any);
        }
        equilibria
            .found
            .sort_by_key(|found| (!found.solution.stability.is_stable(), std::cmp::Reverse(found.hits)));
        Ok(equilibria)
    }
}

impl DirectProblem<'_> {
    /// A start without motions that the platform cannot make: no search leads back from there.
    fn allowed(&self, center: &Pose, start: Pose) -> Pose {
        let freedoms = self.robot().freedoms();
        if freedoms.are_all() {
            return start;
        }
        let motion = freedoms.of_vector(&center.motion_to(&start));
        center.moved(motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into())
    }

    /// Whether two solutions are the same equilibrium.
    pub fn is_same(&self, one: &DirectSolution, other: &DirectSolution) -> bool {
        let motion = one.equilibrium.pose.motion_to(&other.equilibrium.pose);
        motion.fixed_rows::<3>(0).norm() <= SAME * self.size()
            && motion.fixed_rows::<3>(3).norm() * self.characteristic_length() <= SAME * self.size()
    }
}

impl Equilibria {
    fn add(&mut self, problem: &DirectProblem, found: Result<DirectSolution, StaticsError>) {
        let solution = match found {
            Ok(solution) => solution,
            Err(error) => return self.failed.push(error),
        };
        let same = |found: &&mut Found| problem.is_same(&found.solution, &solution);
        match self.found.iter_mut().find(same) {
            Some(found) => found.hits += 1,
            None => self.found.push(Found { solution, hits: 1 }),
        }
    }
}
