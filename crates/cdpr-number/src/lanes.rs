//! Several numbers at a time: the lanes of the processor's vector unit. No other module names pulp.
//!
//! A formula written for [`Lanes`] is evaluated for as many problems as the unit has lanes: 8 with AVX-512, 4
//! with AVX2, 1 without either. The unit is detected when the program runs. Only `+ - * /`, square roots and
//! comparisons are used, which IEEE 754 defines to the bit, and nothing is fused: a problem has the same
//! answer in any lane of any unit. Lanes cannot branch; a [`Mask`] selects between them.

use crate::number::{Lanewise, Number};
use pulp::Arch;
pub use pulp::{Scalar, Simd, WithSimd};
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub, SubAssign};
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

/// Largest number of lanes of any vector unit.
pub const MAX_LANES: usize = 8;

/// A vector unit of the processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// None: one lane.
    Scalar,
    /// AVX2: four lanes.
    Avx2,
    /// The widest one there is.
    Widest,
}

/// The unit of [`dispatch`].
static UNIT: AtomicU8 = AtomicU8::new(Unit::Widest as u8);

/// Held by who chooses the unit.
static CHOICE: Mutex<()> = Mutex::new(());

impl Unit {
    /// The units of this processor, the narrowest first.
    pub fn all() -> Vec<Self> {
        let units = [Self::Scalar, Self::Avx2, Self::Widest];
        units.into_iter().filter(|unit| *unit != Self::Avx2 || avx2().is_some()).collect()
    }

    /// Carries out `task` with this unit on all threads, for tests and measurements: no result depends on the
    /// unit. Calls wait for each other.
    pub fn run<R>(self, task: impl FnOnce() -> R) -> R {
        struct Reset;
        impl Drop for Reset {
            fn drop(&mut self) {
                UNIT.store(Unit::Widest as u8, Relaxed);
            }
        }
        let _choice = CHOICE.lock().unwrap_or_else(PoisonError::into_inner);
        let _reset = Reset;
        UNIT.store(self as u8, Relaxed);
        task()
    }
}

#[cfg(target_arch = "x86_64")]
fn avx2() -> Option<pulp::x86::V3> {
    pulp::x86::V3::try_new()
}

#[cfg(not(target_arch = "x86_64"))]
fn avx2() -> Option<Scalar> {
    None
}

/// Runs `task` on the widest vector unit there is, or that of [`Unit::run`].
pub fn dispatch<T: WithSimd>(task: T) -> T::Output {
    let unit = UNIT.load(Relaxed);
    if unit == Unit::Widest as u8 {
        return Arch::new().dispatch(task);
    }
    match avx2() {
        Some(avx2) if unit == Unit::Avx2 as u8 => Simd::vectorize(avx2, task),
        _ => Simd::vectorize(Scalar, task),
    }
}

/// Defines functions each of which is compiled once for every vector unit, apart from its callers: that of
/// the number that `on` names.
///
/// ```
/// use cdpr_number::apart;
/// use cdpr_number::lanes::{Lanes, Scalar, Simd};
///
/// apart! {
///     /// The sum of two numbers.
///     on(first) fn sum<'a, S: Simd>(first: Lanes<S>, second: &'a Lanes<S>) -> Lanes<S> {
///         first + *second
///     }
/// }
/// let two = Lanes::splat(Scalar, 2.0);
/// assert_eq!(sum(two, &two).first(), 4.0);
/// ```
#[macro_export]
macro_rules! apart {
    ($(
        $(#[$attribute:meta])*
        on($lanes:expr) $visibility:vis fn $name:ident<$($lifetime:lifetime,)* $($kind:ident: $bound:ident),+>(
            $($argument:ident: $type:ty),* $(,)?
        ) $(-> $output:ty)? $body:block
    )+) => {$(
        $(#[$attribute])*
        $visibility fn $name<$($lifetime,)* $($kind: $bound),+>($($argument: $type),*) $(-> $output)? {
            struct Arguments<$($lifetime,)* $($kind: $bound),+> { $($argument: $type),* }

            impl<$($lifetime,)* $($kind: $bound),+> $crate::lanes::WithSimd for Arguments<$($lifetime,)* $($kind),+> {
                type Output = ($($output)?);

                #[inline(always)]
                fn with_simd<Same: $crate::lanes::Simd>(self, _: Same) -> Self::Output {
                    let Self { $($argument),* } = self;
                    $body
                }
            }
            let lanes = $lanes;
            lanes.apart(Arguments { $($argument),* })
        }
    )+};
}

/// One number in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<S: Simd> {
    simd: S,
    values: S::f64s,
}

/// One choice in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Mask<S: Simd> {
    simd: S,
    values: S::m64s,
}

impl<S: Simd> Lanes<S> {
    /// Number of lanes.
    pub const COUNT: usize = S::F64_LANES;

    /// The same number in all lanes.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, values: simd.splat_f64s(value) }
    }

    /// A value for each lane.
    #[inline(always)]
    pub fn from_fn(simd: S, value: impl Fn(usize) -> f64) -> Self {
        let mut values = [0.0; MAX_LANES];
        for (lane, number) in values[..Self::COUNT].iter_mut().enumerate() {
            *number = value(lane);
        }
        Self::from_array(simd, &values)
    }

    /// The first values of an array, one for each lane.
    #[inline(always)]
    pub fn from_array(simd: S, values: &[f64; MAX_LANES]) -> Self {
        // A whole vector: pulp loads a part of one by a function call.
        let (vectors, _) = S::as_simd_f64s(&values[..Self::COUNT]);
        Self { simd, values: vectors[0] }
    }

    /// The same number in all lanes, on the unit of this one.
    #[inline(always)]
    pub fn all(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// Carries out `task` with this vector unit in a function of its own.
    #[inline(always)]
    pub fn apart<T: WithSimd>(self, task: T) -> T::Output {
        self.simd.vectorize(task)
    }

    /// The value of each lane; zeros beyond the last one.
    #[inline(always)]
    pub fn to_array(self) -> [f64; MAX_LANES] {
        let mut values = [0.0; MAX_LANES];
        let (vectors, _) = S::as_mut_simd_f64s(&mut values[..Self::COUNT]);
        vectors[0] = self.values;
        values
    }

    /// The value of the first lane.
    #[inline(always)]
    pub fn first(self) -> f64 {
        self.to_array()[0]
    }

    /// Absolute values.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { values: self.simd.abs_f64s(self.values), ..self }
    }

    /// The larger one; `other` where one of them is NaN.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        other.less_or_equal(self).select(self, other)
    }

    /// Assigns another number in the lanes that are `active`.
    #[inline(always)]
    pub fn replace(&mut self, other: Self, active: Mask<S>) {
        *self = active.select(other, *self);
    }

    /// False where one of them is NaN.
    #[inline(always)]
    pub fn less_or_equal(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, values: self.simd.less_than_or_equal_f64s(self.values, other.values) }
    }
}

impl<S: Simd> Mask<S> {
    /// One of two numbers in each lane.
    #[inline(always)]
    pub fn select(self, chosen: Lanes<S>, otherwise: Lanes<S>) -> Lanes<S> {
        Lanes { simd: self.simd, values: self.simd.select_f64s(self.values, chosen.values, otherwise.values) }
    }

    /// The choice of each lane; false beyond the last one.
    #[inline(always)]
    pub fn to_array(self) -> [bool; MAX_LANES] {
        let one = Lanes::splat(self.simd, 1.0);
        self.select(one, one.all(0.0)).to_array().map(|value| value == 1.0)
    }

    /// Whether it is true in any lane.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.simd.first_true_m64s(self.values) < Lanes::<S>::COUNT
    }
}

impl<S: Simd> Not for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self { values: self.simd.not_m64s(self.values), ..self }
    }
}

macro_rules! operator {
    ($kind:ident, $trait:ident, $function:ident, $simd:ident) => {
        impl<S: Simd> $trait for $kind<S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self { values: self.simd.$simd(self.values, other.values), ..self }
            }
        }
    };
}

operator!(Lanes, Add, add, add_f64s);
operator!(Lanes, Sub, sub, sub_f64s);
operator!(Lanes, Mul, mul, mul_f64s);
operator!(Lanes, Div, div, div_f64s);
operator!(Mask, BitAnd, bitand, and_m64s);
operator!(Mask, BitOr, bitor, or_m64s);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        // pulp's own is a function call.
        self.all(-0.0) - self
    }
}

impl<S: Simd> Add<f64> for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        self + self.all(other)
    }
}

impl<S: Simd> Mul<f64> for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self * self.all(other)
    }
}

impl<S: Simd> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> SubAssign for Lanes<S> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<S: Simd> Lanewise for Lanes<S> {
    type Mask = Mask<S>;

    #[inline(always)]
    fn at_most(self, bound: f64) -> Mask<S> {
        self.less_or_equal(self.all(bound))
    }

    #[inline(always)]
    fn all(mask: Mask<S>) -> bool {
        !(!mask).any()
    }

    #[inline(always)]
    fn select(mask: Mask<S>, chosen: Self, otherwise: Self) -> Self {
        mask.select(chosen, otherwise)
    }
}

impl<S: Simd> Number for Lanes<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    #[inline(always)]
    fn recip(self) -> Self {
        self.all(1.0) / self
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self { values: self.simd.sqrt_f64s(self.values), ..self }
    }
}
