//! Figures of the robustness of the direct model.

use crate::figures::{rectangles, texts};
use cdpr_assess::{Answer, Protocol, ProtocolSummary, RobustnessResult, Solve};
use cdpr_report::{ReportError, found_poses, success_share};
use cdpr_robot::Pose;
use cdpr_statics::{DirectMethod, Residual, StaticsError};

/// Four solves from each start offset: 98 that find the true pose, one another equilibrium, one nothing.
pub(crate) fn robustness() -> RobustnessResult {
    let protocol = Protocol::mahnke_caverly(100, 1);
    let (wanted, away) = (Pose::at(0.0, 0.0, 2.0), Pose::at(1.0, 0.0, 2.0));
    let solve = |k: usize| {
        let distance = if k == 7 { 1.5 } else { 1e-15 * k as f64 };
        let answer = Answer {
            pose: if k == 7 { away } else { wanted },
            distance,
            angle: 0.0,
            anchor_distance: distance,
            method: DirectMethod::Newton,
            iterations: 5,
            residual: Residual { closure: 0.0, force: 0.0, moment: 0.0 },
            is_equilibrium: true,
        };
        let failure = StaticsError::Invalid { field: "x".into(), value: "y".into(), expected: "z".into() };
        Solve {
            draw: k,
            start_offset: k % 25,
            wanted,
            start: away,
            start_distance: 0.01 * k as f64,
            answer: if k == 8 { Err(failure) } else { Ok(answer) },
            microseconds: 50.0,
        }
    };
    RobustnessResult { solves: (0..100).map(solve).collect(), protocol, drawn: 100, refused: Vec::new() }
}

#[test]
fn every_solve_has_a_mark_unless_true_poses_are_too_many() {
    let mut result = robustness();
    let marks = |svg: &str| svg.matches("<circle ").count();
    let svg = found_poses(&result).unwrap();
    assert_eq!(marks(&svg), 100);
    let drawn = texts(&svg);
    for text in [
        "100 solves: 98 found the true pose, 1 another stable equilibrium, 1 failed",
        "another stable equilibrium",
        "distance of the start from the true pose [m]",
        "1e\u{2212}15",
    ] {
        assert!(drawn.contains(&text), "{text}: {drawn:?}");
    }
    let many = result.solves[9].clone();
    result.solves.extend(std::iter::repeat_n(many, 5000));
    let svg = found_poses(&result).unwrap();
    assert_eq!(marks(&svg), 5098_usize.div_ceil(3) + 2);
    assert!(svg.contains("of the true poses one in 3 is shown"));
    result.solves.retain(|solve| solve.answer.is_ok() && solve.draw != 7);
    assert!(!texts(&found_poses(&result).unwrap()).iter().any(|text| text.contains("failed (")));
}

#[test]
fn the_share_of_found_poses_has_a_cell_for_each_start_offset() {
    let summary = ProtocolSummary::new(&robustness());
    let svg = success_share(&summary).unwrap();
    assert_eq!(rectangles(&svg), 25);
    let texts = texts(&svg);
    for (text, cells) in [("100.00 %", 23), ("75.00 %", 2), ("4 of 4", 23), ("3 of 4", 2)] {
        assert_eq!(texts.iter().filter(|cell| **cell == text).count(), cells, "{text}: {texts:?}");
    }
    assert!(texts.contains(&"98 of 100 starts lead to the true pose (98.00 %)"));
}

#[test]
fn without_solves_or_with_invalid_distances_robustness_has_no_figure() {
    let mut result = robustness();
    result.solves[0].start_distance = f64::NAN;
    assert!(matches!(found_poses(&result), Err(ReportError::Invalid { .. })));
    let mut summary = ProtocolSummary::new(&result);
    summary.rows[0].distance = None;
    assert!(matches!(success_share(&summary), Err(ReportError::Invalid { .. })));
    result.solves.clear();
    assert!(matches!(found_poses(&result), Err(ReportError::Empty { .. })));
    assert!(matches!(success_share(&ProtocolSummary::new(&result)), Err(ReportError::Empty { .. })));
}
