//! Whole paths with the noise of load cells: the load is found, a cut cable is seen, nothing else is.
//!
//! A load cell has a zero error of up to 0.5 % of its full scale, which taring removes, and noise of which
//! the standard deviation is taken to be as large again, with 1 N more for cable and amplifier. Data sheets
//! of strain gauge cells state zero balances of 0.5 to 1 % and repeatabilities of 0.02 to 0.05 % of full
//! scale (Seeed Studio, "Weight Sensor (Load Cell)": zero balance ±0.5 %, repeatability 0.05 %): the noise
//! here is ten times theirs. Full scale is twice the greatest tension of the path.

use crate::common::{Followed, follow, index, loaded, robot};
use cdpr_observer::{Alarm, CableState, LoadObserver, ObserverSetting};
use cdpr_robot::{Robot, Vector3};
use cdpr_statics::{DirectStart, Load, direct};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// Samples without load and fault.
const TARED: usize = 20_000;

struct Cells {
    std: f64,
    bias: Vec<f64>,
    rng: ChaCha8Rng,
}

impl Cells {
    fn new(paths: [&Followed; 2], seed: u64) -> Self {
        let tensions = paths.iter().flat_map(|path| path.tensions.iter().flatten());
        let full_scale = 2.0 * tensions.fold(0.0, |most: f64, t| most.max(*t));
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut zero = || 0.005 * full_scale * (2.0 * rng.random::<f64>() - 1.0);
        let bias = paths[0].tensions[0].iter().map(|_| zero()).collect();
        Self { std: 0.005 * full_scale + 1.0, bias, rng }
    }

    fn read(&mut self, tensions: &[f64], readings: &mut [f64]) {
        for ((reading, tension), bias) in readings.iter_mut().zip(tensions).zip(&self.bias) {
            *reading = tension + bias + self.std * self.rng.sample::<f64, _>(StandardNormal);
        }
    }
}

/// A path of a robot with a load [kg] that is found to `accuracy` [kg], and with each cable cut at its end.
fn observe(name: &str, start: [f64; 3], steps: [f64; 2], [mass, accuracy]: [f64; 2], samples: usize) {
    let nominal = robot(name);
    let n = nominal.cables.len();
    let center = Vector3::new(0.1, -0.05, 0.0);
    let truth = loaded(&nominal, mass, center, 1.0);
    let empty = follow(&nominal, &nominal, start, steps);
    let path = follow(&nominal, &truth, start, steps);
    let mut cells = Cells::new([&empty, &path], 51);
    let setting =
        ObserverSetting { modulus_std: 0.02, ..ObserverSetting::new(n, cells.std, 4.0 * mass, 0.2) };
    let mut observer = LoadObserver::new(&nominal, &empty.lengths[0], &empty.poses[0], setting).unwrap();
    let mut readings = vec![0.0; n];
    for k in 0..TARED {
        cells.read(&empty.tensions[index(k)], &mut readings);
        assert!(observer.tare(&empty.lengths[index(k)], &readings).unwrap().converged);
    }
    let mut deviating = 0;
    for k in 0..samples {
        cells.read(&path.tensions[index(k)], &mut readings);
        let observed = observer.update(&path.lengths[index(k)], &readings).unwrap();
        assert!(observed.converged, "{name} {k}");
        // The load comes onto the platform with the first sample.
        let is_of_load = k < 10 && matches!(observed.alarm, Some(Alarm::LoadChanged | Alarm::CableSlack(_)));
        assert!(is_of_load || observed.alarm.is_none(), "{name} {k}: {observed:?}");
        deviating += usize::from(observed.change > observed.threshold);
    }
    let estimate = observer.estimate();
    println!("{name}: {} N, {estimate:?}, {deviating} deviating", cells.std);
    assert!((estimate.payload - mass).abs() < accuracy, "{name}: {estimate:?}");
    // One of a thousand samples deviates alone: (O5) with the default setting.
    let expected = samples as f64 / 1000.0;
    assert!((deviating as f64 - expected).abs() < 5.0 * expected.sqrt(), "{name}: {deviating}");
    let last = index(samples - 1);
    let seen = (0..n).filter(|i| cut(&nominal, &truth, (&path, last), &observer, &mut cells, *i)).count();
    assert!(seen + 1 >= n.min(4), "{name}: {seen} cables could be cut");
}

/// Cuts cable i, where the platform comes to rest without it; it is an alarm within ten samples.
fn cut(
    nominal: &Robot,
    truth: &Robot,
    (path, last): (&Followed, usize),
    observer: &LoadObserver,
    cells: &mut Cells,
    i: usize,
) -> bool {
    let lengths = &path.lengths[last];
    let (mut without, mut left) = (truth.clone(), lengths.clone());
    without.cables.remove(i);
    left.remove(i);
    let Ok(found) = direct(&without, &left, &Load::none(), DirectStart::Pose(&path.poses[last])) else {
        return false;
    };
    let mut tensions = found.equilibrium.tensions();
    tensions.insert(i, 0.0);
    let weight = nominal.cable(i).weight_per_length * lengths[i];
    if path.tensions[last][i] < 7.0 * cells.std + weight {
        // The cable was not distinguishable from a slack one before.
        return false;
    }
    let (mut observer, mut readings) = (observer.clone(), vec![0.0; tensions.len()]);
    for k in 1..=10 {
        cells.read(&tensions, &mut readings);
        let observed = observer.update(lengths, &readings).unwrap();
        let (state, name) = (observer.cable(i), &nominal.name);
        match observed.alarm {
            Some(Alarm::CableLost(_)) => assert_eq!(state, Some(CableState::Lost), "{name} cable {i}"),
            // A light cable, or one of four, leaves another load as an explanation.
            Some(Alarm::CableSlack(_)) => assert_eq!(state, Some(CableState::Slack), "{name} cable {i}"),
            _ => continue,
        }
        println!("{name} cable {i}: {:?} after {k} samples", observed.alarm);
        return true;
    }
    panic!("{}: cable {i} was cut without an alarm", nominal.name);
}

#[test]
fn loads_and_cut_cables_of_caroca() {
    observe("caroca", [0.2, -0.1, 1.75], [2e-3, 0.05], [5.0, 0.1], 100_000);
}

#[test]
fn loads_and_cut_cables_of_cogiro() {
    observe("cogiro", [0.5, -0.25, 1.75], [2e-3, 0.05], [5.0, 0.1], 20_000);
}

#[test]
fn loads_and_cut_cables_of_ipanema_1() {
    observe("ipanema-1", [0.125, 0.0625, 1.0], [1e-3, 0.05], [5.0, 0.1], 20_000);
}

#[test]
fn loads_and_cut_cables_of_ipanema_3_over_pulleys() {
    observe("ipanema-3", [0.25, 0.125, 1.25], [2e-3, 0.05], [5.0, 0.1], 20_000);
}

#[test]
fn loads_and_cut_cables_of_a_telescope() {
    // A platform of 30 t: a load and an accuracy that are as small compared with it.
    observe("fast", [2.0, 1.0, 140.0], [2e-2, 1e-3], [1000.0, 20.0], 20_000);
}

#[test]
fn loads_and_cut_cables_of_four_cables() {
    observe("four-cables", [0.3, 0.2, 1.5], [2e-3, 0.05], [5.0, 0.1], 20_000);
}
