//! What robots that differ leave after a move.

use cdpr_assess::{DrawnRobots, ratio_of_best};
use cdpr_dynamics::moves::{FeedForward, Move, Shaper, ShaperKind};
use cdpr_dynamics::simulate::{Discretization, Profile, Settings};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, Study, uncertainties};
use std::path::Path;

/// How many robots are drawn.
///
/// `CDPR_CASES=100 cargo test -p cdpr-assess --test integration vibration:: -- --nocapture`
fn count() -> usize {
    std::env::var("CDPR_CASES").map_or(4, |count| count.parse().unwrap())
}

/// The greatest ratio of the vibration with and without a shaper that 95 of 100 robots leave.
fn ratio(robot: &Robot, model: &ErrorModel, (height, profile): (f64, Profile)) -> f64 {
    let poses = [-0.5, 0.5].map(|x| Pose::at(x, 0.0, height));
    let plain = Move {
        robot,
        load: Load::none(),
        poses: &poses,
        seconds: 1.0,
        profile,
        shaper: Shaper::default(),
        feed_forward: FeedForward::None,
        rate: 200.0,
    };
    let (shaped, _) = plain.shaped(ShaperKind::Zvd, 2, 0.0).unwrap();
    let points = [plain.plan().unwrap(), shaped.plan().unwrap()];
    let drawn = DrawnRobots { nominal: robot, model, count: count(), seed: 1 };
    let discretization = Some(Discretization { elements: 2, degree: 5 });
    let settings = Settings { rate: 200.0, discretization, tolerance: 1e-6, ..Settings::until(0.5) };
    let compared = drawn.compare(&Load::none(), [&points[0], &points[1]], &settings, &|| {}).unwrap();
    let failed: Vec<_> = compared.iter().filter_map(|one| one.as_ref().err()).collect();
    assert!(failed.is_empty(), "{failed:?}");
    let slack = compared.iter().flatten().flatten().filter(|one| !one.slack.is_empty()).count();
    let unshaped = compared.iter().flatten().map(|[plain, _]| plain.amplitude).fold(f64::INFINITY, f64::min);
    let best = count() - count() / 20;
    let [ratio, worst] = [best, count()].map(|count| ratio_of_best(&compared, count).unwrap());
    println!(
        "{}, {profile:?}: {best} of {} robots leave {:.1} % or less of {:.3} mm or more, \
         the worst one {:.1} %; {slack} slack",
        robot.name,
        count(),
        100.0 * ratio,
        1e3 * unshaped,
        100.0 * worst
    );
    ratio
}

fn robot(name: &str) -> Robot {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/robots");
    let mut robot = cdpr_study::open_robot(&Path::new(file).join(format!("{name}.json"))).unwrap();
    robot.platform.inertia = Some(robot.platform.inertia.unwrap_or_else(|| robot.assumed_inertia()));
    robot
}

#[test]
fn shapers_leave_less_than_a_third_for_robots_that_differ() {
    let study = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json");
    let tolerances = Study::open(Path::new(study)).unwrap().tolerances("table_3").unwrap();
    assert!(ratio(&robot("caroca"), &tolerances, (1.75, Profile::Cosine)) < 0.3);
    for (name, height, profile) in [("cogiro", 2.0, Profile::Cosine), ("ipanema-3", 1.5, Profile::Trapezoid)]
    {
        let robot = robot(name);
        let named = [("a", 0.002), ("b", 0.002), ("mass", 0.02 * robot.platform.mass)];
        let named = named.map(|(name, std)| (name.to_owned(), std));
        let model = ErrorModel::normal(&robot, &uncertainties(&robot, &named).unwrap());
        let ratio = ratio(&robot, &model, (height, profile));
        assert!(ratio < 0.3, "{name}: {ratio}");
    }
}
