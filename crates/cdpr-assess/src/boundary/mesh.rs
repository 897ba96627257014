//! Segments and triangles between points, and what they enclose.

use cdpr_robot::Vector3;
use std::collections::BTreeMap;

/// Points and the faces between them: segments of a plane, triangles in space.
pub(super) struct Mesh {
    pub(super) points: Vec<Vector3<f64>>,
    pub(super) faces: Vec<Vec<usize>>,
}

impl Mesh {
    /// Area [m²] or volume [m³], (W4).
    pub(super) fn measure(&self, axes: &[usize]) -> f64 {
        // Near the mesh rounding is least.
        let origin = self.points.first().copied().unwrap_or_else(Vector3::zeros);
        let of_face = |face: &Vec<usize>| match self.corners(face)[..] {
            [p, q] => {
                let (p, q) = (p - origin, q - origin);
                0.5 * (p[axes[0]] * q[axes[1]] - p[axes[1]] * q[axes[0]])
            }
            [p, q, r] => (p - origin).dot(&(q - origin).cross(&(r - origin))) / 6.0,
            _ => 0.0,
        };
        self.faces.iter().map(of_face).sum::<f64>() + 0.0
    }

    /// Length of the segments [m] or area of the triangles [m²].
    pub(super) fn size(&self) -> f64 {
        let of_face = |face: &Vec<usize>| match self.corners(face)[..] {
            [p, q] => (q - p).norm(),
            [p, q, r] => 0.5 * (q - p).cross(&(r - p)).norm(),
            _ => 0.0,
        };
        self.faces.iter().map(of_face).sum()
    }

    fn corners(&self, face: &[usize]) -> Vec<Vector3<f64>> {
        face.iter().map(|k| self.points[*k]).collect()
    }

    pub(super) fn triangles(&self) -> Vec<[Vector3<f64>; 3]> {
        let corners = self.faces.iter().map(|face| self.corners(face));
        corners.filter_map(|corners| <[Vector3<f64>; 3]>::try_from(corners).ok()).collect()
    }

    /// The segments as closed polygons.
    pub(super) fn polygons(&self) -> Vec<Vec<Vector3<f64>>> {
        let mut next: BTreeMap<usize, usize> = self.faces.iter().map(|face| (face[0], face[1])).collect();
        let mut polygons = Vec::new();
        while let Some((first, mut at)) = next.pop_first() {
            let mut polygon = vec![self.points[first]];
            while at != first {
                polygon.push(self.points[at]);
                let Some(after) = next.remove(&at) else { break };
                at = after;
            }
            polygons.push(polygon);
        }
        polygons
    }
}
