//! The cables of a robot whose platform is held at a pose, each with its chord force as its only unknown.

use super::question::Question;
use crate::equations::{ABOVE_LEAST, Bounds, Ends, Held, wrench};
use crate::error::StaticsError;
use cdpr_cable::CableError;
use cdpr_robot::{Freedoms, TensionLimits, Vector3, Vector6};

/// One cable between its two points, at one chord force.
#[derive(Clone)]
pub(super) struct Strand<'a> {
    pub(super) held: Held<'a>,
    ends: Ends<'a>,
    arm: Vector3<f64>,
    /// Limits of the tension [N]; the least includes what the span demands, once it has been asked for.
    pub(super) limits: TensionLimits,
    /// A tension [N], at least the limit, above which no cable over this span comes near its least one.
    floor: f64,
    /// Chord force at either limit [N], where it has been asked for.
    chord_forces: [Option<f64>; 2],
    pub(super) reference: f64,
    freedoms: Freedoms,
}

impl<'a> Strand<'a> {
    /// Cable i at the chord force that is nearest to `tension` [N] within its limits.
    pub(super) fn new(question: &Question<'a>, i: usize, tension: f64) -> Result<Self, StaticsError> {
        let limits = question.limits[i];
        let tension = tension.clamp(limits.min, limits.max);
        let strand = || -> Result<Self, CableError> {
            let mut strand = Self::with_floor(question, i, |floor| tension.max(floor))?;
            if tension < strand.floor {
                strand.learn(0)?;
                let lowest = strand.chord_forces[0].unwrap_or_default();
                strand.held = strand.at(tension.max(lowest))?;
            }
            Ok(strand)
        };
        strand().map_err(StaticsError::cable(i))
    }

    /// Cable i as it is at a pose nearby: at the same limit, or else at the same chord force [N].
    pub(super) fn near(
        question: &Question<'a>,
        i: usize,
        chord_force: f64,
        limit: Option<usize>,
    ) -> Result<Self, CableError> {
        let mut strand = Self::with_floor(question, i, |_| chord_force)?;
        if let Some(side) = limit {
            strand.learn(side)?;
            strand.held = strand.at(strand.chord_forces[side].unwrap_or(chord_force))?;
        }
        Ok(strand)
    }

    /// Cable i at a chord force [N] that may follow from its floor, with its limits unasked for.
    fn with_floor(
        question: &Question<'a>,
        i: usize,
        chord_force: impl FnOnce(f64) -> f64,
    ) -> Result<Self, CableError> {
        let ends = Ends::of(question.robot, question.pose, i);
        let limits = question.limits[i];
        let floor = ends.floor().max(limits.min);
        Ok(Self {
            held: ends.at_chord_force(chord_force(floor))?,
            ends,
            arm: question.robot.anchor_arm(question.pose, i),
            limits,
            floor,
            chord_forces: [None; 2],
            reference: question.reference[i],
            freedoms: question.robot.freedoms(),
        })
    }

    /// Wrench about P of a force on the platform, its moment divided by `arm` [m]; zero along held motions.
    fn wrench(&self, force: [f64; 3], arm: f64) -> Vector6<f64> {
        let mut wrench = wrench(&self.arm, &force.into());
        wrench.fixed_rows_mut::<3>(3).unscale_mut(arm);
        self.freedoms.of_vector(&wrench)
    }

    /// What the optimum asks of the cable at a chord force.
    pub(super) fn row(&self, held: &Held, arm: f64) -> Row {
        Row {
            tension: held.tension(),
            tension_slope: held.tension_slope(),
            wrench: self.wrench(self.ends.force(held), arm),
            slope: self.wrench(self.ends.force_slope(held), arm),
            reference: self.reference,
        }
    }

    /// Second derivative of the Lagrangian, h_i of (I3).
    pub(super) fn hessian(&self, row: &Row, multipliers: &Vector6<f64>, arm: f64) -> f64 {
        let (force, tension) = self.ends.curvatures(&self.held);
        row.tension_slope * row.tension_slope
            + (row.tension - row.reference) * tension
            + multipliers.dot(&self.wrench(force, arm))
    }

    /// The wrench of a straight cable from the exit point, of one newton.
    pub(super) fn chord_wrench(&self, arm: f64) -> Vector6<f64> {
        self.wrench(self.ends.chord_pull(), arm)
    }

    /// y·w'' [1/N].
    pub(super) fn bend(&self, y: &Vector6<f64>, arm: f64) -> f64 {
        y.dot(&self.wrench(self.ends.curvatures(&self.held).0, arm))
    }

    /// d²t/dσ² [1/N].
    pub(super) fn tension_curvature(&self) -> f64 {
        self.ends.curvatures(&self.held).1
    }

    /// Changes of the chord force [N] that lead to the limits; where a limit's chord force has not been asked
    /// for, a change that does not pass it, because t(σ) is convex with a slope of at most one.
    pub(super) fn room(&self) -> [f64; 2] {
        let t = self.held.tension();
        let room = |side: usize, estimate: f64| {
            self.chord_forces[side].map_or(estimate, |at| at - self.held.chord_force())
        };
        let low = room(0, (self.floor - t) / self.held.tension_slope());
        [low, room(1, self.limits.max - t).max(low)]
    }

    /// Whether the chord force at a limit, 0 the least and 1 the greatest, is known.
    pub(super) fn knows(&self, side: usize) -> bool {
        self.chord_forces[side].is_some()
    }

    /// Asks for the chord force at a limit, and for the least tension that the span demands.
    ///
    /// # Errors
    /// [`CableError::TensionTooSmall`] where the span demands more than the greatest tension.
    pub(super) fn learn(&mut self, side: usize) -> Result<(), CableError> {
        if side == 1 {
            self.chord_forces[1] = Some(self.held.with_tension(self.limits.max)?.chord_force());
            return Ok(());
        }
        let mut nearby = self.held.clone();
        if self.limits.min < self.floor {
            nearby = self.ends.at_least_tension()?;
            let least = nearby.tension();
            if ABOVE_LEAST * least > self.limits.max {
                return Err(CableError::TensionTooSmall { tension: self.limits.max, least });
            }
            self.limits.min = self.limits.min.max(ABOVE_LEAST * least);
            // Beside the least tension, where it has no slope: t = t_0 + t'' (σ - σ_0)²/2.
            let (_, curvature) = self.ends.curvatures(&nearby);
            let beyond = (2.0 * (self.limits.min - least) / curvature).sqrt();
            if let Ok(beside) = nearby.with_chord_force(nearby.chord_force() + beyond) {
                nearby = beside;
            }
        }
        self.chord_forces[0] = Some(nearby.with_tension(self.limits.min)?.chord_force());
        Ok(())
    }

    /// The limit whose chord force has not been asked for though the cable is beyond it, or too near to its
    /// least tension to tell.
    pub(super) fn unknown_limit(&self) -> Option<usize> {
        let t = self.held.tension();
        let beyond = [t < self.floor, t > self.limits.max];
        (0..2).find(|side| beyond[*side] && !self.knows(*side))
    }

    /// The limit that the chord force is at.
    pub(super) fn at_limit(&self) -> Option<usize> {
        (0..2).find(|side| self.chord_forces[*side] == Some(self.held.chord_force()))
    }

    /// No more than y·w at any tension within the limits: the tension differs from the chord force by no
    /// more than the cable's weight. `None` for a cable with a guide.
    pub(super) fn bound_along(&self, y: &Vector6<f64>, arm: f64) -> Option<f64> {
        let Bounds { along, sag, weight } = self.ends.bounds()?;
        let [along, sag] = [along, sag].map(|force| y.dot(&self.wrench(force, arm)));
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
    pub(super) fn least_along(&mut self, y: &Vector6<f64>, arm: f64) -> Result<f64, CableError> {
        let along = |strand: &Self, force: [f64; 3]| y.dot(&strand.wrench(force, arm));
        let mut before: Option<[f64; 3]> = None;
        let mut least = f64::INFINITY;
        for held in self.grid()? {
            let value = along(self, self.ends.force(&held));
            let here = [held.chord_force(), value, along(self, self.ends.force_slope(&held))];
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
        arm: f64,
    ) -> Result<(f64, (f64, f64)), CableError> {
        let part = |strand: &Self, held: &Held| {
            let beyond = held.tension() - strand.reference;
            0.5 * beyond * beyond + y.dot(&strand.wrench(strand.ends.force(held), arm))
        };
        let here = part(self, &self.held);
        Ok((here, self.least_of(part)?))
    }

    /// The tension within the limits, on a grid of chord forces, at which a function is least, and its value.
    fn least_of(&mut self, function: impl Fn(&Self, &Held) -> f64) -> Result<(f64, f64), CableError> {
        let mut least = (f64::NAN, f64::INFINITY);
        for held in self.grid()? {
            let value = function(self, &held);
            if value < least.1 {
                least = (held.tension(), value);
            }
        }
        Ok(least)
    }

    /// The cable at chord forces from limit to limit.
    fn grid(&mut self) -> Result<Vec<Held<'a>>, CableError> {
        const INTERVALS: u32 = 12;
        for side in 0..2 {
            if !self.knows(side) {
                self.learn(side)?;
            }
        }
        let [low, high] = self.chord_forces.map(Option::unwrap_or_default);
        let mut held = self.at(low)?;
        let next = |k: u32| {
            held = held.with_chord_force(low * (high / low).powf(f64::from(k) / f64::from(INTERVALS)))?;
            Ok(held.clone())
        };
        (0..=INTERVALS).map(next).collect()
    }

    /// The cable at another chord force [N].
    pub(super) fn at(&self, chord_force: f64) -> Result<Held<'a>, CableError> {
        // A step to a limit ends exactly there.
        let reached = self.chord_forces.iter().flatten().find(|at| (*at - chord_force).abs() <= 1e-14 * *at);
        let chord_force = reached.copied().unwrap_or(chord_force);
        if chord_force == self.held.chord_force() {
            Ok(self.held.clone())
        } else {
            self.held.with_chord_force(chord_force)
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
