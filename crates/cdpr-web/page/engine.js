// Workers and the questions to them. A newer question of a lane replaces the older ones of that lane.

import { readable } from "./format.js";

// Lanes in the order in which they are served.
const ORDER = ["pose", "modes", "path", "observe", "slice"];

/** What a question resolves to where a newer one has taken its place. */
export const STALE = Symbol("stale");

/** How many workers a machine gets: one for the pose, and as many as cores, up to 7, for the rest. */
export function workerCount(cores) {
  return 1 + Math.min(7, Math.max(1, cores || 1));
}

/**
 * @typedef {{lane: string, generation: number, order: number, version: number, robot: string,
 *   asks: object[], resolve: function(*): void}} Task
 */

export class Engine {
  #workers = [];
  #queue = [];
  #generations = new Map();
  #version = 0;
  #robot = "";
  #next = 0;
  #fail;

  /**
   * @param {function(): Worker} makeWorker
   * @param {number} count
   * @param {WebAssembly.Module} module
   * @param {function(string): void} fail hears of a worker that does not start or breaks
   */
  constructor(makeWorker, count, module, fail) {
    this.#fail = fail;
    for (let k = 0; k < count; k++) this.#start(makeWorker(), module, k);
  }

  get workers() {
    return this.#workers.length;
  }

  /** The robot of all questions from now on, as the text of a robot file. */
  setRobot(text) {
    this.#version += 1;
    this.#robot = text;
  }

  /** Makes all questions of a lane stale. */
  drop(lane) {
    this.#generations.set(lane, this.#generation(lane) + 1);
    this.#queue = this.#queue.filter((task) => task.lane !== lane || void task.resolve(STALE));
  }

  /**
   * Asks a batch of questions, instead of all earlier ones of the lane.
   * @param {string} lane
   * @param {object[]} asks
   * @returns {Promise<{answers: object[], milliseconds: number}|typeof STALE>}
   */
  latest(lane, asks) {
    this.drop(lane);
    return this.ask(lane, asks);
  }

  /** Asks a batch of questions next to the others of the lane. */
  ask(lane, asks) {
    return new Promise((resolve) => {
      const order = ORDER.indexOf(lane);
      const task = {
        lane,
        order,
        generation: this.#generation(lane),
        asks,
        resolve,
        version: this.#version,
        robot: this.#robot,
      };
      const place = this.#queue.findIndex((other) => other.order > order);
      this.#queue.splice(place < 0 ? this.#queue.length : place, 0, task);
      this.#give();
    });
  }

  dispose() {
    for (const { worker } of this.#workers) worker.terminate();
    for (const task of this.#queue) task.resolve(STALE);
    this.#workers = [];
    this.#queue = [];
  }

  #generation(lane) {
    return this.#generations.get(lane) ?? 0;
  }

  #start(worker, module, index) {
    const entry = { worker, ready: false, task: null, version: -1, index };
    this.#workers.push(entry);
    worker.onmessage = ({ data }) => this.#hear(entry, data);
    worker.onerror = (event) => this.#fail(event.message || "a worker could not start");
    worker.postMessage({ module });
  }

  #hear(entry, data) {
    if (data.broken) return this.#fail(data.broken);
    if (data.ready) entry.ready = true;
    else {
      const { task } = entry;
      entry.task = null;
      const stale = task.generation !== this.#generation(task.lane);
      const { answers, milliseconds } = data;
      task.resolve(stale ? STALE : { answers: answers.map(inWords), milliseconds });
    }
    this.#give();
  }

  // The first worker is kept for the pose, so that nothing else holds up the hand. The last one, where there
  // are three, takes slices first, so that these fill in while observations go on.
  #give() {
    const last = this.#workers.length - 1;
    for (const entry of this.#workers) {
      if (!entry.ready || entry.task !== null) continue;
      const slice = this.#queue.findIndex((task) => task.lane === "slice");
      const any = this.#queue.findIndex((task) => entry.index > 0 || task.lane === "pose");
      const place = entry.index === last && last > 1 && slice >= 0 ? slice : any;
      if (place < 0) continue;
      const [task] = this.#queue.splice(place, 1);
      const known = entry.version === task.version;
      entry.task = task;
      entry.version = task.version;
      this.#next += 1;
      entry.worker.postMessage({
        id: this.#next,
        version: task.version,
        robot: known ? undefined : task.robot,
        asks: task.asks,
      });
    }
  }
}

// An answer whose reasons have numbers as people write them.
function inWords(answer) {
  for (const part of [answer?.error, answer?.ok]) {
    for (const field of ["reason", "start_reason"]) {
      if (typeof part?.[field] === "string") part[field] = readable(part[field]);
    }
  }
  return answer;
}
