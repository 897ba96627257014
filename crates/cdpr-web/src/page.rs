//! The products of `cargo xtask web`: what a page needs besides a robot.

/// The module, packed by gzip. It uses the vector unit of WebAssembly, which every browser has that can
/// unpack it.
pub const MODULE: &[u8] = include_bytes!("../dist/cdpr_web.wasm.gz");

/// The script of the page, which defines `cdprExplorer`, packed by gzip.
pub const SCRIPT: &[u8] = include_bytes!("../dist/explorer.js.gz");

/// The script of the workers that compute.
pub const WORKER: &str = include_str!("../dist/worker.js");

/// The style of the page.
pub const STYLE: &str = include_str!("../dist/explorer.css");
