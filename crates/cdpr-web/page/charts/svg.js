// SVG as text: whole drawings and their parts. All colours are attributes: a saved file needs no style.

import { escape } from "../format.js";

/**
 * A whole drawing with a title for those who hear it.
 * @param {number} width
 * @param {number} height
 * @param {string} title
 * @param {string[]} parts
 * @param {object} palette
 */
export function svg(width, height, title, parts, palette) {
  const name = escape(title);
  const paper = palette.background ? rect(0, 0, width, height, palette.background) : "";
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" ` +
    `height="${height}" role="img" aria-label="${name}" font-family="system-ui, sans-serif" font-size="12">` +
    `<title>${name}</title>${paper}${parts.join("")}</svg>`
  );
}

/** @param {string} [more] further attributes */
export function rect(x, y, width, height, fill, more = "") {
  const box = `x="${fix(x)}" y="${fix(y)}" width="${fix(width)}" height="${fix(height)}"`;
  return `<rect ${box} fill="${fill}" ${more}/>`;
}

export function line(x1, y1, x2, y2, stroke, more = "") {
  return `<line x1="${fix(x1)}" y1="${fix(y1)}" x2="${fix(x2)}" y2="${fix(y2)}" stroke="${stroke}" ${more}/>`;
}

/** @param {string} d commands of a path */
export function path(d, stroke, more = "") {
  return `<path d="${d}" stroke="${stroke}" fill="none" ${more}/>`;
}

/** @param {"start"|"middle"|"end"} [anchor] */
export function text(x, y, content, fill, anchor = "middle", more = "") {
  const place = `x="${fix(x)}" y="${fix(y)}" text-anchor="${anchor}"`;
  return `<text ${place} fill="${fill}" ${more}>${escape(content)}</text>`;
}

/** A coordinate with a tenth of a pixel. */
export function fix(value) {
  return Number(value.toFixed(1));
}
