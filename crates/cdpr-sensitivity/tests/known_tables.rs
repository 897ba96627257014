//! Tables whose truth is known: which inputs cause their output, and which do not.
//!
//! The test of verdicts and `cargo xtask statistics verdicts` take the same.

use cdpr_sensitivity::{GivenData, Input, Law, SobolDesign};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A table and its truth.
pub(crate) struct Known {
    pub(crate) data: GivenData,
    /// Inputs that have no effect of their own: they must not be called certain.
    pub(crate) inert: Vec<usize>,
    /// Inputs with more than 10 % of the variance, or as much of an effect: they must be named.
    pub(crate) causes: Vec<usize>,
    /// Whether rows and inputs are independent, so that causes must be certain.
    pub(crate) clean: bool,
}

/// A kind of table: its name, and how a seed makes one.
pub(crate) type Kind = (&'static str, fn(&mut Source) -> Known);

/// Random numbers of one table.
pub(crate) struct Source(ChaCha8Rng);

impl Source {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    fn uniform(&mut self) -> f64 {
        self.0.random_range(0.0..1.0)
    }

    fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.uniform()).ln()).sqrt() * (std::f64::consts::TAU * self.uniform()).cos()
    }

    fn cauchy(&mut self) -> f64 {
        (std::f64::consts::PI * (self.uniform() - 0.5)).tan()
    }

    fn below(&mut self, count: usize) -> usize {
        (self.0.next_u32() as usize) % count
    }

    fn list(&mut self, rows: usize, mut draw: impl FnMut(&mut Self) -> f64) -> Vec<f64> {
        (0..rows).map(|_| draw(self)).collect()
    }

    pub(crate) fn uniforms(&mut self, rows: usize) -> Vec<f64> {
        self.list(rows, Self::uniform)
    }

    fn lists(&mut self, inputs: usize, rows: usize, draw: fn(&mut Self) -> f64) -> Vec<Vec<f64>> {
        (0..inputs).map(|_| self.list(rows, draw)).collect()
    }

    /// Values that follow each other with this correlation.
    fn series(&mut self, rows: usize, correlation: f64) -> Vec<f64> {
        let mut last = self.normal();
        let rest = (1.0 - correlation * correlation).sqrt();
        self.list(rows, |source| {
            last = correlation * last + rest * source.normal();
            last
        })
    }

    fn shuffled(&mut self, columns: &mut [Vec<f64>]) {
        for row in (1..columns[0].len()).rev() {
            let other = self.below(row + 1);
            columns.iter_mut().for_each(|column| column.swap(row, other));
        }
    }
}

fn outputs(columns: &[Vec<f64>], mut model: impl FnMut(&[f64]) -> f64) -> Vec<f64> {
    let row = |row: usize| columns.iter().map(|column| column[row]).collect::<Vec<f64>>();
    (0..columns[0].len()).map(|number| model(&row(number))).collect()
}

fn known(columns: Vec<Vec<f64>>, y: Vec<f64>, causes: &[usize], clean: bool) -> Known {
    let names = (0..columns.len()).map(|input| format!("x{}", input + 1)).collect();
    let inert = (0..columns.len()).filter(|input| !causes.contains(input)).collect();
    let data = GivenData::new(names, columns, y.into_iter().map(Some).collect()).unwrap();
    Known { data, inert, causes: causes.to_vec(), clean }
}

impl Known {
    /// This input has an effect, too.
    fn but(mut self, input: usize) -> Self {
        self.inert.retain(|inert| *inert != input);
        self
    }

    fn with_words(self, input: usize, count: usize) -> Self {
        let words = (0..count).map(|level| format!("word {level}")).collect();
        Self { data: self.data.with_levels(input, words).unwrap(), ..self }
    }
}

/// A table of independent rows and inputs between 0 and 1.
fn of_unit(
    source: &mut Source,
    [inputs, rows]: [usize; 2],
    causes: &[usize],
    model: fn(&[f64], &mut Source) -> f64,
) -> Known {
    let columns = source.lists(inputs, rows, Source::uniform);
    let y = outputs(&columns, |x| model(x, source));
    known(columns, y, causes, true)
}

fn ishigami(x: &[f64], _: &mut Source) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|i| std::f64::consts::TAU * (x[i] - 0.5));
    a.sin() + 7.0 * b.sin().powi(2) + 0.1 * c.powi(4) * a.sin()
}

fn factorial(levels: usize, factors: usize, times: usize) -> Vec<Vec<f64>> {
    let runs = levels.pow(factors as u32);
    let level = |run: usize, factor: usize| ((run / levels.pow(factor as u32)) % levels) as f64;
    (0..factors).map(|factor| (0..runs * times).map(|run| level(run % runs, factor)).collect()).collect()
}

fn ordered(source: &mut Source, inputs: usize, rows: usize, correlation: f64) -> Known {
    let columns: Vec<Vec<f64>> = (0..inputs).map(|_| source.series(rows, correlation)).collect();
    let y = source.series(rows, correlation);
    known(columns, y, &[], false)
}

fn copied(source: &mut Source, rows: usize, correlation: f64) -> Known {
    let mut columns = source.lists(4, rows, Source::normal);
    let rest = (1.0 - correlation * correlation).sqrt();
    columns[1] = columns[0].iter().zip(&columns[1]).map(|(x, own)| correlation * x + rest * own).collect();
    let y = outputs(&columns, |x| x[0] + 0.5 * x[2] + 0.3 * source.normal());
    known(columns, y, &[0, 2], false)
}

/// Rows of Sobol' sequence from a point on, with coordinates in random order.
fn of_sequence(
    source: &mut Source,
    [inputs, rows]: [usize; 2],
    causes: &[usize],
    model: fn(&[f64], &mut Source) -> f64,
) -> Known {
    let laws =
        (0..62).map(|i| Input::continuous(format!("u{i}"), Law::Uniform { min: 0.0, max: 1.0 })).collect();
    let design = SobolDesign::new(laws, 1, rows).unwrap();
    let mut all = GivenData::of_design(&design, &vec![None; rows]).unwrap().columns().to_vec();
    for place in (1..all.len()).rev() {
        let other = source.below(place + 1);
        all.swap(place, other);
    }
    all.truncate(inputs);
    let y = outputs(&all, |x| model(x, source));
    known(all, y, causes, true)
}

/// The difference of two causes of this correlation.
fn difference(source: &mut Source, rows: usize, correlation: f64) -> Known {
    let rest = (1.0 - correlation * correlation).sqrt();
    let mut columns = source.lists(5, rows, Source::normal);
    columns[1] = columns[0].iter().zip(&columns[1]).map(|(x, own)| correlation * x + rest * own).collect();
    columns[2] = outputs(&columns, |x| x[0] - x[1] + 0.3 * x[2]);
    let y = outputs(&columns, |x| x[0] - x[1] + 0.5 * source.normal());
    known(columns, y, &[], false).but(0).but(1)
}

/// All rows of a table so many times.
fn times(columns: &[Vec<f64>], count: usize) -> Vec<Vec<f64>> {
    columns.iter().map(|column| column.iter().flat_map(|&x| vec![x; count]).collect()).collect()
}

/// All kinds.
pub(crate) const KINDS: &[Kind] = &[
    ("nothing, 5 inputs, 100 rows", |s| of_unit(s, [5, 100], &[], |_, s| s.normal())),
    ("nothing, 12 inputs, 500 rows", |s| of_unit(s, [12, 500], &[], |_, s| s.normal())),
    ("nothing, 3 inputs, 12 rows", |s| of_unit(s, [3, 12], &[], |_, s| s.normal())),
    ("nothing, 50 inputs, 100 rows", |s| of_unit(s, [50, 100], &[], |_, s| s.normal())),
    ("nothing, Cauchy", |s| of_unit(s, [5, 200], &[], |_, s| s.cauchy())),
    ("nothing, counts", |s| of_unit(s, [5, 100], &[], |_, s| (3.0 * s.uniform().powi(3)).floor())),
    ("nothing, inputs with long tails", |s| {
        let columns = s.lists(5, 100, Source::cauchy);
        let y = s.list(100, |s| s.normal().exp());
        known(columns, y, &[], true)
    }),
    ("nothing, words", |s| {
        let mut columns = s.lists(3, 150, Source::uniform);
        columns[0] = s.list(150, |s| s.below(5) as f64);
        columns[1] = s.list(150, |s| s.below(30) as f64);
        let y = s.list(150, Source::normal);
        known(columns, y, &[], true).with_words(0, 5).with_words(1, 30)
    }),
    ("additive, 3 of 10", |s| {
        of_unit(s, [10, 500], &[0, 1, 2], |x, s| 2.0 * x[0] + 2.0 * x[1] - 2.0 * x[2] + 0.5 * s.normal())
    }),
    ("additive, 12 % of the variance among 12", |s| {
        // 8 inputs of 12 %, and 4 % of noise.
        of_unit(s, [12, 500], &[0, 1, 2, 3, 4, 5, 6, 7], |x, s| {
            x[..8].iter().sum::<f64>() + (8.0_f64 / 12.0 * 0.04 / 0.96).sqrt() * s.normal()
        })
    }),
    ("12 % among noise, 12 inputs", |s| {
        of_unit(s, [12, 500], &[3], |x, s| x[3] + (0.88_f64 / 0.12 / 12.0).sqrt() * s.normal())
    }),
    ("Ishigami among 12", |s| of_unit(s, [12, 500], &[0, 1, 2], ishigami)),
    ("Ishigami", |s| of_unit(s, [4, 200], &[0, 1], ishigami).but(2)),
    ("product of two", |s| {
        of_unit(s, [6, 500], &[0, 1], |x, s| (2.0 * x[0] - 1.0) * (2.0 * x[1] - 1.0) + 0.1 * s.normal())
    }),
    ("Sobol' g", |s| {
        of_unit(s, [8, 500], &[0, 1], |x, _| {
            let g = |x: f64, a: f64| ((4.0 * x - 2.0).abs() + a) / (1.0 + a);
            g(x[0], 0.0) * g(x[1], 0.5)
        })
    }),
    ("a step", |s| of_unit(s, [6, 500], &[0], |x, s| f64::from(x[0] > 0.9) + 0.3 * s.normal())),
    ("a wave", |s| {
        of_unit(s, [6, 500], &[0], |x, s| (12.0 * std::f64::consts::TAU * x[0]).sin() + 0.2 * s.normal())
    }),
    ("spread alone", |s| of_unit(s, [6, 500], &[0], |x, s| (0.2 + 2.0 * x[0]) * s.normal())),
    ("rare large values", |s| {
        of_unit(s, [6, 500], &[0], |x, s| if x[0] > 0.96 { 100.0 } else { 0.0 } + s.normal())
    }),
    ("exponential output", |s| {
        of_unit(s, [8, 500], &[0, 1], |x, s| (3.0 * x[0] + 1.5 * x[1] + 0.3 * s.normal()).exp())
    }),
    ("Cauchy noise", |s| of_unit(s, [6, 500], &[0], |x, s| 4.0 * x[0] + s.cauchy())),
    ("output in steps", |s| of_unit(s, [6, 500], &[0], |x, s| (3.0 * x[0] + 0.5 * s.normal()).round())),
    ("copy 0.5, 100 rows", |s| copied(s, 100, 0.5)),
    ("copy 0.9, 100 rows", |s| copied(s, 100, 0.9)),
    ("copy 0.9, 500 rows", |s| copied(s, 500, 0.9)),
    ("copy 0.3, 500 rows", |s| copied(s, 500, 0.3)),
    ("a square of the cause", |s| {
        let mut columns = s.lists(4, 500, Source::normal);
        columns[1] = columns[0].iter().zip(&columns[1]).map(|(x, own)| x * x + 0.5 * own).collect();
        let y = outputs(&columns, |x| x[0].abs() + x[0] + 0.3 * s.normal());
        known(columns, y, &[0], false)
    }),
    ("a sum of causes", |s| {
        let mut columns = s.lists(8, 300, Source::normal);
        columns[3] = outputs(&columns, |x| x[0] + x[1] + 0.5 * x[3]);
        let y = outputs(&columns, |x| x[0] + x[1] + x[2] + 0.3 * s.normal());
        known(columns, y, &[0, 1, 2], false)
    }),
    ("words that name parts of the cause", |s| {
        let mut columns = s.lists(3, 300, Source::uniform);
        columns[1] = columns[0].iter().map(|x| (4.0 * x).floor()).collect();
        let y = outputs(&columns, |x| x[0] + 0.1 * s.normal());
        known(columns, y, &[0], false).with_words(1, 4)
    }),
    ("rows in order, 0.9", |s| ordered(s, 1, 100, 0.9)),
    ("rows in order, 0.9, 5 inputs", |s| ordered(s, 5, 300, 0.9)),
    ("rows in order, 0.6", |s| ordered(s, 3, 200, 0.6)),
    ("rows in order, 0.3", |s| ordered(s, 3, 200, 0.3)),
    ("random walks", |s| ordered(s, 3, 200, 0.9999)),
    ("rows in order with a cause", |s| {
        let columns: Vec<Vec<f64>> = (0..4).map(|_| s.series(300, 0.9)).collect();
        let y = outputs(&columns, |x| x[0] + 0.2 * s.normal());
        known(columns, y, &[0], false)
    }),
    ("an output in order, random inputs", |s| {
        let columns = s.lists(4, 300, Source::normal);
        let drift = s.series(300, 0.9);
        let y = columns[0].iter().zip(&drift).map(|(x, drift)| x + drift).collect();
        known(columns, y, &[0], true)
    }),
    ("a drift and the time", |s| {
        let mut columns = s.lists(3, 200, Source::normal);
        columns[2] = (0..200).map(|row| 0.5 * f64::from(row)).collect();
        let y = (0..200).map(|row| 0.02 * f64::from(row) + s.normal()).collect();
        known(columns, y, &[], false)
    }),
    ("every row four times, nothing", |s| {
        let mut all = times(&s.lists(6, 50, Source::normal), 4);
        let y = all.pop().unwrap();
        known(all, y, &[], false)
    }),
    ("every row four times, shuffled", |s| {
        let mut all = times(&s.lists(6, 60, Source::normal), 4);
        s.shuffled(&mut all);
        let y = all.pop().unwrap();
        known(all, y, &[], false)
    }),
    ("four measurements of each setting", |s| {
        let mut columns = times(&s.lists(3, 40, Source::normal), 4);
        s.shuffled(&mut columns);
        let y = outputs(&columns, |x| x[0] + 0.1 * s.normal());
        known(columns, y, &[0], true)
    }),
    ("words and a number", |s| {
        let mut columns = s.lists(4, 500, Source::uniform);
        columns[1] = s.list(500, |s| s.below(3) as f64);
        columns[2] = s.list(500, |s| s.below(4) as f64);
        let y = outputs(&columns, |x| 2.0 * x[0] + [0.0, 1.5, -0.5][x[1] as usize] + 0.5 * s.normal());
        known(columns, y, &[0, 1], true).with_words(1, 3).with_words(2, 4)
    }),
    ("factorial of three levels", |s| {
        let columns = factorial(3, 3, 3);
        let y = outputs(&columns, |x| x[0] + (x[1] - 1.0).powi(2) + 0.3 * s.normal());
        known(columns, y, &[0, 1], true)
    }),
    ("factorial of two levels", |s| {
        let columns = factorial(2, 5, 1);
        let y = outputs(&columns, |x| x[0] - x[3] + 0.2 * s.normal());
        known(columns, y, &[0, 3], true)
    }),
    ("factors that act together alone", |s| {
        let columns = factorial(2, 4, 8);
        let y = outputs(&columns, |x| (2.0 * x[0] - 1.0) * (2.0 * x[2] - 1.0) + 0.3 * s.normal());
        known(columns, y, &[0, 2], true)
    }),
    ("factorial, nothing", |s| {
        let columns = factorial(3, 3, 2);
        let y = s.list(54, Source::normal);
        known(columns, y, &[], true)
    }),
    ("a switch", |s| {
        let mut columns = s.lists(3, 60, Source::uniform);
        columns[0] = s.list(60, |s| f64::from(s.uniform() < 0.4));
        let y = outputs(&columns, |x| 5.0 * x[0] + x[1]);
        known(columns, y, &[0], true).but(1)
    }),
    ("half of the values equal", |s| {
        let mut columns = s.lists(4, 200, Source::uniform);
        columns[0].iter_mut().for_each(|x| *x = (*x - 0.5).max(0.0));
        let y = outputs(&columns, |x| 4.0 * x[0] + 0.3 * s.normal());
        known(columns, y, &[0], true)
    }),
    ("a difference of causes that correlate, and its copy, 200 rows", |s| difference(s, 200, 0.9)),
    ("a difference of causes that correlate, and its copy, 500 rows", |s| difference(s, 500, 0.97)),
    ("a companion of causes that are not found", |s| {
        let mut columns = s.lists(8, 300, Source::normal);
        columns[7] = outputs(&columns, |x| x[..6].iter().sum::<f64>() + 0.3 * x[7]);
        let y = outputs(&columns, |x| x[..6].iter().sum::<f64>() + 2.0 * s.normal());
        (0..6).fold(known(columns, y, &[], false), Known::but)
    }),
    ("a sequence, nothing", |s| of_sequence(s, [62, 500], &[], |_, s| s.normal())),
    ("a sequence, one cause", |s| of_sequence(s, [62, 500], &[0], |x, _| 1.0 / (1.0 + x[0]))),
    ("a sequence, one cause, 200 rows", |s| of_sequence(s, [62, 200], &[0], |x, _| x[0].exp())),
    ("a sequence, one cause, 1500 rows", |s| of_sequence(s, [40, 1500], &[0], |x, _| x[0].exp())),
    ("a sequence, a spread", |s| of_sequence(s, [30, 500], &[0], |x, _| (x[0] - 0.5).abs())),
    ("a sequence, three causes", |s| {
        of_sequence(s, [62, 500], &[0, 1, 2], |x, s| x[0] + x[1] + x[2] + 0.3 * s.normal())
    }),
    ("a sequence, causes that act together", |s| {
        of_sequence(s, [62, 500], &[0], |x, _| x[0] + 0.7 * (2.0 * x[1] - 1.0) * (2.0 * x[2] - 1.0))
            .but(1)
            .but(2)
    }),
    ("a sequence, rows in another order", |s| {
        let Known { data, .. } = of_sequence(s, [62, 500], &[0], |x, _| x[0].powi(2));
        let mut columns = data.columns().to_vec();
        s.shuffled(&mut columns);
        let y = columns[0].iter().map(|x| x.powi(2)).collect();
        known(columns, y, &[0], true)
    }),
    ("a sequence with a copy of the cause", |s| {
        let Known { data, .. } = of_sequence(s, [20, 500], &[0], |x, _| x[0]);
        let mut columns = data.columns().to_vec();
        columns[1] = columns[0].iter().zip(&columns[1]).map(|(x, own)| 0.95 * x + 0.05 * own).collect();
        columns[2] = columns[0].iter().zip(&columns[2]).map(|(x, own)| x + own).collect();
        let y = outputs(&columns, |x| x[0] + 0.1 * s.normal());
        known(columns, y, &[0], false)
    }),
    ("a sequence and another output", |s| {
        let Known { data, .. } = of_sequence(s, [40, 500], &[0], |x, _| x[0]);
        let mut columns = data.columns().to_vec();
        columns[39] = columns[1].iter().map(|x| x + 0.1 * s.normal()).collect();
        let y = outputs(&columns, |x| x[0] + 0.1 * s.normal());
        known(columns, y, &[0], true)
    }),
    ("shares of a mixture", |s| {
        let mut columns = s.lists(4, 300, |s| -(1.0 - s.uniform()).ln());
        for row in 0..300 {
            let sum: f64 = columns[..3].iter().map(|column| column[row]).sum();
            columns[..3].iter_mut().for_each(|column| column[row] /= sum);
        }
        let y = outputs(&columns, |x| x[0] + 0.05 * s.normal());
        known(columns, y, &[0], false)
    }),
];
