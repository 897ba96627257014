// The largest signed effects as bars with intervals, as SVG.

import { digits, escape, parameterWords } from "../format.js";
import { fix, svg } from "./histogram.js";
import { map, ticks } from "./scale.js";

/**
 * @param {Array<{name: string, effect_mm: number, low_mm: number|null, high_mm: number|null}>} inputs
 * @param {{width: number, count?: number, title: string}} options
 * @param {object} palette
 * @returns {string}
 */
export function effectBars(inputs, { width, count = 10, title }, palette) {
  const shown = largest(inputs, count);
  const row = 18;
  const height = shown.length * row + 40;
  const left = Math.min(190, Math.max(120, width * 0.36));
  const ends = shown.flatMap(({ effect_mm, low_mm, high_mm }) => [effect_mm, low_mm ?? effect_mm, high_mm ?? effect_mm, 0]);
  const [low, high] = [Math.min(...ends, 0), Math.max(...ends, 0)];
  const pad = (high - low) * 0.04 || 1;
  const x = map([low - pad, high + pad], [left, width - 10]);
  const parts = [];
  for (const tick of ticks(low, high, Math.max(2, Math.floor((width - left) / 75)))) {
    parts.push(`<line x1="${fix(x(tick))}" x2="${fix(x(tick))}" y1="4" y2="${height - 34}" stroke="${palette.line}"/>`
      + `<text x="${fix(x(tick))}" y="${height - 20}" text-anchor="middle" fill="${palette.soft}">${digits(tick, 2)}</text>`);
  }
  shown.forEach((input, k) => {
    const y = 6 + k * row;
    const [from, to] = [x(0), x(input.effect_mm)].sort((a, b) => a - b);
    const color = input.effect_mm < 0 ? palette.minus : palette.bar;
    parts.push(`<g><title>${escape(`${input.name}: ${digits(input.effect_mm)} mm`)}</title>`
      + `<text x="${fix(left - 6)}" y="${y + 12}" text-anchor="end" fill="${palette.ink}">${escape(parameterWords(input.name))}</text>`
      + `<rect x="${fix(from)}" y="${y + 2}" width="${fix(Math.max(1, to - from))}" height="${row - 6}" fill="${color}"/>`
      + (input.low_mm === null || input.low_mm === undefined ? "" : whisker(x(input.low_mm), x(input.high_mm), y + row / 2 - 1)) + `</g>`);
  });
  parts.push(`<line x1="${fix(x(0))}" x2="${fix(x(0))}" y1="2" y2="${height - 34}" stroke="${palette.ink}"/>`);
  parts.push(`<text x="${fix((left + width) / 2)}" y="${height - 5}" text-anchor="middle" fill="${palette.soft}">`
    + `effect on the deflection [mm]</text>`);
  return svg(width, height, title, parts, palette);

  function whisker(a, b, y) {
    return `<path d="M${fix(a)},${y} H${fix(b)} M${fix(a)},${y - 4} v8 M${fix(b)},${y - 4} v8" stroke="${palette.ink}" `
      + `stroke-width="1.3" fill="none"/>`;
  }
}

/** The inputs with the largest effects, whatever their sign. */
export function largest(inputs, count) {
  return [...inputs].sort((a, b) => Math.abs(b.effect_mm) - Math.abs(a.effect_mm)).slice(0, count);
}
