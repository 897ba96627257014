// The page on paper, which is white whatever the screen is: what has colours of its own is drawn once more.

import { h } from "./dom.js";

export class Paper {
  /** Whether the page is being printed. */
  printed = false;
  #copy = null;

  /**
   * @param {import("./app.js").App} app
   * @param {function(): void} redraw draws the page at once
   */
  constructor(app, redraw) {
    this.app = app;
    this.redraw = redraw;
    for (const event of ["beforeprint", "afterprint"]) addEventListener(event, this.#change);
  }

  dispose() {
    for (const event of ["beforeprint", "afterprint"]) removeEventListener(event, this.#change);
  }

  // What WebGL draws now would reach the screen after it is printed: a copy of it is there at once.
  #change = ({ type }) => {
    const { element, view, stage } = this.app;
    this.printed = type === "beforeprint";
    element.classList.toggle("printed", this.printed);
    view?.fit();
    this.redraw();
    this.#copy?.remove();
    if (!this.printed || !view) return;
    const drawn = view.snapshot();
    this.#copy = h("canvas", { class: "paper", width: drawn.width, height: drawn.height });
    this.#copy.getContext("2d").drawImage(drawn, 0, 0);
    stage.surface.prepend(this.#copy);
  };
}
