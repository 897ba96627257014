// Colours of view and charts, for light and dark screens and for files. Hues are those of Okabe and Ito.

export const LIGHT = {
  dark: false,
  background: null,
  paper: "#ffffff",
  ink: "#1b1f24",
  soft: "#59636e",
  line: "#d8dee4",
  bar: "#0072b2",
  minus: "#c04f00",
  accent: "#009e73",
  sky: "#eef2f5",
  frame: "#8793a0",
  grid: "#cfd6dd",
  body: "#7fb2d9",
  ghost: "#59636e",
  warn: "#c43c00",
  arrow: "#c04f00",
  force: "#7a3f8f",
  casing: "#1b1f24",
  slack: "#8793a0",
};

export const DARK = {
  dark: true,
  background: null,
  paper: "#14181d",
  ink: "#e4e8ec",
  soft: "#9aa5b1",
  line: "#333b44",
  bar: "#56b4e9",
  minus: "#f0924a",
  accent: "#2fc79a",
  sky: "#0f1317",
  frame: "#66727f",
  grid: "#262d35",
  body: "#3f7fae",
  ghost: "#9aa5b1",
  warn: "#ff8a50",
  arrow: "#f0924a",
  force: "#d08fe0",
  casing: "#e4e8ec",
  slack: "#7b8794",
};

/** The colours of exported charts: those of paper, on white. */
export const PAPER = { ...LIGHT, background: "#ffffff" };
