//! Friction where cables run over pulleys.
//!
//! A cable leaves its wheel with the tension T0 after the wrap θ, and enters it at D with the tension T_w of
//! its winch. With the slip s, from -1 to 1, the coefficient μ of cable on wheel and the friction radius c
//! of the bearing over that of the wheel,
//!
//! ```text
//! T(φ) = T0 exp(s μ φ),    T_w = T(θ) + s c |T0 τ - T_w k|                                         (F1)
//! ```
//!
//! with φ from the leave point back to D, τ the direction of the cable there and k that at D, so that
//! -τ·k is -cos θ. The first part is that of a capstan (L. Euler, *Remarques sur l'effet du frottement
//! dans l'équilibre*, Mém. Acad. Berlin 18, 1769; J. A. Eytelwein, *Handbuch der Statik fester Körper*,
//! 1808), the second one that of a bearing with the resultant of both tensions on it (W. Kraus, M. Kessler,
//! A. Pott, *Pulley friction compensation for winch-integrated cable force measurement and verification on a
//! cable-driven parallel robot*, ICRA 2015). It acts at D. With E = exp(s μ θ) and κ = s² c², the root
//! of (F1) on the side of s is
//!
//! ```text
//! T_w/T0 = [E - κ cos θ + s c √(1 + E² - 2 E cos θ - κ sin² θ)]/(1 - κ)                       (F2)
//! ```
//!
//! A wheel slips with s = 1 while cable runs towards the winch and with s = -1 while it runs towards the
//! platform. Between these it sticks: no cable passes D, so that the lead keeps its strain, and T_w stays as
//! it is (L. Prandtl, *Ein Gedankenmodell zur kinetischen Theorie der festen Körper*, ZAMM 8, 1928):
//!
//! ```text
//! T_w = min(max(T_w before, T_w(s = -1)), T_w(s = 1))                                               (F3)
//! ```
//!
//! Lead d and arc contain the unstrained length `r ∫ dφ/(1 + ε(T(φ))) + d/(1 + ε(T_w))`. Without
//! friction it is that of (C20), so that the part beyond the leave point is longer by
//!
//! ```text
//! Δ = r ∫ δ(T(φ)) dφ + d δ(T_w),    δ(T) = (ε(T) - ε(T0))/[(1 + ε(T0)) (1 + ε(T))]          (F4)
//! ```
//!
//! An equilibrium with friction is one without, of the unstrained lengths L + Δ.

mod fit;
mod history;
mod model_fit;
mod wheel;

pub use fit::{Estimate, FrictionFit, WinchReading, fit_friction};
pub(crate) use history::Wheels;
pub use model_fit::fit_friction_model;
pub use wheel::{PulleyFriction, PulleyState};
