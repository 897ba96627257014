//! What a robot does along a path of poses, and how uncertain that is.
//!
//! The lengths hold each pose under the platform's own weight, on the branch of the pose before
//! ([`cdpr_statics::InversePath`]); then the load comes onto the platform with the lengths kept. The standard
//! deviation of a quantity q follows, to first order, from its exact derivatives with respect to the
//! independent inputs θ_j of an error model,
//!
//! ```text
//! std(q)² = sum (dq/dθ_j)² var(θ_j)                                                                 (W5)
//! ```
//!
//! with the mean of both squares where left and right derivatives differ.

use cdpr_dynamics::{FrequencyDerivatives, Modes, Swing, Wanted};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::{
    Deflection, Derivatives, DirectProblem, InversePath, Load, StaticsError, deflection_from, derivatives,
};
use cdpr_study::{ErrorModel, StudyError};

/// A pose of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathPose {
    /// Whether the lengths may jump here.
    pub jump: bool,
    /// Tension of every cable at the platform without the load [N]; exactly the limit where one is active.
    pub tensions: Vec<f64>,
    /// Tension of every cable at its exit point without the load [N].
    pub exit_tensions: Vec<f64>,
    /// Greatest distance of each cable across its chord without the load [m].
    pub sags: Vec<f64>,
    /// The lengths, and the equilibria without and with the load.
    pub deflection: Deflection,
    /// How fast the platform swings with the load, the mass of the cables included; `None` for a robot that
    /// lacks `platform.inertia`, and where a cable hangs without tension.
    pub swing: Option<Swing>,
    /// Standard deviations; `None` without an error model, and where the pose has no derivatives on this
    /// branch.
    pub bands: Option<Bands>,
}

/// Standard deviations at a pose, (W5). `None` stands for what has no derivative.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands {
    /// Of the unstrained lengths [m].
    pub lengths: Vec<f64>,
    /// Of the tensions at the platform without the load [N].
    pub tensions: Vec<f64>,
    /// Of dp under the load [m].
    pub displacement: [f64; 3],
    /// Of |dp| [m].
    pub magnitude: Option<f64>,
    /// Of the stiffness of the softest motion with the load [N/m].
    pub least_stiffness: Option<f64>,
    /// Of the frequency of the platform with the load, [`Swing::platform`] [Hz].
    pub platform_frequency: Option<f64>,
}

/// A robot on its way along a path.
#[derive(Clone, Debug)]
pub struct Path<'a> {
    robot: &'a Robot,
    load: Load,
    model: Option<&'a ErrorModel>,
    lengths: InversePath<&'a Robot>,
}

/// Lengths that differ by less than this share are on one branch.
const SAME_BRANCH: f64 = 1e-9;

impl<'a> Path<'a> {
    /// A path that has yet to begin.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for an error model of another robot.
    pub fn new(robot: &'a Robot, load: Load, model: Option<&'a ErrorModel>) -> Result<Self, StudyError> {
        model.map(|model| model.check(robot)).transpose()?;
        Ok(Self { robot, load, model, lengths: InversePath::new(robot) })
    }

    /// The next pose.
    ///
    /// # Errors
    /// Those of [`InversePath::solve`] and of [`deflection_from`]. The path goes on from the last pose with
    /// an answer.
    pub fn solve(&mut self, pose: &Pose) -> Result<PathPose, StaticsError> {
        let Self { robot, load, .. } = *self;
        let found = self.lengths.solve(pose, &Load::none())?;
        let wanted = found.solution;
        let deflection = deflection_from(robot, wanted.lengths, &load, &wanted.equilibrium)?;
        let Deflection { lengths, unloaded, loaded } = &deflection;
        let problem = DirectProblem::new(robot, lengths, &load)?;
        let modes = Modes::new(&problem, &loaded.equilibrium, Wanted::OfPlatform).ok();
        let frequency = || FrequencyDerivatives::of_platform(&problem, modes.as_ref()?).ok();
        Ok(PathPose {
            jump: found.jump,
            tensions: wanted.tensions,
            exit_tensions: unloaded.equilibrium.exit_tensions(robot, lengths),
            sags: DirectProblem::new(robot, lengths, &Load::none())?.sags(&unloaded.equilibrium)?,
            swing: modes.as_ref().and_then(Swing::of),
            bands: self.model.and_then(|model| Bands::new((robot, pose, &load), model, lengths, frequency)),
            deflection,
        })
    }
}

impl Bands {
    fn new(
        (robot, pose, load): (&Robot, &Pose, &Load),
        model: &ErrorModel,
        lengths: &[f64],
        frequency: impl FnOnce() -> Option<FrequencyDerivatives>,
    ) -> Option<Self> {
        let left = derivatives(robot, pose, load).ok()?;
        let near = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME_BRANCH * b;
        if !left.deflection.lengths.iter().zip(lengths).all(near) {
            return None;
        }
        let right = left.right();
        let std = |slopes: &dyn Fn(&Derivatives) -> Option<Vec<f64>>| {
            let variance = |side| Some(model.variances(&slopes(side)?).iter().sum::<f64>());
            Some((0.5 * (variance(&left)? + variance(&right)?)).sqrt())
        };
        let row = |of: &dyn Fn(&Derivatives, usize) -> f64| {
            std(&|side| Some((0..side.lengths.ncols()).map(|column| of(side, column)).collect()))
        };
        let of_cables = |of: &dyn Fn(&Derivatives, usize, usize) -> f64| -> Option<Vec<f64>> {
            (0..lengths.len()).map(|i| row(&|side, k| of(side, i, k))).collect()
        };
        let frequency = frequency();
        let moved = |i| row(&|side: &Derivatives, k| side.loaded.pose[(i, k)] - side.unloaded.pose[(i, k)]);
        Some(Self {
            lengths: of_cables(&|side, i, k| side.lengths[(i, k)])?,
            tensions: of_cables(&|side, i, k| side.unloaded.tensions[(i, k)])?,
            displacement: [moved(0)?, moved(1)?, moved(2)?],
            magnitude: std(&|side| side.magnitude().ok()),
            least_stiffness: std(&|side| Some(side.least_stiffness(robot, load).ok()?.1)),
            platform_frequency: frequency.and_then(|of| std(&|side| Some(of.with_lengths(&side.lengths)))),
        })
    }
}
