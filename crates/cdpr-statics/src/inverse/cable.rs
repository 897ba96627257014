//! The cables of a robot whose platform is at a given pose, each with its chord force as its only unknown.

use super::problem::InverseProblem;
use crate::equations::{ABOVE_LEAST, Bounds, Ends, wrench};
use crate::error::StaticsError;
use cdpr_cable::{CableError, HeldCable};
use cdpr_robot::{Freedoms, Matrix3, TensionLimits, Vector3, Vector6};
use cdpr_tension::Bound;

/// One cable between its two points, at one chord force.
#[derive(Clone)]
pub(super) struct CableAtPose<'a> {
    pub(super) fixed: HeldCable<'a>,
    ends: Ends<'a>,
    lever_arm: Vector3<f64>,
    /// Limits of the tension [N]; the least includes what the span demands, once it has been computed.
    pub(super) limits: TensionLimits,
    /// A tension [N], at least the limit, above which no cable over this span comes near its least one.
    floor: f64,
    /// Chord force at either limit [N], where it is known.
    chord_forces: [Option<f64>; 2],
    pub(super) reference: f64,
    freedoms: Freedoms,
}

/// The force of a cable on the platform.
pub(super) struct Pull {
    /// Lever arm of its anchor point [m].
    pub(super) lever_arm: Vector3<f64>,
    /// [N]
    pub(super) force: Vector3<f64>,
    /// Its derivative by the position of the anchor point [N/m].
    pub(super) per_motion: Matrix3<f64>,
}

impl<'a> CableAtPose<'a> {
    /// Cable i at the chord force that is nearest to `tension` [N] within its limits.
    pub(super) fn new(problem: &InverseProblem<'a>, i: usize, tension: f64) -> Result<Self, StaticsError> {
        let limits = problem.limits[i];
        let tension = tension.clamp(limits.min, limits.max);
        let cable = || -> Result<Self, CableError> {
            let mut cable = Self::with_floor(problem, i, |floor| tension.max(floor))?;
            if tension < cable.floor {
                cable.compute_limit(Bound::Min)?;
                let lowest = cable.chord_forces[0].unwrap_or_default();
                cable.fixed = cable.at(tension.max(lowest))?;
            }
            Ok(cable)
        };
        cable().map_err(StaticsError::cable(i))
    }

    /// Cable i as it is at a pose nearby: at the same limit, or else at the same chord force [N].
    pub(super) fn near(
        problem: &InverseProblem<'a>,
        i: usize,
        chord_force: f64,
        limit: Option<Bound>,
    ) -> Result<Self, CableError> {
        let mut cable = Self::with_floor(problem, i, |_| chord_force)?;
        if let Some(bound) = limit {
            cable.compute_limit(bound)?;
            cable.fixed = cable.at(cable.chord_forces[bound as usize].unwrap_or(chord_force))?;
        }
        Ok(cable)
    }

    /// Cable i at a chord force [N] that may follow from its floor; its limits are still to be computed.
    fn with_floor(
        problem: &InverseProblem<'a>,
        i: usize,
        chord_force: impl FnOnce(f64) -> f64,
    ) -> Result<Self, CableError> {
        let ends = Ends::of(problem.robot, problem.pose, i);
        let limits = problem.limits[i];
        let floor = ends.floor().max(limits.min);
        Ok(Self {
            fixed: ends.at_chord_force(chord_force(floor))?,
            ends,
            lever_arm: problem.robot.anchor_arm(problem.pose, i),
            limits,
            floor,
            chord_forces: [None; 2],
            reference: problem.reference[i],
            freedoms: problem.robot.freedoms(),
        })
    }

    /// Wrench about P of a force on the platform, its moment divided by a characteristic length [m]; zero
    /// along constrained motions.
    fn wrench(&self, force: [f64; 3], characteristic_length: f64) -> Vector6<f64> {
        let mut wrench = wrench(&self.lever_arm, &force.into());
        wrench.fixed_rows_mut::<3>(3).unscale_mut(characteristic_length);
        self.freedoms.of_vector(&wrench)
    }

    /// Tension and wrench with their derivatives at a chord force.
    pub(super) fn row(&self, fixed: &HeldCable, characteristic_length: f64) -> Row {
        Row {
            tension: fixed.tension(),
            tension_slope: fixed.tension_slope(),
            wrench: self.wrench(self.ends.force(fixed), characteristic_length),
            slope: self.wrench(self.ends.force_slope(fixed), characteristic_length),
            reference: self.reference,
        }
    }

    /// Its force, which changes with the anchor point at the same chord force.
    pub(super) fn pull(&self) -> Pull {
        let force = self.ends.force(&self.fixed).into();
        Pull { lever_arm: self.lever_arm, force, per_motion: self.ends.force_per_end(&self.fixed) }
    }

    /// Second derivative of the Lagrangian, h_i of (I3).
    pub(super) fn hessian(&self, row: &Row, multipliers: &Vector6<f64>, characteristic_length: f64) -> f64 {
        let (force, tension) = self.ends.curvatures(&self.fixed);
        row.tension_slope * row.tension_slope
            + (row.tension - row.reference) * tension
            + multipliers.dot(&self.wrench(force, characteristic_length))
    }

    /// The wrench of a straight cable from the exit point, of one newton.
    pub(super) fn chord_wrench(&self, characteristic_length: f64) -> Vector6<f64> {
        self.wrench(self.ends.chord_pull(), characteristic_length)
    }

    /// y·w'' [1/N].
    pub(super) fn bend(&self, y: &Vector6<f64>, characteristic_length: f64) -> f64 {
        y.dot(&self.wrench(self.ends.curvatures(&self.fixed).0, characteristic_length))
    }

    /// d²t/dσ² [1/N].
    pub(super) fn tension_curvature(&self) -> f64 {
        self.ends.curvatures(&self.fixed).1
    }

    /// Changes of the chord force [N] that lead to the limits; where a limit's chord force is not known, a
    /// change that does not pass it, because t(σ) is convex with a slope of at most one.
    pub(super) fn step_bounds(&self) -> [f64; 2] {
        let t = self.fixed.tension();
        let change = |bound: Bound, estimate: f64| {
            self.chord_forces[bound as usize].map_or(estimate, |at| at - self.fixed.chord_force)
        };
        let low = change(Bound::Min, (self.floor - t) / self.fixed.tension_slope());
        [low, change(Bound::Max, self.limits.max - t).max(low)]
    }

    /// The limit that a change of the chord force [N] passes.
    pub(super) fn passed(&self, change: f64) -> Option<Bound> {
        let [low, high] = self.step_bounds();
        let passed = [change < low, change > high];
        Bound::BOTH.into_iter().find(|bound| passed[*bound as usize])
    }

    /// The same, its chord force computed: the way to a limit that is not known is an estimate.
    ///
    /// # Errors
    /// As [`CableAtPose::compute_limit`].
    pub(super) fn passed_limit(&mut self, change: f64) -> Result<Option<Bound>, CableError> {
        if let Some(bound) = self.passed(change) {
            self.know_limit(bound)?;
        }
        Ok(self.passed(change))
    }

    /// Computes the chord force at a limit that is not known; true if there was none.
    ///
    /// # Errors
    /// As [`CableAtPose::compute_limit`].
    pub(super) fn know_limit(&mut self, bound: Bound) -> Result<bool, CableError> {
        let is_new = !self.limit_known(bound);
        if is_new {
            self.compute_limit(bound)?;
        }
        Ok(is_new)
    }

    /// Whether the chord force at a limit is known.
    pub(super) fn limit_known(&self, bound: Bound) -> bool {
        self.chord_forces[bound as usize].is_some()
    }

    /// Computes the chord force at a limit; at the lower one the least tension that the span demands, too.
    ///
    /// # Errors
    /// [`CableError::TensionTooSmall`] where the span demands more than the greatest tension.
    pub(super) fn compute_limit(&mut self, bound: Bound) -> Result<(), CableError> {
        if bound == Bound::Max {
            self.chord_forces[1] = Some(self.fixed.with_tension(self.limits.max)?.chord_force);
            return Ok(());
        }
        let mut nearby = self.fixed;
        if self.limits.min < self.floor {
            nearby = self.ends.at_least_tension()?;
            let least = nearby.tension();
            if ABOVE_LEAST * least > self.limits.max {
                return Err(CableError::TensionTooSmall { tension: self.limits.max, least });
            }
            self.limits.min = self.limits.min.max(ABOVE_LEAST * least);
            // Next to the least tension, where it has no slope: t = t_0 + t'' (σ - σ_0)²/2.
            let (_, curvature) = self.ends.curvatures(&nearby);
            let beyond = (2.0 * (self.limits.min - least) / curvature).sqrt();
            if let Ok(above) = nearby.with_chord_force(nearby.chord_force + beyond) {
                nearby = above;
            }
        }
        self.chord_forces[0] = Some(nearby.with_tension(self.limits.min)?.chord_force);
        Ok(())
    }

    /// The limit whose chord force is not known though the cable is beyond it, or may be: it is near its
    /// least tension.
    pub(super) fn unknown_limit(&self) -> Option<Bound> {
        let t = self.fixed.tension();
        let beyond = [t < self.floor, t > self.limits.max];
        Bound::BOTH.into_iter().find(|bound| beyond[*bound as usize] && !self.limit_known(*bound))
    }

    /// The limit that the chord force is at.
    pub(super) fn at_limit(&self) -> Option<Bound> {
        let here = Some(self.fixed.chord_force);
        Bound::BOTH.into_iter().find(|bound| self.chord_forces[*bound as usize] == here)
    }

    /// The tension at a limit [N].
    pub(super) fn limit(&self, bound: Bound) -> f64 {
        match bound {
            Bound::Min => self.limits.min,
            Bound::Max => self.limits.max,
        }
    }

    /// No more than y·w at any tension within the limits: the tension differs from the chord force by no
    /// more than the cable's weight. `None` for a cable with a guide.
    pub(super) fn bound_along(&self, y: &Vector6<f64>, characteristic_length: f64) -> Option<f64> {
        let Bounds { along, sag, weight } = self.ends.bounds()?;
        let [along, sag] = [along, sag].map(|force| y.dot(&self.wrench(force, characteristic_length)));
        let chord_forces = [(self.limits.min - weight).max(0.0), self.limits.max + weight];
        let [low, high] = chord_forces.map(|chord_force| along * chord_force);
        Some(low.min(high) + (sag * weight).min(0.0))
    }

    /// No more than y·w at any tension within the limits, from its values and tangents on a grid of chord
    /// forces: between two of them it is either convex, and above both tangents, or concave, and above the
    /// chord.
    ///
    /// # Errors
    /// [`CableError`] where the cable cannot be closed.
    pub(super) fn least_along(
        &mut self,
        y: &Vector6<f64>,
        characteristic_length: f64,
    ) -> Result<f64, CableError> {
        let along = |cable: &Self, force: [f64; 3]| y.dot(&cable.wrench(force, characteristic_length));
        let mut before: Option<[f64; 3]> = None;
        let mut least = f64::INFINITY;
        for fixed in self.grid()? {
            let value = along(self, self.ends.force(&fixed));
            let here = [fixed.chord_force, value, along(self, self.ends.force_slope(&fixed))];
            least = least.min(value);
            if let Some(before) = before.replace(here) {
                least = least.min(below_tangents(before, here));
            }
        }
        Ok(least)
    }

    /// Its part (I11) of the Lagrangian: here, and where it is least on a grid of chord forces within the
    /// limits, with the tension there [N].
    ///
    /// # Errors
    /// [`CableError`] where the cable cannot be closed.
    pub(super) fn lagrangians(
        &mut self,
        y: &Vector6<f64>,
        characteristic_length: f64,
    ) -> Result<(f64, (f64, f64)), CableError> {
        let part = |cable: &Self, fixed: &HeldCable| {
            let beyond = fixed.tension() - cable.reference;
            0.5 * beyond * beyond + y.dot(&cable.wrench(cable.ends.force(fixed), characteristic_length))
        };
        let (here, mut least) = (part(self, &self.fixed), (f64::NAN, f64::INFINITY));
        for fixed in self.grid()? {
            let value = part(self, &fixed);
            if value < least.1 {
                least = (fixed.tension(), value);
            }
        }
        Ok((here, least))
    }

    /// The cable at chord forces from limit to limit.
    fn grid(&mut self) -> Result<Vec<HeldCable<'a>>, CableError> {
        const INTERVALS: u32 = 12;
        for bound in Bound::BOTH {
            self.know_limit(bound)?;
        }
        let [low, high] = self.chord_forces.map(Option::unwrap_or_default);
        let mut fixed = self.at(low)?;
        let next = |k: u32| {
            fixed = fixed.with_chord_force(low * (high / low).powf(f64::from(k) / f64::from(INTERVALS)))?;
            Ok(fixed)
        };
        (0..=INTERVALS).map(next).collect()
    }

    /// The cable at another chord force [N].
    pub(super) fn at(&self, chord_force: f64) -> Result<HeldCable<'a>, CableError> {
        // A step to a limit ends exactly there.
        let reached = self.chord_forces.iter().flatten().find(|at| (*at - chord_force).abs() <= 1e-14 * *at);
        let chord_force = reached.copied().unwrap_or(chord_force);
        if chord_force == self.fixed.chord_force {
            Ok(self.fixed)
        } else {
            self.fixed.with_chord_force(chord_force)
        }
    }
}

/// Where the tangents at two points meet between them, the value there; each point has its abscissa, value
/// and slope.
fn below_tangents([from, first, rising]: [f64; 3], [to, last, at_end]: [f64; 3]) -> f64 {
    let width = to - from;
    let share = (last - first - at_end * width) / ((rising - at_end) * width);
    if share > 0.0 && share < 1.0 { first + rising * share * width } else { f64::INFINITY }
}

/// A cable's tension and wrench with their derivatives with respect to its chord force; moments are divided
/// by a length.
#[derive(Clone)]
pub(super) struct Row {
    pub(super) tension: f64,
    pub(super) tension_slope: f64,
    pub(super) wrench: Vector6<f64>,
    pub(super) slope: Vector6<f64>,
    pub(super) reference: f64,
}

impl Row {
    /// Derivative of (t - r)²/2 [N].
    pub(super) fn gradient(&self) -> f64 {
        (self.tension - self.reference) * self.tension_slope
    }
}
