// A region of the workspace in the scene: a surface that one sees through, or closed lines.

import { BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshLambertMaterial } from "three";
import { Segments } from "./segments.js";

export class Region {
  /**
   * @param {import("three").Object3D} parent
   * @param {{points: number[][], lines: number[][], triangles: number[][]}} region points [m], and indices
   *   of the points of closed lines and of the corners of triangles
   */
  constructor(parent, { points, lines, triangles }) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(points.flat()), 3));
    geometry.setIndex(triangles.flat());
    geometry.computeVertexNormals();
    const material = { transparent: true, opacity: 0.25, side: DoubleSide, depthWrite: false };
    this.surface = new Mesh(geometry, new MeshLambertMaterial(material));
    this.outline = new Segments(
      parent,
      lines.reduce((sum, line) => sum + line.length, 1),
      { linewidth: 3 },
    );
    if (triangles.length === 0) for (const line of lines) this.outline.line(line.flatMap((k) => points[k]));
    this.outline.done();
    this.group = new Group();
    this.group.add(this.surface, this.outline.object);
    parent.add(this.group);
  }

  /** @param {object} palette */
  paint(palette) {
    this.surface.material.color.set(palette.bar);
    this.outline.material.color.set(palette.bar);
  }
}
