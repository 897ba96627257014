//! `cargo xtask c`: `libcdpr` installed into a folder, for programs in C, C++, MATLAB and Octave.

use crate::cargo::{Outcome, cargo_command, done, files, made, root, target, write};
use std::fs;
use std::path::Path;

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

/// Folders of `crates/cdpr-c` and where their files go.
const FOLDERS: [[&str; 2]; 4] = [
    ["include", "include"],
    ["matlab", "share/cdpr/matlab"],
    ["ros2", "share/cdpr/ros2"],
    ["examples", "share/cdpr/examples"],
];

pub(crate) fn run(prefix: &Path) -> Outcome {
    done(&mut cargo_command(&["build", "--release", "--locked", "--package", "cdpr-c"]))?;
    install(&target().join("release"), prefix)?;
    let prefix = prefix.display();
    eprintln!("installed: PKG_CONFIG_PATH is {prefix}/lib/pkgconfig, CMAKE_PREFIX_PATH {prefix}");
    Ok(())
}

fn install(built: &Path, prefix: &Path) -> Outcome {
    let shared = if cfg!(target_os = "macos") { "dylib" } else { "so" };
    for suffix in ["a", shared] {
        let name = format!("lib/libcdpr.{suffix}");
        copy(&built.join(format!("libcdpr_c.{suffix}")), &prefix.join(name))?;
    }
    for [from, to] in FOLDERS {
        let from = root().join("crates/cdpr-c").join(from);
        for file in files(&from, &[])? {
            copy(&file, &prefix.join(to).join(file.strip_prefix(&from)?))?;
        }
    }
    let version = env!("CARGO_PKG_VERSION");
    let package = format!(
        "prefix=${{pcfiledir}}/../..\nlibdir=${{prefix}}/lib\nincludedir=${{prefix}}/include\n\n\
         Name: cdpr\nDescription: Elasto-statics of cable-driven parallel robots\nVersion: {version}\n\
         Libs: -L${{libdir}} -lcdpr\nLibs.private: {SYSTEM}\nCflags: -I${{includedir}}\n"
    );
    write(&prefix.join("lib/pkgconfig/cdpr.pc"), &package)?;
    let config = CMAKE.replace("SHARED\"", &format!("{shared}\""));
    let config = config.replace("SYSTEM", &SYSTEM.replace(' ', ";"));
    write(&prefix.join("lib/cmake/cdpr/cdpr-config.cmake"), &config)
}

fn copy(from: &Path, to: &Path) -> Outcome {
    to.parent().map_or(Ok(()), made)?;
    let copied = fs::copy(from, to);
    copied.map_err(|error| format!("cannot copy {} to {}: {error}", from.display(), to.display()))?;
    Ok(())
}
