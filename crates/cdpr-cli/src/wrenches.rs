//! Sets of wrenches as they are given on the command line.

use crate::arguments::{number, parts};
use crate::error::ProgramError;
use crate::lists::wrench_file;
use cdpr_assess::WrenchSet;
use cdpr_robot::{Vector6, Wrench, counted};
use std::path::PathBuf;

/// A set of wrenches that act on the platform on top of the load.
#[derive(clap::Args)]
pub(crate) struct WrenchArguments {
    /// Wrench about P: fx,fy,fz,mx,my,mz [N, N m]; several times for a set. `low:high` for a number stands
    /// for both ends, which makes the corners of a box. Or a table with a wrench on each line.
    #[arg(long, value_name = "WRENCH|FILE", value_parser = wrenches, allow_hyphen_values = true)]
    wrench: Vec<Wrenches>,
}

/// One of several wrenches, a box of them, or a file.
#[derive(Clone, Debug, PartialEq)]
enum Wrenches {
    /// The middle of a box and its half widths, which are zero for a single wrench.
    Box([f64; 6], [f64; 6]),
    File(PathBuf),
}

fn wrenches(text: &str) -> Result<Wrenches, String> {
    let is_typed = |c: char| c.is_ascii_digit() || "+-.,;: eE".contains(c);
    if !text.chars().all(is_typed) || !text.contains([',', ';', ' ']) {
        return Ok(Wrenches::File(PathBuf::from(text)));
    }
    let end = |text: &str| match text.split_once(':') {
        Some((low, high)) => Ok([number(low)?, number(high)?]),
        None => number(text).map(|value| [value; 2]),
    };
    let ends: Vec<[f64; 2]> = parts(text).iter().map(|part| end(part)).collect::<Result<_, String>>()?;
    let count = ends.len();
    let ends: [[f64; 2]; 6] =
        ends.try_into().map_err(|_| format!("{}: expected 6", counted(count, "number")))?;
    let (middle, half) =
        (ends.map(|[low, high]| 0.5 * (low + high)), ends.map(|[low, high]| 0.5 * (high - low).abs()));
    Ok(Wrenches::Box(middle, half))
}

impl WrenchArguments {
    /// Whether any is given.
    pub(crate) fn are_given(&self) -> bool {
        !self.wrench.is_empty()
    }

    pub(crate) fn set(&self) -> Result<WrenchSet, ProgramError> {
        let wrench = |numbers: &[f64; 6]| Wrench::from_vector(&Vector6::from(*numbers));
        let mut all = Vec::new();
        for given in &self.wrench {
            match given {
                Wrenches::File(path) => all.extend(wrench_file(path)?.iter().map(wrench)),
                Wrenches::Box(middle, half) => {
                    all.extend(WrenchSet::of(vec![wrench(middle)]).widened(&wrench(half)).wrenches());
                }
            }
        }
        Ok(WrenchSet::of(all))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrench_is_six_numbers_a_box_of_them_or_a_file() {
        let typed = |text: &str| wrenches(text).unwrap();
        assert_eq!(typed("1,-2,3e1,0,0,0"), Wrenches::Box([1.0, -2.0, 30.0, 0.0, 0.0, 0.0], [0.0; 6]));
        assert_eq!(
            typed("-50:50,0:10,0,0,0,1"),
            Wrenches::Box([0.0, 5.0, 0.0, 0.0, 0.0, 1.0], [50.0, 5.0, 0.0, 0.0, 0.0, 0.0])
        );
        assert_eq!(typed("wind.csv"), Wrenches::File("wind.csv".into()));
        assert_eq!(wrenches("1,2,3"), Err("3 numbers: expected 6".to_owned()));
        let set = WrenchArguments { wrench: vec![typed("-50:50,0:10,0,0,0,1"), typed("0,0,0,0,0,0")] };
        assert_eq!(set.set().unwrap().wrenches().len(), 5);
    }
}
