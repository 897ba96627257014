// Numbers and names as a reader sees them.

const PREFIXES = [
  [1e9, "G"],
  [1e6, "M"],
  [1e3, "k"],
  [1, ""],
  [1e-3, "m"],
  [1e-6, "µ"],
];

/** A number with so many significant digits, without an exponent between 1e-4 and 1e6. */
export function digits(value, count = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "none";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const text = value.toExponential(Math.max(0, count - 1));
    return text.replace("e+", "e").replaceAll("-", "−");
  }
  const rounded = Number(value.toPrecision(count));
  const decimals = Math.max(0, count - 1 - Math.floor(Math.log10(Math.abs(rounded))));
  return rounded.toFixed(Math.min(decimals, 10)).replace("-", "−");
}

/** A force, stiffness or modulus with its unit: 54.8 kN/m. */
export function withUnit(value, unit, count = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "none";
  const size = Math.abs(value);
  const [factor, prefix] = PREFIXES.find(([factor]) => size >= factor && factor >= 1) ?? [1, ""];
  const scaled = size >= 1e4 || unit === "Pa" ? [factor, prefix] : [1, ""];
  return `${digits(value / scaled[0], count)} ${scaled[1]}${unit}`;
}

/**
 * The unit in which a length of this size [m] reads well.
 * @returns {[number, string]} how many of it are a metre, and its name
 */
export function lengthUnit(metres) {
  const size = Math.abs(metres);
  if (size >= 1) return [1, "m"];
  return size > 0 && size < 1e-4 ? [1e6, "µm"] : [1e3, "mm"];
}

/** A length from metres, in the unit that its size asks for. */
export function short(metres, count = 4) {
  if (metres === null || metres === undefined || !Number.isFinite(metres)) return "none";
  const [factor, unit] = lengthUnit(metres);
  return `${digits(factor * metres, count)} ${unit}`;
}

/** A vector [m] in the unit that its length asks for, all with the decimals that it needs. */
export function vectorShort(vector, count = 3) {
  const [factor, unit] = lengthUnit(Math.hypot(...vector));
  const size = factor * Math.hypot(...vector);
  const decimals = size > 0 ? Math.min(9, Math.max(0, count - 1 - Math.floor(Math.log10(size)))) : 0;
  const shown = vector.map((value) => String(Number((factor * value).toFixed(decimals)) || 0));
  return `(${shown.join(", ").replaceAll("-", "−")}) ${unit}`;
}

/** A share in percent. */
export function sharePercent(share) {
  return share < 1e-3 ? "< 0.1 %" : `${digits(100 * share, 2)} %`;
}

/** A range of forces in one unit. */
export function rangeWithUnit(least, greatest, unit) {
  const [factor, prefix] = greatest >= 1e4 ? [1e3, "k"] : [1, ""];
  return `${digits(least / factor)} to ${digits(greatest / factor)} ${prefix}${unit}`;
}

/** A number of things: 1 iteration, 3 iterations. */
export function counted(count, word) {
  return `${count} ${word}${count === 1 ? "" : "s"}`;
}

/** A residual: two digits and an exponent. */
export function residual(value, unit) {
  return value === null || value === undefined ? "none" : `${value.toExponential(1)} ${unit}`;
}

/** Coordinates in metres, those of a position or a pose: (0, −1.2, 3) m. */
export function point(vector, decimals = 3) {
  const shown = vector.slice(0, 3).map((value) => String(Number(value.toFixed(decimals))));
  return `(${shown.join(", ").replaceAll("-", "−")}) m`;
}

const AXES = { x: "x", y: "y", z: "z" };

/** A parameter in words: `a3.x` is the x coordinate of anchor point 3. */
export function parameterWords(name) {
  const [, letters, number, , axis] = name.match(/^([a-z_]+?)(\d*)(\.([a-z]))?$/) ?? [];
  const where = axis ? ` ${AXES[axis] ?? axis}` : "";
  const words = {
    a: "anchor point",
    b: "exit point",
    cog: "centre of mass",
    dt: "tension set-point",
    r: "pulley radius",
    lead: "lead",
    tilt: "pulley tilt",
    gravity: "gravity",
    mass: "platform mass",
    linear_density: "cable density",
    youngs_modulus: "cable modulus",
  }[letters];
  return words ? `${words}${number ? ` ${number}` : ""}${where}` : name;
}

/** An entry of an error model in words. */
export function entryWords(entry) {
  const groups = {
    a: "anchor points",
    b: "exit points",
    cog: "centre of mass",
    dt: "tension set-points",
    r: "pulley radii",
    lead: "leads",
    tilt: "pulley tilts",
    gravity: "gravity",
    mass: "platform mass",
    linear_density: "cable density",
    youngs_modulus: "cable modulus",
  };
  return groups[entry] ?? parameterWords(entry);
}

/** A name as files, commands and reports have it, and words for it. */
export function named(name, words) {
  return words === name ? name : `${name} (${words})`;
}

/** How many of a unit of the interface one SI unit has, and its name: 1000 mm to a metre. */
export function shownUnit(unit) {
  return (
    { m: [1e3, "mm"], Pa: [1e-9, "GPa"], rad: [180 / Math.PI, "degrees"], "kg/m": [1e3, "g/m"] }[unit] ?? [
      1,
      unit,
    ]
  );
}

/** Text that may stand in SVG or HTML. */
export function escape(text) {
  const entities = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;" };
  return String(text).replace(/[&<>"']/g, (letter) => entities[letter]);
}

/** A reason of the models with numbers of seven digits at most: 6.50625 for 6.5062500000000005. */
export function readable(reason) {
  return reason.replace(/\d+\.\d{7,}(e[-+]?\d+)?/g, (text) => String(Number(Number(text).toPrecision(7))));
}

const KINDS = {
  turning_point: "its equilibrium ended at a turning point",
  bifurcation: "its equilibrium became unstable at a bifurcation",
  overstrained: "a cable was stretched too far",
  step_limit: "the way could not be followed in the allowed steps",
};

/** How an equilibrium was lost, in words. */
export function lossWords(kind) {
  return KINDS[kind] ?? String(kind).replaceAll("_", " ");
}
