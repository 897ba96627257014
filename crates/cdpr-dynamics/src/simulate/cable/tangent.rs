//! The matrices of one cable for Newton's method.

use super::{CableInMotion, Instant, Start};
use crate::simulate::band::Band;
use crate::simulate::lead::Lead;
use cdpr_robot::{Matrix3, Vector3, Vector6};

/// Matrices of one cable: of its own unknowns, and with the motions of the platform.
#[derive(Clone, Debug)]
pub(crate) struct CableMatrices {
    pub(crate) first: usize,
    pub(crate) mass: Vec<f64>,
    pub(crate) stiffness: Band<f64>,
    pub(crate) damping: Band<f64>,
    pub(crate) is_damped: bool,
    pub(crate) coupling: Vec<[Vector6<f64>; 2]>,
    /// The first unknown that is coupled.
    pub(crate) coupled: usize,
}

impl CableInMotion<'_> {
    /// Matrices about an instant, and stiffness and damping at the anchor point.
    pub(crate) fn matrices(
        &self,
        at: &Instant,
        lever: &Vector3<f64>,
        own: [&[f64]; 2],
    ) -> (CableMatrices, [Matrix3<f64>; 2]) {
        let size = self.size();
        let degree = self.mesh.as_ref().map_or(0, |mesh| mesh.rule.degree);
        let width = (3 * degree + 2).min(size.max(1) - 1);
        let mut matrices = CableMatrices {
            first: self.first,
            mass: vec![0.0; size],
            stiffness: Band::zeros(size, width),
            damping: Band::zeros(size, width),
            is_damped: self.material.damping > 0.0,
            coupling: vec![[Vector6::zeros(); 2]; size],
            coupled: size,
        };
        let mut at_end = [Matrix3::zeros(); 2];
        let Some(mesh) = &self.mesh else {
            if let Some(pull) = at.forces.pulls.first() {
                let across = at.way.map_or(at.length.0 * pull.stretch, |way| way.free);
                at_end = [pull.stiffness(at.length.0, across), pull.damping(at.length.0)];
            }
            return (matrices, at_end);
        };
        let points = at.points.positions.len();
        let columns: Vec<Columns> = (0..points).map(|point| self.columns(at, point, points)).collect();
        for (point, columns) in columns.iter().enumerate().take(points - 1) {
            if let Columns::Own(unknowns) = columns {
                unknowns.iter().for_each(|(unknown, _)| matrices.mass[*unknown] = at.forces.masses[point]);
            }
        }
        if let Start::Led(lead) = &self.start {
            self.add_lead(lead, at, own, &mut matrices);
        }
        let arm = lever.cross_matrix();
        let pulls = at.forces.pulls.chunks_exact(mesh.rule.pulls.len());
        for (part, pulls) in mesh.parts(at.length.0).zip(pulls) {
            for a in 0..=degree {
                for b in 0..=degree {
                    let blocks = || part.blocks(&mesh.rule, pulls, [a, b]);
                    match (&columns[part.first + a], &columns[part.first + b]) {
                        (Columns::Own(rows), Columns::Own(columns)) if b <= a || part.first + a == 0 => {
                            let [stiffness, damping] = blocks();
                            for (i, along) in rows {
                                for (j, other) in columns {
                                    matrices.stiffness.add(*i, *j, along.dot(&(stiffness * other)));
                                    matrices.damping.add(*i, *j, along.dot(&(damping * other)));
                                }
                            }
                        }
                        (Columns::Own(rows), Columns::Platform) => {
                            let blocks = blocks();
                            for (i, along) in rows {
                                matrices.coupled = matrices.coupled.min(*i);
                                for (coupling, block) in matrices.coupling[*i].iter_mut().zip(&blocks) {
                                    let pull = block.tr_mul(along);
                                    let moment = -arm.tr_mul(&pull);
                                    let both = [pull.x, pull.y, pull.z, moment.x, moment.y, moment.z];
                                    *coupling += Vector6::from(both);
                                }
                            }
                        }
                        (Columns::Platform, Columns::Platform) => {
                            let blocks = blocks();
                            (0..2).for_each(|k| at_end[k] += blocks[k]);
                        }
                        _ => {}
                    }
                }
            }
        }
        (matrices, at_end)
    }

    /// Adds the mass, the stiffness and the damping of a lead, and those of its wheel.
    fn add_lead(&self, lead: &Lead, at: &Instant, own: [&[f64]; 2], matrices: &mut CableMatrices) {
        matrices.mass[0] = self.of_lead(lead, at, own)[0];
        let (_, [stiffness, damping]) = lead.pull(&self.material, own[0][0], own[1][0]);
        matrices.stiffness.add(0, 0, stiffness);
        matrices.damping.add(0, 0, damping);
        let (Some(way), true) = (&at.way, self.has_next()) else { return };
        let (bending, swivelling) = lead.bending(way, own[0][0], &at.forces.forces[0]);
        let next = self.of_start();
        for (i, j) in (0..3).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            matrices.stiffness.add(next + i, next + j, bending[(i, j)]);
        }
        for (j, stiffness) in swivelling.into_iter().flatten().enumerate() {
            matrices.stiffness.add(1, j, stiffness);
        }
    }

    /// The unknowns that move a point.
    fn columns(&self, at: &Instant, point: usize, points: usize) -> Columns {
        if point + 1 == points {
            return Columns::Platform;
        }
        let (at_start, axes) = (self.of_start(), [Vector3::x(), Vector3::y(), Vector3::z()]);
        match (&self.start, &at.way) {
            (Start::Fixed(_), _) if point == 0 => Columns::Fixed,
            (Start::Led(_), Some(way)) if point == 0 => {
                let swivelling = at.swivelling.map(|swivelling| (1, swivelling));
                let turning = (0..3).map(|k| (at_start + k, at.turning.column(k).into_owned()));
                let turning = turning.take(if self.has_next() { 3 } else { 0 });
                let own = std::iter::once((0, way.direction)).chain(swivelling);
                Columns::Own(own.chain(turning).collect())
            }
            (Start::Loose, _) if point == 0 => Columns::Own((0..3).map(|k| (k, axes[k])).collect()),
            _ => Columns::Own((0..3).map(|k| (at_start + 3 * (point - 1) + k, axes[k])).collect()),
        }
    }
}

/// The unknowns that move a point, each with its direction.
enum Columns {
    Fixed,
    Platform,
    Own(Vec<(usize, Vector3<f64>)>),
}
