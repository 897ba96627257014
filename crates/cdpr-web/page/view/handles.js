// Handles to take the platform or a point by: arrows and rings of three.js around a proxy.

import { Object3D } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";

const FIELDS = ["x", "y", "z"];

export class Handles {
  /**
   * @param {object} scene
   * @param {import("three").Camera} camera
   * @param {HTMLElement} surface
   * @param {string[]} held coordinates that cannot change
   * @param {{grab: function(string, number[]): void, grabPoint: function(string, number[]): void,
   *   change: function(): void}} hooks `grab` hears `begin`, `move`, `end` with the pose of the proxy, and
   *   `grabPoint` with the place of the point
   */
  constructor(scene, camera, surface, held, { grab, grabPoint, change }) {
    this.proxy = new Object3D();
    this.point = new Object3D();
    this.point.visible = false;
    scene.add(this.proxy, this.point);
    this.controls = new TransformControls(camera, surface);
    this.controls.attach(this.proxy);
    this.controls.setSize(matchMedia("(pointer: coarse)").matches ? 1.3 : 0.85);
    scene.add(this.controls.getHelper());
    this.held = held;
    this.taken = false;
    this.controls.addEventListener("change", change);
    this.controls.addEventListener("dragging-changed", ({ value }) => {
      this.taken = value;
      tell(value ? "begin" : "end");
    });
    const tell = (phase) =>
      this.mode === "points" ? grabPoint(phase, this.point.position.toArray()) : grab(phase, this.pose());
    this.controls.addEventListener("objectChange", () => tell("move"));
    this.set("translate");
  }

  /** @param {string} mode `translate`, `rotate`, `points`, `draw` or `off` */
  set(mode) {
    this.mode = mode;
    const isPoint = mode === "points";
    const shown = isPoint ? this.point.visible : !["draw", "off"].includes(mode);
    this.controls.attach(isPoint ? this.point : this.proxy);
    this.controls.enabled = shown;
    this.controls.getHelper().visible = shown;
    if (!shown) return;
    this.controls.setMode(isPoint ? "translate" : mode);
    const names = mode === "rotate" ? ["roll", "pitch", "yaw"] : FIELDS;
    FIELDS.forEach((axis, k) => {
      this.controls[`show${axis.toUpperCase()}`] = isPoint || !this.held.includes(names[k]);
    });
  }

  /** Puts the handle of a point at its place, unless somebody holds it; there is none without a place. */
  followPoint(place) {
    if (this.taken) return;
    if (place) this.point.position.set(...place);
    if (this.point.visible === Boolean(place)) return;
    this.point.visible = Boolean(place);
    if (this.mode !== "points") return;
    this.set("points");
    // A pointer that chooses a point takes it in the same gesture.
    this.controls.getHelper().updateMatrixWorld(true);
  }

  /** Where the proxy is, as a pose. */
  pose() {
    const { position: p, quaternion: q } = this.proxy;
    const sign = q.w < 0 ? -1 : 1;
    return [p.x, p.y, p.z, sign * q.w, sign * q.x, sign * q.y, sign * q.z];
  }

  /** Puts the proxy at a pose, unless somebody holds it. */
  follow([x, y, z, qw, qx, qy, qz]) {
    if (this.taken) return;
    this.proxy.position.set(x, y, z);
    this.proxy.quaternion.set(qx, qy, qz, qw);
  }

  dispose() {
    this.controls.detach();
    this.controls.dispose();
  }
}
