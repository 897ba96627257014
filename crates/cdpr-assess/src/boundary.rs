//! The boundary of a region of positions: polygons in a plane, a mesh of triangles in a box.
//!
//! The grid is cut into simplices along the diagonals of its cells (Freudenthal), triangles in a plane and
//! tetrahedra in a box. Where a simplex has positions of both kinds, the boundary crosses its edges, and each
//! crossing is found by bisection (marching simplices: Allgower, Gnutzmann, *Simplicial pivoting for mesh
//! generation of implicitly defined surfaces*, Computer Aided Geometric Design 8, 1991). Then every edge of
//! the boundary is divided, and its middle moved at right angles to where the region ends, which is near as a
//! rule and looked for nearby first. A denser grid is
//! not needed for that; what is smaller than a cell of the grid, a hole or an island, is not seen. How much
//! that may be is shown by the centres of the cells and by a grid of every second position. The region is
//! taken to end where the grid does.
//!
//! Area A and volume V follow from the closed boundary,
//!
//! ```text
//! A = 1/2 sum p x q  over its segments pq,      V = 1/6 sum p·(q x r)  over its triangles pqr       (W4)
//! ```
//!
//! with the region on the left of a segment and behind a triangle. The last division changes them by more
//! than what is left to divide, if the boundary is smooth; that change and what the bisection leaves open is
//! the estimate of the error.

mod mesh;
mod region;

use crate::boundary::mesh::Mesh;
use crate::boundary::region::{Node, Region};
use cdpr_robot::Vector3;
use cdpr_study::StudyError;
use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The boundary of a region of positions.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// Area [m²] in a plane, volume [m³] in a box.
    pub measure: f64,
    /// Estimate of its error where the boundary is smooth over a step of the grid [m², m³].
    pub error: f64,
    /// Measure that is in doubt, since parts thinner than a step of the grid are not seen [m², m³]: what a
    /// grid of every second position changes, and the cells whose centre is not as a diagonal's two ends.
    pub doubtful: f64,
    /// Closed polygons [m], the region on their left; none in a box.
    pub polygons: Vec<Vec<Vector3<f64>>>,
    /// Triangles [m], the region behind them; none in a plane.
    pub triangles: Vec<[Vector3<f64>; 3]>,
    /// Positions that were asked for, those of the grid included.
    pub evaluations: usize,
}

impl Boundary {
    /// The triangles as a binary STL file, in metres.
    pub fn stl(&self) -> Vec<u8> {
        let mut file = vec![0; 80];
        file.extend((self.triangles.len() as u32).to_le_bytes());
        for [p, q, r] in &self.triangles {
            let normal = (q - p).cross(&(r - p)).try_normalize(0.0).unwrap_or_else(Vector3::zeros);
            for number in [&normal, p, q, r].into_iter().flat_map(|vector| vector.iter()) {
                file.extend((*number as f32).to_le_bytes());
            }
            file.extend([0; 2]);
        }
        file
    }

    /// The triangles of a binary STL file [m], as [`Boundary::stl`] writes it; `None` for another text.
    pub(crate) fn triangles_of(stl: &[u8]) -> Option<Vec<[Vector3<f64>; 3]>> {
        let (head, rest) = stl.split_at_checked(84)?;
        let count = u32::from_le_bytes(head[80..].try_into().ok()?) as usize;
        let of_face = |face: &[u8]| {
            let numbers = face[12..48].chunks_exact(4).map(|bytes| bytes.try_into().map(f32::from_le_bytes));
            let numbers: Vec<f64> =
                numbers.map(|number| number.map(f64::from)).collect::<Result<_, _>>().ok()?;
            numbers
                .iter()
                .all(|number| number.is_finite())
                .then(|| [0, 3, 6].map(|k| Vector3::new(numbers[k], numbers[k + 1], numbers[k + 2])))
        };
        if rest.len() == 50 * count { rest.chunks_exact(50).map(of_face).collect() } else { None }
    }
}

/// Bisections of a crossing.
const BISECTIONS: i32 = 12;

/// How often edges are divided, in a plane and in a box.
const DIVISIONS: [usize; 2] = [3, 1];

/// The boundary of the positions that `inside` is true of, within the grid of these coordinates [m]. `stop`
/// ends the search.
///
/// # Errors
/// [`StudyError::Setting`] for a grid that is neither a plane nor a box; [`StudyError::Stopped`].
pub(crate) fn boundary(
    coordinates: &[Vec<f64>; 3],
    inside: &(dyn Fn(&Vector3<f64>) -> bool + Sync),
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Boundary, StudyError> {
    let axes: Vec<usize> = (0..3).filter(|k| coordinates[*k].len() > 1).collect();
    if axes.len() < 2 {
        let points = coordinates.each_ref().map(Vec::len);
        let expected = "a plane or a box, with two points or more along two axes or three";
        return Err(StudyError::setting("grid", format!("{points:?} points"), expected));
    }
    let asked = AtomicUsize::new(0);
    let ends = coordinates.each_ref().map(|axis| [axis[0], axis[axis.len() - 1]]);
    let spacing = axes.iter().map(|k| (ends[*k][1] - ends[*k][0]) / (coordinates[*k].len() - 1) as f64);
    let accuracy = spacing.fold(0.0, f64::max) * 0.5_f64.powi(BISECTIONS);
    let inside = |position: &Vector3<f64>| {
        let within = (0..3).all(|k| ends[k][0] <= position[k] && position[k] <= ends[k][1]);
        if !within || stop() {
            return false;
        }
        asked.fetch_add(1, Ordering::Relaxed);
        inside(position)
    };
    let region = Region { coordinates, accuracy, axes: &axes, inside: &inside };
    let held = region.held();
    let (mesh, [before, measure]) = divided(&region, &held);
    let halved = coordinates.each_ref().map(|axis| every_second(axis));
    let every_second = Region { coordinates: &halved, ..region };
    let (_, [_, coarse]) = divided(&every_second, &every_second.held());
    let doubtful = (measure - coarse).abs() + region.unlike_centres(&held);
    if stop() {
        return Err(StudyError::Stopped);
    }
    Ok(Boundary {
        measure,
        error: (measure - before).abs() + 0.5 * accuracy * mesh.size(),
        doubtful,
        polygons: if axes.len() == 2 { mesh.polygons() } else { Vec::new() },
        triangles: if axes.len() == 3 { mesh.triangles() } else { Vec::new() },
        evaluations: asked.into_inner(),
    })
}

/// The mesh with all its edges divided, and its measures before and after the last division.
fn divided(region: &Region, held: &HashMap<Node, bool>) -> (Mesh, [f64; 2]) {
    let mut mesh = region.mesh(held);
    let mut measures = [mesh.measure(region.axes); 2];
    for _ in 0..DIVISIONS[region.axes.len() - 2] {
        mesh = region.divided(&mesh);
        measures = [measures[1], mesh.measure(region.axes)];
    }
    (mesh, measures)
}

/// Every second coordinate of an axis, and its last one.
fn every_second(axis: &[f64]) -> Vec<f64> {
    let last = axis.len() - 1;
    (0..=last).filter(|k| k % 2 == 0 || *k == last).map(|k| axis[k]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn axis(min: f64, max: f64, points: usize) -> Vec<f64> {
        (0..points).map(|k| min + (max - min) * k as f64 / (points - 1) as f64).collect()
    }

    fn of(coordinates: [Vec<f64>; 3], inside: impl Fn(&Vector3<f64>) -> bool + Sync) -> Boundary {
        boundary(&coordinates, &inside, &|| false).unwrap()
    }

    #[test]
    fn the_area_of_a_ring_and_the_volume_of_a_ball_are_within_their_errors() {
        let plane = [axis(-1.2, 1.1, 12), vec![0.5], axis(-1.3, 1.2, 13)];
        let ring = of(plane, |p| (0.5..1.0).contains(&p.xz().norm()));
        let exact = 0.75 * PI;
        println!("{} of {exact}, error {}", ring.measure, ring.error);
        assert!((ring.measure - exact).abs() < ring.error && ring.error < 2e-3 * exact);
        assert_eq!(ring.polygons.len(), 2);
        assert!(ring.polygons.iter().flatten().all(|p| p.y == 0.5));

        let space = [axis(-1.2, 1.1, 10), axis(-1.1, 1.2, 10), axis(-1.3, 1.2, 10)];
        let ball = of(space, |p| p.norm() < 1.0);
        let exact = 4.0 / 3.0 * PI;
        println!("{} of {exact}, error {}", ball.measure, ball.error);
        assert!((ball.measure - exact).abs() < ball.error && ball.error < 0.05 * exact);
        let area: Vector3<f64> = ball.triangles.iter().map(|[p, q, r]| (q - p).cross(&(r - p))).sum();
        assert!(area.norm() < 1e-12, "the mesh is closed");
        let read = Boundary::triangles_of(&ball.stl()).unwrap();
        let ends = read.iter().flatten().zip(ball.triangles.iter().flatten());
        assert!(read.len() == ball.triangles.len() && ends.into_iter().all(|(p, q)| (p - q).norm() < 1e-6));
        assert!(
            Boundary::triangles_of(&ball.stl()[1..]).is_none() && Boundary::triangles_of(b"solid").is_none()
        );
    }

    /// A strip of 0.04 m on a grid of 0.1 m or 0.05 m: which positions are in it is chance.
    #[test]
    fn parts_thinner_than_a_step_are_doubtful() {
        let region = |p: &Vector3<f64>| p.x < 0.31 || (p.x + 0.37 * p.y - 0.9).abs() < 0.02;
        let plane = |points| of([axis(0.0, 1.0, points), axis(0.0, 1.0, points), vec![0.0]], region);
        let exact = 0.31 + 0.04;
        for points in [6, 11, 16, 21] {
            let found = plane(points);
            let wrong = (found.measure - exact).abs();
            println!(
                "{points}: {} of {exact}, error {}, doubtful {}",
                found.measure, found.error, found.doubtful
            );
            assert!(wrong < found.error + found.doubtful, "{points}");
        }
        assert!(plane(11).doubtful > 0.01);
        // Where all is thick there is no doubt.
        let wide = of([axis(0.0, 1.0, 11), axis(0.0, 1.0, 11), vec![0.0]], |p| p.x + 0.3 * p.y < 0.6);
        assert!(wide.doubtful < 1e-3 * wide.measure, "{}", wide.doubtful);
    }

    #[test]
    fn a_region_that_leaves_the_grid_ends_with_it() {
        let space = [axis(0.0, 1.0, 4), axis(0.0, 2.0, 5), axis(0.0, 3.0, 6)];
        let all = of(space, |_| true);
        assert!((all.measure - 6.0).abs() < 1e-12, "{}", all.measure);
        let plane = [axis(0.0, 1.0, 4), axis(0.0, 2.0, 5), vec![1.0]];
        let half = of(plane.clone(), |p| p.x + p.y < 1.5);
        assert!((half.measure - 1.0).abs() < half.error && half.error < 0.01, "{}", half.measure);
        let none = of(plane, |_| false);
        assert_eq!((none.measure, none.polygons.len()), (0.0, 0));
        assert!(none.measure.is_sign_positive(), "an empty region has the area 0, not -0");
    }
}
