//! One cable over one wheel, (F1) to (F4).

use crate::error::StaticsError;
use cdpr_cable::{Cable, Catenary, ElasticLaw, Guide};

/// Friction of all pulleys of a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PulleyFriction {
    /// Coefficient μ of the cable on the wheel, 0 to 1; zero where the wheel turns with its cable.
    pub friction: f64,
    /// Friction radius of the bearing (its radius times its coefficient) over the radius of the wheel, 0 to
    /// 0.5.
    pub bearing: f64,
}

/// A cable on its pulley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulleyState {
    /// Angle over which the cable lies on the wheel [rad]; zero without a pulley.
    pub wrap: f64,
    /// Tension T0 where the cable leaves for the platform [N].
    pub tension: f64,
    /// Tension T_w at the winch [N].
    pub winch_tension: f64,
    /// Slip s: 1 where cable runs towards the winch, -1 where it runs towards the platform, between them
    /// where the wheel sticks.
    pub slip: f64,
    /// How much longer friction makes the unstrained part beyond the leave point [m], (F4).
    pub longer: f64,
    /// Integral of T - T0 over the unstrained length of lead and arc [N m].
    pub(crate) excess: f64,
}

/// Abscissas and weights of the positive half of Gauss and Legendre's rule of eight points.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

/// Halvings of the interval of slips: enough for every bit.
const HALVINGS: usize = 54;

impl PulleyFriction {
    /// Checks that both coefficients are in their ranges.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] names the field.
    pub fn validate(self) -> Result<(), StaticsError> {
        for (field, value, most) in [("friction", self.friction, 1.0), ("bearing", self.bearing, 0.5)] {
            if !(0.0..=most).contains(&value) {
                let expected = format!("a coefficient of pulleys from 0 to {most}");
                return Err(StaticsError::invalid(field.to_owned(), value, expected));
            }
        }
        Ok(())
    }

    /// Whether both coefficients are zero.
    pub fn is_none(self) -> bool {
        self == Self::default()
    }

    /// Tension at the winch over that at the leave point for a wrap [rad] and a slip, (F2); zero where the
    /// wheel can keep a cable without any tension at the winch.
    pub fn ratio(self, wrap: f64, slip: f64) -> f64 {
        let grown = (slip * self.friction * wrap).exp();
        let ((sin, cos), of_bearing) = (wrap.sin_cos(), slip * self.bearing);
        let square = of_bearing * of_bearing;
        // 1 + E² - 2 E cos θ without the difference of near numbers
        let resultant = (1.0 - grown).powi(2) + 4.0 * grown * (0.5 * wrap).sin().powi(2);
        let root = (resultant - square * sin * sin).max(0.0).sqrt();
        ((grown - square * cos + of_bearing * root) / (1.0 - square)).max(0.0)
    }

    /// Tension at the winch [N] and slip of a wheel whose winch has had the tension `before` [N], (F3).
    fn winch(self, wrap: f64, tension: f64, before: f64) -> [f64; 2] {
        let [least, most] = [-1.0, 1.0].map(|slip| tension * self.ratio(wrap, slip));
        if before <= least {
            return [least, -1.0];
        }
        if before >= most {
            return [most, 1.0];
        }
        let [mut low, mut high] = [-1.0, 1.0];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if tension * self.ratio(wrap, middle) < before { low = middle } else { high = middle }
        }
        [before, 0.5 * (low + high)]
    }

    /// The pulley of a cable whose winch has had the tension `before` [N]; `None` for that at slip zero.
    pub(super) fn state(self, catenary: &Catenary, before: Option<f64>) -> PulleyState {
        let (wrap, tension) = (catenary.wrap(), catenary.exit_tension());
        let still =
            PulleyState { wrap, tension, winch_tension: tension, slip: 0.0, longer: 0.0, excess: 0.0 };
        let (Some(guide), Some(before)) = (&catenary.cable.guide, before) else { return still };
        if wrap == 0.0 || tension == 0.0 {
            return still;
        }
        let [winch_tension, slip] = self.winch(wrap, tension, before);
        let rate = slip * self.friction;
        let [longer, excess] = led(&catenary.cable, guide, &PulleyState { winch_tension, ..still }, rate);
        PulleyState { winch_tension, slip, longer, excess, ..still }
    }
}

/// Δ [m] of (F4) and the integral of T - T0 [N m] where the tension on the wheel grows by `rate` per angle.
fn led(cable: &Cable, guide: &Guide, state: &PulleyState, rate: f64) -> [f64; 2] {
    let PulleyState { wrap, tension, winch_tension, .. } = *state;
    let own = cable.strain(tension);
    let mut sums = [0.0; 2];
    let mut add = |at: f64, length: f64| {
        let strain = cable.strain(at);
        sums[0] += length * (strain - own) / ((1.0 + own) * (1.0 + strain));
        sums[1] += length * (at - tension) / (1.0 + strain);
    };
    // The strain is smooth between the kinks of a piecewise law.
    let mut ends = vec![0.0, wrap];
    if let ElasticLaw::Piecewise(law) = cable.law {
        let angles = law.segments().map(|segment| (segment.tension / tension).ln() / rate);
        ends.extend(angles.filter(|angle| 0.0 < *angle && *angle < wrap));
        ends.sort_by(f64::total_cmp);
    }
    for pair in ends.windows(2) {
        let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        for ([x, weight], side) in GAUSS.into_iter().flat_map(|point| [(point, -half), (point, half)]) {
            add(tension * (rate * (middle + side * x)).exp(), weight * half * guide.radius);
        }
    }
    add(winch_tension, guide.lead);
    sums
}
