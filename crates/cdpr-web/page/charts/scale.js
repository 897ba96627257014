// Axes and colours of charts.

/** Round numbers between `min` and `max`, about `count` of them. */
export function ticks(min, max, count = 5) {
  if (!(max > min)) return [min];
  const raw = (max - min) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const ratio = raw / power;
  const step = power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
  const list = [];
  for (let k = Math.ceil(min / step - 1e-9); k * step <= max + 1e-9 * step; k++)
    list.push(Number((k * step).toPrecision(12)));
  return list;
}

/** The label of a tick: no zeros at its end. */
export function tickLabel(tick) {
  return String(Number(tick.toPrecision(6)))
    .replace("e+", "e")
    .replaceAll("-", "−");
}

/** The next number of 1, 2, 5 times a power of ten above a positive value. */
export function roundUp(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return power * ([1, 1.5, 2, 3, 5, 7.5].find((factor) => factor * power >= value) ?? 10);
}

/** A linear map of [a, b] to [c, d]. */
export function map([a, b], [c, d]) {
  const slope = b === a ? 0 : (d - c) / (b - a);
  return (value) => c + slope * (value - a);
}

// Viridis and magma (Stéfan van der Walt, Nathaniel Smith, 2015, CC0), at ten equal steps.
const VIRIDIS = [
  "440154",
  "482878",
  "3e4a89",
  "31688e",
  "26828e",
  "1f9e89",
  "35b779",
  "6ece58",
  "b5de2b",
  "fde725",
];
const MAGMA = [
  "1d1147",
  "3b0f70",
  "641a80",
  "8c2981",
  "b73779",
  "de4968",
  "f7705c",
  "fe9f6d",
  "fecf92",
  "fcfdbf",
];

export const viridis = interpolate(VIRIDIS);
export const magma = interpolate(MAGMA);

/** A colour [0 to 1, sRGB] as CSS has it. */
export function css([r, g, b]) {
  return `#${[r, g, b]
    .map((part) =>
      Math.round(255 * part)
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
}

/** Stops of a gradient for SVG and CSS. */
export function stops(scale, count = 10) {
  return Array.from({ length: count }, (_, k) => [k / (count - 1), css(scale(k / (count - 1)))]);
}

function interpolate(names) {
  const colors = names.map((name) => [0, 2, 4].map((k) => parseInt(name.slice(k, k + 2), 16) / 255));
  return (t) => {
    const place = Math.min(1, Math.max(0, t)) * (colors.length - 1);
    const k = Math.min(colors.length - 2, Math.floor(place));
    return colors[k].map((part, c) => part + (place - k) * (colors[k + 1][c] - part));
  };
}
