//! Bodies of a model of MuJoCo: where their sites are, which of them is the platform, and its mass.

use crate::document::Node;
use crate::draft::{Draft, NoteKind};
use crate::error::ExchangeError;
use crate::read::mjcf::geometry::{Geom, Mass};
use crate::read::mjcf::scene::Scene;
use cdpr_robot::{Matrix3, Plane, Pose, Pulley, Vector3};
use std::collections::{HashMap, HashSet};

/// The bodies of a model.
pub(crate) struct Bodies<'a> {
    bodies: Vec<Body<'a>>,
    pub(crate) sites: Vec<Site>,
    pub(crate) geoms: Vec<PlacedGeom>,
    site_names: HashMap<&'a str, usize>,
    geom_names: HashMap<&'a str, usize>,
    /// Height of a level plane of the frame [m].
    pub(crate) ground_z: Option<f64>,
}

struct Body<'a> {
    node: Node<'a>,
    /// In the base frame.
    pose: Pose,
    /// The outermost one of the bodies around and this one that has joints.
    mover: Option<usize>,
    joints: Vec<Joint<'a>>,
    /// Mass in its own frame; `None` if it is not known.
    mass: Option<Mass>,
    has_mass: bool,
}

struct Joint<'a> {
    node: Node<'a>,
    kind: &'a str,
    /// In the base frame.
    axis: Vector3<f64>,
}

/// A site.
pub(crate) struct Site {
    /// In the base frame [m].
    pub(crate) position: Vector3<f64>,
    /// In its body [m], and the body.
    local: Vector3<f64>,
    body: usize,
    pub(crate) mover: Option<usize>,
}

/// A geom around which a tendon may wrap.
pub(crate) struct PlacedGeom {
    is_cylinder: bool,
    radius: f64,
    /// In the base frame.
    pose: Pose,
    pub(crate) mover: Option<usize>,
}

/// What a tendon runs through, one after the other.
pub(crate) enum Stop<'a> {
    /// A site by its number.
    Site(usize),
    /// A geom that it wraps around, by its number.
    Geom(usize, Node<'a>),
}

/// How far from a cylinder a site may be to lie on it, relative to its radius.
const ON_CYLINDER: f64 = 0.01;

/// Sine of the angle between the entering cable and the tangent at most.
const ALONG_TANGENT: f64 = 0.1;

fn joined(outer: &Pose, inner: &Pose) -> Pose {
    Pose {
        position: outer.position + outer.rotation * inner.position,
        rotation: outer.rotation * inner.rotation,
    }
}

impl<'a> Bodies<'a> {
    pub(crate) fn of(root: &Node<'a>, scene: &Scene<'a>) -> Result<Self, ExchangeError> {
        let mut bodies = Self {
            bodies: Vec::new(),
            sites: Vec::new(),
            geoms: Vec::new(),
            site_names: HashMap::new(),
            geom_names: HashMap::new(),
            ground_z: None,
        };
        let base = Pose::at(0.0, 0.0, 0.0);
        for world in root.all("worldbody") {
            bodies.add(world, &base, None, None, scene)?;
        }
        Ok(bodies)
    }

    /// Adds a body, which has a pose in the base frame, and those in it.
    fn add(
        &mut self,
        node: Node<'a>,
        pose: &Pose,
        around: Option<usize>,
        class: Option<&'a str>,
        scene: &Scene<'a>,
    ) -> Result<(), ExchangeError> {
        let id = self.bodies.len();
        let class = node.get("@childclass").map(|class| class.text()).or(class);
        let mut joints = Vec::new();
        for joint in node.all("joint").chain(node.all("freejoint")) {
            let get = |name: &str| scene.attribute(&joint, "joint", name, class);
            let kind = match joint.name() {
                "freejoint" => "free",
                _ => get("@type").map_or("hinge", |kind| kind.text()),
            };
            let axis = get("@axis").map_or(Ok(Vector3::z()), |axis| axis.vector())?;
            joints.push(Joint { node: joint, kind, axis: pose.rotation * axis });
        }
        let around_mover = around.and_then(|around| self.bodies[around].mover);
        let mover = around_mover.or((!joints.is_empty()).then_some(id));
        let mut parts = Vec::new();
        for geom in node.all("geom") {
            let placed = Geom::of(&geom, scene, class)?;
            parts.push(placed.mass());
            let in_base = joined(pose, &placed.pose);
            if let Some(name) = geom.get("@name")
                && self.geom_names.insert(name.text(), self.geoms.len()).is_some()
            {
                return Err(twice(&name));
            }
            let up = in_base.rotation * Vector3::z();
            if placed.kind == "plane" && mover.is_none() && up.z > 1.0 - 1e-9 {
                let z = in_base.position.z;
                self.ground_z = Some(self.ground_z.map_or(z, |highest: f64| highest.max(z)));
            }
            self.geoms.push(PlacedGeom {
                is_cylinder: placed.kind == "cylinder",
                radius: placed.size.first().copied().unwrap_or(0.0),
                pose: in_base,
                mover,
            });
        }
        let (mass, has_mass) = match node.get("inertial") {
            Some(inertial) if !scene.inertia_from_geoms => (Some(read_inertial(&inertial, scene)?), true),
            _ => {
                let all: Option<Vec<Mass>> = parts.iter().copied().collect();
                (all.and_then(|all| Mass::together(&all)), !parts.is_empty())
            }
        };
        self.bodies.push(Body { node, pose: *pose, mover, joints, mass, has_mass });
        for site in node.all("site") {
            let local = scene.pose(&site, "site", class)?.position;
            if let Some(name) = site.get("@name")
                && self.site_names.insert(name.text(), self.sites.len()).is_some()
            {
                return Err(twice(&name));
            }
            self.sites.push(Site { position: pose.position + pose.rotation * local, local, body: id, mover });
        }
        for body in node.all("body") {
            let inner = scene.pose(&body, "body", None)?;
            self.add(body, &joined(pose, &inner), Some(id), class, scene)?;
        }
        Ok(())
    }

    /// The number of the site that a node names.
    pub(crate) fn site(&self, name: &Node) -> Result<usize, ExchangeError> {
        self.site_names.get(name.text()).copied().ok_or_else(|| name.error("the name of a site"))
    }

    /// The number of the geom that a node names.
    pub(crate) fn geom(&self, name: &Node) -> Result<usize, ExchangeError> {
        self.geom_names.get(name.text()).copied().ok_or_else(|| name.error("the name of a geom"))
    }

    /// A site of the platform in the frame of the platform [m]; in the axes of the base frame for one that
    /// cannot rotate.
    pub(crate) fn in_platform(&self, platform: usize, held_rotation: bool, site: usize) -> Vector3<f64> {
        let Site { position, local, body, .. } = self.sites[site];
        let pose = self.bodies[platform].pose;
        match body == platform {
            _ if held_rotation => position - pose.position,
            true => local,
            false => pose.rotation.inverse() * (position - pose.position),
        }
    }

    /// The pulley that a cylinder is, if the site after it lies on it and the next one shows where the cable
    /// comes from.
    pub(crate) fn pulley(&self, geom: usize, sites: &[usize], stop: &Node) -> Result<Pulley, ExchangeError> {
        let cylinder = &self.geoms[geom];
        let expected = "a cylinder of the frame, then a site on it where the cable enters, then one where it \
                        comes from: other shapes are not imported";
        let [enters, from, ..] = sites[..] else { return Err(stop.need("@geom")?.error(expected)) };
        let [enters, from] = [enters, from].map(|site| self.sites[site].position);
        let local = cylinder.pose.rotation.inverse() * (enters - cylinder.pose.position);
        let distance = local.xy().norm();
        let axle = cylinder.pose.rotation * Vector3::z();
        let radial = cylinder.pose.rotation * Vector3::new(local.x, local.y, 0.0);
        let along = enters - from;
        let is_tangent = along.norm() > 0.0
            && along.dot(&axle).abs() < ALONG_TANGENT * along.norm()
            && along.dot(&radial).abs() < ALONG_TANGENT * along.norm() * radial.norm();
        let is_on = (distance - cylinder.radius).abs() < ON_CYLINDER * cylinder.radius;
        if !(cylinder.is_cylinder && is_on && is_tangent) {
            return Err(stop.need("@geom")?.error(expected));
        }
        Ok(Pulley { radius: cylinder.radius, axis: along.normalize() })
    }

    /// The body that the tendons hold: the free one, or the one that all of them end at.
    pub(crate) fn platform(&self, root: &Node, paths: &[Vec<Stop>]) -> Result<usize, ExchangeError> {
        let mut counts: HashMap<usize, usize> = HashMap::new();
        for path in paths {
            let movers: HashSet<usize> = path
                .iter()
                .filter_map(|stop| match stop {
                    Stop::Site(site) => self.sites[*site].mover,
                    Stop::Geom(geom, _) => self.geoms[*geom].mover,
                })
                .collect();
            movers.into_iter().for_each(|mover| *counts.entry(mover).or_default() += 1);
        }
        let is_free = |body: &&usize| self.bodies[**body].joints.iter().any(|joint| joint.kind == "free");
        let free: Vec<usize> = counts.keys().filter(is_free).copied().collect();
        let of_all: Vec<usize> =
            counts.iter().filter(|(_, count)| **count == paths.len()).map(|(body, _)| *body).collect();
        match (&free[..], &of_all[..]) {
            ([only], _) | ([], [only]) => Ok(*only),
            _ => {
                let value = format!("tendons that end at {} free bodies", free.len());
                let expected = "one platform: a body with a free joint, or one that all tendons end at";
                Err(root.value_error(Some("tendon"), &value, expected))
            }
        }
    }

    /// Reads motions, mass and inertia of the platform: of its body and of all that is fixed to it.
    pub(crate) fn read_platform(&self, draft: &mut Draft, platform: usize) -> Result<(), ExchangeError> {
        let body = &self.bodies[platform];
        read_motions(draft, body)?;
        let mut parts = Vec::new();
        let mut is_known = true;
        for part in self.bodies.iter().filter(|part| part.mover == Some(platform)) {
            if let Some(joint) = part.joints.first().filter(|_| part.node != body.node) {
                let text =
                    format!("{} with joints on the platform: it is taken as fixed", name_of(&part.node));
                draft.note_once(NoteKind::Questioned, &joint.node, text);
            }
            match part.mass {
                Some(mass) if part.node == body.node => parts.push(mass),
                Some(mass) => {
                    let back = body.pose.rotation.inverse();
                    let relative = Pose {
                        position: back * (part.pose.position - body.pose.position),
                        rotation: back * part.pose.rotation,
                    };
                    parts.push(mass.placed(&relative));
                }
                None if part.has_mass => is_known = false,
                None => {}
            }
        }
        if !is_known {
            draft.note(NoteKind::Questioned, &body.node, "the mass of a mesh is not known and not imported");
            return Ok(());
        }
        if let Some(Mass { mass, center, inertia }) = Mass::together(&parts).filter(|all| all.mass > 0.0) {
            draft.mass = Some(mass);
            draft.center_of_mass = Some(center);
            draft.inertia = Some(inertia);
        }
        Ok(())
    }
}

fn name_of(node: &Node) -> String {
    match node.text_in("@name") {
        "" => "a body".to_owned(),
        name => format!("the body {name}"),
    }
}

/// The error of a name that two elements have.
pub(crate) fn twice(name: &Node) -> ExchangeError {
    name.value_error(None, &format!("{:?}, there twice", name.text()), "one of a name")
}

/// Which motions the joints of the platform leave it.
fn read_motions(draft: &mut Draft, body: &Body) -> Result<(), ExchangeError> {
    if body.joints.iter().any(|joint| joint.kind == "free") {
        return Ok(());
    }
    let expected = "a free joint, slides along axes of the base frame, or two of them and a hinge across";
    let refused = |joint: &Joint| Err(joint.node.value_error(None, joint.kind, expected));
    let (mut slides, mut hinges) = ([false; 3], [false; 3]);
    for joint in &body.joints {
        let axis = joint.axis.normalize();
        let Some(along) = (0..3).find(|i| axis[*i].abs() > 1.0 - 1e-9) else { return refused(joint) };
        let of_kind = match joint.kind {
            "slide" => &mut slides,
            "hinge" => &mut hinges,
            _ => return refused(joint),
        };
        if std::mem::replace(&mut of_kind[along], true) {
            return refused(joint);
        }
    }
    let in_plane = |plane: &Plane| (0..3).all(|i| slides[i] != (i == plane.normal()));
    let plane = [Plane::Xy, Plane::Xz, Plane::Yz].into_iter().find(in_plane);
    let across = |plane: Plane| (0..3).all(|i| hinges[i] == (i == plane.normal()));
    match plane {
        _ if slides == [true; 3] && hinges == [true; 3] => {}
        None if slides == [true; 3] && hinges == [false; 3] => draft.held_rotation = true,
        Some(plane) if hinges == [false; 3] => (draft.plane, draft.held_rotation) = (Some(plane), true),
        Some(plane) if across(plane) => draft.plane = Some(plane),
        _ => return refused(&body.joints[0]),
    }
    Ok(())
}

fn read_inertial<'a>(node: &Node<'a>, scene: &Scene<'a>) -> Result<Mass, ExchangeError> {
    let pose = scene.pose(node, "inertial", None)?;
    let mass = node.need("@mass")?.number()?;
    let inertia = if let Some(full) = node.get("@fullinertia") {
        let [xx, yy, zz, xy, xz, yz] = full.components()?;
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    } else {
        Matrix3::from_diagonal(&node.need("@diaginertia")?.vector()?)
    };
    Ok(Mass { mass, center: Vector3::zeros(), inertia }.placed(&pose))
}
