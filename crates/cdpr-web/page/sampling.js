// Observations of perturbed robots at the pose on screen: a coarse design while it moves, all of it at rest.

import { summary } from "./charts/statistics.js";
import { studyOf, tolerances } from "./robot.js";

const COARSE = 256;
const REST = 200;

export class Sampling {
  /** {summary, nominal, failed, milliseconds, coarse, key} of the last observations. */
  sample = null;
  /** {inputs, confidence, replicates, coarse, key} of the last effects. */
  effects = null;
  failure = null;
  busy = false;
  #wanted = null;
  #timer = 0;

  /**
   * @param {import("./engine.js").Engine} engine
   * @param {object} study of the template, or null
   * @param {function(): void} told
   */
  constructor(engine, study, told) {
    this.engine = engine;
    this.study = study;
    this.told = told;
  }

  /** Observes at a state. `version` changes with the robot. */
  update(state, version) {
    if (!this.study) return;
    const { position, rpy_deg, payload, free, tolerances: factors, observations, changes } = state;
    const key = JSON.stringify([position, rpy_deg, payload, free, factors, observations, changes, version]);
    if (key === this.#wanted?.key) return;
    this.#wanted = { key, state, since: performance.now() };
    if (!this.busy) this.#run();
  }

  /** Whether what is shown is of the state on screen. */
  get current() {
    return this.sample?.key === this.#wanted?.key && !this.sample?.coarse;
  }

  dispose() {
    clearTimeout(this.#timer);
  }

  async #run() {
    this.busy = true;
    let done = null;
    while (this.#wanted && done !== this.#wanted) {
      const wanted = this.#wanted;
      const resting = performance.now() - wanted.since > REST;
      if (!resting && (await this.#coarse(wanted)) && this.#wanted === wanted) await this.#pause();
      if (this.#wanted !== wanted) continue;
      await this.#full(wanted);
      done = wanted;
      this.told();
    }
    this.busy = false;
    this.told();
  }

  #pause() {
    return new Promise((resolve) => {
      this.#timer = setTimeout(resolve, REST);
    });
  }

  #text(state, observations) {
    return { study: { text: studyOf(this.study, state, { robot: "robot.json", observations }) } };
  }

  // All in one batch of one worker: it returns soon, and a newer pose waits for nothing else.
  async #coarse({ key, state }) {
    if (this.#nothing(key, state)) return false;
    const asks = [
      this.#text(state, Math.min(COARSE, state.observations)),
      ...observe(0, 1, 2),
      { effects: "batch" },
    ];
    const {
      answers: [set, first, , , effects],
      milliseconds,
    } = await this.engine.ask("observe", asks);
    if (!this.#take(key, set, first, milliseconds, true)) return false;
    if (effects.ok) this.effects = { ...effects.ok, coarse: true, key };
    this.told();
    return true;
  }

  async #full({ key, state }) {
    if (this.#nothing(key, state)) return;
    const text = this.#text(state, state.observations);
    const ask = (replicate) => this.engine.ask("observe", [text, ...observe(replicate)]);
    const begin = performance.now();
    const {
      answers: [set, first],
    } = await ask(0);
    if (!this.#take(key, set, first, performance.now() - begin, false)) return;
    this.told();
    if (this.#wanted.key !== key) return;
    const count = Math.max(2, this.study.replicates);
    const parts = await Promise.all(Array.from({ length: count }, (_, k) => ask(k + 1)));
    const of = parts.map(({ answers: [, part] }) => part.ok?.effects).filter(Boolean);
    if (of.length < 2) {
      this.effects = null;
      this.failure = parts.map(({ answers: [, part] }) => part.error).find(Boolean) ?? {
        kind: "too_few",
        reason: "too few observations have a deflection",
      };
      return;
    }
    const {
      answers: [, effects],
    } = await this.engine.ask("observe", [text, { effects: { of } }]);
    if (effects.ok) this.effects = { ...effects.ok, coarse: false, key };
    else this.failure = effects.error;
  }

  #nothing(key, state) {
    const factors = Object.keys(tolerances(this.study)).map((entry) => state.tolerances[entry] ?? 1);
    const reason =
      state.payload === 0
        ? "there is no payload, so there is no deflection to observe: set a payload"
        : factors.every((factor) => factor === 0)
          ? "all tolerances are zero, so nothing deviates"
          : null;
    if (reason === null) return false;
    this.failure = { kind: "nothing", reason };
    this.sample = null;
    this.effects = null;
    this.told();
    return true;
  }

  #take(key, set, observed, milliseconds, coarse) {
    const { error } = set.error ? set : observed;
    if (error) {
      this.failure = error;
      this.told();
      return false;
    }
    this.failure = null;
    const { values_mm, failed, nominal_mm } = observed.ok;
    this.sample = {
      summary: summary(values_mm),
      nominal: nominal_mm,
      failed,
      milliseconds,
      coarse,
      key,
      observations: values_mm.length,
    };
    return true;
  }
}

function observe(...replicates) {
  return replicates.map((replicate) => ({ observe: { replicate } }));
}
