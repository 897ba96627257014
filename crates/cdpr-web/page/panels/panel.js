// A panel: a part of the page that folds.

import { h } from "../dom.js";

/**
 * @param {string} title
 * @param {{open?: boolean, update: function(): void}} options `update` is called while the panel is open
 * @param {...Node} children
 * @returns {{element: HTMLDetailsElement, update: function(): void}}
 */
export function panel(title, { open = false, update }, ...children) {
  const element = h(
    "details",
    { class: "panel", open },
    h("summary", {}, h("h2", { text: title })),
    h("div", { class: "inside" }, ...children),
  );
  element.addEventListener("toggle", () => element.open && update());
  return { element, update: () => element.open && update() };
}
