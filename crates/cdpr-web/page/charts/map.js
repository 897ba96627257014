// A slice of the workspace as a heat map: pixels for the 3D view, and SVG with axes.

import { digits } from "../format.js";
import { rangeOf, shownIn, SLICE_AXES } from "../slices.js";
import { css, magma, map, stops, tickLabel, ticks } from "./scale.js";
import { fix, path, rect, svg, text } from "./svg.js";

// Opacity, of 255, of positions with tensions out of their limits.
const PALE = 110;

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
        magma(share(value, range)).forEach((part, c) => {
          data[place + c] = 255 * part;
        });
        data[place + 3] = held[k] === 1 ? 255 : PALE;
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
export function heatMap(plane, cells, quantity, { width, here, title }, palette) {
  const frame = mapFrame(plane, width);
  const scales = mapScales(plane, frame);
  const range = rangeOf(cells, quantity.field);
  const parts = [
    ...rectangles(plane, cells, quantity.field, range, scales, palette),
    ...axes(plane, frame, scales, palette),
    ...(here ? cross(scales[0](here[0]), scales[1](here[1]), palette) : []),
    ...(range ? legend(frame, range, quantity, palette) : []),
  ];
  return svg(width, frame.bottom + 76, title, parts, palette);
}

/** Where the cells of a map of some width stand [px]. */
export function mapFrame({ u, v }, width) {
  const [left, right, top] = [44, width - 14, 20];
  const [du, dv] = [u[1] - u[0] || 1, v[1] - v[0] || 1];
  const height = Math.min(1.2 * (right - left), Math.max(60, ((right - left) * dv) / du));
  return { left, right, top, bottom: top + height };
}

/** Scales of a map: coordinates [m] to pixels, half a cell from the edges. */
export function mapScales({ u, v }, { left, right, top, bottom }) {
  const edge = ([min, max, count]) => (count > 1 ? (max - min) / (count - 1) / 2 : 0.5);
  return [
    map([u[0] - edge(u), u[1] + edge(u)], [left, right]),
    map([v[0] - edge(v), v[1] + edge(v)], [bottom, top]),
  ];
}

/** Column and row of a pixel of a map, or null outside. */
export function cellAt({ u, v }, width, [px, py]) {
  const { left, right, top, bottom } = mapFrame({ u, v }, width);
  const column = Math.floor(((px - left) / (right - left)) * u[2]);
  const row = Math.floor(((bottom - py) / (bottom - top)) * v[2]);
  return column >= 0 && column < u[2] && row >= 0 && row < v[2] ? [column, row] : null;
}

function rectangles({ u, v }, { held, values, columns }, field, range, [x, y], palette) {
  const [du, dv] = [u, v].map(([min, max, count]) => (max - min) / (count - 1));
  const [width, height] = [x(du) - x(0), y(0) - y(dv)];
  const list = [];
  for (let k = 0; k < held.length; k++) {
    if (held[k] === 0) continue;
    const value = values[field][k];
    const left = x(u[0] + (k % columns) * du) - width / 2;
    const top = y(v[0] + Math.floor(k / columns) * dv) - height / 2;
    const known = Number.isFinite(value);
    const color = known ? css(magma(share(value, range))) : palette.line;
    const opacity = known && held[k] === 1 ? "" : `fill-opacity="${(known ? PALE / 255 : 0.55).toFixed(2)}"`;
    list.push(rect(left, top, width + 0.4, height + 0.4, color, opacity));
  }
  return list;
}

function axes({ normal, u, v }, { left, right, top, bottom }, [x, y], palette) {
  const [first, second] = SLICE_AXES[normal];
  return [
    ...ticks(u[0], u[1], 5).map((tick) => text(x(tick), bottom + 15, tickLabel(tick), palette.soft)),
    ...ticks(v[0], v[1], 4).map((tick) => text(left - 5, y(tick) + 4, tickLabel(tick), palette.soft, "end")),
    text((left + right) / 2, bottom + 29, `${first} [m]`, palette.soft),
    text(4, top - 6, `${second} [m]`, palette.soft, "start"),
    rect(left, top, right - left, bottom - top, "none", `stroke="${palette.line}"`),
  ];
}

function cross(px, py, palette) {
  const d = `M${fix(px - 7)},${fix(py)} h14 m-7,-7 v14`;
  return [path(d, palette.paper, 'stroke-width="5"'), path(d, palette.ink, 'stroke-width="2"')];
}

function legend({ left, right, bottom }, [min, max], quantity, palette) {
  const { field, words } = quantity;
  const [factor, unit] = shownIn(quantity, [min, max]);
  const top = bottom + 40;
  const scale = isWide([min, max]) ? ", log. scale" : "";
  const colors = stops(magma).map(([t, color]) => `<stop offset="${t}" stop-color="${color}"/>`);
  return [
    `<defs><linearGradient id="cdprx-${field}">${colors.join("")}</linearGradient></defs>`,
    rect(left, top, right - left, 10, `url(#cdprx-${field})`),
    text(left, top + 24, digits(factor * min, 3), palette.soft, "start"),
    text(right, top + 24, digits(factor * max, 3), palette.soft, "end"),
    text((left + right) / 2, top + 24, `${words} [${unit}]${scale}`, palette.ink),
  ];
}

// Where a value is in a range, from 0 to 1.
function share(value, [min, max]) {
  if (isWide([min, max])) return Math.log(value / min) / Math.log(max / min);
  return max > min ? (value - min) / (max - min) : 0.5;
}

/** Whether a range has a logarithmic scale: those over about an order of magnitude. */
export function isWide([min, max]) {
  return min > 0 && max > 8 * min;
}
