// Load and cables: payload, force, moment; modulus, density, tension level and limits.

import { button, h, linear, logarithmic, numberField, select, setText, slider } from "../dom.js";
import { withUnit } from "../format.js";
import { roundUp } from "../charts/scale.js";
import { panel } from "./panel.js";

const AXES = ["x", "y", "z"];

/** @param {object} app */
export function loadPanel(app) {
  const { store, robot, file } = app;
  const commit = () => store.commit();
  const payload = slider({
    label: "payload",
    unit: "kg",
    scale: linear(0, roundUp(2 * robot.mass)),
    min: 0,
    input: (value) => store.set({ payload: value }),
    commit,
  });
  const vector = (field, unit) =>
    AXES.map((axis, k) =>
      numberField({
        label: `${field} ${axis}`,
        unit,
        change: (value) =>
          store.set(
            { [field]: store.state[field].map((old, j) => (j === k ? value : old)) },
            { commit: true },
          ),
      }),
    );
  const force = vector("force", "N");
  const moment = vector("moment", "N m");
  const change = (patch) => store.set({ changes: { ...store.state.changes, ...patch } });
  const common = file.cable ?? file.cables[0]?.cable;
  const modulus = slider({
    label: "modulus of the cables",
    unit: "GPa",
    scale: logarithmic(common.youngs_modulus / 1e10, common.youngs_modulus / 1e8),
    min: 1e-9,
    input: (value) => change({ modulus: (value * 1e9) / common.youngs_modulus }),
    commit,
  });
  const density = slider({
    label: "density of the cables",
    unit: "g/m",
    scale: linear(0, 3e3 * (common.linear_density || 0.01)),
    min: 0,
    input: (value) =>
      change({ density: common.linear_density > 0 ? value / 1e3 / common.linear_density : 1 }),
    commit,
  });
  const [least, greatest] = [
    Math.min(...robot.limits.map(({ min }) => min)),
    Math.max(...robot.limits.map(({ max }) => max)),
  ];
  const reference = select(
    "tensions near",
    [
      ["norm", "least norm"],
      ["mid", "middle of the limits"],
      ["level", "a level"],
    ],
    (value) => {
      change({
        reference: value === "norm" ? null : value === "mid" ? "mid" : Math.round((least + greatest) / 4),
      });
      commit();
    },
  );
  const level = slider({
    label: "tension level",
    unit: "N",
    scale: linear(0, greatest),
    min: 0,
    input: (value) => change({ reference: value }),
    commit,
  });
  const limits = [
    ["least", "least tension"],
    ["greatest", "greatest tension"],
  ].map(([name, label]) =>
    numberField({
      label,
      unit: "N",
      min: 0,
      change: (value) => {
        change({ [name]: value });
        commit();
      },
    }),
  );
  const note = h("p", { class: "hint" });
  const reset = button("As in the robot file", () => {
    change({ modulus: 1, density: 1, reference: null, least: null, greatest: null });
    commit();
  });
  return panel(
    "Load and cables",
    { open: true, update },
    payload.element,
    h("div", { class: "fields three" }, ...force.map((f) => f.element), ...moment.map((f) => f.element)),
    h("h3", { text: "Cables" }),
    modulus.element,
    common.linear_density > 0 ? density.element : null,
    h("h3", { text: "Tensions" }),
    reference.element,
    level.element,
    h("div", { class: "fields" }, ...limits.map((f) => f.element)),
    note,
    reset,
  );

  function update() {
    const { state } = store;
    const { changes } = state;
    payload.set(state.payload);
    force.forEach((field, k) => field.set(state.force[k]));
    moment.forEach((field, k) => field.set(state.moment[k]));
    modulus.set((common.youngs_modulus * changes.modulus) / 1e9);
    density.set(1e3 * common.linear_density * changes.density);
    reference.set(changes.reference === null ? "norm" : changes.reference === "mid" ? "mid" : "level");
    level.element.hidden = typeof changes.reference !== "number";
    if (typeof changes.reference === "number") level.set(changes.reference);
    limits[0].set(changes.least ?? least);
    limits[1].set(changes.greatest ?? greatest);
    setText(
      note,
      state.way === "kept"
        ? "With the lengths kept, level and limits change nothing; modulus and density move the platform."
        : `Limits of the file: ${withUnit(least, "N")} to ${withUnit(greatest, "N")}.`,
    );
  }
}
