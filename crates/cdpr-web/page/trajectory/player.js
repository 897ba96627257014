// Tensions along the trajectory, at rest pose by pose or those in motion of the table, and the time on screen.

import { STALE } from "../engine.js";
import { loadOf } from "../mechanics.js";
import { quaternion } from "../rotation.js";
import { cablesInMotion, drawnRows, duration, poseAt, sampleTimes, tensionsAt } from "./track.js";

// Poses of a question: few, so that all workers take part.
const BATCH = 6;

export class Player {
  /** The time on screen [s], of the trajectory. */
  time = 0;
  playing = false;
  /** How much faster than the trajectory it plays. */
  factor = 1;
  /** {times, every, found, done}, of a motion {count, areInMotion} too; `found`: {tensions, limits, deflection} or
   * {failure} at each time. */
  track = null;
  /** The positions of the trajectory [m], one after the other, as many as the view draws. */
  line = [];
  #key = "";
  #rows = null;
  #frame = 0;

  /**
   * @param {object} app
   * @param {function(): void} told hears of answers and of the time
   */
  constructor(app, told) {
    this.app = app;
    this.told = told;
  }

  get rows() {
    return this.app.store.state.trajectory;
  }

  /** Asks for the tensions along the trajectory of a state, if they are other ones. */
  update(state, version) {
    const { trajectory: rows } = state;
    const key = rows.length > 1 ? JSON.stringify([loadOf(state), state.free, state.changes, version]) : "";
    if (key === this.#key && rows === this.#rows) return;
    const isOther = rows !== this.#rows;
    this.#key = key;
    this.#rows = rows;
    this.app.engine.drop("path");
    if (isOther) {
      this.pause();
      this.time = rows.length > 0 ? Math.min(Math.max(this.time, rows[0][0]), duration(rows)) : 0;
    }
    this.track = key ? this.#begun(rows) : null;
    if (isOther) {
      const every = this.track?.every ?? 1;
      this.line = rows.filter((_, k) => k % every === 0).flatMap((row) => row.slice(1, 4));
    }
    if (this.track && !this.track.areInMotion) this.#ask(state);
    this.told();
  }

  /** Whether the platform on screen is where the trajectory is at its time. */
  get isOnPath() {
    if (this.rows.length === 0) return false;
    const { position, rpy_deg } = this.app.store.state;
    return JSON.stringify(poseAt(this.rows, this.time)) === JSON.stringify({ position, rpy_deg });
  }

  /** A picture with the tensions in motion at the time on screen, where the trajectory has them. */
  inMotion(picture) {
    if (!picture || !this.track?.areInMotion || !(this.playing || this.isOnPath)) return picture;
    const tensions = tensionsAt(this.rows, this.time);
    const cables = picture.loaded.cables.map((cable, k) => ({
      ...cable,
      tension: tensions[k],
      exit_tension: null,
      limit: this.#limit(tensions[k], k),
      slack: tensions[k] <= 0,
    }));
    return { ...picture, isInMotion: true, loaded: { ...picture.loaded, cables } };
  }

  /** Goes to a time; `commit` makes a step of undo of it. */
  seek(time, commit = false) {
    const { rows, app } = this;
    if (rows.length === 0) return;
    if (app.store.state.way === "kept") app.mechanics.renew();
    this.time = Math.min(Math.max(time, rows[0][0]), duration(rows));
    app.store.set(poseAt(rows, this.time), { commit });
    this.told();
  }

  play() {
    if (this.rows.length < 2) return;
    this.playing = true;
    if (this.time >= duration(this.rows)) this.time = this.rows[0][0];
    let before = performance.now();
    const step = (now) => {
      this.seek(this.time + (this.factor * (now - before)) / 1e3);
      before = now;
      if (this.time >= duration(this.rows)) this.pause();
      else this.#frame = requestAnimationFrame(step);
    };
    this.#frame = requestAnimationFrame(step);
    this.told();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    cancelAnimationFrame(this.#frame);
    this.app.store.commit();
    this.app.rest();
    this.told();
  }

  dispose() {
    cancelAnimationFrame(this.#frame);
  }

  // A track of which nothing is computed yet, or that of a motion.
  #begun(rows) {
    const isMotion = cablesInMotion(rows) === this.app.robot.exits.length;
    if (!isMotion) return { ...sampleTimes(rows), found: [], done: 0 };
    const drawn = drawnRows(rows);
    const found = drawn.map((row) => {
      const tensions = row.slice(7);
      return { tensions, limits: tensions.map((tension, k) => this.#limit(tension, k)) };
    });
    const every = Math.ceil(rows.length / drawn.length);
    const times = drawn.map(([time]) => time);
    return { times, every, found, done: times.length, count: rows.length, areInMotion: true };
  }

  // The limit that a tension of a cable passes.
  #limit(tension, k) {
    const { robot, store } = this.app;
    const { least, greatest } = store.state.changes;
    if (tension < (least ?? robot.limits[k].min)) return "below";
    return tension > (greatest ?? robot.limits[k].max) ? "above" : null;
  }

  #ask({ trajectory: rows, free, ...state }) {
    const { track } = this;
    for (let first = 0; first < track.times.length; first += BATCH) {
      const holds = track.times.slice(first, first + BATCH).map((time) => {
        const { position, rpy_deg } = poseAt(rows, time);
        return { hold: { pose: [...position, ...quaternion(rpy_deg)], load: loadOf(state), free } };
      });
      this.app.engine.ask("path", holds).then((answer) => {
        if (answer === STALE || this.track !== track) return;
        answer.answers.forEach((one, k) => {
          track.found[first + k] = found(one);
        });
        track.done += holds.length;
        this.told();
      });
    }
  }
}

// What is kept of an answer.
function found({ ok, error }) {
  if (error) return { failure: error };
  const { cables } = ok.loaded;
  return {
    tensions: cables.map(({ tension }) => tension),
    limits: cables.map(({ limit }) => limit),
    deflection: ok.rms,
  };
}
