//! Mass and inertia of the geoms of MuJoCo.

use crate::document::Node;
use crate::error::ExchangeError;
use crate::read::mjcf::scene::{Scene, onto};
use cdpr_robot::{Matrix3, Pose, Vector3};
use std::f64::consts::PI;

/// A body with its mass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mass {
    /// Mass [kg].
    pub(crate) mass: f64,
    /// Centre of mass [m].
    pub(crate) center: Vector3<f64>,
    /// Inertia about the centre of mass [kg m²].
    pub(crate) inertia: Matrix3<f64>,
}

impl Mass {
    /// The same in the frame around, in which its own frame has a pose.
    pub(crate) fn placed(&self, pose: &Pose) -> Self {
        Self {
            mass: self.mass,
            center: pose.position + pose.rotation * self.center,
            inertia: pose.rotation * self.inertia * pose.rotation.inverse(),
        }
    }

    /// Several bodies as one.
    pub(crate) fn together(parts: &[Mass]) -> Option<Self> {
        if let [only] = parts {
            return Some(*only);
        }
        let mass: f64 = parts.iter().map(|part| part.mass).sum();
        if mass <= 0.0 {
            return None;
        }
        let center = parts.iter().map(|part| part.mass * part.center).sum::<Vector3<f64>>() / mass;
        let inertia = parts.iter().map(|part| {
            let arm = part.center - center;
            part.inertia + part.mass * (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose())
        });
        Some(Self { mass, center, inertia: inertia.sum() })
    }
}

/// A geom.
pub(crate) struct Geom<'a> {
    /// `sphere`, `cylinder`, ...
    pub(crate) kind: &'a str,
    /// Radius, half lengths [m].
    pub(crate) size: Vec<f64>,
    /// Its pose in its body.
    pub(crate) pose: Pose,
    mass: Option<f64>,
    density: f64,
}

impl<'a> Geom<'a> {
    pub(crate) fn of(
        node: &Node<'a>,
        scene: &Scene<'a>,
        inherited: Option<&'a str>,
    ) -> Result<Self, ExchangeError> {
        let get = |name: &str| scene.attribute(node, "geom", name, inherited);
        let number = |name: &str| get(name).map(|node| node.number()).transpose();
        let kind = get("@type").map_or("sphere", |kind| kind.text());
        let kind = if get("@mesh").is_some() { "mesh" } else { kind };
        let mut size = get("@size").map_or(Ok(Vec::new()), |size| size.numbers())?;
        let mut pose = scene.pose(node, "geom", inherited)?;
        if let Some(ends) = get("@fromto") {
            let [a, b, c, d, e, f] = ends.components()?;
            let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
            let length = (to - from).norm();
            if length < 1e-12 {
                return Err(ends.error("two different points"));
            }
            pose = Pose { position: 0.5 * (from + to), rotation: onto(&((to - from) / length)) };
            // Boxes and ellipsoids between two points are as thick as they are wide.
            size.truncate(1);
            if let ([width], "box" | "ellipsoid") = (&size[..], kind) {
                size.push(*width);
            }
            size.push(0.5 * length);
        }
        let needed = match kind {
            "sphere" => 1,
            "capsule" | "cylinder" => 2,
            "box" | "ellipsoid" => 3,
            _ => 0,
        };
        if size.len() < needed || size.iter().take(needed).any(|size| *size <= 0.0) {
            let expected = format!("{needed} positive sizes of a {kind}");
            return Err(get("@size").map_or_else(
                || node.value_error(Some("@size"), "missing", &expected),
                |size| size.error(&expected),
            ));
        }
        Ok(Self { kind, size, pose, mass: number("@mass")?, density: number("@density")?.unwrap_or(1000.0) })
    }

    /// Mass and inertia in the frame of its body; `None` if they are not known, as those of a mesh.
    pub(crate) fn mass(&self) -> Option<Mass> {
        let diagonal = |x: f64, y: f64, z: f64| Matrix3::from_diagonal(&Vector3::new(x, y, z));
        // Volume, and inertia per mass.
        let (volume, inertia) = match (self.kind, &self.size[..]) {
            _ if self.mass == Some(0.0) => (0.0, Matrix3::zeros()),
            ("plane", _) => (0.0, Matrix3::zeros()),
            ("sphere", [r, ..]) => (4.0 / 3.0 * PI * r.powi(3), Matrix3::identity() * (0.4 * r * r)),
            ("box", [a, b, c, ..]) => {
                let [a2, b2, c2] = [a * a, b * b, c * c];
                (8.0 * a * b * c, diagonal(b2 + c2, a2 + c2, a2 + b2) / 3.0)
            }
            ("ellipsoid", [a, b, c, ..]) => {
                let [a2, b2, c2] = [a * a, b * b, c * c];
                (4.0 / 3.0 * PI * a * b * c, diagonal(b2 + c2, a2 + c2, a2 + b2) / 5.0)
            }
            ("cylinder", [r, h, ..]) => {
                let across = (3.0 * r * r + 4.0 * h * h) / 12.0;
                (2.0 * PI * r * r * h, diagonal(across, across, 0.5 * r * r))
            }
            ("capsule", [r, h, ..]) => {
                // A cylinder, and two halves of a ball at its ends.
                let (tube, ball) = (2.0 * PI * r * r * h, 4.0 / 3.0 * PI * r.powi(3));
                let along = 0.5 * tube * r * r + 0.4 * ball * r * r;
                let across =
                    tube * (3.0 * r * r + 4.0 * h * h) / 12.0 + ball * (0.4 * r * r + h * h + 0.75 * h * r);
                (tube + ball, diagonal(across, across, along) / (tube + ball))
            }
            _ => return None,
        };
        let mass = self.mass.unwrap_or(self.density * volume);
        let own = Mass { mass, center: Vector3::zeros(), inertia: inertia * mass };
        Some(own.placed(&self.pose))
    }
}
