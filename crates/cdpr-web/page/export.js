// Files that the page writes.

import { withUnit } from "./format.js";
import { css, viridis } from "./charts/scale.js";

/**
 * Tensions along a trajectory as a table.
 * @param {{times: number[], found: object[]}} track
 * @param {function(number): {position: number[], rpy_deg: number[]}} poseAt
 * @param {number} cables
 */
export function trackCsv({ times, found }, poseAt, cables) {
  const names = ["t_s", "x_m", "y_m", "z_m", "roll_deg", "pitch_deg", "yaw_deg", "deflection_m"];
  const tensions = Array.from({ length: cables }, (_, k) => `tension_${k + 1}_N`);
  const lines = times.map((time, i) => {
    const { position, rpy_deg } = poseAt(time);
    const one = found[i] ?? {};
    const forces = tensions.map((_, k) => one.tensions?.[k] ?? "");
    const reason = one.failure ? `"${one.failure.reason.replaceAll('"', '""')}"` : "";
    return [time, ...position, ...rpy_deg, one.deflection ?? "", ...forces, reason].join(",");
  });
  return [[...names, ...tensions, "reason"].join(","), ...lines, ""].join("\n");
}

/** Offers a file for download. */
export function download(name, content, type) {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const address = URL.createObjectURL(blob);
  const anchor = document.createElement("a");
  anchor.href = address;
  anchor.download = name;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/**
 * The table of the cables as CSV, with the units in its header.
 * @param {object} picture of the mechanics
 * @param {Array<{min: number, max: number}>} limits those of the robot [N]
 */
export function cablesCsv({ loaded, unloaded, limits: here }, limits) {
  const head =
    "cable,unstrained_length_m,tension_n,exit_tension_n,tension_without_load_n," +
    "least_tension_n,greatest_tension_n,sag_m,slack,limit";
  const lines = loaded.cables.map((cable, k) => {
    const [min, max] = here?.[k] ?? [limits[k].min, limits[k].max];
    return [
      k + 1,
      cable.length,
      cable.tension,
      cable.exit_tension,
      unloaded?.cables[k].tension ?? "",
      min,
      max,
      cable.sag,
      cable.slack,
      cable.limit ?? "",
    ].join(",");
  });
  return `${[head, ...lines].join("\n")}\n`;
}

/**
 * The observations as CSV: a row for each, with the seed of the study, the deviations of all inputs in SI
 * units, the outputs, and why one failed.
 * @param {{seed: number, inputs: Array<{name: string, unit: string|null}>, outputs: string[],
 *   rows: Array<{inputs: number[], outputs_mm: number[]|null,
 *   failure: {kind: string, reason: string}|null}>}} table
 */
export function observationsCsv({ seed, inputs, outputs, rows }) {
  const named = inputs.map(({ name, unit }) => (unit ? `d_${name} [${unit}]` : `d_${name}`));
  const none = outputs.map(() => "");
  const head = ["index", "seed", ...named, ...outputs, "status", "reason"];
  const lines = rows.map(({ inputs: deviations, outputs_mm, failure }, index) => [
    index,
    seed,
    ...deviations,
    ...(outputs_mm ?? none),
    failure?.kind ?? "ok",
    failure?.reason ?? "",
  ]);
  return `${[head, ...lines].map((cells) => cells.map(cell).join(",")).join("\n")}\n`;
}

function cell(value) {
  const text = String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/**
 * The picture of the view with its legend and a caption, as a canvas.
 * @param {HTMLCanvasElement} canvas
 * @param {{range: number, lines: string[], palette: object}} options `range` [N] of the colours
 */
export function framed(canvas, { range, lines, palette }) {
  const scale = canvas.width / canvas.clientWidth || 1;
  const size = 13 * scale;
  const made = document.createElement("canvas");
  made.width = canvas.width;
  made.height = canvas.height + (lines.length + 3) * 1.5 * size;
  const pen = made.getContext("2d");
  pen.fillStyle = palette.paper;
  pen.fillRect(0, 0, made.width, made.height);
  pen.drawImage(canvas, 0, 0);
  pen.font = `${size}px system-ui, sans-serif`;
  pen.fillStyle = palette.ink;
  let y = canvas.height + 1.6 * size;
  for (const line of lines) {
    pen.fillText(line, size, y, made.width - 2 * size);
    y += 1.5 * size;
  }
  const [left, width] = [size, Math.min(300 * scale, made.width - 2 * size)];
  for (let k = 0; k < width; k++) {
    pen.fillStyle = css(viridis(k / width));
    pen.fillRect(left + k, y - size, 1.5, size);
  }
  pen.fillStyle = palette.ink;
  pen.fillText(`tension: 0 to ${withUnit(range, "N", 3)}`, left, y + 1.2 * size);
  return made;
}
