//! A region of the base frame: a plane, a box or a part of them.

use crate::program::arguments::{number, parts};
use crate::program::error::ProgramError;
use cdpr_robot::{Axis, Robot};
use cdpr_study::{Grid, GridSpan};

/// What is given of a region; the frame of the robot's exit points gives the rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Region([GridSpan; 3]);

impl Region {
    /// Its positions for a robot.
    pub(crate) fn grid(&self, robot: &Robot) -> Result<Grid, ProgramError> {
        Ok(Grid::within(robot, self.0)?)
    }
}

const EXPECTED: &str = "expected a plane, z=1.75, or x, y and z, each of them a coordinate, min:max or \
                        min:max:points [m], such as -2:2:5,-1:1:3,1.75";

/// A plane, `z=1.75`, or the coordinates along x, y and z in their order or with their names. Each is a
/// number, `min:max` or `min:max:points`; what is missing, such as in `::5`, is that of the frame.
pub(crate) fn region(text: &str) -> Result<Region, String> {
    let wrong = || EXPECTED.to_owned();
    let texts = parts(text);
    let is_named = texts.iter().any(|part| part.contains('='));
    if !is_named && texts.len() != 3 {
        return Err(wrong());
    }
    let mut spans: [Option<GridSpan>; 3] = [None; 3];
    for (k, part) in texts.iter().enumerate() {
        let (k, part) = match part.split_once('=') {
            Some((name, part)) => (Axis::from_letter(name.trim()).ok_or_else(wrong)?.index(), part),
            None if is_named => return Err(wrong()),
            None => (k, part.as_ref()),
        };
        if spans[k].replace(span(part).ok_or_else(wrong)?).is_some() {
            return Err(wrong());
        }
    }
    Ok(Region(spans.map(Option::unwrap_or_default)))
}

/// `1.75`, `min:max` or `min:max:points`, of which each may be empty.
fn span(text: &str) -> Option<GridSpan> {
    let fields: Vec<&str> = text.split(':').map(str::trim).collect();
    let end = |text: &str| if text.is_empty() { Some(None) } else { number(text).ok().map(Some) };
    let count = |text: &str| match text {
        "" => Some(None),
        text => text.parse().ok().filter(|count: &usize| *count > 0).map(Some),
    };
    match fields[..] {
        [value] => {
            let value = number(value).ok();
            value.map(|value| GridSpan { min: Some(value), max: Some(value), points: Some(1) })
        }
        [min, max] => Some(GridSpan { min: end(min)?, max: end(max)?, points: None }),
        [min, max, points] => Some(GridSpan { min: end(min)?, max: end(max)?, points: count(points)? }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cdpr_robot::Pose;

    #[test]
    fn a_region_is_a_plane_or_a_box_and_the_frame_gives_what_is_missing() {
        let robot = Robot::from_library("caroca").unwrap();
        let poses = |text: &str| region(text).unwrap().grid(&robot).unwrap().poses();
        let exact = poses("-1:1:3,0,2:3:2");
        assert_eq!(exact.len(), 6);
        assert_eq!((exact[0], exact[5]), (Pose::at(-1.0, 0.0, 2.0), Pose::at(1.0, 0.0, 3.0)));
        let plane = poses("z=1.75");
        assert_eq!(plane.len(), GridSpan::IN_PLANE.pow(2));
        assert_eq!(plane[0], Pose::at(-3.5, -2.0, 1.75));
        assert_eq!(poses("::11,::7,1.75"), poses("z=1.75,x=::11,y=::7"));
        assert_eq!(poses("-1:1:2;0,5;1,75:2:2").len(), 4);
        for text in ["", "0:1:2", "1,2", "0:1:0,0,0", "x=1,x=2", "w=1", "0,0,z=1", "0:x:2,0,0", "1,2,3,4"] {
            assert!(region(text).is_err_and(|error| error == EXPECTED), "{text}");
        }
    }
}
