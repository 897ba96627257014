//! The handle of an observer of the load and the cables, and what it reads and writes.

use crate::data::{Range, checked};
use crate::failure::Failure;
use cdpr_observer::{Alarm, CableState, LoadObserver, Observed, ObserverSetting};
use cdpr_robot::{Pose, Robot};

/// Observes the load and the cables from lengths and measured tensions: the handle of `cdpr_observer_new`. One
/// thread at a time may use it.
pub struct CdprObserver {
    observer: LoadObserver,
    cables: usize,
}

/// Noise, prior knowledge and alarms of an observer.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CdprObserverSetting {
    /// Number of cables.
    pub count: usize,
    /// Standard deviation of the tension that the sensor of each cable reads [N].
    pub tension_std: *const f64,
    /// Standard deviation of each unstrained length [m]; 0 where lengths count as exact.
    pub length_std: f64,
    /// Standard deviation of the load before the first sample [kg]; its mean is no load.
    pub payload_std: f64,
    /// Standard deviation of the distance between the load's centre and that of the platform along each axis [m].
    pub center_std: f64,
    /// Standard deviation of the modulus as a share of the robot's, 0 to 0.15; 0 where it is known.
    pub modulus_std: f64,
    /// Number of samples after which a sample has lost most of its weight; infinite for none that loses any.
    pub memory: f64,
    /// Probability that an alarm begins at a sample although nothing is wrong, 1e-15 to 0.1, such as 1e-9.
    pub false_alarm: f64,
    /// Number of samples in a row that have to deviate for an alarm, such as 3.
    pub consecutive: usize,
}

/// What the readings say that the model does not.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CdprAlarm {
    /// Nothing.
    None = 0,
    /// The load has changed by more than the estimate allowed.
    LoadChanged = 1,
    /// A cable reads no tension although the model has it taut, and no plausible load explains the readings: it is
    /// broken, slack or off its pulley, or its sensor has failed.
    CableLost = 2,
    /// No plausible load explains the readings, and no cable stands out.
    Inconsistent = 3,
    /// Another load explains the readings, and a cable reads no tension although the model had it taut with the
    /// load before: it has become slack, or it is broken and the robot has too few cables to distinguish these.
    CableSlack = 4,
}

/// What a sample says, and what is known after it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CdprObserved {
    /// Force that the measured tensions hold in addition to the platform's weight, in the base frame [N].
    pub force: [f64; 3],
    /// Its moment about P [N m].
    pub moment: [f64; 3],
    /// Mass of the load [kg].
    pub payload: f64,
    /// Standard deviation of the mass [kg].
    pub payload_std: f64,
    /// Centre of the load in the frame of the platform, from P [m]; NaN where the load is below three times its
    /// standard deviation, or where the samples have not halved the uncertainty of its moment.
    pub center: [f64; 3],
    /// Standard deviation of the centre [m]; NaN where the centre is.
    pub center_std: [f64; 3],
    /// Modulus of the cables as a multiple of the robot's.
    pub modulus: f64,
    /// Standard deviation of the modulus.
    pub modulus_std: f64,
    /// Chi-square of the readings for the best plausible load; NaN while taring.
    pub consistency: f64,
    /// Chi-square of the readings for the load that was known before; NaN while taring.
    pub change: f64,
    /// The value beyond which a chi-square deviates.
    pub threshold: f64,
    /// The cable of `CDPR_ALARM_CABLE_LOST` or `CDPR_ALARM_CABLE_SLACK`, from 0.
    pub cable: usize,
    /// What the last samples in a row say.
    pub alarm: CdprAlarm,
    /// Iterations that were made, at most 12.
    pub iterations: u32,
}

const TENSIONS: Range = (f64::is_finite, "a finite tension [N]");

impl CdprObserver {
    pub(crate) fn new(
        robot: &Robot,
        lengths: &[f64],
        start: &Pose,
        tension_std: &[f64],
        setting: &CdprObserverSetting,
    ) -> Result<Self, Failure> {
        let CdprObserverSetting { length_std, payload_std, center_std, modulus_std, memory, .. } = *setting;
        let setting = ObserverSetting {
            tension_std: tension_std.to_vec(),
            length_std,
            payload_std,
            center_std,
            modulus_std,
            memory,
            false_alarm: setting.false_alarm,
            consecutive: setting.consecutive,
        };
        let observer = LoadObserver::new(robot, lengths, start, setting)?;
        Ok(Self { observer, cables: lengths.len() })
    }

    pub(crate) fn cables(&self) -> usize {
        self.cables
    }

    /// A sample, while the load is known or not.
    pub(crate) fn sample(
        &mut self,
        lengths: &[f64],
        tensions: &[f64],
        tares: bool,
    ) -> Result<CdprObserved, Failure> {
        checked("tensions", tensions, TENSIONS)?;
        let observed = if tares {
            self.observer.tare(lengths, tensions)?
        } else {
            self.observer.update(lengths, tensions)?
        };
        if !observed.converged {
            return Err(Failure::NotConverged { iterations: observed.iterations });
        }
        Ok(self.result(&observed))
    }

    fn result(&self, observed: &Observed) -> CdprObserved {
        let estimate = self.observer.estimate();
        let (alarm, cable) = match observed.alarm {
            None => (CdprAlarm::None, 0),
            Some(Alarm::LoadChanged) => (CdprAlarm::LoadChanged, 0),
            Some(Alarm::CableSlack(cable)) => (CdprAlarm::CableSlack, cable),
            Some(Alarm::CableLost(cable)) => (CdprAlarm::CableLost, cable),
            Some(Alarm::Inconsistent) => (CdprAlarm::Inconsistent, 0),
        };
        CdprObserved {
            force: observed.wrench.force.into(),
            moment: observed.wrench.moment.into(),
            payload: estimate.payload,
            payload_std: estimate.payload_std,
            center: estimate.center.map(|of| of.unwrap_or(f64::NAN)),
            center_std: estimate.center_std.map(|of| of.unwrap_or(f64::NAN)),
            modulus: estimate.modulus,
            modulus_std: estimate.modulus_std,
            consistency: observed.consistency,
            change: observed.change,
            threshold: observed.threshold,
            cable,
            alarm,
            iterations: u32::try_from(observed.iterations).unwrap_or(u32::MAX),
        }
    }

    /// 0 for a taut cable, 1 for a slack one, 2 for one that is lost.
    pub(crate) fn states(&self) -> impl Iterator<Item = u8> {
        (0..self.cables).map(|i| match self.observer.cable(i) {
            Some(CableState::Lost) => 2,
            Some(CableState::Slack) => 1,
            _ => 0,
        })
    }
}
