//! Settings of a model: angles, classes of defaults, frames.

use crate::document::Node;
use crate::error::ExchangeError;
use cdpr_robot::{Matrix3, Pose, Rotation3, UnitQuaternion, Vector3};
use std::collections::HashMap;

/// Settings of a model of MuJoCo.
pub(crate) struct Scene<'a> {
    /// Radians in its unit of angles.
    angle: f64,
    /// Order of Euler angles, in capitals about fixed axes.
    sequence: &'a str,
    /// Whether inertias come from geoms even where a body has its own.
    pub(crate) inertia_from_geoms: bool,
    classes: HashMap<&'a str, Class<'a>>,
}

/// Defaults of a class.
struct Class<'a> {
    parent: Option<&'a str>,
    /// By the names of elements.
    elements: HashMap<&'a str, Node<'a>>,
}

impl<'a> Scene<'a> {
    /// # Errors
    /// [`ExchangeError::Value`] for includes and settings that change what all numbers mean.
    pub(crate) fn of(root: &Node<'a>) -> Result<Self, ExchangeError> {
        let mut scene = Self {
            angle: 1f64.to_radians(),
            sequence: "xyz",
            inertia_from_geoms: false,
            classes: HashMap::new(),
        };
        if let Some(include) = root.get("include") {
            return Err(include.error("the file that it names in its place: included files are not read"));
        }
        for compiler in root.all("compiler") {
            if let Some(angle) = compiler.get("@angle") {
                scene.angle = match angle.text() {
                    "radian" => 1.0,
                    "degree" => 1f64.to_radians(),
                    _ => return Err(angle.error("radian or degree")),
                };
            }
            if let Some(sequence) = compiler.get("@eulerseq") {
                scene.sequence = sequence.text();
                let is_axis = |c: char| "xyzXYZ".contains(c);
                if scene.sequence.len() != 3 || !scene.sequence.chars().all(is_axis) {
                    return Err(sequence.error("three axes, such as xyz"));
                }
            }
            if let Some(coordinate) = compiler.get("@coordinate")
                && coordinate.text() != "local"
            {
                return Err(coordinate.error("local: global coordinates are not imported"));
            }
            if let Some(total) = compiler.get("@settotalmass")
                && total.number()? > 0.0
            {
                return Err(total.error("-1: a scaled total mass is not imported"));
            }
            scene.inertia_from_geoms |= compiler.text_in("@inertiafromgeom") == "true";
        }
        for default in root.all("default") {
            scene.add_class(default, None)?;
        }
        Ok(scene)
    }

    fn add_class(&mut self, node: Node<'a>, parent: Option<&'a str>) -> Result<(), ExchangeError> {
        let name = match node.text_in("@class") {
            "" if parent.is_none() => MAIN,
            "" => return Err(node.value_error(Some("@class"), "missing", "it to be there")),
            name => name,
        };
        let elements = node.elements().map(|element| (element.name(), element)).collect();
        if self.classes.insert(name, Class { parent, elements }).is_some() {
            return Err(node.value_error(Some("@class"), &format!("{name:?}, there twice"), "one of a name"));
        }
        node.all("default").try_for_each(|child| self.add_class(child, Some(name)))
    }

    /// An attribute of an element, or that of its class of defaults. `inherited` is the class of the bodies
    /// around it.
    pub(crate) fn attribute(
        &self,
        element: &Node<'a>,
        tag: &str,
        attribute: &str,
        inherited: Option<&'a str>,
    ) -> Option<Node<'a>> {
        if let Some(own) = element.get(attribute) {
            return Some(own);
        }
        let class = element.get("@class").map(|class| class.text());
        let mut class = class.or(inherited).or(Some(MAIN));
        while let Some(found) = class.and_then(|name| self.classes.get(name)) {
            if let Some(value) = found.elements.get(tag).and_then(|defaults| defaults.get(attribute)) {
                return Some(value);
            }
            class = found.parent;
        }
        None
    }

    /// Position and orientation of an element in the frame around it.
    pub(crate) fn pose(
        &self,
        element: &Node<'a>,
        tag: &str,
        inherited: Option<&'a str>,
    ) -> Result<Pose, ExchangeError> {
        let get = |name: &str| self.attribute(element, tag, name, inherited);
        let position = get("@pos").map_or(Ok(Vector3::zeros()), |node| node.vector())?;
        Ok(Pose { position, rotation: self.rotation(get)? })
    }

    fn rotation(&self, get: impl Fn(&str) -> Option<Node<'a>>) -> Result<Rotation3<f64>, ExchangeError> {
        if let Some(node) = get("@quat") {
            let [w, x, y, z] = node.components()?;
            if w * w + x * x + y * y + z * z < 1e-12 {
                return Err(node.error("a quaternion w x y z that is not zero"));
            }
            return Ok(UnitQuaternion::from_quaternion([x, y, z, w].into()).to_rotation_matrix());
        }
        if let Some(node) = get("@euler") {
            let angles: [f64; 3] = node.components()?;
            let mut rotation = Rotation3::identity();
            for (axis, angle) in self.sequence.chars().zip(angles) {
                let unit = match axis.to_ascii_lowercase() {
                    'x' => Vector3::x_axis(),
                    'y' => Vector3::y_axis(),
                    _ => Vector3::z_axis(),
                };
                let turn = Rotation3::from_axis_angle(&unit, self.angle * angle);
                rotation = if axis.is_ascii_lowercase() { rotation * turn } else { turn * rotation };
            }
            return Ok(rotation);
        }
        if let Some(node) = get("@axisangle") {
            let [x, y, z, angle] = node.components()?;
            let axis = direction(&node, Vector3::new(x, y, z))?;
            return Ok(Rotation3::new(axis * (self.angle * angle)));
        }
        if let Some(node) = get("@xyaxes") {
            let [x, y, z, a, b, c] = node.components()?;
            let x = direction(&node, Vector3::new(x, y, z))?;
            let y = Vector3::new(a, b, c);
            let y = direction(&node, y - x * x.dot(&y))?;
            return Ok(Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)])));
        }
        if let Some(node) = get("@zaxis") {
            let z = direction(&node, node.vector()?)?;
            return Ok(onto(&z));
        }
        Ok(Rotation3::identity())
    }
}

/// The class of defaults that elements have without another one.
const MAIN: &str = "main";

fn direction(node: &Node, vector: Vector3<f64>) -> Result<Vector3<f64>, ExchangeError> {
    if vector.norm() > 1e-9 {
        Ok(vector.normalize())
    } else {
        Err(node.error("directions that are not zero"))
    }
}

/// The least rotation that takes the z axis to a unit vector.
pub(crate) fn onto(z: &Vector3<f64>) -> Rotation3<f64> {
    Rotation3::rotation_between(&Vector3::z(), z)
        .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI))
}

/// Pictures, contacts, sensors, winches and damping: all that no robot at rest depends on.
pub(crate) fn is_harmless(within: &str, name: &str) -> bool {
    const EVERYWHERE: [&str; 25] = [
        "@name",
        "@class",
        "@rgba",
        "@material",
        "@group",
        "@user",
        "@size",
        "@contype",
        "@conaffinity",
        "@condim",
        "@friction",
        "@sidesite",
        "@solref",
        "@solimp",
        "@margin",
        "@gap",
        "@priority",
        "@damping",
        "@frictionloss",
        "@armature",
        "@width",
        "camera",
        "light",
        "@cycle",
        "@sleep",
    ];
    const SECTIONS: [&str; 11] = [
        "asset",
        "visual",
        "statistic",
        "size",
        "sensor",
        "actuator",
        "keyframe",
        "contact",
        "custom",
        "extension",
        "mujoco",
    ];
    const COMPILER: [&str; 9] = [
        "@autolimits",
        "@meshdir",
        "@texturedir",
        "@assetdir",
        "@strippath",
        "@discardvisual",
        "@fusestatic",
        "@usethread",
        "@convexhull",
    ];
    if within.contains("/actuator") || within.contains("/custom") || within.contains("/default") {
        return true;
    }
    EVERYWHERE.contains(&name)
        || match within.rsplit('/').next().unwrap_or_default() {
            "mujoco" => SECTIONS.contains(&name),
            "compiler" => COMPILER.contains(&name),
            "option" => !["@wind", "@density", "@viscosity", "@magnetic"].contains(&name),
            "spatial" => ["@limited", "@range", "@springlength"].contains(&name),
            "site" | "worldbody" => {
                !["frame", "replicate", "attach", "composite", "flexcomp"].contains(&name)
            }
            "joint" | "freejoint" => !["@stiffness", "@springref", "@ref"].contains(&name),
            "geom" => name != "@shellinertia",
            "flag" => true,
            _ => false,
        }
}
