// What the view shows, and how much larger than it is.

import { check, logarithmic, slider } from "../dom.js";
import { panel } from "./panel.js";

/** @param {object} app */
export function displayPanel(app) {
  const { store } = app;
  const view = (patch) => store.set({ view: { ...store.state.view, ...patch } });
  const sag = slider({
    label: "sag ×",
    scale: logarithmic(1, 1000),
    digits: 3,
    min: 0,
    input: (value) => view({ sag: value }),
    commit: () => store.commit(),
  });
  const arrow = slider({
    label: "deflection ×",
    scale: logarithmic(1, 1e5),
    digits: 3,
    min: 0,
    input: (value) => view({ deflection: value }),
    commit: () => store.commit(),
  });
  const auto = check(
    "fitting",
    (on) => {
      view({ deflection: on ? 0 : app.deflectionFactor });
      store.commit();
    },
    "choose the factor of the deflection to fit the view",
  );
  const ghost = check("outline without load", (on) => {
    view({ ghost: on });
    store.commit();
  });
  const names = check("numbers of cables", (on) => {
    view({ names: on });
    store.commit();
  });
  return panel("Display", { update }, sag.element, arrow.element, auto.element, ghost.element, names.element);

  function update() {
    const { state } = store;
    sag.set(state.view.sag);
    arrow.set(app.deflectionFactor);
    auto.set(state.view.deflection === 0);
    ghost.set(state.view.ghost);
    names.set(state.view.names);
  }
}
