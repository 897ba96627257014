//! How near cables come to each other and to the platform, in the shapes in which they hang.
//!
//! A cable is the curve through points of its catenary at equal distances, between which it is a parabola.
//! The nearest two of these points are where Gauss and Newton's method starts for the least distance of two
//! curves.
//!
//! The platform is the convex hull of its anchor points. Every cable ends on it, so that its own anchor point
//! is left out: a straight cable meets the hull of the *other* anchor points exactly where it passes through
//! the hull of all. The distance to a hull is that of its point of least norm (Wolfe, *Finding the nearest
//! point in a polytope*, Math. Programming 11, 1976).
//!
//! Distances are those of the surfaces if the diameters of the cables are known, otherwise of their axes. Two
//! cables whose exit or anchor points lie within the thickness of the cables share a point and have no
//! distance.

mod hull;

use crate::clearance::hull::{Separation, way_to_hull};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{DirectProblem, Equilibrium, Load, StaticsError, WantedPose, inverse};

/// The least distances at a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearance {
    /// The nearest two cables [m], negative where they overlap; `None` if all share points.
    pub cables: Option<CableDistance>,
    /// The cable nearest to the platform [m]; `None` of a point mass or fewer than two other anchor points.
    pub platform: Option<PlatformDistance>,
}

/// Two cables and their distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CableDistance {
    /// The distance of their surfaces [m].
    pub distance: f64,
    /// Indices of both, from 0.
    pub pair: [usize; 2],
}

/// A cable and its distance from the platform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlatformDistance {
    /// The distance of its surface [m], negative where it passes through the platform.
    pub distance: f64,
    /// Index of the cable, from 0.
    pub cable: usize,
}

/// The distances of the cables of a robot with these unstrained lengths [m] at an equilibrium.
///
/// # Errors
/// [`StaticsError::Invalid`] unless lengths and equilibrium are finite, with one value for each cable.
pub fn clearance_at(
    robot: &Robot,
    lengths: &[f64],
    equilibrium: &Equilibrium,
) -> Result<Clearance, StaticsError> {
    let cables = HangingCables::new(robot, lengths, equilibrium)?;
    let n = robot.cables.len();
    let mut clearance = Clearance { cables: None, platform: None };
    for i in 0..n {
        for j in 0..i {
            let bound = clearance.cables.map_or(f64::INFINITY, |found| found.distance);
            if let Some(distance) = cables.pair(j, i, bound)
                && distance < bound
            {
                clearance.cables = Some(CableDistance { distance, pair: [j, i] });
            }
        }
        let bound = clearance.platform.map_or(f64::INFINITY, |found| found.distance);
        if let Some(distance) = cables.platform(i)
            && distance < bound
        {
            clearance.platform = Some(PlatformDistance { distance, cable: i });
        }
    }
    Ok(clearance)
}

/// The distances of the cables that bear `load` at a wanted pose, with the tensions recomputed.
///
/// # Errors
/// Those of [`inverse`].
pub fn clearance_under<'a>(
    robot: &Robot,
    wanted: impl Into<WantedPose<'a>>,
    load: &Load,
) -> Result<Clearance, StaticsError> {
    let found = inverse(robot, wanted.into(), load)?;
    clearance_at(robot, &found.lengths, &found.equilibrium)
}

/// Distance of the surfaces of cables that touch [m].
pub(crate) const TOUCHING: f64 = 1e-9;

/// Intervals of a cable between the points of its curve.
const INTERVALS: usize = 32;

/// The cables of a robot as curves.
pub(crate) struct HangingCables<'a> {
    robot: &'a Robot,
    pose: Pose,
    curves: Vec<Curve>,
}

/// A curve through points at the parameters 0, 1, 2, .. [m].
struct Curve {
    points: Vec<Vector3<f64>>,
    /// Greatest distance from the chord [m].
    sag: f64,
}

impl<'a> HangingCables<'a> {
    /// The shapes of all cables with these unstrained lengths [m] at an equilibrium.
    pub(crate) fn new(
        robot: &'a Robot,
        lengths: &[f64],
        equilibrium: &Equilibrium,
    ) -> Result<Self, StaticsError> {
        let problem = DirectProblem::new(robot, lengths, &Load::none())?;
        let curve = |i| {
            let shape = problem.shape(equilibrium, i, 0, INTERVALS + 1)?;
            let on_pulley = shape.points.len() - (INTERVALS + 1);
            Ok(Curve { points: shape.points[on_pulley..].to_vec(), sag: shape.sag })
        };
        let curves = (0..robot.cables.len()).map(curve).collect::<Result<_, StaticsError>>()?;
        Ok(Self { robot, pose: equilibrium.pose, curves })
    }

    fn radius(&self, i: usize) -> f64 {
        0.5 * self.robot.cables[i].properties.diameter.unwrap_or(0.0)
    }

    /// The mean of the diameters of two cables [m]; zero where they are not known.
    fn thickness(&self, i: usize, j: usize) -> f64 {
        self.radius(i) + self.radius(j)
    }

    /// The distance of the surfaces of two cables [m]; `None` where they share a point, or where it is above
    /// `bound`.
    fn pair(&self, i: usize, j: usize, bound: f64) -> Option<f64> {
        let touch = self.thickness(i, j);
        let [one, other] = [i, j].map(|k| &self.robot.cables[k]);
        let [a, b] = [i, j].map(|k| self.robot.anchor_arm(&self.pose, k));
        let shared = touch.max(1e-9);
        if (one.exit_point - other.exit_point).norm() <= shared || (a - b).norm() <= shared {
            return None;
        }
        let (one, other) = (&self.curves[i], &self.curves[j]);
        if one.chord_distance(other) - one.sag - other.sag - touch > bound {
            return None;
        }
        Some(one.distance(other) - touch)
    }

    /// The distance of the surfaces of two cables that touch, cross or pass within their thickness [m].
    pub(crate) fn touching(&self, i: usize, j: usize) -> Option<f64> {
        let near = self.thickness(i, j).max(TOUCHING);
        self.pair(i, j, near).filter(|distance| *distance <= near)
    }

    /// The distance of the surface of cable `i` from the hull of the other anchor points [m]; `None` of a
    /// point mass or without two others.
    pub(crate) fn platform(&self, i: usize) -> Option<f64> {
        let cables = &self.robot.cables;
        let own = cables[i].anchor_point;
        let others = (0..cables.len()).filter(|k| (cables[*k].anchor_point - own).norm() > 1e-9);
        let corners: Vec<_> =
            others.map(|k| self.pose.position + self.robot.anchor_arm(&self.pose, k)).collect();
        if self.robot.platform.point || corners.len() < 2 {
            return None;
        }
        Some(self.curves[i].distance_to_hull(&corners) - self.radius(i))
    }
}

impl Curve {
    fn last(&self) -> f64 {
        (self.points.len() - 1) as f64
    }

    /// Point and tangent at a parameter: of the parabola through the nearest three points.
    fn at(&self, u: f64) -> (Vector3<f64>, Vector3<f64>) {
        let middle = (u.round() as usize).clamp(1, self.points.len() - 2);
        let [a, b, c] = [-1, 0, 1].map(|k| self.points[middle.saturating_add_signed(k)]);
        let u = u - middle as f64;
        let (slope, curvature) = (0.5 * (c - a), a - 2.0 * b + c);
        (b + u * slope + 0.5 * u * u * curvature, slope + u * curvature)
    }

    /// The least distance of the chords of two curves [m], or less.
    fn chord_distance(&self, other: &Self) -> f64 {
        let ends = |curve: &Self| Self {
            points: [0.0, 0.5, 1.0]
                .map(|s| curve.points[0].lerp(&curve.points[curve.points.len() - 1], s))
                .to_vec(),
            sag: 0.0,
        };
        ends(self).distance(&ends(other))
    }

    /// The least distance of two curves [m].
    fn distance(&self, other: &Self) -> f64 {
        const MAX_ITERATIONS: usize = 30;
        let mut least = (f64::INFINITY, 0, 0);
        for (k, p) in self.points.iter().enumerate() {
            for (l, q) in other.points.iter().enumerate() {
                let square = (p - q).norm_squared();
                if square < least.0 {
                    least = (square, k, l);
                }
            }
        }
        let (mut square, mut u, mut v) = (least.0, least.1 as f64, least.2 as f64);
        for _ in 0..MAX_ITERATIONS {
            let ((p, a), (q, b)) = (self.at(u), other.at(v));
            let open = p - q;
            let (aa, ab, bb) = (a.dot(&a), a.dot(&b), b.dot(&b));
            let (ra, rb) = (a.dot(&open), b.dot(&open));
            let determinant = aa * bb - ab * ab;
            let alone = |r: f64, square: f64| if square > 0.0 { r / square } else { 0.0 };
            let (mut du, mut dv) = if determinant > 1e-12 * aa * bb {
                ((ab * rb - bb * ra) / determinant, (aa * rb - ab * ra) / determinant)
            } else {
                (-alone(ra, aa), 0.0)
            };
            // Where the step leaves one curve, its end is kept and the other parameter follows it.
            if !(0.0..=self.last()).contains(&(u + du)) {
                du = (u + du).clamp(0.0, self.last()) - u;
                dv = alone(rb + ab * du, bb);
            }
            if !(0.0..=other.last()).contains(&(v + dv)) {
                dv = (v + dv).clamp(0.0, other.last()) - v;
                du = (u + alone(ab * dv - ra, aa)).clamp(0.0, self.last()) - u;
            }
            let (next_u, next_v) = (u + du, v + dv);
            let next = (self.at(next_u).0 - other.at(next_v).0).norm_squared();
            if next >= square {
                break;
            }
            (square, u, v) = (next, next_u, next_v);
        }
        square.sqrt()
    }

    /// The least distance of the curve to the convex hull of corners [m].
    fn distance_to_hull(&self, corners: &[Vector3<f64>]) -> f64 {
        const MAX_ITERATIONS: usize = 60;
        let at = |u: f64| {
            let (point, tangent) = self.at(u);
            Separation { way: way_to_hull(&point, corners), point, tangent }
        };
        let (mut least, mut nearest) = (f64::INFINITY, 0.0);
        let mut known: Vec<Separation> = Vec::new();
        // The platform is at the last point.
        for (k, p) in self.points.iter().enumerate().rev() {
            if known.iter().any(|separation| separation.bound(p) >= least) {
                continue;
            }
            let separation = at(k as f64);
            if separation.distance() < least {
                (least, nearest) = (separation.distance(), k as f64);
            }
            known.push(separation);
        }
        // The distance to a convex body has a slope, which tells on which side of a point it falls.
        let ends = [(nearest - 1.0).max(0.0), (nearest + 1.0).min(self.last())];
        let [mut low, mut high] = ends.map(|u| (u, at(u).slope()));
        for iteration in 0..MAX_ITERATIONS {
            if low.1 >= 0.0 || high.1 <= 0.0 {
                break;
            }
            let width = high.0 - low.0;
            let secant = low.0 + width * low.1 / (low.1 - high.1);
            let u = if iteration % 3 == 2 { low.0 + 0.5 * width } else { secant };
            let separation = at(u);
            let slope = separation.slope();
            least = least.min(separation.distance());
            // By no more than this it falls beside the point.
            if slope.abs() * width <= 1e-12 * separation.tangent.norm() {
                break;
            }
            *(if slope < 0.0 { &mut low } else { &mut high }) = (u, slope);
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(from: [f64; 3], to: [f64; 3]) -> Curve {
        let [from, to] = [from, to].map(Vector3::from);
        let point = |k: usize| from.lerp(&to, k as f64 / INTERVALS as f64);
        Curve { points: (0..=INTERVALS).map(point).collect(), sag: 0.0 }
    }

    #[test]
    fn lines_that_cross_have_the_distance_between_them() {
        let one = line([0.0, 0.0, 0.0], [2.0, 2.0, 0.0]);
        let cross = |z: f64| line([0.0, 2.0, z], [2.0, 0.0, z]);
        assert!(one.distance(&cross(0.0)) < 1e-12);
        assert!((one.distance(&cross(0.3)) - 0.3).abs() < 1e-12);
        // Nearest at an end.
        let beside = line([3.0, 2.0, 0.0], [5.0, 2.5, 1.0]);
        assert!((one.distance(&beside) - 1.0).abs() < 1e-12);
        // Parallel.
        let parallel = line([1.0, 1.0, 0.4], [3.0, 3.0, 0.4]);
        assert!((one.distance(&parallel) - 0.4).abs() < 1e-9);
    }

    #[test]
    fn a_parabola_is_met_between_its_points() {
        let point = |k: usize| {
            let x = k as f64 / INTERVALS as f64;
            Vector3::new(x, 0.0, x * (x - 1.0))
        };
        let hanging = Curve { points: (0..=INTERVALS).map(point).collect(), sag: 0.25 };
        let x: f64 = 0.37;
        let below = line([x, -1.0, x * (x - 1.0)], [x, 1.0, x * (x - 1.0)]);
        assert!(hanging.distance(&below) < 1e-9);
    }

    #[test]
    fn the_distance_of_a_cube_is_that_of_its_face_edge_or_corner() {
        let corners: Vec<_> = (0..8)
            .map(|k| Vector3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)))
            .collect();
        let distance = |p: [f64; 3]| way_to_hull(&p.into(), &corners).norm();
        assert!((distance([0.3, 0.4, 1.5]) - 0.5).abs() < 1e-12);
        assert!((distance([0.3, 4.0, 5.0]) - 5.0).abs() < 1e-12);
        assert!((distance([2.0, 3.0, 3.0]) - 3.0).abs() < 1e-12);
        assert_eq!(distance([0.2, 0.5, 0.6]), 0.0);
        let through = line([0.5, 0.5, 3.0], [0.5, 0.5, -1.0]);
        assert_eq!(through.distance_to_hull(&corners), 0.0);
        let past = line([1.5, 0.5, 3.0], [1.7, 0.5, -1.0]);
        // Nearest to the upper edge, at right angles to the line.
        assert!((past.distance_to_hull(&corners) - 2.4 / 16.04_f64.sqrt()).abs() < 1e-12);
        // Through an edge, between two points of the line.
        let chipped = line([0.3, 0.5, 1.69], [1.5, 0.5, 0.49]);
        assert_eq!(chipped.distance_to_hull(&corners), 0.0);
    }
}
