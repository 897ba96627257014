//! The scrambling of Sobol's sequence against Owen's, in which every node of the tree of digits has an
//! independent coin.

use cdpr_sensitivity::Sobol;
use proptest::prelude::*;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::HashMap;

const CELLS: f64 = (1_u64 << 32) as f64;
const DIMENSIONS: usize = 5;

/// Owen's scrambling, whose coins are drawn where they are needed.
struct Exact {
    generator: ChaCha8Rng,
    coins: HashMap<(usize, u32, u32), bool>,
}

impl Exact {
    fn scramble(&mut self, dimension: usize, digits: u32) -> u32 {
        let mut flips = 0;
        for k in 0..32 {
            let before = digits.checked_shr(32 - k).unwrap_or(0);
            let (coins, generator) = (&mut self.coins, &mut self.generator);
            let coin = *coins.entry((dimension, k, before)).or_insert_with(|| generator.next_u32() & 1 == 1);
            flips = (flips << 1) | u32::from(coin);
        }
        digits ^ flips
    }
}

/// Points of the plain sequence.
fn plain(dimensions: usize, count: usize) -> Vec<f64> {
    let mut points = vec![f64::NAN; dimensions * count];
    Sobol::new(dimensions).unwrap().points(0, &mut points).unwrap();
    points
}

/// The sequence under Owen's scrambling.
fn exact(plain: &[f64], dimensions: usize, seed: u64) -> Vec<f64> {
    let mut scrambling = Exact { generator: ChaCha8Rng::seed_from_u64(seed), coins: HashMap::new() };
    let mut one = |(k, x): (usize, &f64)| {
        (f64::from(scrambling.scramble(k % dimensions, (x * CELLS) as u32)) + 0.5) / CELLS
    };
    plain.iter().enumerate().map(&mut one).collect()
}

/// A function of points and its name.
type Named = (&'static str, fn(&[f64]) -> f64);

/// Smooth, kinked and discontinuous functions, of all inputs and of few.
fn functions() -> [Named; 7] {
    [
        ("sum of squares", |x| x.iter().map(|x| x * x).sum()),
        ("product", |x| x.iter().zip(1..).map(|(x, j)| 1.0 + (x - 0.5) / f64::from(j)).product()),
        ("kinks", |x| x.iter().map(|x| (4.0 * x - 2.0).abs()).product()),
        ("half space", |x| f64::from(u8::from(x.iter().sum::<f64>() < 2.5))),
        ("oscillation", |x| (9.0 * x.iter().sum::<f64>()).cos()),
        ("box", |x| f64::from(u8::from(x[0] < 0.3 && x[1] < 0.7 && x[2] < 0.55))),
        ("pair", |x| (x[3] - 0.5) * (x[4] - 0.5)),
    ]
}

/// Means of the functions over the points of each seed: the mean, and the variance with its standard error.
fn variances(seeds: u64, points: impl Fn(u64) -> Vec<f64>) -> Vec<[f64; 3]> {
    let functions = functions();
    let mut means = vec![Vec::new(); functions.len()];
    for seed in 0..seeds {
        let points = points(seed);
        for ((_, function), means) in functions.iter().zip(&mut means) {
            let rows = points.chunks_exact(DIMENSIONS);
            let count = rows.len() as f64;
            means.push(rows.map(function).sum::<f64>() / count);
        }
    }
    let moments = |means: &Vec<f64>| {
        let count = means.len() as f64;
        let mean = means.iter().sum::<f64>() / count;
        let power = |k| means.iter().map(|x| (x - mean).powi(k)).sum::<f64>() / count;
        [mean, power(2), ((power(4) - power(2).powi(2)) / count).sqrt()]
    };
    means.iter().map(moments).collect()
}

#[test]
fn means_have_the_variance_that_independent_coins_give_them() {
    for (count, seeds) in [(16, 4000), (50, 2000), (256, 800)] {
        let plain = plain(DIMENSIONS, count);
        let theirs = variances(seeds, |seed| exact(&plain, DIMENSIONS, seed));
        let sequence = Sobol::new(DIMENSIONS).unwrap();
        let ours = variances(seeds, |seed| {
            let mut points = vec![f64::NAN; plain.len()];
            sequence.rescrambled(seed).points(0, &mut points).unwrap();
            points
        });
        for (((name, _), ours), theirs) in functions().iter().zip(ours).zip(theirs) {
            let deviation = (ours[1] - theirs[1]) / ours[2].hypot(theirs[2]);
            let bias = (ours[0] - theirs[0]) / ((ours[1] + theirs[1]) / seeds as f64).sqrt();
            let ratio = ours[1] / theirs[1];
            println!("{count:4} {name:16} variance {ratio:.3} ({deviation:+.1}), mean {bias:+.1}");
            assert!(deviation.abs() < 4.0 && bias.abs() < 4.0, "{name} at {count} points");
        }
    }
}

#[test]
fn the_coins_of_the_first_nodes_are_fair_and_independent() {
    // The flips of the digits of 0, 1/4, 1/2 and 3/4 down to the second digit, over seeds: the coins of the
    // root and of its two children. Standard deviation of a count: 30.
    let mut counts = [0_i32; 8];
    let sequence = Sobol::new(1).unwrap();
    let mut quarters = [0.0; 4];
    for seed in 0..8000 {
        sequence.rescrambled(seed).points(0, &mut quarters).unwrap();
        let digits = |index: usize, plain: u32| (quarters[index] * 4.0) as u32 ^ plain;
        // Points 0 and 1 of the sequence are 0 and 1/2.
        let (left, right) = (digits(0, 0), digits(1, 2));
        assert_eq!(left >> 1, right >> 1);
        counts[((left >> 1) + 2 * (left & 1) + 4 * (right & 1)) as usize] += 1;
    }
    assert!(counts.iter().all(|count| (count - 1000).abs() < 120), "{counts:?}");
}

#[test]
fn boxes_hold_as_many_scrambled_points_as_plain_ones() {
    // Scrambling moves elementary boxes as a whole: the counts of all boxes of a shape are permuted.
    let (count, sequence) = (1 << 9, Sobol::new(DIMENSIONS).unwrap());
    let counts = |points: &[f64], shape: [u32; DIMENSIONS]| {
        let mut boxes = HashMap::<Vec<u32>, usize>::new();
        for point in points.chunks_exact(DIMENSIONS) {
            let cell = point.iter().zip(shape).map(|(x, k)| (x * f64::from(1 << k)) as u32).collect();
            *boxes.entry(cell).or_default() += 1;
        }
        let mut counts: Vec<usize> = boxes.into_values().collect();
        counts.sort_unstable();
        counts
    };
    let plain = plain(DIMENSIONS, count);
    for seed in 0..4 {
        let mut scrambled = vec![f64::NAN; plain.len()];
        sequence.rescrambled(seed).points(0, &mut scrambled).unwrap();
        for shape in [[9, 0, 0, 0, 0], [3, 3, 3, 0, 0], [1, 0, 2, 0, 4], [2, 2, 2, 2, 1], [0, 0, 0, 5, 4]] {
            assert_eq!(counts(&scrambled, shape), counts(&plain, shape), "{shape:?}");
        }
    }
}

proptest! {
    #[test]
    fn a_digit_depends_on_no_later_digit(one: u32, two: u32, seed: u64) {
        let sequence = Sobol::scrambled(8, seed).unwrap();
        let [mut first, mut second, mut plain_first, mut plain_second] = [[f64::NAN; 8]; 4];
        sequence.point(one, &mut first).unwrap();
        sequence.point(two, &mut second).unwrap();
        Sobol::new(8).unwrap().point(one, &mut plain_first).unwrap();
        Sobol::new(8).unwrap().point(two, &mut plain_second).unwrap();
        let common = |x: f64, y: f64| ((x * CELLS) as u32 ^ (y * CELLS) as u32).leading_zeros();
        for j in 0..8 {
            prop_assert_eq!(common(first[j], second[j]), common(plain_first[j], plain_second[j]));
        }
    }
}
