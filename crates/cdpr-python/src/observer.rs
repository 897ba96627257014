//! `Observer`: what lengths and measured tensions say about the load and the cables, one sample after the
//! other.

use crate::convert::{Answer, Cases, Columns, Numbers, Raised, Rows, answer, plotted, run};
use crate::robot::Robot;
use cdpr_observer::{Alarm, CableState, Estimate, LoadObserver, Observed, ObserverSetting};
use cdpr_statics::StaticsError;
use pyo3::prelude::*;
use std::sync::atomic::Ordering;
use std::sync::{Mutex, MutexGuard, PoisonError};

answer! {
    /// What is known after each sample, and what the sample says.
    ///
    /// The answer is of one sample, or of m: then every field has a first axis of m.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct LoadEstimates {
        /// Mass of the load [kg].
        payload: Py<PyAny>,
        /// Its standard deviation [kg].
        payload_std: Py<PyAny>,
        /// Centre of the load in the frame of the platform, from P [m], (3,); NaN where the load is below
        /// three times its standard deviation, or where the samples have not halved the uncertainty of its
        /// moment.
        center: Py<PyAny>,
        /// Its standard deviation [m], (3,).
        center_std: Py<PyAny>,
        /// Modulus of the cables as a multiple of the robot's.
        modulus: Py<PyAny>,
        /// Its standard deviation.
        modulus_std: Py<PyAny>,
        /// Force that the measured tensions hold in addition to the platform's weight, base frame [N], (3,).
        force: Py<PyAny>,
        /// Its moment about P [N m], (3,).
        moment: Py<PyAny>,
        /// Chi-square of the readings for the best plausible load.
        consistency: Py<PyAny>,
        /// Chi-square of the readings for the load that was known before.
        change: Py<PyAny>,
        /// The value beyond which a chi-square deviates.
        threshold: Py<PyAny>,
        /// none, load_changed, cable_slack, cable_lost or inconsistent.
        alarm: Py<PyAny>,
        /// Cables that read no tension, as the model allows, (n,).
        slack: Py<PyAny>,
        /// Cables that read no tension although the model has them taut, and no plausible load explains it,
        /// (n,).
        lost: Py<PyAny>,
        /// Whether the model found a rest for the lengths; if not, the sample changed nothing.
        converged: Py<PyAny>,
        /// None for each sample: one without a rest has not converged, and the estimate is that before it.
        reasons: Py<PyAny>,
    }
}

plotted!(LoadEstimates);

/// One sample.
struct Sample {
    observed: Observed,
    estimate: Estimate,
    states: Vec<CableState>,
}

/// Observes payload, centre of mass, modulus and broken cables from lengths and measured tensions.
///
/// It keeps the rest of the robot at the last sample, and its estimate with the covariance: recursive least
/// squares on the exact derivatives of the direct model. Sensors read the tensions at the platform; their
/// errors are independent from sample to sample but for a constant one, which `tare` removes.
///
/// Parameters
/// ----------
/// robot : Robot
///     The robot.
/// lengths : array_like
///     Unstrained lengths with which it rests without load [m], (n,).
/// pose : array_like
///     The pose of this rest, or near it, (3,) or (7,).
/// tension_std : array_like
///     Standard deviation of what the sensors read [N], one or one for each cable.
/// payload_std : float
///     Standard deviation of the load before the first sample [kg]; its mean is no load.
/// center_std : float, optional
///     Standard deviation of the distance between its centre and that of the platform along each axis [m].
/// length_std : float, optional
///     Standard deviation of each length [m]; 0 where lengths count as exact.
/// modulus_std : float, optional
///     Standard deviation of the modulus as a share of the robot's, 0 to 0.15; 0 where it is known.
/// memory : float, optional
///     Number of samples after which a sample has lost most of its weight; if left out, none loses any.
/// false_alarm : float, optional
///     Probability that an alarm begins at a sample although nothing is wrong.
/// consecutive : int, optional
///     Number of samples in a row that have to deviate for an alarm.
///
/// Raises
/// ------
/// InputError
///     For an invalid value; the message names it and what would be right.
/// NoSolutionError
///     Where the robot does not rest with these lengths.
///
/// Examples
/// --------
/// >>> import cdpr
/// >>> robot = cdpr.Robot.from_file("caroca")
/// >>> found = robot.deflection([0, 0, 1.75], payload=5)
/// >>> observer = cdpr.Observer(robot, found.lengths, [0, 0, 1.75], tension_std=5, payload_std=20)
/// >>> samples = observer.update([found.lengths] * 100, [found.loaded.tensions] * 100)
/// >>> f"{samples.payload[-1]:.2f} kg, alarm {samples.alarm[-1]}"
/// '5.00 kg, alarm none'
#[pyclass(frozen, module = "cdpr")]
pub(crate) struct Observer {
    observer: Mutex<LoadObserver>,
    cables: usize,
}

#[pymethods]
impl Observer {
    #[new]
    #[pyo3(signature = (robot, lengths, pose, *, tension_std, payload_std, center_std=0.0, length_std=0.0,
        modulus_std=0.0, memory=f64::INFINITY, false_alarm=1e-9, consecutive=3))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python,
        robot: &Robot,
        lengths: Numbers,
        pose: Numbers,
        tension_std: Numbers,
        payload_std: f64,
        center_std: f64,
        length_std: f64,
        modulus_std: f64,
        memory: f64,
        false_alarm: f64,
        consecutive: usize,
    ) -> Answer<Self> {
        let (robot, cables) = (&robot.robot, robot.robot.cables.len());
        let lengths = Rows::of_cables("lengths", &lengths, cables)?;
        let pose = Rows::poses("pose", &pose, robot)?;
        if !Cases::of(&[&lengths, &pose])?.single {
            return Err(Raised::Input("lengths or pose has several rows: expected one".to_owned()));
        }
        let tension_std = match Rows::scalars("tension_std", &tension_std) {
            Ok(std) if std.number() == 1 => vec![std.scalar(0); cables],
            _ => Rows::of_cables("tension_std", &tension_std, cables)?.row(0).to_vec(),
        };
        let setting = ObserverSetting {
            tension_std,
            length_std,
            payload_std,
            center_std,
            modulus_std,
            memory,
            false_alarm,
            consecutive,
        };
        let start = pose.pose(0)?;
        let observer = run(py, |_| LoadObserver::new(robot, lengths.row(0), &start, setting))??;
        Ok(Self { observer: Mutex::new(observer), cables })
    }

    /// Takes samples without load: the mean difference between tensions and model over all such samples is
    /// the constant error of each sensor, which later samples subtract.
    ///
    /// Parameters
    /// ----------
    /// lengths : array_like
    ///     Unstrained lengths [m], (n,) or (m, n).
    /// tensions : array_like
    ///     Measured tensions at the platform [N], (n,) or (m, n).
    ///
    /// Returns
    /// -------
    /// LoadEstimates
    ///     Without chi-squares and alarms.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right.
    fn tare(&self, py: Python, lengths: Numbers, tensions: Numbers) -> Answer<LoadEstimates> {
        self.samples(py, &lengths, &tensions, LoadObserver::tare)
    }

    /// Takes samples, one after the other.
    ///
    /// Parameters
    /// ----------
    /// lengths : array_like
    ///     Unstrained lengths [m], (n,) or (m, n).
    /// tensions : array_like
    ///     Measured tensions at the platform [N], (n,) or (m, n).
    ///
    /// Returns
    /// -------
    /// LoadEstimates
    ///     What is known after each sample.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right.
    fn update(&self, py: Python, lengths: Numbers, tensions: Numbers) -> Answer<LoadEstimates> {
        self.samples(py, &lengths, &tensions, LoadObserver::update)
    }
}

type Take = fn(&mut LoadObserver, &[f64], &[f64]) -> Result<Observed, StaticsError>;

impl Observer {
    fn locked(&self) -> MutexGuard<'_, LoadObserver> {
        self.observer.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn samples(
        &self,
        py: Python,
        lengths: &Numbers,
        tensions: &Numbers,
        take: Take,
    ) -> Answer<LoadEstimates> {
        let lengths = Rows::of_cables("lengths", lengths, self.cables)?;
        let tensions = Rows::of_cables("tensions", tensions, self.cables)?;
        let cases = Cases::of(&[&lengths, &tensions])?;
        let samples = run(py, |stop| -> Result<Vec<Result<Sample, StaticsError>>, StaticsError> {
            let observer = &mut *self.locked();
            let mut samples = Vec::new();
            for k in (0..cases.count).take_while(|_| !stop.load(Ordering::Relaxed)) {
                let observed = take(observer, lengths.row(k), tensions.row(k))?;
                let states = (0..self.cables).filter_map(|i| observer.cable(i)).collect();
                samples.push(Ok(Sample { observed, estimate: observer.estimate(), states }));
            }
            Ok(samples)
        })??;
        let cases = Cases { count: samples.len(), ..cases };
        LoadEstimates::new(&Columns::new(py, cases, &samples)?, self.cables)
    }
}

impl LoadEstimates {
    fn new(all: &Columns<Sample>, cables: usize) -> Answer<Self> {
        let blank = |of: [Option<f64>; 3]| of.map(|value| value.unwrap_or(f64::NAN));
        let are = |state: CableState| {
            all.array(false, &[cables], move |sample, out| {
                out.iter_mut().zip(&sample.states).for_each(|(out, of)| *out = *of == state);
            })
        };
        let alarm = |sample: &Sample| match sample.observed.alarm {
            None => "none",
            Some(Alarm::LoadChanged) => "load_changed",
            Some(Alarm::CableSlack(_)) => "cable_slack",
            Some(Alarm::CableLost(_)) => "cable_lost",
            Some(Alarm::Inconsistent) => "inconsistent",
        };
        Ok(Self {
            payload: all.number(|sample| sample.estimate.payload)?,
            payload_std: all.number(|sample| sample.estimate.payload_std)?,
            center: all.vector(|sample| blank(sample.estimate.center))?,
            center_std: all.vector(|sample| blank(sample.estimate.center_std))?,
            modulus: all.number(|sample| sample.estimate.modulus)?,
            modulus_std: all.number(|sample| sample.estimate.modulus_std)?,
            force: all.vector(|sample| sample.observed.wrench.force.into())?,
            moment: all.vector(|sample| sample.observed.wrench.moment.into())?,
            consistency: all.number(|sample| sample.observed.consistency)?,
            change: all.number(|sample| sample.observed.change)?,
            threshold: all.number(|sample| sample.observed.threshold)?,
            alarm: all.words(|sample| alarm(sample).to_owned())?,
            slack: are(CableState::Slack)?,
            lost: are(CableState::Lost)?,
            converged: all.array(false, &[], |sample, out| out[0] = sample.observed.converged)?,
            reasons: all.reasons(),
        })
    }
}
