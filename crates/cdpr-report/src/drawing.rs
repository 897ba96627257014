//! Tools for drawing figures: pens, headings, axes, maps in colour, planes of the workspace.

pub(crate) mod axis;
pub(crate) mod color_map;
pub(crate) mod compact;
pub(crate) mod decades;
pub(crate) mod heading;
pub(crate) mod name_map;
pub(crate) mod plane;
pub(crate) mod sheet;
pub(crate) mod style;
