// The robot and the study that the engine gets: the files with the changes that the page has made to them.

import { quaternion } from "./rotation.js";

/**
 * The robot file with a changed modulus, density, tension reference, limits and points.
 * @param {object} file robot file
 * @param {{modulus: number, density: number, reference: number|string|null, least: number|null,
 *   greatest: number|null, points: Object<string, number[]>}} changes factors, tensions [N], places [m]
 */
export function changedRobot(file, changes) {
  const robot = structuredClone(file);
  for (const cable of [robot.cable, ...robot.cables.map((entry) => entry.cable)]) {
    if (!cable) continue;
    cable.youngs_modulus *= changes.modulus;
    cable.linear_density *= changes.density;
    for (const segment of cable.law?.segments ?? []) segment.modulus *= changes.modulus;
  }
  if (changes.reference !== null) {
    robot.tension_reference = changes.reference;
    delete robot.distribution;
  }
  for (const limits of [robot.tension_limits, ...robot.cables.map((entry) => entry.tension_limits)]) {
    if (!limits) continue;
    if (changes.least !== null && limits.min !== undefined) limits.min = changes.least;
    if (changes.greatest !== null && limits.max !== undefined) limits.max = changes.greatest;
  }
  for (const [name, place] of Object.entries(changes.points))
    robot.cables[Number(name.slice(1)) - 1][FIELDS[name[0]]] = place;
  return robot;
}

// Fields of a robot file, and of what `describe` answers, by the first letter of the name of a point.
const FIELDS = { a: "anchor_point", b: "exit_point" };
const LISTS = { a: "anchors", b: "exits" };

/** The names of all exit points, b1, b2, .., and anchor points, a1, a2, .., as parameters of studies have. */
export function pointNames(cables) {
  return ["b", "a"].flatMap((kind) => Array.from({ length: cables }, (_, k) => `${kind}${k + 1}`));
}

/** Whether a value is a list of places [m] by the names of points. */
export function arePoints(value, cables) {
  const names = pointNames(cables);
  const isPlace = (place) => Array.isArray(place) && place.length === 3 && place.every(Number.isFinite);
  const isObject = value !== null && typeof value === "object" && !Array.isArray(value);
  return isObject && Object.entries(value).every(([name, place]) => names.includes(name) && isPlace(place));
}

/** The place of a point [m]: an exit point in the base frame, an anchor point in that of the platform. */
export function pointOf(robot, name) {
  return robot[LISTS[name[0]]][Number(name.slice(1)) - 1];
}

/** Changes with a point at another place [m]. */
export function withPoint(changes, name, place) {
  return { ...changes, points: { ...changes.points, [name]: place } };
}

/** The exit and anchor points of a robot file. */
export function pointsOf({ cables }) {
  return {
    exits: cables.map((cable) => cable.exit_point),
    anchors: cables.map((cable) => cable.anchor_point),
  };
}

/** Whether the robot is another one than that of the file. The tension reference is an option of commands. */
export function isChanged({ modulus, density, least, greatest, points }) {
  const isCable = modulus !== 1 || density !== 1 || least !== null || greatest !== null;
  return isCable || Object.keys(points).length > 0;
}

/** The first sampling of a study file, by convention named `all`. */
export function firstSampling(study) {
  return study.samplings.all ?? Object.values(study.samplings)[0];
}

/**
 * What a study says instead of the template: itself, and pose or lengths, load and free coordinates to begin
 * with.
 * @param {object} study study file
 */
export function ofStudy(study) {
  const { pose, free = [], lengths } = firstSampling(study);
  const rotation = pose?.quaternion ?? quaternion(pose?.rpy_deg ?? [0, 0, 0]);
  const { payload, force, moment } = study;
  const start = pose ? { pose: [...pose.position, ...rotation], payload, force, moment, lengths } : null;
  return { study, ...(start ? { start, free } : {}), reference: study.tension_reference ?? null };
}

/** The tolerances of a study: the entries of the error model of its sampling. */
export function tolerances(study) {
  return study.error_models[firstSampling(study).error_model];
}

/** Whether an entry of an error model is of set-points of tensions, which kept lengths do not have. */
export function isOfSetPoints([name, { parameters }]) {
  return (parameters ? Object.keys(parameters) : [name]).some((acts) => /^dt\d*$/.test(acts));
}

// The entries that deviate in a state, with their factors.
function deviating(study, { way, tolerances: factors }) {
  return Object.entries(tolerances(study))
    .filter((entry) => way === "pose" || !isOfSetPoints(entry))
    .map(([name, entry]) => [name, entry, factors[name] ?? 1])
    .filter(([, , factor]) => factor > 0);
}

// The number that a slider shows of a law, in SI units, and what it is.
function extent({ law }) {
  const [numbers] = Object.values(law);
  if ("std" in numbers) return [numbers.std, "standard deviation"];
  if ("log_mean" in numbers) return [Math.exp(numbers.log_mean), "median"];
  if ("min" in numbers) return [(numbers.max - numbers.min) / 2, "±"];
  return [numbers.scale, "scale"];
}

/** How wide a law is, in SI units. */
export const width = (entry) => extent(entry)[0];

/** What `width` is: half the distance of the ends, standard deviation, scale or median. */
export const widthWords = (entry) => extent(entry)[1];

// Numbers of laws that stay where deviations are multiplied.
const SHAPES = ["alpha", "beta", "shape", "log_std"];

/** An entry of an error model with all its deviations times a factor. */
export function scaled(entry, factor) {
  const [[kind, numbers]] = Object.entries(entry.law);
  const law = Object.fromEntries(
    Object.entries(numbers).map(([name, value]) => {
      if (name === "log_mean") return [name, value + Math.log(factor)];
      return [name, SHAPES.includes(name) ? value : value * factor];
    }),
  );
  return { ...entry, law: { [kind]: law } };
}

/**
 * The study of what is on screen: one sampling, `all`, at the pose or on the lengths that are kept, under the
 * load, with scaled tolerances.
 * @param {object} study the study of the template
 * @param {object} state
 * @param {{robot: string, observations?: number}} options name of the robot file
 */
export function studyOf(study, state, { robot, observations = state.observations }) {
  const sampling = firstSampling(study);
  const entries = deviating(study, state).map(([name, entry, factor]) => [
    name,
    factor === 1 ? entry : scaled(entry, factor),
  ]);
  const wrench = ["force", "moment"].filter((part) => state[part].some((value) => value !== 0));
  const { name, seed, replicates, confidence, bootstrap_resamples } = study;
  return {
    format: study.format,
    name,
    source: "Written by the live robot of cdpr.",
    robot,
    payload: state.payload,
    ...Object.fromEntries(wrench.map((part) => [part, state[part]])),
    seed,
    ...(state.changes.reference === null ? {} : { tension_reference: state.changes.reference }),
    replicates: Math.max(2, replicates),
    confidence,
    bootstrap_resamples,
    error_models: { tolerances: Object.fromEntries(entries) },
    samplings: {
      all: {
        title: sampling.title,
        pose: { position: state.position, quaternion: quaternion(state.rpy_deg) },
        ...(state.way === "kept" ? { lengths: state.lengths } : {}),
        ...(state.way === "pose" && state.free.length > 0 ? { free: state.free } : {}),
        error_model: "tolerances",
        observations,
      },
    },
  };
}

/**
 * Why the state has no study; null where it has one.
 * @param {object} study the study of the template
 * @param {object} state
 */
export function unobserved(study, state) {
  const { force, moment, payload } = state;
  if (payload === 0 && [...force, ...moment].every((value) => value === 0))
    return "there is no load, so there is no deflection to observe: set a payload or a force";
  if (deviating(study, state).length === 0) {
    const points = state.way === "kept" ? ", and kept lengths have no tension set-points" : "";
    return `all tolerances are zero${points}, so nothing deviates`;
  }
  return null;
}
