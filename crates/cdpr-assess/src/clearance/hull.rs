//! The distance of a point from the convex hull of others.

use cdpr_robot::Vector3;
use cdpr_statics::DMatrix;

/// A point of a curve beside a convex body.
pub(super) struct Separation {
    pub(super) point: Vector3<f64>,
    /// Of the curve at the point, for a step of its parameter [m].
    pub(super) tangent: Vector3<f64>,
    /// From the point to the nearest one of the body [m]; zero inside.
    pub(super) way: Vector3<f64>,
}

impl Separation {
    pub(super) fn distance(&self) -> f64 {
        self.way.norm()
    }

    /// How the distance grows along the curve [m], for a step of its parameter.
    pub(super) fn slope(&self) -> f64 {
        self.along(&-self.tangent)
    }

    /// What no distance of a point `p` from the body falls below [m]: the body lies beyond the plane at right
    /// angles to the way.
    pub(super) fn bound(&self, p: &Vector3<f64>) -> f64 {
        self.distance() + self.along(&(self.point - p))
    }

    fn along(&self, v: &Vector3<f64>) -> f64 {
        if self.distance() > 0.0 { self.way.dot(v) / self.distance() } else { 0.0 }
    }
}

/// The way from a point to the nearest one of the convex hull of corners [m], zero inside.
pub(super) fn way_to_hull(point: &Vector3<f64>, corners: &[Vector3<f64>]) -> Vector3<f64> {
    const MAX_ITERATIONS: usize = 100;
    let corner = |k: usize| corners[k] - point;
    let size = corners.iter().map(|c| (c - point).norm_squared()).fold(0.0, f64::max);
    // Corners of a face that the nearest point lies on, with its shares of them.
    let nearest =
        (0..corners.len()).min_by(|a, b| corner(*a).norm_squared().total_cmp(&corner(*b).norm_squared()));
    let Some(nearest) = nearest else { return Vector3::repeat(f64::INFINITY) };
    let (mut face, mut shares) = (vec![nearest], vec![1.0]);
    let mut x = corner(nearest);
    for _ in 0..MAX_ITERATIONS {
        let along = |k: usize| x.dot(&corner(k));
        let Some(next) = (0..corners.len()).min_by(|a, b| along(*a).total_cmp(&along(*b))) else { break };
        if x.norm_squared() - along(next) <= 1e-14 * size || face.contains(&next) {
            break;
        }
        face.push(next);
        shares.push(0.0);
        loop {
            let Some(affine) = affine_minimum(&face.iter().map(|k| corner(*k)).collect::<Vec<_>>()) else {
                return x;
            };
            if affine.iter().all(|share| *share > 1e-12) {
                shares = affine;
                break;
            }
            let each = shares.iter().zip(&affine).filter(|(_, to)| **to <= 1e-12);
            let part = each.map(|(from, to)| from / (from - to)).fold(1.0, f64::min);
            shares.iter_mut().zip(&affine).for_each(|(share, to)| *share += part * (to - *share));
            let mut kept = shares.iter().map(|share| *share > 1e-12);
            face.retain(|_| kept.next().unwrap_or(false));
            shares.retain(|share| *share > 1e-12);
        }
        x = face.iter().zip(&shares).map(|(k, share)| corner(*k) * *share).sum();
    }
    if x.norm_squared() <= 1e-20 * size { Vector3::zeros() } else { x }
}

/// Shares, whose sum is one, of the point of least norm in the plane through points.
fn affine_minimum(points: &[Vector3<f64>]) -> Option<Vec<f64>> {
    let n = points.len();
    let scale = points.iter().map(Vector3::norm_squared).fold(f64::MIN_POSITIVE, f64::max);
    let gram = DMatrix::from_fn(n, n, |i, j| 1.0 + points[i].dot(&points[j]) / scale);
    let shares = gram.lu().solve(&DMatrix::from_element(n, 1, 1.0))?;
    let sum = shares.sum();
    Some(shares.iter().map(|share| share / sum).collect())
}
