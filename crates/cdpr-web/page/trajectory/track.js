// A trajectory: rows of t [s], x, y, z [m], roll, pitch, yaw [degrees], with straight ways between them. A series
// of a motion has the tensions of all cables [N] behind these.

import { angles, quaternion, rounded, vectorBetween } from "../rotation.js";

// Number of poses at which tensions are asked for: about FEW where there are few rows, and at most MANY.
const FEW = 120;
const MANY = 2000;
// Numbers of a row before its tensions.
const POSE = 7;

/** The last time [s]. */
export const duration = (rows) => rows.at(-1)[0];

/**
 * Rows with times at which the platform goes at a speed.
 * @param {number[][]} rows
 * @param {number} speed [m/s]
 * @param {number} arm length that a turn of a radian counts as [m]
 */
export function timed(rows, speed, arm) {
  let time = 0;
  return rows.map((row, k) => {
    if (k > 0) time += way(rows[k - 1], row, arm) / speed;
    return [rounded(time, 4), ...row.slice(1)];
  });
}

function way(a, b, arm) {
  const step = Math.hypot(...[1, 2, 3].map((k) => b[k] - a[k]));
  const turn = Math.hypot(...vectorBetween(quaternion(a.slice(4, POSE)), quaternion(b.slice(4, POSE))));
  return Math.max(step, arm * turn);
}

/** The times of the poses of which tensions are shown, and every how many rows, if there are too many. */
export function sampleTimes(rows) {
  const every = Math.ceil(rows.length / MANY);
  if (every > 1) return { times: rows.filter((_, k) => k % every === 0).map(([t]) => t), every };
  const span = duration(rows) - rows[0][0];
  const times = rows.flatMap(([t], k) => {
    if (k === 0) return [t];
    const before = rows[k - 1][0];
    const parts = Math.max(1, Math.round((FEW * (t - before)) / (span || 1)));
    return Array.from({ length: parts }, (_, j) => before + ((t - before) * (j + 1)) / parts);
  });
  return { times, every };
}

// Where a time is: the rows around it, and its share of the way between them.
function between(rows, time) {
  const next = Math.max(1, Math.min(rows.length - 1, rows.findIndex(([t]) => t > time) >>> 0));
  const [a, b] = [rows[next - 1], rows[next] ?? rows[0]];
  const share = b[0] > a[0] ? Math.min(1, Math.max(0, (time - a[0]) / (b[0] - a[0]))) : 1;
  return { a, b, share, mixed: (k) => a[k] + share * (b[k] - a[k]) };
}

/** The number of cables whose tensions in motion the rows have. */
export const cablesInMotion = (rows) => (rows[0]?.length ?? POSE) - POSE;

/** Rows without tensions. */
export const withoutTensions = (rows) => rows.map((row) => row.slice(0, POSE));

/** The tensions in motion at a time [N]; none where the rows have none. */
export function tensionsAt(rows, time) {
  const count = cablesInMotion(rows);
  if (count === 0) return [];
  const { mixed } = between(rows, time);
  return Array.from({ length: count }, (_, k) => mixed(POSE + k));
}

/** The rows of which tensions in motion are drawn: of very many, those with the extreme tensions of each part. */
export function drawnRows(rows) {
  const stretch = 2 * Math.ceil(rows.length / MANY);
  if (stretch <= 2) return rows;
  const drawn = [];
  for (let first = 0; first < rows.length; first += stretch) {
    const part = rows.slice(first, first + stretch);
    const extreme = (of, better) =>
      part.reduce((best, row) => (better(of(...row.slice(POSE)), of(...best.slice(POSE))) ? row : best));
    const [least, greatest] = [extreme(Math.min, (a, b) => a < b), extreme(Math.max, (a, b) => a > b)];
    drawn.push(...part.filter((row) => row === least || row === greatest));
  }
  return drawn;
}

/** Position [m] and angles [degrees] at a time. */
export function poseAt(rows, time) {
  const { a, b, share, mixed } = between(rows, time);
  return {
    position: [1, 2, 3].map((k) => rounded(mixed(k), 6)),
    rpy_deg: turnedBy(a.slice(4, POSE), b.slice(4, POSE), share).map((angle) => rounded(angle, 5)),
  };
}

// A share of the shortest turn from one rotation to another.
function turnedBy(a, b, share) {
  const [p, q] = [quaternion(a), quaternion(b)];
  const dot = p.reduce((sum, value, k) => sum + value * q[k], 0);
  const angle = Math.acos(Math.min(1, Math.abs(dot)));
  if (angle < 1e-9) return share < 0.5 ? a : b;
  const [u, v] = [Math.sin((1 - share) * angle), Math.sign(dot) * Math.sin(share * angle)];
  const sum = p.map((value, k) => u * value + v * q[k]);
  const size = Math.hypot(...sum);
  return angles(sum.map((value) => value / size));
}

/** Whether a value is a list of rows whose times do not go back. */
export function areRows(value) {
  const isRow = (row) =>
    Array.isArray(row) && row.length >= POSE && row.length === value[0].length && row.every(Number.isFinite);
  return (
    Array.isArray(value) && value.every((row, k) => isRow(row) && (k === 0 || row[0] >= value[k - 1][0]))
  );
}
