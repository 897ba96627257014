//! Where the platform stands on given lengths.

use crate::answers::failure::Failure;
use crate::answers::state::State;
use crate::question::Stand;
use cdpr_robot::Robot;
use cdpr_statics::{DirectStart, direct};

pub(crate) fn stand(robot: &Robot, given: &Stand) -> Result<State, Failure> {
    let (start, load) = (given.start.pose()?, given.load.load());
    let found = direct(robot, &given.lengths, &load, DirectStart::Pose(&start))?;
    State::new(robot, &given.lengths, &load, &found)
}
