//! Where a region on a grid ends: the mesh between positions of both kinds, and its divisions.

use crate::boundary::mesh::Mesh;
use cdpr_robot::Vector3;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};

/// How far the middle of an edge is moved at most, over its length: as far as a right-angled corner goes.
const REACH: f64 = 0.6;

/// Shares of that way within which the end of the region is looked for, one after the other.
const NEARER: [f64; 4] = [1.0 / 64.0, 1.0 / 16.0, 1.0 / 4.0, 1.0];

/// A place of the grid, or one step outside of it.
pub(super) type Node = [i64; 3];

/// A region of positions on a grid.
pub(super) struct Region<'a> {
    pub(super) coordinates: &'a [Vec<f64>; 3],
    /// Length at which a bisection ends [m].
    pub(super) accuracy: f64,
    /// Axes with more than one point.
    pub(super) axes: &'a [usize],
    pub(super) inside: &'a (dyn Fn(&Vector3<f64>) -> bool + Sync),
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

    /// Which nodes of the grid are inside.
    pub(super) fn held(&self) -> HashMap<Node, bool> {
        let nodes = self.nodes(0, 0);
        let held: Vec<bool> = nodes.par_iter().map(|node| (self.inside)(&self.position(node))).collect();
        nodes.into_iter().zip(held).collect()
    }

    /// The boundary between nodes of both kinds.
    pub(super) fn mesh(&self, held: &HashMap<Node, bool>) -> Mesh {
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

    /// Measure of the cells whose centre is not inside though both ends of a diagonal through it are, or the
    /// other way round: the region has parts there that the grid does not see. Of a half of space none is.
    pub(super) fn unlike_centres(&self, held: &HashMap<Node, bool>) -> f64 {
        let measure = |cell: &Node| {
            let end: Node = std::array::from_fn(|k| cell[k] + i64::from(self.axes.contains(&k)));
            let (from, to) = (self.position(cell), self.position(&end));
            let is_inside = held[cell];
            let is_unlike = held[&end] == is_inside && (self.inside)(&(0.5 * (from + to))) != is_inside;
            if is_unlike { self.axes.iter().map(|k| to[*k] - from[*k]).product() } else { 0.0 }
        };
        let cells = self.nodes(0, -1);
        let measures: Vec<f64> = cells.par_iter().map(measure).collect();
        measures.iter().sum()
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
    pub(super) fn divided(&self, mesh: &Mesh) -> Mesh {
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
