// An arrow with a shaft and a head, in metres of the scene.

import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";

const UP = new Vector3(0, 1, 0);

export class Arrow {
  /** @param {import("three").Object3D} parent */
  constructor(parent) {
    this.material = new MeshBasicMaterial({ depthTest: false, transparent: true });
    this.shaft = new Mesh(new CylinderGeometry(1, 1, 1, 12), this.material);
    this.head = new Mesh(new ConeGeometry(1, 1, 20), this.material);
    this.group = new Group();
    this.group.add(this.shaft, this.head);
    this.group.visible = false;
    this.group.renderOrder = 6;
    for (const part of [this.shaft, this.head]) part.renderOrder = 6;
    parent.add(this.group);
  }

  /**
   * @param {number[]|null} from base [m]; no arrow without one
   * @param {number[]} vector from base to tip [m]
   * @param {number} thickness radius of the shaft [m]
   */
  draw(from, vector, thickness) {
    const length = from ? Math.hypot(...vector) : 0;
    this.group.visible = length > 0;
    if (length === 0) return;
    const head = Math.min(5 * thickness, 0.5 * length);
    this.group.position.set(...from);
    this.group.quaternion.setFromUnitVectors(UP, new Vector3(...vector).normalize());
    this.shaft.scale.set(thickness, length - head, thickness);
    this.shaft.position.y = (length - head) / 2;
    this.head.scale.set(2.4 * thickness, head, 2.4 * thickness);
    this.head.position.y = length - head / 2;
  }
}
