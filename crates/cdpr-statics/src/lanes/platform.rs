//! Platforms between their cables: their balance and their stiffness (S5).
//!
//! Each lane holds a robot, or a cable of one robot.

use crate::equations::{CablePlane, LinearizedCable};
use crate::lanes::cable::{FreeLength, LaneCable};
use crate::lanes::freedoms::{hold, hold_matrix};
use crate::lanes::load::PlatformLoad;
use crate::state::Residual;
use cdpr_number::Number;
use cdpr_number::dense::{Lanes3, Lanes6, Lanes6x6, SymmetricFactors, add, halves, replace};
use cdpr_number::lanes::{Lanes, MAX_LANES, Mask, Simd};
use cdpr_number::vector::{cross, dot};
use cdpr_number::{six, three};
use cdpr_robot::Freedoms;
use smallvec::{SmallVec, smallvec};
use std::array::from_fn;

/// What the lanes hold.
#[derive(Clone)]
pub(crate) enum Layout<S: Simd> {
    /// Each lane holds a robot.
    Robots,
    /// Each lane holds a cable of one robot. The mask says which lanes of the last [`LaneCable`] count; the
    /// others repeat a cable.
    Cables(Mask<S>),
}

/// Number of [`LaneCable`]s that are stored without allocation.
const INLINE: usize = 4;

/// Robots, in an equilibrium or near one.
#[derive(Clone)]
pub(crate) struct Robots<'a, S: Simd> {
    pub(crate) layout: Layout<S>,
    /// The motions that are free; what holds the others takes any wrench.
    pub(crate) freedoms: Freedoms,
    pub(crate) cables: SmallVec<[LaneCable<'a, S>; INLINE]>,
    /// Position of the platform [m].
    pub(crate) position: Lanes3<S>,
    /// R c, the lever of the centre of mass [m].
    pub(crate) center: Lanes3<S>,
    /// Other vectors that rotate with the platform.
    pub(crate) frame: SmallVec<[Lanes3<S>; 3]>,
    /// Weight of the platform [N].
    pub(crate) weight: Lanes<S>,
}

/// Lengths that positions are compared with [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    /// The longest cable.
    pub(crate) size: f64,
    /// The length that makes rotations comparable with translations.
    pub(crate) characteristic_length: f64,
    /// Rounding of a closure.
    pub(crate) rounding: f64,
}

/// Residual of the equations, one for each lane.
#[derive(Clone, Copy)]
pub(crate) struct LaneResidual<S: Simd> {
    /// Largest distance of a cable's end from its anchor point, squared [m²].
    pub(crate) closure: Lanes<S>,
    /// Unbalanced force [N] and moment [N m], with the sign of the potential's gradient: -G of (S4).
    pub(crate) wrench: Lanes6<S>,
}

impl<S: Simd> LaneResidual<S> {
    /// The norms in each lane.
    #[inline(always)]
    pub(crate) fn norms(&self) -> [Residual; MAX_LANES] {
        let (force, moment) = halves(&self.wrench);
        let (force, moment) =
            (dot(&force, &force).sqrt().to_array(), dot(&moment, &moment).sqrt().to_array());
        let closure = self.closure.sqrt().to_array();
        from_fn(|lane| Residual { closure: closure[lane], force: force[lane], moment: moment[lane] })
    }
}

/// The platform between linearized cables.
pub(crate) struct LinearizedPlatform<S: Simd> {
    pub(crate) cables: SmallVec<[LinearizedCable<Lanes<S>>; INLINE]>,
    /// The lengths beyond the leave points of all cables, of robots with guided ones.
    pub(crate) free: Vec<FreeLength<S>>,
    /// Gradient of the potential with the predicted forces.
    pub(crate) gradient: Lanes6<S>,
    /// Its derivative, factored.
    pub(crate) factored: SymmetricFactors<S>,
    /// The steps of the last search.
    pub(crate) steps: Steps<S>,
}

/// The steps (dp, ℓ dφ) of a search.
pub(crate) struct Steps<S: Simd> {
    /// Square of the first one, which the linearization at the start predicts [m²].
    pub(crate) first: Lanes<S>,
    /// The sum of all others [m].
    pub(crate) others: Lanes6<S>,
}

impl<S: Simd> LinearizedPlatform<S> {
    /// Storage for a linearized platform, all zero, of robots with plain cables.
    #[inline(always)]
    pub(crate) fn new(zero: Lanes<S>, cables: usize) -> Self {
        let cable = LinearizedCable {
            plane: CablePlane { azimuth: [zero; 2] },
            predicted: [zero; 2],
            stiffness: [zero; 3],
            lateral_stiffness: zero,
        };
        Self {
            cables: smallvec![cable; cables],
            free: Vec::new(),
            gradient: [zero; 6],
            factored: SymmetricFactors::new([[zero; 6]; 6]),
            steps: Steps { first: zero, others: [zero; 6] },
        }
    }

    /// Makes room for the lengths beyond leave points.
    #[inline(always)]
    pub(crate) fn follow_guides(&mut self, robots: &Robots<'_, S>) {
        if robots.cables.iter().any(|cable| cable.guided.is_some()) {
            self.free = vec![FreeLength::fixed(robots.weight.all(0.0)); robots.cables.len()];
        }
    }

    /// The lanes whose stiffness is positive definite.
    #[inline(always)]
    pub(crate) fn is_stable(&self) -> Mask<S> {
        self.factored.positive
    }
}

impl<S: Simd> Robots<'_, S> {
    /// Linearizes all cables in the lanes that are `going`, and puts the platform between them.
    #[inline(always)]
    pub(crate) fn linearize(
        &self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
        going: Mask<S>,
    ) {
        self.linearize_cables(platform, going);
        self.assemble(load, platform, going);
    }

    #[inline(always)]
    pub(crate) fn linearize_cables(&self, platform: &mut LinearizedPlatform<S>, going: Mask<S>) {
        for (i, (cable, linearized)) in self.cables.iter().zip(&mut platform.cables).enumerate() {
            if let Some(guided) = &cable.guided {
                guided.linearize(
                    cable,
                    &cable.span(&self.position),
                    linearized,
                    &mut platform.free[i],
                    going,
                );
                continue;
            }
            let span = cable.span(&self.position);
            let response = cable.response();
            linearized.replace(&LinearizedCable::new(&span, cable.force, &response), going);
        }
    }

    /// The upper triangle of the stiffness here (S5), after linearizing all cables; one on the diagonal
    /// for motions that are held.
    #[inline(always)]
    pub(crate) fn stiffness(
        &self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
    ) -> Lanes6x6<S> {
        self.linearize_cables(platform, load.weight.less_or_equal(load.weight));
        let (_, hessian) = self.balance(load, platform);
        hessian
    }

    /// Puts the platform between its linearized cables in the lanes that are `going`.
    #[inline(always)]
    pub(crate) fn assemble(
        &self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
        going: Mask<S>,
    ) {
        let (gradient, hessian) = self.balance(load, platform);
        replace(&mut platform.gradient, &gradient, going);
        platform.factored.replace(&SymmetricFactors::new(hessian), going);
    }

    /// Gradient of the potential with the predicted forces, and the upper triangle of its derivative, which
    /// has one on the diagonal for motions that are held.
    ///
    /// Where moments are out of balance the derivative of the gradient is not symmetric. The skew part is
    /// dropped: it is proportional to the residual moment, which vanishes at equilibrium, and that under a
    /// moment takes part in the steps.
    // Indices as in the formula.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    pub(crate) fn balance(
        &self,
        load: &PlatformLoad<S>,
        platform: &LinearizedPlatform<S>,
    ) -> (Lanes6<S>, Lanes6x6<S>) {
        let zero = self.weight.all(0.0);
        let (mut gradient, mut hessian) = ([zero; 6], [[zero; 6]; 6]);
        for (i, (cable, linearized)) in self.cables.iter().zip(&platform.cables).enumerate() {
            let counted = LinearizedCable {
                plane: linearized.plane,
                predicted: [
                    self.counted(i, linearized.predicted[0]),
                    self.counted(i, linearized.predicted[1]),
                ],
                stiffness: three!(|j| self.counted(i, linearized.stiffness[j])),
                lateral_stiffness: self.counted(i, linearized.lateral_stiffness),
            };
            // -F_i
            let force = counted.plane.lift(counted.predicted);
            add(&mut gradient, &cable.anchor_arm, &force);
            add_stiffness(&mut hessian, &cable.anchor_arm, &force, &counted.stiffness_in_space());
        }
        if let Layout::Cables(_) = self.layout {
            for row in 0..6 {
                gradient[row] = self.total(gradient[row]);
                for column in row..6 {
                    hessian[row][column] = self.total(hessian[row][column]);
                }
            }
        }
        // Weight is vertical and acts at the centre of mass.
        let [cx, cy, cz] = self.center;
        hessian[3][3] -= load.weight * cz;
        hessian[4][4] -= load.weight * cz;
        hessian[3][5] += load.weight * cx * 0.5;
        hessian[4][5] += load.weight * cy * 0.5;
        let wrench = load.wrench(&self.center);
        let gradient = hold(self.freedoms, six!(|k| gradient[k] - wrench[k]));
        hold_matrix(self.freedoms, &mut hessian, zero + 1.0);
        (gradient, hessian)
    }

    /// The value in the lanes of cable `i` that count, zero in the others.
    #[inline(always)]
    pub(crate) fn counted(&self, i: usize, value: Lanes<S>) -> Lanes<S> {
        match self.layout {
            Layout::Cables(last) if i + 1 == self.cables.len() => last.select(value, value.all(0.0)),
            _ => value,
        }
    }

    /// The sum over all cables of a robot, from the sums of its lanes.
    #[inline(always)]
    pub(crate) fn total(&self, sum: Lanes<S>) -> Lanes<S> {
        match self.layout {
            Layout::Robots => sum,
            Layout::Cables(_) => {
                let mut total = 0.0;
                for lane in sum.to_array() {
                    total += lane;
                }
                sum.all(total)
            }
        }
    }

    /// The largest value of all cables of a robot.
    #[inline(always)]
    pub(crate) fn largest(&self, value: Lanes<S>) -> Lanes<S> {
        match self.layout {
            Layout::Robots => value,
            Layout::Cables(_) => {
                let mut largest = 0.0;
                for lane in value.to_array() {
                    largest = f64::max(largest, lane);
                }
                value.all(largest)
            }
        }
    }
}

/// Adds a cable with the stiffness K3 and the force -F_i = `f` at the arm s to the upper triangle of the
/// stiffness, equation (S5).
#[inline(always)]
fn add_stiffness<S: Simd>(hessian: &mut Lanes6x6<S>, s: &Lanes3<S>, f: &Lanes3<S>, k: &[Lanes3<S>; 3]) {
    let [sx, sy, sz] = *s;
    // K [s], row by row: k x s.
    let ks = [cross(&k[0], s), cross(&k[1], s), cross(&k[2], s)];
    for row in 0..3 {
        for column in 0..3 {
            hessian[row][3 + column] -= ks[row][column];
        }
        for column in row..3 {
            hessian[row][column] += k[row][column];
            // [s] K [s], column by column: s x K [s].
            let swung = match row {
                0 => sy * ks[2][column] - sz * ks[1][column],
                1 => sz * ks[0][column] - sx * ks[2][column],
                _ => sx * ks[1][column] - sy * ks[0][column],
            };
            hessian[3 + row][3 + column] -= swung;
        }
    }
    // The symmetric part of s fᵀ - (s·f) 1.
    let (x, y, z) = (sx * f[0], sy * f[1], sz * f[2]);
    hessian[3][3] -= y + z;
    hessian[4][4] -= x + z;
    hessian[5][5] -= x + y;
    let half = three!(|j| s[j] * 0.5);
    hessian[3][4] += half[0] * f[1] + half[1] * f[0];
    hessian[3][5] += half[0] * f[2] + half[2] * f[0];
    hessian[4][5] += half[1] * f[2] + half[2] * f[1];
}
