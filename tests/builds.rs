//! Every dependency is compiled once: the program, all tests, the optional features and the wheel ask the
//! same features of it (those that `Cargo.toml` of `cdpr-tests`, `cdpr-python` and `xtask` add).

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// The features [each a set] with which a selection of packages and kinds of dependencies compiles each
/// package.
fn features(selection: &[&str]) -> BTreeMap<String, BTreeSet<String>> {
    let output = Command::new(std::env::var("CARGO").unwrap())
        .args(["tree", "--locked", "--prefix", "none", "--no-dedupe", "--format", "{p}|{f}"])
        .args(["--manifest-path", concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml")])
        .args(selection)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut features = BTreeMap::<String, BTreeSet<String>>::new();
    for line in String::from_utf8(output.stdout).unwrap().lines() {
        if let Some((package, of)) = line.split_once('|') {
            features.entry(package.to_owned()).or_default().insert(of.to_owned());
        }
    }
    features
}

#[test]
fn dependencies_are_compiled_once() {
    let tests = features(&["--workspace", "--edges", "normal,build,dev"]);
    assert!(tests.len() > 200, "{}", tests.len());
    let optional = "--features=cdpr/parquet,cdpr/figures,cdpr-fuzz/targets";
    for selection in [
        &["--edges", "normal,build"][..],
        &["--edges", "normal,build", "--package", "xtask"],
        &["--edges", "normal,build", "--package", "cdpr-python"],
        &["--edges", "normal,build,dev", "--workspace", optional],
    ] {
        let own = features(selection);
        for (package, tests_ask) in &tests {
            let Some(asked) = own.get(package).filter(|_| !package.starts_with("cdpr")) else { continue };
            let other: Vec<_> = asked.difference(tests_ask).collect();
            assert!(
                other.is_empty(),
                "{selection:?}: {package} with {other:?}, the tests with {tests_ask:?}"
            );
        }
    }
}
