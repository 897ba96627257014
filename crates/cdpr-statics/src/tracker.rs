//! Direct solves one after the other, each from the equilibrium before: the case of a control loop or a simulation.

use crate::direct::{Residual, Start, direct, rounding_of_closure};
use crate::error::StaticsError;
use crate::lane_algebra::three;
use crate::lanes::{Lanes, Scalar};
use crate::model::{Equilibrium, Load, Model};
use crate::taut::{self, Cable, Robots, Scale, Tangent};
use cdpr_robot::{Matrix3, Robot, Rotation3, Vector3};

/// Follows the stable equilibrium of a robot while its cables are wound and its load changes.
///
/// ```
/// use cdpr_robot::{Pose, Robot};
/// use cdpr_statics::{Load, Tracker, inverse};
///
/// let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json"))?;
/// let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none(), None)?;
/// let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium)?;
/// let mut lengths = wanted.lengths.clone();
/// lengths[0] -= 1e-3;
/// let pose = tracker.update(&lengths, &Load::none())?.pose;
/// println!("{:.3} mm", 1e3 * (pose.position - wanted.equilibrium.pose.position).norm());
/// assert!(tracker.residual().force < 1e-8);
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
pub struct Tracker<'a> {
    robot: &'a Robot,
    equilibrium: Equilibrium,
    residual: Residual,
    /// Largest distance of an exit point from the origin [m].
    farthest: f64,
    platform: Robots<Scalar>,
    tangent: Tangent<Scalar>,
    /// Whether it is that of the equilibrium at hand.
    tangent_fits: bool,
}

impl<'a> Tracker<'a> {
    /// Begins at the equilibrium for `lengths` [m] and `load` that [`direct`] finds from `start`.
    ///
    /// # Errors
    /// Those of [`direct`], and [`StaticsError::Robot`] for a robot that is none.
    pub fn new(
        robot: &'a Robot,
        lengths: &[f64],
        load: &Load,
        start: &Equilibrium,
    ) -> Result<Self, StaticsError> {
        robot.validate()?;
        let solution = direct(robot, lengths, load, Start::Near(start))?;
        let zero = lane(0.0);
        let cable = |i: usize| {
            let cable = robot.cable(i);
            Cable {
                weight: lane(cable.weight_per_length),
                stretch: lane(1.0 / cable.axial_stiffness),
                exit: lanes(&robot.cables[i].exit_point),
                arm: [zero; 3],
                length: zero,
                force: [zero; 2],
            }
        };
        let n = robot.cables.len();
        Ok(Self {
            robot,
            residual: solution.report.residual,
            equilibrium: solution.equilibrium,
            farthest: robot.cables.iter().map(|cable| cable.exit_point.norm()).fold(0.0, f64::max),
            platform: Robots {
                cables: (0..n).map(cable).collect(),
                position: [zero; 3],
                center: [zero; 3],
                frame: vec![[zero; 3]; 3],
                weight: lane(robot.platform.mass * robot.gravity),
            },
            tangent: Tangent::new(zero, n),
            tangent_fits: false,
        })
    }

    /// The equilibrium at hand.
    pub fn equilibrium(&self) -> &Equilibrium {
        &self.equilibrium
    }

    /// What it leaves open in the equations.
    pub fn residual(&self) -> Residual {
        self.residual
    }

    /// Goes to the equilibrium for other lengths [m] and another load, near the one at hand. Nothing is allocated where all cables are
    /// taut and Newton's method finds a stable equilibrium; whatever else there is, [`direct`] is asked.
    ///
    /// # Errors
    /// Those of [`direct`]; the equilibrium at hand is then the one before.
    pub fn update(&mut self, lengths: &[f64], load: &Load) -> Result<&Equilibrium, StaticsError> {
        let model = Model::new(self.robot, lengths, load)?;
        // A moment has no potential: whether its equilibria are stable is not seen from pivots.
        self.tangent_fits = load.wrench.moment == Vector3::zeros() && self.settle(&model);
        if !self.tangent_fits {
            let solution = direct(self.robot, lengths, load, Start::Near(&self.equilibrium))?;
            self.residual = solution.report.residual;
            self.equilibrium = solution.equilibrium;
        }
        Ok(&self.equilibrium)
    }

    /// Newton's method for taut cables. Whether it found an equilibrium.
    fn settle(&mut self, model: &Model) -> bool {
        let Self { robot, equilibrium, platform, tangent, .. } = self;
        let pose = &mut equilibrium.pose;
        platform.position = lanes(&pose.position);
        platform.center = lanes(&(pose.rotation * robot.platform.center_of_mass));
        for (k, column) in platform.frame.iter_mut().enumerate() {
            *column = lanes(&pose.rotation.matrix().column(k).into());
        }
        for (i, cable) in platform.cables.iter_mut().enumerate() {
            cable.arm = lanes(&robot.anchor_arm(pose, i));
            cable.force = [lane(equilibrium.cable_forces[i].x), lane(equilibrium.cable_forces[i].y)];
        }
        let force = &model.load.wrench.force;
        let load =
            taut::Load { weight: platform.weight + model.load.payload * robot.gravity, force: lanes(force) };
        let size = model.size();
        let coordinates = pose.position.norm() + self.farthest;
        let scale = Scale { size, arm: model.arm(), rounding: rounding_of_closure(size, coordinates) };
        let zero = lane(0.0);
        let all = zero.less_or_equal(zero);
        if self.tangent_fits {
            platform.pay_out(&load, tangent, |i| lane(model.lengths[i]) - platform.cables[i].length);
        }
        for (cable, length) in platform.cables.iter_mut().zip(model.lengths) {
            cable.length = lane(*length);
        }
        if !self.tangent_fits {
            platform.linearise(&load, tangent, all);
        }
        let (found, open) = platform.settle(&load, tangent, &scale, all);
        if !found.any() {
            return false;
        }
        pose.position = vector(&platform.position);
        let columns: [Vector3<f64>; 3] = [0, 1, 2].map(|k| vector(&platform.frame[k]));
        pose.rotation = nearest_rotation(&Matrix3::from_columns(&columns));
        for (force, cable) in equilibrium.cable_forces.iter_mut().zip(&platform.cables) {
            (force.x, force.y) = (value(cable.force[0]), value(cable.force[1]));
        }
        let [force, moment] = open.norms();
        self.residual = Residual { closure: value(open.closure).sqrt(), force: force[0], moment: moment[0] };
        true
    }
}

/// A rotation from a matrix that is one but for rounding: Newton's step `R (3 - Rᵀ R)/2` to the nearest one.
fn nearest_rotation(matrix: &Matrix3<f64>) -> Rotation3<f64> {
    let excess = matrix.transpose() * matrix;
    Rotation3::from_matrix_unchecked(matrix * (Matrix3::from_diagonal_element(1.5) - excess * 0.5))
}

fn lane(value: f64) -> Lanes<Scalar> {
    Lanes::splat(Scalar, value)
}

fn lanes(vector: &Vector3<f64>) -> [Lanes<Scalar>; 3] {
    three(|k| lane(vector[k]))
}

fn value(lane: Lanes<Scalar>) -> f64 {
    lane.to_array()[0]
}

fn vector(lanes: &[Lanes<Scalar>; 3]) -> Vector3<f64> {
    Vector3::new(value(lanes[0]), value(lanes[1]), value(lanes[2]))
}
