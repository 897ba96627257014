// A slice of the workspace as a heat map: pixels for the 3D view, and SVG with axes.

import { digits } from "../format.js";
import { extent, SLICE_AXES } from "../slices.js";
import { fix, svg } from "./histogram.js";
import { css, magma, map, stops, ticks } from "./scale.js";

/**
 * The colours of the cells, a row of pixels for each row of cells, the last row first (as pictures have it).
 * @param {object} cells of `slices.emptyCells`
 * @param {string} field
 * @param {number[]|null} range
 * @returns {Uint8ClampedArray} red, green, blue, alpha
 */
export function pixels(cells, field, range) {
  const { columns, rows, held, values } = cells;
  const data = new Uint8ClampedArray(4 * columns * rows);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const k = row * columns + column;
      const place = 4 * ((rows - 1 - row) * columns + column);
      const value = values[field][k];
      if (Number.isFinite(value) && range) {
        magma(share(value, range)).forEach((part, c) => { data[place + c] = 255 * part; });
        data[place + 3] = 255;
      } else if (held[k] !== 0) {
        data.set((row + column) % 2 ? [150, 150, 150, 90] : [150, 150, 150, 50], place);
      }
    }
  }
  return data;
}

/**
 * @param {object} plane of `slices.plane`
 * @param {object} cells
 * @param {{field: string, words: string, unit: string}} quantity
 * @param {{width: number, here: number[]|null, title: string}} options `here`: position of the platform
 * @param {object} palette
 */
export function heatMap(plane, cells, { field, words, unit }, { width, here, title }, palette) {
  const { u, v } = plane;
  const [first, second] = SLICE_AXES[plane.normal];
  const range = extent(cells.values[field]);
  const frame = mapFrame(plane, width);
  const height = frame.bottom + 84;
  const [x, y] = mapScales(plane, frame);
  const [du, dv] = [u, v].map(([min, max, count]) => count > 1 ? (max - min) / (count - 1) : 1);
  const [cw, ch] = [Math.abs(x(du) - x(0)), Math.abs(y(dv) - y(0))];
  const rectangles = [];
  for (let k = 0; k < cells.held.length; k++) {
    if (cells.held[k] === 0) continue;
    const value = cells.values[field][k];
    const [px, py] = [x(u[0] + (k % cells.columns) * du), y(v[0] + Math.floor(k / cells.columns) * dv)];
    const known = Number.isFinite(value) && range;
    rectangles.push(`<rect x="${fix(px - cw / 2)}" y="${fix(py - ch / 2)}" width="${fix(cw + 0.4)}" height="${fix(ch + 0.4)}" `
      + `fill="${known ? css(magma(share(value, range))) : palette.line}"${known ? "" : ' fill-opacity="0.55"'}/>`);
  }
  const axes = [
    ...ticks(u[0], u[1], 5).map((tick) => `<text x="${fix(x(tick))}" y="${frame.bottom + 15}" text-anchor="middle" fill="${palette.soft}">${digits(tick, 3)}</text>`),
    ...ticks(v[0], v[1], 4).map((tick) => `<text x="${frame.left - 5}" y="${fix(y(tick) + 4)}" text-anchor="end" fill="${palette.soft}">${digits(tick, 3)}</text>`),
    `<text x="${(frame.left + frame.right) / 2}" y="${frame.bottom + 31}" text-anchor="middle" fill="${palette.soft}">${first} [m]</text>`,
    `<text x="10" y="${frame.top - 6}" fill="${palette.soft}">${second} [m]</text>`,
    `<rect x="${frame.left}" y="${frame.top}" width="${frame.right - frame.left}" height="${frame.bottom - frame.top}" fill="none" stroke="${palette.line}"/>`,
  ];
  const mark = here ? [`<path d="M${fix(x(here[0]) - 7)},${fix(y(here[1]))} h14 m-7,-7 v14" stroke="${palette.background ?? palette.paper}" stroke-width="4"/>`
    + `<path d="M${fix(x(here[0]) - 7)},${fix(y(here[1]))} h14 m-7,-7 v14" stroke="${palette.ink}" stroke-width="2"/>`] : [];
  return svg(width, height, title, [...rectangles, ...axes, ...mark, ...legend()], palette);

  function legend() {
    if (!range) return [];
    const top = frame.bottom + 44;
    const id = `magma-${field}`;
    return [
      `<defs><linearGradient id="${id}">${stops(magma).map(([t, color]) => `<stop offset="${t}" stop-color="${color}"/>`).join("")}</linearGradient></defs>`,
      `<rect x="${frame.left}" y="${top}" width="${frame.right - frame.left}" height="10" fill="url(#${id})"/>`,
      `<text x="${frame.left}" y="${top + 25}" fill="${palette.soft}">${digits(range[0], 3)}</text>`,
      `<text x="${frame.right}" y="${top + 25}" text-anchor="end" fill="${palette.soft}">${digits(range[1], 3)}</text>`,
      `<text x="${(frame.left + frame.right) / 2}" y="${top + 25}" text-anchor="middle" fill="${palette.ink}">${words} [${unit}]</text>`,
    ];
  }
}

/** Where the cells of a map of some width stand [px]. */
export function mapFrame({ u, v }, width) {
  const [left, right, top] = [44, width - 14, 20];
  const [du, dv] = [u[1] - u[0] || 1, v[1] - v[0] || 1];
  const height = Math.min(1.2 * (right - left), Math.max(60, (right - left) * dv / du));
  return { left, right, top, bottom: top + height };
}

/** Scales of a map: coordinates [m] to pixels, half a cell from the edges. */
export function mapScales({ u, v }, { left, right, top, bottom }) {
  const edge = ([min, max, count]) => count > 1 ? (max - min) / (count - 1) / 2 : 0.5;
  return [map([u[0] - edge(u), u[1] + edge(u)], [left, right]), map([v[0] - edge(v), v[1] + edge(v)], [bottom, top])];
}

/** Column and row of a pixel of a map, or null outside. */
export function cellAt({ u, v }, width, [px, py]) {
  const { left, right, top, bottom } = mapFrame({ u, v }, width);
  const column = Math.floor((px - left) / (right - left) * u[2]);
  const row = Math.floor((bottom - py) / (bottom - top) * v[2]);
  return column >= 0 && column < u[2] && row >= 0 && row < v[2] ? [column, row] : null;
}

function share(value, [min, max]) {
  return max > min ? (value - min) / (max - min) : 0.5;
}
