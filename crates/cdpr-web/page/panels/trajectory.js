// The trajectory: a table that is dropped or pasted, or points that are drawn in the view.

import { button, h, numberField, setText } from "../dom.js";
import { counted, digits } from "../format.js";
import { roundUp } from "../charts/scale.js";
import { readPoses } from "../trajectory/table.js";
import { duration, timed, withoutTensions } from "../trajectory/track.js";
import { panel } from "./panel.js";

/** @param {object} app */
export function trajectoryPanel(app) {
  const { store } = app;
  app.speed = roundUp(app.size / 20);
  const text = h("textarea", {
    rows: 4,
    spellcheck: "false",
    placeholder: "x_m, y_m, z_m, yaw_deg, t_s\n0, 0, 1.5, 0, 0\n0.5, 0, 1.8, 10, 4",
    "aria-label": "table of poses",
    onchange: () => take(text.value, "The table"),
    oninput: ({ inputType }) => inputType === "insertFromPaste" && take(text.value, "The table"),
  });
  const file = h("input", {
    type: "file",
    accept: ".csv,.txt,.tsv,text/csv,text/plain",
    "aria-label": "file of poses",
    onchange: () => file.files[0] && open(file.files[0]),
  });
  const note = h("p", { class: "hint", role: "status" });
  const draw = button("Draw in the view", () => app.setHandle(app.handle === "draw" ? "translate" : "draw"));
  const add = button("Add the pose on screen", () => app.moves.waypoint(store.state.position));
  const back = button("Remove the last", () => set(store.state.trajectory.slice(0, -1)));
  const clear = button("Remove all", () => set([]));
  const speed = numberField({
    label: "speed",
    unit: "m/s",
    min: 1e-4,
    hint: "of points that are drawn, and of tables without a time",
    change: (value) => {
      app.speed = value;
      if (app.speedCounts) set(timed(store.state.trajectory, value, app.arm));
    },
  });
  let said = "";
  const { element, update: updateOpen } = panel(
    "Trajectory",
    { update },
    h(
      "p",
      { class: "hint" },
      "Drop or paste a table of poses, as --poses takes it, or draw points in the view.",
    ),
    text,
    file,
    h("div", { class: "buttons" }, draw, add, back, clear),
    h("div", { class: "fields" }, speed.element),
    note,
  );
  return { element, update: updateOpen, open };

  function set(trajectory) {
    store.set({ trajectory }, { commit: true });
  }

  async function open(dropped) {
    text.value = "";
    take(await dropped.text(), dropped.name);
    element.open = true;
    file.value = "";
  }

  function take(content, name) {
    said = "";
    if (content.trim() === "") return app.refresh();
    const { rows, hasTime, cables, further, problem } = readPoses(content);
    if (problem) said = `${name}: ${problem}`;
    else {
      app.speedCounts = !hasTime;
      const isMotion = cables === app.robot.exits.length;
      if (cables > 0)
        said = isMotion
          ? "With its tensions in motion. "
          : `It has tensions of ${counted(cables, "cable")}, not read. `;
      if (further.length > 0) said += `Not read: ${further.join(", ")}.`;
      const known = isMotion ? rows : withoutTensions(rows);
      set(hasTime ? known : timed(known, app.speed, app.arm));
    }
    note.classList.toggle("warns", Boolean(problem));
    app.refresh();
  }

  function update() {
    const { trajectory: rows } = store.state;
    draw.setAttribute("aria-pressed", String(app.handle === "draw"));
    back.disabled = clear.disabled = rows.length === 0;
    speed.set(app.speed);
    speed.element.hidden = !app.speedCounts && rows.length > 0;
    const length =
      rows.length > 0 ? `${counted(rows.length, "pose")} in ${digits(duration(rows), 3)} s. ` : "";
    const hint = app.handle === "draw" ? "Click in the view: each click adds a point. " : "";
    setText(note, `${length}${hint}${said}`);
  }
}
