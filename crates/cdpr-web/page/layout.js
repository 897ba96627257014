// How the parts of the page stand together.

import { button, h } from "./dom.js";
import { digits } from "./format.js";

// Widths [px] from which the page has two columns, and below which it is one of a phone.
export const WHOLE = 990;
const PHONE = 640;

/**
 * Puts the parts into the element of the page.
 * @param {object} app
 * @param {{stage: object, figures: object, charts: object, side: object[]}} parts panels
 * @returns {{undo: HTMLButtonElement, redo: HTMLButtonElement, live: HTMLElement, sizes: ResizeObserver}}
 */
export function layout(app, { stage, figures, charts, side }) {
  const { element, robot, store, refused, size, embedded } = app;
  const undo = button("Undo", () => store.undo(), { title: "Ctrl+Z" });
  const redo = button("Redo", () => store.redo(), { title: "Ctrl+Shift+Z" });
  const again = button("Start again", () => app.jumpTo(app.first));
  const live = h("p", { class: "visually-hidden", role: "status", "aria-live": "polite" });
  const kind = `${robot.cables} cables, ${digits(robot.mass, 3)} kg, ${digits(size, 3)} m across`;
  const head = h(
    embedded ? "div" : "header",
    { class: "head" },
    h(embedded ? "p" : "h1", { class: "title", text: robot.name }),
    h("p", { class: "kind", text: kind }),
    robot.source && h("details", { class: "source" }, h("summary", {}, "Source"), h("p", {}, robot.source)),
    h("div", { class: "buttons" }, undo, redo, again),
  );
  const note = `Left out of the saved state: ${refused.join(", ")}.`;
  const main = h(
    embedded ? "div" : "main",
    { class: "main" },
    refused.length > 0 && h("p", { class: "failure", text: note }),
    ...[stage, figures, charts].map((panel) => panel.element),
  );
  const controls = side.map((panel) => panel.element);
  const aside = h("aside", { class: "side", "aria-label": "Controls" }, ...controls);
  element.classList.add("cdprx");
  element.classList.toggle("embedded", embedded);
  element.replaceChildren(head, main, aside, live);
  const fit = () => {
    element.classList.toggle("whole", element.clientWidth >= WHOLE);
    element.classList.toggle("phone", element.clientWidth < PHONE);
  };
  const sizes = new ResizeObserver(fit);
  sizes.observe(element);
  fit();
  return { undo, redo, live, sizes };
}
