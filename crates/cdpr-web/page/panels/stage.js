// The 3D view with its tools and legend, and the messages on what went wrong or jumped.

import { button, choice, h, setText } from "../dom.js";
import { digits, lossWords, point, short, withUnit } from "../format.js";
import { KEYS } from "../moves.js";
import { legendOf } from "./legend.js";

const KEY_WORDS =
  "Arrow keys and Page Up, Page Down move the platform, with Shift they turn it, with Alt ten steps.";

/** @param {object} app */
export function stagePanel(app) {
  const { store, mechanics, moves } = app;
  const surface = h("div", {
    class: "surface",
    tabindex: "0",
    role: "application",
    "aria-label": `3D view of ${app.robot.name}. ${KEY_WORDS}`,
  });
  const way = choice(
    "Cables",
    [
      ["pose", "lengths for the pose", "The lengths are set so that the platform has the pose you choose."],
      ["kept", "lengths kept", "The lengths stay; the platform goes where the cables hold it."],
    ],
    (value) => (value === "kept" ? mechanics.keep() : mechanics.renew()),
  );
  const handle = choice(
    "Handles",
    [
      ["translate", "move"],
      ["rotate", "turn"],
      ["points", "points"],
      ["draw", "draw", "Each click in the view adds a point to the trajectory."],
      ["off", "off"],
    ],
    (mode) => app.setHandle(mode),
  );
  handle.set("translate");
  const failure = h("div", { class: "banner warns", role: "alert", hidden: true });
  const jumpText = h("span", {});
  const jump = h(
    "div",
    { class: "banner jump", role: "alert", hidden: true },
    jumpText,
    button("Forget it", () => mechanics.forgetJump()),
  );
  const pull = h("div", { class: "banner pull", hidden: true });
  const low = h("div", { class: "banner warns", role: "status", hidden: true });
  const legend = legendOf(app);
  const looks = h(
    "div",
    { class: "tools", role: "group", "aria-label": "Camera" },
    ...[
      ["whole", () => app.view?.look("default")],
      ["top", () => app.view?.look("top")],
      ["front", () => app.view?.look("front")],
      ["side", () => app.view?.look("side")],
      ["platform", () => app.view?.toPlatform()],
    ].map(([name, act]) => button(name, act)),
    h(
      "span",
      { class: "turns" },
      button("+", () => app.view?.zoom(0.8), { "aria-label": "zoom in" }),
      button("−", () => app.view?.zoom(1.25), { "aria-label": "zoom out" }),
      button("⟲", () => app.view?.turn(-0.25), { "aria-label": "turn the view to the left" }),
      button("⟳", () => app.view?.turn(0.25), { "aria-label": "turn the view to the right" }),
    ),
  );
  const workspace = button("Workspace", () => app.toggleSlice(), {
    title: "a slice of the workspace, to see where the platform can go and to go there",
  });
  const messages = h("div", { class: "banners" }, failure, jump, low, pull);
  const picture = h("div", { class: "picture" }, surface);
  const view = h("div", { class: "view" }, picture, legend.element, looks);
  for (const kind of ["dragover", "drop"])
    view.addEventListener(kind, (event) => {
      event.preventDefault();
      const [file] = event.dataTransfer.files;
      if (kind === "drop" && file) app.openFile(file);
    });
  const element = h(
    "section",
    { class: "stage", "aria-label": "Robot" },
    h("div", { class: "stagebar" }, way.element, handle.element, workspace),
    view,
  );
  surface.addEventListener("keydown", (event) => {
    const key = KEYS[event.key];
    if (!key || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    // With Shift the keys turn about the axis in which they would move.
    moves.nudge(key[0], key[1], event.shiftKey, event.altKey ? 10 : 1);
  });
  return { element, surface, messages, update, setHandle: handle.set };

  function update() {
    const { state } = store;
    way.set(state.way);
    legend.update();
    workspace.setAttribute("aria-pressed", String(state.slice.shown));
    const failed = mechanics.failure;
    failure.hidden = !failed;
    if (failed) {
      const shown = mechanics.picture
        ? ` Picture and numbers are of the last state that was found, ${point(mechanics.picture.loaded.pose)}.`
        : "";
      setText(failure, `${notHeld(state, failed)}: ${failed.reason}.${shown}`);
    }
    element.classList.toggle("stale", Boolean(failed));
    element.classList.toggle("busy", mechanics.busy);
    const lost = mechanics.jump;
    jump.hidden = !lost;
    if (lost) setText(jumpText, jumpWords(lost));
    const ground = groundWords(app);
    low.hidden = ground === "";
    setText(low, ground);
    const size = Math.hypot(...mechanics.pull.force);
    const turn = Math.hypot(...mechanics.pull.moment);
    pull.hidden = size === 0 && turn === 0;
    setText(
      pull,
      size > 0
        ? `The hand pulls with ${withUnit(size, "N", 3)}.`
        : `The hand turns with ${withUnit(turn, "N m", 3)}.`,
    );
  }
}

// What a failure means where it does not mean that nothing was found.
const FAILURES = {
  cable_overstrained: "Beyond the strain for which the models hold",
  overstrained: "Beyond the strain for which the models hold",
  unstable: "No stable equilibrium here",
  equilibrium_lost: "The platform does not stay here",
  indifferent: "No single equilibrium here",
  not_unique: "No single equilibrium here",
  inverse_not_converged: "Tensions were found, but not the best ones",
  step_limit: "Not computed to its end",
};
const NOT_COMPUTED = ["invalid_input", "invalid_question", "invalid_robot", "robot", "module", "cable"];

/** The beginning of a sentence on why there is no picture of the state. */
export function notHeld({ way }, { kind }) {
  if (NOT_COMPUTED.includes(kind)) return "Not computed";
  return FAILURES[kind] ?? (way === "kept" ? "No equilibrium found on these lengths" : "Not held here");
}

/** What is to be said of a platform at or below the ground; empty without need. */
export function groundWords({ ground, store: { state }, mechanics: { picture } }) {
  if (ground === null) return "";
  const place = `the ground, z = ${digits(ground, 4)} m`;
  const { anchors = [], cables = [] } = picture?.loaded ?? {};
  const lowest = Math.min(...anchors.map((anchor) => anchor[2]));
  if (lowest < ground - 1e-9) return `Anchor points are below ${place}: down to z = ${digits(lowest, 4)} m.`;
  const isBelow = (value, i) => i % 3 === 2 && value < ground - 1e-9;
  const hanging = cables.flatMap(({ points }, k) => (points.some(isBelow) ? [k + 1] : []));
  if (hanging.length > 0) return `Cables that hang below ${place}: ${hanging.join(", ")}.`;
  if (state.position[2] < ground) return `The pose is below ${place}.`;
  return state.position[2] === ground ? `The platform is at ${place}, and goes no lower here.` : "";
}

/** A jump in words. */
export function jumpWords({ kind, share, before, after, count }) {
  const where = `at ${point(before)}, after ${digits(100 * share, 3)} % of the change`;
  if (!after) return `The platform can be followed no further: ${lossWords(kind)}, ${where}.`;
  const times = count > 1 ? ` ${count} times, the last` : "";
  const way = short(Math.hypot(...after.map((value, k) => value - before[k])), 3);
  return `The platform jumped${times}: ${lossWords(kind)}, ${where}. It went ${way} to ${point(after)}.`;
}
