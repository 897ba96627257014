// A slice of the workspace as a picture in the scene.

import {
  DataTexture,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  PlaneGeometry,
  RGBAFormat,
  SRGBColorSpace,
  Matrix4,
  Vector3,
} from "three";
import { SLICE_AXES } from "../slices.js";

const AXIS = { x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1) };

export class SlicePicture {
  /** @param {import("three").Object3D} parent */
  constructor(parent) {
    this.mesh = new Mesh(
      new PlaneGeometry(1, 1),
      new MeshBasicMaterial({ side: DoubleSide, transparent: true, opacity: 0.8, depthWrite: false }),
    );
    this.mesh.visible = false;
    this.mesh.renderOrder = -1;
    parent.add(this.mesh);
  }

  hide() {
    this.mesh.visible = false;
  }

  /**
   * @param {object} plane of `slices.plane`
   * @param {Uint8ClampedArray} pixels of `charts/map.pixels`, the last row first
   */
  draw(plane, pixels) {
    const { normal, at, u, v } = plane;
    const [columns, rows] = [u[2], v[2]];
    const flipped = new Uint8Array(pixels.length);
    for (let row = 0; row < rows; row++) {
      flipped.set(
        pixels.subarray(4 * columns * row, 4 * columns * (row + 1)),
        4 * columns * (rows - 1 - row),
      );
    }
    this.mesh.material.map?.dispose();
    const texture = new DataTexture(flipped, columns, rows, RGBAFormat);
    Object.assign(texture, {
      magFilter: NearestFilter,
      minFilter: NearestFilter,
      colorSpace: SRGBColorSpace,
      needsUpdate: true,
    });
    this.mesh.material.map = texture;
    this.mesh.material.needsUpdate = true;
    const [first, second] = SLICE_AXES[normal].map((axis) => AXIS[axis]);
    const [du, dv] = [u, v].map(([min, max, count]) => ((max - min) * count) / (count - 1));
    const basis = new Matrix4().makeBasis(first, second, new Vector3().crossVectors(first, second));
    this.mesh.quaternion.setFromRotationMatrix(basis);
    this.mesh.scale.set(du, dv, 1);
    this.mesh.position
      .set(0, 0, 0)
      .addScaledVector(AXIS[normal], at)
      .addScaledVector(first, (u[0] + u[1]) / 2)
      .addScaledVector(second, (v[0] + v[1]) / 2);
    this.mesh.visible = true;
  }
}
