// Two poses that are pinned, and their numbers next to those on screen.

import { button, h } from "../dom.js";
import { digits, point, short, withUnit } from "../format.js";
import { panel } from "./panel.js";
import { poseOf } from "../mechanics.js";

const ROWS = [
  ["position", ({ position }) => point(position)],
  ["payload", ({ payload }) => `${digits(payload)} kg`],
  ["deflection", ({ rms }) => short(rms)],
  ["least stiffness", ({ stiffness }) => withUnit(stiffness, "N/m")],
  ["least tension", ({ tensions }) => withUnit(tensions[0], "N")],
  ["greatest tension", ({ tensions }) => withUnit(tensions[1], "N")],
  ["mean observed", ({ mean_mm }) => short(mean_mm === null ? null : mean_mm / 1e3)],
  ["standard deviation", ({ std_mm }) => short(std_mm === null ? null : std_mm / 1e3)],
  ["matters most", ({ most }) => most ?? "not known"],
];

/** @param {object} app */
export function pinsPanel(app) {
  const { store } = app;
  const table = h("table", { class: "compare" });
  const buttons = h(
    "div",
    { class: "buttons" },
    ...["A", "B"].flatMap((name, k) => [
      button(`Pin as ${name}`, () => pin(k, numbers(app))),
      button(`Go to ${name}`, () => go(k), { "data-pin": k }),
    ]),
    button("Remove pins", () => store.set({ pins: [null, null] }, { commit: true })),
  );
  return panel(
    "Compare two poses",
    { update },
    h("p", { class: "hint" }, "A pin keeps the numbers of a pose and shows its outline in the view."),
    buttons,
    h("div", { class: "scroll" }, table),
  );

  function update() {
    const { pins } = store.state;
    for (const one of buttons.querySelectorAll("[data-pin]")) one.disabled = !pins[one.dataset.pin];
    const here = numbers(app);
    const columns = [
      ["A", pins[0]],
      ["B", pins[1]],
      ["on screen", here],
    ].filter(([, one]) => one);
    table.replaceChildren(
      h("thead", {}, h("tr", {}, h("td", {}), ...columns.map(([name]) => h("th", { scope: "col" }, name)))),
      h(
        "tbody",
        {},
        ...ROWS.map(([name, text]) =>
          h("tr", {}, h("th", { scope: "row" }, name), ...columns.map(([, one]) => h("td", {}, text(one)))),
        ),
      ),
    );
  }

  function pin(k, what) {
    if (what) store.set({ pins: store.state.pins.map((old, j) => (j === k ? what : old)) }, { commit: true });
  }

  function go(k) {
    const { way, position, rpy_deg, lengths, payload, force, moment } = store.state.pins[k];
    app.jumpTo({ way, position, rpy_deg, lengths, payload, force, moment });
  }
}

/** The numbers on screen, as a pin keeps them; null while there are none. */
export function numbers(app) {
  const { store, mechanics, sampling } = app;
  const { picture, failure } = mechanics;
  if (!picture || failure) return null;
  const { way, position, rpy_deg, lengths, payload, force, moment } = store.state;
  const tensions = picture.loaded.cables.map((cable) => cable.tension);
  const sample = sampling.current ? sampling.sample?.summary : null;
  return {
    way,
    position,
    rpy_deg,
    lengths,
    payload,
    force,
    moment,
    rms: picture.rms,
    stiffness: picture.loaded.least_stiffness,
    tensions: [Math.min(...tensions), Math.max(...tensions)],
    mean_mm: sample?.mean ?? null,
    std_mm: sample?.std ?? null,
    most: app.most(),
  };
}

/** The poses of the pins. */
export function pinPoses({ pins }) {
  return pins.map((one) => one && poseOf(one));
}
