// The state of the page: what a link, a file and the steps of undo hold. No numbers are derived here.

import { arePoints, firstSampling } from "./robot.js";
import { placeOf, rounded } from "./rotation.js";
import { QUANTITIES } from "./slices.js";
import { areRows } from "./trajectory/track.js";

export const FORMAT = "cdpr-explorer/1";
const MEMORY = 200;
// Most rows of a trajectory that a link holds; a saved state holds all.
const LINKED = 60;
const COORDINATES = ["x", "y", "z", "roll", "pitch", "yaw"];

// Values of fields of which not every one of their kind will do.
const CHOICES = {
  normal: (value) => ["x", "y", "z"].includes(value),
  quantity: (value) => QUANTITIES.some(([field]) => field === value),
  cells: (value) => Number.isInteger(value) && value >= 2 && value <= 200,
  reference: (value) => value === null || value === "mid" || Number.isFinite(value),
  points: arePoints,
};

/**
 * The state that a robot is first shown in.
 * @param {object} robot answer to `describe`
 */
export function initial(robot) {
  const { pose = [0, 0, 0, 1, 0, 0, 0], payload = 0, lengths = null, ...wrench } = robot.start ?? {};
  return {
    format: FORMAT,
    robot: robot.name,
    way: lengths ? "kept" : "pose",
    ...placeOf(pose),
    lengths,
    cables: robot.cables,
    payload,
    force: wrench.force ?? [0, 0, 0],
    moment: wrench.moment ?? [0, 0, 0],
    free: robot.free ?? [],
    changes: {
      modulus: 1,
      density: 1,
      reference: scalarReference(robot.reference),
      least: null,
      greatest: null,
      points: {},
    },
    tolerances: {},
    observations: robot.study ? firstSampling(robot.study).observations : 2048,
    view: { sag: 1, deflection: 0, motion: "still", ghost: true, names: true },
    trajectory: [],
    slice: { shown: false, normal: "z", at: rounded(pose[2], 6), quantity: "deflection_mm", cells: 33 },
    pins: [null, null],
  };
}

/**
 * A saved state on top of the first one. Fields of another kind than they should have are left out.
 * @param {object|null} saved
 * @param {object} first
 * @returns {{state: object, refused: string[]}} with the names of the fields that were left out
 */
export function restore(saved, first) {
  const refused = [];
  if (saved === null || saved === undefined) return { state: structuredClone(first), refused };
  if (saved.format !== undefined && saved.format !== FORMAT) {
    return { state: structuredClone(first), refused: [`format ${String(saved.format)}`] };
  }
  const state = structuredClone(first);
  for (const [field, value] of Object.entries(saved)) {
    if (["format", "robot", "cables"].includes(field)) continue;
    if (field in first && alike(value, first[field], field)) {
      const nested = ["changes", "view", "slice"].includes(field);
      state[field] = nested ? { ...first[field], ...known(value, first[field], first.cables) } : value;
    } else refused.push(field);
  }
  if (state.lengths?.length !== first.cables) state.lengths = null;
  if (state.lengths === null) state.way = "pose";
  return { state, refused };
}

/**
 * The state as a link holds it: the fields that differ from the first state, as base64url of JSON, without a
 * long trajectory.
 */
export function encode(state, first) {
  const saved = { format: FORMAT };
  for (const field of Object.keys(first)) {
    if (field === "trajectory" && state.trajectory.length > LINKED) continue;
    if (JSON.stringify(state[field]) !== JSON.stringify(first[field])) saved[field] = state[field];
  }
  const bytes = new TextEncoder().encode(JSON.stringify(saved));
  const text = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/**
 * The saved state of a link.
 * @param {string} hash such as `#state=..`
 * @returns {object|null} null where the link holds no state that can be read
 */
export function decode(hash) {
  const [, text] = hash.match(/state=([A-Za-z0-9_-]+)/) ?? [];
  if (text === undefined) return null;
  try {
    const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    const saved = JSON.parse(
      new TextDecoder().decode(Uint8Array.from(binary, (letter) => letter.charCodeAt(0))),
    );
    return saved !== null && typeof saved === "object" && !Array.isArray(saved) ? saved : null;
  } catch {
    return null;
  }
}

/** Holds the state, its steps of undo, and who wants to hear of changes. */
export class Store {
  #listeners = new Set();
  #past = [];
  #future = [];
  #kept;

  /** @param {object} state */
  constructor(state) {
    this.state = state;
    this.#kept = state;
  }

  /**
   * Changes fields of the state; `commit` makes a step of undo of it.
   * @param {object} patch
   * @param {{commit?: boolean, quiet?: boolean}} [options] `quiet` for what follows from an answer
   */
  set(patch, { commit = false, quiet = false } = {}) {
    const before = this.state;
    this.state = { ...this.state, ...patch };
    if (!quiet) this.#tell(before);
    if (commit) this.commit();
  }

  /** Makes a step of undo of all changes since the last one. */
  commit() {
    if (JSON.stringify(this.state) === JSON.stringify(this.#kept)) return;
    this.#past.push(this.#kept);
    if (this.#past.length > MEMORY) this.#past.shift();
    this.#future = [];
    this.#kept = this.state;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  undo() {
    this.#step(this.#past, this.#future);
  }

  redo() {
    this.#step(this.#future, this.#past);
  }

  /** @param {function(object, object, boolean): void} listener state, state before, whether undo or redo */
  listen(listener) {
    this.#listeners.add(listener);
  }

  #step(from, to) {
    if (from.length === 0) return;
    const before = this.state;
    to.push(this.#kept);
    this.#kept = from.pop();
    this.state = this.#kept;
    this.#tell(before, true);
  }

  #tell(before, stepped = false) {
    for (const listener of this.#listeners) listener(this.state, before, stepped);
  }
}

// A list of tensions stays in the robot and study files: the page has one level for all cables.
function scalarReference(reference) {
  return typeof reference === "number" || reference === "mid" ? reference : null;
}

function alike(value, first, field) {
  if (field === "lengths") return value === null || numbers(value);
  if (field === "pins")
    return Array.isArray(value) && value.length === 2 && value.every((pin) => !pin || isPin(pin));
  if (field === "way") return value === "pose" || value === "kept";
  if (field === "free") return Array.isArray(value) && value.every((name) => COORDINATES.includes(name));
  if (field === "trajectory") return areRows(value);
  if (field === "tolerances") return isObject(value) && Object.values(value).every((factor) => factor >= 0);
  if (Array.isArray(first)) return numbers(value) && value.length === first.length;
  if (typeof first === "number") return Number.isFinite(value);
  return isObject(value) === isObject(first) && typeof value === typeof first;
}

function isObject(value) {
  return value !== null && typeof value === "object" && !Array.isArray(value);
}

function isPin({ position, rpy_deg, force, moment, tensions, lengths }) {
  const threes = [position, rpy_deg, force, moment].every((list) => numbers(list) && list.length === 3);
  return threes && numbers(tensions) && tensions.length === 2 && (lengths === null || numbers(lengths));
}

function numbers(list) {
  return Array.isArray(list) && list.every(Number.isFinite);
}

// The fields of a part of the state whose values are such as they can have.
function known(value, first, cables) {
  const fits = (name, inner) => {
    if (!(name in first)) return false;
    if (name in CHOICES) return CHOICES[name](inner, cables);
    if (first[name] === null) return inner === null || Number.isFinite(inner);
    return typeof inner === "number"
      ? Number.isFinite(inner) && typeof first[name] === "number"
      : typeof inner === typeof first[name];
  };
  return Object.fromEntries(Object.entries(value).filter(([name, inner]) => fits(name, inner)));
}
