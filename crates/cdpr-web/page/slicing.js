// A slice of the workspace that fills in row by row.

import { STALE } from "./engine.js";
import { floorOf } from "./geometry.js";
import { loadOf } from "./mechanics.js";
import { quaternion } from "./rotation.js";
import { emptyCells, fill, plane, rowOrder } from "./slices.js";

export class Slicing {
  plane = null;
  cells = null;
  failure = null;
  #key = "";

  /**
   * @param {import("./engine.js").Engine} engine
   * @param {object} robot answer to `describe`
   * @param {function(): void} told
   */
  constructor(engine, robot, told) {
    this.engine = engine;
    this.robot = robot;
    this.told = told;
    this.floor = floorOf(robot);
  }

  get filling() {
    return this.cells !== null && this.cells.done < this.cells.held.length && !this.failure;
  }

  /** Asks for the slice of a state, if it shows one. */
  update(state, version) {
    const { shown, normal, at, cells } = state.slice;
    const key = shown
      ? JSON.stringify([normal, at, cells, state.rpy_deg, loadOf(state), state.free, state.changes, version])
      : "";
    if (key === this.#key) return;
    this.#key = key;
    this.engine.drop("slice");
    this.failure = null;
    this.plane = shown ? plane(state.slice, this.robot.exits, this.floor) : null;
    if (this.plane && (this.plane.u[2] < 2 || this.plane.v[2] < 2)) {
      this.failure = {
        reason: `the exit points have no extent in the plane across ${normal}: choose another plane`,
      };
      this.plane = null;
    }
    this.cells = this.plane ? emptyCells(this.plane) : null;
    if (this.plane) this.#ask(state);
    this.told();
  }

  #ask(state) {
    const { plane: asked, cells } = this;
    const { normal, at, u, v } = asked;
    for (const row of rowOrder(v[2])) {
      const slice = {
        normal,
        at,
        quaternion: quaternion(state.rpy_deg),
        u,
        v,
        rows: [row, row + 1],
        load: loadOf(state),
        free: state.free,
      };
      this.engine.ask("slice", [{ slice }]).then((answer) => {
        if (answer === STALE || this.cells !== cells) return;
        const [{ ok, error }] = answer.answers;
        if (error) {
          this.failure = error;
          this.engine.drop("slice");
        } else fill(cells, row, ok);
        this.told();
      });
    }
  }
}
