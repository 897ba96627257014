// Poses of a table as people have it: the columns that `--poses` of the program takes, and a time.

import { angles, fromVector } from "../rotation.js";

/** Most poses of a trajectory. */
export const MOST = 20000;

const POSITION = ["x", "y", "z"];
const QUATERNION = ["qw", "qx", "qy", "qz"];
const ANGLES = ["roll", "pitch", "yaw"];
// A rotation vector. Where there is a quaternion, too, that one counts: in a series of `cdpr simulate` the vector
// is that from the rest.
const VECTOR = ["rx", "ry", "rz"];
const EXPECTED =
  "expected x_m,y_m,z_m, then none, qw,qx,qy,qz, roll_deg,pitch_deg,yaw_deg or rx_rad,ry_rad,rz_rad, " +
  "and perhaps t_s";

// The tension of a cable at the platform in a series of `cdpr simulate` [N].
const TENSION = /^t_anchor_(\d+)_n$/i;

// What a unit is in those of the page: metres, degrees, seconds.
const LENGTHS = { m: 1, cm: 1e-2, mm: 1e-3, um: 1e-6, µm: 1e-6, km: 1e3 };
const TURNS = { deg: 1, "°": 1, rad: 180 / Math.PI, mrad: 0.18 / Math.PI };
const RADIANS = { rad: 1, mrad: 1e-3, deg: Math.PI / 180, "°": Math.PI / 180 };
const TIMES = { s: 1, ms: 1e-3, min: 60 };

/**
 * The rows of a trajectory.
 * @param {string} text a table, with commas, semicolons, tabs or blanks between its cells
 * @returns {{rows: number[][], hasTime: boolean, cables: number, further: string[]}|{problem: string}} rows of
 *   t [s], x, y, z [m], roll, pitch, yaw [degrees], and the tensions in motion [N] of `cables` cables, 0 without
 *   times or tensions; without times, t is zero; names of columns that are not read
 */
export function readPoses(text) {
  try {
    return read(text);
  } catch (error) {
    if (error instanceof Refusal) return { problem: error.message };
    throw error;
  }
}

class Refusal extends Error {}

function read(text) {
  const lines = text
    .replace(/^\uFEFF/, "")
    .split(/\r\n?|\n/)
    .map((line, k) => ({ line, number: k + 1 }))
    .filter(({ line }) => line.trim() !== "" && !line.startsWith("#"));
  const given = lines[0]?.line.match(/^sep=(.)\s*$/i)?.[1];
  if (given) lines.shift();
  if (lines.length === 0) throw new Refusal(`The table is empty: ${EXPECTED}.`);
  const split = splitter(given ?? separator(lines.map(({ line }) => line)));
  const first = split(lines[0].line);
  const isNamed = first.some((cell) => Number.isNaN(numeral(cell)));
  const columns = isNamed ? named(first, lines[0].number) : plain(first, lines[0].number);
  const body = isNamed ? lines.slice(1) : lines;
  if (body.length > MOST) throw new Refusal(`The table has ${body.length} poses: ${MOST} at most.`);
  if (body.length === 0) throw new Refusal("The table has names, but no poses.");
  checkMarks(body.flatMap(({ line, number }) => split(line).map((cell) => ({ cell, number }))));
  const rows = body.map(({ line, number }) => row(split(line), columns, number));
  rows.forEach(([time], k) => {
    if (k > 0 && time < rows[k - 1][0])
      throw new Refusal(`Line ${body[k].number}: the time ${time} s is before that of the line above.`);
  });
  const cables = columns.get("tensions")?.length ?? 0;
  return { rows, hasTime: columns.has("t"), cables, further: columns.get("further") ?? [] };
}

// The character that separates cells: the first of these that all lines have.
function separator(lines) {
  return [";", "\t", ","].find((mark) => lines.every((line) => line.includes(mark))) ?? " ";
}

function splitter(mark) {
  if (mark === " ") return (line) => line.trim().split(/\s+/);
  return (line) => line.split(mark).map((cell) => cell.trim().replace(/^"(.*)"$/, "$1"));
}

function numeral(cell) {
  return /^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i.test(cell) ? Number(cell.replace(",", ".")) : NaN;
}

// Refuses numbers that can be read in two ways.
function checkMarks(cells) {
  const commas = cells.filter(({ cell }) => cell.includes(",") && !Number.isNaN(numeral(cell)));
  if (commas.length === 0) return;
  const [{ cell, number }] = commas;
  const point = cells.find((one) => one.cell.includes(".") && !Number.isNaN(numeral(one.cell)));
  if (point)
    throw new Refusal(`Line ${point.number}: ${point.cell} has a decimal point, ${cell} a decimal comma.`);
  if (commas.every((one) => /^[+-]?\d{1,3},\d{3}$/.test(one.cell)))
    throw new Refusal(
      `Line ${number}: ${cell} can be read in two ways: write ${cell.replace(",", ".")} or more digits.`,
    );
}

// Columns by quantity: their index, and the factor to the units of the page.
function named(names, line) {
  const columns = new Map();
  const further = [];
  names.forEach((name, index) => {
    const [, word, unit] = name.toLowerCase().match(/^([a-z]+)(?:\s*[_[(]\s*([a-zµ°]+)\s*[\])]?)?$/) ?? [];
    const quantity = word === "time" ? "t" : word;
    const [units, usual] = unitsOf(quantity);
    const factor = units?.[unit ?? usual];
    if (units && factor === undefined) {
      const reason = unit ? "an unknown unit" : `no unit: expected ${name}_deg or ${name}_rad`;
      throw new Refusal(`Line ${line}: column ${name} has ${reason}.`);
    }
    if (!units) further.push(name);
    else if (columns.has(quantity)) throw new Refusal(`Line ${line}: there are two columns ${quantity}.`);
    else columns.set(quantity, { index, factor, name });
  });
  const has = (list) => list.filter((name) => columns.has(name)).length;
  const isWhole =
    has(POSITION) === 3 &&
    [0, 4].includes(has(QUATERNION)) &&
    [0, 3].includes(has(VECTOR)) &&
    (has(QUATERNION) + has(VECTOR)) * has(ANGLES) === 0;
  if (!isWhole) throw new Refusal(`Line ${line}: the columns are ${names.join(", ")}: ${EXPECTED}.`);
  const tensions = tensionsOf(names, columns.has("t"));
  columns.set("tensions", tensions);
  const read = tensions.map((index) => names[index]);
  columns.set(
    "further",
    further.filter((name) => !read.includes(name)),
  );
  return columns;
}

// The columns of the tensions of all cables, in their order; none where one is missing.
function tensionsOf(names, hasTime) {
  const indices = [];
  names.forEach((name, index) => {
    const number = name.match(TENSION)?.[1];
    if (hasTime && number > 0) indices[number - 1] = index;
  });
  return indices.includes(undefined) ? [] : indices;
}

function unitsOf(quantity) {
  if (POSITION.includes(quantity)) return [LENGTHS, "m"];
  if (QUATERNION.includes(quantity)) return [{ "": 1 }, ""];
  if (ANGLES.includes(quantity)) return [TURNS, undefined];
  if (VECTOR.includes(quantity)) return [RADIANS, undefined];
  return quantity === "t" ? [TIMES, "s"] : [];
}

function plain(cells, line) {
  if (![3, 7].includes(cells.length))
    throw new Refusal(`Line ${line}: ${cells.length} numbers without names: ${EXPECTED}.`);
  return new Map(
    [...POSITION, ...QUATERNION].slice(0, cells.length).map((name, index) => [name, { index, factor: 1 }]),
  );
}

function row(cells, columns, line) {
  const numberAt = (index, name) => {
    const cell = cells[index] ?? "";
    const number = numeral(cell);
    if (!Number.isFinite(number))
      throw new Refusal(`Line ${line}: ${name} is “${cell}”, which is not a number.`);
    return number;
  };
  const value = (name) => {
    const column = columns.get(name);
    return column ? numberAt(column.index, name) * column.factor : 0;
  };
  let turn = columns.has("rx") ? angles(fromVector(VECTOR.map(value))) : ANGLES.map(value);
  if (columns.has("qw")) {
    const quaternion = QUATERNION.map(value);
    const size = Math.hypot(...quaternion);
    if (Math.abs(size - 1) > 1e-3)
      throw new Refusal(
        `Line ${line}: the quaternion has the length ${Number(size.toPrecision(4))}: expected 1.`,
      );
    turn = angles(quaternion.map((part) => part / size));
  }
  const tensions = (columns.get("tensions") ?? []).map((index, k) => numberAt(index, `tension ${k + 1}`));
  return [value("t"), ...POSITION.map(value), ...turn, ...tensions];
}
