//! Which roots of the balance are looked for, and which one is taken.

use super::search::{Outcome, Point, SAME, Search, Unknowns};
use super::solution::{FreeSolution, FreeSolutions};
use super::sound::{Loops, longest};
use super::straight::{STRAIGHT_STARTS, StraightRoot};
use crate::error::StaticsError;
use crate::inverse::PoseLengths;
use crate::inverse::problem::InverseProblem;
use crate::out_of_limits::out_of_limits;
use crate::rest_fault::RestFault;
use cdpr_cable::LONGEST_TAUT;

/// Starts of the search among cables that sag.
const STARTS: usize = 32;

/// How far they are from the given angles [rad], and from its position relative to the longest span; every
/// other start within a fifth of it.
const REACH: [f64; 2] = [1.3, 0.4];
const NEAR: [f64; 2] = [0.2 * REACH[0], 0.2 * REACH[1]];

/// Roots of straight cables that are followed, the nearest first.
const MOST_ROOTS: usize = 24;

/// An unstable solution that is turned by more than this from the given pose [rad] is refused: turned over, a
/// platform is in balance nearly everywhere. A solution whose pitch is beyond a right angle is refused, too:
/// its roll and yaw are not the given ones.
const TURNED_OVER: f64 = std::f64::consts::FRAC_PI_2;

/// Roots of the balance as they are found.
pub(super) struct Roots<'s, 'a> {
    search: &'s Search<'a>,
    loops: Loops,
    found: Vec<Root>,
    /// What the nearest attempt lacks.
    nearest: Option<Lacking>,
    starts: usize,
}

/// What an attempt lacks.
struct Lacking {
    /// Whether it is a solution at which the platform stays.
    is_stable: bool,
    /// How much is wrong, among faults of one kind.
    extent: f64,
    fault: RestFault,
}

/// A solution with what is wrong about it.
struct Root {
    solution: FreeSolution,
    unknowns: Unknowns,
    fault: Option<RestFault>,
}

impl<'s, 'a> Roots<'s, 'a> {
    pub(super) fn new(search: &'s Search<'a>, loops: Loops) -> Self {
        Self { search, loops, found: Vec::new(), nearest: None, starts: 0 }
    }

    /// The roots that are found, in their order.
    pub(super) fn all(mut self) -> Result<FreeSolutions, StaticsError> {
        self.starts += STRAIGHT_STARTS;
        let straight = self.search.straight_roots();
        let followed = straight.iter().filter(|root| self.search.may_sag(root)).take(MOST_ROOTS);
        let outcomes: Vec<Outcome> = followed.map(|root| self.sagging(root)).collect();
        for outcome in outcomes {
            self.add(outcome)?;
        }
        for start in 0..STARTS {
            let changes = self.search.start(start, if start % 2 == 0 { NEAR } else { REACH });
            let chord_forces = self.search.straight_forces(&changes);
            self.starts += 1;
            let outcome = self.search.descend(Unknowns { changes, chord_forces });
            self.add(outcome)?;
        }
        self.chosen(&straight)
    }

    /// The solution of cables with weight that belongs to a root of straight ones.
    fn sagging(&self, root: &StraightRoot) -> Outcome {
        let start = root.unknowns(self.search.least_force());
        let direct = self.search.descend(start.clone());
        let InverseProblem { robot, .. } = self.search.problem;
        let is_sound = |point: &Point| self.loops.fault(robot, &point.found).is_none();
        match &direct {
            Outcome::Found(point, ..) if is_sound(point) => direct,
            _ => self.search.raised(start).unwrap_or(direct),
        }
    }

    fn add(&mut self, outcome: Outcome) -> Result<(), StaticsError> {
        let InverseProblem { robot, load, .. } = self.search.problem;
        let (point, unknowns, iterations) = match outcome {
            Outcome::Found(point, unknowns, iterations) => (point, unknowns, iterations),
            Outcome::Stuck(point) => {
                self.lacks(false, point.residual.norm() / point.forces, self.search.left(&point));
                return Ok(());
            }
            Outcome::Lost => return Ok(()),
        };
        let known = |root: &Root| {
            self.search.distance(&root.solution.equilibrium.pose, &point.found.equilibrium.pose) <= SAME
        };
        if self.found.iter().any(known) {
            return Ok(());
        }
        let fault = self.loops.fault(robot, &point.found);
        let PoseLengths { lengths, equilibrium } = point.found;
        let solution = FreeSolution::new(robot, load, lengths, equilibrium, iterations)?;
        // Along its neutral motions a solution is the same.
        let same = |Root { solution: found, .. }: &Root| {
            let same = |(one, other): (&f64, &f64)| (one - other).abs() <= SAME * self.search.size;
            !found.stability.neutral().is_empty() && found.lengths.iter().zip(&solution.lengths).all(same)
        };
        if self.found.iter().any(same) {
            return Ok(());
        }
        let is_turned_about = self.search.is_turned_about(&unknowns.changes);
        let angle = self.search.problem.pose.angle_to(&solution.equilibrium.pose);
        let is_stable = solution.stability.is_stable();
        let is_turned_over = is_turned_about || (angle > TURNED_OVER && !is_stable);
        let fault = fault.or(is_turned_over.then_some(RestFault::TurnedOver { angle, is_stable }));
        if let Some(fault) = &fault {
            self.lacks(is_stable, 0.0, fault.clone());
        }
        let is_refused = matches!(fault, Some(RestFault::Loop { .. } | RestFault::BelowGround { .. }));
        if !is_refused && !is_turned_about {
            self.found.push(Root { solution, unknowns, fault });
        }
        Ok(())
    }

    /// Keeps what the nearest attempt lacks, a stable solution before all others.
    fn lacks(&mut self, is_stable: bool, share: f64, fault: RestFault) {
        let extent = share + fault.extent();
        let key = |one: &Lacking| (!one.is_stable, one.fault.order());
        let new = Lacking { is_stable, extent, fault };
        let is_nearer =
            |old: &Lacking| key(&new).cmp(&key(old)).then(new.extent.total_cmp(&old.extent)).is_lt();
        if self.nearest.as_ref().is_none_or(is_nearer) {
            self.nearest = Some(new);
        }
    }

    fn chosen(mut self, straight: &[StraightRoot]) -> Result<FreeSolutions, StaticsError> {
        let InverseProblem { robot, pose, .. } = self.search.problem;
        let order = |Root { solution, fault, .. }: &Root| {
            let FreeSolution { stability, lengths, equilibrium, .. } = solution;
            let is_taut =
                longest(robot, lengths, equilibrium).is_none_or(|(_, chords)| chords <= LONGEST_TAUT);
            let is_within = out_of_limits(robot, lengths, &[equilibrium]).is_empty();
            (fault.is_some(), !stability.is_stable(), !is_taut, !is_within)
        };
        let away = |root: &Root| self.search.distance(pose, &root.solution.equilibrium.pose);
        self.found
            .sort_by(|one, other| order(one).cmp(&order(other)).then(away(one).total_cmp(&away(other))));
        let mut found = std::mem::take(&mut self.found).into_iter();
        // An unstable solution is not taken where a stable one is out of limits or below the ground alone.
        let is_named = self.nearest.as_ref().is_some_and(|nearest| {
            let is_near = matches!(nearest.fault, RestFault::Limit(_) | RestFault::BelowGround { .. });
            nearest.is_stable && is_near
        });
        match found.next() {
            Some(Root { solution: first, fault: None, unknowns })
                if first.stability.is_stable() || !is_named =>
            {
                self.search.check_unique(&unknowns)?;
                let others = found.map(|root| root.solution).collect();
                Ok(FreeSolutions { first, others })
            }
            _ => Err(self.refusal(straight)),
        }
    }

    fn refusal(mut self, straight: &[StraightRoot]) -> StaticsError {
        let pushing = straight.iter().map(StraightRoot::slackest);
        if let Some((cable, tension)) = pushing.max_by(|one, other| one.1.total_cmp(&other.1))
            && tension < 0.0
        {
            self.lacks(false, 0.0, RestFault::Pushing { cable, force: -tension });
        }
        let nearest = self.nearest.map_or_else(|| self.search.unbalanced(), |nearest| nearest.fault);
        StaticsError::NoRest { starts: self.starts, nearest }
    }
}

impl Search<'_> {
    /// Whether the weight of the cables may make up for what pushes.
    pub(super) fn may_sag(&self, root: &StraightRoot) -> bool {
        let (cable, tension) = root.slackest();
        tension > -self.problem.robot.cable(cable).weight_per_length * self.size
    }

    /// The solution to which a root of straight cables leads while their weight grows to its value; `None`
    /// where the branch ends before.
    fn raised(&self, start: Unknowns) -> Option<Outcome> {
        const FIRST: f64 = 0.25;
        const LEAST: f64 = 1.0 / 128.0;
        let InverseProblem { robot, pose, load, .. } = self.problem;
        let (mut at, mut share, mut step) = (start, 0.0, FIRST);
        while step >= LEAST {
            let next = (share + step).min(1.0);
            let mut light = robot.clone();
            light.cables.iter_mut().for_each(|cable| cable.properties.linear_density *= next);
            let outcome = Search::new(&light, pose, load, self.free).ok()?.descend(at.clone());
            let Outcome::Found(_, unknowns, _) = &outcome else {
                step *= 0.5;
                continue;
            };
            let moves = unknowns.changes.iter().zip(&at.changes).map(|(one, other)| (one - other).abs());
            if moves.fold(0.0, f64::max) > 0.2 {
                step *= 0.5;
                continue;
            }
            (at, share, step) = (unknowns.clone(), next, 1.5 * step);
            if share == 1.0 {
                return Some(self.descend(at));
            }
        }
        None
    }
}
