//! What acts on the platforms in the lanes.

use cdpr_number::dense::{Lanes3, Lanes6};
use cdpr_number::lanes::{Lanes, Simd};
use cdpr_number::three;
use cdpr_robot::{Vector3, Wrench};

/// A weight at the centre of mass of a platform, and a force and a moment at P.
#[derive(Clone)]
pub(crate) struct PlatformLoad<S: Simd> {
    /// Weight [N].
    pub(crate) weight: Lanes<S>,
    /// Force [N].
    pub(crate) force: Lanes3<S>,
    /// Moment [N m]; mostly none.
    pub(crate) moment: Option<Lanes3<S>>,
}

impl<S: Simd> PlatformLoad<S> {
    /// A weight and the same wrench in all lanes.
    #[inline(always)]
    pub(crate) fn new(weight: Lanes<S>, Wrench { force, moment }: &Wrench) -> Self {
        let turning = *moment != Vector3::zeros();
        Self {
            weight,
            force: three!(|k| weight.all(force[k])),
            moment: turning.then_some(three!(|k| weight.all(moment[k]))),
        }
    }

    /// A weight alone.
    #[inline(always)]
    pub(crate) fn weight(weight: Lanes<S>) -> Self {
        Self { weight, force: [weight.all(0.0); 3], moment: None }
    }

    /// This load in addition to a weight.
    #[inline(always)]
    pub(crate) fn on(&self, weight: Lanes<S>) -> Self {
        Self { weight: weight + self.weight, force: self.force, moment: self.moment }
    }

    /// The wrench about P of a platform whose centre of mass has the lever `center`.
    #[inline(always)]
    pub(crate) fn wrench(&self, center: &Lanes3<S>) -> Lanes6<S> {
        let [x, y, z] = self.force;
        let zero = self.weight.all(0.0);
        let mut wrench = [x, y, z - self.weight, -center[1] * self.weight, center[0] * self.weight, zero];
        if let Some(moment) = &self.moment {
            for k in 0..3 {
                wrench[3 + k] += moment[k];
            }
        }
        wrench
    }
}
