//! The whole robot in weather, and how it is said.

use crate::program::answer::{OutOfLimits, Residual};
use crate::program::arguments::towards;
use crate::program::pose::safety::case::{Factor, Greatest};
use cdpr_assess::{AnyWeather, DIRECTIONS, InWind, Winds};
use cdpr_robot::{Robot, significant};
use cdpr_statics::Load;
use cdpr_statics::limits::Limit;
use serde::Serialize;

/// Its columns in a table.
pub(super) const COLUMNS: [&str; 8] = [
    "weather_moved_mm",
    "weather_azimuth_deg",
    "weather_greatest_tension_n",
    "weather_greatest_tension_cable",
    "weather_greatest_tension_azimuth_deg",
    "weather_safety_factor",
    "weather_safety_factor_cable",
    "weather_reason",
];

/// The platform in wind of all directions that were looked at, or of one.
#[derive(Serialize)]
pub(super) struct InWeather {
    /// Speed of a wind from any direction [m/s].
    #[serde(rename = "speed_m_per_s", skip_serializing_if = "Option::is_none")]
    speed: Option<f64>,
    #[serde(skip)]
    tilted: bool,
    /// Whether there is wind, and no force that may be that on the platform.
    #[serde(skip)]
    on_cables_alone: bool,
    /// Winds that were looked at.
    directions: usize,
    /// The wind that moves the platform farthest; absent where there is no rest in any.
    #[serde(skip_serializing_if = "Option::is_none")]
    farthest: Option<OneWind>,
    /// The wind with the greatest tension.
    #[serde(skip_serializing_if = "Option::is_none")]
    tightest: Option<OneWind>,
    /// The least safety factor in any wind; absent where a breaking force is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    least_safe: Option<LeastSafe>,
    /// Whether what is wrong is a tension.
    #[serde(skip)]
    is_overloaded: bool,
    /// A wind in which something is wrong.
    #[serde(skip_serializing_if = "Option::is_none")]
    wrong: Option<String>,
    /// A wind in which no rest was found: whether the robot bears it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_found: Option<String>,
    /// A wind in which a tension falls below its least one.
    #[serde(skip_serializing_if = "Option::is_none")]
    below_least: Option<String>,
}

/// The least breaking force over tension.
#[derive(Serialize)]
struct LeastSafe {
    factor: f64,
    /// Number of the cable, from 1.
    cable: usize,
    /// Direction in which that wind blows; absent for a wind of one velocity.
    #[serde(skip_serializing_if = "Option::is_none")]
    azimuth_deg: Option<f64>,
}

impl LeastSafe {
    fn new((found, factor, cable): (&InWind, f64, usize)) -> Self {
        let azimuth_deg = found.azimuth.map(|azimuth| azimuth.to_degrees().rem_euclid(360.0));
        Self { factor, cable: cable + 1, azimuth_deg }
    }
}

/// The platform in one wind.
#[derive(Serialize)]
struct OneWind {
    /// Direction in which it blows, from x to y; absent for a wind of one velocity.
    #[serde(skip_serializing_if = "Option::is_none")]
    azimuth_deg: Option<f64>,
    /// Position of P [m] and quaternion, qw first.
    position: [f64; 3],
    rotation: [f64; 4],
    /// From where the platform is held without the weather.
    displacement_mm: [f64; 3],
    moved_mm: f64,
    turned_deg: f64,
    tensions: Vec<f64>,
    exit_tensions: Vec<f64>,
    greatest_tension: Greatest,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
    #[serde(flatten)]
    factor: Factor,
    below_ground: bool,
    residual: Residual,
}

impl OneWind {
    fn new(found: &InWind) -> Self {
        let (tension, cable) = found.greatest_tension();
        Self {
            azimuth_deg: found.azimuth.map(|azimuth| azimuth.to_degrees().rem_euclid(360.0)),
            position: found.rest.pose.position.into(),
            rotation: found.rest.pose.quaternion(),
            displacement_mm: (1e3 * found.displacement).into(),
            moved_mm: 1e3 * found.moved(),
            turned_deg: found.turned.to_degrees(),
            tensions: found.rest.tensions(),
            exit_tensions: found.rest.exit_tensions.clone(),
            greatest_tension: Greatest { cable: cable + 1, tension },
            out_of_limits: found.out_of_limits.iter().copied().map(OutOfLimits::new).collect(),
            factor: found.safety_factor.into(),
            below_ground: found.below_ground,
            residual: Residual::new(&found.rest.residual),
        }
    }
}

/// What is wrong in one wind: the gravest has the least kind, and of one kind the greatest excess.
fn wrong(found: &InWind) -> Option<(Option<Limit>, f64, String)> {
    let gravest = found.gravest().filter(|one| one.is_too_much());
    let beyond = gravest.map(|one| (Some(one.limit), one.excess(), one.to_string()));
    let below = || found.below_ground.then(|| (None, 0.0, "the platform comes below the ground".to_owned()));
    let (limit, excess, what) = beyond.or_else(below)?;
    Some((limit, excess, format!("{what}, in wind{}", towards(found.azimuth))))
}

impl InWeather {
    pub(super) fn new(robot: &Robot, weather: &AnyWeather, found: &Winds, load: &Load) -> Self {
        let mut failed = found.failures.iter();
        let not_found = failed
            .next()
            .map(|(azimuth, error)| format!("no rest was found in wind{} ({error})", towards(*azimuth)));
        let gravest = found.rests.iter().filter_map(wrong).min_by(|a, b| {
            // What is passed counts more than the ground.
            let kind = a.0.is_none().cmp(&b.0.is_none()).then(a.0.cmp(&b.0));
            kind.then(b.1.total_cmp(&a.1))
        });
        let below = found.rests.iter().flat_map(|one| {
            let passed = one.out_of_limits.iter().filter(|passed| passed.limit == Limit::Min);
            passed.map(move |passed| (passed, one.azimuth))
        });
        let below = below.max_by(|(a, _), (b, _)| a.excess().total_cmp(&b.excess()));
        Self {
            speed: weather.speed,
            tilted: robot.gravity.level().is_some(),
            on_cables_alone: (weather.speed.is_some() || !weather.weather.wind.is_calm())
                && load.wrench.force.norm() == 0.0,
            directions: found.rests.len() + found.failures.len(),
            farthest: found.farthest().map(OneWind::new),
            tightest: found.tightest().map(OneWind::new),
            least_safe: found.least_safe().map(LeastSafe::new),
            is_overloaded: gravest.as_ref().is_some_and(|(limit, _, _)| limit.is_some()),
            wrong: gravest.map(|(_, _, what)| what),
            not_found,
            below_least: below.map(|(least, azimuth)| format!("{least}, in wind{}", towards(azimuth))),
        }
    }

    /// How the robot bears the weather, in one word.
    pub(super) fn ending(&self) -> String {
        let word = match (&self.wrong, &self.not_found) {
            (Some(_), _) if self.is_overloaded => "overloaded",
            (Some(_), _) => "below_ground",
            (None, Some(_)) => "no_rest",
            (None, None) => "held",
        };
        word.to_owned()
    }

    /// Whether the platform comes below the ground in a wind.
    pub(super) fn is_below_ground(&self) -> bool {
        self.wrong.is_some() && !self.is_overloaded
    }

    /// The least safety factor in any wind.
    pub(super) fn factor(&self) -> Factor {
        let least = self.least_safe.as_ref();
        Factor { value: least.map(|of| of.factor), cable: least.map(|of| of.cable) }
    }

    /// What is wrong, or not known.
    pub(super) fn wrong(&self) -> Option<&str> {
        self.wrong.as_deref().or(self.not_found.as_deref())
    }

    /// The verdict, and the winds that move the platform farthest and pull most.
    pub(super) fn sentences(&self, heading: &str) -> Vec<String> {
        let winds = match self.speed {
            Some(speed) => format!(
                "wind of {speed} m/s from {DIRECTIONS} directions, and from {} of searches for the worst ones",
                self.directions.saturating_sub(DIRECTIONS)
            ),
            None => "the weather".to_owned(),
        };
        let first = match (&self.wrong, &self.not_found) {
            (None, None) => format!("{heading} bears {winds}: no tension is too great."),
            (Some(what), _) => format!("{heading} does not bear {winds}: {what}."),
            (None, Some(what)) => format!("{heading} is not known to bear {winds}: {what}."),
        };
        let wind = |azimuth: Option<f64>| {
            azimuth.map_or_else(String::new, |azimuth| format!(" (wind towards {azimuth:.0} degrees)"))
        };
        let farthest = self.farthest.as_ref().map(|one| {
            let moved = significant(one.moved_mm, 4);
            let [x, y, z] = one.displacement_mm.map(|along| significant(along, 4));
            format!("The weather moves it up to {moved} mm, by ({x}, {y}, {z}) mm{}.", wind(one.azimuth_deg))
        });
        let is_tightest = |cable: usize, azimuth: Option<f64>| {
            self.tightest
                .as_ref()
                .is_some_and(|one| one.greatest_tension.cable == cable && one.azimuth_deg == azimuth)
        };
        let factor = |cable: usize| {
            let here =
                self.least_safe.as_ref().filter(|of| of.cable == cable && is_tightest(cable, of.azimuth_deg));
            here.map_or_else(String::new, |of| format!(", a safety factor of {}", significant(of.factor, 3)))
        };
        let least_safe =
            self.least_safe.as_ref().filter(|of| !is_tightest(of.cable, of.azimuth_deg)).map(|of| {
                format!(
                    "The least safety factor in it is {}, of cable {}{}.",
                    significant(of.factor, 3),
                    of.cable,
                    wind(of.azimuth_deg)
                )
            });
        let tightest = self.tightest.as_ref().map(|one| {
            let Greatest { cable, tension } = one.greatest_tension;
            let tension = significant(tension, 4);
            format!(
                "Tensions in the weather reach {tension} N, in cable {cable}{}{}.",
                wind(one.azimuth_deg),
                factor(cable)
            )
        });
        // An azimuth without a level base has another x axis than the poses.
        let frame = (self.tilted && self.farthest.as_ref().is_some_and(|one| one.azimuth_deg.is_some()))
            .then(|| {
                "Azimuths are counted from x to y of the level frame, whose z points against gravity."
                    .to_owned()
            });
        let below = self.below_least.as_ref().map(|what| format!("In the weather {what}."));
        let cables = self
            .on_cables_alone
            .then(|| "The wind is that on the cables. That on the platform is a load, --force.".to_owned());
        [Some(first), cables, farthest, tightest, least_safe, frame, below].into_iter().flatten().collect()
    }

    pub(super) fn cells(&self) -> Vec<String> {
        let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
        let (far, tight) = (self.farthest.as_ref(), self.tightest.as_ref());
        vec![
            number(far.map(|one| one.moved_mm)),
            number(far.and_then(|one| one.azimuth_deg)),
            number(tight.map(|one| one.greatest_tension.tension)),
            tight.map_or_else(String::new, |one| one.greatest_tension.cable.to_string()),
            number(tight.and_then(|one| one.azimuth_deg)),
            number(self.factor().value),
            self.factor().cable.map_or_else(String::new, |cable| cable.to_string()),
            self.wrong().unwrap_or_default().to_owned(),
        ]
    }
}
