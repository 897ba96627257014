// Points of robots: their extent, order and shape, and what is drawn of a cable.

import { fromVector, product, turned } from "./rotation.js";

/**
 * The box around the exit points, and where the floor is drawn.
 * @param {number[][]} exits
 * @returns {{min: number[], max: number[], size: number, floor: number, middle: number[]}}
 */
export function extents(exits) {
  const min = [0, 1, 2].map((k) => Math.min(...exits.map((exit) => exit[k])));
  const max = [0, 1, 2].map((k) => Math.max(...exits.map((exit) => exit[k])));
  const size = Math.max(...max.map((value, k) => value - min[k]), 1e-3);
  // Frames are surveyed from the floor; of those that hang above nothing the floor is below the lowest exit.
  const floor = min[2] >= 0 && min[2] < 2 * size ? 0 : min[2];
  return { min, max, size, floor, middle: min.map((value, k) => (value + max[k]) / 2) };
}

/** Indices of the exit points in the order of their angle about the vertical through their middle. */
export function ring(exits) {
  const { middle } = extents(exits);
  const angle = (k) => Math.atan2(exits[k][1] - middle[1], exits[k][0] - middle[0]);
  return exits.map((_, k) => k).sort((a, b) => angle(a) - angle(b));
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
 * Points of a cable with its distances from the chord times a factor.
 * @param {number[]} points flat, from the exit point to the anchor point
 */
export function exaggerated(points, factor) {
  if (factor === 1) return points;
  const last = points.length - 3;
  const chord = [0, 1, 2].map((k) => points[last + k] - points[k]);
  const square = dot(chord, chord) || 1;
  return points.map((value, i) => {
    const base = i - (i % 3);
    const t = [0, 1, 2].reduce((sum, k) => sum + (points[base + k] - points[k]) * chord[k], 0) / square;
    const onChord = points[i % 3] + t * chord[i % 3];
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

/** Points of a cable whose anchor point has moved by `step`, the nearer to it the more. */
export function followed(points, step) {
  const count = points.length / 3 - 1;
  return points.map((value, i) => value + (step[i % 3] * Math.floor(i / 3)) / count);
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
