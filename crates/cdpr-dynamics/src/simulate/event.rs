//! What happens to a robot in motion.

use super::winch::{Profile, Reeling, WinchLengths};
use crate::error::DynamicsError;
use cdpr_robot::{JsonError, Vector3, Vector6, frame, from_json, short, significant};
use cdpr_statics::DirectProblem;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::PI;

/// A change at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When [s].
    pub time: f64,
    /// What.
    pub change: Change,
}

impl Event {
    /// Whether it has cut a cable at a time [s].
    pub fn has_cut(&self, cable: usize, time: f64) -> bool {
        self.time <= time && matches!(self.change, Change::Cut { cable: own, .. } if own == cable)
    }

    /// What the winch of a cable does from then on.
    pub(super) fn reeling(&self, cable: usize) -> Option<Reeling> {
        let from = self.time;
        match &self.change {
            Change::Shorten { cable: own, by, over, profile } if *own == cable => {
                Some(Reeling::Ramp { from, over: *over, by: *by, profile: *profile })
            }
            Change::Lengths(lengths) => Some(Reeling::Table { from, cable, lengths: lengths.clone() }),
            _ => None,
        }
    }
}

/// A change of the load, of a cable, or of the place where a motion begins.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// This payload is added at the centre of mass, or removed if it is negative [kg].
    Payload(f64),
    /// The cable with this index, from 0, parts.
    Cut {
        /// Index from 0.
        cable: usize,
        /// Where.
        at: CutAt,
    },
    /// From now on this wrench of constant components in the base frame acts at P, besides the load and in
    /// place of that of an earlier event [N, N m].
    Wrench {
        /// Force [N].
        force: Vector3<f64>,
        /// Moment [N m].
        moment: Vector3<f64>,
    },
    /// The motion begins with the platform held away from its rest: (dp, dφ), the translation [m] and the
    /// rotation vector [rad] in the base frame. The cables have their static shape there.
    Displace(Vector6<f64>),
    /// The winch of a cable takes cable in, or pays it out if the length is negative.
    Shorten {
        /// Index from 0.
        cable: usize,
        /// Unstrained length [m].
        by: f64,
        /// Duration [s].
        over: f64,
        /// How.
        profile: Profile,
    },
    /// The winches follow a table, whose first row has the lengths at that time.
    Lengths(WinchLengths),
}

/// Where a cable parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CutAt {
    /// At the platform, which it leaves.
    #[default]
    Anchor,
    /// At the exit point or pulley: the platform carries it on.
    Exit,
}

/// An event of an event file: a time and one change.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "event")]
struct Entry {
    /// When [s], zero or later.
    t: f64,
    /// Payload that is added at the centre of mass, or removed if it is negative [kg].
    payload: Option<f64>,
    /// Number of the cable that parts, from 1.
    cut: Option<usize>,
    /// Where it parts; at its anchor point if left out.
    at: Option<CutAt>,
    /// Force at P from now on, in the base frame [N]; it ends that of an earlier event.
    force: Option<[f64; 3]>,
    /// Moment from now on, in the base frame [N m].
    moment: Option<[f64; 3]>,
    /// At the time 0 only: where the platform is held before it is released, as translation [m] and rotation
    /// vector [rad] in the base frame.
    displace: Option<[f64; 6]>,
    /// A cable that its winch takes in.
    shorten: Option<Shorten>,
    /// Lengths of all cables over time.
    lengths: Option<Lengths>,
}

/// A cable that its winch takes in.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Shorten {
    /// Number of the cable, from 1.
    cable: usize,
    /// Unstrained length that is taken in, or paid out if it is negative [m].
    by: f64,
    /// Duration [s].
    over: f64,
    /// How: linear, trapezoid, cosine or polynomial; cosine if left out.
    #[serde(default)]
    profile: Profile,
}

/// Lengths of all cables over time, which winches follow without jumps of speed and acceleration.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Lengths {
    /// Times since the event, ascending from zero [s].
    times: Vec<f64>,
    /// Unstrained lengths at each of them, in the order of the robot's cables [m]; the first are those that
    /// the cables have at the event.
    lengths: Vec<Vec<f64>>,
}

/// The JSON Schema of an event file, as pretty-printed text.
pub fn events_schema() -> String {
    format!("{:#}\n", schemars::schema_for!(Vec<Entry>).as_value())
}

/// The events of an event file: a JSON array with an object for each.
///
/// # Errors
/// [`DynamicsError::Events`] for text that is no such array; [`DynamicsError::Event`] for an event without a
/// change or with several.
pub fn events_from_json(text: &str) -> Result<Vec<Event>, DynamicsError> {
    let entries: Vec<Entry> = from_json(text).map_err(|error: JsonError| DynamicsError::Events(error))?;
    entries.into_iter().enumerate().map(|(index, entry)| entry.event(index)).collect()
}

impl Entry {
    fn event(self, index: usize) -> Result<Event, DynamicsError> {
        let wrong = |field: &str, value: String, expected: &str| DynamicsError::Event {
            index,
            field: field.to_owned(),
            value,
            expected: expected.to_owned(),
        };
        let cable = |field: &str, number: usize| {
            number.checked_sub(1).ok_or_else(|| wrong(field, "0".to_owned(), "the number of a cable, from 1"))
        };
        let mut changes = Vec::new();
        changes.extend(self.payload.map(Change::Payload));
        if let Some(number) = self.cut {
            changes.push(Change::Cut { cable: cable("cut", number)?, at: self.at.unwrap_or_default() });
        } else if self.at.is_some() {
            return Err(wrong("at", "given".to_owned(), "`cut` with it, the number of a cable"));
        }
        if self.force.is_some() || self.moment.is_some() {
            let vector = |given: Option<[f64; 3]>| given.map_or_else(Vector3::zeros, Vector3::from);
            changes.push(Change::Wrench { force: vector(self.force), moment: vector(self.moment) });
        }
        changes.extend(self.displace.map(|motion| Change::Displace(Vector6::from(motion))));
        if let Some(Shorten { cable: number, by, over, profile }) = self.shorten {
            changes.push(Change::Shorten { cable: cable("shorten.cable", number)?, by, over, profile });
        }
        if let Some(Lengths { times, lengths }) = self.lengths {
            if times.first().is_some_and(|first| *first != 0.0) {
                return Err(wrong("lengths.times[0]", format!("{:?}", times[0]), "0, the time of the event"));
            }
            let table = WinchLengths::new(&times, &lengths).map_err(|error| match error {
                DynamicsError::Invalid { field, value, expected } => wrong(field, value, &expected),
                error => error,
            });
            changes.push(Change::Lengths(table?));
        }
        let found = format!("an event with {} changes", changes.len());
        match <[Change; 1]>::try_from(changes) {
            Ok([change]) => Ok(Event { time: self.t, change }),
            Err(_) => {
                let expected = "one of payload, cut, force with moment, displace, shorten, lengths";
                Err(wrong("", found, expected))
            }
        }
    }
}

/// Checks events for a robot.
pub(super) fn check(problem: &DirectProblem, events: &[Event]) -> Result<(), DynamicsError> {
    /// Greatest change that is computed: of masses [kg], forces [N] and moments [N m].
    const MOST: f64 = 1e12;
    let robot = problem.robot();
    let mut mass = robot.platform.mass + problem.load().payload;
    let mut order: Vec<usize> = (0..events.len()).collect();
    order.sort_by(|one, other| events[*one].time.total_cmp(&events[*other].time));
    let mut before: Vec<&Event> = Vec::new();
    for index in order {
        let event = &events[index];
        let wrong = |field: &str, value: String, expected: String| {
            Err(DynamicsError::Event { index, field: field.to_owned(), value, expected })
        };
        if !(event.time.is_finite() && event.time >= 0.0) {
            return wrong("t", format!("{:?}", event.time), "a time [s], zero or more".to_owned());
        }
        let exists = |cable: usize| cable < robot.cables.len();
        let cables = format!("the number of a cable, 1 to {}", robot.cables.len());
        if let Some((field, value, expected)) = fault_of_parted(event, &before) {
            return wrong(field, value, expected);
        }
        match &event.change {
            Change::Payload(payload) => {
                mass += payload;
                if !(payload.abs() <= MOST && mass > 0.0) {
                    let expected = match payload.abs() <= MOST {
                        true => {
                            "a payload [kg] that leaves platform and payload a mass above zero".to_owned()
                        }
                        false => format!("a payload of {MOST:.0e} kg at most"),
                    };
                    return wrong("payload", format!("{payload:?}"), expected);
                }
            }
            Change::Cut { cable, .. } if !exists(*cable) => {
                return wrong("cut", (cable + 1).to_string(), cables);
            }
            Change::Cut { .. } => {}
            Change::Wrench { force, moment } => {
                for (name, vector, unit) in [("force", force, "N"), ("moment", moment, "N m")] {
                    if !vector.iter().all(|component| component.abs() <= MOST) {
                        let value = format!("{:?}", vector.as_slice());
                        return wrong(name, value, format!("three numbers of {MOST:.0e} {unit} at most"));
                    }
                }
                if robot.platform.point && moment.norm() > 0.0 {
                    let expected = "zeros: the platform is a point mass, which no moment turns";
                    return wrong("moment", format!("{:?}", moment.as_slice()), expected.to_owned());
                }
            }
            Change::Displace(motion) => {
                if let Some(fault) = fault_of_displacement(problem, event.time, motion, &before) {
                    return wrong(&fault.0, fault.1, fault.2);
                }
            }
            Change::Shorten { cable, .. } if !exists(*cable) => {
                return wrong("shorten.cable", (cable + 1).to_string(), cables);
            }
            Change::Shorten { cable, by, over, .. } => {
                let lengths = lengths_at(problem.lengths(), &before, f64::INFINITY)[*cable];
                if let Some(fault) = fault_of_ramp(*by, *over, [problem.lengths()[*cable], lengths]) {
                    return wrong(fault.0, fault.1, fault.2);
                }
            }
            Change::Lengths(table) => {
                let lengths = lengths_at(problem.lengths(), &before, event.time);
                if let Some((field, value, expected)) = fault_of_table(table, &lengths) {
                    return wrong(field, value, expected);
                }
            }
        }
        before.push(event);
    }
    Ok(())
}

/// What of an event acts on a cable that has parted before: a second cut at the same end, or one of a cable
/// that has left the platform; a winch that takes in a cable that is not whole.
fn fault_of_parted(event: &Event, before: &[&Event]) -> Option<(&'static str, String, String)> {
    let (cable, field, at) = match &event.change {
        Change::Cut { cable, at } => (*cable, "cut", Some(*at)),
        Change::Shorten { cable, .. } => (*cable, "shorten.cable", None),
        _ => return None,
    };
    let has_parted = |one: &&&Event| {
        let Change::Cut { cable: own, at: place } = one.change else { return false };
        own == cable && (place == CutAt::Anchor || at.is_none_or(|at| at == place))
    };
    let expected =
        |one: &&Event| format!("a cable that is still there, not one that parts at {} s", short(one.time));
    before.iter().find(has_parted).map(|one| (field, (cable + 1).to_string(), expected(one)))
}

/// What of a displacement is not possible at a time [s].
fn fault_of_displacement(
    problem: &DirectProblem,
    time: f64,
    motion: &Vector6<f64>,
    before: &[&Event],
) -> Option<(String, String, String)> {
    /// A half turn [rad], with its rounding. Every rotation is such a turn or less.
    const HALF_TURN: f64 = PI + 1e-3;
    let robot = problem.robot();
    if time != 0.0 {
        let expected = "0: a motion begins there, and no platform jumps later".to_owned();
        return Some(("t".to_owned(), format!("{time:?}"), expected));
    }
    let (free, text) = (robot.freedoms(), |numbers: &[f64]| format!("{numbers:?}"));
    let is_possible = |k: &usize| motion[*k].is_finite() && (motion[*k] == 0.0 || free.contains(*k));
    if let Some(k) = (0..6).find(|k| !is_possible(k)) {
        let expected = "a number, 0 for a motion that the platform has not".to_owned();
        return Some((format!("displace[{k}]"), format!("{:?}", motion[k]), expected));
    }
    let field = "displace".to_owned();
    if before.iter().any(|event| matches!(event.change, Change::Displace(_))) {
        let expected = "one displacement: a motion begins at one place".to_owned();
        return Some((field, text(motion.as_slice()), expected));
    }
    let sides = frame(robot).map(|[low, high]| high - low);
    let size = problem.lengths().iter().copied().chain(sides).fold(0.0, f64::max);
    let [translation, rotation] = [0, 3].map(|first| motion.fixed_rows::<3>(first).into_owned());
    if translation.norm() > size {
        let expected = format!("a translation of {} m at most, the size of the robot", significant(size, 4));
        return Some((field, text(translation.as_slice()), expected));
    }
    (rotation.norm() > HALF_TURN).then(|| {
        let expected = "a rotation vector of 3.1416 rad at most, a half turn".to_owned();
        (field, text(rotation.as_slice()), expected)
    })
}

/// What of a winch that takes in or pays out cable is not possible. The cable has one length at rest and one
/// after what earlier events do [m].
fn fault_of_ramp(by: f64, over: f64, [length, left]: [f64; 2]) -> Option<(&'static str, String, String)> {
    if !(by.is_finite() && by < left - 0.1 * length && by > left - 11.0 * length) {
        let [least, most] = [left - 11.0 * length, left - 0.1 * length].map(|by| significant(by, 4));
        let events = if left == length { "" } else { " after earlier events" };
        let left = significant(left, 4);
        let expected = format!("{least} to {most} m: the cable has {left} m{events}");
        return Some(("shorten.by", format!("{by:?}"), expected));
    }
    (!(over.is_finite() && over > 0.0))
        .then(|| ("shorten.over", format!("{over:?}"), "a duration [s] above zero".to_owned()))
}

/// The lengths at a time [m] after what winches have done until then.
fn lengths_at(rest: &[f64], before: &[&Event], time: f64) -> Vec<f64> {
    let mut lengths = rest.to_vec();
    for event in before {
        for (i, length) in lengths.iter_mut().enumerate() {
            *length -= event.reeling(i).map_or(0.0, |reeling| reeling.at(time)[0]);
        }
    }
    lengths
}

/// What of a table of lengths does not fit the lengths at its begin [m].
fn fault_of_table(table: &WinchLengths, lengths: &[f64]) -> Option<(&'static str, String, String)> {
    /// Share of a length by which the first row may differ, as rounding of a table does. The winch does what
    /// the table changes.
    const SAME: f64 = 1e-6;
    if table.cables() != lengths.len() {
        let expected = format!("one for each of the {} cables", lengths.len());
        return Some(("lengths", format!("a table of {} lengths", table.cables()), expected));
    }
    lengths.iter().enumerate().find_map(|(i, length)| {
        let first = table.at(i, 0.0)[0];
        let [least, most] = table.extremes(i);
        if (first / length - 1.0).abs() > SAME {
            let expected = format!("the length of cable {} then, {length:.6} m", i + 1);
            return Some(("lengths, first row", format!("{first:.6} m"), expected));
        }
        (least < 0.1 * length || most > 10.0 * length).then(|| {
            let expected = format!("a tenth to ten times the {length:.4} m of cable {} then", i + 1);
            ("lengths", format!("{least:.4} to {most:.4} m"), expected)
        })
    })
}
