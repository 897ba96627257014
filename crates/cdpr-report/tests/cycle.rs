//! Figure of a load cycle.

use cdpr_report::{Cycle, CycleBranch, ReportError, Sheet, cycle};

fn figure(branches: &[CycleBranch]) -> Result<String, ReportError> {
    cycle(
        &Cycle {
            title: "Loop",
            lines: &["dissipates <1 J".to_owned()],
            x: "elongation [mm]",
            y: "force [N]",
            branches,
        },
        Sheet::SCREEN,
    )
}

fn branch(name: &str, points: &[(f64, f64)]) -> CycleBranch {
    CycleBranch { name: name.to_owned(), points: points.to_vec() }
}

#[test]
fn each_sample_of_a_loop_has_its_dot() {
    let branches = [
        branch("loading", &[(0.0, 0.0), (1.0, 10.0), (2.0, 30.0)]),
        branch("unloading", &[(2.0, 30.0), (0.5, 1.0)]),
    ];
    let svg = figure(&branches).unwrap();
    assert_eq!(svg.matches("<circle").count(), 5);
    assert!(svg.contains("dissipates &lt;1 J") && svg.contains("unloading") && !svg.contains("NaN"));
}

#[test]
fn a_cycle_without_points_or_with_a_point_that_is_not_finite_has_no_figure() {
    assert!(matches!(figure(&[]), Err(ReportError::Empty { .. })));
    let nowhere = [branch("loading", &[(0.0, f64::NAN)])];
    assert!(matches!(figure(&nowhere), Err(ReportError::Invalid { .. })));
}
