//! Every derivative against central differences of the models themselves.

use crate::common::{caroca, cogiro};
use crate::derivatives_by_gravity::random_case;
use crate::pulleys::{led, tilted};
use cdpr_robot::{Parameter, Pose, Robot, RobotCable, Rotation3, Vector3, Vector6, Wrench};
use cdpr_statics::derivatives::EquilibriumDerivatives;
use cdpr_statics::limits::limits_at;
use cdpr_statics::{
    Deflection, Derivatives, Load, PoseLengths, StaticsError, WantedPose, deflection_from, derivatives,
    inverse, lengths_for_tensions,
};
use nalgebra::DVector;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

pub(crate) const STUDY_POSES: [[f64; 3]; 2] = [[0.0, 0.0, 1.75], [3.2, 1.7, 3.0]];

/// A robot at a pose with a load, and what is to be differentiated there.
#[derive(Clone)]
pub(crate) struct Case {
    pub(crate) robot: Robot,
    pub(crate) pose: Pose,
    pub(crate) offsets: Vec<f64>,
    pub(crate) load: Load,
}

/// The outputs, in groups of one unit each: name, values, and the size by which errors are judged.
pub(crate) type Outputs = Vec<(&'static str, Vec<f64>)>;

/// What decides which formula holds for a cable. Differences must not cross it.
#[derive(PartialEq)]
pub(crate) struct Regime {
    /// The bound that the inverse model's tension rests on.
    active: Option<cdpr_tension::Bound>,
    /// Whether that bound is what the cable's weight demands.
    demanded: bool,
    /// Whether the set-point is kept at the robot's least tension.
    clamped: bool,
    /// Whether the set-point is kept at the greatest tension.
    lowered: bool,
    /// Whether the cable's weight demands more than the set-point.
    raised: bool,
}

impl Case {
    /// The case with one input moved.
    pub(crate) fn moved(&self, column: usize, step: f64) -> Self {
        let mut case = self.clone();
        let parameters = Parameter::of(&self.robot).len();
        if column < parameters {
            let mut deviations = vec![0.0; parameters];
            deviations[column] = step;
            let perturbed = self.robot.perturbed(&deviations).unwrap();
            case.robot = perturbed.robot;
            case.offsets.iter_mut().zip(perturbed.tension_offsets).for_each(|(offset, more)| *offset += more);
        } else if column == parameters {
            case.load.payload += step;
        } else {
            let mut motion = Vector6::zeros();
            motion[column - parameters - 1] = step;
            case.pose = self.pose.moved(motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
        }
        case
    }

    /// A step of an input that changes lengths and tensions little, but far above rounding.
    pub(crate) fn step(&self, column: usize) -> f64 {
        let parameters = Parameter::of(&self.robot);
        let length = 1e-3 * self.robot.platform_size();
        match parameters.get(column) {
            Some(parameter @ (Parameter::Mass | Parameter::LinearDensity | Parameter::YoungsModulus)) => {
                3e-3 * parameter.nominal(&self.robot)
            }
            Some(Parameter::TensionOffset(_)) => 1e-3 * self.robot.platform.mass,
            Some(_) => length,
            None if column == parameters.len() => 3e-3 * self.robot.platform.mass,
            None if column <= parameters.len() + 3 => length,
            None => 1e-4,
        }
    }

    /// As the library computes it, from an equilibrium nearby.
    pub(crate) fn outputs(&self, about: &Deflection) -> Result<(Outputs, Vec<Regime>), StaticsError> {
        let wanted = inverse(&self.robot, &self.pose, &Load::none())?;
        let limits = limits_at(&self.robot, &self.pose)?;
        let set_points = cdpr_tension::offset(&wanted.tensions, &self.offsets, &limits);
        let PoseLengths { lengths, equilibrium: held } =
            lengths_for_tensions(&self.robot, &self.pose, &set_points)?;
        let found = deflection_from(&self.robot, lengths, &self.load, &held)?;
        let regime = (0..set_points.len())
            .map(|i| {
                let (active, raised) = (wanted.active[i], held.tensions()[i] > (1.0 + 1e-9) * set_points[i]);
                Regime {
                    active,
                    demanded: active == Some(cdpr_tension::Bound::Min) && wanted.tensions[i] > limits[i].min,
                    clamped: !raised && wanted.tensions[i] + self.offsets[i] <= limits[i].min,
                    lowered: wanted.tensions[i] + self.offsets[i] >= limits[i].max,
                    raised,
                }
            })
            .collect();
        let turned = |found: &Deflection, loaded: bool| {
            let [from, to] = [about, found]
                .map(|d| if loaded { d.loaded.equilibrium.pose } else { d.unloaded.equilibrium.pose });
            from.motion_to(&to)
        };
        let position = |motion: Vector6<f64>| motion.as_slice()[..3].to_vec();
        let rotation = |motion: Vector6<f64>| motion.as_slice()[3..].to_vec();
        let outputs = vec![
            ("set-points", held.tensions()),
            ("lengths", found.lengths.clone()),
            ("unloaded position", position(turned(&found, false))),
            ("unloaded rotation", rotation(turned(&found, false))),
            ("unloaded tensions", found.unloaded.equilibrium.tensions()),
            ("loaded position", position(turned(&found, true))),
            ("loaded rotation", rotation(turned(&found, true))),
            ("loaded tensions", found.loaded.equilibrium.tensions()),
            ("deflection", found.displacement().as_slice().to_vec()),
            ("norm of the deflection", vec![found.magnitude()]),
        ];
        Ok((outputs, regime))
    }
}

/// A column of all derivatives, in the order of [`Case::outputs`].
pub(crate) fn column(exact: &Derivatives, column: usize) -> Vec<DVector<f64>> {
    let magnitude = exact.magnitude().unwrap();
    let pose =
        |at: &EquilibriumDerivatives, first: usize| DVector::from_fn(3, |i, _| at.pose[(first + i, column)]);
    vec![
        exact.set_points.column(column).into_owned(),
        exact.lengths.column(column).into_owned(),
        pose(&exact.unloaded, 0),
        pose(&exact.unloaded, 3),
        exact.unloaded.tensions.column(column).into_owned(),
        pose(&exact.loaded, 0),
        pose(&exact.loaded, 3),
        exact.loaded.tensions.column(column).into_owned(),
        DVector::from_column_slice(exact.displacement().column(column).as_slice()),
        DVector::from_element(1, magnitude[column]),
    ]
}

/// What the comparison of one case gives.
#[derive(Default)]
pub(crate) struct Found {
    /// Largest error of each output relative to the largest derivative of its kind in the column.
    worst: BTreeMap<&'static str, (f64, String)>,
    pub(crate) columns: usize,
    /// Outputs whose difference is exact to 1e-6 of itself or better.
    compared: usize,
    /// Columns whose differences cross a bound.
    pub(crate) crossed: usize,
    pub(crate) active: usize,
    demanded: usize,
    clamped: usize,
    pub(crate) lowered: usize,
    raised: usize,
}

/// A derivative by central differences with three steps, twice extrapolated, and what these leave open.
fn extrapolated(values: &[DVector<f64>; 6], h: f64, rounding: f64) -> (DVector<f64>, f64) {
    let slope = |pair: usize, h: f64| (&values[2 * pair] - &values[2 * pair + 1]) / (2.0 * h);
    let (wide, middle, narrow) = (slope(0, h), slope(1, 0.5 * h), slope(2, 0.25 * h));
    let (once, again) = ((&middle * 4.0 - &wide) / 3.0, (&narrow * 4.0 - &middle) / 3.0);
    let best = (&again * 16.0 - &once) / 15.0;
    // What the second extrapolation is to remove is fifteen times what it corrects; the narrowest difference
    // amplifies rounding by 4/h times 1.4.
    let open = (&again - &once).amax() + 6.0 * rounding / h;
    (best, open)
}

/// Checks all columns of a case.
pub(crate) fn check(case: &Case) -> Result<Found, StaticsError> {
    let exact =
        derivatives(&case.robot, WantedPose::at(&case.pose).tension_offsets(&case.offsets), &case.load)?;
    let about = &exact.deflection;
    let (values_of, regime) = case.outputs(about)?;
    let mut found = Found {
        active: regime.iter().filter(|cable| cable.active.is_some()).count(),
        demanded: regime.iter().filter(|cable| cable.demanded).count(),
        clamped: regime.iter().filter(|cable| cable.clamped).count(),
        lowered: regime.iter().filter(|cable| cable.lowered).count(),
        raised: regime.iter().filter(|cable| cable.raised).count(),
        ..Found::default()
    };
    // Tensions are known to the rounding of lengths times the stiffness of a cable.
    let size = about.lengths.iter().fold(0.0, |size: f64, length| size.max(*length));
    let stiffness = case.robot.cable(0).axial_stiffness / about.lengths.iter().fold(size, |a, b| a.min(*b));
    let tension: f64 = about.loaded.equilibrium.tensions().iter().sum();
    // Poses to that of lengths, and to that of forces over the stiffness of the softest motion.
    let least = [&about.unloaded, &about.loaded].map(|at| at.stability.least_stiffness());
    let soft = 1e-14 * tension / least[0].min(least[1]);
    let rounding = |name: &str| match name {
        "set-points" => 1e-14 * tension,
        "unloaded tensions" | "loaded tensions" => 1e-14 * tension + stiffness * (3e-15 * size + soft),
        "lengths" => 3e-14 * size,
        _ => 3e-14 * size + soft,
    };
    for input in 0..exact.inputs.count() {
        found.columns += 1;
        let expected = column(&exact, input);
        let mut best: Vec<Option<(DVector<f64>, f64)>> = vec![None; expected.len()];
        for scale in [10.0, 1.0, 0.1, 1e-3] {
            let h = scale * case.step(input);
            let at = |h: f64| match case.moved(input, h).outputs(about) {
                Ok((outputs, same)) if same == regime => Some(outputs),
                _ => None,
            };
            let steps = [h, -h, 0.5 * h, -0.5 * h, 0.25 * h, -0.25 * h];
            let Some(all) = steps.into_iter().map(at).collect::<Option<Vec<_>>>() else { continue };
            for (output, best) in best.iter_mut().enumerate() {
                let values = std::array::from_fn(|step| DVector::from_column_slice(&all[step][output].1));
                let (slope, open) = extrapolated(&values, h, rounding(values_of[output].0));
                if best.as_ref().is_none_or(|(_, least)| open < *least) {
                    *best = Some((slope, open));
                }
            }
            let exact_enough = |(slope, open): &(DVector<f64>, f64)| *open < 1e-9 * slope.amax();
            if best.iter().all(|best| best.as_ref().is_some_and(exact_enough)) {
                break;
            }
        }
        found.crossed += usize::from(best[0].is_none());
        for ((best, exact), (name, _)) in best.into_iter().zip(expected).zip(&values_of) {
            let Some((best, open)) = best else { continue };
            let (error, scale) = ((&best - &exact).amax(), exact.amax());
            assert!(
                error <= open + 1e-10 * scale,
                "{}: {name}, input {input}: error {error:e} of {scale:e}, open {open:e}",
                case.robot.name
            );
            // Where differences tell a derivative at all.
            if open < 1e-6 * scale {
                found.compared += 1;
                let worst = found.worst.entry(name).or_default();
                if error / scale >= worst.0 {
                    *worst = (error / scale, format!("{}, input {input}", case.robot.name));
                }
            }
        }
    }
    Ok(found)
}

pub(crate) fn report(title: &str, all: &[Found]) {
    let sum = |count: fn(&Found) -> usize| all.iter().map(count).sum::<usize>();
    println!(
        "{title}: {} cases, {} columns ({} cross a bound), {} derivatives compared; {} active bounds \
         ({} of the cable's weight), {} clamped, {} lowered and {} raised set-points",
        all.len(),
        sum(|f| f.columns),
        sum(|f| f.crossed),
        sum(|f| f.compared),
        sum(|f| f.active),
        sum(|f| f.demanded),
        sum(|f| f.clamped),
        sum(|f| f.lowered),
        sum(|f| f.raised)
    );
    let names: BTreeSet<_> = all.iter().flat_map(|f| f.worst.keys()).collect();
    for name in names {
        let mut errors: Vec<_> = all.iter().filter_map(|f| f.worst.get(name)).collect();
        errors.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (worst, median) = (errors[errors.len() - 1], errors[errors.len() / 2].0);
        println!("  {name}: worst {:.1e} ({}), median over cases {median:.1e}", worst.0, worst.1);
    }
}

#[test]
fn derivatives_of_caroca_are_those_of_differences() {
    for position in STUDY_POSES {
        for offset in [0.0, 12.0, -8.0, 2000.0] {
            let offsets = (0..8).map(|i| if i % 3 == 0 { -offset } else { offset }).collect();
            let pose = Pose { position: position.into(), rotation: Rotation3::identity() };
            let case = Case { robot: caroca(), pose, offsets, load: Load::payload(50.0) };
            let found = check(&case).unwrap();
            report(&format!("CAROCA at {position:?}, offsets of {offset} N"), &[found]);
        }
    }
}

#[test]
fn derivatives_over_pulleys_are_those_of_differences() {
    for (robot, position) in
        [(caroca(), [0.0, 0.0, 1.75]), (caroca(), [3.2, 1.7, 3.0]), (cogiro(), [1.0, -2.0, 2.0])]
    {
        for load in [
            Load::payload(50.0),
            Load {
                payload: 20.0,
                wrench: Wrench { force: Vector3::new(40.0, -30.0, 10.0), moment: Vector3::zeros() },
            },
        ] {
            let pose = Pose { position: position.into(), rotation: Rotation3::identity() };
            let case = Case { robot: led(robot.clone(), 0.1, 3.0), pose, offsets: vec![0.0; 8], load };
            let found = check(&case).unwrap();
            report(
                &format!("{} over pulleys of 100 mm with leads of 3 m at {position:?}", robot.name),
                &[found],
            );
        }
    }
}

#[test]
fn derivatives_over_tilted_axes_on_a_base_that_is_not_level_are_those_of_differences() {
    for (robot, position) in
        [(caroca(), [0.0, 0.0, 1.75]), (caroca(), [3.2, 1.7, 3.0]), (cogiro(), [1.0, -2.0, 2.0])]
    {
        let load = Load {
            payload: 20.0,
            wrench: Wrench { force: Vector3::new(40.0, -30.0, 10.0), moment: Vector3::zeros() },
        };
        let pose = Pose { position: position.into(), rotation: Rotation3::identity() };
        let case = Case { robot: tilted(led(robot, 0.1, 3.0)), pose, offsets: vec![0.0; 8], load };
        assert_eq!(Parameter::of(&case.robot).len(), 62 + 8 + 8 + 16 + 3);
        let found = check(&case).unwrap();
        report(&format!("{} over tilted axes, tilted, at {position:?}", case.robot.name), &[found]);
    }
}

/// The robot with this lead of every cable [m].
pub(crate) fn with_lead(robot: Robot, lead: f64) -> Robot {
    Robot { cables: robot.cables.into_iter().map(|cable| RobotCable { lead, ..cable }).collect(), ..robot }
}

#[test]
fn derivatives_of_random_robots_are_those_of_differences() {
    let outcomes: Vec<_> = (0..140u64).into_par_iter().map(|seed| check(&random_case(seed))).collect();
    let (mut all, mut refused) = (Vec::new(), BTreeMap::<_, usize>::new());
    for outcome in outcomes {
        match outcome {
            Ok(found) => all.push(found),
            Err(error) => *refused.entry(error.kind()).or_default() += 1,
        }
    }
    report("random robots", &all);
    println!("no observation: {refused:?}");
    assert!(all.len() > 80);
    let sum = |count: fn(&Found) -> usize| all.iter().map(count).sum::<usize>();
    assert!(sum(|f| f.active) > sum(|f| f.demanded) + 5 && sum(|f| f.demanded) > 5);
    assert!(sum(|f| f.clamped) > 5 && sum(|f| f.raised) > 5);
}
