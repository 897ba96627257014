//! Files of figures: formats by their names, width, title; figures of a folder by their names.

use crate::common::{answered, cdpr, cdpr_in, data_path, unwrapped};
use crate::study_run::bench;
use std::fs::read_to_string;
use std::path::Path;
use tempfile::TempDir;

/// A path along two poses of a robot with a figure of this name.
fn path(folder: &Path, robot: &str, poses: &str, figure: &str) -> std::process::Output {
    std::fs::write(folder.join("poses.csv"), poses).unwrap();
    cdpr_in(folder, &["path", robot, "--poses", "poses.csv", "--figure", figure, "--overwrite"])
}

#[test]
fn a_name_that_says_no_format_or_a_setting_that_is_none_is_refused_before_anything_is_computed() {
    let poses = data_path("poses/caroca.csv");
    for (name, remedy) in [
        ("x.eps", "ends in .svg, .pdf or .png"),
        ("x", "ends in .svg, .pdf or .png"),
        ("svg", "ends in .svg, .pdf or .png"),
        (".svg", "ends in .svg, .pdf or .png"),
        ("x.svg,90", "width=MM or untitled"),
        ("x.svg,width=9cm", "a number"),
        ("x.svg,width=5", "20 to 1000 mm"),
        ("x.svg,width=nan", "a finite number"),
        #[cfg(not(feature = "figures"))]
        ("x.pdf", "built with the feature `figures`"),
        #[cfg(not(feature = "figures"))]
        ("x.PNG", "built with the feature `figures`"),
    ] {
        let output = cdpr(&["path", "caroca", "--poses", &poses, "--figure", name]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        let message = unwrapped(output.stderr);
        assert!(output.stdout.is_empty() && message.contains(remedy), "{name}: {message}");
    }
}

#[test]
fn a_width_in_millimetres_and_a_caption_in_place_of_the_title() {
    let folder = TempDir::new().unwrap();
    let written = |name: &str| {
        let output = path(folder.path(), "caroca", "x_m,y_m,z_m\n0,0,1.75\n0,0,2\n", name);
        assert!(output.status.success(), "{}", unwrapped(output.stderr));
        read_to_string(folder.path().join("path.svg")).unwrap()
    };
    let usual = written("path.svg");
    assert!(usual.starts_with("<svg width=\"700\"") && usual.contains("CAROCA along a path of 2 poses"));
    let small = written("path.svg,width=90,untitled");
    assert!(small.starts_with("<svg width=\"340.157\""), "{}", &small[..80]);
    assert!(!small.contains("along a path of") && small.contains("tensions [N]"), "{small}");
}

#[test]
fn letters_have_seven_to_eight_points_at_the_width_of_a_column_and_of_a_page() {
    let folder = TempDir::new().unwrap();
    let run = |width: f64, name: &str, arguments: &[&str]| {
        let figure = format!("{name}.svg,width={width}");
        cdpr_in(folder.path(), &[arguments, &["--overwrite", "--figure", &figure]].concat());
        let svg = read_to_string(folder.path().join(format!("{name}.svg"))).unwrap();
        let number = |attribute: &str, text: &str| -> f64 {
            text.split(&format!("{attribute}=\""))
                .nth(1)
                .unwrap()
                .split(['"', ' '])
                .next()
                .unwrap()
                .parse()
                .unwrap()
        };
        let across = svg.split("viewBox=\"").nth(1).unwrap().split(['"', ' ']).nth(2).unwrap();
        let point = 0.75 * number("<svg width", &svg) / across.parse::<f64>().unwrap();
        for text in svg.split("<text ").skip(1) {
            let size = point * number("font-size", text);
            assert!((6.99..8.01).contains(&size), "{name}, {width} mm: {size} pt: {text:.200}");
        }
    };
    std::fs::write(folder.path().join("poses.csv"), "x_m,y_m,z_m\n0,0,2\n0.5,0,2\n1,0,2\n").unwrap();
    for width in [88.0, 180.0] {
        run(width, "path", &["path", "cogiro", "--poses", "poses.csv", "--payload", "20"]);
        run(
            width,
            "modes",
            &["response", "cogiro", "--pose", "0,0,2", "--below", "20", "--with", "damping=1e-3"],
        );
        run(
            width,
            "deflection",
            &["workspace", "cogiro", "--region", "::5,::5,1.5", "--payload", "20", "--out", "map"],
        );
    }
}

#[test]
fn a_figure_of_results_is_drawn_by_its_name() {
    let bench = bench();
    answered(cdpr_in(&bench.path("."), &["study", "run", "study.json", "--out", "out"]));
    let asked = |names: &[&str]| {
        let named = names.iter().flat_map(|name| ["--figure", name]);
        let arguments: Vec<&str> = ["study", "report", "out"].into_iter().chain(named).collect();
        cdpr_in(&bench.path("."), &arguments)
    };
    answered(asked(&["mechanical.svg,width=85", "robot.svg"]));
    assert!(read_to_string(bench.path("mechanical.svg")).unwrap().starts_with("<svg width=\"321.26\""));
    let same = ["robot.svg", "out/robot.svg"].map(|name| read_to_string(bench.path(name)).unwrap());
    assert_eq!(same[0], same[1]);
    let output = asked(&["robot.svg", "chemical.svg"]);
    assert_eq!(output.status.code(), Some(2));
    let message = unwrapped(output.stderr);
    assert!(message.contains("--figure chemical.svg") && message.contains("mechanical, "), "{message}");
}

#[test]
fn a_map_is_drawn_by_its_name() {
    let folder = TempDir::new().unwrap();
    let run =
        ["workspace", "caroca", "--region", "::5,::5,1.75", "--payload", "50", "--out", "map", "--figure"];
    let map = |name: &str| cdpr_in(folder.path(), &[&run[..], &[name, "--overwrite"]].concat());
    // Fewer than half of the positions are held.
    assert_eq!(map("deflection.svg,untitled").status.code(), Some(3));
    let [own, cut] = ["map/deflection.svg", "deflection.svg"]
        .map(|name| read_to_string(folder.path().join(name)).unwrap());
    assert!(own.contains("static deflection at z") && !cut.contains("static deflection at z"));
    let height = |svg: &str| -> f64 {
        svg.split("height=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    assert_eq!(height(&own) - height(&cut), 20.0);
    let output = map("torque.svg");
    assert_eq!(output.status.code(), Some(2));
    assert!(unwrapped(output.stderr).contains("deflection, "));
    assert!(folder.path().join("map/workspace.csv").exists());
}

#[cfg(feature = "figures")]
#[test]
fn pdf_and_png_come_from_every_robot_with_the_same_font_on_every_machine() {
    let folder = TempDir::new().unwrap();
    for (robot, poses) in [
        ("caroca", "0,0,1.75\n0,0,2"),
        ("cogiro", "0,0,2\n0,0,3"),
        ("fast", "0,0,10\n5,0,12"),
        ("ipanema-1", "0,0,1\n0.2,0,1"),
        ("ipanema-3", "0,0,1\n0.2,0,1"),
        ("four-cables", "0,0,1\n0.1,0,1"),
    ] {
        let poses = format!("x_m,y_m,z_m\n{poses}\n");
        for (name, begin) in [("path.pdf,width=90", &b"%PDF-1"[..]), ("path.png", b"\x89PNG")] {
            path(folder.path(), robot, &poses, name);
            let file = std::fs::read(folder.path().join(name.split(',').next().unwrap())).unwrap();
            assert!(file.starts_with(begin) && file.len() > 5000, "{robot} {name} {}", file.len());
        }
    }
}
