// The histogram of the deflection, as SVG.

import { lengthUnit } from "../format.js";
import { map, tickLabel, ticks } from "./scale.js";
import { bins } from "./statistics.js";
import { fix, line, rect, svg, text } from "./svg.js";

/**
 * @param {object} summary of `statistics.summary`
 * @param {{width: number, height: number, nominal: number|null, title: string}} options nominal [mm]
 * @param {object} palette colours by name
 * @returns {string}
 */
export function histogram(summary, { width, height, nominal, title }, palette) {
  const { edges, counts } = bins(summary);
  const values = [summary.min, summary.max, ...(nominal === null ? [] : [nominal])];
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const pad = high > low ? 0.03 * (high - low) : Math.max(Math.abs(high), 1e-6) * 0.05;
  const frame = { left: 8, right: width - 8, top: 34, bottom: height - 36 };
  const x = map([low - pad, high + pad], [frame.left, frame.right]);
  const y = map([0, Math.max(...counts)], [frame.bottom, frame.top]);
  const constant = edges[0] === edges.at(-1);
  const bars = counts.map((count, k) => {
    const [from, to] = constant ? [x(edges[0]) - 2, x(edges[0]) + 2] : [x(edges[k]), x(edges[k + 1])];
    return rect(from, y(count), Math.max(0.5, to - from - 0.5), frame.bottom - y(count), palette.bar);
  });
  const mean = x(summary.mean);
  const marks = [
    dashed(x(summary.q05), "5 %", "end"),
    dashed(x(summary.q95), "95 %", "start"),
    line(mean, frame.top - 4, mean, frame.bottom, palette.ink, 'stroke-width="2"'),
    text(mean, frame.top - 8, "mean", palette.ink, "middle", 'font-weight="600"'),
  ];
  if (nominal !== null) {
    marks.push(`<path d="M${fix(x(nominal))},${frame.bottom} l-5,8 h10 z" fill="${palette.accent}"/>`);
  }
  const [factor, unit] = lengthUnit(Math.max(Math.abs(low), Math.abs(high)) / 1e3);
  const shown = factor / 1e3;
  const labels = ticks(shown * low, shown * high, Math.max(2, Math.floor(width / 90)))
    .map((tick) => [tick, x(tick / shown)])
    .filter(([, at]) => at > 12 && at < width - 12)
    .map(([tick, at]) => text(at, height - 18, tickLabel(tick), palette.soft));
  const axis = line(frame.left, frame.bottom, frame.right, frame.bottom, palette.line);
  const name = text(width / 2, height - 3, `deflection [${unit}]`, palette.soft);
  return svg(width, height, title, [...bars, axis, ...marks, ...labels, name], palette);

  function dashed(px, words, anchor) {
    const stroke = line(px, frame.top, px, frame.bottom, palette.ink, 'stroke-dasharray="4 3"');
    return stroke + text(px + (anchor === "end" ? -3 : 3), frame.top + 10, words, palette.soft, anchor);
  }
}
