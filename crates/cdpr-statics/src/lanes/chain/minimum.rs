//! Whether a stationary point of the tensions is the least of all.
//!
//! With λ the multipliers of the balance, a point within the limits is the least of all if the horizontal
//! force of each cable, by itself, makes its part of the Lagrangian least:
//!
//! ```text
//! φ(fx) = (t - r)²/2 + λ·w,   φ(fx*) <= φ(fx)   for all fx that the limits allow                  (L7)
//! ```
//!
//! (H. Everett, *Generalized Lagrange multiplier method*, Operations Research 11, 1963). φ is compared with
//! that of inextensible catenaries (L4) at fixed values of u, from nearly straight to steep ones; over a
//! pulley with that from the point where the one before would leave it.

use crate::equations::Span;
use crate::local::cable::LaneCable;
use cdpr_number::Number;
use cdpr_number::dense::{Lanes2, Lanes6};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::vector::{dot, wrench};

/// u, u coth u and (sinh u/u)².
const CATENARIES: [[f64; 3]; 27] = [
    [0.02, 1.0001333297779134, 1.0001333404446477],
    [0.02449489742783178, 1.000199992000457, 1.0002000160006859],
    [0.03, 1.0002999820015428, 1.0003000360023147],
    [0.03674234614174767, 1.0004499595052065, 1.000450081007811],
    [0.045, 1.0006749088925706, 1.0006751822763633],
    [0.0551135192126215, 1.0010122950280447, 1.001012910151481],
    [0.0675, 1.0015182888797765, 1.0015196729409561],
    [0.08267027881893226, 1.0022770877044433, 1.0022802019551258],
    [0.10125, 1.0034148543437589, 1.0034218617899873],
    [0.1240054182283984, 1.0051205342070941, 1.0051363022546531],
    [0.151875, 1.0076768746528206, 1.007712357143993],
    [0.18600812734259758, 1.0115064931140558, 1.0115863436090249],
    [0.2278125, 1.0172399514147172, 1.0174196657529744],
    [0.2790121910138964, 1.0258155854434492, 1.0262201162801843],
    [0.34171875, 1.0386242183096823, 1.0395350105133716],
    [0.41851828652084455, 1.0577152480149343, 1.0597666085378987],
    [0.512578125, 1.0860821719063531, 1.0907050498546278],
    [0.6277774297812669, 1.1280412864254832, 1.1384689727026605],
    [0.7688671875, 1.1896991682601088, 1.2132574697355716],
    [0.9416661446719004, 1.2794606036808573, 1.33282808779378],
    [1.15330078125, 1.4084488933079546, 1.5299278526817623],
    [1.4124992170078505, 1.5906098616963442, 1.8695583207249007],
    [1.729951171875, 1.8422351010090872, 2.4931493844663244],
    [2.1187488255117755, 2.1808509104125147, 3.745120466072322],
    [2.5949267578125, 2.624010974494838, 6.588105013913786],
    [3.1781232382676636, 3.1891760428865963, 14.209285602615553],
    [3.89239013671875, 3.8956300990104515, 39.63081220847486],
];

/// The lanes in which no catenary between the same ends, of a tension within `limits`, has a smaller φ.
#[inline(always)]
pub(crate) fn is_least<S: Simd>(
    cable: &LaneCable<'_, S>,
    span: &Span<Lanes<S>>,
    multipliers: &Lanes6<S>,
    reference: f64,
    [least, greatest]: &Lanes2<S>,
) -> Mask<S> {
    // λ·w of a unit force at A: w is linear in the force.
    let (zero, one) = (cable.length.all(0.0), cable.length.all(1.0));
    let plane = cable.plane(span);
    let level = wrench(&cable.anchor_arm, &plane.force_on_platform([one, zero]));
    let upright = wrench(&cable.anchor_arm, &plane.force_on_platform([zero, one]));
    let gain = [dot(multipliers, &level), dot(multipliers, &upright)];
    let here = lagrangian(dot(&cable.force, &cable.force).sqrt(), &cable.force, &gain, reference);
    let half_weight = cable.weight_per_length * 0.5;
    let mut is_least = here.less_or_equal(here);
    // Beyond the least tension of the span, where it rises again, no cable is taut.
    let (mut before, mut beyond) = (*greatest * f64::INFINITY, !is_least);
    for [u, coth, stretch] in CATENARIES {
        let force = match &cable.guided {
            None => catenary(span.end, half_weight, [u, coth, stretch]).1,
            Some(guided) => {
                let ((span, _), guide) = (guided.seen(span), guided.in_plane());
                let mut position = guided.leave_point(&cable.free()).position;
                let mut force = cable.force;
                for _ in 0..LEAVING {
                    let end = span.misclosure(position);
                    let (length, closed) = catenary(end, half_weight, [u, coth, stretch]);
                    force = closed;
                    position = guide.leave_point(cable.weight_per_length, length, force).position;
                }
                force
            }
        };
        let there = dot(&force, &force).sqrt();
        beyond = beyond | !there.less_or_equal(before);
        before = there;
        let allowed = !beyond & least.less_or_equal(there) & there.less_or_equal(*greatest);
        is_least = is_least & (here.less_or_equal(lagrangian(there, &force, &gain, reference)) | !allowed);
    }
    is_least
}

/// φ, with λ·w of unit forces at A.
#[inline(always)]
fn lagrangian<S: Simd>(tension: Lanes<S>, force: &Lanes2<S>, gain: &Lanes2<S>, reference: f64) -> Lanes<S> {
    let miss = tension + -reference;
    miss * miss * 0.5 + dot(gain, force)
}

/// Catenaries after which a leave point fits its catenary well enough for a comparison.
const LEAVING: usize = 3;

/// Length and force at A of an inextensible catenary to `end` with half the weight per length, (L4).
#[inline(always)]
fn catenary<S: Simd>(
    [h, z]: Lanes2<S>,
    half_weight: Lanes<S>,
    [u, coth, stretch]: [f64; 3],
) -> (Lanes<S>, Lanes2<S>) {
    let length = (z * z + h * h * stretch).sqrt();
    (length, [half_weight * h * (1.0 / u), half_weight * (z * (coth / u) + length)])
}
