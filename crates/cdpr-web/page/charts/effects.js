// The largest signed effects as bars with intervals, as SVG.

import { lengthUnit } from "../format.js";
import { map, tickLabel, ticks } from "./scale.js";
import { fix, line, path, rect, svg, text } from "./svg.js";

const ROW = 18;

/**
 * @param {Array<{name: string, effect_mm: number, low_mm: number, high_mm: number}>} inputs
 * @param {{width: number, count?: number, title: string}} options
 * @param {object} palette
 * @returns {string}
 */
export function effectBars(inputs, { width, count = 10, title }, palette) {
  const shown = largest(inputs, count);
  const height = shown.length * ROW + 40;
  const left = Math.min(190, Math.max(120, width * 0.36));
  const ends = shown.flatMap(({ effect_mm, low_mm, high_mm }) => [effect_mm, low_mm, high_mm]);
  const [low, high] = [Math.min(...ends, 0), Math.max(...ends, 0)];
  const pad = (high - low) * 0.04 || 1;
  const x = map([low - pad, high + pad], [left, width - 10]);
  const [factor, unit] = lengthUnit(Math.max(-low, high) / 1e3);
  const scale = factor / 1e3;
  const grid = ticks(scale * low, scale * high, Math.max(2, Math.floor((width - left) / 85))).map((tick) => {
    const at = x(tick / scale);
    return line(at, 4, at, height - 34, palette.line) + text(at, height - 20, tickLabel(tick), palette.soft);
  });
  const bars = shown.map(({ name, effect_mm, low_mm, high_mm }, k) => {
    const y = 6 + k * ROW;
    const [from, to] = [x(0), x(effect_mm)].sort((a, b) => a - b);
    const [a, b, middle] = [fix(x(low_mm)), fix(x(high_mm)), y + ROW / 2 - 1];
    const whisker = `M${a},${middle} H${b} M${a},${middle - 4} v8 M${b},${middle - 4} v8`;
    return [
      text(left - 6, y + 12, name, palette.ink, "end"),
      rect(from, y + 2, Math.max(1, to - from), ROW - 6, effect_mm < 0 ? palette.minus : palette.bar),
      path(whisker, palette.ink, 'stroke-width="1.3"'),
    ].join("");
  });
  const zero = line(x(0), 2, x(0), height - 34, palette.ink);
  const name = text((left + width) / 2, height - 5, `effect on the deflection [${unit}]`, palette.soft);
  return svg(width, height, title, [...grid, ...bars, zero, name], palette);
}

/** The inputs with the largest effects, whatever their sign. */
export function largest(inputs, count) {
  return [...inputs].sort((a, b) => Math.abs(b.effect_mm) - Math.abs(a.effect_mm)).slice(0, count);
}
