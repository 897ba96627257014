//! Tension distribution of a cable-driven parallel robot.
//!
//! A robot with more than six cables can balance a wrench with many sets of tensions. Eq. (3) of Baklouti,
//! Caro, Courteille (CableCon 2017), `W t + w = 0`, leaves the choice to a distribution algorithm. This crate
//! chooses the tensions nearest to a reference. W is the wrench matrix (6 x n) and w the sum of all wrenches
//! on the platform that do not come from the cables:
//!
//! ```text
//! minimise  |t - t_ref|²   subject to   W t + w = 0,   t_min <= t_i <= t_max                    (T1)
//! ```
//!
//! With `t_ref = 0` this is the least-norm distribution. Where no bound is active the solution has the closed
//! form
//!
//! ```text
//! t = t_ref - Wᵀ λ,      λ = (W Wᵀ)⁻¹ (w + W t_ref)                                            (T2)
//! ```
//!
//! Otherwise an active-set method adds and removes one bound at a time and solves the optimality conditions
//! of the free cables F:
//!
//! ```text
//! t_i = t_ref,i - w_i·λ   for i in F,      W t + w = 0                                          (T3)
//! ```
//!
//! where `w_i` is column i of W. If that method does not end at the optimum, Clarabel (Goulart and Chen,
//! arXiv:2405.12762) says which bounds are active, or that the problem has no solution. An infeasible problem
//! is answered by the least residual wrench that tensions within the bounds leave.
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

mod box_problem;
mod distribution;
mod least_squares;
mod linear_program;
mod problem;
mod quadratic_program;

pub use box_problem::{BoxProblem, BoxSolution, BoxUnknown};
pub use distribution::{Distribution, DistributionMethod, closed_form, distribute, offset};
pub use least_squares::bounded_least_squares;
pub use linear_program::{LinearProgram, LinearSolution};
pub use problem::{Bound, Problem, TensionError};
