//! Designs of many choices: what is left out early is worse, and too many are refused with their time.

use crate::design::{planar, solve, with};
use cdpr_assess::DesignProblem;
use cdpr_robot::{Pose, Wrench};
use cdpr_statics::{Load, deflection};
use serde_json::{Value, json};
use std::path::Path;

fn file(steps: [usize; 2]) -> Value {
    let places = |from: f64, count: usize| Vec::from_iter((0..count).map(|k| from - 0.05 * k as f64));
    let poses =
        (0..20).map(|k| json!({"position": [-0.6 + 0.06 * f64::from(k), 0, 0.01 * f64::from(k % 3)]}));
    json!({
        "format": "cdpr-design/1", "wrench": [60, 0, -40, 0, 0, 0],
        "variables": [
            {"parameters": ["b1.x"], "choices": places(-0.3, steps[0])},
            {"parameters": ["b2.z"], "choices": places(4.0, steps[1])},
        ],
        "poses": {"list": poses.collect::<Vec<_>>()},
        "objective": {"output": "deflection"},
    })
}

#[test]
fn configurations_that_are_left_at_a_pose_are_no_better_than_the_two_best_ones() {
    let found = solve(&file([50, 40]), planar(1.0, 1e6));
    let best = found.best.as_ref().unwrap();
    let load = Load::wrench(Wrench { force: [60.0, 0.0, -40.0].into(), moment: [0.0; 3].into() });
    let mut all: Vec<(f64, [f64; 2])> = Vec::new();
    let mut held = 0;
    for (x, z) in
        (0..50).flat_map(|i| (0..40).map(move |j| (-0.3 - 0.05 * f64::from(i), 4.0 - 0.05 * f64::from(j))))
    {
        let mut robot = planar(1.0, 1e6);
        (robot.cables[0].exit_point.x, robot.cables[1].exit_point.z) = (x, z);
        let each: Option<Vec<f64>> = (0..20)
            .map(|k| {
                let pose = Pose::at(-0.6 + 0.06 * f64::from(k), 0.0, 0.01 * f64::from(k % 3));
                Some(1e3 * deflection(&robot, &pose, &load).ok()?.magnitude())
            })
            .collect();
        held += usize::from(each.is_some());
        all.extend(each.map(|each| (each.into_iter().fold(0.0, f64::max), [x, z])));
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(found.configurations, 2000);
    assert!(found.left > 200 && (2..=held).contains(&found.feasible), "{} {}", found.left, found.feasible);
    let to: Vec<f64> = best.variables.iter().map(|variable| variable.to).collect();
    assert!((best.objective / all[0].0 - 1.0).abs() < 1e-9, "{} {:?}", best.objective, all[0]);
    assert!((best.next_configuration.unwrap() / all[1].0 - 1.0).abs() < 1e-9);
    assert!(to.iter().zip(all[0].1).all(|(a, b)| (a - b).abs() < 1e-12), "{to:?} {:?}", all[0]);
    assert!(held < 2000);
    // The same whatever the threads are.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(pool.install(|| solve(&file([50, 40]), planar(1.0, 1e6))), found);
}

#[test]
fn too_many_configurations_are_refused_with_their_number_and_time() {
    let refused = |file: Value| {
        let found = DesignProblem::from_json(&file.to_string(), Path::new("d.json"), planar(1.0, 1e6));
        found.unwrap_err().to_string()
    };
    let many = refused(file([2000, 1000]));
    assert!(many.contains("variables is 2000000 configurations: expected choices with at most"), "{many}");
    assert!(many.contains("to evaluate each of these once would take about "), "{many}");
    let mut searched = with(file([2000, 1]), "/starts", json!(1000));
    searched["variables"][1] = json!({"parameters": ["b2.z"], "bounds": [2.0, 4.0]});
    let searched = refused(searched);
    assert!(searched.contains("2000 configurations with 1000 starts in each"), "{searched}");
}
