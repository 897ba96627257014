//! What a motion is: its samples, and what is known of all its steps.

use super::collocation::Work;
use super::setting::Discretization;
use crate::error::DynamicsError;
use cdpr_robot::{Doubt, Pose, Robot, Vector6, short, significant};
use cdpr_statics::MAX_STRAIN;

/// The platform and its cables at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Time [s].
    pub time: f64,
    /// Pose.
    pub pose: Pose,
    /// Velocity of P [m/s] and angular velocity [rad/s] in the base frame.
    pub velocity: Vector6<f64>,
    /// Tension of each cable at its exit and at its anchor point [N]; zero where it has parted.
    pub tensions: Vec<[f64; 2]>,
}

/// Energy of platform and cables.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Greatest kinetic energy [J].
    pub kinetic: f64,
    /// Work of winches and forces, with the energy of payloads and cables that came and went [J].
    pub given: f64,
    /// What damping took [J].
    pub lost: f64,
    /// What is missing at the end, or too much [J]: the error of the steps.
    pub drift: f64,
}

/// Greatest differences between two discretizations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Of the position of P [m].
    pub position: f64,
    /// Of the rotation [rad].
    pub rotation: f64,
    /// Of a tension [N].
    pub tension: f64,
}

/// How far a platform moves, over all steps of a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Excursion {
    /// Greatest distance of P from where it rests before the first event [m].
    pub distance: f64,
    /// When that is [s].
    pub time: f64,
    /// Greatest rotation from the rest [rad].
    pub rotation: f64,
    /// Greatest distance of P from its mean place in the last quarter of the time [m].
    pub swing: f64,
}

/// A motion.
///
/// [`Self::overstrained`] says whether it is one that the models are valid for.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its samples, ascending.
    pub samples: Vec<Sample>,
    /// Greatest differences to a coarser computation: what is left of the error is smaller.
    pub difference: Difference,
    /// Energy.
    pub energy: Energy,
    /// Greatest acceleration of a point at rest before the first event [m/s²].
    pub residual: f64,
    /// Greatest tension of each cable, at its exit or its anchor point, at any step [N], and when [s].
    pub peaks: Vec<(f64, f64)>,
    /// Greatest tension of each cable at its exit and at its anchor point, at any step [N].
    pub end_peaks: Vec<[f64; 2]>,
    /// How far the platform moves.
    pub excursion: Excursion,
    /// Whether each cable lost its elastic tension at one of its points before it was cut.
    pub slack: Vec<bool>,
    /// What it took.
    pub work: Work,
    /// Elements of each cable, those at the end of the motion.
    pub discretizations: Vec<Discretization>,
}

impl Series {
    /// The cable that is strained most, if by more than the models are valid for.
    pub fn overstrained(&self, robot: &Robot) -> Option<Doubt> {
        let strains =
            self.peaks.iter().enumerate().map(|(i, (tension, _))| (i, robot.cable(i).strain(*tension)));
        let (i, strain) =
            strains.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, strain)| *strain > MAX_STRAIN)?;
        let value = format!("strained by {} % at {} s", short(100.0 * strain), short(self.peaks[i].1));
        let why = format!("the models are valid up to {} %", short(100.0 * MAX_STRAIN));
        Some(Doubt::new(
            format!("cable {}", i + 1),
            value,
            why,
            "a smaller force or motion, or stiffer cables",
        ))
    }

    /// Whether it is a motion that says something of the robot.
    ///
    /// # Errors
    /// [`DynamicsError::Implausible`] where its energy is off, as only that of a wrong computation is, or
    /// where a cable is strained by more than the models are valid for.
    pub fn check(&self, robot: &Robot) -> Result<(), DynamicsError> {
        /// Share of the greatest kinetic energy by which the energy may be off: that of velocities which
        /// err by half of it.
        const OFF: f64 = 0.01;
        /// Rounding of energies [J].
        const ROUNDING: f64 = 1e-6;
        let Energy { kinetic, drift, .. } = self.energy;
        // Also where it is NaN.
        let stays = drift.abs() <= OFF * kinetic + ROUNDING;
        if !stays {
            let [drift, kinetic] = [drift, kinetic].map(|energy| significant(energy, 3));
            let what = format!("its energy is off by {drift} J, where the kinetic one reaches {kinetic} J");
            return Err(DynamicsError::Implausible { what });
        }
        self.overstrained(robot).map_or(Ok(()), |Doubt { quantity, value, why, .. }| {
            Err(DynamicsError::Implausible { what: format!("{quantity} is {value}, and {why}") })
        })
    }

    /// The greatest differences to the same motion computed otherwise.
    pub(super) fn difference_to(&self, other: &Self) -> Difference {
        Self::difference(self.samples.iter().zip(&other.samples))
    }

    /// The greatest differences to the begin.
    pub(super) fn motion(&self) -> Difference {
        Self::difference(self.samples.iter().zip(self.samples.first().into_iter().cycle()))
    }

    fn difference<'s>(pairs: impl Iterator<Item = (&'s Sample, &'s Sample)>) -> Difference {
        let mut difference = Difference::default();
        for (one, other) in pairs {
            let motion = one.pose.motion_to(&other.pose);
            difference.position = difference.position.max(motion.fixed_rows::<3>(0).norm());
            difference.rotation = difference.rotation.max(motion.fixed_rows::<3>(3).norm());
            for (one, other) in one.tensions.iter().flatten().zip(other.tensions.iter().flatten()) {
                difference.tension = difference.tension.max((one - other).abs());
            }
        }
        difference
    }
}
