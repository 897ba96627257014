// Points of robots: their extent, order and shape, and what is drawn of a cable.

import { fromVector, product, turned } from "./rotation.js";

/**
 * The box around the exit points.
 * @param {number[][]} exits
 * @returns {{min: number[], max: number[], size: number, middle: number[]}}
 */
export function extents(exits) {
  const min = [0, 1, 2].map((k) => Math.min(...exits.map((exit) => exit[k])));
  const max = [0, 1, 2].map((k) => Math.max(...exits.map((exit) => exit[k])));
  const size = Math.max(...max.map((value, k) => value - min[k]), 1e-3);
  return { min, max, size, middle: min.map((value, k) => (value + max[k]) / 2) };
}

/**
 * The height of the ground [m], below which the platform does not go: that of the robot file or, for a frame
 * that is surveyed from the floor and a platform above it, zero; null where nothing says where it is.
 * @param {{exits: number[][], anchors: number[][], start: {pose: number[]}|null, ground_z?: number}} robot
 */
export function groundOf({ exits, anchors, start, ground_z }) {
  if (Number.isFinite(ground_z)) return ground_z;
  const { min, size } = extents(exits);
  const isSurveyed = min[2] >= 0 && min[2] < 2 * size;
  return isSurveyed && Math.min(0, ...feet({ anchors, start })) === 0 ? 0 : null;
}

/** The height at which the floor is drawn: the ground or, without one, the lowest exit or anchor point. */
export function floorOf(robot) {
  return groundOf(robot) ?? Math.min(...robot.exits.map((exit) => exit[2]), ...feet(robot));
}

// Heights of the anchor points where the platform stands first.
function feet({ anchors, start }) {
  return start ? anchorsAt(start.pose, anchors).map((anchor) => anchor[2]) : [];
}

/**
 * Indices of the exit points in the order of their angle about the vertical through their middle: one ring or,
 * where they are on two levels, a lower and an upper one.
 */
export function rings(exits) {
  const { min, max, middle, size } = extents(exits);
  const height = max[2] - min[2];
  const rising = exits.map((_, k) => k).sort((a, b) => exits[a][2] - exits[b][2]);
  const gap = (k) => exits[rising[k]][2] - exits[rising[k - 1]][2];
  const split = rising.findIndex((_, k) => k > 2 && k < exits.length - 2 && gap(k) > 0.4 * height);
  const levels = split > 0 && height > 0.1 * size ? [rising.slice(0, split), rising.slice(split)] : [rising];
  const angle = (k) => Math.atan2(exits[k][1] - middle[1], exits[k][0] - middle[0]);
  return levels.map((level) => level.sort((a, b) => angle(a) - angle(b)));
}

/**
 * Points of which the convex hull is the body that is drawn: a flat one gets a thickness, a bar a width.
 * @param {number[][]} anchors in the platform frame
 * @param {number} size of the robot, for a point mass
 */
export function bodyPoints(anchors, size) {
  const middle = [0, 1, 2].map((k) => anchors.reduce((sum, anchor) => sum + anchor[k] / anchors.length, 0));
  const arms = anchors.map((anchor) => anchor.map((value, k) => value - middle[k]));
  const reach = Math.max(...arms.map((arm) => Math.hypot(...arm)));
  if (reach < 1e-9 * size) return null;
  const first = unit(arms.reduce((best, arm) => (Math.hypot(...arm) > Math.hypot(...best) ? arm : best)));
  const across = arms.map((arm) => sub(arm, first, dot(arm, first)));
  const widest = across.reduce((best, arm) => (Math.hypot(...arm) > Math.hypot(...best) ? arm : best));
  const flat = Math.hypot(...widest) < 0.02 * reach;
  const second = flat ? unit(sub(leastAxis(first), first, dot(leastAxis(first), first))) : unit(widest);
  const third = cross(first, second);
  const height = Math.max(...arms.map((arm) => Math.abs(dot(arm, third))));
  let points = anchors;
  if (flat)
    points = points.flatMap((anchor) => [
      sub(anchor, second, 0.06 * reach),
      sub(anchor, second, -0.06 * reach),
    ]);
  if (height < 0.02 * reach)
    points = points.flatMap((anchor) => [
      sub(anchor, third, 0.05 * reach),
      sub(anchor, third, -0.05 * reach),
    ]);
  return points;
}

/**
 * Points of a cable with the distances of its free part from the chord times a factor. What lies on a pulley
 * stays there.
 * @param {number[]} points flat, from the exit point to the anchor point
 * @param {number} [free] index of the first point of the free part: where the cable leaves its pulley
 */
export function exaggerated(points, factor, free = 0) {
  if (factor === 1) return points;
  const [first, last] = [3 * free, points.length - 3];
  const chord = [0, 1, 2].map((k) => points[last + k] - points[first + k]);
  const square = dot(chord, chord) || 1;
  return points.map((value, i) => {
    if (i < first) return value;
    const base = i - (i % 3);
    const along = [0, 1, 2].reduce((sum, k) => sum + (points[base + k] - points[first + k]) * chord[k], 0);
    const onChord = points[first + (i % 3)] + (along / square) * chord[i % 3];
    return onChord + factor * (value - onChord);
  });
}

/**
 * A pose moved by a small motion times a factor: translation of P and rotation vector in the base frame.
 * @param {number[]} pose x, y, z, qw, qx, qy, qz
 */
export function moved(pose, { translation, rotation }, factor) {
  const position = translation.map((value, k) => pose[k] + factor * value);
  return [...position, ...product(fromVector(rotation.map((value) => factor * value)), pose.slice(3))];
}

/** The anchor points at a pose, in the base frame. */
export function anchorsAt(pose, anchors) {
  return anchors.map((anchor) => turned(pose.slice(3), anchor).map((value, k) => value + pose[k]));
}

/** Points of a cable whose anchor point has moved by `step`: those of its free part, the nearer the more. */
export function followed(points, step, free = 0) {
  const count = points.length / 3 - 1 - free;
  return points.map((value, i) => value + (step[i % 3] * Math.max(0, Math.floor(i / 3) - free)) / count);
}

/** A motion of unit size, scaled so that its fastest point moves by `reach` [m]. */
export function amplitude({ translation, rotation }, anchors, pose, reach) {
  const arms = anchors.map((anchor) => turned(pose.slice(3), anchor));
  const speeds = [...arms, [0, 0, 0]].map((arm) =>
    Math.hypot(...cross(rotation, arm).map((value, k) => value + translation[k])),
  );
  const fastest = Math.max(...speeds);
  return fastest > 0 ? reach / fastest : 0;
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function sub(a, b, factor) {
  return a.map((value, k) => value - factor * b[k]);
}

function unit(a) {
  return a.map((value) => value / Math.hypot(...a));
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function leastAxis(a) {
  const least = a.reduce((best, value, k) => (Math.abs(value) < Math.abs(a[best]) ? k : best), 0);
  return [0, 1, 2].map((k) => (k === least ? 1 : 0));
}
