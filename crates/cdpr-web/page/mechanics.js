// Where the platform stands: asks for the state on screen, one question at a time, the newest next.

import { placeOf, quaternion, vectorBetween } from "./rotation.js";

const NONE = { payload: 0, force: [0, 0, 0], moment: [0, 0, 0] };

/** The wanted pose of a state, as the engine has it. */
export function poseOf({ position, rpy_deg }) {
  return [...position, ...quaternion(rpy_deg)];
}

/** The load of a state. */
export function loadOf({ payload, force, moment }) {
  return { payload, force, moment };
}

export class Mechanics {
  /** What is shown: the last state that was found. */
  picture = null;
  /** Why the wanted pose has no picture: {kind, reason}. */
  failure = null;
  /** The last jump to another equilibrium. */
  jump = null;
  /** Force and moment of the hand, with the lengths kept. */
  pull = { force: [0, 0, 0], moment: [0, 0, 0] };
  busy = false;
  #again = false;
  #anchor = null;

  /**
   * @param {import("./engine.js").Engine} engine
   * @param {import("./state.js").Store} store
   * @param {function(): void} told hears of every answer
   */
  constructor(engine, store, told) {
    this.engine = engine;
    this.store = store;
    this.told = told;
  }

  /** Asks for the state as it is now. `restart` where it does not follow from the last one, as in undo. */
  update({ restart = false } = {}) {
    if (restart) this.#anchor = null;
    if (this.busy) this.#again = true;
    else this.#run();
  }

  /** Keeps the lengths of what is shown from now on. */
  keep() {
    if (!this.picture) return;
    const { lengths, loaded } = this.picture;
    this.failure = null;
    this.#anchor = { lengths, load: loadOf(this.store.state), pose: loaded.pose };
    this.store.set({ way: "kept", lengths, ...placeOf(loaded.pose) }, { commit: true });
  }

  /** Sets the lengths for the pose from now on, without the load. */
  renew() {
    const pose = this.picture?.unloaded?.pose ?? this.picture?.loaded.pose;
    this.jump = null;
    this.store.set({ way: "pose", lengths: null, ...(pose ? placeOf(pose) : {}) }, { commit: true });
  }

  forgetJump() {
    this.jump = null;
    this.told();
  }

  async #run() {
    this.busy = true;
    do {
      this.#again = false;
      const { state } = this.store;
      await (state.way === "kept" && state.lengths ? this.#follow(state) : this.#hold(state));
      this.told();
    } while (this.#again);
    this.busy = false;
    this.told();
  }

  async #hold(state) {
    const pose = poseOf(state);
    const {
      answers: [answer],
      milliseconds,
    } = await this.engine.ask("pose", [{ hold: { pose, load: loadOf(state), free: state.free } }]);
    if (answer.error) return this.#fail(answer.error, pose);
    this.failure = null;
    this.picture = { ...answer.ok, milliseconds, way: "pose" };
    this.#take(state);
    this.#anchor = null;
  }

  // Coordinates that are found are where the next search begins.
  #take({ position, rpy_deg, free }) {
    if (free.length === 0 || this.store.state.way !== "pose") return;
    const found = placeOf(this.picture.unloaded.pose);
    const mixed = (now, names, values) =>
      now.map((value, k) => (free.includes(names[k]) ? values[k] : value));
    const place = {
      position: mixed(position, ["x", "y", "z"], found.position),
      rpy_deg: mixed(rpy_deg, ["roll", "pitch", "yaw"], found.rpy_deg),
    };
    const { state } = this.store;
    if (state.position === position && state.rpy_deg === rpy_deg) this.store.set(place, { quiet: true });
  }

  // The lengths are kept: from where the platform is, lengths and load change to those of the state.
  async #follow(state) {
    const load = loadOf(state);
    for (const part of ["force", "moment"])
      load[part] = load[part].map((value, k) => value + this.pull[part][k]);
    const { lengths } = state;
    const anchor = this.#anchor;
    const start = anchor?.pose ?? poseOf(state);
    const free = { stand: { lengths, load: NONE, start: this.picture?.unloaded?.pose ?? start } };
    const ask = anchor
      ? { wind: { lengths: [anchor.lengths, lengths], load: [anchor.load, load], start } }
      : { stand: { lengths, load, start } };
    const {
      answers: [answer, alone],
      milliseconds,
    } = await this.engine.ask("pose", [ask, free]);
    if (answer.error) return this.#fail(answer.error, null);
    const way = answer.ok;
    if (anchor && way.jumps.length > 0) this.#mark(way);
    else if (this.jump?.after === null) this.jump = null;
    const found = anchor ? way.state : way;
    if (!found)
      return this.#fail(
        { kind: way.jumps.at(-1)?.kind ?? "lost", reason: way.reason ?? "the equilibrium is lost" },
        null,
      );
    this.failure = null;
    const unloaded = alone.ok ?? null;
    this.picture = {
      loaded: found,
      unloaded,
      lengths,
      limits: null,
      milliseconds,
      way: "kept",
      ...between(unloaded, found),
    };
    this.#anchor = { lengths, load, pose: found.pose };
    if (this.store.state.way === "kept") this.store.set(placeOf(found.pose), { quiet: true });
  }

  #mark({ jumps, path }) {
    const { before, after, kind, share } = jumps.at(-1);
    this.jump = {
      kind,
      share,
      count: jumps.length,
      path,
      before: before.pose.slice(0, 3),
      after: after?.pose.slice(0, 3) ?? null,
      lengths: before.cables.map((cable) => cable.length),
    };
  }

  #fail(error, wanted) {
    this.failure = { ...error, wanted };
  }
}

// Displacements [m] and rotations [rad] below it are rounding errors of two equilibria.
const ROUNDING = 1e-9;

/** How the load moves the platform from one equilibrium to the other: exactly nothing up to rounding errors. */
export function between(unloaded, loaded) {
  if (!unloaded) return { displacement: null, rms: null, rotation: null };
  const beyond = (vector) => (Math.hypot(...vector) < ROUNDING ? [0, 0, 0] : vector);
  const displacement = beyond([0, 1, 2].map((k) => loaded.pose[k] - unloaded.pose[k]));
  const rotation = beyond(vectorBetween(unloaded.pose.slice(3), loaded.pose.slice(3)));
  return { displacement, rms: Math.hypot(...displacement), rotation };
}
