// Wide lines in one draw call, whose points change in place from frame to frame.

import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";

export class Segments {
  #positions;
  #colors;
  #count = 0;

  /**
   * @param {import("three").Object3D} parent
   * @param {number} capacity greatest number of segments
   * @param {object} material options of LineMaterial: color, linewidth [px], opacity, ..
   */
  constructor(parent, capacity, material) {
    this.capacity = capacity;
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(new Float32Array(6 * capacity));
    geometry.setColors(new Float32Array(6 * capacity));
    this.#positions = geometry.attributes.instanceStart.data;
    this.#colors = geometry.attributes.instanceColorStart.data;
    this.material = new LineMaterial({ transparent: true, ...material });
    this.object = new LineSegments2(geometry, this.material);
    this.object.frustumCulled = false;
    parent.add(this.object);
    this.clear();
  }

  clear() {
    this.#count = 0;
    this.#show();
  }

  /**
   * Adds a line through points.
   * @param {ArrayLike<number>} points flat
   * @param {number[]} [color] red, green, blue from 0 to 1
   */
  line(points, color = [1, 1, 1]) {
    for (let i = 0; i + 5 < points.length; i += 3) {
      if (this.#count >= this.capacity) return;
      const place = 6 * this.#count;
      for (let k = 0; k < 6; k++) {
        this.#positions.array[place + k] = points[i + k];
        this.#colors.array[place + k] = color[k % 3];
      }
      this.#count += 1;
    }
  }

  /** Hands the points to the screen. */
  done() {
    this.#positions.needsUpdate = true;
    this.#colors.needsUpdate = true;
    this.#show();
  }

  #show() {
    this.object.geometry.instanceCount = this.#count;
    this.object.visible = this.#count > 0;
  }
}
