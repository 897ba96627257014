//! What robots that differ leave after a move.

use cdpr_assess::{DrawnRobots, ratio_of_best};
use cdpr_dynamics::moves::{FeedForward, Move, Shaper, ShaperKind};
use cdpr_dynamics::simulate::{Discretization, Profile, Settings};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, Study, uncertainties};
use std::path::Path;

/// How many robots are drawn.
const COUNT: usize = 4;

/// The ratios of the vibration with and without a shaper, and the greatest of them.
fn ratios(robot: &Robot, model: &ErrorModel, (height, profile): (f64, Profile)) -> (Vec<f64>, f64) {
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
    let drawn = DrawnRobots { nominal: robot, model, count: COUNT, seed: 1 };
    let discretization = Some(Discretization { elements: 2, degree: 5 });
    let settings = Settings { rate: 200.0, discretization, tolerance: 1e-6, ..Settings::until(0.5) };
    let clock = std::time::Instant::now();
    let compared = drawn.compare(&Load::none(), [&points[0], &points[1]], &settings, &|| {}).unwrap();
    let ratios = compared.iter().map(|one| match one {
        Ok([plain, shaped]) => shaped.amplitude / plain.amplitude,
        Err(error) => panic!("{error}"),
    });
    let best = ratio_of_best(&compared, COUNT).unwrap();
    let ratios: Vec<f64> = ratios.collect();
    println!("{}: {best} of {ratios:.3?}, {:.1} s", robot.name, clock.elapsed().as_secs_f64());
    (ratios, best)
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
    let (ratios_of, best) = ratios(&robot("caroca"), &tolerances, (1.75, Profile::Cosine));
    assert!(ratios_of.len() == COUNT && best < 0.3, "{best}");
    for (name, height, profile) in [("cogiro", 2.0, Profile::Cosine), ("ipanema-3", 1.5, Profile::Trapezoid)]
    {
        let robot = robot(name);
        let named = [("a", 0.002), ("b", 0.002), ("mass", 0.02 * robot.platform.mass)];
        let named = named.map(|(name, std)| (name.to_owned(), std));
        let model = ErrorModel::normal(&robot, &uncertainties(&robot, &named).unwrap());
        let (_, best) = ratios(&robot, &model, (height, profile));
        assert!(best < 0.3, "{name}: {best}");
    }
}
