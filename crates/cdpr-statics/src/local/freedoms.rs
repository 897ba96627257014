//! Wrenches, twists and stiffness of platforms some motions of which are constrained.

use cdpr_number::dense::{Lanes6, Lanes6x6};
use cdpr_number::lanes::{Lanes, Simd};
use cdpr_number::six;
use cdpr_robot::Freedoms;

/// A wrench or a twist without its components along the constrained motions.
#[inline(always)]
pub(crate) fn constrain<S: Simd>(freedoms: Freedoms, v: Lanes6<S>) -> Lanes6<S> {
    if freedoms.are_all() {
        return v;
    }
    six!(|k| if freedoms.contains(k) { v[k] } else { v[k].all(0.0) })
}

/// The same of the upper triangle of a matrix, with `diagonal` for those motions.
#[inline(always)]
pub(crate) fn constrain_matrix<S: Simd>(freedoms: Freedoms, matrix: &mut Lanes6x6<S>, diagonal: Lanes<S>) {
    if freedoms.are_all() {
        return;
    }
    for (row, elements) in matrix.iter_mut().enumerate() {
        match freedoms.contains(row) {
            true => *elements = constrain(freedoms, *elements),
            false => {
                *elements = [diagonal.all(0.0); 6];
                elements[row] = diagonal;
            }
        }
    }
}
