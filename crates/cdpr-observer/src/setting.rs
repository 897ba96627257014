//! What an observer is given: the noise of the sensors, what is known before, and how it decides.

use cdpr_statics::StaticsError;

/// Noise, prior knowledge and alarms of an observer.
#[derive(Clone, Debug, PartialEq)]
pub struct ObserverSetting {
    /// Standard deviation of the tension that each cable's sensor reads [N].
    pub tension_std: Vec<f64>,
    /// Standard deviation of each unstrained length [m]; zero where lengths count as exact.
    pub length_std: f64,
    /// Standard deviation of the load before the first sample [kg]: loads of several times this mass are
    /// implausible. The mean is no load.
    pub payload_std: f64,
    /// Standard deviation of the distance between the load's centre and that of the platform, along each axis
    /// [m]; zero where they coincide.
    pub center_std: f64,
    /// Standard deviation of the modulus as a share of the robot's; zero where it is known.
    pub modulus_std: f64,
    /// Number of samples after which a sample has lost most of its weight; infinite for none that loses any.
    pub memory: f64,
    /// Probability that an alarm begins at a sample although nothing is wrong, 1e-15 to 0.1.
    pub false_alarm: f64,
    /// Number of samples in a row that have to deviate for an alarm, 1 to 1000.
    pub consecutive: usize,
}

impl ObserverSetting {
    /// Sensors of tension with this standard deviation [N] on each of `cables` cables, exact lengths, a load
    /// of up to some times `payload_std` [kg] with its centre within some times `center_std` [m] of that of
    /// the platform, a known modulus, no forgetting, and alarms that are false once in 10^9 samples.
    pub fn new(cables: usize, tension_std: f64, payload_std: f64, center_std: f64) -> Self {
        Self {
            tension_std: vec![tension_std; cables],
            length_std: 0.0,
            payload_std,
            center_std,
            modulus_std: 0.0,
            memory: f64::INFINITY,
            false_alarm: 1e-9,
            consecutive: 3,
        }
    }

    /// Refuses what is out of range.
    pub(crate) fn check(&self, cables: usize) -> Result<(), StaticsError> {
        if self.tension_std.len() != cables {
            let expected = format!("a number for each of the {cables} cables");
            return Err(invalid("tension_std", format!("a list of {}", self.tension_std.len()), expected));
        }
        for (i, std) in self.tension_std.iter().enumerate() {
            demand(&format!("tension_std[{i}]"), *std, 1e-9..=1e9, "a standard deviation [N]")?;
        }
        demand("length_std", self.length_std, 0.0..=1e3, "a standard deviation [m], zero or more")?;
        demand("payload_std", self.payload_std, 0.0..=1e9, "a standard deviation [kg], zero or more")?;
        demand("center_std", self.center_std, 0.0..=1e3, "a standard deviation [m], zero or more")?;
        demand("modulus_std", self.modulus_std, 0.0..=0.15, "a share from 0 to 0.15")?;
        demand("memory", self.memory, 1.0..=f64::INFINITY, "a number of samples, 1 or more")?;
        demand("false_alarm", self.false_alarm, 1e-15..=0.1, "a probability from 1e-15 to 0.1")?;
        demand("consecutive", self.consecutive as f64, 1.0..=1000.0, "a number of samples, 1 to 1000")
    }
}

fn demand(
    field: &str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    expected: &str,
) -> Result<(), StaticsError> {
    if range.contains(&value) { Ok(()) } else { Err(invalid(field, value, expected)) }
}

pub(crate) fn invalid(field: &str, value: impl ToString, expected: impl ToString) -> StaticsError {
    StaticsError::Invalid {
        field: field.to_owned(),
        value: value.to_string(),
        expected: expected.to_string(),
    }
}
