//! A cable with a piecewise linear law, as a sum of pieces that each stay within one segment of the law.
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
//! The cable is cut where its tension crosses a kink of the law, at `V = ±sqrt(T_k² - fx²)`. Since ε is
//! continuous, what a moving cut adds to one piece it takes from the next. All derivatives are therefore sums
//! over the pieces at fixed ranges of s, with `dV = df_z` and, for the weight, `dV = -(L - s) dw`.
//!
//! With S the sum of L_k/EA_k and N the sum of α_k times the inextensible flexibilities, the flexibility is
//! `S 1 + N` and its determinant `S² + S tr N + det N`. The complementary energy is the integral over the
//! cable of a convex function of a convex one, so that the force at the end stays unique.
//!
//! Functions that are called from outside are marked cold: most cables are linear, and their code is shorter
//! when it is laid out for them.

use crate::cable::Cable;
use crate::catenary::Catenary;
use crate::kernel::{Response, Terms};
use crate::law::{PiecewiseLaw, SegmentTerms};
use cdpr_number::Real;
use nalgebra::Vector2;

/// A piece of a cable whose tension stays within one segment.
struct Piece<T> {
    /// Terms of a linear cable with 1/EA_k.
    elastic: Terms<T>,
    /// Terms of an inextensible cable.
    inextensible: Terms<T>,
    segment: SegmentTerms<T>,
    length: T,
    /// Length of the cable beyond the piece, towards A.
    beyond: T,
    /// Vertical force at the ends of the piece, nearer to B and to A.
    vertical: [T; 2],
}

/// What the pieces of a cable are cut from, over any kind of number.
struct Whole<T> {
    weight_per_length: T,
    axial_flexibility: T,
    length: T,
    force: [T; 2],
}

impl Whole<f64> {
    fn of(catenary: &Catenary) -> Self {
        let Catenary { cable, unstrained_length: length, force } = *catenary;
        let axial_flexibility = 1.0 / cable.axial_stiffness;
        Self { weight_per_length: cable.weight_per_length, axial_flexibility, length, force: force.into() }
    }
}

impl<T: Real> Whole<T> {
    /// The pieces in the order from B to A.
    fn pieces(&self, law: &PiecewiseLaw) -> Vec<Piece<T>> {
        let Self { weight_per_length: w, axial_flexibility, length, force: [fx, fz] } = *self;
        let zero = T::of(0.0);
        let v0 = fz - w * length;
        let mut cuts = vec![zero, length];
        let cable = Cable::linear(w.value(), 1.0 / axial_flexibility.value());
        if !cable.is_weightless(length.value()) {
            for kink in law.kinks().filter(|kink| *kink > fx.value()) {
                let v = ((-fx + kink) * (fx + kink)).sqrt();
                let inside = |s: &T| (0.0..length.value()).contains(&s.value());
                cuts.extend([-v, v].map(|v| (v - v0) / w).into_iter().filter(inside));
            }
        }
        cuts.sort_by(|a, b| a.value().total_cmp(&b.value()));
        let between = cuts.windows(2).filter(|ends| ends[1].value() > ends[0].value());
        between
            .map(|ends| {
                // The tension in the middle decides, because an end may lie on a kink.
                let middle = v0 + w * (ends[0] + ends[1]) * 0.5;
                let segment = law.segment_terms(fx.value().hypot(middle.value()), axial_flexibility);
                let piece = ends[1] - ends[0];
                let last = ends[1].value() == length.value();
                let vertical = [v0 + w * ends[0], if last { fz } else { v0 + w * ends[1] }];
                let terms = |flexibility| Terms::new(w, flexibility, piece, fx, vertical[1]);
                Piece {
                    elastic: terms(segment.flexibility),
                    inextensible: terms(zero),
                    segment,
                    length: piece,
                    beyond: length - ends[1],
                    vertical,
                }
            })
            .collect()
    }
}

impl Piece<f64> {
    /// (C13): `Q(1/EA_k) + (α_k - 1) Q(0)`.
    fn of<T>(&self, quantity: impl Fn(&Terms<f64>) -> T) -> T
    where
        T: std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
    {
        quantity(&self.elastic) + quantity(&self.inextensible) * (self.segment.alpha - 1.0)
    }
}

/// Position (x, z) of A [m].
#[cold]
pub(crate) fn end_position(catenary: &Catenary, law: &PiecewiseLaw) -> Vector2<f64> {
    let ends = Whole::of(catenary).pieces(law).into_iter();
    ends.map(|piece| piece.of(|terms| Vector2::from(terms.end_position()))).sum()
}

/// The response to the force `force` [N] at A of a cable with this law, over any kind of number: see
/// [`crate::kernel::response`].
#[cold]
pub(crate) fn response<T: Real>(
    law: &PiecewiseLaw,
    weight_per_length: T,
    axial_flexibility: T,
    length: T,
    force: [T; 2],
) -> Response<T> {
    let zero = T::of(0.0);
    let [fx, fz] = force;
    let v0 = fz - weight_per_length * length;
    let (tension, exit) = ((fx * fx + fz * fz).sqrt(), (fx * fx + v0 * v0).sqrt());
    let q = weight_per_length * length / (tension + exit);
    let mut sum = Response {
        end: [zero; 2],
        flexibility: [zero; 3],
        determinant: zero,
        lateral_flexibility: zero,
        end_per_length: [zero; 2],
        tension,
        tension_inv: tension.recip(),
        direction: [fx / tension, fz / tension],
        slackness: q * q,
    };
    let (mut straight, mut bent, mut determinant) = (zero, [zero; 3], zero);
    let whole = Whole { weight_per_length, axial_flexibility, length, force };
    for (index, piece) in whole.pieces(law).iter().enumerate() {
        let Piece { segment: SegmentTerms { alpha, flexibility, .. }, length, .. } = *piece;
        let (elastic, inextensible) = (piece.elastic.response(), piece.inextensible.response());
        let add = |one: T, other: T| one + (alpha + -1.0) * other;
        for k in 0..2 {
            sum.end[k] = sum.end[k] + add(elastic.end[k], inextensible.end[k]);
        }
        for k in 0..3 {
            sum.flexibility[k] =
                sum.flexibility[k] + add(elastic.flexibility[k], inextensible.flexibility[k]);
        }
        let across = add(elastic.lateral_flexibility, inextensible.lateral_flexibility);
        sum.lateral_flexibility = sum.lateral_flexibility + across;
        if index == 0 {
            // Cable that is paid out enters at B.
            for k in 0..2 {
                sum.end_per_length[k] = add(elastic.end_per_length[k], inextensible.end_per_length[k]);
            }
        }
        let n = inextensible.flexibility.map(|c| alpha * c);
        let mixed = bent[0] * n[2] + bent[2] * n[0] + bent[1] * n[1] * -2.0;
        let mixed = if mixed.value() > 0.0 { mixed } else { zero };
        determinant = determinant + alpha * alpha * inextensible.determinant + mixed;
        straight = straight + length * flexibility;
        (0..3).for_each(|k| bent[k] = bent[k] + n[k]);
    }
    sum.determinant = straight * (straight + bent[0] + bent[2]) + determinant;
    sum
}

/// d(x, z)/dw at constant force at A [m²/N].
#[cold]
pub(crate) fn end_per_weight(catenary: &Catenary, law: &PiecewiseLaw) -> Vector2<f64> {
    let all = Whole::of(catenary).pieces(law).into_iter();
    all.map(|piece| {
        // The force at the end of the piece falls by the added weight of the cable beyond it.
        let per_vertical = piece.of(|terms| {
            let [_, xz, zz] = terms.response().flexibility;
            Vector2::new(xz, zz)
        });
        piece.of(Terms::end_per_weight) - per_vertical * piece.beyond
    })
    .sum()
}

/// d(x, z)/dEA at constant force at A [m/N]: the strain of each element is proportional to 1/EA.
#[cold]
pub(crate) fn end_per_stiffness(catenary: &Catenary, law: &PiecewiseLaw) -> Vector2<f64> {
    let strained: Vector2<f64> = Whole::of(catenary)
        .pieces(law)
        .into_iter()
        .map(|piece| {
            let [below, above] = piece.vertical;
            let pull = Vector2::new(catenary.force.x, 0.5 * (below + above));
            let bare = Vector2::from(piece.inextensible.end_position());
            pull * (piece.length * piece.segment.flexibility) + bare * (piece.segment.alpha - 1.0)
        })
        .sum();
    -strained / catenary.cable.axial_stiffness
}

/// Complementary energy [J].
#[cold]
pub(crate) fn complementary_energy(catenary: &Catenary, law: &PiecewiseLaw) -> f64 {
    let all = Whole::of(catenary).pieces(law).into_iter();
    all.map(|piece| piece.of(Terms::complementary_energy) + piece.length * piece.segment.energy).sum()
}

/// Potential energy [J]: the sum of `f·r - U*` over the pieces, each of which lifts the cable beyond it.
#[cold]
pub(crate) fn potential_energy(catenary: &Catenary, law: &PiecewiseLaw) -> f64 {
    let w = catenary.cable.weight_per_length;
    let all = Whole::of(catenary).pieces(law).into_iter();
    all.map(|piece| {
        let [_, z] = [0, 1].map(|k| piece.of(|terms| terms.end_position()[k]));
        piece.of(Terms::potential_energy) - piece.length * piece.segment.energy + w * piece.beyond * z
    })
    .sum()
}
