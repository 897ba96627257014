// What keys, buttons and handles do to the platform.

import { pointOf, withPoint } from "./robot.js";
import { timed, withoutTensions } from "./trajectory/track.js";
import { placeOf, rounded, turned, turnedAngles, vectorBetween } from "./rotation.js";

const AXES = ["x", "y", "z"];
const ANGLES = ["roll", "pitch", "yaw"];

/** Keys that move the platform: axis of the base frame and direction. */
export const KEYS = {
  ArrowLeft: [0, -1],
  ArrowRight: [0, 1],
  ArrowDown: [1, -1],
  ArrowUp: [1, 1],
  PageDown: [2, -1],
  PageUp: [2, 1],
};

export class Moves {
  /**
   * @param {{store: object, robot: object, mechanics: object, size: number}} app
   */
  constructor(app) {
    this.app = app;
    this.step = nice(app.size / 300);
    this.degrees = 1;
    this.newtons = niceForce(app.robot.mass);
    this.keepForce = false;
    this.taken = null;
  }

  /** One step along or about an axis. With the lengths kept the load changes instead of the pose. */
  nudge(axis, sign, turn = false, factor = 1) {
    const { store, robot } = this.app;
    const { state } = store;
    if (robot.held.includes((turn ? ANGLES : AXES)[axis])) return;
    if (state.way === "kept") {
      const name = turn ? "moment" : "force";
      const step = (turn ? this.newtons * this.app.arm : this.newtons) * factor;
      store.set(
        { [name]: state[name].map((value, k) => (k === axis ? rounded(value + sign * step, 6) : value)) },
        { commit: true },
      );
    } else if (turn) {
      const angles = turnedAngles(state.rpy_deg, axis, sign * this.degrees * factor);
      store.set({ rpy_deg: angles.map((angle) => rounded(angle, 5)) }, { commit: true });
    } else {
      const position = state.position.map((value, k) =>
        k === axis ? rounded(value + sign * this.step * factor, 6) : value,
      );
      store.set({ position: this.#above(position) }, { commit: true });
    }
  }

  /** Goes to a position, with the lengths set for it. */
  goto(position) {
    const { store, mechanics } = this.app;
    if (store.state.way === "kept") mechanics.renew();
    store.set({ position: position.map((value) => rounded(value, 6)) }, { commit: true });
  }

  /** Adds a point to the trajectory, and goes there. */
  waypoint(place) {
    const { store, mechanics, robot, speed, arm } = this.app;
    if (store.state.way === "kept") mechanics.renew();
    const { state } = store;
    const kept = place.map((value, k) =>
      robot.held.includes(AXES[k]) || state.free.includes(AXES[k]) ? state.position[k] : value,
    );
    const position = this.#above(kept.map((value) => rounded(value, this.#decimals)));
    const row = (at) => [0, ...at, ...state.rpy_deg];
    const before = state.trajectory.length > 0 ? withoutTensions(state.trajectory) : [row(state.position)];
    const isSame = JSON.stringify(before.at(-1).slice(1)) === JSON.stringify(row(position).slice(1));
    this.app.speedCounts = true;
    // The platform goes to the end.
    this.app.player.time = Infinity;
    const trajectory = timed(isSame ? before : [...before, row(position)], speed, arm);
    store.set({ trajectory, position }, { commit: true });
  }

  /** A hand on the handles of the view. */
  grab(phase, pose) {
    const { store, mechanics } = this.app;
    const { state } = store;
    if (phase === "begin") this.taken = { pose: mechanics.picture?.loaded.pose ?? pose, state };
    if (state.way === "pose") {
      if (phase === "move") store.set(this.#moved(pose, this.taken.state));
      if (phase === "end") store.commit();
      return;
    }
    if (phase === "move") this.#pull(pose);
    if (phase === "end") this.#release();
  }

  /** A hand on the handles of the chosen exit or anchor point. */
  grabPoint(phase, place) {
    const { store, mechanics, robot, point } = this.app;
    if (phase === "begin") {
      const { pose } = mechanics.picture.loaded;
      this.taken = { place, from: pointOf(robot, point), pose: point.startsWith("a") ? pose : null };
    }
    if (phase === "end") store.commit();
    if (phase !== "move") return;
    const { from, pose, place: begin } = this.taken;
    let step = place.map((value, k) => value - begin[k]);
    if (pose) step = turned([pose[3], -pose[4], -pose[5], -pose[6]], step);
    const now = from.map((value, k) =>
      Math.abs(step[k]) < 1e-6 ? value : rounded(value + step[k], this.#decimals),
    );
    store.set({ changes: withPoint(store.state.changes, point, now) });
  }

  // Decimals of lengths [m] that a hand sets: those that the size of the robot asks for.
  get #decimals() {
    return Math.max(0, 4 - Math.floor(Math.log10(this.app.size)));
  }

  // What the hand has moved, with a few digits; the rest is as it was.
  #moved(pose, { position, rpy_deg }) {
    const place = placeOf(pose);
    const kept = (now, before, digits) =>
      now.map((value, k) => (Math.abs(value - before[k]) < 1e-4 ? before[k] : rounded(value, digits)));
    return {
      position: this.#above(kept(place.position, position, this.#decimals)),
      rpy_deg: kept(place.rpy_deg, rpy_deg, 2),
    };
  }

  // A position that is not below the ground, nor lower than the platform already is.
  #above([x, y, z]) {
    const { ground, store } = this.app;
    return [x, y, ground === null ? z : Math.max(z, Math.min(ground, store.state.position[2]))];
  }

  // The hand pulls with a force in proportion to its way from where it took the platform.
  #pull(pose) {
    const { mechanics, size, arm } = this.app;
    const stiffness = (10 * this.newtons) / (0.1 * size);
    mechanics.pull.force = [0, 1, 2].map((k) => rounded((pose[k] - this.taken.pose[k]) * stiffness, 3));
    mechanics.pull.moment = vectorBetween(this.taken.pose.slice(3), pose.slice(3)).map((angle) =>
      rounded(angle * 10 * this.newtons * arm, 3),
    );
    mechanics.update();
  }

  #release() {
    const { store, mechanics } = this.app;
    const { force, moment } = mechanics.pull;
    mechanics.pull = { force: [0, 0, 0], moment: [0, 0, 0] };
    if (this.keepForce) {
      const { state } = store;
      store.set(
        {
          force: state.force.map((value, k) => rounded(value + force[k], 3)),
          moment: state.moment.map((value, k) => rounded(value + moment[k], 3)),
        },
        { commit: true },
      );
    } else mechanics.update();
  }
}

// The next of 1, 2, 5 times a power of ten.
function nice(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return rounded(power * [1, 2, 5, 10].find((factor) => factor * power >= value), 9);
}

// A round force of about a twentieth of the platform's weight.
function niceForce(mass) {
  return Number((10 ** Math.round(Math.log10((mass * 9.81) / 20))).toPrecision(1));
}
