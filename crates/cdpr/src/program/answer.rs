//! Results that several commands print, as JSON and as tables.
//!
//! JSON is in SI units; cables are numbered from 1, as in `a1.x`.

use crate::program::output::{Ending, print_sentence, table};
use cdpr_cable::SLACK_BELOW_OWN_WEIGHTS;
pub(crate) use cdpr_robot::decimal;
use cdpr_robot::{CableEnd, Pose, Robot, counted, decimals_of, significant};
use cdpr_statics::limits::{Limit, cables_in_words, in_words};
use cdpr_statics::stiffness::Mode;
use cdpr_statics::{Bound, DirectSolution, Equilibrium, Load, Stability};
use serde::Serialize;

/// Residuals of the equations at a solution.
#[derive(Serialize)]
pub(crate) struct Residual {
    /// Largest distance between the end of a cable and its anchor point [m].
    #[serde(rename = "closure_m")]
    closure: f64,
    /// Norm of the force that remains on the platform [N].
    #[serde(rename = "force_n")]
    force: f64,
    /// Norm of the moment about P that remains on the platform [N m].
    #[serde(rename = "moment_nm")]
    moment: f64,
}

impl Residual {
    pub(crate) fn new(residual: &cdpr_statics::Residual) -> Self {
        let cdpr_statics::Residual { closure, force, moment } = *residual;
        Self { closure, force, moment }
    }

    pub(crate) fn print(&self) {
        let Self { closure, force, moment } = self;
        println!("residuals: closure {closure:.1e} m, force {force:.1e} N, moment {moment:.1e} N m");
    }
}

/// The load that the lengths are for, without what is zero: with it an answer is a case of `cdpr direct`.
#[derive(Serialize)]
pub(crate) struct Borne {
    /// Mass [kg].
    #[serde(skip_serializing_if = "is_default")]
    payload: f64,
    /// Components in the base frame [N].
    #[serde(skip_serializing_if = "is_default")]
    force: [f64; 3],
    /// Components about P in the base frame [N m].
    #[serde(skip_serializing_if = "is_default")]
    moment: [f64; 3],
}

impl From<&Load> for Borne {
    fn from(Load { payload, wrench }: &Load) -> Self {
        Self { payload: *payload, force: wrench.force.into(), moment: wrench.moment.into() }
    }
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// A tension outside of what a cable is to bear, or can bear.
#[derive(Serialize)]
pub(crate) struct OutOfLimits {
    pub(crate) cable: usize,
    /// The end that has it: `anchor` or `exit`.
    end: CableEnd,
    /// The tension [N].
    #[serde(rename = "tension_n")]
    tension: f64,
    /// `min` or `max` of its limits, or `breaking_force`.
    pub(crate) limit: &'static str,
    /// The limit [N].
    #[serde(rename = "value_n")]
    pub(crate) value: f64,
    #[serde(skip)]
    found: cdpr_statics::limits::OutOfLimits,
}

impl OutOfLimits {
    /// Those of an answer of these unstrained lengths [m], over all its equilibria.
    pub(crate) fn all(robot: &Robot, lengths: &[f64], equilibria: &[&Equilibrium]) -> Vec<Self> {
        let found = cdpr_statics::limits::out_of_limits(robot, lengths, equilibria);
        found.into_iter().map(Self::new).collect()
    }

    /// Those of tensions of every cable at the platform and at its exit point [N].
    pub(crate) fn of_tensions(robot: &Robot, tensions: &[Vec<[f64; 2]>]) -> Vec<Self> {
        let found = cdpr_statics::limits::tensions_out_of_limits(robot, tensions);
        found.into_iter().map(Self::new).collect()
    }

    pub(crate) fn new(found: cdpr_statics::limits::OutOfLimits) -> Self {
        Self {
            cable: found.cable + 1,
            end: found.end,
            tension: found.tension,
            limit: found.limit.name(),
            value: found.value,
            found,
        }
    }

    /// Whether it is one of these tensions [N].
    pub(crate) fn is_of(&self, tensions: &[f64]) -> bool {
        tensions.contains(&self.tension)
    }

    pub(crate) fn print(list: &[Self]) {
        Self::words(list).iter().for_each(|line| print_sentence(line));
    }

    /// A line for all cables that pass the same limit.
    fn words(list: &[Self]) -> Vec<String> {
        in_words(&list.iter().map(|one| one.found).collect::<Vec<_>>())
    }

    /// What the cables do that bear too much, behind a verdict: `; cables 1 to 8 break`; empty if none do.
    pub(crate) fn verdict(list: &[Self]) -> String {
        let gravest = list.iter().filter(|one| one.is_too_much()).map(|one| one.found.limit).min();
        let Some(gravest) = gravest else { return String::new() };
        let same = list.iter().filter(|one| one.found.limit == gravest);
        let cables: Vec<usize> = same.map(|one| one.found.cable).collect();
        let s = if cables.len() == 1 { "s" } else { "" };
        let what = match gravest {
            Limit::BreakingForce => format!("break{s}"),
            Limit::Strain => format!("reach{} the greatest strain", if s.is_empty() { "" } else { "es" }),
            _ => format!("exceed{s} tension_limits.max"),
        };
        format!("; {} {what}", cables_in_words(&cables))
    }

    /// In one cell of a table.
    pub(crate) fn cell(list: &[Self]) -> String {
        Self::words(list).join("; ")
    }

    /// Whether the cable breaks or may not be strained so.
    pub(crate) fn is_too_much(&self) -> bool {
        self.found.is_too_much()
    }

    /// By how much the limit is passed, as a share of it.
    pub(crate) fn excess(&self) -> f64 {
        self.found.excess()
    }

    /// A cable that is slack answers the question; one that breaks or may not be strained so does not.
    pub(crate) fn ending(list: &[Self]) -> Ending {
        if list.iter().any(Self::is_too_much) { Ending::SomethingWrong } else { Ending::Well }
    }
}

/// A motion that nothing resists, with `|translation|² + ℓ² |rotation|² = 1`.
#[derive(Serialize)]
pub(crate) struct Neutral {
    /// Translation of P [m/m].
    translation: [f64; 3],
    /// Rotation vector [rad/m].
    rotation: [f64; 3],
}

impl Neutral {
    /// Those of an equilibrium.
    pub(crate) fn all(stability: &Stability) -> Vec<Self> {
        let one = |mode: &Mode| Self { translation: mode.translation.into(), rotation: mode.rotation.into() };
        stability.neutral().iter().map(one).collect()
    }

    pub(crate) fn print(list: &[Self]) {
        for Self { translation, rotation } in list {
            let (translation, rotation) = (vector(translation, 4), vector(rotation, 4));
            print_sentence(&format!(
                "nothing resists the motion {translation} m/m with the rotation {rotation} rad/m"
            ));
        }
    }
}

/// A stable equilibrium of the direct model.
#[derive(Serialize)]
pub(crate) struct Found {
    /// Position of P in the base frame.
    position: [f64; 3],
    /// Rows of the rotation matrix R.
    rotation: [[f64; 3]; 3],
    /// Position and angles in words.
    #[serde(skip)]
    pub(crate) place: String,
    #[serde(skip)]
    pub(crate) pose: Pose,
    /// Force (fx, fz) on each cable at its anchor point, in its vertical plane.
    cable_forces: Vec<[f64; 2]>,
    pub(crate) tensions: Vec<f64>,
    pub(crate) exit_tensions: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) out_of_limits: Vec<OutOfLimits>,
    stable: bool,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    neutral: Vec<Neutral>,
    residual: Residual,
    report: Report,
}

#[derive(Serialize)]
struct Report {
    method: String,
    iterations: usize,
    /// Stiffness of the softest motion [N/m].
    #[serde(rename = "least_stiffness_n_per_m")]
    least_stiffness: f64,
    /// Cables whose tension at the lower end is at most `slack_below_own_weights` times their weight.
    slack_cables: Vec<usize>,
    slack_below_own_weights: f64,
    /// Other cables that are longer than the distance of their points: loaded, but sagging.
    sagging_cables: Vec<usize>,
}

impl Found {
    pub(crate) fn new(robot: &Robot, lengths: &[f64], solution: &DirectSolution) -> Self {
        let DirectSolution { equilibrium, report, stability } = solution;
        let sagging = report.longer_than_chord.iter().filter(|i| !report.slack.contains(i));
        Self {
            position: equilibrium.pose.position.into(),
            rotation: rows(&equilibrium.pose),
            place: exact_place(robot, &equilibrium.pose),
            pose: equilibrium.pose,
            cable_forces: forces(equilibrium),
            tensions: equilibrium.tensions(),
            exit_tensions: equilibrium.exit_tensions(robot, lengths),
            out_of_limits: OutOfLimits::all(robot, lengths, &[equilibrium]),
            stable: stability.is_stable(),
            neutral: Neutral::all(stability),
            residual: Residual::new(&report.residual),
            report: Report {
                method: report.method.to_string(),
                iterations: report.iterations,
                least_stiffness: stability.least_stiffness(),
                slack_cables: report.slack.iter().map(|i| i + 1).collect(),
                slack_below_own_weights: SLACK_BELOW_OWN_WEIGHTS,
                sagging_cables: sagging.map(|i| i + 1).collect(),
            },
        }
    }

    pub(crate) fn ending(&self) -> Ending {
        OutOfLimits::ending(&self.out_of_limits)
    }

    /// Where it rests, and its cables.
    pub(crate) fn print(&self, name: &str, lengths: &[f64]) {
        let (stable, beyond) = (stability_word(self.stable), OutOfLimits::verdict(&self.out_of_limits));
        print_sentence(&format!("{name} rests at {}, {stable}{beyond}.", self.place));
        print_cables(lengths, &self.tensions, &self.exit_tensions);
        self.print_rest();
    }

    /// Tensions out of limits, stability, slack cables and residuals.
    pub(crate) fn print_rest(&self) {
        OutOfLimits::print(&self.out_of_limits);
        let Report { method, iterations, least_stiffness, slack_cables, sagging_cables, .. } = &self.report;
        let iterations = counted(*iterations, "iteration");
        println!("softest motion {least_stiffness:.1} N/m; {method}, {iterations}");
        Neutral::print(&self.neutral);
        if !slack_cables.is_empty() {
            println!(
                "slack cables: {} (they carry nothing, or less than their own weight)",
                numbers(slack_cables)
            );
        }
        if !sagging_cables.is_empty() {
            let cables = numbers(sagging_cables);
            println!("sagging cables: {cables} (longer than the distance of their points)");
        }
        self.residual.print();
    }

    /// Stiffness of the softest motion [N/m].
    pub(crate) fn least_stiffness(&self) -> f64 {
        self.report.least_stiffness
    }

    /// Whether it is stable.
    pub(crate) fn is_stable(&self) -> bool {
        self.stable
    }
}

/// `stable` or `unstable`.
pub(crate) fn stability_word(stable: bool) -> &'static str {
    if stable { "stable" } else { "unstable" }
}

/// Least and greatest of the tensions [N] in words, such as `55.07 to 412.3 N`.
pub(crate) fn tension_range(tensions: &[f64]) -> String {
    let [least, greatest] = [
        tensions.iter().copied().fold(f64::INFINITY, f64::min),
        tensions.iter().copied().fold(0.0, f64::max),
    ]
    .map(|tension| significant(tension, 4));
    if least == greatest { format!("{least} N") } else { format!("{least} to {greatest} N") }
}

/// Position and angles of a pose, to a micrometre. A point mass has no angles.
pub(crate) fn exact_place(robot: &Robot, pose: &Pose) -> String {
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let angles = [roll, pitch, yaw].map(f64::to_degrees);
    let position = vector(pose.position.as_slice(), 6);
    if robot.platform.point {
        return format!("{position} m");
    }
    format!("{position} m with (roll, pitch, yaw) = {} degrees", vector(&angles, 4))
}

/// Prints lengths and tensions of all cables, these at the platform and at the exit point.
pub(crate) fn print_cables(lengths: &[f64], tensions: &[f64], exit_tensions: &[f64]) {
    let mut rows = table(&["cable", "unstrained length [m]", "tension [N]", "at exit point [N]"]);
    let decimals = decimals_of(exit_tensions.iter().chain(tensions).copied(), 3);
    for (i, (length, (tension, exit))) in lengths.iter().zip(tensions.iter().zip(exit_tensions)).enumerate() {
        let [tension, exit] = [tension, exit].map(|tension| decimal(*tension, decimals));
        rows.add_row([(i + 1).to_string(), format!("{length:.6}"), tension, exit]);
    }
    println!("{rows}");
}

pub(crate) fn forces(equilibrium: &Equilibrium) -> Vec<[f64; 2]> {
    equilibrium.cable_forces.iter().map(|force| (*force).into()).collect()
}

/// Rows of the rotation matrix R.
fn rows(pose: &Pose) -> [[f64; 3]; 3] {
    pose.rotation.matrix().transpose().into()
}

/// A vector in brackets.
pub(crate) fn vector(components: &[f64], decimals: usize) -> String {
    let texts: Vec<_> = components.iter().map(|component| decimal(*component, decimals)).collect();
    format!("({})", texts.join(", "))
}

/// `min` or `max`.
pub(crate) fn bound_name(bound: Bound) -> &'static str {
    match bound {
        Bound::Min => "min",
        Bound::Max => "max",
    }
}

/// Numbers separated by commas.
pub(crate) fn numbers(list: &[usize]) -> String {
    list.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}
