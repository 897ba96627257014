// Exit and anchor points as marks that can be taken, and the numbers of the one that is chosen.

import { BufferAttribute, BufferGeometry, Color, Points, PointsMaterial, Vector3 } from "three";
import { h, setText } from "../dom.js";
import { point } from "../format.js";

// How near to a mark a finger or a pointer takes it [px].
const NEAR = 16;

export class PointMarks {
  #names = [];
  #places = [];
  #scratch = new Vector3();

  /**
   * @param {import("three").Object3D} parent
   * @param {HTMLElement} container
   * @param {number} cables
   */
  constructor(parent, container, cables) {
    this.geometry = new BufferGeometry();
    for (const name of ["position", "color"])
      this.geometry.setAttribute(name, new BufferAttribute(new Float32Array(6 * cables), 3));
    const material = { size: 9, sizeAttenuation: false, vertexColors: true, depthTest: false };
    this.marks = new Points(this.geometry, new PointsMaterial(material));
    this.marks.frustumCulled = false;
    this.marks.renderOrder = 7;
    this.marks.visible = false;
    parent.add(this.marks);
    this.label = h("span", { class: "name chosen", "aria-hidden": "true" });
    container.append(this.label);
  }

  /**
   * @param {{places: Object<string, number[]>, chosen: string|null, numbers: number[]|null}|null} points
   *   `places`: in the base frame, by names; `numbers`: those of the chosen point in the robot file
   * @param {object} palette
   */
  draw(points, palette) {
    this.marks.visible = points !== null;
    this.#names = Object.keys(points?.places ?? {});
    this.#places = Object.values(points?.places ?? {});
    this.chosen = this.#names.indexOf(points?.chosen);
    if (points === null) return;
    const { position, color } = this.geometry.attributes;
    this.#names.forEach((name, k) => {
      const tone = k === this.chosen ? palette.warn : name.startsWith("b") ? palette.ink : palette.accent;
      position.array.set(this.#places[k], 3 * k);
      color.array.set(new Color(tone).toArray(), 3 * k);
    });
    position.needsUpdate = color.needsUpdate = true;
    if (this.chosen >= 0) setText(this.label, `${points.chosen} ${point(points.numbers, 4)}`);
  }

  /** Where the chosen point is [m], or null. */
  get place() {
    return this.#places[this.chosen] ?? null;
  }

  /** Puts the numbers next to the chosen point. */
  follow(camera, width, height) {
    const seen = this.place && this.#project(this.place, camera, width, height);
    this.label.style.display = seen ? "" : "none";
    if (!seen) return;
    const [x, y] = [Math.min(seen[0] + 12, width - this.label.offsetWidth - 2), Math.max(seen[1] - 34, 0)];
    this.label.style.transform = `translate(${x.toFixed(1)}px,${y.toFixed(1)}px)`;
  }

  /** The name of the mark at a pixel, or null. */
  at([x, y], camera, width, height) {
    let [best, distance] = [null, NEAR];
    this.#places.forEach((place, k) => {
      const seen = this.#project(place, camera, width, height);
      const away = seen ? Math.hypot(seen[0] - x, seen[1] - y) : Infinity;
      if (away < distance) [best, distance] = [this.#names[k], away];
    });
    return best;
  }

  dispose() {
    this.label.remove();
  }

  #project(place, camera, width, height) {
    const { x, y, z } = this.#scratch.set(...place).project(camera);
    return z < 1 ? [((x + 1) / 2) * width, ((1 - y) / 2) * height] : null;
  }
}
