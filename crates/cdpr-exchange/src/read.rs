//! Files of other programs, by their content.

mod caspr;
mod irma;
mod mjcf;
mod moorpy;
mod okermorgant;
mod points;
mod sdf;
mod wirex;

use crate::document::{Document, xml, yaml};
use crate::draft::{Draft, ImportOptions, Imported, NoteKind};
use crate::error::ExchangeError;

/// A file of another program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ForeignFile {
    /// Its name, for messages.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// What a file is, by its content.
enum Kind {
    CasprBodies(Document),
    CasprCables(Document),
    /// Trajectories and spaces of CASPR, which a robot file has no place for.
    CasprBeside(Document),
    Wirex(Document),
    Mjcf(Document),
    Sdf(Document),
    Okermorgant(Document),
    Irma(Document),
    Moorpy,
    Points,
}

/// Makes a robot of the files of another program: the bodies and cables of CASPR, or one file.
///
/// Reading takes time and memory in proportion to the files, and refuses depths, numbers of elements and
/// declarations that no robot has.
///
/// # Errors
/// [`ExchangeError`] with file, line and element of what is wrong, or what the files lack.
pub fn import(files: &[ForeignFile], options: &ImportOptions) -> Result<Imported, ExchangeError> {
    let kinds: Vec<Kind> = files.iter().map(kind).collect::<Result<_, _>>()?;
    let mut beside: Vec<&Document> = Vec::new();
    let (mut bodies, mut cables, mut single) = (None, None, None);
    let names = || files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>().join(", ");
    let together = |expected: &str| ExchangeError::Together { given: names(), expected: expected.to_owned() };
    for (file, kind) in files.iter().zip(&kinds) {
        let slot = match kind {
            Kind::CasprBodies(document) => (&mut bodies, document),
            Kind::CasprCables(document) => (&mut cables, document),
            Kind::CasprBeside(document) => {
                beside.push(document);
                continue;
            }
            _ if single.is_some() => return Err(together("the files of one robot")),
            _ => {
                single = Some((file, kind));
                continue;
            }
        };
        if slot.0.replace(slot.1).is_some() {
            return Err(together("one file of bodies and one of cables"));
        }
    }
    let mut draft = match (bodies, cables, single) {
        (Some(bodies), Some(cables), None) => caspr::read(bodies, cables, options)?,
        (None, None, Some((file, kind))) => read_one(file, kind)?,
        (Some(_), None, None) => return Err(together("the cables of CASPR (*_cables.xml) with the bodies")),
        (None, Some(_), None) => return Err(together("the bodies of CASPR (*_bodies.xml) with the cables")),
        (None, None, None) => return Err(together("the bodies and the cables of CASPR")),
        _ => return Err(together("the files of one robot")),
    };
    for document in beside {
        let root = document.root();
        draft.note(NoteKind::NoPlace, &root, format!("{}, the whole file", root.name()));
    }
    draft.finish(options)
}

fn read_one(file: &ForeignFile, kind: &Kind) -> Result<Draft, ExchangeError> {
    match kind {
        Kind::Wirex(document) => wirex::read(document),
        Kind::Mjcf(document) => mjcf::read(document),
        Kind::Sdf(document) => sdf::read(document),
        Kind::Okermorgant(document) => okermorgant::read(document),
        Kind::Irma(document) => irma::read(document),
        Kind::Moorpy => moorpy::read(&file.name, &file.text),
        _ => points::read(&file.name, &file.text),
    }
}

/// What a file is.
fn kind(file: &ForeignFile) -> Result<Kind, ExchangeError> {
    let ForeignFile { name, text } = file;
    let unknown = |found: String| ExchangeError::Unknown { file: name.clone(), found };
    if text.trim_start().starts_with('<') {
        let document = xml::parse(name, text)?;
        return match document.first().name() {
            "bodies_system" => Ok(Kind::CasprBodies(document)),
            "cables" => Ok(Kind::CasprCables(document)),
            "trajectories" | "operational_spaces" => Ok(Kind::CasprBeside(document)),
            "models" => Ok(Kind::Wirex(document)),
            "mujoco" => Ok(Kind::Mjcf(document)),
            "sdf" | "gazebo" => Ok(Kind::Sdf(document)),
            "robot" if document.first().has("link") => {
                Err(unknown("it is URDF, which has no element for cables".to_owned()))
            }
            other => Err(unknown(format!("its root is <{other}>"))),
        };
    }
    if moorpy::is_system(text) {
        return Ok(Kind::Moorpy);
    }
    if name.ends_with(".csv") || name.ends_with(".txt") || points::is_table(text) {
        return Ok(Kind::Points);
    }
    let document = yaml::parse(name, text)?;
    let root = document.first();
    match () {
        () if root.has("actuator") => Ok(Kind::Irma(document)),
        () if okermorgant::has_robot(&document)? => Ok(Kind::Okermorgant(document)),
        () if root.has("format") => Err(unknown("it is a file of this program".to_owned())),
        () => Err(unknown("it has neither `points` nor `actuator`".to_owned())),
    }
}
