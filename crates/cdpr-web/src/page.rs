//! The products of `cargo xtask web`: what a page needs besides a robot.

/// The module, packed by LZMA. It uses the vector unit of WebAssembly, which browsers have since 2023.
pub const MODULE: &[u8] = include_bytes!("../dist/cdpr_web.wasm.lzma");

/// The script of the page, which defines `cdprExplorer`, packed by LZMA.
pub const SCRIPT: &[u8] = include_bytes!("../dist/explorer.js.lzma");

/// The script of the workers that compute.
pub const WORKER: &str = include_str!("../dist/worker.js");

/// The style of the page.
pub const STYLE: &str = include_str!("../dist/explorer.css");
