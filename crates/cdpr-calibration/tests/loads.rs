//! Loads of a campaign: as tables keep them, and what the platform becomes under them.

use cdpr_calibration::{
    CalibrationError, Noise, Quantity, Row, Simulated, read_measurements, simulate, write_measurements,
};
use cdpr_robot::{Axis, CableEnd, Parameter, Pose, Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::{Load, deflection};

fn suspended() -> Robot {
    Robot::from_json(include_str!("../../../data/reference/robots/suspended.json")).unwrap()
}

/// A share of a load under which the branch of the unloaded platform ends at 92 %.
fn load(share: f64) -> Load {
    let wrench = Wrench { force: Vector3::zeros(), moment: share * Vector3::new(400.0, -300.0, 100.0) };
    Load { payload: 2.0 * share, wrench }
}

fn pose() -> Pose {
    let [roll, pitch, yaw] = [3.0, -4.0, 6.0].map(f64::to_radians);
    let rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
    Pose { position: Vector3::new(0.6, -0.4, 1.6), rotation }
}

/// What sensors with hardly any noise read of the robot of the file.
fn read_under(load: Load) -> Result<Vec<Row>, CalibrationError> {
    let robot = suspended();
    let noise = Noise {
        position: Some(1e-12),
        displacement: Some(1e-12),
        length: Some(1e-12),
        tension: Some(1e-9),
        ..Noise::default()
    };
    simulate(&Simulated {
        nominal: &robot,
        deviations: &vec![0.0; Parameter::of(&robot).len()],
        poses: &[pose()],
        free: &[],
        load,
        noise,
        markers: &[],
        errors: &[],
        tension_at: CableEnd::Anchor,
        seed: 1,
    })
}

#[test]
fn a_simulated_platform_is_what_the_unloaded_one_becomes() {
    let robot = suspended();
    for share in [0.5, 0.92] {
        let row = &read_under(load(share)).unwrap()[0];
        let wanted = deflection(&robot, &pose(), &load(share)).unwrap();
        let read =
            |of: fn(Axis) -> Quantity| Vector3::from(Axis::ALL.map(|axis| row.value(of(axis)).unwrap()));
        let apart = read(Quantity::Displacement) - wanted.displacement();
        assert!(apart.norm() < 1e-8, "{share}: {apart}");
        let apart = read(Quantity::Position) - wanted.loaded.equilibrium.pose.position;
        assert!(apart.norm() < 1e-8, "{share}: {apart}");
    }
}

#[test]
fn a_simulated_platform_that_falls_on_the_way_to_its_load_is_an_error() {
    let error = read_under(load(1.0)).unwrap_err();
    assert_eq!(error.kind(), "branch_ends");
    assert!(error.to_string().starts_with("line 1: "), "{error}");
}

#[test]
fn a_table_of_measurements_keeps_every_load() {
    let robot = suspended();
    let mut rows = read_under(Load::none()).unwrap();
    rows.extend(read_under(load(0.5)).unwrap());
    rows.extend(rows.clone());
    rows[1].mass = Some(31.5);
    rows[2].load.wrench.force = Vector3::new(1.0, -2.0, 0.1 + 0.2);
    rows[3].rotation = Some(pose().rotation);
    let (header, lines) = write_measurements(&rows);
    let text = lines.iter().fold(header.join(",") + "\n", |text, line| text + &line.join(",") + "\n");
    let read = read_measurements(text.as_bytes(), &robot, &[]).unwrap().rows;
    assert_eq!(read.len(), 4);
    for (read, row) in read.iter().zip(&rows) {
        assert_eq!((read.load, read.mass), (row.load, row.mass), "{text}");
        assert_eq!(read.lengths, row.lengths);
        for reading in &row.readings {
            assert_eq!(read.value(reading.quantity), Some(reading.value), "{}", reading.quantity);
        }
        let turn = |row: &Row| row.rotation.map_or(0.0, |rotation| rotation.angle_to(&pose().rotation));
        assert_eq!(read.rotation.is_some(), row.rotation.is_some());
        assert!(turn(read) < 1e-12);
    }
}
