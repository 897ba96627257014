// What the view is to show of the page.

import { poseOf } from "./mechanics.js";
import { chosenMotion } from "./panels/motions.js";
import { pinPoses } from "./panels/pins.js";
import { pointOf } from "./robot.js";

/**
 * @param {import("./app.js").App} app with a picture of the mechanics
 * @returns {import("./view/scene.js").Picture}
 */
export function pictureOf(app) {
  const { mechanics, store, robot, handle, point, player } = app;
  const { failure, jump } = mechanics;
  const picture = player.inMotion(mechanics.picture);
  const { state } = store;
  const asked = state.free.length > 0 ? picture.unloaded?.pose : poseOf(state);
  return {
    loaded: picture.loaded,
    unloaded: picture.unloaded,
    rotation: picture.rotation,
    wanted: failure ? failure.wanted : null,
    faded: Boolean(failure),
    handle: state.way === "pose" ? asked : null,
    sag: state.view.sag,
    range: app.range,
    selected: app.selected,
    deflection: app.deflectionFactor,
    ghost: state.view.ghost,
    names: state.view.names,
    motion: chosenMotion(app, picture.loaded),
    still: app.reduced,
    force: forceArrow(app),
    jump,
    pins: pinPoses(state),
    track: player.line,
    isDrawn: handle === "draw",
    points: handle === "points" ? { chosen: point, numbers: point && pointOf(robot, point) } : null,
  };
}

// The force of the load and the hand as an arrow [m]; null without one.
function forceArrow({ mechanics: { pull }, store: { state }, size, robot }) {
  const force = state.force.map((value, k) => value + pull.force[k]);
  const newtons = Math.hypot(...force);
  const length = (0.22 * size * newtons) / (newtons + robot.mass * 9.81);
  return newtons > 0 ? force.map((value) => (value / newtons) * length) : null;
}
