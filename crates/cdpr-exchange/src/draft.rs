//! What files of other programs say of a robot, and the robot that is made of it with what the user adds.

use crate::document::{Document, Node};
use crate::error::{ExchangeError, Lacking};
use cdpr_robot::{
    CableEnd, CableProperties, CatalogueCable, Gravity, Matrix3, OwnLimits, Plane, Platform, Provenance,
    Pulley, Robot, RobotCable, TensionLimits, Vector3,
};

/// What a user adds to files of another program, or puts in place of what they say.
#[derive(Clone, Debug, Default)]
pub struct ImportOptions {
    /// The cable of all cables.
    pub cable: Option<CatalogueCable>,
    /// Mass of the platform [kg].
    pub mass: Option<f64>,
    /// Centre of mass in the platform frame [m].
    pub center_of_mass: Option<Vector3<f64>>,
    /// Limits of every tension [N].
    pub tension_limits: Option<TensionLimits>,
    /// Name of the cable set of CASPR, where it is not the default one.
    pub cable_set: Option<String>,
}

/// A robot made of files of another program.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The robot.
    pub robot: Robot,
    /// What the program has assumed, what it questions, what has no place in a robot file.
    pub notes: Vec<Note>,
}

/// What a user has to know of an import.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Its kind.
    pub kind: NoteKind,
    /// File and line, if it is about a place in a file.
    pub place: Option<(String, usize)>,
    /// A sentence.
    pub text: String,
}

/// Kinds of notes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoteKind {
    /// A value that the files lack and that was chosen.
    Assumed,
    /// A value that is known from templates, or that is probably wrong.
    Questioned,
    /// What a robot file has no place for.
    NoPlace,
}

/// What files say of a robot.
#[derive(Debug, Default)]
pub(crate) struct Draft {
    /// Name of the robot.
    pub(crate) name: String,
    /// Format and files.
    pub(crate) source: String,
    pub(crate) mass: Option<f64>,
    pub(crate) center_of_mass: Option<Vector3<f64>>,
    pub(crate) inertia: Option<Matrix3<f64>>,
    /// Acceleration due to gravity [m/s²]; that of the earth along -z if left out.
    pub(crate) gravity: Option<Vector3<f64>>,
    pub(crate) plane: Option<Plane>,
    pub(crate) cables: Vec<DraftCable>,
    pub(crate) notes: Vec<Note>,
}

/// What files say of one cable.
#[derive(Debug)]
pub(crate) struct DraftCable {
    pub(crate) exit_point: Vector3<f64>,
    pub(crate) anchor_point: Vector3<f64>,
    pub(crate) pulley: Option<Pulley>,
    pub(crate) min: Option<f64>,
    pub(crate) max: Option<f64>,
    pub(crate) properties: Option<CableProperties>,
    /// Axial stiffness EA [N], where section and modulus are not known on their own.
    pub(crate) stiffness: Option<f64>,
}

/// Acceleration due to gravity on earth [m/s²].
const EARTH: f64 = 9.81;

/// Least tension where the files have zero [N], or a thousandth of the greatest one if that is less.
const LEAST_TENSION: f64 = 1.0;

impl Draft {
    pub(crate) fn note(&mut self, kind: NoteKind, node: &Document, at: &Node, text: impl Into<String>) {
        self.notes.push(Note { kind, place: Some((node.file.clone(), at.line)), text: text.into() });
    }

    pub(crate) fn assume(&mut self, text: impl Into<String>) {
        self.notes.push(Note { kind: NoteKind::Assumed, place: None, text: text.into() });
    }

    /// Lists what was not read of a file.
    pub(crate) fn list_unread(&mut self, document: &Document) {
        for unread in document.unread() {
            let place = Some((document.file.clone(), unread.line));
            self.notes.push(Note { kind: NoteKind::NoPlace, place, text: unread.to_string() });
        }
    }

    /// The robot, with what the user adds.
    ///
    /// # Errors
    /// [`ExchangeError::Lacking`], [`ExchangeError::Robot`].
    pub(crate) fn finish(mut self, options: &ImportOptions) -> Result<Imported, ExchangeError> {
        let mass = self.chosen("mass of the platform", self.mass, options.mass, "kg");
        if let (Some(of_file), Some(given)) = (self.center_of_mass, options.center_of_mass)
            && of_file != given
        {
            let text = format!(
                "the centre of mass is {:?} m, in place of {:?} m",
                given.as_slice(),
                of_file.as_slice()
            );
            self.assume(text);
        }
        let center_of_mass = options.center_of_mass.or(self.center_of_mass).unwrap_or_else(|| {
            self.assume("the centre of mass is the origin of the platform");
            Vector3::zeros()
        });
        let limits = self.limits(options);
        let has_cable = options.cable.is_some() || self.cables.iter().all(|cable| cable.properties.is_some());
        let lacking: Vec<_> = [
            (Lacking::Cable, has_cable),
            (Lacking::Mass, mass.is_some()),
            (Lacking::TensionLimits, limits.is_some()),
        ]
        .into_iter()
        .filter_map(|(lacking, is_there)| (!is_there).then_some(lacking))
        .collect();
        let (Some(mass), Some(tension_limits), true) = (mass, limits, has_cable) else {
            return Err(ExchangeError::Lacking(lacking));
        };
        if let Some(cable) = &options.cable {
            let source = cable.source.as_ref().map_or_else(String::new, |source| format!(" ({source})"));
            self.assume(format!("the cables are {}{source}", cable.name));
        }
        if self.gravity.is_none() {
            self.assume(format!("gravity is {EARTH} m/s² along -z"));
        }
        let cables = std::mem::take(&mut self.cables).into_iter();
        let cables = cables.map(|cable| robot_cable(cable, tension_limits, options)).collect();
        let assumed = self.notes.iter().filter(|note| note.kind == NoteKind::Assumed);
        let robot = Robot {
            name: self.name,
            provenance: Provenance {
                source: Some(self.source),
                grade: None,
                assumed: assumed.map(|note| note.text.clone()).collect(),
            },
            gravity: self.gravity.map_or_else(|| Gravity::from(EARTH), Gravity::from),
            platform: Platform { inertia: self.inertia, ..Platform::new(mass, center_of_mass) },
            plane: self.plane,
            tension_limits,
            max_at: CableEnd::Anchor,
            tension_reference: None,
            cables,
        };
        robot.validate().and_then(|()| robot.check_units()).map_err(ExchangeError::Robot)?;
        Ok(Imported { robot, notes: self.notes })
    }

    /// The value that the user gives, or else that of the file; a note where they differ.
    fn chosen(&mut self, what: &str, of_file: Option<f64>, given: Option<f64>, unit: &str) -> Option<f64> {
        if let (Some(of_file), Some(given)) = (of_file, given)
            && of_file != given
        {
            self.assume(format!("the {what} is {given} {unit}, in place of {of_file} {unit}"));
        }
        given.or(of_file)
    }

    /// The limits of the robot: the widest of its cables, which keep theirs where they differ.
    fn limits(&mut self, options: &ImportOptions) -> Option<TensionLimits> {
        if let Some(given) = options.tension_limits {
            self.assume(format!("the tensions are between {} N and {} N", given.min, given.max));
            self.cables.iter_mut().for_each(|cable| (cable.min, cable.max) = (None, None));
            return Some(given);
        }
        let max =
            self.cables.iter().map(|cable| cable.max).try_fold(0.0_f64, |most, max| Some(most.max(max?)))?;
        let least = LEAST_TENSION.min(1e-3 * max);
        let mut raised = false;
        for cable in &mut self.cables {
            let min = cable.min.unwrap_or(0.0);
            raised |= min <= 0.0;
            cable.min = Some(if min <= 0.0 { least } else { min });
        }
        if raised {
            self.assume(format!(
                "the least tension is {least} N where the files have 0, as cables must pull"
            ));
        }
        let min = self.cables.iter().filter_map(|cable| cable.min).fold(f64::INFINITY, f64::min);
        Some(TensionLimits { min, max })
    }
}

fn robot_cable(cable: DraftCable, limits: TensionLimits, options: &ImportOptions) -> RobotCable {
    let own = |value: Option<f64>, common: f64| value.filter(|value| *value != common);
    let chosen = options.cable.as_ref().map(|cable| cable.properties.clone());
    let mut properties =
        chosen.or(cable.properties).unwrap_or_else(|| CableProperties::linear(0.0, 0.0, 0.0));
    // The stiffness is the file's; section and density are the cable's that is given.
    if let Some(stiffness) = cable.stiffness {
        properties.youngs_modulus = stiffness / properties.section;
    }
    RobotCable {
        pulley: cable.pulley,
        tension_limits: OwnLimits {
            min: own(cable.min, limits.min),
            max: own(cable.max, limits.max),
            ..OwnLimits::default()
        },
        ..RobotCable::between(cable.exit_point, cable.anchor_point, properties)
    }
}
