//! Models of MuJoCo (MJCF): cables are spatial tendons between sites of the frame and of one free body.
//!
//! The first two neighbouring sites of a tendon of which one is on the platform are anchor and exit point;
//! what follows in the frame is the winch. EA is `stiffness` times the unstrained length, `springlength`.
//! What our own export adds under `custom` completes the cables.

mod bodies;
mod geometry;
mod scene;

use crate::document::{Document, Node};
use crate::draft::{Draft, DraftCable, NoteKind};
use crate::error::ExchangeError;
use crate::read::mjcf::bodies::{Bodies, Stop};
use crate::read::mjcf::scene::Scene;
use cdpr_robot::CableProperties;
use std::collections::HashMap;

/// Reads a robot.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and element of what a robot file cannot describe.
pub(crate) fn read(document: &Document) -> Result<Draft, ExchangeError> {
    let root = document.root();
    let mut draft = Draft::of_file(&document.file, "MuJoCo");
    if let Some(name) = root.get("@model") {
        draft.name = name.text().to_owned();
    }
    let scene = Scene::of(&root)?;
    // Without another one the gravity of MuJoCo is ours.
    for option in root.all("option") {
        if let Some(gravity) = option.get("@gravity") {
            draft.gravity = Some(gravity.vector()?);
        }
        for flag in option.all("flag").filter_map(|flags| flags.get("@gravity")) {
            if flag.text() == "disable" {
                return Err(flag.error("enable: robots without gravity are not imported"));
            }
        }
    }
    let bodies = Bodies::of(&root, &scene)?;
    let tendons: Vec<Node> = root.all("tendon").flat_map(|tendon| tendon.all("spatial")).collect();
    if tendons.is_empty() {
        let expected = "tendons between sites, one for each cable: other cables of MuJoCo are not imported";
        return Err(root.value_error(Some("tendon/spatial"), "missing", expected));
    }
    let paths = tendons.iter().map(|tendon| path(tendon, &bodies)).collect::<Result<Vec<_>, _>>()?;
    let platform = bodies.platform(&root, &paths)?;
    bodies.read_platform(&mut draft, platform)?;
    let custom = custom(&root)?;
    if let Some(source) = custom.texts.get("source") {
        draft.source += &format!(" {source}");
    }
    for (tendon, path) in tendons.iter().zip(&paths) {
        match cable(&mut draft, tendon, path, &bodies, platform, &scene)? {
            Some(cable) => {
                let cable = custom.complete(&mut draft, tendon, cable)?;
                draft.cables.push(cable);
            }
            None => {
                draft.note_once(NoteKind::Questioned, tendon, "a tendon that does not end at the platform");
            }
        }
    }
    draft.ground_z = bodies.ground_z;
    question_limits(&mut draft, &root);
    draft.list_unread(document, scene::is_harmless)?;
    Ok(draft)
}

fn path<'a>(tendon: &Node<'a>, bodies: &Bodies<'a>) -> Result<Vec<Stop<'a>>, ExchangeError> {
    let mut stops = Vec::new();
    for stop in tendon.elements() {
        stops.push(match stop.name() {
            "site" => Stop::Site(bodies.site(&stop.need("@site")?)?),
            "geom" => Stop::Geom(bodies.geom(&stop.need("@geom")?)?, stop),
            other => return Err(stop.value_error(None, other, "site or geom: others are not imported")),
        });
    }
    Ok(stops)
}

/// The cable along a tendon; `None` if it does not end at the platform.
fn cable(
    draft: &mut Draft,
    tendon: &Node,
    path: &[Stop],
    bodies: &Bodies,
    platform: usize,
    scene: &Scene,
) -> Result<Option<DraftCable>, ExchangeError> {
    let on_platform = |stop: &Stop| match stop {
        Stop::Site(site) => bodies.sites[*site].mover == Some(platform),
        Stop::Geom(geom, _) => bodies.geoms[*geom].mover == Some(platform),
    };
    let changes = path.windows(2).filter(|pair| on_platform(&pair[0]) != on_platform(&pair[1])).count();
    if changes == 0 {
        return Ok(None);
    }
    if changes > 1 {
        let expected = "one change between frame and platform: cables that return are not imported";
        return Err(tendon.value_error(None, &format!("a tendon with {changes}"), expected));
    }
    // From the platform outwards.
    let outwards: Vec<&Stop> = if path.first().is_some_and(on_platform) {
        path.iter().collect()
    } else {
        path.iter().rev().collect()
    };
    let first = outwards.iter().position(|stop| !on_platform(stop)).unwrap_or(outwards.len());
    let (inside, outside) = outwards.split_at(first);
    let Some(Stop::Site(anchor)) = inside.last().copied() else {
        return Err(tendon.value_error(None, "a tendon that wraps around the platform", "a site at its end"));
    };
    let sites: Vec<usize> = outside
        .iter()
        .filter_map(|stop| if let Stop::Site(site) = stop { Some(*site) } else { None })
        .collect();
    let Some(exit) = sites.first().copied() else {
        return Err(tendon.value_error(
            None,
            "a tendon without a site of the frame",
            "a site at the exit point",
        ));
    };
    let pulley = match outside[0] {
        Stop::Geom(geom, stop) => Some(bodies.pulley(*geom, &sites, stop)?),
        Stop::Site(_) => None,
    };
    if pulley.is_some() {
        let text = "a cylinder, whose axle is fixed: the pulley of a robot swivels about the entering cable";
        draft.note_once(NoteKind::Questioned, tendon, text);
    }
    if bodies.sites[exit].mover.is_some() {
        let text = "the exit point lies on a body that moves: it is taken where the model begins";
        draft.note_once(NoteKind::Questioned, tendon, text);
    }
    let anchor_point = bodies.in_platform(platform, draft.held_rotation, *anchor);
    let exit_point = bodies.sites[exit].position;
    let span = (bodies.sites[*anchor].position - exit_point).norm();
    let is_bent = path.len() > 2;
    let stiffness = stiffness(draft, tendon, scene, span, is_bent)?;
    Ok(Some(DraftCable { exit_point, anchor_point, pulley, stiffness, ..DraftCable::default() }))
}

/// EA [N] of the spring of a tendon, if it has one; `span` is its length where the model begins [m].
fn stiffness(
    draft: &mut Draft,
    tendon: &Node,
    scene: &Scene,
    span: f64,
    is_bent: bool,
) -> Result<Option<f64>, ExchangeError> {
    let Some(stiffness) = scene.attribute(tendon, "tendon", "@stiffness", None) else { return Ok(None) };
    let per_length = stiffness.number()?;
    if per_length == 0.0 {
        return Ok(None);
    }
    if is_bent {
        let text = "stiffness: of the whole tendon, as if the cable began at its exit point";
        draft.note_once(NoteKind::Questioned, &stiffness, text);
    }
    let length = match scene.attribute(tendon, "tendon", "@springlength", None) {
        None => span,
        Some(lengths) => match lengths.numbers()?[..] {
            [_, length] if length > 0.0 => length,
            [length] if length > 0.0 => {
                let text = "springlength: a spring that also pushes; a cable only pulls";
                draft.note_once(NoteKind::Questioned, &lengths, text);
                length
            }
            [-1.0] => span,
            _ => return Err(lengths.error("an unstrained length, or zero and one")),
        },
    };
    Ok(Some(per_length * length))
}

/// Questions actuators that pull at tendons: their ranges are limits of tension in units of their own.
fn question_limits(draft: &mut Draft, root: &Node) {
    let actuators = root.all("actuator").flat_map(|actuators| actuators.elements());
    // All are looked at: a file has one for each cable.
    let of_tendons: Vec<_> = actuators.filter(|actuator| actuator.has("@tendon")).collect();
    if let Some(first) = of_tendons.first() {
        let text = "actuators of tendons: their ranges are not imported as limits of tension";
        draft.note_once(NoteKind::Questioned, first, text);
    }
}

/// Relative difference of two stiffnesses that are the same but for rounding.
const SAME: f64 = 1e-9;

/// Numbers and texts under `custom`.
struct Custom<'a> {
    numbers: HashMap<&'a str, Node<'a>>,
    texts: HashMap<&'a str, &'a str>,
}

fn custom<'a>(root: &Node<'a>) -> Result<Custom<'a>, ExchangeError> {
    let mut custom = Custom { numbers: HashMap::new(), texts: HashMap::new() };
    for node in root.all("custom") {
        for numeric in node.all("numeric") {
            let name = numeric.need("@name")?;
            if custom.numbers.insert(name.text(), numeric.need("@data")?).is_some() {
                return Err(bodies::twice(&name));
            }
        }
        for text in node.all("text") {
            custom.texts.insert(text.need("@name")?.text(), text.need("@data")?.text());
        }
    }
    Ok(custom)
}

impl Custom<'_> {
    /// What our own export says of the cable of a tendon. Where the tendon was given another stiffness since,
    /// the tendon's counts.
    fn complete(
        &self,
        draft: &mut Draft,
        tendon: &Node,
        mut cable: DraftCable,
    ) -> Result<DraftCable, ExchangeError> {
        let name = tendon.text_in("@name");
        if let Some(limits) = self.numbers.get(format!("{name}.tension_limits").as_str()) {
            let [min, max] = limits.components()?;
            (cable.min, cable.max) = (Some(min), Some(max));
        }
        if let Some(data) = self.numbers.get(format!("{name}.properties").as_str()) {
            let [section, density, modulus, diameter, force] = data.components()?;
            let known = |value: f64| Some(value).filter(|value| *value > 0.0);
            let edited = cable
                .stiffness
                .take()
                .filter(|stiffness| (stiffness / (section * modulus) - 1.0).abs() > SAME);
            if edited.is_some() {
                let text = format!(
                    "stiffness times springlength is not EA of {name}.properties under custom: the tendon's \
                     counts, and the modulus follows from it"
                );
                draft.note_once(NoteKind::Questioned, tendon, &text);
            }
            cable.stiffness = edited;
            cable.properties = Some(CableProperties {
                diameter: known(diameter),
                breaking_force: known(force),
                ..CableProperties::linear(section, density, edited.map_or(modulus, |edited| edited / section))
            });
        }
        Ok(cable)
    }
}
