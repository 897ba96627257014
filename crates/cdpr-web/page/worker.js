// A worker: one live robot, which answers one batch of questions after the other.
// Messages: {module} once; then {id, version, robot, asks}, `robot` only where it has changed. The answer is
// {id, answers, milliseconds}, and {ready} or {broken} after the module.

import { initSync, Live } from "./pkg/cdpr_web.js";

let live = null;
let version = -1;
let refused = null;

self.onmessage = ({ data }) => {
  if (data.module) return start(data.module);
  const begin = performance.now();
  const answers = answer(data);
  self.postMessage({ id: data.id, answers, milliseconds: performance.now() - begin });
};

function start(module) {
  try {
    initSync({ module });
    self.postMessage({ ready: true });
  } catch (error) {
    self.postMessage({ broken: String(error?.message ?? error) });
  }
}

function answer({ version: wanted, robot, asks }) {
  if (wanted !== version) {
    live?.free();
    live = null;
    refused = null;
    try {
      live = new Live(robot);
    } catch (error) {
      refused = { error: { kind: "robot", reason: String(error?.message ?? error) } };
    }
    version = wanted;
  }
  const answers = [];
  for (const ask of asks) answers.push(refused ?? one(ask.effects === "batch" ? effectsOf(answers) : ask));
  return answers;
}

// The question for the effects of the replicates that this batch has observed.
function effectsOf(answers) {
  return {
    effects: {
      of: answers
        .slice(2)
        .map((answer) => answer.ok?.effects)
        .filter(Boolean),
    },
  };
}

function one(ask) {
  try {
    return JSON.parse(live.ask(JSON.stringify(ask)));
  } catch (error) {
    // A trap of the module leaves it in an unknown state: the next batch makes a new robot.
    version = -1;
    return { error: { kind: "module", reason: `the module failed: ${String(error?.message ?? error)}` } };
  }
}
