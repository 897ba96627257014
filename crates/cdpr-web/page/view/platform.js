// The platform: the hull of its anchor points, the ghost without load, the outline of an exaggerated motion.

import {
  DoubleSide,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  SphereGeometry,
} from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import { Vector3 } from "three";
import { bodyPoints } from "../geometry.js";

export class Platform {
  pins = [];

  /**
   * @param {import("three").Object3D} parent
   * @param {{anchors: number[][], center_of_mass: number[]}} robot
   * @param {number} size of the robot [m]
   */
  constructor(parent, robot, size) {
    this.size = size;
    this.body = new Group();
    this.surface = new Mesh(
      undefined,
      new MeshLambertMaterial({
        transparent: true,
        opacity: 0.82,
        side: DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
      }),
    );
    this.mass = new Mesh(
      new SphereGeometry(1, 16, 12),
      new MeshBasicMaterial({ depthTest: false, transparent: true }),
    );
    this.mass.position.set(...robot.center_of_mass);
    this.mass.renderOrder = 5;
    [this.rim, this.ghost, this.tip, this.wanted, ...this.pins] = Array.from({ length: 6 }, outline);
    this.body.add(this.surface, this.rim, this.mass);
    parent.add(this.body, this.ghost, this.tip, this.wanted, ...this.pins);
    for (const part of [this.ghost, this.tip, this.wanted, ...this.pins]) part.visible = false;
    this.shape(robot);
  }

  /** Gives the platform the hull of these anchor points. */
  shape({ anchors }) {
    const points = bodyPoints(anchors, this.size);
    const geometry = points
      ? new ConvexGeometry(points.map((point) => new Vector3(...point)))
      : new SphereGeometry(0.012 * this.size, 24, 16);
    const edges = points
      ? new EdgesGeometry(geometry, 12)
      : new EdgesGeometry(new SphereGeometry(0.012 * this.size, 10, 6), 1);
    this.reach = points ? Math.max(...points.map((point) => Math.hypot(...point))) : 0.012 * this.size;
    this.surface.geometry.dispose();
    this.surface.geometry = geometry;
    this.rim.geometry.dispose();
    for (const one of [this.rim, this.ghost, this.tip, this.wanted, ...this.pins]) one.geometry = edges;
    this.mass.scale.setScalar(0.06 * this.reach);
  }

  /** @param {object} palette */
  paint(palette) {
    this.palette = palette;
    this.surface.material.color.set(palette.body);
    this.rim.material.color.set(palette.ink);
    this.mass.material.color.set(palette.ink);
    this.ghost.material.color.set(palette.ghost);
    this.tip.material.color.set(palette.arrow);
    this.wanted.material.color.set(palette.warn);
    this.pins[0].material.color.set(palette.accent);
    this.pins[1].material.color.set(palette.force);
  }

  /** Grey where the picture is of another pose than the wanted one. */
  fade(faded) {
    this.surface.material.color.set(faded ? this.palette.slack : this.palette.body);
    this.surface.material.opacity = faded ? 0.3 : 0.82;
  }
}

/** Puts an object at a pose [x, y, z, qw, qx, qy, qz]; hides it without one. */
export function place(object, pose) {
  object.visible = Boolean(pose);
  if (!pose) return;
  const [x, y, z, qw, qx, qy, qz] = pose;
  object.position.set(x, y, z);
  object.quaternion.set(qx, qy, qz, qw);
}

function outline() {
  return new LineSegments(undefined, new LineBasicMaterial());
}
