//! What a cable is made of, over any kind of number: its weight, its elastic law, and how it answers.
//!
//! Each element points along its force and is strained by ε(T):
//!
//! ```text
//! dx = (1 + ε) fx/T ds,      dz = (1 + ε) V/T ds,      1 + ε = α_k + T/EA_k                    (C12)
//! ```
//!
//! A piece of cable whose tension stays within segment k therefore has the equations of `kernel/response.rs`
//! with 1/EA_k for 1/EA and their inextensible part times α_k: every quantity Q that is linear in the two
//! parts is
//!
//! ```text
//! Q = Q(1/EA_k) + (α_k - 1) Q(0)                                                               (C13)
//! ```
//!
//! The cable is cut where its tension crosses a kink of the law, at `V = ±sqrt(T_k² - fx²)`. Above each kink
//! it may have two pieces, one on either side of its lowest point, and the segment of its lowest tension has
//! one. Since ε is continuous, what a moving cut adds to one piece it takes from the next. The determinant of
//! the flexibility of two pieces in a row is that of each and what they have in common,
//!
//! ```text
//! det(C + C') = det C + det C' + Cxx C'zz + Czz C'xx - 2 Cxz C'xz                              (C36)
//! ```
//!
//! The complementary energy is the integral over the cable of a convex function of a convex one, so that the
//! force at the end stays unique.

use super::response::{LaneEnd, Response, Terms};
use cdpr_number::{Lanewise, Number, Real};

/// A segment of an elastic law with 1 + ε = 1 + (offset + flexibility T)/EA, from a tension up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawSegment {
    /// Tension T_k at which it begins [N].
    pub from: f64,
    /// Its stiffness over the cable's, κ_k = EA_k/EA.
    pub ratio: f64,
    /// Strain at its beginning, σ_k, times EA [N].
    pub strain: f64,
    /// σ_k - T_k/κ_k [N].
    pub offset: f64,
    /// 1/κ_k.
    pub flexibility: f64,
    /// W(T_k) EA, the integral of the strain over the tension up to it [N²].
    pub energy: f64,
}

/// Material of a cable.
#[derive(Clone, Copy, Debug)]
pub struct Material<'a, T> {
    /// Segments of the elastic law, from zero tension up; none of a linear one.
    pub law: &'a [LawSegment],
    /// Weight per unstrained length w [N/m].
    pub weight_per_length: T,
    /// Axial flexibility 1/EA [1/N].
    pub axial_flexibility: T,
}

/// The segment of the law at a tension, of each cable.
#[derive(Clone, Copy)]
struct Here<T> {
    /// Number of the segment.
    index: T,
    /// T_k [N].
    from: T,
    /// α_k.
    alpha: T,
    /// 1/EA_k [1/N].
    flexibility: T,
}

impl<T: Lanewise> Material<'_, T> {
    /// How the end of a cable of this unstrained length [m] answers to the force `[fx, fz]` [N] there.
    ///
    /// It takes `fx²` as it is: a vertical folded cable is singular.
    #[inline(always)]
    pub fn response(&self, length: T, [fx, fz]: [T; 2]) -> Response<T> {
        let terms = self.terms(length, fx, fz);
        if self.law.is_empty() { terms.response(None) } else { self.by_law(&terms) }
    }

    /// The end of that cable alone.
    #[inline(always)]
    pub fn end(&self, length: T, [fx, fz]: [T; 2]) -> LaneEnd<T> {
        let terms = self.terms(length, fx, fz);
        let end = if self.law.is_empty() { terms.end_position() } else { self.by_law(&terms).end };
        LaneEnd { end, tension: terms.t, slackness: terms.slackness() }
    }

    /// Strain at a tension [N].
    #[inline(always)]
    pub fn strain(&self, tension: T) -> T {
        if self.law.is_empty() {
            return tension * self.axial_flexibility;
        }
        let Here { alpha, flexibility, .. } = self.at(tension);
        alpha + -1.0 + tension * flexibility
    }

    /// 1 + ε and ε' [1/N] at a tension [N].
    #[inline(always)]
    pub fn stretch(&self, tension: T) -> [T; 2] {
        if self.law.is_empty() {
            return [tension * self.axial_flexibility + 1.0, self.axial_flexibility];
        }
        let Here { alpha, flexibility, .. } = self.at(tension);
        [alpha + tension * flexibility, flexibility]
    }

    /// W, the integral of the strain over the tension [N], as [`crate::Cable::energy_per_length`].
    #[inline(always)]
    pub fn energy(&self, tension: T) -> T {
        if self.law.is_empty() {
            return tension * tension * self.axial_flexibility * 0.5;
        }
        let mut scaled = tension * 0.0;
        for LawSegment { from, offset, flexibility, energy, .. } in self.law {
            let more = tension + -from;
            let here = more * (more * (0.5 * flexibility) + (offset + flexibility * from)) + *energy;
            scaled = T::select((more * -1.0).at_most(0.0), here, scaled);
        }
        scaled * self.axial_flexibility
    }

    /// Tension [N] at `height` [m] above a point where it is `tension` [N], (C26) of `cable.rs`; zero or less
    /// where the cable weighs more. With a law Newton's method on a convex function finds it.
    #[inline(always)]
    pub fn tension_above(&self, tension: T, height: T) -> T {
        let work = tension + self.energy(tension) + self.weight_per_length * height;
        if self.law.is_empty() {
            return work * 2.0 * ((work * self.axial_flexibility * 2.0 + 1.0).sqrt() + 1.0).recip();
        }
        let (zero, mut above, mut open) = (tension * 0.0, tension, tension * 0.0 + 1.0);
        for _ in 0..30 {
            let step = (above + self.energy(above) - work) / (self.strain(above) + 1.0);
            above = T::select(open.at_most(0.0), above, above - step);
            let left = step * step - above * above * (4.0 * f64::EPSILON).powi(2);
            open = T::select(left.at_most(0.0), zero, open);
            if T::all(open.at_most(0.0)) {
                break;
            }
        }
        T::select(work.at_most(0.0), zero + -1.0, above)
    }

    #[inline(always)]
    fn terms(&self, length: T, fx: T, fz: T) -> Terms<T> {
        Terms::with_square(self.weight_per_length, self.axial_flexibility, length, fx, fz, fx * fx)
    }

    #[inline(always)]
    fn at(&self, tension: T) -> Here<T> {
        let zero = tension * 0.0;
        let (mut index, mut from, mut offset, mut flexibility) = (zero, zero, zero, zero);
        let mut number = 0.0;
        for segment in self.law {
            let reached = (tension * -1.0 + segment.from).at_most(0.0);
            index = T::select(reached, zero + number, index);
            from = T::select(reached, zero + segment.from, from);
            offset = T::select(reached, zero + segment.offset, offset);
            flexibility = T::select(reached, zero + segment.flexibility, flexibility);
            number += 1.0;
        }
        Here {
            index,
            from,
            alpha: offset * self.axial_flexibility + 1.0,
            flexibility: flexibility * self.axial_flexibility,
        }
    }

    /// The response of a cable with a law: of the segment that it stays in, or the sum of its pieces.
    #[inline(always)]
    fn by_law(&self, whole: &Terms<T>) -> Response<T> {
        let (zero, near, far) = (whole.fx * 0.0, self.at(whole.t), self.at(whole.t0));
        let mut response = whole.with_flexibility(near.flexibility).response(Some(near.alpha));
        let apart = (near.index - far.index) * (near.index - far.index);
        // A cable that dips has its least tension fx between its ends.
        let leaves = T::select((near.from - whole.fx).at_most(0.0), apart, zero + 1.0);
        let others = T::select((whole.fz * whole.v0).at_most(0.0), leaves, apart);
        let one = others.at_most(0.0);
        if !T::all(one) {
            let sum = self.sum_of_pieces(whole, &response);
            response = Response::select(one, &response, &sum);
        }
        response
    }

    #[inline(always)]
    fn sum_of_pieces(&self, whole: &Terms<T>, of_the_force: &Response<T>) -> Response<T> {
        let zero = whole.fx * 0.0;
        let mut sum = Response {
            end: [zero; 2],
            flexibility: [zero; 3],
            determinant: zero,
            lateral_flexibility: zero,
            end_per_length: [zero; 2],
            ..*of_the_force
        };
        let mut begun = zero;
        for number in 0..2 * self.law.len() {
            let piece = self.piece(whole, number);
            let empty = piece.length().at_most(0.0);
            if T::all(empty) {
                continue;
            }
            let own = piece.terms(whole).response(Some(piece.alpha));
            let mut more = sum;
            for k in 0..2 {
                more.end[k] = sum.end[k] + own.end[k];
                // Cable that is paid out enters at B.
                more.end_per_length[k] =
                    T::select(begun.at_most(0.0), own.end_per_length[k], sum.end_per_length[k]);
            }
            let ([xx, xz, zz], [own_xx, own_xz, own_zz]) = (sum.flexibility, own.flexibility);
            let common = xx * own_zz + zz * own_xx - xz * own_xz * 2.0;
            more.determinant = sum.determinant + own.determinant + common;
            more.flexibility = [xx + own_xx, xz + own_xz, zz + own_zz];
            more.lateral_flexibility = sum.lateral_flexibility + own.lateral_flexibility;
            sum = Response::select(empty, &sum, &more);
            begun = T::select(empty, begun, zero + 1.0);
        }
        sum
    }

    /// A piece of a cable, in the order from B to A: down to the segment of the lowest tension, and up again.
    #[inline(always)]
    fn piece(&self, whole: &Terms<T>, number: usize) -> Piece<T> {
        let count = self.law.len();
        let rises = number >= count;
        let index = if rises { number - count } else { count - 1 - number };
        let LawSegment { from, offset, flexibility, .. } = self.law[index];
        let (low, lowest) = self.cut(whole, from);
        let [down, up] = match self.law.get(index + 1) {
            Some(next) => {
                let (high, _) = self.cut(whole, next.from);
                [self.place(whole, -high), self.place(whole, high)]
            }
            None => whole.ends(),
        };
        // The lowest segment has one piece, that on the way down.
        let ends = if rises {
            [Place::select(lowest, up, self.place(whole, low)), up]
        } else {
            [down, Place::select(lowest, up, self.place(whole, -low))]
        };
        let [alpha, flexibility] =
            [self.axial_flexibility * offset + 1.0, self.axial_flexibility * flexibility];
        Piece { segment: index, weight_per_length: self.weight_per_length, alpha, flexibility, ends }
    }

    /// |V| where the tension is `tension` [N], zero where it is higher everywhere, and whether it is.
    #[inline(always)]
    fn cut(&self, whole: &Terms<T>, tension: f64) -> (T, T::Mask) {
        let square = (-whole.fx + tension) * (whole.fx + tension);
        let above = square.at_most(0.0);
        (T::select(above, whole.fx * 0.0, square).sqrt(), above)
    }

    /// The place where the vertical force is `v` [N], or the end of the cable towards it.
    #[inline(always)]
    fn place(&self, whole: &Terms<T>, v: T) -> Place<T> {
        let zero = whole.fx * 0.0;
        let s = (v - whole.v0) / (self.weight_per_length + f64::MIN_POSITIVE);
        let (before, beyond) = (s.at_most(0.0), (whole.length - s).at_most(0.0));
        Place {
            s: T::select(before, zero, T::select(beyond, whole.length, s)),
            v: T::select(before, whole.v0, T::select(beyond, whole.fz, v)),
        }
    }
}

impl<T: Real> Material<'_, T> {
    /// [`Material::response`] of any cable: see [`super::response()`] for one that hangs folded.
    #[inline]
    pub fn any_response(&self, length: T, [fx, fz]: [T; 2]) -> Response<T> {
        let terms = self.any_terms(length, [fx, fz]);
        if self.law.is_empty() { terms.response(None) } else { self.any_by_law(&terms) }
    }

    #[inline]
    pub(crate) fn any_terms(&self, length: T, [fx, fz]: [T; 2]) -> Terms<T> {
        Terms::new(self.weight_per_length, self.axial_flexibility, length, fx, fz)
    }

    /// Cold: most cables are linear, and their code is shorter when it is laid out for them.
    #[cold]
    #[inline(never)]
    fn any_by_law(&self, terms: &Terms<T>) -> Response<T> {
        self.by_law(terms)
    }
}

/// A place on a cable.
#[derive(Clone, Copy)]
struct Place<T> {
    /// Unstrained length from B [m].
    s: T,
    /// Vertical force there [N].
    v: T,
}

impl<T: Number> Terms<T> {
    /// B and A.
    #[inline(always)]
    fn ends(&self) -> [Place<T>; 2] {
        [Place { s: self.fx * 0.0, v: self.v0 }, Place { s: self.length, v: self.fz }]
    }
}

impl<T: Lanewise> Place<T> {
    #[inline(always)]
    fn select(mask: T::Mask, chosen: Self, otherwise: Self) -> Self {
        Self { s: T::select(mask, chosen.s, otherwise.s), v: T::select(mask, chosen.v, otherwise.v) }
    }
}

/// A piece of a cable whose tension stays within one segment of its law.
struct Piece<T> {
    /// Number of the segment.
    segment: usize,
    weight_per_length: T,
    /// α_k.
    alpha: T,
    /// 1/EA_k [1/N].
    flexibility: T,
    /// Its ends, nearer to B and nearer to A.
    ends: [Place<T>; 2],
}

impl<T: Number> Piece<T> {
    /// Its unstrained length [m].
    #[inline(always)]
    fn length(&self) -> T {
        self.ends[1].s - self.ends[0].s
    }

    /// The terms of a linear cable with 1/EA_k.
    #[inline(always)]
    fn terms(&self, whole: &Terms<T>) -> Terms<T> {
        let [_, Place { v, .. }] = self.ends;
        Terms::with_square(self.weight_per_length, self.flexibility, self.length(), whole.fx, v, whole.fx2)
    }
}

impl Material<'_, f64> {
    /// Complementary energy [J].
    pub(crate) fn complementary_energy(&self, whole: &Terms<f64>) -> f64 {
        self.energy_of_pieces(whole, |piece, energy| {
            piece.of(whole, Terms::complementary_energy) + piece.length() * energy
        })
    }

    /// Potential energy [J]: the sum of `f·r - U*` over the pieces, each of which lifts the cable beyond it.
    pub(crate) fn potential_energy(&self, whole: &Terms<f64>) -> f64 {
        self.energy_of_pieces(whole, |piece, energy| {
            let height = piece.of(whole, |terms| terms.end_position()[1]);
            let beyond = whole.length - piece.ends[1].s;
            piece.of(whole, Terms::potential_energy) - piece.length() * energy
                + self.weight_per_length * beyond * height
        })
    }

    /// The sum over the pieces, each with the constant c_k of its complementary energy per length [N]; a
    /// linear cable is one piece.
    fn energy_of_pieces(&self, whole: &Terms<f64>, of: impl Fn(&Piece<f64>, f64) -> f64) -> f64 {
        let (from, strain, offset, energy) = (0.0, 0.0, 0.0, 0.0);
        let linear = [LawSegment { from, ratio: 1.0, strain, offset, flexibility: 1.0, energy }];
        let law = if self.law.is_empty() { &linear } else { self.law };
        let material = Material { law, ..*self };
        let constant = |&LawSegment { from, offset, flexibility, energy, .. }: &LawSegment| {
            (energy - from * (offset + 0.5 * flexibility * from)) * self.axial_flexibility
        };
        let pieces = (0..2 * law.len()).map(|number| material.piece(whole, number));
        let filled = pieces.filter(|piece| piece.length() > 0.0);
        filled.map(|piece| of(&piece, constant(&law[piece.segment]))).sum()
    }
}

impl Piece<f64> {
    /// (C13): `Q(1/EA_k) + (α_k - 1) Q(0)`.
    fn of(&self, whole: &Terms<f64>, quantity: impl Fn(&Terms<f64>) -> f64) -> f64 {
        let elastic = self.terms(whole);
        quantity(&elastic) + quantity(&elastic.with_flexibility(0.0)) * (self.alpha - 1.0)
    }
}
