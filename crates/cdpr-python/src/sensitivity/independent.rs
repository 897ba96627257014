//! The designs whose rows are a sample of independent inputs, as one type.

use crate::convert::{Answer, Raised};
use cdpr_sensitivity::{
    Halton, IndependentSample, Input, JointSample, LatinHypercube, Layout, RandomDesign, SampleDesign,
    SensitivityError, SobolDesign,
};

/// A sample of independent inputs.
#[derive(Clone)]
pub(crate) enum Independent {
    Random(RandomDesign),
    LatinHypercube(LatinHypercube),
    Halton(Halton),
    Sobol(SobolDesign),
}

impl Independent {
    /// The design of a class of Python. Sequences are plain without a seed.
    pub(crate) fn new(
        class: &str,
        inputs: Vec<Input>,
        points: usize,
        first_index: u32,
        seed: Option<u64>,
    ) -> Answer<Self> {
        match (class, seed) {
            (_, Some(_)) if first_index > 0 => {
                return Err(Raised::Input(format!(
                    "first_index is {first_index}: expected 0 where there is a seed"
                )));
            }
            ("RandomDesign" | "LatinHypercube" | "CentredLatinHypercube", None) => {
                return Err(Raised::Input("seed is None: expected a whole number".to_owned()));
            }
            _ => {}
        }
        Ok(match (class, seed) {
            ("RandomDesign", Some(seed)) => Self::Random(RandomDesign::new(inputs, points, seed)?),
            ("LatinHypercube", Some(seed)) => {
                Self::LatinHypercube(LatinHypercube::new(inputs, points, seed)?)
            }
            ("CentredLatinHypercube", Some(seed)) => {
                Self::LatinHypercube(LatinHypercube::centred(inputs, points, seed)?)
            }
            ("HaltonDesign", Some(seed)) => Self::Halton(Halton::scrambled(inputs, points, seed)?),
            ("HaltonDesign", None) => Self::Halton(Halton::new(inputs, first_index, points)?),
            ("SobolDesign", Some(seed)) => Self::Sobol(SobolDesign::scrambled(inputs, points, seed)?),
            ("SobolDesign", None) => Self::Sobol(SobolDesign::new(inputs, first_index, points)?),
            _ => return Err(Raised::Input(format!("the design is {class:?}: expected a class of designs"))),
        })
    }
}

/// Passes a call on to the design.
macro_rules! of {
    ($of:expr, $design:ident => $call:expr) => {
        match $of {
            Independent::Random($design) => $call,
            Independent::LatinHypercube($design) => $call,
            Independent::Halton($design) => $call,
            Independent::Sobol($design) => $call,
        }
    };
}

impl SampleDesign for Independent {
    fn layout(&self) -> &Layout {
        of!(self, design => design.layout())
    }

    fn replicate(&self, seed: u64) -> Self {
        match self {
            Self::Random(design) => Self::Random(design.replicate(seed)),
            Self::LatinHypercube(design) => Self::LatinHypercube(design.replicate(seed)),
            Self::Halton(design) => Self::Halton(design.replicate(seed)),
            Self::Sobol(design) => Self::Sobol(design.replicate(seed)),
        }
    }

    fn unit_point(&self, index: usize, point: &mut [f64]) -> Result<(), SensitivityError> {
        of!(self, design => design.unit_point(index, point))
    }

    fn unit_points(&self, first: usize, points: &mut [f64]) -> Result<(), SensitivityError> {
        of!(self, design => design.unit_points(first, points))
    }

    fn rows(&self, first: usize, rows: &mut [f64]) -> Result<(), SensitivityError> {
        of!(self, design => design.rows(first, rows))
    }
}

impl JointSample for Independent {}
impl IndependentSample for Independent {}
