// The frame of the robot: floor, posts, the rings through the exit points, and the numbers of the cables.

import { GridHelper, Group } from "three";
import { h, setText } from "../dom.js";
import { rings } from "../geometry.js";
import { Segments } from "./segments.js";
import { roundUp } from "../charts/scale.js";

export class Frame {
  /**
   * @param {import("three").Object3D} parent
   * @param {number[][]} exits
   * @param {{min: number[], max: number[], size: number, floor: number, middle: number[]}} box
   */
  constructor(parent, exits, box) {
    this.group = new Group();
    parent.add(this.group);
    this.floor = box.floor;
    this.lines = new Segments(this.group, 4 * exits.length + 8, { linewidth: 2, opacity: 0.85 });
    this.draw(exits);
    const cell = roundUp(box.size / 12);
    const count = 2 * Math.ceil((0.75 * box.size) / cell);
    this.cell = cell;
    this.grid = new GridHelper(count * cell, count);
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.set(
      Math.round(box.middle[0] / cell) * cell,
      Math.round(box.middle[1] / cell) * cell,
      box.floor - 1e-4 * box.size,
    );
    this.group.add(this.grid);
  }

  /** Draws the posts and the rings through exit points. */
  draw(exits) {
    this.lines.clear();
    for (const exit of exits) {
      if (exit[2] > this.floor) this.lines.line([...exit, exit[0], exit[1], this.floor]);
    }
    for (const order of rings(exits))
      order.forEach((k, j) => this.lines.line([...exits[k], ...exits[order[(j + 1) % order.length]]]));
    this.lines.done();
  }

  /** @param {object} palette */
  paint(palette) {
    this.lines.material.color.set(palette.frame);
    this.grid.material.vertexColors = false;
    this.grid.material.color.set(palette.grid);
    this.grid.material.needsUpdate = true;
  }
}

export class Names {
  /**
   * @param {HTMLElement} container
   * @param {number[][]} exits
   */
  constructor(container, exits) {
    this.exits = exits;
    this.labels = exits.map(() => h("span", { class: "name", "aria-hidden": "true" }));
    this.element = h("div", { class: "names" }, ...this.labels);
    container.append(this.element);
  }

  /** Puts each number next to its exit point; those that would cover each other stand together. */
  place(camera, scratch, width, height) {
    const shown = [];
    this.exits.forEach((exit, k) => {
      scratch.set(...exit).project(camera);
      const [x, y] = [((scratch.x + 1) / 2) * width + 5, ((1 - scratch.y) / 2) * height - 18];
      const seen = scratch.z < 1 && Math.abs(scratch.x) < 1 && Math.abs(scratch.y) < 1;
      const other = seen && shown.find((one) => Math.abs(one.x - x) < 16 && Math.abs(one.y - y) < 14);
      if (other) other.names.push(k + 1);
      else if (seen) shown.push({ x, y, names: [k + 1] });
    });
    this.labels.forEach((label, k) => {
      const one = shown[k];
      label.style.display = one ? "" : "none";
      if (!one) return;
      setText(label, one.names.join(", "));
      label.style.transform = `translate(${one.x.toFixed(1)}px,${one.y.toFixed(1)}px)`;
    });
  }
}
