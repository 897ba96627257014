//! Mutations that know numbers: a byte of a double changes its value by anything or by nothing that matters.

use serde_json::Value;

/// SplitMix64, for the mutations alone.
struct Random(u64);

impl Random {
    fn new(seed: u32) -> Self {
        Self(u64::from(seed))
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// From `min` to `max`.
    fn between(&mut self, min: f64, max: f64) -> f64 {
        min + (max - min) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }
}

/// Numbers at which formulas change: ends of ranges, ends of the doubles, units.
const MARKS: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    f64::EPSILON,
    1e-9,
    1e-30,
    1e-100,
    1e30,
    1e100,
    5e-324,
    f64::MIN_POSITIVE,
    f64::MAX,
    1e-300,
];

/// Varies `N` doubles in place: a case of the references instead, or one to three numbers scaled, nudged,
/// copied, redrawn.
pub fn numbers<const N: usize>(
    data: &mut [u8],
    size: usize,
    max_size: usize,
    seed: u32,
    cases: &[[f64; N]],
) -> usize {
    if max_size < 8 * N {
        return size;
    }
    let mut random = Random::new(seed);
    let mut numbers = if size < 8 * N || random.below(64) == 0 { random.pick(cases) } else { read(data) };
    for _ in 0..=random.below(3) {
        let i = random.below(N);
        numbers[i] = varied(numbers[i], &numbers, &mut random);
    }
    for (bytes, number) in data.chunks_exact_mut(8).zip(numbers) {
        bytes.copy_from_slice(&number.to_le_bytes());
    }
    8 * N
}

fn varied(number: f64, others: &[f64], random: &mut Random) -> f64 {
    match random.below(10) {
        0 => f64::from_bits(random.bits()),
        1 => number * random.between(0.0, 2.0),
        2 => number * 10f64.powf(random.between(-3.0, 3.0)),
        3 => number * 10f64.powf(random.between(-40.0, 40.0)),
        4 => f64::from_bits(number.to_bits().wrapping_add(random.below(17) as u64).wrapping_sub(8)),
        5 => -number,
        6 => random.pick(others),
        7 => random.pick(others) * (1.0 + random.pick(&[-1.0, 1.0]) * 10f64.powf(random.between(-17.0, 0.0))),
        8 => random.pick(&MARKS),
        _ => number * random.pick(&MARKS[2..]),
    }
}

fn read<const N: usize>(data: &[u8]) -> [f64; N] {
    let mut numbers = [0.0; N];
    for (number, bytes) in numbers.iter_mut().zip(data.chunks_exact(8)) {
        *number = f64::from_le_bytes(bytes.try_into().unwrap_or_default());
    }
    numbers
}

/// Replaces one number of a JSON text by another. `None` if the text has no number, or no room for it.
pub fn number_in_text(data: &mut [u8], size: usize, max_size: usize, seed: u32) -> Option<usize> {
    let mut random = Random::new(seed);
    let of_number = |byte: &u8| matches!(byte, b'0'..=b'9' | b'.' | b'-' | b'+' | b'e' | b'E');
    let text = data.get(..size)?;
    let starts: Vec<usize> = (0..size)
        .filter(|i| matches!(text[*i], b'0'..=b'9' | b'-') && !(*i > 0 && of_number(&text[*i - 1])))
        .collect();
    if starts.is_empty() {
        return None;
    }
    let start = random.pick(&starts);
    let length = text[start..].iter().take_while(|byte| of_number(byte)).count();
    let old = std::str::from_utf8(&text[start..start + length]).ok()?.parse().ok()?;
    let new = varied(old, &[old], &mut random);
    let new = match random.below(3) {
        0 => format!("{}", new.round().abs().min(1e20) as u64),
        1 => format!("{new:?}"),
        _ => format!("{new:e}"),
    };
    let rest = text[start + length..].to_vec();
    let grown = start + new.len() + rest.len();
    if grown > max_size {
        return None;
    }
    data[start..start + new.len()].copy_from_slice(new.as_bytes());
    data[start + new.len()..grown].copy_from_slice(&rest);
    Some(grown)
}

/// The numbers `fields` of every case of `data/reference/catenary.json`.
pub fn references<const N: usize>(fields: [&str; N]) -> Vec<[f64; N]> {
    let text = include_str!("../../../data/reference/catenary.json");
    let Ok(Value::Array(cases)) = serde_json::from_str(text) else { return vec![[1.0; N]] };
    let number = |value: &Value| value.as_f64().or_else(|| value.as_str()?.parse().ok()).unwrap_or(1.0);
    cases.iter().map(|case| fields.map(|field| number(&case[field]))).collect()
}
