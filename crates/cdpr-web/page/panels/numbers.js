// The numbers of the state on screen, with residuals, and what went wrong.

import { h, setText } from "../dom.js";
import { digits, rangeWithUnit, residual, short, vectorShort, withUnit } from "../format.js";

const DEGREES = 180 / Math.PI;

/** @param {object} app */
export function numbersPanel(app) {
  const items = ["deflection", "rotation", "tensions", "least stiffness", "residuals", "computed"].map(
    (name) => {
      const value = h("dd", {});
      return { name, value, element: h("div", {}, h("dt", { text: name }), value) };
    },
  );
  const element = h(
    "dl",
    { class: "numbers", "aria-label": "Numbers of the state on screen" },
    ...items.map((item) => item.element),
  );
  return { element, update };

  function update() {
    const { picture, failure } = app.mechanics;
    element.classList.toggle("stale", Boolean(failure) || app.mechanics.busy);
    if (!picture) return;
    const texts = words(picture);
    items.forEach((item, k) => setText(item.value, texts[k]));
  }
}

/** The numbers of a picture as texts. */
export function words({ displacement, rms, rotation, loaded, milliseconds }) {
  const tensions = loaded.cables.map((cable) => cable.tension);
  const { closure, force, moment } = loaded.residual;
  return [
    displacement ? `${short(rms)}, ${vectorShort(displacement)}` : "none: no rest without load",
    rotation ? `${digits(DEGREES * Math.hypot(...rotation), 3)}°` : "none",
    rangeWithUnit(Math.min(...tensions), Math.max(...tensions), "N"),
    `${withUnit(loaded.least_stiffness, "N/m")}, ${loaded.stable ? "stable" : "not stable"}`,
    `${residual(closure, "m")}, ${residual(force, "N")}, ${residual(moment, "N m")}`,
    `in ${digits(milliseconds, 3)} ms, ${loaded.method}, ${loaded.iterations} iterations`,
  ];
}
