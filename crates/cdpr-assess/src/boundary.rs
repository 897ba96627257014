//! The boundary of a region of positions: polygons in a plane, a mesh of triangles in a box.
//!
//! The grid is cut into simplices along the diagonals of its cells (Freudenthal), triangles in a plane and
//! tetrahedra in a box. Where a simplex has positions of both kinds, the boundary crosses its edges, and each
//! crossing is found by bisection (marching simplices: Allgower, Gnutzmann, *Simplicial pivoting for mesh
//! generation of implicitly defined surfaces*, Computer Aided Geometric Design 8, 1991). Then every edge of
//! the boundary is divided, and its middle moved at right angles to where the region ends, which is near as a
//! rule and looked for nearby first. A denser grid is
//! not needed for that; what is smaller than a cell of the grid, a hole or an island, is not seen. The region
//! is taken to end where the grid does.
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

use cdpr_robot::Vector3;
use cdpr_study::StudyError;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The boundary of a region of positions.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// Area [m²] in a plane, volume [m³] in a box.
    pub measure: f64,
    /// Estimate of its error [m², m³].
    pub error: f64,
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

/// How far the middle of an edge is moved at most, over its length: as far as a right-angled corner goes.
const REACH: f64 = 0.6;

/// Shares of that way within which the end of the region is looked for, one after the other.
const NEARER: [f64; 4] = [1.0 / 64.0, 1.0 / 16.0, 1.0 / 4.0, 1.0];

/// How often edges are divided, in a plane and in a box.
const DIVISIONS: [usize; 2] = [3, 1];

/// A place of the grid, or one step outside of it.
type Node = [i64; 3];

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
    let region = Region {
        coordinates,
        accuracy,
        axes: &axes,
        inside: &|position| {
            let within = (0..3).all(|k| ends[k][0] <= position[k] && position[k] <= ends[k][1]);
            if !within || stop() {
                return false;
            }
            asked.fetch_add(1, Ordering::Relaxed);
            inside(position)
        },
    };
    let mut mesh = region.mesh();
    let mut measures = vec![mesh.measure(&axes)];
    for _ in 0..DIVISIONS[axes.len() - 2] {
        mesh = region.divided(&mesh);
        measures.push(mesh.measure(&axes));
    }
    if stop() {
        return Err(StudyError::Stopped);
    }
    let [.., before, measure] = measures[..] else { return Err(StudyError::Stopped) };
    Ok(Boundary {
        measure,
        error: (measure - before).abs() + 0.5 * accuracy * mesh.size(),
        polygons: if axes.len() == 2 { mesh.polygons() } else { Vec::new() },
        triangles: if axes.len() == 3 { mesh.triangles() } else { Vec::new() },
        evaluations: asked.into_inner(),
    })
}

struct Region<'a> {
    coordinates: &'a [Vec<f64>; 3],
    /// Length at which a bisection ends [m].
    accuracy: f64,
    /// Axes with more than one point.
    axes: &'a [usize],
    inside: &'a (dyn Fn(&Vector3<f64>) -> bool + Sync),
}

/// Points and the faces between them: segments of a plane, triangles in space.
struct Mesh {
    points: Vec<Vector3<f64>>,
    faces: Vec<Vec<usize>>,
}

impl Region<'_> {
    /// The position of a node, or of the end of the grid that it lies beyond [m].
    fn position(&self, node: &Node) -> Vector3<f64> {
        let at = |k: usize| {
            let axis = &self.coordinates[k];
            axis[node[k].clamp(0, axis.len() as i64 - 1) as usize]
        };
        Vector3::new(at(0), at(1), at(2))
    }

    fn is_beyond(&self, node: &Node) -> bool {
        (0..3).any(|k| node[k] < 0 || node[k] >= self.coordinates[k].len() as i64)
    }

    fn clamped(&self, node: &Node) -> Node {
        std::array::from_fn(|k| node[k].clamp(0, self.coordinates[k].len() as i64 - 1))
    }

    /// Nodes from `first` to `last` of each axis beyond the grid.
    fn nodes(&self, first: i64, last: i64) -> Vec<Node> {
        let range = |k: usize| {
            let count = self.coordinates[k].len() as i64;
            if self.axes.contains(&k) { first..count + last } else { 0..1 }
        };
        let along = |i| range(1).flat_map(move |j| range(2).map(move |k| [i, j, k]));
        range(0).flat_map(along).collect()
    }

    /// The boundary between nodes of both kinds.
    fn mesh(&self) -> Mesh {
        let nodes = self.nodes(0, 0);
        let held: Vec<bool> = nodes.par_iter().map(|node| (self.inside)(&self.position(node))).collect();
        let held: HashMap<Node, bool> = nodes.into_iter().zip(held).collect();
        let is_inside = |node: &Node| held.get(node).copied().unwrap_or(false);
        let mut crossings: HashMap<[Node; 2], usize> = HashMap::new();
        let mut edges = Vec::new();
        let mut faces = Vec::new();
        for cell in self.nodes(-1, 0) {
            for simplex in self.simplices(cell) {
                let (ins, outs): (Vec<Node>, Vec<Node>) = simplex.into_iter().partition(is_inside);
                let pairs: Vec<[Node; 2]> = match (&ins[..], &outs[..]) {
                    (&[i, k], &[o, p]) => vec![[i, o], [i, p], [k, p], [k, o]],
                    _ => ins.iter().flat_map(|i| outs.iter().map(|o| [*i, *o])).collect(),
                };
                let of_pair = |pair: &[Node; 2]| {
                    *crossings.entry(*pair).or_insert_with(|| {
                        edges.push(*pair);
                        edges.len() - 1
                    })
                };
                let vertices: Vec<usize> = pairs.iter().map(of_pair).collect();
                for part in parts(vertices.len(), self.axes.len()) {
                    let middles = part.iter().map(|k| middle(&pairs[*k]));
                    let outwards = mean(&outs) - mean(&ins);
                    let mut face: Vec<usize> = part.iter().map(|k| vertices[*k]).collect();
                    if self.normal(&middles.collect::<Vec<_>>()).dot(&outwards) < 0.0 {
                        face.swap(0, 1);
                    }
                    faces.push(face);
                }
            }
        }
        let crossing = |[i, o]: &[Node; 2]| {
            let (from, to) = (self.position(i), self.position(o));
            // Beyond the grid the region ends; what is held up to its end is in it.
            if self.is_beyond(o) && is_inside(&self.clamped(o)) {
                return to;
            }
            self.last(from, to)
        };
        Mesh { points: edges.par_iter().map(crossing).collect(), faces }
    }

    /// Where the region ends on the way from a position inside to one outside.
    fn last(&self, inside: Vector3<f64>, outside: Vector3<f64>) -> Vector3<f64> {
        let (mut low, mut high) = (inside, outside);
        while (high - low).norm() > self.accuracy {
            let middle = 0.5 * (low + high);
            if (self.inside)(&middle) { low = middle } else { high = middle }
        }
        // At the end of the grid, the first position is the last.
        if low == inside { low } else { 0.5 * (low + high) }
    }

    /// The triangles or tetrahedra of a cell, whose first node is given.
    fn simplices(&self, cell: Node) -> Vec<Vec<Node>> {
        let orders: &[&[usize]] = match self.axes.len() {
            2 => &[&[0, 1], &[1, 0]],
            _ => &[&[0, 1, 2], &[0, 2, 1], &[1, 0, 2], &[1, 2, 0], &[2, 0, 1], &[2, 1, 0]],
        };
        let simplex = |order: &&[usize]| {
            let mut nodes = vec![cell];
            let mut node = cell;
            for k in *order {
                node[self.axes[*k]] += 1;
                nodes.push(node);
            }
            nodes
        };
        orders.iter().map(simplex).collect()
    }

    /// A vector at right angles to a face, on the right of a segment.
    fn normal(&self, face: &[Vector3<f64>]) -> Vector3<f64> {
        match face {
            [p, q, r] => (q - p).cross(&(r - p)),
            [p, q] => {
                let (along, mut normal) = (q - p, Vector3::zeros());
                normal[self.axes[0]] = along[self.axes[1]];
                normal[self.axes[1]] = -along[self.axes[0]];
                normal
            }
            _ => Vector3::zeros(),
        }
    }

    /// The mesh with every edge divided in its middle, which is moved to the end of the region.
    fn divided(&self, mesh: &Mesh) -> Mesh {
        let at = |face: &[usize]| face.iter().map(|k| mesh.points[*k]).collect::<Vec<_>>();
        let mut normals: BTreeMap<[usize; 2], Vector3<f64>> = BTreeMap::new();
        for face in &mesh.faces {
            let normal = self.normal(&at(face)).try_normalize(0.0).unwrap_or_else(Vector3::zeros);
            for edge in edges_of(face) {
                *normals.entry(edge).or_insert_with(Vector3::zeros) += normal;
            }
        }
        let moved = |([a, b], normal): (&[usize; 2], &Vector3<f64>)| {
            let [a, b] = [mesh.points[*a], mesh.points[*b]];
            self.moved(0.5 * (a + b), normal, REACH * (a - b).norm())
        };
        let edges: Vec<_> = normals.iter().collect();
        let middles: Vec<Vector3<f64>> = edges.into_par_iter().map(moved).collect();
        let first = mesh.points.len();
        let index: HashMap<[usize; 2], usize> =
            normals.keys().enumerate().map(|(k, edge)| (*edge, first + k)).collect();
        let faces = mesh.faces.iter().flat_map(|face| {
            let between = |a: usize, b: usize| index[&[a.min(b), a.max(b)]];
            match face[..] {
                [a, b] => vec![vec![a, between(a, b)], vec![between(a, b), b]],
                [a, b, c] => {
                    let (ab, bc, ca) = (between(a, b), between(b, c), between(c, a));
                    vec![vec![a, ab, ca], vec![ab, b, bc], vec![ca, bc, c], vec![ab, bc, ca]]
                }
                _ => Vec::new(),
            }
        });
        Mesh { faces: faces.collect(), points: mesh.points.iter().copied().chain(middles).collect() }
    }

    /// A point moved along a normal to where the region ends, at most by `reach` [m]; the point itself where
    /// it does not end so near.
    fn moved(&self, point: Vector3<f64>, normal: &Vector3<f64>, reach: f64) -> Vector3<f64> {
        let Some(normal) = normal.try_normalize(0.0) else { return point };
        let is_inside = (self.inside)(&point);
        let way = if is_inside { reach * normal } else { -reach * normal };
        let mut near = point;
        for share in NEARER {
            let far = point + share * way;
            if (self.inside)(&far) != is_inside {
                return if is_inside { self.last(near, far) } else { self.last(far, near) };
            }
            near = far;
        }
        point
    }
}

/// The faces between crossings of a simplex, which four of are a quadrilateral.
fn parts(crossings: usize, dimension: usize) -> Vec<Vec<usize>> {
    match (crossings, dimension) {
        (0, _) => Vec::new(),
        (4, 3) => vec![vec![0, 1, 2], vec![0, 2, 3]],
        (count, _) => vec![(0..count).collect()],
    }
}

fn mean(nodes: &[Node]) -> Vector3<f64> {
    let sum: Vector3<f64> = nodes.iter().map(place).sum();
    sum / nodes.len() as f64
}

fn middle([a, b]: &[Node; 2]) -> Vector3<f64> {
    0.5 * (place(a) + place(b))
}

/// A node in steps of the grid.
fn place(node: &Node) -> Vector3<f64> {
    Vector3::from(node.map(|k| k as f64))
}

/// The edges of a face, by ascending points; a segment is its own edge.
fn edges_of(face: &[usize]) -> Vec<[usize; 2]> {
    let next = |k: usize| face[(k + 1) % face.len()];
    let count = if face.len() == 2 { 1 } else { face.len() };
    (0..count).map(|k| [face[k].min(next(k)), face[k].max(next(k))]).collect()
}

impl Mesh {
    /// Area [m²] or volume [m³], (W4).
    fn measure(&self, axes: &[usize]) -> f64 {
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
        self.faces.iter().map(of_face).sum()
    }

    /// Length of the segments [m] or area of the triangles [m²].
    fn size(&self) -> f64 {
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

    fn triangles(&self) -> Vec<[Vector3<f64>; 3]> {
        let corners = self.faces.iter().map(|face| self.corners(face));
        corners.filter_map(|corners| <[Vector3<f64>; 3]>::try_from(corners).ok()).collect()
    }

    /// The segments as closed polygons.
    fn polygons(&self) -> Vec<Vec<Vector3<f64>>> {
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
    }
}
