// The legends of the view: tensions as colours, and the slice.

import { h, setText } from "../dom.js";
import { digits } from "../format.js";
import { magma, stops, viridis } from "../charts/scale.js";
import { isWide } from "../charts/map.js";
import { rangeOf, shownIn } from "../slices.js";
import { quantityOf } from "./slice.js";

/** @param {object} app */
export function legendOf(app) {
  const tensions = scaleOf(viridis);
  const slice = scaleOf(magma);
  const caption = h("div", { class: "caption" });
  const element = h("div", { class: "legend" }, slice.element, tensions.element, caption);
  return { element, update };

  function update() {
    const { store, slicing, mechanics, range } = app;
    const [factor, unit] = range >= 1e4 ? [1e-3, "kN"] : [1, "N"];
    tensions.update(
      `tension at the platform [${unit}]`,
      [0, range / 2, range].map((value) => factor * value),
    );
    const quantity = quantityOf(store.state.slice.quantity);
    const found = slicing.plane && rangeOf(slicing.cells, quantity.field);
    slice.element.hidden = !found;
    if (found) {
      const [times, name] = shownIn(quantity, found);
      const [min, max] = found.map((value) => times * value);
      const middle = isWide(found) ? Math.sqrt(min * max) : (min + max) / 2;
      slice.update(`slice: ${quantity.words} [${name}]`, [min, middle, max]);
    }
    const lines = [];
    if (found) lines.push("click on the slice to go there");
    if (mechanics.picture?.rms > 0) lines.push(`deflection × ${digits(app.deflectionFactor, 3)}`);
    if (store.state.view.sag !== 1) lines.push(`sag × ${digits(store.state.view.sag, 3)}`);
    lines.push("no dark edge: slack; orange band: out of limits");
    setText(caption, lines.join(" · "));
  }
}

/**
 * A bar of colours with its title and three numbers.
 * @param {function(number): number[]} scale
 */
export function scaleOf(scale) {
  const colors = stops(scale).map(([t, color]) => `${color} ${100 * t}%`);
  const bar = h("div", {
    class: "gradient",
    style: `background: linear-gradient(to right, ${colors.join(", ")})`,
  });
  const title = h("div", {});
  const marks = [0, 1, 2].map(() => h("span", {}));
  return {
    element: h("div", {}, title, bar, h("div", { class: "marks" }, ...marks)),
    update(words, values) {
      setText(title, words);
      values.forEach((value, k) => setText(marks[k], digits(value, 3)));
    },
  };
}
