import assert from "node:assert/strict";
import { test } from "node:test";
import { Engine, STALE, workerCount } from "../engine.js";
import { Live } from "./mock-live.js";

// A worker that answers when it is told to.
class Worker {
  constructor() {
    this.messages = [];
  }

  postMessage(message) {
    if (message.module) queueMicrotask(() => this.onmessage({ data: { ready: true } }));
    else this.messages.push(message);
  }

  answer(...answers) {
    const { id } = this.messages.shift();
    this.onmessage({ data: { id, answers, milliseconds: 1 } });
  }

  terminate() {
    this.gone = true;
  }
}

async function engineOf(count) {
  const workers = [];
  const failures = [];
  const make = () => workers[workers.push(new Worker()) - 1];
  const engine = new Engine(make, count, "module", (reason) => failures.push(reason));
  engine.setRobot("robot 1");
  await Promise.resolve();
  return { engine, workers, failures };
}

test("the first worker serves the pose alone", async () => {
  const { engine, workers } = await engineOf(2);
  engine.ask("observe", [1]);
  engine.ask("observe", [2]);
  assert.deepEqual(
    workers.map((worker) => worker.messages.length),
    [0, 1],
  );
  engine.ask("pose", [3]);
  assert.deepEqual(workers[0].messages[0].asks, [3]);
});

test("the last of three takes slices before observations", async () => {
  const { engine, workers } = await engineOf(3);
  engine.ask("observe", ["a"]);
  engine.ask("observe", ["b"]);
  engine.ask("observe", ["c"]);
  engine.ask("slice", ["s"]);
  workers[2].answer("b is answered");
  assert.deepEqual(workers[2].messages[0].asks, ["s"]);
});

test("a newer question makes the older ones of its lane stale", async () => {
  const { engine, workers } = await engineOf(2);
  const [first, second] = [engine.latest("observe", [1]), engine.latest("observe", [2])];
  const third = engine.latest("observe", [3]);
  workers[1].answer("one");
  workers[1].answer("three");
  assert.equal(await first, STALE);
  assert.equal(await second, STALE);
  assert.deepEqual((await third).answers, ["three"]);
});

test("a robot is sent to each worker once", async () => {
  const { engine, workers } = await engineOf(2);
  const robots = [];
  for (const robot of [null, null, "robot 2", null]) {
    if (robot) engine.setRobot(robot);
    engine.ask("pose", []);
    robots.push(workers[0].messages[0].robot);
    workers[0].answer();
  }
  assert.deepEqual(robots, ["robot 1", undefined, "robot 2", undefined]);
});

test("a module that does not start is told", async () => {
  const { workers, failures } = await engineOf(1);
  workers[0].onmessage({ data: { broken: "no memory" } });
  assert.deepEqual(failures, ["no memory"]);
});

test("what is left is stale once the engine is gone", async () => {
  const { engine, workers } = await engineOf(2);
  engine.ask("observe", [1]);
  const left = engine.ask("observe", [2]);
  engine.dispose();
  assert.equal(await left, STALE);
  assert.ok(workers.every((worker) => worker.gone));
});

test("a machine with one core has a worker for the pose and one for the rest", () => {
  assert.deepEqual([undefined, 1, 2, 7, 64].map(workerCount), [2, 2, 3, 8, 8]);
});

test("the stand-in answers every question of the page", () => {
  const cables = [
    [1, 1, 2],
    [-1, 1, 2],
    [0, -1, 2],
  ].map((exit_point) => ({ exit_point, anchor_point: [0, 0, 0.1] }));
  const live = new Live(
    JSON.stringify({ name: "r", cables, platform: { mass: 1 }, tension_limits: { min: 1, max: 9 } }),
  );
  const ask = (question) => JSON.parse(live.ask(JSON.stringify(question)));
  const { start } = ask({ describe: {} }).ok;
  assert.equal(ask({ hold: { pose: start.pose } }).ok.loaded.cables.length, 3);
  assert.equal(ask({ hold: { pose: [0, 0, 5, 1, 0, 0, 0] } }).error.kind, "infeasible_tension");
});
