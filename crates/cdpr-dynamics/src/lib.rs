//! Natural motions and motions over time of cable-driven parallel robots whose sagging, elastic cables have
//! mass.
//!
//! A platform on cables without mass has six natural frequencies. Cables with mass vibrate themselves, and
//! where they do so about as fast as the platform, the two move together: CoGiRo has 76 natural motions below
//! 20 Hz, and none of them is the platform's alone. [`Mode::platform_share`] tells them apart.
//!
//! ```
//! use cdpr_dynamics::{Wanted, modes_at};
//! use cdpr_robot::{Pose, Robot};
//! use cdpr_statics::Load;
//!
//! let robot = Robot::from_library("cogiro")?;
//! let found = modes_at(&robot, &Pose::at(0.0, 0.0, 2.0), &Load::none(), Wanted::Below(6.0))?;
//! assert_eq!(found.modes.len(), found.counted);
//! let platform = found.of_platform().map(|mode| mode.frequency);
//! println!("{} motions below 6 Hz, most of the platform moves at {platform:?} Hz", found.counted);
//! # Ok::<(), cdpr_dynamics::DynamicsError>(())
//! ```
//!
//! The cables are those of `cdpr-cable`: sag, elasticity, laws, leads and pulleys. Cable on a pulley and
//! behind it has no mass here. In natural motions nothing is damped, and winches hold or have a [`Rotor`];
//! [`FrequencyResponse`] has damping and winches that move, [`LargestInBand`] its largest amplitudes,
//! [`FrequencyDerivatives`] how the frequencies change. [`simulate`] follows large motions over time.

mod cable;
mod condensed;
mod dense;
mod derivatives;
mod element;
mod energy;
mod error;
mod free;
mod modes;
mod motion;
pub mod moves;
mod platform;
mod polynomial;
mod response;
pub mod simulate;

pub use derivatives::FrequencyDerivatives;
pub use derivatives::amplitude::{AmplitudeAt, AmplitudeDerivatives};
pub use error::DynamicsError;
pub use free::Rotor;
pub use modes::swing::Swing;
pub use modes::{Mode, Modes, Wanted, modes_at};
pub use platform::MovingPlatform;
pub use response::band::{LargestInBand, Peak, worst_amplitude};
pub use response::point::{PointMotion, ShakenPoint};
pub use response::{Damping, FrequencyResponse, Response};
