//! What the page of a robot asks, and what the models answer: as JSON, in a WebAssembly module or natively.
//!
//! [`Live`] holds a robot. [`Live::ask`] takes a question, which is one of [`Question`], and returns either
//! `{"ok": ..}` with the answer or `{"error": {"kind": .., "reason": ..}}`. All numbers are in SI units; a
//! pose is `[x, y, z, qw, qx, qy, qz]`, and angles are in radians. The same question has the same answer in
//! the browser and in a native program, except that `libm` rounds a few functions differently there.
//!
//! ```
//! let robot = cdpr_robot::Robot::from_library("caroca")?;
//! let mut live = cdpr_web::Live::new(&robot.to_json())?;
//! let answer = live.ask(r#"{"hold": {"pose": [0, 0, 1.75, 1, 0, 0, 0], "load": {"payload": 50}}}"#);
//! let answer: serde_json::Value = serde_json::from_str(&answer)?;
//! let rms = answer["ok"]["rms"].as_f64().ok_or("no deflection")?;
//! assert!((1e3 * rms - 1.33124).abs() < 1e-4); // [mm]
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod answers;
#[cfg(target_arch = "wasm32")]
mod bindings;
mod live;
#[cfg(not(target_arch = "wasm32"))]
pub mod page;
mod question;

pub use live::Live;
pub use question::{
    Follow, Hold, LoadGiven, Motions, ObserveReplicate, PoseGiven, Question, Slice, SliceAxis, Stand,
};
