// The numbers of the state on screen.

import { h, setText } from "../dom.js";
import { counted, digits, rangeWithUnit, residual, short, vectorShort, withUnit } from "../format.js";

const DEGREES = 180 / Math.PI;

/** @param {object} app */
export function numbersPanel(app) {
  const items = ["deflection", "displacement", "rotation", "tensions", "least stiffness", "computed"].map(
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
    const { failure } = app.mechanics;
    const picture = app.player.inMotion(app.mechanics.picture);
    element.classList.toggle("stale", Boolean(failure) || app.mechanics.busy);
    if (!picture) return;
    const texts = words(picture);
    items.forEach((item, k) => setText(item.value, texts[k]));
    items.at(-1).element.title = residuals(picture.loaded);
  }
}

/** The numbers of a picture as texts. */
export function words({ displacement, rms, rotation, loaded, milliseconds }) {
  const tensions = loaded.cables.map((cable) => cable.tension);
  return [
    displacement ? short(rms) : "none: no rest without load",
    displacement ? vectorShort(displacement) : "none",
    rotation ? `${digits(angle(rotation), 3)}°` : "none",
    rangeWithUnit(Math.min(...tensions), Math.max(...tensions), "N"),
    `${withUnit(loaded.least_stiffness, "N/m")}, ${loaded.stable ? "stable" : "not stable"}`,
    `${digits(milliseconds, 3)} ms, ${counted(loaded.iterations, "iteration")} (${loaded.method})`,
  ];
}

// The size of a turn [degrees], without what is rounding.
function angle(rotation) {
  const degrees = DEGREES * Math.hypot(...rotation);
  return degrees < 1e-6 ? 0 : degrees;
}

/** How well the equations are solved. */
function residuals({ residual: { closure, force, moment } }) {
  return `residuals ${residual(closure, "m")}, ${residual(force, "N")}, ${residual(moment, "N m")}`;
}
