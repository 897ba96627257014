//! What files of other programs say of a robot, and the robot that is made of it with what the user adds.

mod replaced;

use crate::document::unread::Unread;
use crate::document::{Document, Node};
use crate::error::{ExchangeError, Lacking};
use cdpr_robot::{
    CableEnd, CableProperties, CatalogueCable, Gravity, Matrix3, OwnLimits, Plane, Platform, Provenance,
    Pulley, Robot, RobotCable, RobotError, TensionDistribution, TensionLimits, Vector3,
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
    /// A value that is known from templates or probably wrong, or an entry that may change the robot and is
    /// not imported.
    Questioned,
    /// What a robot file has no place for and what does not matter for a robot at rest.
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
    /// Whether the platform cannot rotate.
    pub(crate) held_rotation: bool,
    /// The cable set of CASPR that was read, and the others of the file.
    pub(crate) cable_sets: Option<(String, Vec<String>)>,
    /// Height of the ground in the base frame [m].
    pub(crate) ground_z: Option<f64>,
    pub(crate) cables: Vec<DraftCable>,
    pub(crate) notes: Vec<Note>,
}

/// What files say of one cable.
#[derive(Debug, Default)]
pub(crate) struct DraftCable {
    pub(crate) exit_point: Vector3<f64>,
    pub(crate) anchor_point: Vector3<f64>,
    pub(crate) pulley: Option<Pulley>,
    pub(crate) lead: f64,
    pub(crate) min: Option<f64>,
    pub(crate) max: Option<f64>,
    pub(crate) properties: Option<CableProperties>,
    /// Diameter [m], where it may be known without the other properties.
    pub(crate) diameter: Option<f64>,
    /// Breaking force [N], likewise.
    pub(crate) breaking_force: Option<f64>,
    /// Axial stiffness EA [N], where section and modulus are not known on their own.
    pub(crate) stiffness: Option<f64>,
}

/// Acceleration due to gravity on earth [m/s²].
const EARTH: f64 = 9.81;

/// Least tension where the files have zero [N], or a thousandth of the greatest one if that is less.
const LEAST_TENSION: f64 = 1.0;

impl Draft {
    /// A draft with the name of a file, made of it in a format.
    pub(crate) fn of_file(file: &str, format: &str) -> Self {
        let stem = file.rsplit(['/', '\\']).next().unwrap_or("robot");
        let name = stem.split('.').next().unwrap_or(stem).to_owned();
        Self { name, source: format!("Imported from {file} of {format}."), ..Self::default() }
    }

    pub(crate) fn note(&mut self, kind: NoteKind, at: &Node, text: impl Into<String>) {
        let place = Some((at.file().to_owned(), at.line()));
        self.notes.push(Note { kind, place, text: text.into() });
    }

    /// An error with the names of the cable sets that might be imported instead, if there are others.
    pub(crate) fn of_cable_set(&self, source: ExchangeError) -> ExchangeError {
        match self.cable_sets.clone() {
            Some((set, others)) => ExchangeError::CableSet { source: Box::new(source), set, others },
            None => source,
        }
    }

    /// A note, unless there is one with the same text.
    pub(crate) fn note_once(&mut self, kind: NoteKind, at: &Node, text: impl Into<String>) {
        let text = text.into();
        if !self.notes.iter().any(|note| note.text == text) {
            self.note(kind, at, text);
        }
    }

    pub(crate) fn assume(&mut self, text: impl Into<String>) {
        self.notes.push(Note { kind: NoteKind::Assumed, place: None, text: text.into() });
    }

    /// Lists what was not read of a file. `is_harmless` gets the path around an entry, without numbers, and
    /// its name: entries that do not matter for a robot at rest are listed, all others are questioned.
    ///
    /// # Errors
    /// [`ExchangeError::Value`] for an entry that is there twice.
    pub(crate) fn list_unread(
        &mut self,
        document: &Document,
        is_harmless: impl Fn(&str, &str) -> bool,
    ) -> Result<(), ExchangeError> {
        for Unread { line, matters, text } in document.unread(is_harmless)? {
            let place = Some((document.file.clone(), line));
            let (kind, text) = match matters {
                true => (NoteKind::Questioned, format!("{text}: not known and not imported")),
                false => (NoteKind::NoPlace, text),
            };
            self.notes.push(Note { kind, place, text });
        }
        Ok(())
    }

    /// The robot, with what the user adds.
    ///
    /// # Errors
    /// [`ExchangeError::Lacking`], [`ExchangeError::Robot`].
    pub(crate) fn finish(mut self, options: &ImportOptions) -> Result<Imported, ExchangeError> {
        if self.cables.is_empty() {
            return Err(self.of_cable_set(ExchangeError::Robot(RobotError::Invalid {
                field: "cables".to_owned(),
                value: "an empty list".to_owned(),
                expected: "at least one cable".to_owned(),
            })));
        }
        let mass = self.chosen("mass of the platform", self.mass, options.mass, "kg");
        if let (Some(of_file), Some(given)) = (self.center_of_mass, options.center_of_mass)
            && of_file != given
        {
            let text = format!(
                "the centre of mass is {:?} m, instead of {:?} m",
                given.as_slice(),
                of_file.as_slice()
            );
            self.assume(text);
        }
        let mut center_of_mass = options.center_of_mass.or(self.center_of_mass).unwrap_or_else(|| {
            self.assume("the centre of mass is the origin of the platform");
            Vector3::zeros()
        });
        let point = self.held_rotation;
        if point {
            self.shrink_to_point();
            center_of_mass = Vector3::zeros();
        }
        let inertia = self.checked_inertia();
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
            let replaced = self.replaced(&cable.properties);
            self.assume(format!("the cables are {}{source}{replaced}", cable.name));
            self.assume_kept(&cable.properties);
        }
        if self.gravity.is_none() {
            self.assume(format!("gravity is {EARTH} m/s² along -z"));
        }
        let cables = std::mem::take(&mut self.cables).into_iter();
        let cables = cables.map(|cable| robot_cable(cable, tension_limits, options)).collect();
        let assumed = self.notes.iter().filter(|note| note.kind == NoteKind::Assumed);
        let robot = Robot {
            name: std::mem::take(&mut self.name),
            provenance: Provenance {
                source: Some(std::mem::take(&mut self.source)),
                grade: None,
                assumed: assumed.map(|note| note.text.clone()).collect(),
            },
            gravity: self.gravity.map_or_else(|| Gravity::from(EARTH), Gravity::from),
            platform: Platform { inertia, point, ..Platform::new(mass, center_of_mass) },
            plane: self.plane,
            tension_limits,
            max_at: CableEnd::Anchor,
            ground_z: self.ground_z,
            tension_reference: None,
            distribution: TensionDistribution::default(),
            cables,
        };
        let checked = robot.validate().and_then(|()| robot.check_units()).map_err(ExchangeError::Robot);
        checked.map_err(|source| self.of_cable_set(source))?;
        Ok(Imported { robot, notes: self.notes })
    }

    /// Makes a point mass of a platform that cannot rotate: a cable from B to A is one from B - A to P, as
    /// r = p + A - B.
    fn shrink_to_point(&mut self) {
        let shifted = self.cables.iter().any(|cable| cable.anchor_point != Vector3::zeros());
        for cable in &mut self.cables {
            cable.exit_point -= std::mem::take(&mut cable.anchor_point);
        }
        if shifted {
            self.assume(
                "the platform cannot rotate: it is a point mass, each exit point moved by its anchor point",
            );
        }
    }

    /// The inertia, completed where only motions in a plane count; `None` where the files have zeros.
    fn checked_inertia(&mut self) -> Option<Matrix3<f64>> {
        let inertia = self.inertia?;
        let moments = inertia.symmetric_eigenvalues();
        let is_body = moments.min() > 0.0 && moments.max() <= 0.5 * moments.sum() * (1.0 + 1e-3);
        match self.plane {
            _ if self.held_rotation => None,
            _ if inertia == Matrix3::zeros() => {
                self.assume("the inertia is not known: the files have zeros");
                None
            }
            Some(plane) if !is_body && inertia[(plane.normal(), plane.normal())] > 0.0 => {
                let normal = plane.normal();
                let moment = inertia[(normal, normal)];
                self.assume(
                    "the moments of inertia about axes in the plane are those of a plate: no motion in the \
                     plane depends on them",
                );
                let of_axis = |i: usize| if i == normal { moment } else { 0.5 * moment };
                Some(Matrix3::from_diagonal(&Vector3::from_fn(|i, _| of_axis(i))))
            }
            _ => Some(inertia),
        }
    }

    /// The value that the user gives, or else that of the file; a note where they differ.
    fn chosen(&mut self, what: &str, of_file: Option<f64>, given: Option<f64>, unit: &str) -> Option<f64> {
        if let (Some(of_file), Some(given)) = (of_file, given)
            && of_file != given
        {
            self.assume(format!("the {what} is {given} {unit}, instead of {of_file} {unit}"));
        }
        given.or(of_file)
    }

    /// The limits of the robot: the widest of its cables, which keep theirs where they differ.
    fn limits(&mut self, options: &ImportOptions) -> Option<TensionLimits> {
        if let Some(given) = options.tension_limits {
            let (min, max) =
                (self.cables.iter().map(|cable| cable.min), self.cables.iter().map(|cable| cable.max));
            let range = |values: &mut dyn Iterator<Item = Option<f64>>| {
                let known = values.flatten().map(|value| [value, value]);
                known.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
            };
            let of_file = [("least", range(&mut { min })), ("greatest", range(&mut { max }))];
            let of_file = of_file.into_iter().filter_map(|(which, range)| {
                let [low, high] = range?;
                let range = if low == high { format!("{low}") } else { format!("{low} to {high}") };
                Some(format!("{which} ones of {range} N"))
            });
            let of_file = of_file.collect::<Vec<_>>().join(" and ");
            let instead = if of_file.is_empty() { of_file } else { format!(", instead of {of_file}") };
            self.assume(format!("the tensions are between {} N and {} N{instead}", given.min, given.max));
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
    let of_file = options.cable.is_none() && cable.properties.is_some();
    let chosen = options.cable.as_ref().map(|cable| cable.properties.clone());
    let stated = cable.properties.as_ref().map(|of| (of.diameter, of.breaking_force)).unwrap_or_default();
    let (diameter, breaking_force) = (cable.diameter.or(stated.0), cable.breaking_force.or(stated.1));
    let mut properties =
        chosen.or(cable.properties).unwrap_or_else(|| CableProperties::linear(0.0, 0.0, 0.0));
    // What a cable of a catalogue does not say.
    properties.diameter = properties.diameter.or(diameter);
    properties.breaking_force = properties.breaking_force.or(breaking_force);
    // The stiffness is the file's; section and density are the cable's that is given. A cable of the file has
    // it in its modulus.
    if let Some(stiffness) = cable.stiffness.filter(|_| !of_file) {
        properties.youngs_modulus = stiffness / properties.section;
    }
    RobotCable {
        pulley: cable.pulley,
        lead: cable.lead,
        tension_limits: OwnLimits {
            min: own(cable.min, limits.min),
            max: own(cable.max, limits.max),
            ..OwnLimits::default()
        },
        ..RobotCable::between(cable.exit_point, cable.anchor_point, properties)
    }
}
