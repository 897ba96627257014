//! Elasto-statics of cable-driven parallel robots with sagging, elastic cables.
//!
//! Functions take the robot, the pose that is wanted, and the load, in this order. A pose is a
//! [`cdpr_robot::Pose`], or a [`WantedPose`] where coordinates are free, tensions preferred or set-points
//! offset; [`inverse`], [`deflection`] and [`derivatives()`] take a slice of poses, too.
//!
//! | question | function |
//! |---|---|
//! | which unstrained lengths hold a pose, or each of many (IEGM)? | [`inverse`] |
//! | and those of a path, without jumps where there need be none? | [`InversePath`] |
//! | where else does it rest with fewer cables than free motions (n < m)? | [`free_coordinates`] |
//! | what can be carried there, how far are the limits of tension? | [`capacity`] |
//! | which tensions are out of their limits? | [`limits`] |
//! | where does the platform stand for given lengths and load (DEGM)? | [`direct`] |
//! | and for the next lengths and load, in a microsecond or two? | [`Tracker`] |
//! | is it stable, and how far is it from becoming unstable? | [`DirectSolution::stability`] |
//! | how exact is that, with a proof? | [`DirectProblem::certify`] |
//! | where else could it rest? | [`multistart`], [`DirectProblem::with_unstable`] |
//! | where does it go while lengths or loads change, and where does it jump? | [`continuation`] |
//! | how far does a load displace it, Eq. (4)? | [`deflection`] |
//! | where does it end after a load cycle, with hysteresis or friction at pulleys? | [`hysteresis`] |
//! | and with a million other values of the parameters, at a million poses? | [`Observer`], [`batch`] |
//! | which parameter changes lengths, tensions, poses and deflection, and by how much? | [`derivatives()`] |
//! | and in weather, with wind on its cables? | [`weather`], [`DirectProblem::in_wind`] |
//! | how stiff is it, how do lengths and loads move it? | [`stiffness`] |
//! | how does it vibrate? | [`vibration`] |
//!
//! The equations are Eq. (1) to (4) of Baklouti, Caro, Courteille, *Sensitivity Analysis of the
//! Elasto-Geometrical Model of Cable-Driven Parallel Robots* (CableCon 2017), with Irvine's catenary of crate
//! `cdpr-cable` as Eq. (2a), (2b). An equilibrium is a pose and the two components of every cable's end
//! force: `6 + 2n` unknowns for as many equations. Every solution carries the residuals of all of them.
//!
//! ```
//! use cdpr_robot::{Pose, Robot};
//! use cdpr_statics::{DirectProblem, Load, deflection};
//!
//! let robot = Robot::from_library("caroca")?;
//! let pose = Pose::at(0.0, 0.0, 1.75);
//! let deflection = deflection(&robot, &pose, &Load::payload(50.0))?;
//! assert!((1e3 * deflection.magnitude() - 1.33125).abs() < 1e-4); // [mm]
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

mod blocked;
mod certificate;
mod dense;
pub mod derivatives;
mod direct;
mod equations;
pub mod error;
mod inverse;
mod lanes;
mod loading;
mod local;
mod out_of_limits;
mod problem;
mod rest_fault;
mod state;

pub use certificate::Certificate;
pub use derivatives::{Derivatives, derivatives};
pub use direct::{DirectMethod, DirectReport, DirectSolution, DirectStart, Stability, direct, rough_pose};
pub use error::StaticsError;
pub use inverse::{
    InversePath, InverseSolution, PathSolution, PoseLengths, is_feasible, lengths_for_tensions,
};
pub use lanes::{Observer, Tracker, TrackerStep, inverse};
pub use loading::{Deflection, deflection, deflection_from, set_point_lengths};
pub use problem::{DirectProblem, Unstable, check_lengths};
pub use state::{Equilibrium, Load, Residual, Wanted, WantedPose};

pub use cdpr_cable::MAX_STRAIN;
pub use cdpr_robot::{Matrix6xX, Vector2, Vector3, Vector6};
pub use cdpr_tension::Bound;
pub use nalgebra::{DMatrix, Matrix3xX, Matrix6};

/// Many robots and many poses at a time, in the lanes of the vector unit: what [`Observer`] observes, and
/// poses under a load.
pub mod batch {
    pub use crate::lanes::{
        Loaded, LoadedPose, Observation, ObservationMotion, ObservationSlopes, Observed, PoseSlopes,
        ScalarReason, loaded_poses,
    };
}

/// What can be carried at a pose, and how far the limits of tension are.
pub mod capacity {
    pub use crate::inverse::{Blocking, Greatest, greatest_payload, tension_margin};
}

/// Equilibria that are followed while lengths or loads change, up to where they are lost.
pub mod continuation {
    pub use crate::direct::{Loss, LossKind, Path, PathStep, Setting, follow_load};
    pub use crate::loading::follow;
}

/// Where a platform rests that has fewer cables than free motions.
pub mod free_coordinates {
    pub use crate::inverse::{FreeSolution, FreeSolutions, LONGEST, free_solutions, rest_near};
}

/// Load cycles on cables that dissipate energy, over pulleys with friction.
pub mod hysteresis {
    pub use crate::loading::{
        CycleStep, HysteresisLaw, LoadCycle, LoadHistory, Unloading, load_cycle, load_cycle_over_pulleys,
    };
    pub use crate::loading::{
        Estimate, FrictionFit, PulleyFriction, PulleyState, WinchReading, fit_friction, fit_friction_model,
    };
}

/// Limits of the tensions at a pose, and the tensions that pass them.
pub mod limits {
    pub use crate::inverse::limits_at;
    pub use crate::out_of_limits::{
        Limit, OutOfLimits, allowed, cables_in_words, in_words, out_of_limits, tensions_out_of_limits,
    };
}

/// Equilibria from many starts.
pub mod multistart {
    pub use crate::direct::{Equilibria, Found, Starts};
}

/// How lengths and loads move the platform, and along which motion it is softest.
pub mod stiffness {
    pub use crate::direct::Mode;
    pub use crate::equations::{CableShape, Linearization};
    pub use crate::loading::{PoseStiffness, stiffness_at};
}

/// Rest in weather: wind on the cables, ice, creep, another temperature.
pub mod weather {
    pub use crate::derivatives::{WeatherDerivatives, WeatherInput, weather_derivatives};
    pub use crate::loading::{RestInWeather, Weather, Wind, WindProfile, in_weather, rest_in_weather};
}

/// Natural motions of the platform and of the cables.
pub mod vibration {
    pub use crate::loading::{CableAtRest, CableFrequency, NaturalMode, PoseModes, SmallMotions, modes_at};
}
