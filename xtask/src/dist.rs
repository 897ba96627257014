//! `cargo xtask dist`: what a release consists of, in `target/dist`.
//!
//! The program, a wheel for all Pythons from 3.10 on, the packed crates, the list of all crates that they
//! consist of (SBOM), the book, the notes of the version from CHANGELOG.md, and the checksums of all files. A
//! part whose tool is not installed is left out, and the last lines say so.

use crate::cargo::{
    Outcome, cargo_command, cdpr_command, checksum, done, emptied, files, made, printed, read, root, target,
    text, text_of, write,
};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Makes one part in a folder.
type Part = fn(&Path) -> Outcome;

pub(crate) fn run() -> Outcome {
    let folder = root().join("target/dist");
    let parts: [(&str, Part); 7] = [
        ("program", program),
        ("notes", notes),
        ("crates", crates),
        ("bill of materials", materials),
        ("wheel", wheel),
        ("book", book),
        ("checksums", checksums),
    ];
    emptied(&folder)?;
    let mut left_out = Vec::new();
    for (name, make) in parts {
        eprintln!("{name}");
        left_out.extend(make(&folder).err().map(|error| format!("{name}: {error}")));
    }
    eprintln!("\n{} holds what could be made", folder.display());
    if left_out.is_empty() { Ok(()) } else { Err(format!("left out:\n{}", left_out.join("\n")).into()) }
}

/// The program, on Linux with everything linked in, so that it runs on any.
fn program(folder: &Path) -> Outcome {
    let host = printed("rustc", &["--print", "host-tuple"])?;
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
    let built = target().join(&host).join("release").join(format!("cdpr{suffix}"));
    fs::copy(built, folder.join(format!("cdpr-{host}{suffix}")))?;
    Ok(())
}

/// The first section of the changelog.
fn notes(folder: &Path) -> Outcome {
    let text = read(&root().join("CHANGELOG.md"))?;
    let section = text.split("\n## ").nth(1).ok_or("CHANGELOG.md has no section")?;
    write(&folder.join("NOTES.md"), &format!("## {}\n", section.trim_end()))
}

/// The crates as a registry takes them. They name each other by versions, so none is built here.
fn crates(folder: &Path) -> Outcome {
    let into = folder.join("crates");
    let mut package = cargo_command(&["package", "--workspace", "--locked", "--no-verify", "--allow-dirty"]);
    // What is not published.
    package.args(
        ["xtask", "cdpr-tests", "cdpr-fuzz", "cdpr-python", "cdpr-evidence"]
            .map(|name| format!("--exclude={name}")),
    );
    // A folder without packages of other versions.
    done(package.arg("--target-dir").arg(&into))?;
    for entry in fs::read_dir(into.join("package"))? {
        let packed = entry?.path();
        if packed.extension().is_some_and(|end| end == "crate") {
            fs::rename(&packed, folder.join(packed.file_name().unwrap_or_default()))?;
        }
    }
    Ok(fs::remove_dir_all(into)?)
}

/// All crates of the lock file with their licenses, as a software bill of materials (CycloneDX 1.5).
fn materials(folder: &Path) -> Outcome {
    let metadata = ["metadata", "--locked", "--all-features", "--format-version", "1"];
    let metadata: Value = serde_json::from_str(&text_of(&mut cargo_command(&metadata), &[0])?)?;
    let component = |of: &Value| {
        let (name, version) = (text(&of["name"]), text(&of["version"]));
        // Manifests of old crates have a slash for OR.
        let license = text(&of["license"]).replace('/', " OR ");
        json!({
            "type": "library",
            "name": name,
            "version": version,
            "purl": format!("pkg:cargo/{name}@{version}"),
            "licenses": [{ "expression": license }],
        })
    };
    let components: Vec<Value> =
        metadata["packages"].as_array().into_iter().flatten().map(component).collect();
    let bill =
        json!({"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1, "components": components});
    write(&folder.join("cdpr.cdx.json"), &format!("{bill:#}\n"))
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
    let mut build = program("maturin");
    build.args(["build", "--locked", "--manifest-path"]).arg(manifest);
    done(build.arg("--out").arg(folder))
}

fn book(folder: &Path) -> Outcome {
    let book = folder.join("book");
    done(Command::new("mdbook").arg("build").arg(root().join("docs")).arg("--dest-dir").arg(&book))?;
    // The pages that docs/live.md leads to.
    made(&book.join("explorer"))?;
    for robot in files(&root().join("data/robots"), &[])? {
        if let Some(name) = robot.file_stem().filter(|_| robot.extension().is_some_and(|end| end == "json")) {
            let page = book.join("explorer").join(name).with_extension("html");
            done(cdpr_command(&["explore"]).arg(&robot).arg("--out").arg(page))?;
        }
    }
    Ok(())
}

/// The checksums of all files next to them, as `sha256sum --check` reads them.
fn checksums(folder: &Path) -> Outcome {
    let mut sums = String::new();
    for file in files(folder, &["book"])? {
        let name = file.strip_prefix(folder)?.display();
        sums += &format!("{}  {name}\n", checksum(&fs::read(&file)?));
    }
    write(&folder.join("SHA256SUMS"), &sums)
}
