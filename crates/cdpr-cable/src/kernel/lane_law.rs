//! Cables with a piecewise elastic law in lanes, (C12) and (C13) of `catenary/pieces.rs`.
//!
//! The tension of a short cable spans few newtons, so that it stays within a segment of its law or crosses
//! one kink. A cable in one segment has the equations of a linear one, with 1/EA_k and its inextensible part
//! times α_k. One that crosses the kink T_k is the sum of two such pieces, cut at
//! `V = ±sqrt(T_k² - fx²)`. Cables that cross more than one kink, or dip below the segments of their ends,
//! have a slackness of 2 here.

use super::response::{LaneEnd, Response, Terms};
use cdpr_number::Lanewise;

/// A segment of an elastic law with 1 + ε = 1 + (offset + flexibility T)/EA, from a tension up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSegment {
    /// Tension T_k at which it begins [N].
    pub from: f64,
    /// σ_k - T_k/κ_k [N].
    pub offset: f64,
    /// 1/κ_k.
    pub flexibility: f64,
    /// W(T_k) EA, the integral of the strain over the tension up to it [N²].
    pub energy: f64,
}

/// The segment of each lane.
#[derive(Clone, Copy)]
struct Segments<T> {
    index: T,
    from: T,
    /// α_k.
    alpha: T,
    /// 1/EA_k [1/N].
    flexibility: T,
}

/// As [`super::lane_response`], for cables with a law.
#[inline(always)]
pub fn lane_law_response<T: Lanewise>(
    law: &[LaneSegment],
    w: T,
    axial_flexibility: T,
    length: T,
    force: [T; 2],
) -> Response<T> {
    let [fx, fz] = force;
    let ends = Terms::with_square(w, axial_flexibility, length, fx, fz, fx * fx);
    let [near, far] = segments(law, axial_flexibility, &ends);
    let whole = ends.with_flexibility(near.flexibility);
    let mut response = whole.lane_response(Some(near.alpha));
    let together = (near.index - far.index) * (near.index - far.index);
    let one = together.at_most(0.0);
    if !T::all(one) {
        let cut = Cut::new(w, fx, &whole, &near, &far);
        let [a, b] = cut.pieces(w, fx, fz, &near, &far);
        let pieces = two(
            &cut,
            (&a.lane_response(Some(near.alpha)), near.flexibility),
            (&b.lane_response(Some(far.alpha)), far.flexibility),
        );
        response = Response {
            end: [
                T::select(one, response.end[0], pieces.end[0]),
                T::select(one, response.end[1], pieces.end[1]),
            ],
            flexibility: [
                T::select(one, response.flexibility[0], pieces.flexibility[0]),
                T::select(one, response.flexibility[1], pieces.flexibility[1]),
                T::select(one, response.flexibility[2], pieces.flexibility[2]),
            ],
            determinant: T::select(one, response.determinant, pieces.determinant),
            lateral_flexibility: T::select(one, response.lateral_flexibility, pieces.lateral_flexibility),
            end_per_length: [
                T::select(one, response.end_per_length[0], pieces.end_per_length[0]),
                T::select(one, response.end_per_length[1], pieces.end_per_length[1]),
            ],
            ..response
        };
    }
    let beyond = crosses_more(&whole, &near, &far, together);
    Response {
        slackness: T::select(beyond.at_most(0.0), response.slackness, together * 0.0 + 2.0),
        ..response
    }
}

/// As [`super::lane_end`], for cables with a law.
#[inline(always)]
pub fn lane_law_end<T: Lanewise>(
    law: &[LaneSegment],
    w: T,
    axial_flexibility: T,
    length: T,
    force: [T; 2],
) -> LaneEnd<T> {
    let Response { end, tension, slackness, .. } =
        lane_law_response(law, w, axial_flexibility, length, force);
    LaneEnd { end, tension, slackness }
}

/// Strain at a tension [N].
#[inline(always)]
pub fn lane_law_strain<T: Lanewise>(law: &[LaneSegment], axial_flexibility: T, tension: T) -> T {
    let segments = at(law, axial_flexibility, tension);
    segments.alpha + -1.0 + tension * segments.flexibility
}

/// 1 + ε and ε' [1/N] at a tension [N].
#[inline(always)]
pub fn lane_law_stretch<T: Lanewise>(law: &[LaneSegment], axial_flexibility: T, tension: T) -> [T; 2] {
    let segments = at(law, axial_flexibility, tension);
    [segments.alpha + tension * segments.flexibility, segments.flexibility]
}

/// W, the integral of the strain over the tension [N], as [`crate::Cable::energy_per_length`].
#[inline(always)]
pub fn lane_law_energy<T: Lanewise>(law: &[LaneSegment], axial_flexibility: T, tension: T) -> T {
    let mut scaled = tension * 0.0;
    for LaneSegment { from, offset, flexibility, energy } in law {
        let more = tension + -from;
        let here = more * (more * (0.5 * flexibility) + (offset + flexibility * from)) + *energy;
        scaled = T::select((more * -1.0).at_most(0.0), here, scaled);
    }
    scaled * axial_flexibility
}

/// The segments at A and at B.
#[inline(always)]
fn segments<T: Lanewise>(law: &[LaneSegment], axial_flexibility: T, ends: &Terms<T>) -> [Segments<T>; 2] {
    [at(law, axial_flexibility, ends.t), at(law, axial_flexibility, ends.t0)]
}

#[inline(always)]
fn at<T: Lanewise>(law: &[LaneSegment], axial_flexibility: T, tension: T) -> Segments<T> {
    let zero = tension * 0.0;
    let (mut index, mut from, mut offset, mut flexibility) = (zero, zero, zero, zero);
    let mut number = 0.0;
    for segment in law {
        let below = (tension * -1.0 + segment.from).at_most(0.0);
        index = T::select(below, zero + number, index);
        from = T::select(below, zero + segment.from, from);
        offset = T::select(below, zero + segment.offset, offset);
        flexibility = T::select(below, zero + segment.flexibility, flexibility);
        number += 1.0;
    }
    Segments {
        index,
        from,
        alpha: offset * axial_flexibility + 1.0,
        flexibility: flexibility * axial_flexibility,
    }
}

/// Positive where a cable crosses more than one kink.
#[inline(always)]
fn crosses_more<T: Lanewise>(whole: &Terms<T>, near: &Segments<T>, far: &Segments<T>, together: T) -> T {
    let lower = T::select((near.from - far.from).at_most(0.0), near.from, far.from);
    let dips = whole.fz * whole.v0;
    let low = T::select((lower - whole.fx).at_most(0.0), together * 0.0, together * 0.0 + 1.0);
    let low = T::select(dips.at_most(0.0), low, together * 0.0);
    T::select(together.at_most(1.0), low, together)
}

/// Where a cable crosses its kink.
struct Cut<T> {
    /// Vertical force there [N].
    vertical: T,
    /// Lengths of the pieces at A and at B [m].
    lengths: [T; 2],
}

impl<T: Lanewise> Cut<T> {
    #[inline(always)]
    fn new(w: T, fx: T, whole: &Terms<T>, near: &Segments<T>, far: &Segments<T>) -> Self {
        let rises = (far.from - near.from).at_most(0.0);
        // The end of the greater tension has the kink at its lower one, and its sign.
        let kink = T::select(rises, near.from, far.from);
        let end = T::select(rises, whole.fz, whole.v0);
        let square = (kink - fx) * (kink + fx);
        let size = T::select(square.at_most(0.0), fx * 0.0, square).sqrt();
        let vertical = T::select(end.at_most(0.0), -size, size);
        let w_inv = w.recip();
        Self { vertical, lengths: [(whole.fz - vertical) * w_inv, (vertical - whole.v0) * w_inv] }
    }

    /// The pieces at A and at B.
    #[inline(always)]
    fn pieces(&self, w: T, fx: T, fz: T, near: &Segments<T>, far: &Segments<T>) -> [Terms<T>; 2] {
        [
            Terms::with_square(w, near.flexibility, self.lengths[0], fx, fz, fx * fx),
            Terms::with_square(w, far.flexibility, self.lengths[1], fx, self.vertical, fx * fx),
        ]
    }
}

/// The sum of two pieces, at A and at B, with their axial flexibilities.
#[inline(always)]
fn two<T: Lanewise>(
    cut: &Cut<T>,
    (a, a_flexibility): (&Response<T>, T),
    (b, b_flexibility): (&Response<T>, T),
) -> Response<T> {
    let [xx, xz, zz] = [
        a.flexibility[0] + b.flexibility[0],
        a.flexibility[1] + b.flexibility[1],
        a.flexibility[2] + b.flexibility[2],
    ];
    let straight = cut.lengths[0] * a_flexibility + cut.lengths[1] * b_flexibility;
    let (nx, nz) = (xx - straight, zz - straight);
    Response {
        end: [a.end[0] + b.end[0], a.end[1] + b.end[1]],
        flexibility: [xx, xz, zz],
        determinant: straight * (straight + nx + nz) + (nx * nz - xz * xz),
        lateral_flexibility: a.lateral_flexibility + b.lateral_flexibility,
        // Cable that is paid out enters at B.
        end_per_length: b.end_per_length,
        ..*a
    }
}
