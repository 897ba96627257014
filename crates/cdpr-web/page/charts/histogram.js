// The histogram of the deflection, as SVG.

import { digits, escape } from "../format.js";
import { map, ticks } from "./scale.js";
import { bins } from "./statistics.js";

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
  const bars = counts.map((count, k) => {
    const [left, right] = edges[0] === edges.at(-1) ? [x(edges[0]) - 2, x(edges[0]) + 2] : [x(edges[k]), x(edges[k + 1])];
    return `<rect x="${fix(left)}" y="${fix(y(count))}" width="${fix(Math.max(0.5, right - left - 0.5))}" `
      + `height="${fix(frame.bottom - y(count))}" fill="${palette.bar}"/>`;
  });
  const lines = [mark(x(summary.q05), "5 %", "end"), mark(x(summary.q95), "95 %", "start")];
  lines.push(`<line x1="${fix(x(summary.mean))}" x2="${fix(x(summary.mean))}" y1="${frame.top - 4}" y2="${frame.bottom}" `
    + `stroke="${palette.ink}" stroke-width="2"/>`
    + `<text x="${fix(x(summary.mean))}" y="${frame.top - 8}" text-anchor="middle" fill="${palette.ink}" font-weight="600">mean</text>`);
  if (nominal !== null) {
    const px = fix(x(nominal));
    lines.push(`<path d="M${px},${frame.bottom} l-5,8 h10 z" fill="${palette.accent}"><title>nominal robot</title></path>`);
  }
  const axis = ticks(low, high, Math.max(2, Math.floor(width / 90))).filter((tick) => x(tick) > 12 && x(tick) < width - 12);
  const labels = axis.map((tick) => `<text x="${fix(x(tick))}" y="${height - 18}" text-anchor="middle" fill="${palette.soft}">`
    + `${digits(tick, 6).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "")}</text>`);
  return svg(width, height, title, [
    ...bars, `<line x1="${frame.left}" x2="${frame.right}" y1="${frame.bottom}" y2="${frame.bottom}" stroke="${palette.line}"/>`,
    ...lines, ...labels,
    `<text x="${width / 2}" y="${height - 3}" text-anchor="middle" fill="${palette.soft}">deflection [mm]</text>`,
  ], palette);

  function mark(px, text, anchor) {
    return `<line x1="${fix(px)}" x2="${fix(px)}" y1="${frame.top}" y2="${frame.bottom}" stroke="${palette.ink}" `
      + `stroke-dasharray="4 3"/><text x="${fix(px + (anchor === "end" ? -3 : 3))}" y="${frame.top + 10}" `
      + `text-anchor="${anchor}" fill="${palette.soft}">${text}</text>`;
  }
}

/** A whole SVG with a title for those who hear it. */
export function svg(width, height, title, parts, palette) {
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" `
    + `role="img" aria-label="${escape(title)}" font-family="system-ui, sans-serif" font-size="12">`
    + `<title>${escape(title)}</title>${palette.background ? `<rect width="${width}" height="${height}" fill="${palette.background}"/>` : ""}`
    + `${parts.join("")}</svg>`;
}

/** A coordinate with a tenth of a pixel. */
export function fix(value) {
  return Number(value.toFixed(1));
}
