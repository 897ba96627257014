//! Payload, centre of mass and modulus from lengths and tensions, by recursive least squares.
//!
//! The unknowns θ in units of their prior standard deviations, ξ, have the information A, the unit matrix
//! before the first sample. A sample with the whitened residuals ẽ at the last estimate and their exact
//! derivatives J̃ (O3) gives
//!
//! ```text
//! A <- 1 + λ (A - 1) + J̃ᵀ J̃,      ξ <- ξ + A⁻¹ J̃ᵀ ẽ,      λ = 1 - 1/memory                        (O6)
//! ```
//!
//! the extended Kalman filter of constant unknowns in information form (Ljung 1979, "Asymptotic behavior of
//! the extended Kalman filter as a parameter estimator"), with a memory that never loses the prior.
//!
//! **Two statistics** decide about a sample, (O4): χ²(A) is small if the *estimated* load explains it, and
//! χ²(A') if *some* plausible load does, where A' has the information of the prior about the load and of A
//! about the modulus. χ²(A') <= χ²(A). Samples of which χ²(A) is beyond its quantile do not change the
//! estimate, and for them χ²(A') is that of the best load, not of the derivatives at the last one. c of them
//! in a row are a changed load, whose information begins with A', or, if χ²(A') is beyond the quantile, too,
//! a fault. The first sample changes nothing that was known: it is explained if some plausible load does, and
//! the estimate begins with the best one.

use crate::alarm::{Alarm, CableState, Run, Thresholds};
use crate::rest::{MODULUS, Rest, Unknowns};
use crate::setting::{ObserverSetting, invalid};
use crate::whitened::{Normal, Sample};
use cdpr_robot::{Pose, Robot, Wrench};
use cdpr_statics::{DirectStart, Load, StaticsError, direct};
use nalgebra::Matrix5;

/// Greatest deviation of an unknown from its prior, in standard deviations.
const MOST: f64 = 6.0;

/// Iterations of the search for another load.
const SEARCHES: usize = 4;

/// Observes the load and the cables of a robot from its unstrained lengths and measured tensions.
///
/// The robot is in static equilibrium at each sample: motions have to be so slow that inertia is small
/// compared with the noise. Errors of sensors are independent from sample to sample; constant ones of the
/// tensions are removed by [`LoadObserver::tare`]. A sample allocates nothing.
///
/// ```
/// use cdpr_observer::{LoadObserver, ObserverSetting};
/// use cdpr_robot::{Pose, Robot};
/// use cdpr_statics::{Load, deflection};
///
/// let robot = Robot::from_library("caroca")?;
/// let pose = Pose::at(0.0, 0.0, 1.75);
/// let found = deflection(&robot, &pose, &Load::payload(5.0))?;
/// let (lengths, tensions) = (&found.lengths, found.loaded.equilibrium.tensions());
/// let setting = ObserverSetting::new(8, 5.0, 20.0, 0.0); // 5 N, loads of some 20 kg
/// let mut observer = LoadObserver::new(&robot, lengths, &pose, setting)?;
/// for _ in 0..500 {
///     observer.update(lengths, &tensions)?;
/// }
/// let estimate = observer.estimate();
/// assert!((estimate.payload - 5.0).abs() < 0.01 && estimate.payload_std < 0.1);
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
#[derive(Clone)]
pub struct LoadObserver {
    setting: ObserverSetting,
    thresholds: Thresholds,
    /// Standard deviations of the unknowns before the first sample.
    prior: Unknowns,
    rest: Rest,
    /// ξ of (O6).
    scaled: Unknowns,
    /// A of (O6).
    information: Matrix5<f64>,
    sample: Sample,
    /// Constant errors of the sensors [N], and the number of samples that they are the mean of.
    bias: Vec<f64>,
    tared: usize,
    changed: Run,
    inconsistent: Run,
    /// Of each cable that reads no tension.
    slack: Vec<Run>,
    states: Vec<CableState>,
}

/// What is known of the load and the cables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mass of the load [kg].
    pub payload: f64,
    /// Its standard deviation [kg].
    pub payload_std: f64,
    /// Centre of the load in the frame of the platform, from P [m]; `None` where the load is below three
    /// times its standard deviation, or where the samples have not halved the uncertainty of its moment.
    pub center: [Option<f64>; 3],
    /// Its standard deviation [m].
    pub center_std: [Option<f64>; 3],
    /// Modulus of the cables as a multiple of the robot's.
    pub modulus: f64,
    /// Its standard deviation: that of the prior where the samples say nothing.
    pub modulus_std: f64,
}

/// What a sample says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observed {
    /// Whether a rest was found for the lengths; if not, the sample changes nothing, and `wrench` and the
    /// statistics are not numbers.
    pub converged: bool,
    /// Iterations of Newton's method, at most 12.
    pub iterations: usize,
    /// The wrench about P, in the base frame, that the measured tensions hold besides the platform's weight,
    /// at the pose and in the directions of the model [N, N m].
    pub wrench: Wrench,
    /// Chi-square of the readings for the best load of the prior.
    pub consistency: f64,
    /// Chi-square of the readings for the estimated load.
    pub change: f64,
    /// The value that a chi-square exceeds with the probability of (O5).
    pub threshold: f64,
    /// What the last samples in a row say; an alarm lasts as long as the samples deviate.
    pub alarm: Option<Alarm>,
}

impl LoadObserver {
    /// Starts at the rest without load for `lengths` [m] that the direct model finds from `start`.
    ///
    /// # Errors
    /// Those of [`direct`]; [`StaticsError::Invalid`] for a setting out of range, and for a robot with
    /// motions that nothing resists.
    pub fn new(
        robot: &Robot,
        lengths: &[f64],
        start: &Pose,
        setting: ObserverSetting,
    ) -> Result<Self, StaticsError> {
        let cables = robot.cables.len();
        robot.validate()?;
        setting.check(cables)?;
        let found = direct(robot, lengths, &Load::none(), DirectStart::Pose(start))?;
        let mut rest = Rest::new(robot, found.equilibrium.pose, lengths);
        let scaled = Unknowns::zeros();
        let moment = setting.payload_std * setting.center_std;
        let prior = Unknowns::new(setting.payload_std, moment, moment, moment, setting.modulus_std);
        if rest.solve(lengths, &unknowns(&scaled, &prior)).is_none() {
            return Err(invalid("robot", &robot.name, "one whose every motion is resisted"));
        }
        let thresholds = Thresholds::new(cables, setting.false_alarm, setting.consecutive);
        Ok(Self {
            setting,
            thresholds,
            prior,
            rest,
            scaled,
            information: Matrix5::identity(),
            sample: Sample::new(cables),
            bias: vec![0.0; cables],
            tared: 0,
            changed: Run::default(),
            inconsistent: Run::default(),
            slack: vec![Run::default(); cables],
            states: vec![CableState::Taut; cables],
        })
    }

    /// Takes a sample at a known load, that of the estimate: what the tensions deviate from the model in the
    /// mean of all such samples is the constant error of each sensor, and is subtracted from later readings.
    ///
    /// Before the first sample the load is zero: tare the empty robot. The uncertainty of the mean does not
    /// enter later covariances: take many more samples than the accuracy needs.
    ///
    /// # Errors
    /// As [`LoadObserver::update`].
    pub fn tare(&mut self, lengths: &[f64], tensions: &[f64]) -> Result<Observed, StaticsError> {
        let iterations = self.solve(lengths, tensions)?;
        if iterations.is_some() {
            self.tared += 1;
            for ((bias, tension), cable) in self.bias.iter_mut().zip(tensions).zip(&self.rest.cables) {
                *bias += (tension - cable.tension - *bias) / self.tared as f64;
            }
        }
        Ok(self.nothing(iterations, tensions))
    }

    /// Takes a sample: unstrained lengths [m] and measured tensions at the platform [N].
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless there is a finite, positive length and a finite tension for each
    /// cable.
    pub fn update(&mut self, lengths: &[f64], tensions: &[f64]) -> Result<Observed, StaticsError> {
        let iterations = self.solve(lengths, tensions)?;
        let mut observed = self.nothing(iterations, tensions);
        if iterations.is_some() {
            // Without derivatives there are no statistics.
            let _ = self.take(lengths, tensions, &mut observed);
        }
        Ok(observed)
    }

    /// Rest for the lengths with the load of the estimate, and the number of iterations.
    fn solve(&mut self, lengths: &[f64], tensions: &[f64]) -> Result<Option<usize>, StaticsError> {
        let cables = self.bias.len();
        for (field, given) in [("lengths", lengths.len()), ("tensions", tensions.len())] {
            if given != cables {
                let expected = format!("a number for each of the {cables} cables");
                return Err(invalid(field, format!("a list of {given}"), expected));
            }
        }
        if let Some(i) = lengths.iter().position(|length| !(length.is_finite() && *length > 0.0)) {
            return Err(invalid(&format!("lengths[{i}]"), lengths[i], "a finite, positive number [m]"));
        }
        if let Some(i) = tensions.iter().position(|tension| !tension.is_finite()) {
            return Err(invalid(&format!("tensions[{i}]"), tensions[i], "a finite number [N]"));
        }
        Ok(self.rest.solve(lengths, &unknowns(&self.scaled, &self.prior)))
    }

    /// A sample without statistics.
    fn nothing(&self, iterations: Option<usize>, tensions: &[f64]) -> Observed {
        let wrench = match iterations {
            Some(_) => self.rest.residual_wrench(tensions.iter().zip(&self.bias).map(|(t, bias)| t - bias)),
            None => Wrench::from_vector(&nalgebra::Vector6::repeat(f64::NAN)),
        };
        Observed {
            converged: iterations.is_some(),
            iterations: iterations.unwrap_or(crate::rest::MOST_ITERATIONS),
            wrench,
            consistency: f64::NAN,
            change: f64::NAN,
            threshold: self.thresholds.chi_square,
            alarm: None,
        }
    }

    /// Statistics, alarms and (O6) of a sample.
    fn take(&mut self, lengths: &[f64], tensions: &[f64], observed: &mut Observed) -> Option<()> {
        let ObserverSetting { memory, consecutive, .. } = self.setting;
        let normal = self.normal(lengths, tensions)?;
        let prior = Matrix5::identity();
        let information = prior + (1.0 - 1.0 / memory) * (self.information - prior);
        let mut any_load = prior;
        any_load[(MODULUS, MODULUS)] = 1.0 / information.try_inverse()?[(MODULUS, MODULUS)];
        let (change, factor) = normal.chi_square(&information)?;
        let (mut consistency, _) = normal.chi_square(&any_load)?;
        let begins = self.information == prior;
        let follows = !begins && change <= self.thresholds.chi_square;
        if follows {
            self.information = information + normal.matrix;
            self.scaled = bounded(self.scaled + factor.solve(&normal.right));
        }
        let mut found = None;
        if !follows {
            let before = (self.rest.pose, self.scaled);
            found = self.search(lengths, tensions, &any_load, normal);
            consistency = found.as_ref().map_or(consistency, |(least, ..)| least.min(consistency));
            // What was searched is not the estimate yet.
            self.rest.pose = before.0;
            self.rest.solve(lengths, &unknowns(&before.1, &self.prior))?;
        }
        (observed.consistency, observed.change) = (consistency, if begins { consistency } else { change });
        let is_explained = consistency <= self.thresholds.chi_square;
        let is_inconsistent = self.inconsistent.count(!is_explained, consecutive);
        let is_changed = self.changed.count(!begins && !follows && is_explained, consecutive);
        let lost = self.cable_states(lengths, tensions, is_inconsistent);
        if let (true, Some((_, scaled, normal))) = (is_changed || begins && is_explained, found) {
            self.changed = Run::default();
            (self.scaled, self.information) = (scaled, any_load + normal.matrix);
            if is_changed {
                observed.alarm = Some(lost.map_or(Alarm::LoadChanged, Alarm::CableSlack));
            }
        }
        if is_inconsistent {
            observed.alarm = Some(lost.map_or(Alarm::Inconsistent, Alarm::CableLost));
        }
        Some(())
    }

    /// Residuals and derivatives of a sample at the rest at hand.
    fn normal(&mut self, lengths: &[f64], tensions: &[f64]) -> Option<Normal> {
        let ObserverSetting { tension_std, length_std, .. } = &self.setting;
        let Sample { residuals, rows, .. } = &mut self.sample;
        for (i, (residual, cable)) in residuals.iter_mut().zip(&self.rest.cables).enumerate() {
            *residual = tensions[i] - self.bias[i] - cable.tension;
        }
        self.rest.tensions_per_unknown(lengths, rows);
        rows.iter_mut().for_each(|row| row.component_mul_assign(&self.prior));
        self.sample.whiten(&self.rest, lengths, tension_std, *length_std)?;
        Some(self.sample.normal())
    }

    /// The least chi-square of the readings over the loads near the estimate, with the information
    /// `any_load`, its unknowns, and the derivatives there; by Gauss and Newton, because cables become slack
    /// on the way.
    fn search(
        &mut self,
        lengths: &[f64],
        tensions: &[f64],
        any_load: &Matrix5<f64>,
        mut normal: Normal,
    ) -> Option<(f64, Unknowns, Normal)> {
        let mut scaled = self.scaled;
        for _ in 0..SEARCHES {
            let factor = (any_load + normal.matrix).cholesky()?;
            let back = any_load * (self.scaled - scaled);
            scaled = bounded(scaled + factor.solve(&(normal.right + back)));
            self.rest.solve(lengths, &unknowns(&scaled, &self.prior))?;
            normal = self.normal(lengths, tensions)?;
        }
        let away = scaled - self.scaled;
        Some((normal.square + away.dot(&(any_load * away)), scaled, normal))
    }

    /// Finds the state of each cable, and of those that read none although the model has them taut the one
    /// with the greatest tension there.
    fn cable_states(&mut self, lengths: &[f64], tensions: &[f64], is_inconsistent: bool) -> Option<usize> {
        let mut greatest = None;
        let mut of_greatest = 0.0;
        for (i, cable) in self.rest.cables.iter().enumerate() {
            let reading = tensions[i] - self.bias[i];
            let noise = self.thresholds.normal * self.setting.tension_std[i];
            let weight = self.rest.robot().cable(i).weight_per_length * lengths[i];
            let is_slack = self.slack[i].count(reading <= noise + weight, self.setting.consecutive);
            let is_lost = is_slack && cable.tension - reading > noise + weight;
            self.states[i] = match (is_slack, is_lost && is_inconsistent) {
                (_, true) => CableState::Lost,
                (true, _) => CableState::Slack,
                _ => CableState::Taut,
            };
            if is_lost && cable.tension > of_greatest {
                (greatest, of_greatest) = (Some(i), cable.tension);
            }
        }
        greatest
    }

    /// What is known after the last sample.
    pub fn estimate(&self) -> Estimate {
        let covariance = self.covariance();
        let unknowns = unknowns(&self.scaled, &self.prior);
        let std = |k: usize| covariance[(k, k)].max(0.0).sqrt();
        let payload = unknowns[0];
        let has_center = payload.abs() > 3.0 * std(0);
        let origin = self.rest.robot().platform.center_of_mass;
        let (mut center, mut center_std) = ([None; 3], [None; 3]);
        for k in 0..3 {
            if has_center && std(k + 1) <= 0.5 * self.prior[k + 1] {
                let lever = unknowns[k + 1] / payload;
                let spread = covariance[(k + 1, k + 1)] - 2.0 * lever * covariance[(0, k + 1)]
                    + lever * lever * covariance[(0, 0)];
                center[k] = Some(origin[k] + lever);
                center_std[k] = Some(spread.max(0.0).sqrt() / payload.abs());
            }
        }
        let (modulus, modulus_std) = (unknowns[MODULUS], std(MODULUS));
        Estimate { payload, payload_std: std(0), center, center_std, modulus, modulus_std }
    }

    /// Covariance of the load's mass [kg], its first moment about the platform's centre of mass in the
    /// platform's frame [kg m], and the modulus as a multiple of the robot's.
    pub fn covariance(&self) -> Matrix5<f64> {
        let inverse = self.information.try_inverse().unwrap_or_else(Matrix5::identity);
        inverse.component_mul(&(self.prior * self.prior.transpose()))
    }

    /// What the last samples say about a cable; `None` beyond the last one.
    pub fn cable(&self, i: usize) -> Option<CableState> {
        self.states.get(i).copied()
    }

    /// Pose of the platform at the last sample, with the load of the estimate before it.
    pub fn pose(&self) -> &Pose {
        &self.rest.pose
    }

    /// Tensions of the model at the last sample [N].
    pub fn tensions(&self) -> impl Iterator<Item = f64> {
        self.rest.cables.iter().map(|cable| cable.tension)
    }
}

/// Within what is plausible.
fn bounded(scaled: Unknowns) -> Unknowns {
    scaled.map(|of| of.clamp(-MOST, MOST))
}

/// The unknowns in their units.
fn unknowns(scaled: &Unknowns, prior: &Unknowns) -> Unknowns {
    let mut unknowns = scaled.component_mul(prior);
    unknowns[MODULUS] += 1.0;
    unknowns
}
