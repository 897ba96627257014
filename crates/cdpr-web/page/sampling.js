// Observations of perturbed robots at the pose on screen: few while it moves, more and more once it rests.

import { summary } from "./charts/statistics.js";
import { studyOf, unobserved } from "./robot.js";

// Time of the observations while the platform moves, and the longest time of one question at rest [ms].
const COARSE_TIME = 120;
const LONGEST = 2500;
const REST = 200;
const FEWEST = 16;
// Above this time [ms] effects wait until the platform rests.
const SLOW = 400;

/**
 * How many observations a question may have: a power of two for `time` [ms] at `rate` [ms each].
 * @param {number} time
 * @param {number} rate
 * @param {number} most
 */
export function affordable(time, rate, most) {
  const count = 2 ** Math.floor(Math.log2(Math.max(time / rate, 1)));
  return Math.min(most, Math.max(FEWEST, count));
}

export class Sampling {
  /** {summary, sentences, nominal, failed, milliseconds, coarse, key, observations, study} of the last
   * observations. */
  sample = null;
  /** {inputs, confidence, replicates, key, observations, variance} of the last effects, with the observations
   * of a replicate and their variance [mm²]. */
  effects = null;
  failure = null;
  busy = false;
  #wanted = null;
  #timer = 0;
  #rate = null;

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
    const reason = unobserved(this.study, state);
    const study = reason === null ? studyOf(this.study, state, { robot: "robot.json" }) : null;
    const key = JSON.stringify([reason, study, state.changes, version]);
    if (key === this.#wanted?.key) return;
    this.#wanted = { key, state, since: performance.now() };
    this.failure = null;
    // Numbers of a state that is not observed must not stay until the running question is answered.
    if (!this.#refused(state) && !this.busy) this.#run();
  }

  /** Lets what is observed be of the state before, until `update` asks again. */
  wait() {
    this.#wanted = null;
  }

  /** Whether the effects are of the state on screen. */
  get hasEffects() {
    return this.effects !== null && this.effects.key === this.#wanted?.key;
  }

  /** Whether the observations are of the state on screen. */
  get hasSample() {
    return this.sample !== null && this.sample.key === this.#wanted?.key;
  }

  /** The same, and as many as are made of it. */
  get current() {
    return this.hasSample && !this.sample.coarse;
  }

  /** The observations with their inputs, as the engine answers `table`. */
  async table() {
    const {
      answers: [set, made],
    } = await this.engine.ask("observe", [this.sample.study, { table: {} }]);
    const { ok, error } = set.error ? set : made;
    if (error) throw new Error(error.reason);
    return ok;
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
      await this.#refine(wanted);
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
    if (this.#refused(state)) return false;
    if (this.#rate === null) await this.#measure(state);
    const count = affordable(COARSE_TIME / 3, this.#rate, state.observations);
    const slow = 3 * count * this.#rate > SLOW;
    const more = slow ? [] : [...observe(1, 2), { effects: "batch" }];
    const text = this.#text(state, count);
    const asks = [text, ...observe(0), ...more];
    const {
      answers: [set, first, , , effects],
      milliseconds,
    } = await this.engine.ask("observe", asks);
    const asked = { key, study: text, coarse: true };
    if (!this.#take(asked, set, first, slow ? milliseconds : milliseconds / 3)) return false;
    if (effects?.ok) this.#keep(effects.ok, key, count);
    this.told();
    return true;
  }

  // Effects, with the variance of the observations that they were asked with.
  #keep(effects, key, observations) {
    const variance = (this.sample?.summary.std ?? 0) ** 2;
    this.effects = { ...effects, key, observations, variance };
  }

  // How long an observation takes, which nobody knows before.
  async #measure(state) {
    const asks = [this.#text(state, FEWEST), ...observe(0)];
    const { milliseconds } = await this.engine.ask("observe", asks);
    this.#rate = Math.max(milliseconds / FEWEST, 1e-3);
  }

  // As many observations as are wanted, in steps where one takes long.
  async #refine({ key, state }) {
    if (this.#refused(state)) return;
    if (this.#rate === null) await this.#measure(state);
    let count = 0;
    while (count < state.observations && this.#wanted?.key === key) {
      const time = count === 0 ? LONGEST / 10 : LONGEST;
      const next = affordable(time, this.#rate, state.observations);
      if (next <= count) break;
      count = next;
      if (!(await this.#full({ key, state }, count))) return;
    }
  }

  async #full({ key, state }, count) {
    const text = this.#text(state, count);
    const ask = (replicate) => this.engine.ask("observe", [text, ...observe(replicate)]);
    const {
      answers: [set, first],
      milliseconds,
    } = await ask(0);
    if (!this.#take({ key, study: text, coarse: false }, set, first, milliseconds)) return false;
    this.told();
    if (this.#wanted?.key !== key) return false;
    const replicates = Math.max(2, this.study.replicates);
    const parts = await Promise.all(Array.from({ length: replicates }, (_, k) => ask(k + 1)));
    if (this.#wanted?.key !== key) return false;
    const of = parts.map(({ answers: [, part] }) => part.ok?.effects).filter(Boolean);
    if (of.length < 2) {
      const error = parts.map(({ answers: [, part] }) => part.error).find(Boolean);
      this.effects = null;
      this.failure = error ?? { kind: "too_few", reason: "too few observations have a deflection" };
      return false;
    }
    const {
      answers: [, effects],
    } = await this.engine.ask("observe", [text, { effects: { of } }]);
    if (this.#wanted?.key !== key) return false;
    if (effects.ok) this.#keep(effects.ok, key, count);
    else this.failure = effects.error;
    this.told();
    return true;
  }

  #refused(state) {
    const reason = unobserved(this.study, state);
    if (reason === null) return false;
    this.failure = { kind: "unobserved", reason };
    this.sample = null;
    this.effects = null;
    this.told();
    return true;
  }

  #take(asked, set, observed, milliseconds) {
    if (this.#wanted === null || this.#refused(this.#wanted.state)) return false;
    const { error } = set.error ? set : observed;
    if (error) {
      if (asked.key === this.#wanted?.key) this.failure = error;
      this.told();
      return false;
    }
    this.failure = null;
    const { values_mm, failed, nominal_mm, sentences } = observed.ok;
    const observations = values_mm.length;
    this.#rate = Math.max(milliseconds / observations, 1e-3);
    const numbers = { summary: summary(values_mm), nominal: nominal_mm, failed, milliseconds, observations };
    this.sample = { ...numbers, sentences, ...asked };
    return true;
  }
}

function observe(...replicates) {
  return replicates.map((replicate) => ({ observe: { replicate } }));
}
