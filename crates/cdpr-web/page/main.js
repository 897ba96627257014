// The explorer: `mount` puts the live page of a robot into an element.

import { App } from "./app.js";
import { h } from "./dom.js";
import { Engine, workerCount } from "./engine.js";
import { ofStudy } from "./robot.js";

export { still } from "./still.js";

const ADVICE =
  "It needs a browser with WebAssembly and workers, such as Firefox, Chrome, Edge or Safari of 2023 " +
  "or later. The program gives the same numbers: cdpr deflection --help.";

/**
 * @param {HTMLElement} element
 * @param {{robot: object, study?: object|null, state?: object|null, pose?: number[]|null,
 *   module: ArrayBuffer, worker: string, name?: string, embedded?: boolean}} options
 *   `robot`: content of a robot file; `study`: a study file whose sampling `all` takes the place of the
 *   template's; `state`: a saved state; `pose`: where the platform is shown first; `module`: bytes of the
 *   WebAssembly module; `worker`: source text of worker.js; `name`: name of the robot file in commands;
 *   `embedded`: part of another page, which has the address, the headings and the height
 * @returns {{getState: function(): object|null, setState: function(object): void, dispose: function(): void,
 *   ready: Promise<void>}}
 */
export function mount(
  element,
  { robot, study = null, state = null, pose = null, module, worker, name = "robot.json", embedded = false },
) {
  let app = null;
  let engine = null;
  let waiting = null;
  let gone = false;
  const fail = (reason) => {
    if (!gone && app === null)
      element.replaceChildren(message(`The live robot does not run here: ${reason}.`, ADVICE));
  };
  element.classList.add("cdprx");
  element.replaceChildren(h("p", { class: "loading", role: "status" }, "The models are loading …"));
  const ready = start().catch((error) => fail(String(error?.message ?? error)));
  return {
    ready,
    getState: () => app?.getState() ?? null,
    setState: (saved) => {
      if (app) app.setState(saved);
      else waiting = saved;
    },
    dispose: () => {
      gone = true;
      if (app) app.dispose();
      else engine?.dispose();
    },
  };

  async function start() {
    if (typeof WebAssembly !== "object") throw new Error("this browser has no WebAssembly");
    const compiled = await WebAssembly.compile(module);
    const address = URL.createObjectURL(new Blob([worker], { type: "text/javascript" }));
    engine = new Engine(
      () => new Worker(address),
      workerCount(navigator.hardwareConcurrency),
      compiled,
      fail,
    );
    engine.setRobot(JSON.stringify(robot));
    const {
      answers: [answer],
    } = await engine.ask("pose", [{ describe: {} }]);
    URL.revokeObjectURL(address);
    if (gone) return engine.dispose();
    if (answer.error) {
      engine.dispose();
      return element.replaceChildren(message(`This robot cannot be shown: ${answer.error.reason}.`));
    }
    const described = { ...answer.ok, ground_z: robot.ground_z, ...(study ? ofStudy(study) : {}) };
    if (pose) described.start = { ...described.start, pose };
    app = new App(element, {
      engine,
      robot: described,
      file: robot,
      name,
      saved: waiting ?? state,
      embedded,
    });
  }
}

function message(...sentences) {
  return h("div", { class: "failure", role: "alert" }, ...sentences.map((sentence) => h("p", {}, sentence)));
}
