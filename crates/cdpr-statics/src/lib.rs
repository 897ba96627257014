//! Elasto-statics of cable-driven parallel robots with sagging, elastic cables.
//!
//! | question | function |
//! |---|---|
//! | which unstrained lengths hold a pose, or each of many (IEGM)? | [`inverse`] |
//! | and those of a path, without jumps where there need be none? | [`InversePath`] |
//! | with fewer cables than free motions (n < m), with other tensions? | a [`WantedPose`] for a pose |
//! | where else does it rest with free coordinates? | [`free_solutions`] |
//! | what can be carried there, how far are the limits of tension? | [`greatest_payload`], [`tension_margin`] |
//! | where does the platform stand for given lengths and load (DEGM)? | [`direct`] |
//! | and for the next lengths and load, in a microsecond or two? | [`Tracker`] |
//! | is it stable, and how far is it from becoming unstable? | [`DirectSolution::stability`] |
//! | how exact is that, with a proof? | [`DirectProblem::certify`] |
//! | where else could it stand? | [`DirectProblem::direct_all`], [`DirectProblem::direct_any`] |
//! | where does it go while lengths or loads change, and where does it jump? | [`follow`] |
//! | how far does a load displace it, Eq. (4)? | [`deflection`] |
//! | where does it end after a load cycle, on cables that dissipate energy? | [`load_cycle`] |
//! | and with a million other values of the parameters? | [`Observer`] |
//! | which parameter changes lengths, tensions, poses and deflection, and by how much? | [`derivatives`] |
//! | how stiff is it, how do lengths and loads move it? | [`stiffness_at`], [`DirectProblem::linearize`] |
//!
//! The equations are Eq. (1) to (4) of Baklouti, Caro, Courteille, *Sensitivity Analysis of the
//! Elasto-Geometrical Model of Cable-Driven Parallel Robots* (CableCon 2017), with Irvine's catenary of crate
//! `cdpr-cable` as Eq. (2a), (2b). An equilibrium is a pose and the two components of every cable's end
//! force: `6 + 2n` unknowns for as many equations. Every answer carries the residuals of all of them.
//!
//! ```
//! use cdpr_robot::{Pose, Robot};
//! use cdpr_statics::{DirectProblem, Load, deflection};
//!
//! let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json"))?;
//! let pose = Pose::at(0.0, 0.0, 1.75);
//! let deflection = deflection(&robot, &pose, &Load::payload(50.0))?;
//! assert!((1e3 * deflection.rms() - 1.33125).abs() < 1e-4); // [mm]
//! assert!(deflection.loaded.report.residual.force < 1e-8); // [N]
//!
//! // Does it stay there, and how exactly is that known?
//! let loaded = &deflection.loaded;
//! let proof = DirectProblem::new(&robot, &deflection.lengths, &Load::payload(50.0))?.certify(loaded)?;
//! assert!(loaded.stability.is_stable() && proof.is_stable());
//! let softest = loaded.stability.least_stiffness();
//! println!("exact to {:.0e} m, softest motion {softest:.0} N/m", proof.position);
//! # Ok::<(), cdpr_statics::StaticsError>(())
//! ```

mod certificate;
mod derivatives;
mod direct;
mod equations;
mod error;
mod inverse;
mod lanes;
mod loading;
mod out_of_limits;
mod problem;
mod rest_fault;
mod state;

pub use certificate::Certificate;
pub use derivatives::{
    AtBound, Derivatives, EquilibriumDerivatives, ForceDerivatives, OneSided, VarianceBudget, derivatives,
};
pub use direct::{
    DirectMethod, DirectSolution, Equilibria, Found, Loss, LossKind, Mode, Path, PathStep, Report, Setting,
    Stability, Start, Starts, direct, follow_load, rough_pose,
};
pub use equations::{CableShape, Inputs, Linearization};
pub use error::{Blocked, BranchEnd, StaticsError};
pub use inverse::{
    Blocking, FreeSolution, FreeSolutions, Greatest, HeldPose, InversePath, InverseSolution, LONGEST,
    PathSolution, free_solutions, greatest_payload, is_held, lengths_for_tensions, limits_at, rest_near,
    tension_margin,
};
pub use lanes::{
    Loaded, LoadedPose, Observation, ObservationMotion, ObservationSlopes, Observed, Observer, PoseSlopes,
    ScalarReason, Tracker, inverse, loaded_poses,
};
pub use loading::{
    CableFrequency, CycleStep, Deflection, HysteresisLaw, LoadCycle, NaturalMode, PoseModes, PoseStiffness,
    Unloading, deflection, deflection_from, follow, load_cycle, modes_at, stiffness_at, wound_lengths,
};
pub use out_of_limits::{Limit, OutOfLimits, out_of_limits, tensions_out_of_limits};
pub use problem::{DirectProblem, check_lengths};
pub use rest_fault::RestFault;
pub use state::{Equilibrium, Load, Residual, Wanted, WantedPose};

pub use cdpr_cable::MAX_STRAIN;
pub use cdpr_robot::{Matrix6xX, Vector2, Vector3, Vector6};
pub use cdpr_tension::Bound;
pub use nalgebra::{DMatrix, Matrix3xX, Matrix6};
