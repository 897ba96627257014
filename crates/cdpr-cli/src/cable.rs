//! Commands about one cable: its catenary, modulus and mass per length.

pub(crate) mod catenary;
pub(crate) mod linear_density;
pub(crate) mod modulus;
