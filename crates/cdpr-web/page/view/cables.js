// The cables: their shapes, tensions as colours, pulley wheels, and marks on those out of limits. Slack ones
// have their colour, too, without a dark edge.

import { Color, SRGBColorSpace } from "three";
import { exaggerated, followed } from "../geometry.js";
import { Segments } from "./segments.js";
import { cableStyle } from "./style.js";

export class Cables {
  /**
   * @param {import("three").Object3D} parent
   * @param {number} count number of cables
   */
  constructor(parent, count) {
    const capacity = 80 * count;
    this.casing = new Segments(parent, capacity, {
      color: 0x000000,
      linewidth: 4.6,
      opacity: 0.35,
      depthWrite: false,
    });
    this.marks = new Segments(parent, capacity, {
      color: 0xffffff,
      vertexColors: true,
      linewidth: 9,
      opacity: 0.75,
      depthWrite: false,
    });
    this.lines = new Segments(parent, capacity, { color: 0xffffff, vertexColors: true, linewidth: 3 });
    this.wheels = new Segments(parent, capacity, { color: 0xffffff, linewidth: 2 });
    this.lines.object.renderOrder = 2;
    this.marks.object.renderOrder = 1;
  }

  /** @param {object} palette */
  paint(palette) {
    this.palette = palette;
    this.casing.material.color.set(palette.casing);
    this.wheels.material.color.set(palette.frame);
  }

  /**
   * @param {object} state answer of the engine
   * @param {{sag: number, range: number, selected: number|null, faded: boolean,
   *   steps: number[][]|null}} options
   *   `range`: tension at the top of the scale [N]; `steps`: how far each anchor point is off in a motion
   */
  draw(state, { sag, range, selected, faded, steps }) {
    const { palette } = this;
    for (const part of [this.casing, this.marks, this.lines, this.wheels]) part.clear();
    state.cables.forEach((cable, k) => {
      let points = exaggerated(cable.points, sag, cable.free);
      if (steps) points = followed(points, steps[k], cable.free);
      const { color, hasEdge, mark } = cableStyle(cable, { range, faded, selected: k === selected });
      this.lines.line(points, color ? linear(color) : rgb(palette.slack));
      if (hasEdge) this.casing.line(points);
      if (mark) this.marks.line(points, rgb(palette[mark]));
      if (cable.wheel.length > 0) this.wheels.line([...cable.wheel, ...cable.wheel.slice(0, 3)]);
    });
    for (const part of [this.casing, this.marks, this.lines, this.wheels]) part.done();
  }
}

function rgb(name) {
  return new Color(name).toArray();
}

// Colours are linear in the scene, and sRGB in scales.
function linear(color) {
  return new Color().setRGB(...color, SRGBColorSpace).toArray();
}
