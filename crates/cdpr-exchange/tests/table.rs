//! Tables of lengths, interpolated as firmware does, against the model at random poses.

use cdpr_exchange::{ExchangeError, TableErrors, correction_table};
use cdpr_robot::library::{ROBOTS, named};
use cdpr_robot::{Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, inverse};

/// Random poses of all robots together.
const POSES: usize = 10_000;

fn robot(name: &str) -> Robot {
    Robot::from_json(named(ROBOTS, name).unwrap().text).unwrap()
}

fn line(min: f64, max: f64, points: usize) -> Vec<f64> {
    let step = (max - min) / points.max(2).saturating_sub(1) as f64;
    (0..points).map(|k| min + step * k as f64).collect()
}

/// A table of a file: its coordinates and rows.
struct Read {
    coordinates: [Vec<f64>; 3],
    rows: Vec<Vec<f64>>,
}

impl Read {
    fn new(text: &str) -> Self {
        let mut lines = text.lines();
        assert!(lines.next().unwrap().starts_with("x_mm,y_mm,z_mm,length_1_mm,"), "{text}");
        let row = |line: &str| line.split(',').map(|word| word.parse().unwrap()).collect();
        let rows: Vec<Vec<f64>> = lines.map(row).collect();
        let along = |axis: usize| {
            let mut found: Vec<f64> = rows.iter().map(|row| row[axis]).collect();
            found.sort_by(f64::total_cmp);
            found.dedup();
            found
        };
        Self { coordinates: [0, 1, 2].map(along), rows }
    }

    /// The values behind the position, interpolated linearly along each axis [mm].
    fn at(&self, position: &Vector3<f64>) -> Vec<f64> {
        let mut corners = vec![(0, 1.0)];
        for (axis, along) in self.coordinates.iter().enumerate() {
            let value = 1e3 * position[axis];
            let cell = along.partition_point(|node| *node <= value).clamp(1, along.len().max(2) - 1) - 1;
            let share = match along.get(cell + 1) {
                Some(next) => (value - along[cell]) / (next - along[cell]),
                None => 0.0,
            };
            corners = corners
                .into_iter()
                .flat_map(|(index, weight)| {
                    let index = index * along.len() + cell;
                    [(index, weight * (1.0 - share)), (index + 1, weight * share)]
                })
                .filter(|(_, weight)| *weight != 0.0)
                .collect();
        }
        let values = self.rows[0].len() - 3;
        (0..values)
            .map(|k| corners.iter().map(|(row, weight)| weight * self.rows[*row][3 + k]).sum())
            .collect()
    }
}

/// Numbers between 0 and 1, the same in each run (PCG of O'Neill 2014, its 32 bits).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (((self.0 >> 18) ^ self.0) >> 27) as u32;
        f64::from(mixed.rotate_right((self.0 >> 59) as u32)) / f64::from(u32::MAX)
    }
}

/// Greatest errors at random positions of the lengths and of the platform that rests on them [m].
fn measured(
    robot: &Robot,
    rotation: Rotation3<f64>,
    coordinates: &[Vec<f64>; 3],
    poses: usize,
) -> (TableErrors, TableErrors) {
    let table = correction_table(robot, &rotation, coordinates).unwrap();
    let read = Read::new(&table.exported.files[0].1);
    let nodes: usize = coordinates.iter().map(Vec::len).product();
    assert_eq!(read.rows.len(), nodes);
    let mut found =
        TableErrors { length: 0.0, position: 0.0, corrected_length: 0.0, corrected_position: 0.0 };
    let mut numbers = Numbers(1);
    for _ in 0..poses {
        let inside = |along: &Vec<f64>| along[0] + (along[along.len() - 1] - along[0]) * numbers.next();
        let [x, y, z] = coordinates.each_ref().map(inside);
        let pose = Pose { position: Vector3::new(x, y, z), rotation };
        let model = inverse(robot, &pose, &Load::none()).unwrap();
        let values = read.at(&pose.position);
        let cables = robot.cables.len();
        let lengths: Vec<f64> = values[..cables].iter().map(|value| 1e-3 * value).collect();
        let corrected = values[cables..].iter().enumerate();
        let corrected: Vec<f64> =
            corrected.map(|(i, value)| robot.span(&pose, i).norm() + 1e-3 * value).collect();
        let way = |lengths: &[f64]| {
            let problem = DirectProblem::new(robot, lengths, &Load::none()).unwrap();
            let rest = problem.direct(DirectStart::Near(&model.equilibrium)).unwrap();
            (rest.equilibrium.pose.position - pose.position).norm()
        };
        let off = |lengths: &[f64]| {
            lengths.iter().zip(&model.lengths).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        found.length = found.length.max(off(&lengths));
        found.corrected_length = found.corrected_length.max(off(&corrected));
        found.position = found.position.max(way(&lengths));
        found.corrected_position = found.corrected_position.max(way(&corrected));
    }
    (table.errors, found)
}

/// Forward of inverse: the platform that rests on interpolated lengths is where it was wanted, within the
/// bound.
#[test]
fn interpolated_lengths_hold_the_wanted_pose_within_the_bound_that_is_stated() {
    let maslow = Robot::from_json(include_str!("../../../docs/how-to/planner/maslow.json")).unwrap();
    let camera = Robot::from_json(include_str!("../../../docs/how-to/planner/stadium.json")).unwrap();
    let level = Rotation3::identity();
    let cases = [
        ("maslow", maslow, level, [line(0.5, 2.4, 20), vec![0.0], line(0.5, 1.6, 12)]),
        ("camera", camera, level, [line(-30.0, 30.0, 9), line(-20.0, 20.0, 7), line(5.0, 15.0, 5)]),
        ("cogiro", robot("cogiro"), level, [line(-2.0, 2.0, 5), line(-1.0, 1.0, 4), line(2.0, 3.0, 3)]),
        (
            "ipanema-3",
            robot("ipanema-3"),
            Rotation3::from_euler_angles(0.02, 0.0, 0.05),
            [line(-1.0, 1.0, 5), line(-1.0, 1.0, 5), line(1.0, 1.6, 4)],
        ),
    ];
    let poses = std::env::var("CDPR_CASES").map_or(POSES, |poses| poses.parse().unwrap()) / cases.len();
    for (name, robot, rotation, coordinates) in cases {
        let (bound, found) = measured(&robot, rotation, &coordinates, poses);
        println!("{name}: {bound:?}\n  found {found:?}");
        assert!(found.length <= bound.length && found.position <= bound.position, "{name}");
        assert!(found.corrected_length <= bound.corrected_length, "{name}");
        assert!(found.corrected_position <= bound.corrected_position, "{name}");
        // The bounds are no more than ten times what is found, and corrections are smoother than lengths.
        assert!(bound.length < 10.0 * found.length, "{name}");
        assert!(found.corrected_length < 0.5 * found.length, "{name}");
    }
}

#[test]
fn a_finer_grid_has_a_quarter_of_the_error() {
    let cogiro = robot("cogiro");
    let errors = |points: usize| {
        let coordinates = [line(-1.0, 1.0, points), line(-0.5, 0.5, points), line(2.0, 3.0, points)];
        correction_table(&cogiro, &Rotation3::identity(), &coordinates).unwrap().errors
    };
    let (coarse, fine) = (errors(3), errors(5));
    assert!((coarse.length / fine.length - 4.0).abs() < 0.6, "{coarse:?} {fine:?}");
    assert!((coarse.position / fine.position - 4.0).abs() < 0.6, "{coarse:?} {fine:?}");
}

/// Lengths are those of the inverse model, and corrections those less the distances.
#[test]
fn rows_are_positions_with_the_lengths_of_the_model_z_fastest() {
    let cogiro = robot("cogiro");
    let coordinates = [vec![-1.0, 1.5], vec![0.25], vec![2.0, 2.5, 4.0]];
    let table = correction_table(&cogiro, &Rotation3::identity(), &coordinates).unwrap();
    let (ending, text) = &table.exported.files[0];
    assert_eq!(*ending, ".csv");
    let read = Read::new(text);
    assert_eq!(read.rows.len(), 6);
    assert_eq!(read.rows[1][..3], [-1000.0, 250.0, 2500.0]);
    assert_eq!(read.rows[3][..3], [1500.0, 250.0, 2000.0]);
    let pose = Pose::at(1.5, 0.25, 4.0);
    let lengths = inverse(&cogiro, &pose, &Load::none()).unwrap().lengths;
    for (i, length) in lengths.iter().enumerate() {
        assert!((read.rows[5][3 + i] - 1e3 * length).abs() < 1e-5);
        let correction = 1e3 * (length - cogiro.span(&pose, i).norm());
        assert!((read.rows[5][11 + i] - correction).abs() < 1e-5);
    }
    let notes = table.exported.notes.join(" ");
    assert!(
        notes.contains("interpolated lengths are wrong by at most") && notes.contains("measured, not proved")
    );
    // A single position is not interpolated.
    let one = correction_table(&cogiro, &Rotation3::identity(), &[vec![0.0], vec![0.0], vec![2.0]]).unwrap();
    assert!(one.errors.length < 2e-9 && one.errors.corrected_length < 2e-9, "{:?}", one.errors);
}

#[test]
fn coordinates_that_make_no_grid_and_positions_that_are_not_held_are_named() {
    let cogiro = robot("cogiro");
    let grid =
        |coordinates: [Vec<f64>; 3]| match correction_table(&cogiro, &Rotation3::identity(), &coordinates) {
            Err(ExchangeError::Grid { field, value, .. }) => format!("{field} is {value}"),
            other => panic!("{other:?}"),
        };
    let fine = || vec![2.0];
    assert_eq!(grid([vec![], fine(), fine()]), "coordinates along x is a list of 0");
    assert_eq!(grid([fine(), vec![1.0, 0.0], fine()]), "coordinates along y is a list of 2");
    assert_eq!(grid([fine(), fine(), vec![1.0, 1.0]]), "coordinates along z is a list of 2");
    assert_eq!(grid([vec![f64::NAN], fine(), fine()]), "coordinates along x is a list of 1");
    let many = || line(0.0, 1.0, 50);
    assert_eq!(grid([many(), many(), many()]), "positions is 50 x 50 x 50");
    let coordinates = [vec![0.0, 20.0], vec![0.0], vec![2.0]];
    match correction_table(&cogiro, &Rotation3::identity(), &coordinates) {
        Err(ExchangeError::Position { position, reason }) => {
            assert_eq!(position, [20.0, 0.0, 2.0]);
            assert!(!reason.is_empty());
        }
        other => panic!("{other:?}"),
    }
    // A platform with fewer cables than free motions has no pose to choose.
    let hung = Robot::from_json(include_str!("../../../docs/how-to/planner/drawn.json")).unwrap();
    let coordinates = [vec![0.0], vec![0.0], vec![14.0]];
    let refused = correction_table(&hung, &Rotation3::identity(), &coordinates);
    assert!(matches!(refused, Err(ExchangeError::Position { .. })), "{refused:?}");
}
