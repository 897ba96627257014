//! The equations of a cable between fixed ends in its vertical plane, over any kind of number.

use crate::cable::Numbers;
use crate::catenary::Catenary;
use crate::catenary::guided::OnGuide;
use crate::kernel::Response;
use cdpr_number::Real;

/// Share of the chord that stands for the horizontal distance of a vertical cable: far below rounding.
pub(super) const VERTICAL: f64 = 1e-20;

/// The quantities of (C17) and (C18) over any kind of number.
#[derive(Clone, Copy)]
pub(super) struct InPlane<T> {
    pub(super) end: [T; 2],
    pub(super) numbers: Numbers<T>,
    pub(super) chord_force: T,
    pub(super) fz: T,
}

impl<T: Real> InPlane<T> {
    pub(super) fn chord(&self) -> T {
        (self.end[0] * self.end[0] + self.end[1] * self.end[1]).sqrt()
    }

    /// h, or what stands for it where the cable is vertical.
    pub(super) fn horizontal(&self) -> T {
        let chord = self.chord();
        if self.end[0].value() > VERTICAL * chord.value() { self.end[0] } else { chord * VERTICAL }
    }

    pub(super) fn fx(&self) -> T {
        self.chord_force * self.horizontal() / self.chord()
    }

    /// The response, and what it does not tell of a cable on a guide.
    pub(super) fn response(&self, catenary: &Catenary) -> (Response<T>, Option<OnGuide<T>>) {
        catenary.cable.whole_response(&self.numbers, [self.fx(), self.fz])
    }

    /// c/σ - x/fx and the height that is missing, (C17).
    pub(super) fn misclosure(&self, response: &Response<T>) -> [T; 2] {
        [self.chord() / self.chord_force - response.lateral_flexibility, self.end[1] - response.end[1]]
    }

    /// (fx', fz', L'), (C18).
    pub(super) fn slopes(&self, (response, on_guide): &(Response<T>, Option<OnGuide<T>>)) -> [T; 3] {
        let (fx, fx_slope) = (self.fx(), self.horizontal() / self.chord());
        let ([xx, shear, zz], mut determinant) = (response.flexibility, response.determinant);
        let (mut xz, mut zx) = (shear, shear);
        if let Some(OnGuide { asymmetry, .. }) = *on_guide {
            (xz, zx) = (shear + asymmetry, shear - asymmetry);
            determinant = determinant + asymmetry * asymmetry;
        }
        // The cable enters along the tangent at B: the slope there is V0/fx.
        let [entering, rising] = response.end_per_length;
        let k = entering / fx;
        let v0 = rising / k;
        let m = (zz - v0 * xz / fx).recip();
        let fz_slope = (v0 * xx / self.chord_force - zx * fx_slope) * m;
        [fx_slope, fz_slope, -(determinant * m) / (self.chord_force * k)]
    }
}

impl InPlane<f64> {
    /// The response of a cable with these numbers.
    #[inline]
    pub(super) fn whole_response(&self, catenary: &Catenary) -> (Response<f64>, Option<OnGuide<f64>>) {
        match catenary.cable.guide {
            None => (catenary.response(), None),
            Some(_) => self.response(catenary),
        }
    }
}

/// The derivative of (x/fx, z) with respect to (fz, L).
pub(super) struct ClosureMatrix {
    across: [f64; 2],
    height: [f64; 2],
}

impl ClosureMatrix {
    pub(super) fn of(
        cable: &InPlane<f64>,
        (response, on_guide): &(Response<f64>, Option<OnGuide<f64>>),
    ) -> Self {
        let fx = cable.fx();
        let asymmetry = on_guide.as_ref().map_or(0.0, |on_guide| on_guide.asymmetry);
        Self {
            across: [(response.flexibility[1] + asymmetry) / fx, response.end_per_length[0] / fx],
            height: [response.flexibility[2], response.end_per_length[1]],
        }
    }

    /// The change of (fz, L) that makes up for a misclosure.
    pub(super) fn solve(&self, [across, height]: [f64; 2]) -> [f64; 2] {
        let ([a, b], [c, d]) = (self.across, self.height);
        let determinant = a * d - b * c;
        [(across * d - b * height) / determinant, (a * height - across * c) / determinant]
    }
}
