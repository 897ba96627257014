//! Tension distribution of a cable-driven parallel robot.
//!
//! For the wrench matrix `W` (6 x n) and the sum `w` of all wrenches on the platform that do not come from the cables:
//!
//! ```text
//! minimise  |t - t_ref|²   subject to   W t + w = 0,   t_min <= t_i <= t_max                     (1)
//! ```
//!
//! (Eq. (3) of Baklouti, Caro, Courteille 2017, which leaves the choice among the solutions to a distribution algorithm.)
//! With `t_ref = 0` this is the least-norm distribution. Where no bound is active the solution has the closed form
//!
//! ```text
//! t = t_ref - Wᵀ (W Wᵀ)⁻¹ (w + W t_ref)                                                          (2)
//! ```
//!
//! Otherwise bounds are taken in and let go one by one, each time with the linear system of the optimality conditions; where that does
//! not end at the optimum, Clarabel (Goulart and Chen, arXiv:2405.12762) says which bounds are active, or that the problem has no
//! solution, which is answered by the least residual wrench that tensions within the bounds leave.
//!
//! ```
//! use cdpr_robot::{Pose, Robot};
//! use cdpr_tension::{Problem, distribute};
//!
//! let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json"))?;
//! let pose = Pose::at(0.0, 0.0, 1.75);
//! let pulls: Vec<_> = (0..8).map(|i| -robot.span(&pose, i).normalize()).collect(); // straight cables
//! let solution = distribute(&Problem {
//!     wrench_matrix: &robot.wrench_matrix(&pose, &pulls),
//!     wrench: robot.weight(&pose, 0.0).to_vector(),
//!     reference: &[0.0; 8],
//!     limits: &[robot.tension_limits; 8],
//! })?;
//! assert!(solution.tensions.iter().all(|t| (500.0..700.0).contains(t)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod distribution;
mod quadratic_program;

pub use distribution::{Bound, Distribution, Method, Problem, TensionError, closed_form, distribute, offset};
