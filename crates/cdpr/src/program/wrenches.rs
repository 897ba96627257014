//! Sets of wrenches as they are given on the command line.

use crate::program::arguments::{number, parts};
use crate::program::error::ProgramError;
use crate::program::lists::wrench_file;
use cdpr_assess::WrenchSet;
use cdpr_robot::{Vector6, Wrench, counted};
use std::path::PathBuf;

/// A set of wrenches that act on the platform on top of the load.
#[derive(clap::Args)]
pub(crate) struct WrenchArguments {
    /// Wrench about P: fx,fy,fz,mx,my,mz [N, N m]; several times for a set. `low:high` for a number stands
    /// for both ends, which makes the corners of a box. Or a table with a wrench on each line, FILE; the six
    /// numbers of FILE,fx,fy,fz,mx,my,mz are added to each of them.
    #[arg(long, value_name = "WRENCH|FILE", value_parser = wrenches, allow_hyphen_values = true)]
    wrench: Vec<Wrenches>,
}

/// A wrench or a box of them, alone or around each wrench of a file.
#[derive(Clone, Debug, Default, PartialEq)]
struct Wrenches {
    file: Option<PathBuf>,
    /// The middle of the box and its half widths, which are zero for a single wrench.
    middle: [f64; 6],
    half: [f64; 6],
}

fn wrenches(text: &str) -> Result<Wrenches, String> {
    let is_typed = |text: &str| text.chars().all(|c| c.is_ascii_digit() || "+-.,;: eE".contains(c));
    let is_list = is_typed(text) && text.contains([',', ';', ' ']);
    if is_list || number(text).is_ok() {
        let (middle, half) = of_box(text)?;
        return Ok(Wrenches { file: None, middle, half });
    }
    let around =
        text.match_indices(',').find(|(at, _)| is_typed(&text[*at..])).map(|(at, _)| text.split_at(at));
    match around {
        Some((file, numbers)) => {
            let (middle, half) = of_box(&numbers[1..])?;
            Ok(Wrenches { file: Some(file.into()), middle, half })
        }
        None => Ok(Wrenches { file: Some(text.into()), ..Wrenches::default() }),
    }
}

/// Middle and half widths of six numbers or `low:high`.
fn of_box(text: &str) -> Result<([f64; 6], [f64; 6]), String> {
    let end = |text: &str| match text.split_once(':') {
        Some((low, high)) => Ok([number(low)?, number(high)?]),
        None => number(text).map(|value| [value; 2]),
    };
    let ends: Vec<[f64; 2]> = parts(text).iter().map(|part| end(part)).collect::<Result<_, String>>()?;
    let count = ends.len();
    let ends: [[f64; 2]; 6] = ends
        .try_into()
        .map_err(|_| format!("{}: expected 6, fx,fy,fz,mx,my,mz", counted(count, "number")))?;
    Ok((ends.map(|[low, high]| 0.5 * (low + high)), ends.map(|[low, high]| 0.5 * (high - low).abs())))
}

impl WrenchArguments {
    /// Whether any is given.
    pub(crate) fn are_given(&self) -> bool {
        !self.wrench.is_empty()
    }

    pub(crate) fn set(&self) -> Result<WrenchSet, ProgramError> {
        let wrench = |numbers: &[f64; 6]| Wrench::from_vector(&Vector6::from(*numbers));
        let mut all = Vec::new();
        for Wrenches { file, middle, half } in &self.wrench {
            let lines = file.as_ref().map_or_else(|| Ok(vec![[0.0; 6]]), |path| wrench_file(path))?;
            let lines = WrenchSet::of(lines.iter().map(wrench).collect());
            all.extend(lines.shifted(wrench(middle)).widened(&wrench(half)).wrenches());
        }
        Ok(WrenchSet::of(all))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrench_is_six_numbers_a_box_of_them_or_a_file_with_a_box_around_each_line() {
        let typed = |text: &str| wrenches(text).unwrap();
        let one = Wrenches { middle: [1.0, -2.0, 30.0, 0.0, 0.0, 0.0], ..Wrenches::default() };
        assert_eq!(typed("1,-2,3e1,0,0,0"), one);
        let middle = [0.0, 5.0, 0.0, 0.0, 0.0, 1.0];
        let corners = Wrenches { file: None, middle, half: [50.0, 5.0, 0.0, 0.0, 0.0, 0.0] };
        assert_eq!(typed("-50:50,0:10,0,0,0,1"), corners);
        let file = Wrenches { file: Some("a,wind.csv".into()), ..Wrenches::default() };
        assert_eq!(typed("a,wind.csv"), file);
        assert_eq!(typed("a,wind.csv,-50:50,0:10,0,0,0,1"), Wrenches { file: file.file, ..corners.clone() });
        for (text, count) in [("150", "1 number"), ("1,2,3", "3 numbers"), ("wind.csv,1,2", "2 numbers")] {
            assert_eq!(wrenches(text), Err(format!("{count}: expected 6, fx,fy,fz,mx,my,mz")));
        }
        let set = WrenchArguments { wrench: vec![corners, Wrenches::default()] };
        assert_eq!(set.set().unwrap().wrenches().len(), 5);
        let folder = tempfile::TempDir::new().unwrap();
        let path = folder.path().join("wind.csv");
        std::fs::write(&path, "fx,fy,fz,mx,my,mz\n10,0,0,0,0,0\n0,20,0,0,0,0\n").unwrap();
        let around = typed(&format!("{},-1:3,0,0,0,0,0", path.display()));
        let set = WrenchArguments { wrench: vec![around] }.set().unwrap();
        let mut forces: Vec<[f64; 2]> = set.wrenches().iter().map(|of| [of.force.x, of.force.y]).collect();
        forces.sort_by(|one, other| one[0].total_cmp(&other[0]));
        assert_eq!(forces, [[-1.0, 20.0], [3.0, 20.0], [9.0, 0.0], [13.0, 0.0]]);
    }
}
