//! The robot at the poses of a study, as points in space, as the view of the explorer takes them.

use crate::text::{self, beyond_rounding};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{Deflection, DirectProblem, Equilibrium, Load, StaticsError};
use cdpr_study::{Study, StudyError};
use serde::{Serialize, Serializer};

/// Number of points along a cable.
const POINTS: usize = 33;

/// Points of a cable on its pulley.
const POINTS_ON_PULLEY: usize = 8;

/// Robot at all poses of a study.
#[derive(Serialize)]
pub(crate) struct Scene {
    /// Exit points [m].
    pub(crate) exits: Vec<[f64; 3]>,
    /// Anchor points in the frame of the platform [m].
    anchors: Vec<[f64; 3]>,
    /// Centre of mass in the frame of the platform [m].
    center_of_mass: [f64; 3],
    /// Indices of the exit points in the order of their angle around their middle, seen from above: one ring
    /// or, where they are on two levels, a lower and an upper one.
    #[serde(skip)]
    pub(crate) rings: Vec<Vec<usize>>,
    /// Height of the floor [m].
    pub(crate) floor: f64,
    pub poses: Vec<ScenePose>,
}

/// Robot at one pose.
#[derive(Serialize)]
pub(crate) struct ScenePose {
    #[serde(serialize_with = "seven")]
    pub pose: Pose,
    /// Names of the samplings and surfaces at this pose.
    #[serde(skip)]
    pub parts: Vec<String>,
    pub name: String,
    pub unloaded: State,
    pub loaded: State,
    /// Unstrained lengths [m].
    #[serde(skip)]
    pub lengths: Vec<f64>,
    /// Deflection |dp| [mm].
    pub deflection_mm: f64,
}

/// A pose as the explorer takes it: position [m], then quaternion w, x, y, z.
fn seven<S: Serializer>(pose: &Pose, serializer: S) -> Result<S::Ok, S::Error> {
    let [w, i, j, k] = pose.quaternion();
    let [x, y, z] = pose.position.into();
    [x, y, z, w, i, j, k].serialize(serializer)
}

/// Points to a micrometre, which is finer than any screen.
fn micrometres<S: Serializer>(points: &[[f64; 3]], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(points.iter().map(|point| point.map(|x| (1e6 * x).round() / 1e6)))
}

/// Robot in equilibrium.
#[derive(Serialize)]
pub(crate) struct State {
    #[serde(serialize_with = "seven")]
    pose: Pose,
    /// Centre of mass [m].
    center_of_mass: [f64; 3],
    /// Anchor points [m].
    pub(crate) anchors: Vec<[f64; 3]>,
    pub cables: Vec<SceneCable>,
}

/// Cable in equilibrium.
#[derive(Serialize)]
pub(crate) struct SceneCable {
    /// Points from the exit point, over the pulley, to the anchor point [m].
    #[serde(serialize_with = "micrometres")]
    pub(crate) points: Vec<[f64; 3]>,
    /// Index of the point where the cable leaves its pulley: the first one of the free cable.
    free: usize,
    /// Points around the wheel of its pulley [m]; empty without one.
    #[serde(serialize_with = "micrometres")]
    pub(crate) wheel: Vec<[f64; 3]>,
    /// Tension at the platform [N].
    pub tension: f64,
    /// Greatest distance from the chord [mm].
    pub sag_mm: f64,
}

impl Scene {
    /// Collects every pose of the study once, in the order of its samplings and surfaces.
    ///
    /// A sampling at several poses contributes the first pose that the nominal robot holds.
    ///
    /// # Errors
    /// As [`Study::sampling`].
    pub(crate) fn new(study: &Study) -> Result<Self, StudyError> {
        let mut poses: Vec<ScenePose> = Vec::new();
        let mut add = |name: &str, pose: Pose, nominal: &Deflection| -> Result<(), StudyError> {
            if let Some(known) = poses.iter_mut().find(|known| known.pose == pose) {
                known.parts.push(name.to_owned());
                return Ok(());
            }
            let drawn = ScenePose::new(&study.robot, name, pose, nominal);
            poses.push(drawn.map_err(|error| StudyError::Nominal {
                path: study.path.clone(),
                field: name.to_owned(),
                value: text::point(pose.position.as_slice()),
                meant: None,
                source: Box::new(error),
            })?);
            Ok(())
        };
        for (name, spec) in &study.file.samplings {
            if spec.pose.is_some() {
                let found = study.nominal(name)?;
                add(name, found.pose, &found.deflection)?;
                continue;
            }
            // The first pose that is held stands for all poses of the sampling.
            let prefix = format!("{name}/");
            let mut names = study.sampling_names().filter(|name| name.starts_with(&prefix));
            if let Some((found, name)) = names.find_map(|name| Some((study.nominal(&name).ok()?, name))) {
                add(&name, found.pose, &found.deflection)?;
            }
        }
        for name in study.file.surfaces.keys() {
            let found = study.nominal(name)?;
            add(name, found.pose, &found.deflection)?;
        }
        if let (true, Some(name)) = (poses.is_empty(), study.sampling_names().next()) {
            // This returns the reason why there is nothing to draw.
            study.nominal(&name)?;
        }
        let exits: Vec<[f64; 3]> = study.robot.cables.iter().map(|cable| cable.exit_point.into()).collect();
        let lowest = exits.iter().map(|exit| exit[2]).fold(f64::INFINITY, f64::min);
        let anchors = poses.iter().flat_map(|pose| pose.loaded.anchors.iter().chain(&pose.unloaded.anchors));
        let floor = anchors.map(|anchor| anchor[2]).fold(lowest.min(0.0), f64::min);
        Ok(Self {
            anchors: study.robot.cables.iter().map(|cable| cable.anchor_point.into()).collect(),
            center_of_mass: study.robot.platform.center_of_mass.into(),
            rings: rings(&exits),
            floor,
            exits,
            poses,
        })
    }
}

impl ScenePose {
    fn new(robot: &Robot, part: &str, pose: Pose, nominal: &Deflection) -> Result<Self, StaticsError> {
        let rotated = if pose.quaternion() == [1.0, 0.0, 0.0, 0.0] { "" } else { ", rotated" };
        let unloaded = State::new(robot, &nominal.lengths, &nominal.unloaded.equilibrium)?;
        let deflection_mm = beyond_rounding(1e3 * nominal.magnitude());
        // What differs by rounding errors alone is not drawn as an arrow.
        let loaded = if deflection_mm > 0.0 { &nominal.loaded } else { &nominal.unloaded };
        Ok(Self {
            name: format!("{} m{rotated}", text::point(pose.position.as_slice())),
            parts: vec![part.to_owned()],
            loaded: State::new(robot, &nominal.lengths, &loaded.equilibrium)?,
            unloaded,
            lengths: nominal.lengths.clone(),
            deflection_mm,
            pose,
        })
    }
}

impl State {
    fn new(robot: &Robot, lengths: &[f64], equilibrium: &Equilibrium) -> Result<Self, StaticsError> {
        let Equilibrium { pose, cable_forces } = equilibrium;
        let anchor = |i: usize| pose.position + robot.anchor_arm(pose, i);
        let load = Load::none();
        let problem = DirectProblem::new(robot, lengths, &load)?;
        let cables = cable_forces.iter().enumerate().map(|(i, force)| {
            let shape = problem.shape(equilibrium, i, POINTS_ON_PULLEY, POINTS)?;
            Ok(SceneCable {
                free: shape.points.len() - POINTS,
                points: shape.points.into_iter().map(Into::into).collect(),
                wheel: shape.wheel.into_iter().map(Into::into).collect(),
                tension: force.norm(),
                sag_mm: 1e3 * shape.sag,
            })
        });
        Ok(Self {
            pose: *pose,
            center_of_mass: (pose.position + pose.rotation * robot.platform.center_of_mass).into(),
            anchors: (0..lengths.len()).map(|i| anchor(i).into()).collect(),
            cables: cables.collect::<Result<_, StaticsError>>()?,
        })
    }

    /// Greatest sag of the cables [mm].
    pub(crate) fn greatest_sag_mm(&self) -> f64 {
        self.cables.iter().map(|cable| cable.sag_mm).fold(0.0, f64::max)
    }
}

/// Indices of points in the order of their angle around their middle, seen from above, of each of the levels
/// on which they are: two where a gap of more than 0.4 of their height separates them, else one.
fn rings(points: &[[f64; 3]]) -> Vec<Vec<usize>> {
    let middle = points.iter().map(|point| Vector3::from(*point)).sum::<Vector3<f64>>() / points.len() as f64;
    let angle = |i: &usize| (points[*i][1] - middle.y).atan2(points[*i][0] - middle.x);
    let mut rising: Vec<usize> = (0..points.len()).collect();
    rising.sort_by(|one, other| points[*one][2].total_cmp(&points[*other][2]));
    let height = |k: usize| points[rising[k]][2];
    let whole = height(points.len() - 1) - height(0);
    let extent = |axis: usize| {
        let values = || points.iter().map(|point| point[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    let is_high = whole > 0.1 * extent(0).max(extent(1)).max(whole);
    let split = (3..points.len().saturating_sub(2)).find(|&k| height(k) - height(k - 1) > 0.4 * whole);
    let mut levels = match split.filter(|_| is_high) {
        Some(split) => vec![rising[..split].to_vec(), rising[split..].to_vec()],
        None => vec![rising],
    };
    levels.iter_mut().for_each(|level| level.sort_by(|one, other| angle(one).total_cmp(&angle(other))));
    levels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cables_are_drawn_from_exit_to_anchor_point_and_below_their_chord_by_their_sag() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json");
        let scene = Scene::new(&Study::open(path.as_ref()).unwrap()).unwrap();
        assert_eq!(scene.poses.len(), 2, "three samplings and two surfaces at two poses");
        assert_eq!(scene.poses[0].parts.len(), 4);
        for state in scene.poses.iter().flat_map(|pose| [&pose.unloaded, &pose.loaded]) {
            for (i, cable) in state.cables.iter().enumerate() {
                let (first, last) = (Vector3::from(cable.points[0]), Vector3::from(cable.points[POINTS - 1]));
                assert!((first - Vector3::from(scene.exits[i])).norm() < 1e-12);
                assert!((last - Vector3::from(state.anchors[i])).norm() < 1e-9);
                let chord = (last - first).normalize();
                let away = |point: &[f64; 3]| (Vector3::from(*point) - first).cross(&chord).norm();
                let sag = cable.points.iter().map(away).fold(0.0, f64::max);
                assert!(sag > 0.0 && (1e3 * sag - cable.sag_mm).abs() < 0.01 * cable.sag_mm, "{sag}");
            }
        }
    }

    #[test]
    fn exit_points_on_two_levels_have_a_ring_on_each() {
        let corners = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        let level = |z: f64| corners.map(|[x, y]| [x, y, z]);
        assert_eq!(rings(&level(3.0)), [vec![0, 2, 1, 3]]);
        assert_eq!(rings(&[level(3.0), level(0.5)].concat()), [vec![4, 6, 5, 7], vec![0, 2, 1, 3]]);
        // Heights of a survey are one level.
        assert_eq!(rings(&[[0.0, 0.0, 3.0], [1.0, 1.0, 3.01], [1.0, 0.0, 3.0], [0.0, 1.0, 3.02]]).len(), 1);
    }
}
