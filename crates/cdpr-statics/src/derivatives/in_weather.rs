//! Derivatives of where a platform rests in weather, by the robot's parameters and by the weather's own
//! numbers.
//!
//! The weather changes lengths, exit points and cables as `loading/weather.rs` has it: L' = k L, b' = f b,
//! ρ', d'. An input θ therefore changes the balance at the rest in the weather by
//!
//! ```text
//! dG = ∂G/∂θ' dθ' + sum [k_L; s x k_L] (k dL_i + L_i dk) + sum [dF_i; s x dF_i]                     (D14)
//! dF_i = K3_i b_i df + k_l l_i df + k_ρ dρ'_i + k_q ½ρc dd'_i + k_h dh_i
//! ```
//!
//! with the lead l, the drag q = ½ρc d' and the height h of the exit point. dL_i is (D7), of the robot
//! without weather. In wind the coefficients of (D1) are those of (C42) of `cdpr_cable`, and K3 is not
//! symmetric. The drag is that of the square of the speed v of the wind, so that `k_v = 2 k_q q/v`.
//!
//! A wind that turns about the vertical e by dψ acts as one that keeps its direction acts on a cable that is
//! turned back. With the span x from the leave point to the anchor point, on which the force F depends by
//! -K3,
//!
//! ```text
//! dF = [e x F + K3 (e x x)] dψ                                                                      (D15)
//! ```

use crate::derivatives::{Derivatives, OneSided, derivatives};
use crate::direct::{DirectSolution, DirectStart};
use crate::equations::{CableDerivatives, CableInput, Inputs, Partials, Pins, Reading, solve, wrench};
use crate::error::StaticsError;
use crate::loading::{BlownCable, CableInWeather, DRAG_PER_DIAMETER, Deflection, RestInWeather, Weather};
use crate::problem::DirectProblem;
use crate::state::{Load, WantedPose};
use cdpr_number::Dual;
use cdpr_robot::{Axis, Matrix6xX, Parameter, Pose, Robot, Vector3, Vector6};
use nalgebra::{Matrix3xX, Matrix6};
use std::array::from_fn;

/// A number of the weather.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WeatherInput {
    /// How much warmer it is [K].
    Warmer,
    /// Thermal expansion of the cables [1/K].
    CableExpansion,
    /// Thermal expansion of the frame [1/K].
    FrameExpansion,
    /// Thickness of the ice [m].
    Ice,
    /// Strain by which the cables have crept.
    Creep,
    /// Speed of the wind in its direction [m/s].
    Wind,
    /// Direction of the wind, an angle about the vertical [rad].
    Direction,
}

/// Numbers of the weather.
const COUNT: usize = WeatherInput::ALL.len();

impl WeatherInput {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Warmer,
        Self::CableExpansion,
        Self::FrameExpansion,
        Self::Ice,
        Self::Creep,
        Self::Wind,
        Self::Direction,
    ];

    /// `warmer`, `cable_expansion`, `frame_expansion`, `ice`, `creep`, `wind` or `wind_direction`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Warmer => "warmer",
            Self::CableExpansion => "cable_expansion",
            Self::FrameExpansion => "frame_expansion",
            Self::Ice => "ice",
            Self::Creep => "creep",
            Self::Wind => "wind",
            Self::Direction => "wind_direction",
        }
    }

    /// Its SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Warmer => "K",
            Self::CableExpansion | Self::FrameExpansion => "1/K",
            Self::Ice => "m",
            Self::Creep => "",
            Self::Wind => "m/s",
            Self::Direction => "rad",
        }
    }
}

/// A rest in weather, as [`crate::weather::in_weather`] finds it, with its derivatives.
///
/// The columns of inputs in `one_sided` have the left derivatives.
#[derive(Clone, Debug)]
pub struct WeatherDerivatives {
    /// The platform without the weather.
    pub still: Deflection,
    /// The platform in the weather.
    pub rest: RestInWeather,
    /// What the columns of `displacement` stand for.
    pub inputs: Inputs,
    /// Derivatives of the displacement from the pose without load and weather to that in the weather, 3 x
    /// count [m per unit].
    pub displacement: Matrix3xX<f64>,
    /// Derivatives of that displacement by the numbers of the weather, in the order of [`WeatherInput::ALL`]
    /// [m per unit]. An error says why a derivative does not exist.
    pub per_weather: [Result<Vector3<f64>, StaticsError>; COUNT],
    /// The inputs whose left and right derivatives differ, because a cable leaves a bound on one side.
    pub one_sided: Vec<OneSided>,
}

impl WeatherDerivatives {
    /// The displacement [m].
    pub fn displaced(&self) -> Vector3<f64> {
        self.rest.pose.position - self.still.unloaded.equilibrium.pose.position
    }

    /// Derivative of the norm of the displacement by something that it has this derivative by; `None` where
    /// the displacement is zero.
    pub fn magnitude(&self, per_unit: &Vector3<f64>) -> Option<f64> {
        Some(self.displaced().try_normalize(f64::MIN_POSITIVE)?.dot(per_unit))
    }
}

/// The rest in weather with its derivatives by the robot's parameters, payload and wanted pose, and by the
/// numbers of the weather.
///
/// # Errors
/// Those of [`crate::weather::in_weather`] and [`derivatives()`]; [`StaticsError::NoDerivative`] for cables
/// over pulleys in wind.
pub fn weather_derivatives(
    robot: &Robot,
    wanted: WantedPose,
    load: &Load,
    weather: &Weather,
) -> Result<WeatherDerivatives, StaticsError> {
    let changed = weather.robot(robot)?;
    let found = derivatives(robot, wanted, load)?;
    let lengths = weather.lengths(&found.deflection.lengths);
    let problem = DirectProblem::new(&changed, &lengths, load)?;
    let calm = problem.direct(DirectStart::Pose(&found.deflection.loaded.equilibrium.pose))?;
    let rest = problem.in_wind(&weather.wind, &calm)?;
    let cables = if weather.wind.is_calm() {
        let at = &calm.equilibrium;
        let all = CableDerivatives::all(&problem, &at.pose, &at.cable_forces).into_iter();
        all.map(|cable| BlownCable { cable, per_drag: Vector3::zeros(), per_height: Vector3::zeros() })
            .collect()
    } else {
        problem.blown_cables(&weather.wind, &calm, &rest)?
    };
    let at = InWeather { robot, weather, problem: &problem, found: &found, cables };
    let (inputs, count) = (&found.inputs, found.inputs.count());
    let pose = if weather.wind.is_calm() { calm.equilibrium.pose } else { rest.pose };
    let own: Vec<_> = at.cables.iter().map(|blown| blown.cable.clone()).collect();
    let mut partials = Partials::new(&changed, inputs, &pose, load, &own, Reading::tension);
    let (hessian, _) = partials.take_pose(inputs);
    let mut balance = partials.balance;
    at.through_weather(&mut balance);
    let (of_weather, reasons) = at.by_weather(&pose);
    balance.resize_horizontally_mut(count + COUNT, 0.0);
    of_weather.iter().enumerate().for_each(|(k, wrench)| balance.set_column(count + k, wrench));
    at.solve(&calm, &hessian, &mut balance)?;
    let mut displacement: Matrix3xX<f64> = balance.fixed_rows::<3>(0).into_owned();
    let of_weather: [Vector3<f64>; COUNT] = from_fn(|k| displacement.column(count + k).into_owned());
    displacement.resize_horizontally_mut(count, 0.0);
    displacement -= found.unloaded.pose.fixed_rows::<3>(0);
    let mut per_weather = of_weather.map(Ok);
    for (k, reason) in reasons {
        per_weather[k] = Err(StaticsError::NoDerivative { quantity: "the rest in weather", reason });
    }
    let Derivatives { deflection, inputs, one_sided, .. } = found;
    Ok(WeatherDerivatives { still: deflection, rest, inputs, displacement, per_weather, one_sided })
}

/// A rest in weather.
struct InWeather<'a> {
    robot: &'a Robot,
    weather: &'a Weather,
    problem: &'a DirectProblem<'a>,
    /// The robot without the weather.
    found: &'a Derivatives,
    cables: Vec<BlownCable>,
}

impl InWeather<'_> {
    fn made(&self, i: usize) -> CableInWeather<Dual<f64, 5>> {
        self.weather.slopes(self.robot, i)
    }

    /// Derivatives by the inputs from those by what they become, with those of the lengths, (D14).
    fn through_weather(&self, balance: &mut Matrix6xX<f64>) {
        let (first, inputs) = (self.made(0), &self.found.inputs);
        let (lengthening, frame) = (first.lengthening.value, first.frame.value);
        for (column, parameter) in inputs.parameters.iter().enumerate() {
            let mut own = balance.column_mut(column);
            match parameter {
                Parameter::LinearDensity => own /= lengthening,
                Parameter::Lead(_) => own *= frame,
                Parameter::ExitPoint(i, axis) => {
                    if *axis == Axis::Z {
                        let BlownCable { cable, per_height, .. } = &self.cables[*i];
                        own += wrench(&cable.arm, per_height);
                    }
                    own *= frame;
                }
                _ => {}
            }
        }
        let per_actuation: Vec<Vector6<f64>> =
            self.cables.iter().map(|blown| blown.cable.wrench_per_actuation()).collect();
        let mut of_inputs = balance.columns_mut(0, inputs.count());
        of_inputs.gemm(lengthening, &Matrix6xX::from_columns(&per_actuation), &self.found.lengths, 1.0);
    }

    /// Wrenches by the numbers of the weather, (D14), and by which of them there is no derivative.
    fn by_weather(&self, pose: &Pose) -> ([Vector6<f64>; COUNT], Vec<(usize, &'static str)>) {
        let (mut wrenches, level) = ([Vector6::zeros(); COUNT], self.robot.gravity.level());
        let up = level.map_or_else(Vector3::z, |level| level.row(2).transpose());
        for (i, BlownCable { cable, per_drag, per_height }) in self.cables.iter().enumerate() {
            let (made, own) = (self.made(i), &self.robot.cables[i]);
            let per_frame = cable.stiffness * own.exit_point
                + cable.by(CableInput::Lead) * own.lead
                + per_height * own.exit_point.z;
            let length = self.found.deflection.lengths[i];
            for (k, wrench_of) in wrenches.iter_mut().take(5).enumerate() {
                let force = cable.per_actuation * (length * made.lengthening.slopes[k])
                    + per_frame * made.frame.slopes[k]
                    + cable.by(CableInput::Density) * made.linear_density.slopes[k]
                    + per_drag * (DRAG_PER_DIAMETER * made.diameter.slopes[k]);
                *wrench_of += wrench(&cable.arm, &force);
            }
            if !self.weather.wind.is_calm() {
                let speed = self.weather.wind.velocity().norm();
                let drag = DRAG_PER_DIAMETER * made.diameter.value;
                wrenches[5] += wrench(&cable.arm, &(per_drag * (2.0 * drag / speed)));
                let span = pose.position + cable.arm - self.problem.robot().cables[i].exit_point;
                let turned = up.cross(&cable.force) + cable.stiffness * up.cross(&span); // Eq. (D15)
                wrenches[6] += wrench(&cable.arm, &turned);
            }
        }
        let bare = self.robot.cables.iter().any(|cable| cable.properties.diameter.is_none());
        let mut reasons = Vec::new();
        if bare {
            reasons.push((3, "a cable has no diameter, on which the weight of the ice depends"));
        }
        if self.weather.wind.is_calm() {
            reasons.extend([5, 6].map(|k| (k, "there is no wind, whose direction it would need")));
        } else if self.weather.wind.profile().is_some() && level.is_some() {
            reasons.push((6, "the height with which the wind grows is not along gravity"));
        }
        (wrenches, reasons)
    }

    /// Motions of the platform from the partial derivatives of its balance.
    fn solve(
        &self,
        calm: &DirectSolution,
        hessian: &Matrix6<f64>,
        balance: &mut Matrix6xX<f64>,
    ) -> Result<(), StaticsError> {
        let symmetric = -0.5 * (hessian + hessian.transpose());
        let pins = Pins::new(self.problem, &calm.equilibrium, &symmetric);
        balance.neg_mut();
        pins.take(balance);
        solve(pins.pinned(hessian, -1.0), balance, "the rest in weather")
    }
}
