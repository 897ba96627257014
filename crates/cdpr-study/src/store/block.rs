//! The file of a block, `cdpr-block/2`: the observations at consecutive indices of a design. The inputs are
//! not in it, because they follow from the design.
//!
//! ```text
//! cdpr-block/2 CHECKSUM        BLAKE3, in hexadecimal digits, of all that follows this line
//! {"version":.., "study":.., "sampling":.., "design":.., "first":.., "observations":.., "failed":{..}}
//! dx dy dz ...                 displacement [m] of each observation as little-endian 64-bit floats; NaN
//!                              where it failed; of an output that is no length one number in its unit;
//!                              with "recorded":"motion" also the rotation vector rx ry rz [rad]
//! [[index, kind, reason], ...] failed observations, counted from the first of the block
//! [[index, count, why], ...]   runs of observations by the scalar models, and why lanes did not make them
//! ```

use crate::file::output::{Output, Recorded};
use crate::model::observed::{Failure, Measured, MeasuredQuantity, Observed};
use cdpr_robot::{Vector3, Vector6};
use cdpr_statics::batch::ScalarReason;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;

/// Name and version of the format.
pub(crate) const BLOCK_FORMAT: &str = "cdpr-block/2";

/// Observations of a block, except the last one of a design: the unit of work, of saving and of summing.
pub const BLOCK: usize = 16_384;

/// Bytes of a number.
const NUMBER: usize = 8;

/// The header of a block.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BlockHeader {
    /// Version of the program.
    pub(crate) version: String,
    /// Hash of what the observations depend on ([`crate::Study::sampling_hash`]).
    pub(crate) study: String,
    /// Name of the sampling.
    pub(crate) sampling: String,
    /// Name of its design.
    pub(crate) design: String,
    /// Index in the design of the first observation.
    pub(crate) first: usize,
    /// Number of observations.
    pub(crate) observations: usize,
    /// What is observed.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub(crate) output: Output,
    /// What it keeps of each observation.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub(crate) recorded: Recorded,
    /// Failed ones by kind.
    pub(crate) failed: BTreeMap<String, usize>,
}

/// The blocks of a design with so many points: index of the block and indices of its points.
pub(crate) fn blocks(points: usize) -> impl Iterator<Item = (usize, Range<usize>)> {
    (0..count(points)).map(move |number| (number, range(points, number)))
}

/// Number of blocks of a design with so many points.
pub(crate) fn count(points: usize) -> usize {
    points.div_ceil(BLOCK)
}

/// Indices of the points in a block.
pub(crate) fn range(points: usize, number: usize) -> Range<usize> {
    number * BLOCK..points.min((number + 1) * BLOCK)
}

/// The file of a block.
///
/// # Errors
/// Those of `serde_json`, which do not occur for numbers and texts.
pub(crate) fn encode(header: &BlockHeader, outcomes: &[Observed]) -> Result<Vec<u8>, serde_json::Error> {
    let mut body = serde_json::to_vec(header)?;
    body.push(b'\n');
    let none = header.output.nothing_recorded(header.recorded);
    for measured in outcomes.iter().map(|outcome| outcome.as_ref().unwrap_or(&none)) {
        measured.quantity.numbers().iter().for_each(|value| body.extend_from_slice(&value.to_le_bytes()));
    }
    let failures: Vec<(usize, &str, &str)> = outcomes
        .iter()
        .enumerate()
        .filter_map(|(k, outcome)| {
            outcome.as_ref().err().map(|failure| (k, failure.kind.as_str(), failure.reason.as_str()))
        })
        .collect();
    serde_json::to_writer(&mut body, &failures)?;
    body.push(b'\n');
    serde_json::to_writer(&mut body, &scalar_runs(outcomes))?;
    let mut file = format!("{BLOCK_FORMAT} {}\n", blake3::hash(&body)).into_bytes();
    file.append(&mut body);
    Ok(file)
}

/// The content of a block's file, or why it is damaged.
pub(crate) fn decode(file: &[u8]) -> Result<(BlockHeader, Vec<Observed>), String> {
    let (first, body) = line(file).ok_or("no line in it")?;
    let checksum = std::str::from_utf8(first)
        .ok()
        .and_then(|first| first.strip_prefix(BLOCK_FORMAT)?.strip_prefix(' '))
        .ok_or_else(|| format!("it does not begin with {BLOCK_FORMAT}"))?;
    let found = blake3::hash(body).to_string();
    if found != checksum {
        return Err(format!("its checksum is {found}, and should be {checksum}"));
    }
    let (header, payload) = line(body).ok_or("no header in it")?;
    let header: BlockHeader = serde_json::from_slice(header).map_err(|error| format!("header: {error}"))?;
    let nothing = header.output.nothing_recorded(header.recorded).quantity;
    let each = NUMBER * nothing.numbers().len();
    let bytes = header.observations.checked_mul(each).filter(|bytes| *bytes <= payload.len());
    let (measured, rest) = payload.split_at(bytes.ok_or("fewer observations than its header says")?);
    let (failures, runs) = line(rest).ok_or("it ends before the reasons of the scalar models")?;
    let number = |bytes: &[u8], k: usize| float(&bytes[NUMBER * k..NUMBER * (k + 1)]);
    let one = |bytes| match nothing {
        MeasuredQuantity::Displacement(_) => {
            MeasuredQuantity::Displacement(Vector3::from_fn(|k, _| number(bytes, k)))
        }
        MeasuredQuantity::Motion(_) => {
            MeasuredQuantity::Motion(Box::new(Vector6::from_fn(|k, _| number(bytes, k))))
        }
        MeasuredQuantity::Number(_) => MeasuredQuantity::Number(number(bytes, 0)),
    };
    let all = measured.chunks_exact(each);
    let mut outcomes: Vec<Observed> =
        all.map(|bytes| Ok(Measured { quantity: one(bytes), scalar: None })).collect();
    let runs: Vec<(usize, usize, String)> =
        serde_json::from_slice(runs).map_err(|error| format!("scalar models: {error}"))?;
    for (first, count, why) in runs {
        let why = ScalarReason::named(&why).ok_or_else(|| format!("`{why}` is no reason"))?;
        let end = first.checked_add(count).filter(|end| *end <= outcomes.len());
        let end = end.ok_or_else(|| format!("{count} after observation {first} are more than there are"))?;
        outcomes[first..end].iter_mut().flatten().for_each(|measured| measured.scalar = Some(why));
    }
    let failures: Vec<(usize, String, String)> =
        serde_json::from_slice(failures).map_err(|error| format!("failures: {error}"))?;
    for (k, kind, reason) in failures {
        let outcome = outcomes.get_mut(k).ok_or_else(|| format!("failure {k} is of no observation"))?;
        *outcome = Err(Failure { kind, reason });
    }
    Ok((header, outcomes))
}

/// Runs of observations by the scalar models for the same reason: the first, how many, and the reason.
fn scalar_runs(outcomes: &[Observed]) -> Vec<(usize, usize, &'static str)> {
    let mut runs: Vec<(usize, usize, &str)> = Vec::new();
    for (k, outcome) in outcomes.iter().enumerate() {
        let Some(why) = outcome.as_ref().ok().and_then(|measured| measured.scalar) else { continue };
        match runs.last_mut() {
            Some((first, count, last)) if *first + *count == k && *last == why.name() => *count += 1,
            _ => runs.push((k, 1, why.name())),
        }
    }
    runs
}

/// The header at the start of a block's file; `None` for a file that is no block, and an error for the
/// damaged header of one.
pub(crate) fn header_of(start: &[u8]) -> Option<Result<BlockHeader, ()>> {
    let body = start.strip_prefix(BLOCK_FORMAT.as_bytes())?.strip_prefix(b" ")?;
    let header = line(body).and_then(|(_, body)| serde_json::from_slice(line(body)?.0).ok());
    Some(header.ok_or(()))
}

/// The text before the first end of a line, and all after it.
fn line(text: &[u8]) -> Option<(&[u8], &[u8])> {
    let end = text.iter().position(|byte| *byte == b'\n')?;
    Some((&text[..end], &text[end + 1..]))
}

fn float(bytes: &[u8]) -> f64 {
    f64::from_bits(bytes.iter().rev().fold(0, |bits, byte| bits << 8 | u64::from(*byte)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block() -> (BlockHeader, Vec<Observed>) {
        let failure = Failure { kind: "infeasible_tension".to_owned(), reason: "1 N\nis \"ρ\"".to_owned() };
        let header = BlockHeader {
            version: "1.2.3".to_owned(),
            study: "abc".to_owned(),
            sampling: "mechanical".to_owned(),
            design: "replicate-2".to_owned(),
            first: BLOCK,
            observations: 3,
            output: Output::Deflection,
            recorded: Recorded::Output,
            failed: [("infeasible_tension".to_owned(), 1)].into(),
        };
        let numbers = [Vector3::new(1.5e-3, -0.0, 5e-324), Vector3::new(-1e300, 0.1, 1.0 / 3.0)];
        let whys = [None, Some(ScalarReason::Folded)];
        let [first, last] = [0, 1]
            .map(|k| Ok(Measured { quantity: MeasuredQuantity::Displacement(numbers[k]), scalar: whys[k] }));
        (header, vec![first, Err(failure), last])
    }

    fn bits(outcomes: &[Observed]) -> Vec<Result<Vec<u64>, Failure>> {
        let bits =
            |measured: &Measured| measured.quantity.numbers().iter().map(|value| value.to_bits()).collect();
        outcomes.iter().map(|outcome| outcome.as_ref().map(bits).map_err(Clone::clone)).collect()
    }

    #[test]
    fn a_block_is_read_as_it_was_written_to_the_last_bit() {
        let (header, outcomes) = block();
        let (read_header, read) = decode(&encode(&header, &outcomes).unwrap()).unwrap();
        assert_eq!(read_header, header);
        assert_eq!(bits(&read), bits(&outcomes));
        assert_eq!(read[2].as_ref().unwrap().scalar, Some(ScalarReason::Folded));
        assert_eq!(read[0].as_ref().unwrap().scalar, None);
        let header = BlockHeader { output: Output::Frequency, ..header };
        let number = |value| {
            Ok(Measured { quantity: MeasuredQuantity::Number(value), scalar: Some(ScalarReason::Output) })
        };
        let numbers = [number(1.0 / 3.0), outcomes[1].clone(), number(-0.0)];
        let file = encode(&header, &numbers).unwrap();
        assert_eq!(bits(&decode(&file).unwrap().1), bits(&numbers));
        let header = BlockHeader { output: Output::Position, recorded: Recorded::Motion, ..header };
        let motion = Vector6::new(1.5e-3, -0.0, 5e-324, 1.0 / 3.0, 1e-9, -0.2);
        let quantity = MeasuredQuantity::Motion(Box::new(motion));
        let motions = [outcomes[1].clone(), Ok(Measured { quantity, scalar: None })];
        let file = encode(&BlockHeader { observations: 2, ..header }, &motions).unwrap();
        assert_eq!(bits(&decode(&file).unwrap().1), bits(&motions));
    }

    #[test]
    fn any_single_damaged_byte_and_any_truncation_is_noticed() {
        let (header, outcomes) = block();
        let file = encode(&header, &outcomes).unwrap();
        for k in 0..file.len() {
            let mut damaged = file.clone();
            damaged[k] ^= 0x20;
            assert!(decode(&damaged).is_err(), "byte {k}");
            assert!(decode(&file[..k]).is_err(), "{k} bytes");
        }
    }

    #[test]
    fn the_blocks_of_a_design_cover_its_points_once() {
        let ranges: Vec<_> = blocks(2 * BLOCK + 7).collect();
        assert_eq!(ranges, [(0, 0..BLOCK), (1, BLOCK..2 * BLOCK), (2, 2 * BLOCK..2 * BLOCK + 7)]);
        assert_eq!(blocks(BLOCK).count(), 1);
    }
}
