// How the parts of the page stand together.

import { button, h } from "./dom.js";
import { digits, short } from "./format.js";

/**
 * Puts the parts into the element of the page.
 * @param {object} app
 * @param {{stage: object, figures: object, charts: object, side: object[]}} parts panels
 * @returns {{undo: HTMLButtonElement, redo: HTMLButtonElement, live: HTMLElement}}
 */
export function layout(app, { stage, figures, charts, side }) {
  const { element, robot, store, refused, size } = app;
  const undo = button("Undo", () => store.undo(), { title: "Ctrl+Z" });
  const redo = button("Redo", () => store.redo(), { title: "Ctrl+Shift+Z" });
  const again = button("Start again", () => app.jumpTo(app.first));
  const live = h("p", { class: "visually-hidden", role: "status", "aria-live": "polite" });
  const kind = `${robot.cables} cables, ${digits(robot.mass, 3)} kg, ${short(size, 3)} across`;
  const head = h(
    "header",
    { class: "head" },
    h("h1", { text: robot.name }),
    h("p", { class: "kind", text: kind }),
    robot.source && h("details", { class: "source" }, h("summary", {}, "Source"), h("p", {}, robot.source)),
    h("div", { class: "buttons" }, undo, redo, again),
  );
  const note = `Left out of the saved state: ${refused.join(", ")}.`;
  const main = h(
    "main",
    { class: "main" },
    refused.length > 0 && h("p", { class: "failure", text: note }),
    ...[stage, figures, charts].map((panel) => panel.element),
  );
  const controls = side.map((panel) => panel.element);
  const aside = h("aside", { class: "side", "aria-label": "Controls" }, ...controls);
  element.classList.add("cdprx");
  element.replaceChildren(head, main, aside, live);
  return { undo, redo, live };
}
