// The 3D view: scene, camera, and the loop that draws only when something has changed or moves.

import {
  AmbientLight,
  DirectionalLight,
  PerspectiveCamera,
  Plane,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
  Color,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { amplitude, anchorsAt, extents, floorOf, moved } from "../geometry.js";
import { Arrow } from "./arrow.js";
import { Cables } from "./cables.js";
import { Frame, Names } from "./frame.js";
import { Handles } from "./handles.js";
import { Platform, place } from "./platform.js";
import { PointMarks } from "./points.js";
import { Segments } from "./segments.js";
import { SlicePicture } from "./slice.js";

const LOOKS = { default: [-0.75, -1.25, 0.5], top: [0, -1e-3, 1], front: [0, -1, 0.02], side: [1, 0, 0.02] };
const PERIOD = 1.6;
// Height of the buttons in the view [px], below which the robot begins.
const TOOLS = 36;

/**
 * @typedef {{loaded: object, unloaded: object|null, wanted: number[]|null, faded: boolean, sag: number,
 *   range: number,
 *   selected: number|null, deflection: number, ghost: boolean, motion: object|null, still: boolean,
 *   force: number[]|null, jump: {before: number[], after: number[]|null}|null,
 *   pins: Array<number[]|null>, track: number[], isDrawn: boolean,
 *   points: {chosen: string|null, numbers: number[]|null}|null}} Picture
 */

export class View {
  #needed = true;
  // The look that the camera keeps when the size of the view changes, until a hand turns it.
  #kept = null;
  #frame = 0;
  // The trajectory that is drawn.
  #line = null;
  #pick = new Raycaster();

  /**
   * @param {HTMLElement} container
   * @param {object} robot answer to `describe`
   * @param {{grab: function(string, number[]): void, grabPoint: function(string, number[]): void,
   *   choosePoint: function(string): void, goto: function(number[]): void,
   *   waypoint: function(number[]): void}|null} hooks of a hand; the robot is not moved without them
   */
  constructor(container, robot, hooks) {
    this.container = container;
    this.robot = robot;
    this.hooks = hooks;
    this.box = { ...extents(robot.exits), floor: floorOf(robot) };
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: false });
    this.renderer.setPixelRatio(Math.min(2, globalThis.devicePixelRatio || 1));
    this.surface = this.renderer.domElement;
    this.surface.setAttribute("aria-hidden", "true");
    container.prepend(this.surface);
    this.scene = new Scene();
    const { size } = this.box;
    this.camera = new PerspectiveCamera(38, 1, size / 2000, size * 30);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new AmbientLight(0xffffff, 1.8));
    const sun = new DirectionalLight(0xffffff, 1.6);
    sun.position.set(-1, -2, 3);
    this.scene.add(sun);
    this.orbit = new OrbitControls(this.camera, this.surface);
    this.orbit.addEventListener("change", () => this.invalidate());
    this.orbit.addEventListener("start", () => this.#release());
    this.frame = new Frame(this.scene, robot.exits, this.box);
    this.names = new Names(container, robot.exits);
    this.slice = new SlicePicture(this.scene);
    this.cables = new Cables(this.scene, robot.cables);
    this.platform = new Platform(this.scene, robot, size);
    this.arrow = new Arrow(this.scene);
    this.force = new Arrow(this.scene);
    this.jump = new Arrow(this.scene);
    this.points = new PointMarks(this.scene, container, robot.cables);
    this.trace = new Segments(this.scene, 400, { linewidth: 2, opacity: 0.8 });
    this.track = new Segments(this.scene, 2100, { linewidth: 2.5 });
    if (hooks) this.#takeHandles();
    this.resize = new ResizeObserver(() => this.fit());
    this.resize.observe(container);
    this.fit();
    this.look("default");
    this.#frame = requestAnimationFrame(this.#loop);
  }

  #takeHandles() {
    const { hooks, robot } = this;
    const taken = (tell) => (phase, place) => {
      this.orbit.enabled = phase === "end";
      tell(phase, place);
    };
    this.handles = new Handles(this.scene, this.camera, this.surface, robot.held, {
      grab: taken(hooks.grab),
      grabPoint: taken(hooks.grabPoint),
      change: () => this.invalidate(),
    });
    this.#listen();
  }

  /** @param {object} palette */
  paint(palette) {
    this.palette = palette;
    this.scene.background = new Color(palette.sky);
    for (const part of [this.frame, this.cables, this.platform]) part.paint(palette);
    this.arrow.material.color.set(palette.arrow);
    this.force.material.color.set(palette.force);
    this.jump.material.color.set(palette.warn);
    this.trace.material.color.set(palette.warn);
    this.track.material.color.set(palette.force);
    if (this.picture) this.show(this.picture);
    this.invalidate();
  }

  /** Draws at the next frame. */
  invalidate() {
    this.#needed = true;
  }

  /** @param {Picture} picture */
  show(picture) {
    this.picture = picture;
    const { loaded, unloaded, wanted, faded, deflection, ghost, force, jump, pins } = picture;
    this.platform.fade(faded);
    place(this.platform.ghost, ghost && unloaded ? unloaded.pose : null);
    place(this.platform.wanted, wanted);
    pins.forEach((pin, k) => place(this.platform.pins[k], pin));
    const step = unloaded ? loaded.pose.slice(0, 3).map((value, k) => value - unloaded.pose[k]) : [0, 0, 0];
    const { size } = this.box;
    const thickness = Math.max(0.0022 * size, 0.03 * this.platform.reach);
    this.arrow.draw(
      unloaded && !faded ? unloaded.pose.slice(0, 3) : null,
      step.map((value) => deflection * value),
      thickness,
    );
    const tip =
      unloaded && !faded && deflection > 1
        ? moved(unloaded.pose, { translation: step, rotation: picture.rotation ?? [0, 0, 0] }, deflection)
        : null;
    place(this.platform.tip, tip);
    this.force.draw(force ? loaded.center_of_mass : null, force ?? [0, 0, 0], thickness);
    this.jump.draw(
      jump?.after ? jump.before : null,
      jump?.after ? jump.after.map((value, k) => value - jump.before[k]) : [0, 0, 0],
      thickness,
    );
    this.trace.clear();
    if (jump?.path) this.trace.line(jump.path.flat());
    this.trace.done();
    if (this.#line !== picture.track) {
      this.#line = picture.track;
      this.track.clear();
      this.track.line(picture.track);
      this.track.done();
    }
    this.handles?.follow(wanted ?? picture.handle ?? loaded.pose);
    this.points.draw(picture.points && { ...picture.points, places: this.#places(loaded) }, this.palette);
    this.handles?.followPoint(this.points.place);
    this.#pose(0);
    this.invalidate();
  }

  /** Takes over other exit and anchor points of the robot. */
  reshape() {
    this.frame.draw(this.robot.exits);
    this.names.exits = this.robot.exits;
    this.platform.shape(this.robot);
    this.invalidate();
  }

  // Exit and anchor points by their names.
  #places({ anchors }) {
    const named = (kind, list) => list.map((place, k) => [`${kind}${k + 1}`, place]);
    return Object.fromEntries([...named("b", this.robot.exits), ...named("a", anchors)]);
  }

  /** Shows a slice, or none. */
  showSlice(plane, pixels) {
    this.plane = plane;
    if (plane) this.slice.draw(plane, pixels);
    else this.slice.hide();
    this.invalidate();
  }

  /** Looks at the whole robot from one of `LOOKS`. */
  look(name) {
    this.#kept = name;
    const { floor } = this.box;
    const feet = this.robot.exits.map(([x, y, z]) => [x, y, Math.min(z, floor)]);
    const anchors = this.picture?.loaded.anchors ?? [];
    this.#lookAt([...this.robot.exits, ...feet, ...anchors], new Vector3(...LOOKS[name]));
  }

  /** Looks at the platform from where the camera is. */
  toPlatform() {
    if (!this.picture) return;
    this.#release();
    const { pose } = this.picture.loaded;
    const reach = 1.6 * this.platform.reach;
    const ends = [0, 1, 2].flatMap((axis) =>
      [-reach, reach].map((step) => pose.slice(0, 3).with(axis, pose[axis] + step)),
    );
    this.#lookAt(ends, this.camera.position.clone().sub(this.orbit.target));
  }

  /** Moves the camera towards its target, or away from it. */
  zoom(factor) {
    this.#release();
    this.camera.position.sub(this.orbit.target).multiplyScalar(factor).add(this.orbit.target);
    this.orbit.update();
    this.invalidate();
  }

  /** Turns the camera about its target [rad]. */
  turn(angle) {
    this.#release();
    this.camera.position.sub(this.orbit.target).applyAxisAngle(this.camera.up, angle).add(this.orbit.target);
    this.orbit.update();
    this.invalidate();
  }

  /** Raises the camera about its target [rad]. */
  tilt(angle) {
    this.#release();
    const back = this.camera.position.clone().sub(this.orbit.target);
    const height = Math.asin(back.z / back.length());
    const right = new Vector3().crossVectors(this.camera.up, back).normalize();
    const step = Math.min(1.5, Math.max(-1.5, height + angle)) - height;
    this.camera.position.copy(back.applyAxisAngle(right, -step).add(this.orbit.target));
    this.orbit.update();
    this.invalidate();
  }

  /** Takes the size of its container. */
  fit() {
    const { clientWidth, clientHeight } = this.container;
    this.width = Math.max(clientWidth, 50);
    this.height = Math.max(clientHeight, 50);
    this.renderer.setSize(this.width, this.height);
    this.camera.aspect = this.width / this.height;
    this.camera.updateProjectionMatrix();
    if (this.#kept) this.look(this.#kept);
    this.invalidate();
  }

  #release() {
    this.#kept = null;
  }

  /** The picture as it is now. */
  snapshot() {
    this.renderer.render(this.scene, this.camera);
    const named = Boolean(this.picture?.names);
    this.names.element.hidden = !named;
    if (named) this.names.place(this.camera, this.#scratch, this.width, this.height);
    this.points.follow(this.camera, this.width, this.height);
    return this.surface;
  }

  dispose() {
    cancelAnimationFrame(this.#frame);
    this.resize.disconnect();
    this.handles?.dispose();
    this.orbit.dispose();
    this.renderer.dispose();
    this.surface.remove();
    this.names.element.remove();
    this.points.dispose();
  }

  // From a direction, and so near that points just fit into the view.
  #lookAt(points, direction) {
    const back = direction.normalize();
    const right = new Vector3().crossVectors(this.camera.up, back).normalize();
    const up = new Vector3().crossVectors(back, right);
    const tangent = 0.93 * Math.tan((this.camera.fov * Math.PI) / 360);
    const vectors = points.map((point) => new Vector3(...point));
    const target = vectors.reduce((sum, one) => sum.addScaledVector(one, 1 / points.length), new Vector3());
    // Each side of the view is a plane through the camera. With the slopes of two opposite planes, the points
    // bound the distance d and the shift s of the camera: a / upper + n <= d + s / upper, n - a / lower <=
    // d - s / lower, where a is the place of a point along the axis and n how near it is.
    const fitted = (axis, lower, upper) => {
      const seen = vectors.map((one) => [
        one.clone().sub(target).dot(axis),
        one.clone().sub(target).dot(back),
      ]);
      const above = Math.max(...seen.map(([along, near]) => along / upper + near));
      const below = Math.max(...seen.map(([along, near]) => near - along / lower));
      const shift = (above - below) / (1 / lower + 1 / upper);
      return { distance: below + shift / lower, shift };
    };
    const across = fitted(right, tangent * this.camera.aspect, tangent * this.camera.aspect);
    const along = fitted(up, tangent, tangent * (1 - Math.min(0.3, (2 * TOOLS) / this.height)));
    target.addScaledVector(right, across.shift).addScaledVector(up, along.shift);
    this.orbit.target.copy(target);
    this.camera.position.copy(target).addScaledVector(back, Math.max(across.distance, along.distance));
    this.orbit.update();
    this.invalidate();
  }

  #loop = () => {
    this.#frame = requestAnimationFrame(this.#loop);
    const picture = this.picture;
    if (picture?.motion && !picture.still && !picture.faded) {
      this.#pose(Math.sin((2 * Math.PI * performance.now()) / 1000 / PERIOD));
      this.#needed = true;
    }
    if (!this.#needed) return;
    this.#needed = false;
    this.snapshot();
  };

  #scratch = new Vector3();

  // The platform and its cables at a phase of the motion, from -1 to 1; a still motion is shown at its end.
  #pose(phase) {
    const { loaded, sag, range, selected, faded, motion, still } = this.picture;
    let { pose } = loaded;
    let steps = null;
    if (motion && !faded) {
      const reach = amplitude(
        motion,
        this.robot.anchors,
        pose,
        Math.max(0.03 * this.box.size, 0.35 * this.platform.reach),
      );
      pose = moved(pose, motion, reach * (still ? 1 : phase));
      steps = anchorsAt(pose, this.robot.anchors).map((anchor, i) =>
        anchor.map((value, k) => value - loaded.anchors[i][k]),
      );
      if (still) place(this.platform.ghost, loaded.pose);
    }
    place(this.platform.body, pose);
    this.cables.draw(loaded, { sag, range, selected, faded, steps });
  }

  // A click on the slice goes there; a drag turns the view.
  #listen() {
    let down = null;
    const choose = ({ offsetX, offsetY }) => {
      const name = this.points.at([offsetX, offsetY], this.camera, this.width, this.height);
      if (name && !this.handles.controls.axis) this.hooks.choosePoint(name);
    };
    this.surface.addEventListener(
      "pointerdown",
      (event) => {
        down = [event.clientX, event.clientY];
        choose(event);
      },
      // Before the handles, which then are where the point is.
      { capture: true },
    );
    this.surface.addEventListener("pointerup", (event) => {
      const still = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4;
      down = null;
      if (!still || this.handles.taken || this.handles.controls.axis) return;
      const box = this.surface.getBoundingClientRect();
      const at = new Vector2(
        ((event.clientX - box.left) / box.width) * 2 - 1,
        1 - ((event.clientY - box.top) / box.height) * 2,
      );
      this.#pick.setFromCamera(at, this.camera);
      if (this.picture?.isDrawn) return this.#drawn();
      if (!this.slice.mesh.visible) return;
      const [hit] = this.#pick.intersectObject(this.slice.mesh);
      if (hit) this.hooks.goto(hit.point.toArray());
    });
  }

  // A point of a trajectory where the pointer is, in the plane through the platform across the axis along
  // which the camera looks most; seen from well above, that of its height.
  #drawn() {
    const { direction } = this.#pick.ray;
    const size = direction.toArray().map(Math.abs);
    const axis = size[2] > 0.25 ? 2 : size[0] > size[1] ? 0 : 1;
    const [x, y, z] = this.picture.handle ?? this.picture.loaded.pose;
    const normal = new Vector3().setComponent(axis, 1);
    const plane = new Plane().setFromNormalAndCoplanarPoint(normal, new Vector3(x, y, z));
    const hit = this.#pick.ray.intersectPlane(plane, new Vector3());
    if (hit && hit.distanceTo(this.orbit.target) < 10 * this.box.size) this.hooks.waypoint(hit.toArray());
  }
}
