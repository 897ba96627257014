//! What a wanted pose says besides the pose: free coordinates, offsets, a reference of the tensions.

use crate::common::{caroca, cogiro, ipanema};
use cdpr_robot::{Coordinate, Pose, Robot, TensionReference};
use cdpr_statics::capacity::{greatest_payload, tension_margin};
use cdpr_statics::free_coordinates::free_solutions;
use cdpr_statics::limits::limits_at;
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::vibration::modes_at;
use cdpr_statics::{
    InversePath, InverseSolution, Load, Observer, StaticsError, WantedPose, deflection, derivatives, inverse,
    is_feasible, lengths_for_tensions, set_point_lengths,
};

/// CoGiRo on every other cable, with the coordinates that it finds itself.
fn on_four_cables() -> (Robot, [Coordinate; 2]) {
    let mut robot = cogiro();
    robot.cables = [1, 3, 5, 7].map(|i| robot.cables[i].clone()).to_vec();
    (robot, [Coordinate::Roll, Coordinate::Yaw])
}

#[test]
fn tensions_that_are_wanted_are_those_of_a_robot_that_prefers_them() {
    for (robot, pose, tension) in
        [(caroca(), Pose::at(0.4, -0.3, 1.6), 900.0), (ipanema(), Pose::at(0.2, 0.1, 1.0), 60.0)]
    {
        let preferred = vec![tension; robot.cables.len()];
        let wanted = WantedPose::at(&pose).tension_reference(&preferred);
        let mut other = robot.clone();
        other.tension_reference = Some(TensionReference::All(tension));
        let load = Load::payload(0.1 * robot.platform.mass);
        assert_ne!(inverse(&robot, &pose, &load), inverse(&other, &pose, &load));
        assert_eq!(inverse(&robot, wanted, &load), inverse(&other, &pose, &load));
        assert_eq!(deflection(&robot, wanted, &load), deflection(&other, &pose, &load));
        assert_eq!(derivatives(&robot, wanted, &load), derivatives(&other, &pose, &load));
        assert_eq!(modes_at(&robot, wanted, &load).ok(), modes_at(&other, pose, &load).ok());
        assert_eq!(stiffness_at(&robot, wanted, &load), stiffness_at(&other, pose, &load));
        let of_path = |robot, wanted| InversePath::new(robot).solve(wanted, &load);
        assert_eq!(of_path(&robot, wanted), of_path(&other, WantedPose::at(&pose)));
    }
}

#[test]
fn no_offsets_are_offsets_of_zero() {
    let (few, free) = on_four_cables();
    for (robot, pose, free) in
        [(caroca(), Pose::at(0.4, -0.3, 1.6), &[][..]), (few, Pose::at(1.0, -0.3, 2.0), &free)]
    {
        let zeros = vec![0.0; robot.cables.len()];
        let (none, load) = (WantedPose::at(&pose).free(free), Load::payload(20.0));
        let zero = none.tension_offsets(&zeros);
        assert_eq!(deflection(&robot, none, &load), deflection(&robot, zero, &load));
        assert_eq!(derivatives(&robot, none, &load), derivatives(&robot, zero, &load));
        assert_eq!(set_point_lengths(&robot, none), set_point_lengths(&robot, zero));
    }
}

#[test]
fn offsets_are_refused_where_no_set_points_are_set() {
    let (robot, pose, load) = (caroca(), Pose::at(0.4, -0.3, 1.6), Load::payload(20.0));
    let wanted = WantedPose::at(&pose).tension_offsets(&[1.0; 8]);
    let errors = [
        inverse(&robot, wanted, &load).err(),
        free_solutions(&robot, wanted, &load).err(),
        stiffness_at(&robot, wanted, &load).err(),
        modes_at(&robot, wanted, &load).err(),
        InversePath::new(&robot).solve(wanted, &load).err(),
        Observer::new(&robot, wanted, &load).err(),
        is_feasible(&robot, wanted, &load).err(),
        greatest_payload(&robot, wanted, &load.wrench).err(),
        tension_margin(&robot, wanted, &load).err(),
        lengths_for_tensions(&robot, wanted, &[900.0; 8]).err(),
        limits_at(&robot, wanted).err(),
    ];
    for error in errors {
        let text = error.unwrap().to_string();
        assert!(
            text.starts_with("tension_offsets is a list of 8: expected none here: deflections"),
            "{text}"
        );
    }
    let preferred = WantedPose::at(&pose).tension_reference(&[900.0; 8]);
    let errors = [
        Observer::new(&robot, preferred, &load).err(),
        lengths_for_tensions(&robot, preferred, &[900.0; 8]).err(),
        limits_at(&robot, preferred).err(),
    ];
    for error in errors {
        let text = error.unwrap().to_string();
        assert!(text.starts_with("tension_reference is a list of 8: expected none here"), "{text}");
    }
}

#[test]
fn free_coordinates_are_refused_where_tensions_have_to_be_chosen() {
    let ((robot, free), load) = (on_four_cables(), Load::none());
    let pose = Pose::at(1.0, -0.3, 2.0);
    let wanted = WantedPose::at(&pose).free(&free);
    let errors = [
        InversePath::new(&robot).solve(wanted, &load).err(),
        greatest_payload(&robot, wanted, &load.wrench).err(),
        tension_margin(&robot, wanted, &load).err(),
        lengths_for_tensions(&robot, wanted, &[900.0; 4]).err(),
        limits_at(&robot, wanted).err(),
    ];
    for error in errors {
        let text = error.unwrap().to_string();
        assert!(text.starts_with("free is a list of 2: expected none here: it takes whole poses"), "{text}");
    }
    // They are found, at rest or not.
    assert_eq!(is_feasible(&robot, wanted, &load), Ok(true));
    assert_eq!(
        is_feasible(&robot, WantedPose { pose: Pose::at(1.0, -0.3, 9.0), ..wanted }, &load),
        Ok(false)
    );
}

#[test]
fn each_pose_of_a_list_has_its_own_answer() {
    let (robot, load) = (caroca(), Load::none());
    let poses = [Pose::at(0.4, -0.3, 1.6), Pose::at(9.0, 0.0, 1.0)];
    let held: Vec<_> = poses.iter().map(|pose| is_feasible(&robot, pose, &load)).collect();
    assert_eq!((is_feasible(&robot, &poses, &load), &held), (vec![Ok(true), Ok(false)], &held));
    let each: Vec<_> = poses.iter().map(|pose| greatest_payload(&robot, pose, &load.wrench)).collect();
    assert_eq!(greatest_payload(&robot, &poses, &load.wrench), each);
    let each: Vec<_> = poses.iter().map(|pose| tension_margin(&robot, pose, &load)).collect();
    assert_eq!(tension_margin(&robot, &poses, &load), each);
    let each: Vec<_> = poses.iter().map(|pose| lengths_for_tensions(&robot, pose, &[900.0; 8])).collect();
    assert_eq!(lengths_for_tensions(&robot, &poses, &[900.0; 8]), each);
    assert_eq!(limits_at(&robot, &poses).len(), 2);
}

#[test]
fn the_rest_of_a_robot_on_few_cables_is_the_first_of_its_solutions() {
    let (robot, free) = on_four_cables();
    let wanted = WantedPose::at(&Pose::at(1.0, -0.3, 2.0)).free(&free);
    for load in [Load::none(), Load::payload(20.0)] {
        let InverseSolution { lengths, tensions, active, residual, equilibrium, .. } =
            inverse(&robot, wanted, &load).unwrap();
        let first = free_solutions(&robot, wanted, &load).unwrap().first;
        let differ = lengths.iter().zip(&first.lengths).map(|(one, other)| (one - other).abs());
        assert!(differ.fold(0.0, f64::max) < 1e-9);
        assert_eq!((active, tensions), (vec![None; 4], equilibrium.tensions()));
        assert!(residual.force < 1e-8 && residual.closure < 1e-12);
    }
}

#[test]
fn a_path_takes_no_free_coordinates() {
    let (robot, free) = on_four_cables();
    let wanted = WantedPose::at(&Pose::at(1.0, -0.3, 2.0)).free(&free);
    let error = InversePath::new(&robot).solve(wanted, &Load::none()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "free is a list of 2: expected none here: it takes whole poses, at which tensions are chosen"
    );
    let error = InversePath::new(&robot).solve(wanted.pose, &Load::none()).unwrap_err();
    assert!(matches!(error, StaticsError::FreeCoordinates { cables: 4, .. }));
}
