//! The observer has the bits of the Rust interface, allocates nothing in a sample, and refuses bad input.

use crate::common::{level, robot};
use cdpr_c::border::observer::{
    cdpr_observer_cables, cdpr_observer_free, cdpr_observer_new, cdpr_observer_tare, cdpr_observer_update,
};
use cdpr_c::border::{cdpr_message, cdpr_robot_free, cdpr_robot_named};
use cdpr_c::{CdprAlarm, CdprObserved, CdprObserver, CdprObserverSetting, CdprStatus};
use cdpr_observer::{LoadObserver, ObserverSetting};
use cdpr_robot::Pose;
use cdpr_statics::{Load, deflection};
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

const STD: [f64; 8] = [5.0; 8];

const SETTING: CdprObserverSetting = CdprObserverSetting {
    count: 8,
    tension_std: STD.as_ptr(),
    length_std: 1e-5,
    payload_std: 20.0,
    center_std: 0.1,
    modulus_std: 0.05,
    memory: 1000.0,
    false_alarm: 1e-9,
    consecutive: 3,
};

/// Lengths, and tensions without and with a load.
fn readings() -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let found = deflection(&robot("caroca"), &Pose::at(0.2, -0.1, 1.75), &Load::payload(5.0)).unwrap();
    let [empty, loaded] = [&found.unloaded, &found.loaded].map(|of| of.equilibrium.tensions());
    (found.lengths, empty, loaded)
}

unsafe fn observer(lengths: &[f64]) -> *mut CdprObserver {
    let (mut robot, mut observer, start) = (null_mut(), null_mut(), level([0.2, -0.1, 1.75]));
    unsafe {
        assert_eq!(cdpr_robot_named(c"caroca".as_ptr(), &mut robot), CdprStatus::Ok);
        let status = cdpr_observer_new(robot, lengths.as_ptr(), 8, &start, &SETTING, &mut observer);
        assert_eq!(status, CdprStatus::Ok);
        cdpr_robot_free(robot);
    }
    observer
}

#[test]
fn a_sample_has_the_bits_of_the_rust_interface_and_allocates_nothing() {
    let (lengths, empty, loaded) = readings();
    let setting = ObserverSetting {
        length_std: 1e-5,
        modulus_std: 0.05,
        memory: 1000.0,
        ..ObserverSetting::new(8, 5.0, 20.0, 0.1)
    };
    let mut expected =
        LoadObserver::new(&robot("caroca"), &lengths, &Pose::at(0.2, -0.1, 1.75), setting).unwrap();
    let observer = unsafe { observer(&lengths) };
    let mut found = MaybeUninit::<CdprObserved>::uninit();
    let mut states = [9; 8];
    for k in 0..50 {
        let tensions = if k < 20 { &empty } else { &loaded };
        let allocated = allocation_counter::measure(|| unsafe {
            let call = if k < 20 { cdpr_observer_tare } else { cdpr_observer_update };
            let status = call(observer, lengths.as_ptr(), tensions.as_ptr(), 8, found.as_mut_ptr());
            assert_eq!(status, CdprStatus::Ok);
            assert_eq!(cdpr_observer_cables(observer, states.as_mut_ptr(), 8), CdprStatus::Ok);
        });
        assert_eq!(allocated.count_total, 0);
        let observed = if k < 20 {
            expected.tare(&lengths, tensions).unwrap()
        } else {
            expected.update(&lengths, tensions).unwrap()
        };
        let (found, estimate) = (unsafe { found.assume_init() }, expected.estimate());
        assert_eq!(found.force, <[f64; 3]>::from(observed.wrench.force));
        assert_eq!(found.moment, <[f64; 3]>::from(observed.wrench.moment));
        assert_eq!(found.change.to_bits(), observed.change.to_bits());
        assert_eq!(found.payload.to_bits(), estimate.payload.to_bits());
        assert_eq!(found.payload_std.to_bits(), estimate.payload_std.to_bits());
        for (found, expected) in found.center.iter().zip(estimate.center) {
            assert_eq!(found.to_bits(), expected.unwrap_or(f64::NAN).to_bits());
        }
        assert_eq!((found.alarm, states), (CdprAlarm::None, [0; 8]));
    }
    unsafe { cdpr_observer_free(observer) };
}

#[test]
fn bad_samples_and_settings_have_a_status_and_a_message() {
    let message = || unsafe { CStr::from_ptr(cdpr_message()) }.to_str().unwrap().to_owned();
    let (lengths, empty, mut tensions) = readings();
    unsafe {
        let (mut robot, mut other, start) = (null_mut(), null_mut(), level([0.2, -0.1, 1.75]));
        assert_eq!(cdpr_robot_named(c"caroca".as_ptr(), &mut robot), CdprStatus::Ok);
        let mut made = |setting: *const CdprObserverSetting| {
            let status = cdpr_observer_new(robot, lengths.as_ptr(), 8, &start, setting, &mut other);
            assert!(other.is_null());
            status
        };
        assert_eq!(made(null()), CdprStatus::Pointer);
        assert_eq!(made(&CdprObserverSetting { tension_std: null(), ..SETTING }), CdprStatus::Pointer);
        assert_eq!(made(&CdprObserverSetting { count: 7, ..SETTING }), CdprStatus::Size);
        assert_eq!(made(&CdprObserverSetting { payload_std: f64::NAN, ..SETTING }), CdprStatus::Invalid);
        assert!(message().starts_with("payload_std is NaN"), "{}", message());
        cdpr_robot_free(robot);
        let observer = observer(&lengths);
        let take = |count: usize, tensions: *const f64, lengths: *const f64| {
            cdpr_observer_update(observer, lengths, tensions, count, null_mut())
        };
        assert_eq!(take(7, empty.as_ptr(), lengths.as_ptr()), CdprStatus::Size);
        assert_eq!(take(8, null(), lengths.as_ptr()), CdprStatus::Pointer);
        assert_eq!(take(8, empty.as_ptr(), null()), CdprStatus::Pointer);
        tensions[2] = f64::NAN;
        assert_eq!(take(8, tensions.as_ptr(), lengths.as_ptr()), CdprStatus::Invalid);
        assert!(message().contains("tensions"), "{}", message());
        let far: Vec<f64> = lengths.iter().map(|length| length - 1.0).collect();
        assert_eq!(take(8, empty.as_ptr(), far.as_ptr()), CdprStatus::NotConverged);
        assert_eq!(take(8, empty.as_ptr(), lengths.as_ptr()), CdprStatus::Ok);
        assert_eq!(cdpr_observer_cables(observer, null_mut(), 8), CdprStatus::Pointer);
        assert_eq!(cdpr_observer_update(null_mut(), null(), null(), 8, null_mut()), CdprStatus::Pointer);
        cdpr_observer_free(observer);
        cdpr_observer_free(null_mut());
    }
}
