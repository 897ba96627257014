//! `cargo xtask dist`: what a release consists of, in `target/dist`.
//!
//! The program, a wheel for all Pythons from 3.10 on, the packed crates, the list of all crates that they
//! consist of (SBOM), the book, the notes of the version from CHANGELOG.md, and the checksums of all files. A
//! part whose tool is not installed is left out, and the last lines say so.

use crate::cargo::{cargo_command, cdpr_command, done, parsed, root, text_of};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::Command;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Makes one part in a folder.
type Part = fn(&Path) -> Outcome;

pub(crate) fn run(rest: &[String]) -> Result<(), String> {
    if !rest.is_empty() {
        return Err("`cargo xtask dist` is followed by nothing".to_owned());
    }
    let folder = root().join("target/dist");
    let parts: [(&str, Part); 6] = [
        ("program", program),
        ("notes", notes),
        ("crates", crates),
        ("bill of materials", materials),
        ("wheel", wheel),
        ("book", book),
    ];
    let made = fs::remove_dir_all(&folder).or_else(|error| match error.kind() {
        std::io::ErrorKind::NotFound => Ok(()),
        _ => Err(error),
    });
    let made = made.and_then(|()| fs::create_dir_all(&folder));
    made.map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut left_out = Vec::new();
    for (name, make) in parts {
        eprintln!("{name}");
        if let Err(error) = make(&folder) {
            left_out.push(format!("{name}: {error}"));
        }
    }
    if let Err(error) = checksums(&folder) {
        left_out.push(format!("checksums: {error}"));
    }
    eprintln!("\n{} holds what could be made", folder.display());
    if left_out.is_empty() { Ok(()) } else { Err(format!("left out:\n{}", left_out.join("\n"))) }
}

/// The program, on Linux with everything linked in, so that it runs on any.
fn program(folder: &Path) -> Outcome {
    let host = host()?;
    let features = "cdpr/figures,cdpr/parquet";
    let package = ["--package", "cdpr", "--features", features];
    let mut build =
        cargo_command(&[&["build", "--release", "--locked", "--target", &host], &package[..]].concat());
    // For a smaller program: what nobody calls across crates is left out.
    build.env("CARGO_PROFILE_RELEASE_STRIP", "symbols").env("CARGO_PROFILE_RELEASE_LTO", "fat");
    // On macOS the system's own library is there, and on Windows that of the compiler is linked in.
    if !host.contains("apple") {
        build.env("RUSTFLAGS", "-C target-feature=+crt-static");
    }
    done(&mut build)?;
    let suffix = std::env::consts::EXE_SUFFIX;
    let built = root().join("target").join(&host).join("release").join(format!("cdpr{suffix}"));
    fs::copy(built, folder.join(format!("cdpr-{host}{suffix}")))?;
    Ok(())
}

/// The target of this machine, as the compiler names it.
fn host() -> Result<String, Box<dyn std::error::Error>> {
    let found = Command::new("rustc").arg("--version").arg("--verbose").output()?;
    let text = String::from_utf8(found.stdout)?;
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    Ok(host.ok_or("`rustc --version --verbose` names no host")?.to_owned())
}

/// The first section of the changelog.
fn notes(folder: &Path) -> Outcome {
    let text = fs::read_to_string(root().join("CHANGELOG.md"))?;
    let section = text.split("\n## ").nth(1).ok_or("CHANGELOG.md has no section")?;
    Ok(fs::write(folder.join("NOTES.md"), format!("## {}\n", section.trim_end()))?)
}

/// The crates as a registry takes them. They name each other by versions, so none is built here.
fn crates(folder: &Path) -> Outcome {
    let into = folder.join("crates");
    let mut package = cargo_command(&["package", "--workspace", "--locked", "--no-verify", "--allow-dirty"]);
    // What is not published.
    package.args(
        ["xtask", "cdpr-tests", "cdpr-python", "cdpr-evidence"].map(|name| format!("--exclude={name}")),
    );
    // A folder without packages of other versions.
    done(package.arg("--target-dir").arg(&into))?;
    for file in fs::read_dir(into.join("package"))? {
        let path = file?.path();
        if let Some(name) = path.file_name().filter(|_| path.extension().is_some_and(|end| end == "crate")) {
            fs::rename(&path, folder.join(name))?;
        }
    }
    Ok(fs::remove_dir_all(into)?)
}

/// All crates of the lock file with their licenses, as a software bill of materials (CycloneDX 1.5).
fn materials(folder: &Path) -> Outcome {
    let metadata = text_of(&mut cargo_command(&["metadata", "--locked", "--format-version", "1"]), &[0])?;
    let metadata = parsed(&metadata)?;
    let component = |of: &Value| {
        let (name, version) =
            (of["name"].as_str().unwrap_or_default(), of["version"].as_str().unwrap_or_default());
        json!({
            "type": "library",
            "name": name,
            "version": version,
            "purl": format!("pkg:cargo/{name}@{version}"),
            "licenses": [{ "expression": of["license"] }],
        })
    };
    let components: Vec<Value> =
        metadata["packages"].as_array().into_iter().flatten().map(component).collect();
    let bill =
        json!({"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1, "components": components});
    Ok(fs::write(folder.join("cdpr.cdx.json"), format!("{bill:#}\n"))?)
}

/// The wheel, by maturin in an environment of its own: it serves all Pythons from 3.10 on.
fn wheel(folder: &Path) -> Outcome {
    let environment = root().join("target/dist-python");
    let program = |name: &str| {
        let place = if cfg!(windows) { "Scripts" } else { "bin" };
        Command::new(environment.join(place).join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
    };
    let python = if cfg!(windows) { "python" } else { "python3" };
    done(Command::new(python).args(["-m", "venv", "--clear"]).arg(&environment))?;
    done(program("python").args(["-m", "pip", "install", "--quiet", "maturin>=1.9.4,<2"]))?;
    let manifest = root().join("crates/cdpr-python/Cargo.toml");
    done(
        program("maturin")
            .args(["build", "--locked", "--manifest-path"])
            .arg(manifest)
            .arg("--out")
            .arg(folder),
    )
}

fn book(folder: &Path) -> Outcome {
    let book = folder.join("book");
    done(Command::new("mdbook").arg("build").arg(root().join("docs")).arg("--dest-dir").arg(&book))?;
    // The pages that docs/live.md leads to.
    let pages = book.join("explorer");
    fs::create_dir_all(&pages)?;
    for file in fs::read_dir(root().join("data/robots"))? {
        let path = file?.path();
        if let Some(name) = path.file_stem().filter(|_| path.extension().is_some_and(|end| end == "json")) {
            let page = pages.join(name).with_extension("html");
            done(cdpr_command(&["explore"]).arg(&path).arg("--out").arg(page))?;
        }
    }
    Ok(())
}

/// The checksums of all files beside them, as `sha256sum --check` reads them.
fn checksums(folder: &Path) -> Outcome {
    let mut names = Vec::new();
    for file in fs::read_dir(folder)? {
        let file = file?;
        if file.file_type()?.is_file() {
            names.push(file.file_name());
        }
    }
    names.sort();
    let (program, before): (_, &[&str]) =
        if cfg!(target_os = "macos") { ("shasum", &["-a", "256"]) } else { ("sha256sum", &[]) };
    let found = Command::new(program).args(before).args(names).current_dir(folder).output()?;
    if !found.status.success() {
        return Err(format!("`{program}`: {}", String::from_utf8_lossy(&found.stderr)).into());
    }
    Ok(fs::write(folder.join("SHA256SUMS"), found.stdout)?)
}
