//! A cable with its force as a vector in space, and the derivatives of what follows from it.
//!
//! Where the swivel axis of a pulley is tilted, the plane of the wheel is not that of the cable, and the
//! leave point lies beside the cable's plane. The force F at A is then the unknown, and (C22) its
//! flexibility in space. Axes: the origin is the entry point D, z points up.

use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::catenary::guided::Guided;
use crate::guide::{Entry, Guide};
use crate::kernel::{GuidedInSpace, Response};
use cdpr_number::vector::{cross, dot};
use cdpr_number::{Dual, Number, Real};
use nalgebra::{Matrix3, SMatrix, Vector2, Vector3};

/// A cable in equilibrium, over a pulley with any axis or without: its unstrained length and the force at A
/// in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialCable<'a> {
    /// The cable. The direction [`Entry::Along`] of its guide has the components along x, y and z.
    pub cable: Cable<'a>,
    /// Unstrained length L [m].
    pub unstrained_length: f64,
    /// Force on the cable at A [N].
    pub force: Vector3<f64>,
}

/// How the end of a cable answers in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialResponse {
    /// Where the cable leaves the wheel, from D [m].
    pub leave: Vector3<f64>,
    /// Position of A from D [m].
    pub end: Vector3<f64>,
    /// Flexibility dA/dF at constant length [m/N], (C22); not quite symmetric for a cable with weight.
    pub flexibility: Matrix3<f64>,
    /// dA/dL at constant force [m/m], (C23).
    pub end_per_length: Vector3<f64>,
}

/// What a cable and its guide are: the columns of [`PropertySlopes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// Weight per length [N/m].
    Weight,
    /// Axial stiffness [N].
    Stiffness,
    /// Lead [m].
    Lead,
    /// Radius of the pulley [m].
    Radius,
    /// Direction in which the cable enters its pulley: the first of three components.
    Axis,
}

/// Derivatives of a vector by what a cable and its guide are, a column each in the order of [`Property`].
/// Those by the pulley are zero without one.
pub type PropertySlopes = SMatrix<f64, 3, 7>;

/// A vector that a cable has between fixed ends, with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldSlopes {
    /// The vector v.
    pub value: Vector3<f64>,
    /// By the length, or by the tension where that is given.
    pub per_actuation: Vector3<f64>,
    /// By the position of A from D.
    pub per_end: Matrix3<f64>,
    /// By what cable and guide are.
    pub per_property: PropertySlopes,
}

impl HeldSlopes {
    fn mean(&self, other: &Self) -> Self {
        Self {
            value: 0.5 * (self.value + other.value),
            per_actuation: 0.5 * (self.per_actuation + other.per_actuation),
            per_end: 0.5 * (self.per_end + other.per_end),
            per_property: 0.5 * (self.per_property + other.per_property),
        }
    }

    /// The same vector, with the tension given instead of the length, from the derivatives of the force.
    fn at_tension(&self, of_force: &Self) -> Self {
        let direction = of_force.value.normalize();
        let per_tension = self.per_actuation / direction.dot(&of_force.per_actuation);
        Self {
            value: self.value,
            per_actuation: per_tension,
            per_end: self.per_end - per_tension * direction.tr_mul(&of_force.per_end),
            per_property: self.per_property - per_tension * direction.tr_mul(&of_force.per_property),
        }
    }
}

/// Where the horizontal force is a smaller share of the tension, differences with respect to it lose digits.
const NEARLY_VERTICAL: f64 = 1e-8;

/// The share by which a vertical force is moved aside: its square is rounding.
const ASIDE: f64 = 1e-7;

/// Inputs of derivatives between fixed ends: seven of [`Numbers::with_inputs`], the length, the force.
const INPUTS: usize = 11;
const LENGTH: usize = 7;
const FORCE: usize = 8;

type Input = Dual<f64, INPUTS>;

/// A vector with its derivatives by all inputs, a column each.
type WithSlopes = (Vector3<f64>, SMatrix<f64, 3, INPUTS>);

/// A cable with the derivatives by all inputs.
struct Differentiated {
    force: [Input; 3],
    /// Force on the cable where it leaves its guide, `w Lf e_z - F` of (C20).
    leave_force: [Input; 3],
    response: GuidedInSpace<Input>,
    /// K = C⁻¹.
    stiffness: Matrix3<f64>,
}

fn with_slopes(vector: &[Input; 3]) -> WithSlopes {
    (vector.map(|of| of.value).into(), SMatrix::from_fn(|i, k| vector[i].slopes[k]))
}

/// Horizontal forces below this share of the whole have no direction.
const VERTICAL: f64 = 1e-20;

/// The response of the cable to the force `force` [N] at A.
fn response<T: Real>(cable: &Cable, numbers: &Numbers<T>, force: &[T; 3]) -> GuidedInSpace<T> {
    free_length_and_response(cable, numbers, force).1
}

/// The unstrained length beyond the leave point [m], and the response to the force `force` [N] at A.
fn free_length_and_response<T: Real>(
    cable: &Cable,
    numbers: &Numbers<T>,
    force: &[T; 3],
) -> (T, GuidedInSpace<T>) {
    let (fx, [c, s]) = horizontal(force);
    let in_plane = [fx, force[2]];
    let (free_length, in_plane) = match cable.guide {
        None => (numbers.length, without_guide(&cable.free_response(numbers, in_plane))),
        Some(_) => {
            let [kx, ky, kz] = numbers.axis;
            let turned = Numbers { axis: [c * kx + s * ky, c * ky - s * kx, kz], ..*numbers };
            let guided = Guided::new(cable, &guide(cable), &turned, in_plane);
            let free = cable.free_response(&Numbers { length: guided.free, ..*numbers }, in_plane);
            (guided.free, guided.in_space(fx, &free))
        }
    };
    let GuidedInSpace { leave, end, flexibility, end_per_length, free_per_force } = in_plane;
    let turn = |[h, l, z]: [T; 3]| [c * h - s * l, s * h + c * l, z];
    let rows = flexibility.map(turn);
    let columns = [0, 1, 2].map(|j| turn(rows.map(|row| row[j])));
    let response = GuidedInSpace {
        leave: turn(leave),
        end: turn(end),
        flexibility: [0, 1, 2].map(|i| columns.map(|column| column[i])),
        end_per_length: turn(end_per_length),
        free_per_force: turn(free_per_force),
    };
    (free_length, response)
}

/// The response in space of a cable without guide, in the axes of its plane.
fn without_guide<T: Real>(free: &Response<T>) -> GuidedInSpace<T> {
    let Response { end: [x, z], flexibility: [xx, xz, zz], end_per_length: [ex, ez], .. } = *free;
    let (o, across) = (T::of(0.0), free.lateral_flexibility);
    GuidedInSpace {
        leave: [o; 3],
        end: [x, o, z],
        flexibility: [[xx, o, xz], [o, across, o], [xz, o, zz]],
        end_per_length: [ex, o, ez],
        free_per_force: [o; 3],
    }
}

/// `matrix⁻¹ right` by Cramer's rule, for a matrix of rows.
fn solve<T: Real>([a, b, c]: &[[T; 3]; 3], right: &[T; 3]) -> [T; 3] {
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, &columns[0]);
    [0, 1, 2].map(|i| dot(&columns.map(|column| column[i]), right) / determinant)
}

/// The guide of a cable; the axis of a pulley is one that may be tilted.
pub(crate) fn guide(cable: &Cable) -> Guide {
    let guide = cable.guide.unwrap_or(Guide { lead: 0.0, radius: 0.0, entry: Entry::Upwards });
    let entry = if guide.radius > 0.0 { Entry::Along(guide.entry.axis()) } else { Entry::Upwards };
    Guide { entry, ..guide }
}

/// The horizontal part of a force [N] and its direction, x where it has none.
pub(crate) fn horizontal<T: Real>([x, y, z]: &[T; 3]) -> (T, [T; 2]) {
    let square = *x * *x + *y * *y;
    let least = VERTICAL * z.value().abs();
    if square.value() <= least * least {
        return (T::of(0.0), [T::of(1.0), T::of(0.0)]);
    }
    let fx = square.sqrt();
    (fx, [*x / fx, *y / fx])
}

/// A vector in its vertical plane, and the direction of the plane.
pub(crate) fn flat(v: Vector3<f64>) -> (Vector2<f64>, [f64; 2]) {
    let (x, azimuth) = horizontal(&v.into());
    (Vector2::new(x, v.z), azimuth)
}

/// A vector of the vertical plane with a direction.
pub(crate) fn lifted(v: Vector2<f64>, [c, s]: [f64; 2]) -> Vector3<f64> {
    Vector3::new(c * v.x, s * v.x, v.y)
}

impl<'a> SpatialCable<'a> {
    pub(crate) fn numbers(&self) -> Numbers<f64> {
        self.cable.numbers(self.unstrained_length)
    }

    /// The cable in its vertical plane, and the horizontal direction of the plane.
    pub fn in_plane(&self) -> (Catenary<'a>, Vector2<f64>) {
        let (fx, azimuth) = horizontal(&self.force.into());
        let cable = self.cable.turned(azimuth);
        let force = Vector2::new(fx, self.force.z);
        (Catenary { cable, unstrained_length: self.unstrained_length, force }, azimuth.into())
    }

    /// Tension at A [N].
    pub fn anchor_tension(&self) -> f64 {
        self.force.norm()
    }

    /// Whether this is a slack cable without weight, which has no shape.
    pub fn is_slack_and_weightless(&self) -> bool {
        self.force == Vector3::zeros() && self.cable.is_weightless(self.unstrained_length)
    }

    /// Position of A, flexibility and dA/dL.
    pub fn response(&self) -> SpatialResponse {
        let force = self.force.into();
        let GuidedInSpace { leave, end, flexibility, end_per_length, .. } =
            response(&self.cable, &self.numbers(), &force);
        SpatialResponse {
            leave: leave.into(),
            end: end.into(),
            flexibility: Matrix3::from_fn(|i, j| flexibility[i][j]),
            end_per_length: end_per_length.into(),
        }
    }

    /// The force `K d` [N/m] by which the cable answers to a unit motion `d` of A, with its derivatives at
    /// constant `d`: second derivatives of the force between held ends.
    ///
    /// With `K = C⁻¹` and the derivatives ∂ of position and flexibility C at constant force,
    ///
    /// ```text
    /// d(K d) = -K (∂C/∂F dF + ∂C) K d,      dF = K (dA - ∂A)                                     (C28)
    /// ```
    ///
    /// Not a number for a cable that hangs folded in a vertical plane without width.
    pub fn stiffness_slopes(&self, direction: Vector3<f64>) -> HeldSlopes {
        self.between_fixed_ends(|Differentiated { response, stiffness, .. }| {
            let value = stiffness * direction;
            let entry = |i: usize, j: usize, k: usize| response.flexibility[i][j].slopes[k];
            let mut slopes = SMatrix::<f64, 3, INPUTS>::zeros();
            for k in 0..INPUTS {
                // (C28)
                slopes.set_column(k, &(-stiffness * (Matrix3::from_fn(|i, j| entry(i, j, k)) * value)));
            }
            (value, slopes)
        })
    }

    /// The force on the cable where it leaves its guide [N], `w Lf e_z - F` of (C20), with its derivatives
    /// between fixed ends.
    ///
    /// Not a number for a cable that hangs folded in a vertical plane without width.
    pub fn leave_force_slopes(&self) -> HeldSlopes {
        self.between_fixed_ends(|of| with_slopes(&of.leave_force))
    }

    /// How the force at A changes with the tension t there between fixed ends, v = dF/dt, with its
    /// derivatives at given tension.
    ///
    /// With `s = C⁻¹ dA/dL`, u the direction of the force and the derivatives ∂ at given length,
    ///
    /// ```text
    /// v = s/(u·s),      dv = ∂v + ∂v/∂L dL,      u·(∂F/∂L dL + ∂F) = dt                           (C37)
    /// ```
    ///
    /// Not a number for a cable that hangs folded in a vertical plane without width.
    pub fn tension_slopes(&self) -> HeldSlopes {
        let of_force = self.between_fixed_ends(|of| with_slopes(&of.force));
        let rate = self.between_fixed_ends(|Differentiated { response, force, .. }| {
            let s = solve(&response.flexibility, &response.end_per_length);
            let per_tension = dot(force, force).sqrt() / dot(force, &s);
            with_slopes(&s.map(|component| component * per_tension))
        });
        rate.at_tension(&of_force)
    }

    /// A vector with its derivatives between fixed ends at given length, from those at constant force and
    /// length that `of` returns. The inputs are what [`Numbers::with_inputs`] has, the length, and the force.
    fn between_fixed_ends(&self, of: impl Fn(&Differentiated) -> WithSlopes) -> HeldSlopes {
        let plain = self.numbers();
        let at = |force: Vector3<f64>| {
            let mut numbers = plain.with_inputs();
            numbers.length = Dual::input(plain.length, LENGTH);
            let force = [0, 1, 2].map(|k| Dual::input(force[k], FORCE + k));
            let (free, response) = free_length_and_response(&self.cable, &numbers, &force);
            let flexibility = Matrix3::from_fn(|i, j| response.flexibility[i][j].value);
            let stiffness = flexibility.try_inverse().unwrap_or_else(|| Matrix3::repeat(f64::NAN));
            let leave_force = [-force[0], -force[1], numbers.weight_per_length * free - force[2]];
            let end = response.end;
            let (value, at_force) = of(&Differentiated { force, leave_force, response, stiffness });
            let per_end = at_force.fixed_columns::<3>(FORCE) * stiffness;
            let slope = |k: usize| at_force.column(k) - per_end * Vector3::from(end.map(|end| end.slopes[k]));
            let per_property = self.by_property(slope);
            HeldSlopes { value, per_actuation: slope(LENGTH), per_end, per_property }
        };
        let (fx, azimuth) = horizontal(&self.force.into());
        if fx > NEARLY_VERTICAL * self.anchor_tension() {
            return at(self.force);
        }
        // The plane of a vertical cable turns at once: what is odd about the vertical is zero.
        let [one, other] = [ASIDE, -ASIDE].map(|share| {
            let aside = share * self.anchor_tension();
            at(Vector3::new(aside * azimuth[0], aside * azimuth[1], self.force.z))
        });
        one.mean(&other)
    }

    /// Derivatives of the position of A at constant force and length.
    pub fn slopes(&self) -> PropertySlopes {
        let numbers = self.numbers().with_inputs::<7>();
        let force = <[f64; 3]>::from(self.force).map(Dual::of);
        let end = response(&self.cable, &numbers, &force).end;
        self.by_property(|k| end.map(|component| component.slopes[k]).into())
    }

    /// Derivatives by what cable and guide are, from those by the inputs of [`Numbers::with_inputs`].
    fn by_property(&self, slope: impl Fn(usize) -> Vector3<f64>) -> PropertySlopes {
        let flexibility = self.numbers().axial_flexibility;
        let count = match self.cable.guide {
            None => 2,
            Some(guide) if guide.radius == 0.0 => 3,
            Some(_) => 7,
        };
        let mut slopes = PropertySlopes::zeros();
        for k in 0..count {
            slopes.set_column(k, &slope(k));
        }
        let mut per_stiffness = slopes.column_mut(Property::Stiffness as usize);
        per_stiffness *= -flexibility * flexibility;
        slopes
    }
}

impl Numbers<f64> {
    /// The numbers as dual ones, with weight, 1/EA, lead, radius and the three components of the axis as the
    /// first inputs.
    fn with_inputs<const N: usize>(&self) -> Numbers<Dual<f64, N>> {
        Numbers {
            weight_per_length: Dual::input(self.weight_per_length, 0),
            axial_flexibility: Dual::input(self.axial_flexibility, 1),
            lead: Dual::input(self.lead, 2),
            radius: Dual::input(self.radius, 3),
            length: Dual::of(self.length),
            axis: [0, 1, 2].map(|k| Dual::input(self.axis[k], 4 + k)),
        }
    }
}

impl Cable<'_> {
    /// The cable with a tilted axis along x, y and z as it is in the vertical plane of this direction.
    pub fn turned(&self, [c, s]: [f64; 2]) -> Self {
        let turned = |guide: Guide| match guide.entry {
            Entry::Along([x, y, z]) => {
                Guide { entry: Entry::Along([c * x + s * y, c * y - s * x, z]), ..guide }
            }
            _ => guide,
        };
        Self { guide: self.guide.map(turned), ..*self }
    }
}
