//! Tension distribution of a cable-driven parallel robot.
//!
//! A robot with more cables than degrees of freedom can balance a wrench with many sets of tensions. Eq. (3)
//! of Baklouti, Caro, Courteille (CableCon 2017) and the limits of the tensions leave the choice to an
//! [`Objective`]:
//!
//! ```text
//! W t + w = 0,      t_min <= t_i <= t_max                                                       (T1)
//! ```
//!
//! W is the wrench matrix, in which the directions of the cables are given, and w the sum of all wrenches on
//! the platform that do not come from the cables. Of sagging cables, whose directions depend on their
//! tensions, (T1) is a linearization: `cdpr_statics` starts there.
//!
//! Where no bound is active the tensions nearest to a reference have the closed form
//!
//! ```text
//! t = t_ref - Wᵀ λ,      λ = (W Wᵀ)⁻¹ (w + W t_ref)                                            (T2)
//! ```
//!
//! Everything else is a quadratic or linear program that Clarabel solves. Of the tensions nearest to a
//! reference it finds the active bounds, and the optimality conditions of the cables F between theirs give
//! the digits:
//!
//! ```text
//! t_i = t_ref,i - w_i·λ   for i in F,      W t + w = 0                                          (T3)
//! ```
//!
//! where `w_i` is column i of W. That a problem has no solution is proved by a wrench y,
//!
//! ```text
//! y·w + sum min(y·w_i t_min, y·w_i t_max) > 0                                                   (T8)
//! ```
//!
//! which Clarabel finds and [`distribute`] checks with a margin above rounding.
//!
//! ```
//! use cdpr_robot::{Pose, Robot};
//! use cdpr_tension::{Objective, Problem, distribute};
//! use nalgebra::{DMatrix, DVector};
//!
//! let robot = Robot::from_library("caroca")?;
//! let pose = Pose::at(0.0, 0.0, 1.75);
//! let pulls: Vec<_> = (0..8).map(|i| -robot.span(&pose, i).normalize()).collect(); // straight cables
//! let matrix = robot.wrench_matrix(&pose, &pulls);
//! let problem = Problem {
//!     wrench_matrix: &DMatrix::from_column_slice(6, 8, matrix.as_slice()),
//!     wrench: &DVector::from_column_slice(robot.weight(&pose, 0.0).to_vector().as_slice()),
//!     limits: &[robot.tension_limits; 8],
//! };
//! let nearest = distribute(&problem, Objective::Nearest(&[0.0; 8]))?;
//! assert!(nearest.tensions.iter().all(|t| (500.0..700.0).contains(t)));
//! let even = distribute(&problem, Objective::LeastGreatest)?;
//! assert!(even.value < nearest.tensions.iter().copied().fold(0.0, f64::max));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`BoxProblem`] and [`LinearProgram`] are the programs of single steps towards an equilibrium with sagging
//! cables. They are solved many times for one pose, in a tenth of Clarabel's
//! time. [`box_problem`] solves the first for many robots at a time, too, in the lanes of the vector unit.
//! [`QuadraticProgram`] is that of a step of any optimization with constraints.

pub mod box_problem;
mod distribution;
mod linear_program;
mod problem;
mod program;
mod quadratic_program;

pub use box_problem::{BoxProblem, BoxSolution, BoxUnknown};
pub use distribution::{Distribution, DistributionMethod, distribute, offset};
pub use linear_program::{LinearProgram, LinearSolution};
pub use problem::{Bound, Objective, Problem, TensionError};
pub use quadratic_program::{QuadraticProgram, QuadraticSolution};
