// Tensions of all cables along a trajectory, as SVG.

import { digits } from "../format.js";
import { map, roundUp, tickLabel, ticks } from "./scale.js";
import { fix, line, path, rect, svg, text } from "./svg.js";

/** Colours of cables, of which lines beyond the eighth are dashed. */
const LIGHT = ["#0072b2", "#c04f00", "#00835f", "#a4417d", "#9a6a00", "#3f8fc4", "#7a3f8f", "#4d5b68"];
const DARK = ["#56b4e9", "#f0924a", "#2fc79a", "#e08fc0", "#e6b840", "#9fd0f0", "#c99be0", "#b0bbc6"];

/** The colour of a cable in the chart. */
export function cableColor(k, palette) {
  return (palette.dark ? DARK : LIGHT)[k % LIGHT.length];
}

/** Where the chart is in a drawing of some width and height [px]. */
export function tensionFrame(width, height) {
  return { left: 46, right: width - 8, top: 6, bottom: height - 18 };
}

/**
 * @param {{times: number[], found: Array<{tensions: number[], limits: string[]}|{failure: object}>}} track
 * @param {{width: number, height: number, selected: number|null, bounds: number[], title: string}} options
 *   `bounds`: least and greatest tension that are allowed [N]
 * @param {object} palette
 */
export function tensionChart({ times, found }, { width, height, selected, bounds, title }, palette) {
  const frame = tensionFrame(width, height);
  const held = found.filter((one) => one?.tensions);
  const top = roundUp(held.reduce((most, { tensions }) => Math.max(most, ...tensions), 0) || 1);
  const x = map([times[0], times.at(-1)], [frame.left, frame.right]);
  const y = map([0, top], [frame.bottom, frame.top]);
  const grid = ticks(0, top, 3).map(
    (tick) =>
      line(frame.left, y(tick), frame.right, y(tick), palette.line) +
      text(frame.left - 4, y(tick) + 4, tickLabel(tick), palette.soft, "end"),
  );
  const clock = ticks(times[0], times.at(-1), Math.max(2, Math.floor(width / 110))).map((tick) =>
    text(Math.min(x(tick), width - 16), height - 4, `${tickLabel(tick)} s`, palette.soft),
  );
  const limits = bounds
    .filter((bound) => bound > 0.02 * top && bound < top)
    .map((bound) =>
      line(frame.left, y(bound), frame.right, y(bound), palette.warn, 'stroke-dasharray="5 4"'),
    );
  const count = held[0]?.tensions.length ?? 0;
  const curves = Array.from({ length: count }, (_, k) => {
    const more = `stroke-width="${k === selected ? 3.2 : 1.5}" stroke-linejoin="round"`;
    return path(
      curve(found, times, k, x, y),
      cableColor(k, palette),
      more + (k < 8 ? "" : ' stroke-dasharray="7 3"'),
    );
  });
  const parts = [...bands(times, found, x, frame, palette), ...grid, ...limits, ...curves, ...clock];
  return svg(
    width,
    height,
    title,
    [...parts, text(frame.left + 5, frame.top + 11, "tension [N]", palette.soft, "start")],
    palette,
  );
}

// The line of a cable, with a gap where the platform is not held or nothing is computed yet.
function curve(found, times, k, x, y) {
  let pen = "M";
  return times
    .map((time, i) => {
      const tension = found[i]?.tensions?.[k];
      if (tension === undefined) {
        pen = "M";
        return "";
      }
      const step = `${pen}${fix(x(time))},${fix(y(tension))}`;
      pen = "L";
      return step;
    })
    .join("");
}

// Where the platform is not held, and where a tension is out of its limits: a band for each stretch of time.
function bands(times, found, x, { top, bottom }, palette) {
  const kind = (one) => (one?.failure ? 0.3 : one?.limits.some(Boolean) ? 0.12 : 0);
  const runs = [];
  times.forEach((time, i) => {
    const opacity = kind(found[i]);
    const [from, to] = [times[i - 1] ?? time, times[i + 1] ?? time].map((other) => x((other + time) / 2));
    if (runs.at(-1)?.opacity === opacity) runs.at(-1).to = to;
    else runs.push({ opacity, from, to });
  });
  return runs
    .filter(({ opacity }) => opacity > 0)
    .map(({ opacity, from, to }) =>
      rect(from, top, Math.max(to - from, 1), bottom - top, palette.warn, `fill-opacity="${opacity}"`),
    );
}

/** The trajectory in a sentence: what is computed, what is not held, and between which tensions. */
export function trackWords({ times, found, done, every, count = times.length, areInMotion = false }) {
  const failed = times.flatMap((time, i) => (found[i]?.failure ? [{ time, ...found[i].failure }] : []));
  const out = times.filter((_, i) => found[i]?.limits?.some(Boolean)).length;
  const tensions = found.flatMap((one) => one?.tensions ?? []);
  const [least, greatest] = tensions.reduce(([a, b], t) => [Math.min(a, t), Math.max(b, t)], [Infinity, 0]);
  const parts = [done < times.length ? `${done} of ${times.length} poses computed` : `${count} poses`];
  if (every > 1 && !areInMotion) parts[0] += `, one in ${every} of the table`;
  const motion = areInMotion ? " in motion, as the table has them" : "";
  if (tensions.length > 0) parts.push(`tensions ${digits(least, 3)} to ${digits(greatest, 3)} N${motion}`);
  if (out > 0) parts.push(`${out} with a tension out of its limits`);
  const [first] = failed;
  if (first) parts.push(`${failed.length} not held, first at ${digits(first.time, 3)} s: ${first.reason}`);
  return `${parts.join("; ")}.`;
}
