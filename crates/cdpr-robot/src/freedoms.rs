//! Which motions of the platform are free, and the coordinates of a pose.
//!
//! A platform in space has six freedoms. A point mass cannot rotate, and a planar robot moves in a plane of
//! the base frame only. What holds the other motions takes any wrench: their rows of Eq. (3) are left out.

use crate::error::RobotError;
use nalgebra::{DMatrix, Matrix6, Vector3, Vector6};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The plane of the base frame in which the platform of a planar robot moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Plane {
    /// x and y, rotation about z.
    Xy,
    /// x and z, rotation about y.
    Xz,
    /// y and z, rotation about x.
    Yz,
}

impl Plane {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Xy => "xy",
            Self::Xz => "xz",
            Self::Yz => "yz",
        }
    }

    /// Index of the axis at right angles to the plane.
    pub fn normal(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Xz => 1,
            Self::Yz => 0,
        }
    }
}

/// The free ones among the motions (dp, dφ) of the platform, in the base frame about P.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Freedoms {
    free: [bool; 6],
}

impl Freedoms {
    /// All six.
    pub const ALL: Self = Self { free: [true; 6] };

    /// Those of a point mass, whose rotation is held, or of a platform that moves in a plane.
    #[inline]
    pub fn new(point: bool, plane: Option<Plane>) -> Self {
        if !point && plane.is_none() {
            return Self::ALL;
        }
        let in_plane = |k: usize| match plane {
            None => true,
            Some(plane) if k < 3 => k != plane.normal(),
            Some(plane) => k - 3 == plane.normal(),
        };
        Self { free: std::array::from_fn(|k| in_plane(k) && !(point && k >= 3)) }
    }

    /// Number m of free motions.
    #[inline]
    pub fn count(&self) -> usize {
        self.free.iter().filter(|free| **free).count()
    }

    /// Whether all six motions are free.
    #[inline]
    pub fn are_all(&self) -> bool {
        self.free == [true; 6]
    }

    /// Whether a component of (dp, dφ) is free.
    #[inline]
    pub fn contains(&self, component: usize) -> bool {
        self.free[component]
    }

    /// The components of (dp, dφ) that are free.
    pub fn components(&self) -> Vec<usize> {
        (0..6).filter(|k| self.free[*k]).collect()
    }

    /// A motion or wrench without its components along held motions.
    #[inline]
    pub fn of_vector(&self, vector: &Vector6<f64>) -> Vector6<f64> {
        if self.are_all() {
            return *vector;
        }
        Vector6::from_fn(|k, _| if self.free[k] { vector[k] } else { 0.0 })
    }

    /// A stiffness without the rows and columns of held motions.
    #[inline]
    pub fn of_matrix(&self, matrix: &Matrix6<f64>) -> Matrix6<f64> {
        if self.are_all() {
            return *matrix;
        }
        Matrix6::from_fn(|i, j| if self.free[i] && self.free[j] { matrix[(i, j)] } else { 0.0 })
    }

    /// The rows and columns of free motions alone, m x m.
    pub fn block(&self, matrix: &Matrix6<f64>) -> DMatrix<f64> {
        let free = self.components();
        DMatrix::from_fn(free.len(), free.len(), |i, j| matrix[(free[i], free[j])])
    }
}

/// A coordinate of a pose: of P [m], or an angle of `R = Rz(yaw) Ry(pitch) Rx(roll)` [rad].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Coordinate {
    /// Position along x of the base frame.
    X,
    /// Position along y of the base frame.
    Y,
    /// Position along z of the base frame.
    Z,
    /// Last angle, about x of the platform.
    Roll,
    /// Middle angle.
    Pitch,
    /// First angle, about z of the base frame.
    Yaw,
}

impl Coordinate {
    /// All six, in the order of (dp, dφ).
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::Roll, Self::Pitch, Self::Yaw];

    /// Whether it is an angle.
    pub fn is_angle(self) -> bool {
        matches!(self, Self::Roll | Self::Pitch | Self::Yaw)
    }

    /// The component of (dp, dφ) that changes it where the platform stands level.
    pub fn component(self) -> usize {
        self as usize
    }

    /// Motion (dp, dφ) of the platform per unit of the coordinate, at the yaw and pitch [rad] of a pose.
    pub fn motion(self, yaw: f64, pitch: f64) -> Vector6<f64> {
        let axis = match self {
            Self::X | Self::Y | Self::Z => return Vector6::ith(self.component(), 1.0),
            Self::Yaw => Vector3::z(),
            Self::Pitch => Vector3::new(-yaw.sin(), yaw.cos(), 0.0),
            Self::Roll => Vector3::new(yaw.cos() * pitch.cos(), yaw.sin() * pitch.cos(), -pitch.sin()),
        };
        Vector6::new(0.0, 0.0, 0.0, axis.x, axis.y, axis.z)
    }
}

impl fmt::Display for Coordinate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::Roll => "roll",
            Self::Pitch => "pitch",
            Self::Yaw => "yaw",
        })
    }
}

impl FromStr for Coordinate {
    type Err = RobotError;

    fn from_str(name: &str) -> Result<Self, RobotError> {
        let known = Self::ALL.into_iter().find(|coordinate| coordinate.to_string() == name);
        known.ok_or_else(|| {
            RobotError::invalid("free", format!("{name:?}"), "names out of x, y, z, roll, pitch, yaw")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn points_and_planar_platforms_have_three_freedoms() {
        assert_eq!(Freedoms::new(false, None), Freedoms::ALL);
        assert_eq!(Freedoms::new(true, None).components(), [0, 1, 2]);
        assert_eq!(Freedoms::new(false, Some(Plane::Xz)).components(), [0, 2, 4]);
        assert_eq!(Freedoms::new(false, Some(Plane::Xy)).components(), [0, 1, 5]);
        assert_eq!(Freedoms::new(true, Some(Plane::Yz)).components(), [1, 2]);
    }

    #[test]
    fn the_motion_of_an_angle_is_the_derivative_of_the_rotation() {
        let angles = [0.3, -0.4, 0.7];
        let h = 1e-6;
        for (k, coordinate) in [Coordinate::Roll, Coordinate::Pitch, Coordinate::Yaw].into_iter().enumerate()
        {
            let at = |change: f64| {
                let mut angles = angles;
                angles[k] += change;
                Rotation3::from_euler_angles(angles[0], angles[1], angles[2])
            };
            let slope = (at(h).matrix() - at(-h).matrix()) / (2.0 * h) * at(0.0).matrix().transpose();
            let difference = Vector3::new(slope[(2, 1)], slope[(0, 2)], slope[(1, 0)]);
            let motion = coordinate.motion(angles[2], angles[1]);
            assert!((difference - motion.fixed_rows::<3>(3)).norm() < 1e-9, "{coordinate}");
        }
    }
}
