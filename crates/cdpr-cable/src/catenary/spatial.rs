//! A cable whose pulley swivels about an axis that is not vertical, with its force as a vector in space.
//!
//! Where the axis is tilted, the plane of the wheel is not that of the cable, and the leave point lies beside
//! the cable's plane. The force F at A is then the unknown, and (C22) its flexibility in space. Axes: the
//! origin is the entry point D, z points up.

use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::catenary::guided::Guided;
use crate::guide::{Entry, Guide};
use crate::kernel::GuidedInSpace;
use cdpr_number::{Dual, Real};
use nalgebra::{Matrix3, Matrix3xX, Vector2, Vector3};

/// A cable in equilibrium over a pulley with any axis: its unstrained length and the force at A in space.
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

/// Derivatives of the position of A at constant force and length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialSlopes {
    /// Per weight per length [m²/N].
    pub per_weight: Vector3<f64>,
    /// Per axial stiffness [m/N].
    pub per_stiffness: Vector3<f64>,
    /// Per lead [m/m].
    pub per_lead: Vector3<f64>,
    /// Per radius of the pulley [m/m].
    pub per_radius: Vector3<f64>,
    /// Per component of the direction in which the cable enters its pulley [m].
    pub per_axis: Matrix3<f64>,
}

/// A vector that a cable has between held ends, with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldSlopes {
    /// The vector v.
    pub value: Vector3<f64>,
    /// By the length, or by the tension where that is given.
    pub per_actuation: Vector3<f64>,
    /// By the position of A from D.
    pub per_end: Matrix3<f64>,
    /// By the weight per length.
    pub per_weight: Vector3<f64>,
    /// By the axial stiffness.
    pub per_stiffness: Vector3<f64>,
    /// By the lead.
    pub per_lead: Vector3<f64>,
    /// By the radius of the pulley.
    pub per_radius: Vector3<f64>,
    /// By the direction in which the cable enters its pulley.
    pub per_axis: Matrix3<f64>,
}

impl HeldSlopes {
    fn mean(&self, other: &Self) -> Self {
        let vector = |of: fn(&Self) -> Vector3<f64>| 0.5 * (of(self) + of(other));
        let matrix = |of: fn(&Self) -> Matrix3<f64>| 0.5 * (of(self) + of(other));
        Self {
            value: vector(|slopes| slopes.value),
            per_actuation: vector(|slopes| slopes.per_actuation),
            per_end: matrix(|slopes| slopes.per_end),
            per_weight: vector(|slopes| slopes.per_weight),
            per_stiffness: vector(|slopes| slopes.per_stiffness),
            per_lead: vector(|slopes| slopes.per_lead),
            per_radius: vector(|slopes| slopes.per_radius),
            per_axis: matrix(|slopes| slopes.per_axis),
        }
    }
}

/// Where the horizontal force is a smaller share of the tension, differences with respect to it lose digits.
const NEARLY_VERTICAL: f64 = 1e-8;

/// The share by which a vertical force is moved aside: its square is rounding.
const ASIDE: f64 = 1e-7;

/// Inputs of derivatives between held ends: seven of [`Numbers::with_inputs`], the length, the force.
const INPUTS: usize = 11;
const LENGTH: usize = 7;
const FORCE: usize = 8;

type Input = Dual<f64, INPUTS>;

/// Horizontal forces below this share of the whole have no direction.
const VERTICAL: f64 = 1e-20;

/// The response of the cable to the force `force` [N] at A.
pub(crate) fn response<T: Real>(cable: &Cable, numbers: &Numbers<T>, force: &[T; 3]) -> GuidedInSpace<T> {
    free_length_and_response(cable, numbers, force).1
}

/// The unstrained length beyond the leave point [m], and the response to the force `force` [N] at A.
fn free_length_and_response<T: Real>(
    cable: &Cable,
    numbers: &Numbers<T>,
    force: &[T; 3],
) -> (T, GuidedInSpace<T>) {
    let z = force[2];
    let (fx, [c, s]) = horizontal(force);
    let [kx, ky, kz] = numbers.axis;
    let in_plane = Numbers { axis: [c * kx + s * ky, c * ky - s * kx, kz], ..*numbers };
    let guided = Guided::new(cable, &guide(cable), &in_plane, [fx, z]);
    let free = cable.free_response(&Numbers { length: guided.free, ..*numbers }, [fx, z]);
    let GuidedInSpace { leave, end, flexibility, end_per_length, free_per_force } =
        guided.in_space(fx, &free);
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
    (guided.free, response)
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

/// A derivative by EA from that by 1/EA.
pub(crate) fn per_stiffness(numbers: &Numbers<f64>, per_flexibility: Vector3<f64>) -> Vector3<f64> {
    per_flexibility * (-numbers.axial_flexibility * numbers.axial_flexibility)
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
        self.between_held_ends(|found, _, stiffness| {
            let value = stiffness * direction;
            let entry = |i: usize, j: usize, k: usize| found.flexibility[i][j].slopes[k];
            // (C28)
            let slopes = (0..INPUTS).map(|k| -stiffness * (Matrix3::from_fn(|i, j| entry(i, j, k)) * value));
            (value, Matrix3xX::from_columns(&slopes.collect::<Vec<_>>()))
        })
    }

    /// The force on the cable where it leaves its guide [N], `w Lf e_z - F` of (C20), with its derivatives
    /// between held ends.
    ///
    /// Not a number for a cable that hangs folded in a vertical plane without width.
    pub fn leave_force_slopes(&self) -> HeldSlopes {
        self.between_held_ends(|_, force, _| {
            (force.map(|of| of.value).into(), Matrix3xX::from_fn(INPUTS, |i, k| force[i].slopes[k]))
        })
    }

    /// A vector with its derivatives between held ends, from those at constant force and length that `of`
    /// returns of the response, the force at the leave point and the stiffness. The inputs are what
    /// [`Numbers::with_inputs`] has, the length, and the force.
    fn between_held_ends(
        &self,
        of: impl Fn(&GuidedInSpace<Input>, &[Input; 3], &Matrix3<f64>) -> (Vector3<f64>, Matrix3xX<f64>),
    ) -> HeldSlopes {
        let plain = self.numbers();
        let at = |force: Vector3<f64>| {
            let mut numbers = plain.with_inputs::<INPUTS, 0>();
            numbers.length = Dual::input(plain.length, LENGTH);
            let force = [0, 1, 2].map(|k| Dual::input(force[k], FORCE + k));
            let (free, found) = free_length_and_response(&self.cable, &numbers, &force);
            let flexibility = Matrix3::from_fn(|i, j| found.flexibility[i][j].value);
            let stiffness = flexibility.try_inverse().unwrap_or_else(|| Matrix3::repeat(f64::NAN));
            let leave_force = [-force[0], -force[1], numbers.weight_per_length * free - force[2]];
            let (value, at_force) = of(&found, &leave_force, &stiffness);
            let per_end = at_force.fixed_columns::<3>(FORCE) * stiffness;
            let slope =
                |k: usize| at_force.column(k) - per_end * Vector3::from(found.end.map(|end| end.slopes[k]));
            HeldSlopes {
                value,
                per_actuation: slope(LENGTH),
                per_end,
                per_weight: slope(0),
                per_stiffness: per_stiffness(&plain, slope(1)),
                per_lead: slope(2),
                per_radius: slope(3),
                per_axis: Matrix3::from_columns(&[4, 5, 6].map(slope)),
            }
        };
        let (fx, azimuth) = horizontal(&self.force.into());
        if fx > NEARLY_VERTICAL * self.anchor_tension() {
            return at(self.force);
        }
        // The plane of a vertical cable turns at once: what is odd about the vertical is zero.
        let [one, other] = [ASIDE, -ASIDE].map(|share| {
            at(self.force + Vector3::new(azimuth[0], azimuth[1], 0.0) * (share * self.anchor_tension()))
        });
        one.mean(&other)
    }

    /// Derivatives of the position of A with respect to what the cable and its guide are.
    pub fn slopes(&self) -> SpatialSlopes {
        let plain = self.numbers();
        let numbers = plain.with_inputs::<7, 0>();
        let force = <[f64; 3]>::from(self.force).map(Dual::of);
        let end = response(&self.cable, &numbers, &force).end;
        let slopes = Matrix3xX::from_fn(7, |i, k| end[i].slopes[k]);
        let column = |k: usize| Vector3::from(slopes.fixed_columns::<1>(k));
        SpatialSlopes {
            per_weight: column(0),
            per_stiffness: per_stiffness(&plain, column(1)),
            per_lead: column(2),
            per_radius: column(3),
            per_axis: slopes.fixed_columns::<3>(4).into(),
        }
    }
}

impl Numbers<f64> {
    /// The numbers as dual ones, with weight, 1/EA, lead, radius and the three components of the axis as the
    /// inputs from number `FIRST` on.
    pub(crate) fn with_inputs<const N: usize, const FIRST: usize>(&self) -> Numbers<Dual<f64, N>> {
        let input = |value: f64, k: usize| Dual::input(value, FIRST + k);
        Numbers {
            weight_per_length: input(self.weight_per_length, 0),
            axial_flexibility: input(self.axial_flexibility, 1),
            lead: input(self.lead, 2),
            radius: input(self.radius, 3),
            length: Dual::of(self.length),
            axis: [0, 1, 2].map(|k| input(self.axis[k], 4 + k)),
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
