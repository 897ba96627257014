// The address of the page: it follows the state, so that it can be copied at any time.

import { encode } from "./state.js";

// Least time between two addresses [ms]: browsers refuse more than 100 in 30 s.
const OFTEN = 350;

export class Address {
  #timer = 0;
  #written = -Infinity;

  /**
   * @param {import("./state.js").Store} store
   * @param {object} first the first state, which the address leaves out
   */
  constructor(store, first) {
    this.store = store;
    this.first = first;
  }

  /** The address of the page in its state. */
  get link() {
    return `${location.href.split("#")[0]}#${this.#hash}`;
  }

  /** Writes the state into the address: at once, but a few times a second while a hand moves. */
  write() {
    clearTimeout(this.#timer);
    const rest = this.#written + OFTEN - performance.now();
    if (rest > 0) {
      this.#timer = setTimeout(() => this.write(), rest);
      return;
    }
    this.#written = performance.now();
    try {
      history.replaceState(history.state, "", `#${this.#hash}`);
    } catch {
      // A page without an address of its own, such as a frame of a notebook, has no link.
    }
  }

  dispose() {
    clearTimeout(this.#timer);
  }

  get #hash() {
    return `state=${encode(this.store.state, this.first)}`;
  }
}
