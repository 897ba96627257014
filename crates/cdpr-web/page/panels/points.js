// Exit and anchor points: one of them is chosen, typed or dragged in the view.

import { button, h, numberField, select, setText } from "../dom.js";
import { parameterWords } from "../format.js";
import { pointNames, pointOf, withPoint } from "../robot.js";
import { panel } from "./panel.js";

/** @param {object} app */
export function pointsPanel(app) {
  const { store, robot } = app;
  const names = pointNames(robot.cables);
  const which = select(
    "point",
    [["", "none"], ...names.map((name) => [name, parameterWords(name)])],
    (name) => app.choosePoint(name || null),
  );
  const fields = ["x", "y", "z"].map((axis, k) =>
    numberField({
      label: `point ${axis}`,
      unit: "m",
      change: (value) => {
        const place = pointOf(robot, app.point).with(k, value);
        store.set({ changes: withPoint(store.state.changes, app.point, place) }, { commit: true });
      },
    }),
  );
  const note = h("p", { class: "hint" });
  const drag = button("Drag points in the view", () => app.setHandle("points"));
  const reset = button("All as in the robot file", () =>
    store.set({ changes: { ...store.state.changes, points: {} } }, { commit: true }),
  );
  return panel(
    "Exit and anchor points",
    { update },
    drag,
    which.element,
    h("div", { class: "fields three" }, ...fields.map((field) => field.element)),
    note,
    reset,
  );

  function update() {
    const { points } = store.state.changes;
    which.set(app.point ?? "");
    drag.setAttribute("aria-pressed", String(app.handle === "points"));
    fields.forEach((field, k) => {
      field.input.disabled = app.point === null;
      if (app.point) field.set(pointOf(robot, app.point)[k]);
    });
    const moved = Object.keys(points);
    reset.disabled = moved.length === 0;
    const frame = app.point?.startsWith("a") ? "In the frame of the platform. " : "";
    const list = moved.map((name) => `${parameterWords(name)} (${name})`).join(", ");
    setText(
      note,
      frame +
        (list ? `Not as in the robot file: ${list}. “Save” has the robot.` : "All are as in the robot file."),
    );
  }
}
