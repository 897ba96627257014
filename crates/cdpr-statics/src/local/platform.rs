//! Platforms between their cables: their balance and their stiffness (S5).
//!
//! Each lane has a robot, or a cable of one robot.

use crate::equations::{CablePlane, LinearizedCable, add_stiffness};
use crate::local::cable::LaneCable;
use crate::local::freedoms::{constrain, constrain_matrix};
use crate::local::guided::{FreeLength, GuidedLinearization, linearize_guided};
use crate::local::load::PlatformLoad;
use crate::local::swivel::Swivel;
use crate::state::Residual;
use cdpr_number::dense::{Lanes3, Lanes6, Lanes6x6, SymmetricFactors, add, halves, replace};
use cdpr_number::lanes::{Lanes, MAX_LANES, Mask, Simd};
use cdpr_number::vector::dot;
use cdpr_number::{Lanewise, Number};
use cdpr_number::{six, three};
use cdpr_robot::Freedoms;
use smallvec::{SmallVec, smallvec};
use std::array::from_fn;

/// What the lanes have.
#[derive(Clone)]
pub(crate) enum Layout<S: Simd> {
    /// Each lane has a robot.
    Robots,
    /// Each lane has a cable of one robot. The mask says which lanes of the last [`LaneCable`] count; the
    /// others repeat a cable.
    Cables(Mask<S>),
}

/// Number of [`LaneCable`]s that are stored without allocation. Processors other than x86-64 have one or two
/// lanes, and then more of these.
const INLINE: usize = if cfg!(target_arch = "x86_64") { 4 } else { 16 };

/// Robots, in an equilibrium or near one.
#[derive(Clone)]
pub(crate) struct Robots<'a, S: Simd> {
    pub(crate) layout: Layout<S>,
    /// The motions that are free; what constrains the others takes any wrench.
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
    pub(crate) free: SmallVec<[FreeLength<S>; INLINE]>,
    /// Forces across the planes of all cables, of robots with tilted axes.
    pub(crate) swivels: SmallVec<[Swivel<S>; INLINE]>,
    /// Gradient of the potential with the predicted forces.
    pub(crate) gradient: Lanes6<S>,
    /// Its derivative, factored.
    pub(crate) factored: SymmetricFactors<S>,
    /// The steps of the last search.
    pub(crate) steps: Steps<S>,
}

/// The steps (dp, ℓ dφ) of a search.
pub(crate) struct Steps<S: Simd> {
    /// The number of steps.
    pub(crate) count: usize,
    /// The first one, which the linearization at the start predicts [m].
    pub(crate) first: Lanes6<S>,
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
            free: SmallVec::new(),
            swivels: SmallVec::new(),
            gradient: [zero; 6],
            factored: SymmetricFactors::new([[zero; 6]; 6]),
            steps: Steps { count: 0, first: [zero; 6], others: [zero; 6] },
        }
    }

    /// Makes room for the lengths beyond leave points, and for the forces across planes.
    #[inline(always)]
    pub(crate) fn follow_guides(&mut self, robots: &Robots<'_, S>) {
        let (zero, cables) = (robots.weight.all(0.0), robots.cables.len());
        if robots.cables.iter().any(|cable| cable.guided.is_some()) {
            self.free = smallvec![FreeLength::fixed(zero); cables];
        }
        if robots.cables.iter().any(LaneCable::is_tilted) {
            self.swivels = smallvec![Swivel::none(zero); cables];
        }
    }

    /// The lanes whose stiffness is positive definite.
    #[inline(always)]
    pub(crate) fn is_stable(&self) -> Mask<S> {
        self.factored.positive
    }
}

impl<S: Simd> Robots<'_, S> {
    /// Linearizes all cables in the lanes that are `active`, and puts the platform between them.
    #[inline(always)]
    pub(crate) fn linearize(
        &self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
        active: Mask<S>,
    ) {
        self.linearize_cables(platform, active);
        self.assemble(load, platform, active);
    }

    #[inline(always)]
    pub(crate) fn linearize_cables(&self, platform: &mut LinearizedPlatform<S>, active: Mask<S>) {
        for (i, (cable, linearized)) in self.cables.iter().zip(&mut platform.cables).enumerate() {
            let span = cable.span(&self.position);
            if let Some(guided) = &cable.guided {
                let (free, swivel) = (&mut platform.free[i], platform.swivels.get_mut(i));
                let places = GuidedLinearization { cable: linearized, free, swivel };
                linearize_guided(guided, cable.free(), span, places, active);
                continue;
            }
            let response = cable.response();
            linearized.replace(&LinearizedCable::new(&span, cable.force, &response), active);
        }
    }

    /// The upper triangle of the stiffness here (S5), after linearizing all cables; one on the diagonal
    /// for constrained motions.
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

    /// Puts the platform between its linearized cables in the lanes that are `active`.
    #[inline(always)]
    pub(crate) fn assemble(
        &self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
        active: Mask<S>,
    ) {
        let (gradient, hessian) = self.balance(load, platform);
        replace(&mut platform.gradient, &gradient, active);
        platform.factored.replace(&SymmetricFactors::new(hessian), active);
    }

    /// Gradient of the potential with the predicted forces, and the upper triangle of its derivative, whose
    /// moments turn with the forces as they are: these of stiff cables are far from their prediction. It has
    /// one on the diagonal for constrained motions.
    ///
    /// Where moments are out of balance the derivative of the gradient is not symmetric. The skew part is
    /// dropped: it is proportional to the residual moment, which vanishes at equilibrium, and that under a
    /// moment takes part in the steps.
    #[inline(always)]
    pub(crate) fn balance(
        &self,
        load: &PlatformLoad<S>,
        platform: &LinearizedPlatform<S>,
    ) -> (Lanes6<S>, Lanes6x6<S>) {
        let zero = self.weight.all(0.0);
        let (mut gradient, mut hessian) = ([zero; 6], [[zero; 6]; 6]);
        let stride = self.stride();
        for first in 0..stride {
            let (mut forces, mut stiffness) = ([zero; 6], [[zero; 6]; 6]);
            let mut i = first;
            while i < self.cables.len() {
                self.add_cable(i, platform, &mut forces, &mut stiffness);
                i += stride;
            }
            for row in 0..6 {
                gradient[row] = self.total(first, gradient[row], forces[row]);
                for column in row..6 {
                    hessian[row][column] = self.total(first, hessian[row][column], stiffness[row][column]);
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
        let gradient = constrain(self.freedoms, six!(|k| gradient[k] - wrench[k]));
        constrain_matrix(self.freedoms, &mut hessian, zero + 1.0);
        (gradient, hessian)
    }

    /// Adds -F_i of a cable as predicted with its moment, and its stiffness, (S5).
    #[inline(always)]
    fn add_cable(
        &self,
        i: usize,
        platform: &LinearizedPlatform<S>,
        forces: &mut Lanes6<S>,
        stiffness: &mut Lanes6x6<S>,
    ) {
        let (arm, linearized) = (&self.cables[i].anchor_arm, &platform.cables[i]);
        let counted = LinearizedCable {
            plane: linearized.plane,
            predicted: [self.counted(i, linearized.predicted[0]), self.counted(i, linearized.predicted[1])],
            stiffness: three!(|j| self.counted(i, linearized.stiffness[j])),
            lateral_stiffness: self.counted(i, linearized.lateral_stiffness),
        };
        // -F_i
        let mut force = counted.plane.lift(counted.predicted);
        let mut in_space = counted.stiffness_in_space();
        if let Some(swivel) = platform.swivels.get(i) {
            let [along, upwards] = swivel.stiffness;
            let swivel = Swivel {
                predicted: self.counted(i, swivel.predicted),
                stiffness: [self.counted(i, along), self.counted(i, upwards)],
                ..*swivel
            };
            swivel.add_to(&counted.plane, &mut force, &mut in_space);
        }
        add(forces, arm, &force);
        let [x, z] = self.cables[i].force;
        let now = counted.plane.lift([self.counted(i, x), self.counted(i, z)]);
        add_stiffness(stiffness, arm, &now, &in_space);
    }

    /// The value in the lanes of cable `i` that count, zero in the others.
    #[inline(always)]
    pub(crate) fn counted(&self, i: usize, value: Lanes<S>) -> Lanes<S> {
        match self.layout {
            Layout::Cables(last) if i + 1 == self.cables.len() => last.select(value, value.all(0.0)),
            _ => value,
        }
    }

    /// Every which [`LaneCable`] is added to the same sums. Sums over the cables of one robot are those of
    /// every eighth cable, whatever the number of lanes: their bits do not depend on it.
    #[inline(always)]
    pub(crate) fn stride(&self) -> usize {
        match self.layout {
            Layout::Robots => 1,
            Layout::Cables(_) => MAX_LANES / Lanes::<S>::COUNT,
        }
    }

    /// The sum over all cables of a robot, from that of others, unless these are the first ones, and the sums
    /// of its lanes.
    #[inline(always)]
    pub(crate) fn total(&self, first: usize, others: Lanes<S>, sum: Lanes<S>) -> Lanes<S> {
        match self.layout {
            Layout::Robots => sum,
            Layout::Cables(_) => {
                let mut total = if first == 0 { 0.0 } else { others.first() };
                for lane in sum.to_array() {
                    total += lane;
                }
                sum.all(total)
            }
        }
    }

    /// The lanes of the robots all of whose cables are in these lanes.
    #[inline(always)]
    pub(crate) fn of_robot(&self, of_cables: Mask<S>) -> Mask<S> {
        match self.layout {
            Layout::Robots => of_cables,
            Layout::Cables(_) if <Lanes<S> as Lanewise>::all(of_cables) => of_cables,
            Layout::Cables(_) => of_cables & !of_cables,
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
