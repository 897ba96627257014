//! `cargo xtask web`: the module and the page of `cdpr explore`, in `crates/cdpr-web/dist`.
//!
//! The products are kept in the tree, so that nobody needs their tools to build `cdpr`. `SOURCES` next to
//! them has the checksum of what they were made of; `cargo xtask web --check` says where it is another one by
//! now.
//!
//! It takes the target `wasm32-unknown-unknown` of the compiler, npm, xz, and wasm-bindgen in the version of
//! Cargo.lock, which is installed below `target`. The module uses the vector unit of WebAssembly.

use crate::cargo::{self, Outcome, cargo_command, done, files, printed, read, root, write};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// What the products are made of, in the workspace: sources and manifests of these crates, and other files.
const CRATES: [&str; 8] = ["number", "cable", "robot", "tension", "statics", "sensitivity", "study", "web"];
const FILES: [&str; 4] = ["crates/cdpr-web/page", "data/robots", "Cargo.toml", "Cargo.lock"];

/// Folders of the page that tools make.
const MADE: [&str; 2] = ["node_modules", "pkg"];

pub(crate) fn run(check: bool) -> Outcome {
    if check { check_sources() } else { make() }
}

fn make() -> Outcome {
    let (page, dist) = (web().join("page"), web().join("dist"));
    // Of the sources as they are now, whatever changes while they are compiled.
    let sources = checksum()?;
    has_target()?;
    let wasm_bindgen = wasm_bindgen()?;
    fs::create_dir_all(&dist)?;
    let target = root().join("target/web");
    let mut build = cargo_command(&["build", "--locked", "--package", "cdpr-web", "--profile", "web"]);
    build.args(["--target", TARGET, "--target-dir"]).arg(&target);
    done(build.env("RUSTFLAGS", "-C target-feature=+simd128"))?;
    let bound = page.join("pkg");
    let mut bind = Command::new(&wasm_bindgen);
    bind.args(["--target", "web", "--no-typescript", "--out-name", "cdpr_web", "--out-dir"]).arg(&bound);
    done(bind.arg(target.join(TARGET).join("web/cdpr_web.wasm")))?;
    eprintln!("page");
    done(Command::new("npm").args(["ci", "--no-audit", "--no-fund"]).current_dir(&page))?;
    done(Command::new("npm").args(["run", "build"]).current_dir(&page))?;
    pack(&bound.join("cdpr_web_bg.wasm"), &dist.join("cdpr_web.wasm.lzma"))?;
    let script = dist.join("explorer.js");
    pack(&script, &dist.join("explorer.js.lzma"))?;
    fs::remove_file(script)?;
    write(&dist.join("SOURCES"), &format!("{sources}\n"))?;
    for file in fs::read_dir(&dist)? {
        let file = file?;
        eprintln!("{:>9} bytes  {}", file.metadata()?.len(), file.file_name().display());
    }
    Ok(())
}

/// Packs a file by LZMA: a fifth smaller than by gzip. Neither code nor text has a period of bytes (pb = 0).
fn pack(file: &Path, packed: &Path) -> Outcome {
    let setting = "--lzma1=preset=9e,dict=4MiB,nice=273,pb=0";
    done(
        Command::new("xz")
            .args(["--format=lzma", setting, "--stdout"])
            .arg(file)
            .stdout(fs::File::create(packed)?),
    )
}

/// Says where the products are not those of the sources: a warning, because the models may agree
/// nevertheless.
fn check_sources() -> Outcome {
    if read(&web().join("dist/SOURCES"))?.trim() != checksum()? {
        eprintln!("warning: crates/cdpr-web/dist was made of other sources: run `cargo xtask web`");
    }
    Ok(())
}

fn web() -> PathBuf {
    root().join("crates/cdpr-web")
}

/// Finds the standard library of the target, or has rustup install it.
fn has_target() -> Outcome {
    if Path::new(&printed("rustc", &["--print", "target-libdir", "--target", TARGET])?).is_dir() {
        return Ok(());
    }
    eprintln!("installing the target {TARGET}");
    done(Command::new("rustup").args(["target", "add", TARGET])).map_err(|error| {
        format!("the compiler has no target {TARGET}: {error}; CONTRIBUTING.md says what else does it").into()
    })
}

/// wasm-bindgen in the version of Cargo.lock, below `target`.
fn wasm_bindgen() -> Outcome<PathBuf> {
    let lock = read(&root().join("Cargo.lock"))?;
    let entry = lock.split("name = \"wasm-bindgen\"\nversion = \"").nth(1);
    let version = entry.and_then(|rest| rest.split('"').next()).ok_or("Cargo.lock has no wasm-bindgen")?;
    let tools = root().join("target/web/tools");
    let program = tools.join("bin").join(format!("wasm-bindgen{}", std::env::consts::EXE_SUFFIX));
    if !printed(&program, &["--version"]).is_ok_and(|known| known.ends_with(version)) {
        // Without this workspace's manifest, to which the package does not belong.
        let mut install = Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()));
        install.args(["install", "wasm-bindgen-cli", "--version", version, "--force", "--root"]);
        done(install.arg(&tools))?;
    }
    Ok(program)
}

/// The checksum of the compiler's version and of all sources, with their names.
fn checksum() -> Outcome<String> {
    let mut all = Vec::new();
    let of_crate = |name: &str| ["src", "Cargo.toml"].map(|part| format!("crates/cdpr-{name}/{part}"));
    for source in CRATES.into_iter().flat_map(of_crate).chain(FILES.map(String::from)) {
        all.extend(files(&root().join(source), &MADE)?);
    }
    all.sort();
    let mut bytes = printed("rustc", &["--version"])?.into_bytes();
    for file in all {
        let name = file.strip_prefix(root())?.to_string_lossy().replace('\\', "/");
        let content = fs::read(&file)?;
        bytes.extend(format!("{name}\n{}\n", content.len()).into_bytes());
        bytes.extend(content);
    }
    Ok(cargo::checksum(&bytes))
}
