//! Motions of robots of the library.

use crate::robots::{ROBOTS, free_coordinates, robot, wanted};
use cdpr_dynamics::simulate::{Change, CutAt, Event, Profile, Series, Settings, simulate};
use cdpr_robot::{Pose, Robot, Vector3, Wrench};
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, inverse};

/// Its lengths at the pose, and the rest.
fn rest(robot: &Robot, position: [f64; 3], free: &str, load: &Load) -> (Vec<f64>, Equilibrium) {
    let [x, y, z] = position;
    let (pose, free) = (Pose::at(x, y, z), free_coordinates(free));
    let held = inverse(robot, wanted(&pose, &free), load).unwrap();
    let problem = DirectProblem::new(robot, &held.lengths, load).unwrap();
    let found = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap();
    (held.lengths, found.equilibrium)
}

fn moved(series: &Series, from: &Pose) -> f64 {
    let motion = |pose: &Pose| from.motion_to(pose);
    series.samples.iter().map(|sample| motion(&sample.pose).norm()).fold(0.0, f64::max)
}

#[test]
fn robots_at_rest_stay_at_rest() {
    for (file, position, free) in ROBOTS {
        let robot = robot(file);
        let (lengths, rest) = rest(&robot, position, free, &Load::none());
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let series = simulate(&problem, &rest, &[], &Settings::until(1.0)).unwrap();
        let from = series.samples[0].pose;
        let way = moved(&series, &from);
        let off = rest.pose.motion_to(&from).norm();
        println!(
            "{}: moves {way:e}, off {off:e}, residual {:e}, {:?}",
            robot.name, series.residual, series.work
        );
        let tensions = rest.tensions();
        for (i, [exit, anchor]) in series.samples[0].tensions.iter().enumerate() {
            println!(
                "   {i} {exit:.6} {anchor:.6} {:.6} {:.6}",
                rest.exit_tensions(&robot, &lengths)[i],
                tensions[i]
            );
        }
    }
}

#[test]
fn a_platform_put_where_it_rests_with_a_payload_stays_there_with_it() {
    for (file, position, free) in ROBOTS {
        let robot = robot(file);
        let (lengths, rest) = rest(&robot, position, free, &Load::none());
        let payload = 0.1 * robot.platform.mass;
        let loaded = DirectProblem::new(&robot, &lengths, &Load::payload(payload)).unwrap();
        let loaded = loaded.direct(DirectStart::Near(&rest)).unwrap().equilibrium;
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let motion = rest.pose.motion_to(&loaded.pose);
        let at = |change| Event { time: 0.0, change };
        let events = [at(Change::Displace(motion)), at(Change::Payload(payload))];
        match simulate(&problem, &rest, &events, &Settings::until(1.0)) {
            Ok(series) => println!(
                "{}: deflects {:e}, moves {:e} {:?}",
                robot.name,
                motion.norm(),
                moved(&series, &loaded.pose),
                series.work
            ),
            Err(error) => println!("{}: {error}", robot.name),
        }
    }
}

#[test]
fn cables_part_and_winches_turn_on_every_robot() {
    for (file, position, free) in ROBOTS {
        let robot = robot(file);
        let (lengths, rest) = rest(&robot, position, free, &Load::none());
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        for change in [
            Change::Cut { cable: 0, at: CutAt::Anchor },
            Change::Cut { cable: 1, at: CutAt::Exit },
            Change::Shorten { cable: 2, by: 1e-3 * lengths[2], over: 0.2, profile: Profile::Polynomial },
            Change::Wrench {
                force: Vector3::new(0.0, 0.1 * 9.81 * robot.platform.mass, 0.0),
                moment: Vector3::zeros(),
            },
        ] {
            let events = [Event { time: 0.1, change }];
            let settings = Settings { damping: 2e-4, ..Settings::until(0.5) };
            let clock = std::time::Instant::now();
            match simulate(&problem, &rest, &events, &settings) {
                Ok(series) => println!(
                    "{}: {change:?}: moves {:.3e}, {:?} {:?} drift {:e} kin {:e} {:.1?}",
                    robot.name,
                    moved(&series, &rest.pose),
                    series.difference,
                    series.work,
                    series.energy.drift,
                    series.energy.kinetic,
                    clock.elapsed()
                ),
                Err(error) => println!("{}: {change:?} {error} {:.1?}", robot.name, clock.elapsed()),
            }
        }
    }
    let _ = Wrench::none();
}
