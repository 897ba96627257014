//! Tables of deviations that are refused, without rows, and names of reasons.

use crate::common::{caroca, observed};
use cdpr_robot::{Deviations, ParameterLayout, Pose, Pulley, RobotError, Vector3};
use cdpr_statics::batch::{Observation, ObservationMotion, ObservationSlopes, ScalarReason};
use cdpr_statics::{Load, Observer, StaticsError};

#[test]
fn a_table_for_robots_with_other_parameters_is_refused_and_no_row_is_observed() {
    let robot = caroca();
    let mut guided = robot.clone();
    for (i, cable) in guided.cables.iter_mut().enumerate() {
        cable.pulley = Some(Pulley { radius: 0.045, axis: Vector3::z() });
        cable.lead = if i < 7 { 3.0 } else { 0.0 };
    }
    let (pose, load) = (Pose::at(0.0, 0.0, 1.75), Load::payload(50.0));
    let observer = Observer::new(&guided, pose, &load).unwrap();
    let layout = ParameterLayout::of(&robot);
    // As many numbers as 62 robots with 93 parameters have.
    let table = Deviations::zeros(&layout, 93);
    let refused = Err(StaticsError::Robot(RobotError::DeviationCount { given: 62, parameters: 93 }));
    assert_eq!(observer.observe::<Observation>(&table), vec![refused.clone(); 93]);
    assert_eq!(observer.observe_one_by_one::<Observation>(&table), vec![refused.clone(); 93]);
    let motions = observer.observe::<ObservationMotion>(&table).into_iter().map(|found| found.map(|_| ()));
    let slopes = observer.observe::<ObservationSlopes>(&table).into_iter().map(|found| found.map(|_| ()));
    assert!(motions.chain(slopes).all(|found| found == refused.clone().map(|_| ())));

    // With one pulley and with three leads, a robot has 65 parameters.
    let (mut pulley, mut leads) = (robot.clone(), robot);
    pulley.cables[0].pulley = guided.cables[0].pulley;
    leads.cables[..3].iter_mut().for_each(|cable| cable.lead = 3.0);
    let layout = ParameterLayout::of(&leads);
    let found = Observer::new(&pulley, pose, &load).unwrap().observe(&Deviations::zeros(&layout, 1));
    let found: &Result<Observation, _> = &found[0];
    let message = "column 63 of the deviations is lead1: expected r1, as the robot has it";
    assert_eq!(found.as_ref().unwrap_err().to_string(), message);
}

#[test]
fn a_table_without_rows_has_no_observations() {
    let robot = caroca();
    let observer = Observer::new(&robot, Pose::at(0.0, 0.0, 1.75), &Load::payload(50.0)).unwrap();
    assert_eq!(observed::<Observation>(&observer, &[]), []);
}

#[test]
fn each_reason_for_the_scalar_models_has_a_name_of_its_own() {
    use ScalarReason::*;
    let reasons = [
        OneByOne,
        Output,
        FreeCoordinates,
        FewCables,
        NominalRobot,
        InvalidRobot,
        Tensions,
        Folded,
        Lengths,
        Unloaded,
        Loaded,
        Derivatives,
    ];
    for (place, reason) in reasons.into_iter().enumerate() {
        assert_eq!(ScalarReason::named(reason.name()), Some(reason));
        assert_eq!(reason as usize, place, "the list has all of them");
    }
    assert_eq!(ScalarReason::named(""), None);
}
