// Where the parts of the page are: the view keeps its place, and the panels scroll next to it or below it.

import { button, h } from "./dom.js";
import { digits } from "./format.js";

// Width [px] from which the panels are next to the view; below it they are under the view.
export const WIDE = 760;

/**
 * Puts the parts into the element of the page.
 * @param {object} app
 * @param {{stage: object, figures: object, timeline: object, side: object[]}} parts panels
 * @returns {{undo: HTMLButtonElement, redo: HTMLButtonElement, live: HTMLElement, sizes: ResizeObserver}}
 */
export function layout(app, { stage, figures, timeline, side }) {
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
    h("div", { class: "buttons" }, undo, redo, again),
  );
  const note = `Left out of the saved state: ${refused.join(", ")}.`;
  const main = h(
    embedded ? "div" : "main",
    { class: "main" },
    ...[stage, figures, timeline].map((part) => part.element),
  );
  const panels = h(
    "div",
    { class: "panels", tabindex: "-1" },
    refused.length > 0 && h("p", { class: "failure", text: note }),
    ...side.map((panel) => panel.element),
    robot.source && h("p", { class: "hint" }, `Source of the robot: ${robot.source}`),
  );
  const aside = h("aside", { class: "side", "aria-label": "Controls" }, panels, stage.messages);
  element.classList.add("cdprx");
  element.classList.toggle("embedded", embedded);
  element.replaceChildren(head, main, aside, live);
  const fit = () => element.classList.toggle("narrow", element.clientWidth < WIDE);
  const sizes = new ResizeObserver(fit);
  sizes.observe(element);
  fit();
  return { undo, redo, live, sizes };
}
