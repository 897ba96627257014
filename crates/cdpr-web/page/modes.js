// Natural modes and motions of the state on screen, asked for while somebody looks at them.

import { loadOf } from "./mechanics.js";

export class Modes {
  /** The last answer, or null. */
  found = null;
  /** Why there is none of the state on screen. */
  failure = null;
  #key = "";
  #isAsked = false;

  /**
   * @param {object} app
   * @param {function(): void} told hears of every answer
   */
  constructor(app, told) {
    this.app = app;
    this.told = told;
  }

  /** Asks once the platform rests. */
  async update() {
    const { mechanics, motions, engine, store, version } = this.app;
    const { picture, failure, busy } = mechanics;
    if (!motions.wanted() || !picture || failure || busy || this.#isAsked) return;
    const { lengths, loaded } = picture;
    const load = loadOf(store.state);
    const key = JSON.stringify([lengths, load, loaded.pose, version]);
    if (key === this.#key) return;
    this.#isAsked = true;
    const {
      answers: [answer],
    } = await engine.ask("modes", [{ modes: { lengths, load, start: loaded.pose } }]);
    this.#isAsked = false;
    this.#key = key;
    this.found = answer.ok ?? this.found;
    this.failure = answer.error?.reason ?? null;
    this.told();
    this.update();
  }
}
