// The pose: typed numbers, steps, and which coordinates are found.

import { button, check, h, numberField, setText } from "../dom.js";
import { panel } from "./panel.js";

const NAMES = ["x", "y", "z", "roll", "pitch", "yaw"];

/** @param {object} app */
export function posePanel(app) {
  const { store, robot, moves } = app;
  const fields = NAMES.map((name, k) =>
    numberField({
      label: name,
      unit: k < 3 ? "m" : "°",
      ...(name === "z" && app.ground !== null ? { min: app.ground, why: "the ground is there" } : {}),
      change: (value) => {
        const field = k < 3 ? "position" : "rpy_deg";
        store.set(
          { [field]: store.state[field].map((old, j) => (j === k % 3 ? value : old)) },
          { commit: true },
        );
      },
    }),
  );
  const missing = Math.max(0, robot.freedoms - robot.cables);
  const free = NAMES.filter((name) => !robot.held.includes(name)).map((name) => [
    name,
    check(name, (wanted) => {
      const { free } = store.state;
      const list = wanted ? [...free, name].slice(-missing) : free.filter((other) => other !== name);
      store.set({ free: NAMES.filter((one) => list.includes(one)) }, { commit: true });
    }),
  ]);
  const step = numberField({
    label: "step",
    unit: "m",
    min: 1e-6,
    change: (value) => {
      moves.step = value;
    },
  });
  const turn = numberField({
    label: "turn",
    unit: "°",
    min: 1e-3,
    change: (value) => {
      moves.degrees = value;
    },
  });
  const pull = numberField({
    label: "force",
    unit: "N",
    min: 1e-6,
    change: (value) => {
      moves.newtons = value;
    },
  });
  const keep = check("the force of the hand stays when it lets go", (value) => {
    moves.keepForce = value;
  });
  const note = h("p", { class: "note" });
  const keys = h(
    "div",
    { class: "nudges", role: "group", "aria-label": "Move the platform by one step" },
    ...["x", "y", "z"].flatMap((axis, k) =>
      [-1, 1].map((sign) =>
        button(`${sign < 0 ? "−" : "+"}${axis}`, () => moves.nudge(k, sign), {
          "aria-label": `one step along ${sign < 0 ? "minus" : "plus"} ${axis}`,
        }),
      ),
    ),
    ...["roll", "pitch", "yaw"].flatMap((axis, k) =>
      [-1, 1].map((sign) =>
        button(`${sign < 0 ? "−" : "+"}${axis}`, () => moves.nudge(k, sign, true), {
          "aria-label": `turn by one step, ${sign < 0 ? "minus" : "plus"} ${axis}`,
        }),
      ),
    ),
  );
  const freeBox = h(
    "fieldset",
    { class: "free" },
    h("legend", {}, `found, not chosen: ${missing} of these`),
    ...free.map(([, box]) => box.element),
  );

  return panel(
    "Pose",
    { open: true, update },
    note,
    h("div", { class: "fields three" }, ...fields.map((field) => field.element)),
    missing > 0 ? freeBox : null,
    h("h3", { text: "One step" }),
    keys,
    h("div", { class: "fields three" }, step.element, turn.element, pull.element),
    keep.element,
    h(
      "p",
      { class: "hint" },
      "Keys in the view: arrows and Page Up, Page Down; with Shift they turn; with Alt ten steps.",
    ),
  );

  function update() {
    const { state } = store;
    const kept = state.way === "kept";
    fields.forEach((field, k) => {
      field.set(k < 3 ? state.position[k] : state.rpy_deg[k - 3]);
      field.input.disabled = kept || robot.held.includes(NAMES[k]) || state.free.includes(NAMES[k]);
    });
    for (const [name, box] of free) box.set(state.free.includes(name));
    step.set(moves.step);
    turn.set(moves.degrees);
    pull.set(moves.newtons);
    keep.element.hidden = !kept;
    setText(
      note,
      kept
        ? "The lengths are kept. The platform is where the cables hold it; handles, keys, buttons pull at it."
        : "The lengths are set for this pose under the platform's own weight; then the load is put on it.",
    );
  }
}
