//! `cargo xtask c`: `libcdpr` installed into a folder, for programs in C, C++, MATLAB and Octave.

use crate::cargo::{cargo, root, write};
use std::path::{Path, PathBuf};

/// What the static library needs of the system.
const SYSTEM: &str = if cfg!(target_os = "macos") { "-liconv -lm" } else { "-lpthread -ldl -lm" };

const CMAKE: &str = "# cdpr::cdpr is the shared library, cdpr::static the static one.
get_filename_component(_cdpr \"${CMAKE_CURRENT_LIST_DIR}/../../..\" ABSOLUTE)
add_library(cdpr::cdpr SHARED IMPORTED)
set_target_properties(cdpr::cdpr PROPERTIES IMPORTED_NO_SONAME TRUE
    IMPORTED_LOCATION \"${_cdpr}/lib/libcdpr.SHARED\" INTERFACE_INCLUDE_DIRECTORIES \"${_cdpr}/include\")
add_library(cdpr::static STATIC IMPORTED)
set_target_properties(cdpr::static PROPERTIES INTERFACE_LINK_LIBRARIES \"SYSTEM\"
    IMPORTED_LOCATION \"${_cdpr}/lib/libcdpr.a\" INTERFACE_INCLUDE_DIRECTORIES \"${_cdpr}/include\")
";

/// Sources for MATLAB, Octave and Simulink.
const MATLAB: [&str; 7] = [
    "+cdpr/Robot.m",
    "+cdpr/Tracker.m",
    "cdpr_compare.m",
    "cdpr_example.m",
    "cdpr_mex.c",
    "cdpr_sfun.c",
    "cdpr_study.m",
];

/// Sources of the package for ROS 2.
const ROS: [&str; 5] = [
    "cdpr_ros/CMakeLists.txt",
    "cdpr_ros/include/cdpr_ros/logic.hpp",
    "cdpr_ros/launch/cdpr.launch.py",
    "cdpr_ros/package.xml",
    "cdpr_ros/src/node.cpp",
];

pub(crate) fn run(rest: &[String]) -> Result<(), String> {
    let [option, prefix] = rest else { return Err("expected `cargo xtask c --prefix FOLDER`".to_owned()) };
    if option != "--prefix" {
        return Err(format!("expected `--prefix FOLDER`, not `{option}`"));
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    cargo(&["build", "--release", "--locked", "--package", "cdpr-c"])?;
    install(&target.join("release"), Path::new(prefix))?;
    eprintln!("installed: PKG_CONFIG_PATH is {prefix}/lib/pkgconfig, CMAKE_PREFIX_PATH {prefix}");
    Ok(())
}

fn install(built: &Path, prefix: &Path) -> Result<(), String> {
    let shared = if cfg!(target_os = "macos") { "dylib" } else { "so" };
    let sources = root().join("crates/cdpr-c");
    copy(&sources.join("include/cdpr.h"), &prefix.join("include/cdpr.h"))?;
    copy(&built.join("libcdpr_c.a"), &prefix.join("lib/libcdpr.a"))?;
    copy(&built.join(format!("libcdpr_c.{shared}")), &prefix.join(format!("lib/libcdpr.{shared}")))?;
    for file in MATLAB {
        copy(&sources.join("matlab").join(file), &prefix.join("share/cdpr/matlab").join(file))?;
    }
    for file in ROS {
        copy(&sources.join("ros2").join(file), &prefix.join("share/cdpr/ros2").join(file))?;
    }
    for name in ["control_loop.c", "load_observer.c"] {
        copy(&sources.join("examples").join(name), &prefix.join("share/cdpr/examples").join(name))?;
    }
    let version = env!("CARGO_PKG_VERSION");
    let package = format!(
        "prefix=${{pcfiledir}}/../..\nlibdir=${{prefix}}/lib\nincludedir=${{prefix}}/include\n\n\
         Name: cdpr\nDescription: Elasto-statics of cable-driven parallel robots\nVersion: {version}\n\
         Libs: -L${{libdir}} -lcdpr\nLibs.private: {SYSTEM}\nCflags: -I${{includedir}}\n"
    );
    place(&prefix.join("lib/pkgconfig/cdpr.pc"), &package)?;
    let config = CMAKE.replace("SHARED\"", &format!("{shared}\""));
    let config = config.replace("SYSTEM", &SYSTEM.replace(' ', ";"));
    place(&prefix.join("lib/cmake/cdpr/cdpr-config.cmake"), &config)
}

fn made(folder: Option<&Path>) -> Result<(), String> {
    let Some(folder) = folder else { return Ok(()) };
    std::fs::create_dir_all(folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    made(to.parent())?;
    let copied = std::fs::copy(from, to).map(|_| ());
    copied.map_err(|error| format!("cannot copy {} to {}: {error}", from.display(), to.display()))
}

fn place(path: &Path, text: &str) -> Result<(), String> {
    made(path.parent())?;
    write(path, text)
}
