//! Collocation with three stages (E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, second
//! edition, 1996, sections IV.5 and IV.8).
//!
//! The polynomial u of degree 3 has u' = f at the stages. With Radau's points motions that are too fast for a
//! step fade, as they do in cables with damping. With Gauss' points the energy of linear vibrations stays,
//! however fast they are.

use nalgebra::Complex;

/// A method: its stages, and the matrix of its coefficients in the form that Newton's method needs.
#[derive(Debug)]
pub(crate) struct Method {
    /// Times of the stages, as shares of the step.
    pub(crate) stages: [f64; 3],
    /// Weights of the stages in an integral over the step.
    pub(crate) weights: [f64; 3],
    /// Eigenvalues of the inverse of its matrix, and the transformation that makes it diagonal.
    pub(crate) real: f64,
    pub(crate) complex: Complex<f64>,
    pub(crate) to_stages: [[f64; 3]; 3],
    pub(crate) from_stages: [[f64; 3]; 3],
    /// Coefficients of u: of x, x², x³ for each stage.
    pub(crate) polynomial: [[f64; 3]; 3],
}

const S6: f64 = 2.449_489_742_783_178;
const S15: f64 = 3.872_983_346_207_417;

impl Method {
    /// Radau IIA of order 5.
    pub(crate) const RADAU: Self = Self {
        stages: [(4.0 - S6) / 10.0, (4.0 + S6) / 10.0, 1.0],
        weights: [(16.0 - S6) / 36.0, (16.0 + S6) / 36.0, 1.0 / 9.0],
        real: 3.637_834_252_744_496,
        complex: Complex { re: 2.681_082_873_627_752_3, im: -3.050_430_199_247_410_5 },
        to_stages: [
            [0.094_438_762_488_975_24, -0.141_255_295_020_954_2, 0.030_029_194_105_147_424],
            [0.250_213_122_965_333_3, 0.204_129_352_293_799_93, -0.382_942_112_757_261_9],
            [1.0, 1.0, 0.0],
        ],
        from_stages: [
            [4.178_718_591_551_904, 0.327_682_820_761_062_4, 0.523_376_445_499_449_5],
            [-4.178_718_591_551_904, -0.327_682_820_761_062_4, 0.476_623_554_500_550_44],
            [0.502_872_634_945_786_9, -2.571_926_949_855_605, 0.596_039_204_828_224_9],
        ],
        polynomial: [
            [13.0 / 3.0 + 7.0 * S6 / 3.0, -23.0 / 3.0 - 22.0 * S6 / 3.0, 10.0 / 3.0 + 5.0 * S6],
            [13.0 / 3.0 - 7.0 * S6 / 3.0, -23.0 / 3.0 + 22.0 * S6 / 3.0, 10.0 / 3.0 - 5.0 * S6],
            [1.0 / 3.0, -8.0 / 3.0, 10.0 / 3.0],
        ],
    };

    /// That of Gauss of order 6.
    pub(crate) const GAUSS: Self = Self {
        stages: [(5.0 - S15) / 10.0, 0.5, (5.0 + S15) / 10.0],
        weights: [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0],
        real: 4.644_370_709_252_176,
        complex: Complex { re: 3.677_814_645_373_909_6, im: -3.508_761_919_567_442 },
        to_stages: [
            [0.072_151_852_055_200_25, -0.082_241_230_573_630_84, 0.060_120_738_619_308_24],
            [0.118_832_578_741_277_24, 0.053_065_090_742_061_81, -0.316_205_051_132_291_7],
            [1.0, 1.0, 0.0],
        ],
        from_stages: [
            [5.991_698_084_937_8, 1.139_214_295_155_730_2, 0.432_312_113_783_859_14],
            [-5.991_698_084_937_8, -1.139_214_295_155_730_2, 0.567_687_886_216_140_9],
            [1.246_213_273_586_212_6, -2.925_559_646_192_317_2, 0.257_735_201_273_432_5],
        ],
        polynomial: [
            [(20.0 + 5.0 * S15) / 3.0, -(65.0 + 15.0 * S15) / 3.0, (50.0 + 10.0 * S15) / 3.0],
            [-4.0 / 3.0, 40.0 / 3.0, -40.0 / 3.0],
            [(20.0 - 5.0 * S15) / 3.0, -(65.0 - 15.0 * S15) / 3.0, (50.0 - 10.0 * S15) / 3.0],
        ],
    };

    /// Weights of the stages, minus the state at the begin, in the state at the end.
    pub(crate) fn end(&self) -> [f64; 3] {
        self.polynomial.map(|shares| shares.iter().sum())
    }
}
