// Slices of the workspace: their planes, their rows, and the quantities that are shown.

import { lengthUnit } from "./format.js";

/** The two axes in the plane across each axis. */
export const SLICE_AXES = { x: ["y", "z"], y: ["x", "z"], z: ["x", "y"] };

/** Quantities of a slice: field of the answer, words, unit. */
export const QUANTITIES = [
  ["deflection_mm", "deflection", "mm"],
  ["least_stiffness", "least stiffness", "N/m"],
  ["tension_min", "least tension", "N"],
  ["tension_max", "greatest tension", "N"],
];

const INDEX = { x: 0, y: 1, z: 2 };

/**
 * The plane of a slice over the frame of the exit points, as the engine wants it.
 * @param {{normal: string, at: number, cells: number}} slice `cells` along the longer side
 * @param {number[][]} exits
 * @param {number} floor height of the floor [m]
 */
export function plane({ normal, at, cells }, exits, floor) {
  const ranges = SLICE_AXES[normal].map((axis) => {
    const values = exits.map((exit) => exit[INDEX[axis]]);
    if (axis === "z") values.push(floor);
    return [Math.min(...values), Math.max(...values)];
  });
  const longest = Math.max(...ranges.map(([min, max]) => max - min), 1e-9);
  const [u, v] = ranges.map(([min, max]) => {
    const count = Math.max(2, Math.round(((max - min) / longest) * (cells - 1)) + 1);
    return max - min < 1e-9 * longest ? [tidy(min), tidy(min), 1] : [tidy(min), tidy(max), count];
  });
  return { normal, at: tidy(at), u, v };
}

/** The least and greatest coordinate of a slice along its normal. */
export function reach(normal, exits, floor) {
  const values = exits.map((exit) => exit[INDEX[normal]]);
  if (normal === "z") values.push(floor);
  return [Math.min(...values), Math.max(...values)];
}

/** An empty picture of a plane, with a cell for each position; `state` is 0 unknown, 1 held, 2 not held. */
export function emptyCells({ u: [, , columns], v: [, , rows] }) {
  const values = Object.fromEntries(
    QUANTITIES.map(([field]) => [field, new Float64Array(columns * rows).fill(NaN)]),
  );
  return { columns, rows, held: new Uint8Array(columns * rows), values, reasons: {}, done: 0 };
}

/** Puts the answer for the rows from `first` on into the cells. */
export function fill(cells, first, answer) {
  const offset = first * cells.columns;
  answer.held.forEach((held, k) => {
    cells.held[offset + k] = held ? 1 : 2;
  });
  for (const [field] of QUANTITIES) {
    answer[field].forEach((value, k) => {
      cells.values[field][offset + k] = value ?? NaN;
    });
  }
  for (const [kind, count] of Object.entries(answer.reasons ?? {})) {
    cells.reasons[kind] = (cells.reasons[kind] ?? 0) + count;
  }
  cells.done += answer.held.length;
}

/** The order in which rows are asked for: those far apart first, so that the picture fills in everywhere. */
export function rowOrder(rows) {
  const order = [];
  const seen = new Set();
  for (let step = 2 ** Math.ceil(Math.log2(Math.max(rows, 1))); step >= 1; step /= 2) {
    for (let row = 0; row < rows; row += step) {
      if (!seen.has(row)) order.push(row);
      seen.add(row);
    }
  }
  return order;
}

/** The base-frame position of the cell in a column and row. */
export function positionOf({ normal, at, u, v }, column, row) {
  const place = ([min, max, count], k) => (count > 1 ? tidy(min + ((max - min) * k) / (count - 1)) : min);
  const position = [0, 0, 0];
  position[INDEX[normal]] = at;
  position[INDEX[SLICE_AXES[normal][0]]] = place(u, column);
  position[INDEX[SLICE_AXES[normal][1]]] = place(v, row);
  return position;
}

/**
 * The least and greatest value of a quantity at the positions that are held or, where none is, at those with
 * tensions out of their limits; null without any.
 */
export function rangeOf(cells, field) {
  const list = known(cells, field);
  if (list.length === 0) return null;
  const values = list.map((k) => cells.values[field][k]);
  return [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
}

/**
 * How a quantity of a slice with this range is shown: the factor of its values, and the unit. Deflections
 * have the unit that the greatest of them asks for.
 */
export function shownIn({ field, unit }, range) {
  if (field !== "deflection_mm" || range === null) return [1, unit];
  const [factor, name] = lengthUnit(range[1] / 1e3);
  return [factor / 1e3, name];
}

/** Column and row of the greatest (`sign` 1) or least (-1) of these values, or null. */
export function extreme(cells, field, sign) {
  const list = known(cells, field);
  if (list.length === 0) return null;
  const value = (k) => sign * cells.values[field][k];
  const best = list.reduce((a, b) => (value(b) > value(a) ? b : a));
  return [best % cells.columns, Math.floor(best / cells.columns)];
}

function known({ held, values }, field) {
  const list = Array.from(held.keys()).filter((k) => Number.isFinite(values[field][k]));
  const within = list.filter((k) => held[k] === 1);
  return within.length > 0 ? within : list;
}

function tidy(value) {
  return Number(value.toPrecision(10));
}
