// A robot at rest in another page, such as a report: the view without the engine.

import { h } from "./dom.js";
import { DARK, LIGHT } from "./palette.js";
import { scaleOf } from "./panels/legend.js";
import { roundUp, viridis } from "./charts/scale.js";
import { Region } from "./view/region.js";
import { View } from "./view/scene.js";

// A step of the camera by keys [rad].
const STEP = 0.1;

/**
 * Puts the view of a robot into an element.
 * @param {HTMLElement} element
 * @param {{robot: object, poses: Array<{unloaded: object, loaded: object}>, region: object|null}} content
 *   `robot`: as `describe` answers, as far as the view needs it; states as answers of the engine have them;
 *   `region`: of the workspace, as `view/region.js` takes it
 * @returns {{view: View, show: function(object): void, dispose: function(): void}} `show` takes the number of
 *   the `pose`, `isLoaded`, the factors `sag` and `deflection`, and `hasRegion`
 */
export function still(element, { robot, poses, region }) {
  element.classList.add("cdprx", "still");
  const surface = h("div", { class: "surface" });
  const legend = scaleOf(viridis);
  element.replaceChildren(surface, h("div", { class: "legend" }, legend.element));
  const view = new View(surface, robot, null);
  const part = region && new Region(view.scene, region);
  const dark = matchMedia("screen and (prefers-color-scheme: dark)");
  let shown = null;
  let copy = null;

  const paint = (isPrinted) => {
    const palette = dark.matches && !isPrinted ? DARK : LIGHT;
    part?.paint(palette);
    view.paint(palette);
  };
  const repaint = () => paint(false);
  const print = ({ type }) => {
    paint(type === "beforeprint");
    copy?.remove();
    copy = null;
    if (type === "afterprint") return;
    const drawn = view.snapshot();
    copy = h("canvas", { class: "paper", width: drawn.width, height: drawn.height });
    copy.getContext("2d").drawImage(drawn, 0, 0);
    surface.prepend(copy);
  };
  dark.addEventListener("change", repaint);
  for (const event of ["beforeprint", "afterprint"]) addEventListener(event, print);
  element.addEventListener("keydown", (event) => {
    const act = keys(view)[event.key];
    if (!act || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    act();
  });
  letThePageScroll(element, view);
  repaint();
  view.look("default");
  return { view, show, dispose };

  function show({ pose: k, isLoaded, sag, deflection, hasRegion }) {
    const { unloaded, loaded } = poses[k];
    const tensions = [unloaded, loaded].flatMap(({ cables }) => cables.map(({ tension }) => tension));
    const range = roundUp(Math.max(...tensions));
    const unit = range >= 1e4 ? "kN" : "N";
    const factor = range >= 1e4 ? 1e-3 : 1;
    legend.update(`tension at the platform [${unit}]`, [0, (factor * range) / 2, factor * range]);
    if (part) part.group.visible = hasRegion;
    view.show({
      ...NOTHING,
      loaded: isLoaded ? loaded : unloaded,
      unloaded: isLoaded ? unloaded : null,
      sag,
      range,
      deflection,
    });
    if (shown === null) view.look("default");
    shown = k;
  }

  function dispose() {
    dark.removeEventListener("change", repaint);
    for (const event of ["beforeprint", "afterprint"]) removeEventListener(event, print);
    view.dispose();
    element.replaceChildren();
  }
}

const NOTHING = {
  rotation: null,
  wanted: null,
  faded: false,
  handle: null,
  selected: null,
  ghost: true,
  names: true,
  motion: null,
  still: true,
  force: null,
  jump: null,
  pins: [null, null],
  track: [],
  isDrawn: false,
  points: null,
};

function keys(view) {
  return {
    ArrowLeft: () => view.turn(-STEP),
    ArrowRight: () => view.turn(STEP),
    ArrowUp: () => view.tilt(STEP),
    ArrowDown: () => view.tilt(-STEP),
    "+": () => view.zoom(1 / 1.1),
    "-": () => view.zoom(1.1),
  };
}

// The wheel scrolls the page until the view has been clicked; a finger scrolls it up and down.
function letThePageScroll(element, { surface }) {
  let isActive = false;
  surface.style.touchAction = "pan-y";
  element.addEventListener("pointerdown", () => {
    isActive = true;
  });
  element.addEventListener("pointerleave", () => {
    isActive = false;
  });
  element.addEventListener("wheel", (event) => isActive || event.stopPropagation(), { capture: true });
}
