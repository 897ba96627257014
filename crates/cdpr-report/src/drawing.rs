//! What figures are drawn with: pens, headings, axes, grids of colours, planes of the workspace.

pub(crate) mod axis;
pub(crate) mod color_map;
pub(crate) mod heading;
pub(crate) mod name_map;
pub(crate) mod plane;
pub(crate) mod style;
