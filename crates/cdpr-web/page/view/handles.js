// Handles to take the platform by: arrows and rings of three.js around a proxy of the platform.

import { Object3D } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";

const FIELDS = ["x", "y", "z"];

export class Handles {
  /**
   * @param {object} scene
   * @param {import("three").Camera} camera
   * @param {HTMLElement} surface
   * @param {string[]} held coordinates that cannot change
   * @param {{grab: function(string, number[]): void, change: function(): void}} hooks `grab` hears `begin`,
   *   `move`, `end` with the pose of the proxy
   */
  constructor(scene, camera, surface, held, { grab, change }) {
    this.proxy = new Object3D();
    scene.add(this.proxy);
    this.controls = new TransformControls(camera, surface);
    this.controls.attach(this.proxy);
    this.controls.setSize(matchMedia("(pointer: coarse)").matches ? 1.3 : 0.85);
    scene.add(this.controls.getHelper());
    this.held = held;
    this.taken = false;
    this.controls.addEventListener("change", change);
    this.controls.addEventListener("dragging-changed", ({ value }) => {
      this.taken = value;
      grab(value ? "begin" : "end", this.pose());
    });
    this.controls.addEventListener("objectChange", () => grab("move", this.pose()));
    this.set("translate");
  }

  /** @param {string} mode `translate`, `rotate` or `off` */
  set(mode) {
    this.mode = mode;
    const shown = mode !== "off";
    this.controls.enabled = shown;
    this.controls.getHelper().visible = shown;
    if (!shown) return;
    this.controls.setMode(mode);
    const names = mode === "translate" ? FIELDS : ["roll", "pitch", "yaw"];
    FIELDS.forEach((axis, k) => {
      this.controls[`show${axis.toUpperCase()}`] = !this.held.includes(names[k]);
    });
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
