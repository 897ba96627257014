// A slice of the workspace: its plane, its map, and the way to its positions.

import { button, check, choice, h, linear, select, setText, slider, whenOther } from "../dom.js";
import { digits } from "../format.js";
import { cellAt, heatMap, pixels } from "../charts/map.js";
import { rangeOf, extreme, positionOf, QUANTITIES, reach, shownIn, SLICE_AXES } from "../slices.js";
import { panel } from "./panel.js";

// Why positions are not held, and how they are drawn.
const REASONS = {
  beyond_limits: "with a tension out of its limits (pale)",
  infeasible_tension: "without tensions that hold the platform (grey)",
};

/** @param {object} app */
export function slicePanel(app) {
  const { store, robot, slicing, moves } = app;
  const change = (patch, commit = true) =>
    store.set({ slice: { ...store.state.slice, ...patch } }, { commit });
  const shown = check("show a slice of the workspace", (value) => change({ shown: value }));
  const normal = choice(
    "plane across",
    [
      ["x", "x"],
      ["y", "y"],
      ["z", "z"],
    ],
    (value) => {
      change({ normal: value, at: store.state.position["xyz".indexOf(value)], shown: true });
    },
  );
  const quantity = select(
    "quantity",
    QUANTITIES.map(([field, words]) => [field, words]),
    (value) => change({ quantity: value }),
  );
  const cells = select(
    "positions along the longer side",
    ["17", "33", "65"].map((n) => [n, n]),
    (value) => change({ cells: Number(value) }),
  );
  let axis = "";
  let at = null;
  const other = whenOther();
  const place = h("div", {});
  const picture = h("div", {
    class: "map",
    tabindex: "0",
    role: "group",
    "aria-label": "Map of the slice. Arrow keys move the platform to the next position, Home to the worst.",
  });
  const note = h("p", { class: "hint" });
  const buttons = h(
    "div",
    { class: "buttons" },
    button("Go to the greatest", () => go(1)),
    button("Go to the least", () => go(-1)),
    button("Plane through the platform", () =>
      change({ at: store.state.position["xyz".indexOf(store.state.slice.normal)], shown: true }),
    ),
  );
  picture.addEventListener("click", (event) => {
    if (!slicing.plane) return;
    const box = picture.firstElementChild.getBoundingClientRect();
    const cell = cellAt(slicing.plane, app.mapWidth, [
      ((event.clientX - box.left) * app.mapWidth) / box.width,
      ((event.clientY - box.top) * app.mapWidth) / box.width,
    ]);
    if (cell) moves.goto(positionOf(slicing.plane, ...cell));
  });
  picture.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (event.key === "Home") go(1);
    else if (step && slicing.plane) walk(step);
    else return;
    event.preventDefault();
  });
  return panel(
    "Slice of the workspace",
    { update },
    shown.element,
    h("div", { class: "row" }, normal.element, quantity.element),
    place,
    cells.element,
    picture,
    buttons,
    note,
  );

  function update() {
    const { slice, position } = store.state;
    shown.set(slice.shown);
    normal.set(slice.normal);
    quantity.set(slice.quantity);
    cells.set(String(slice.cells));
    if (axis !== slice.normal) {
      axis = slice.normal;
      at = slider({
        label: `${axis} of the plane`,
        unit: "m",
        scale: linear(...reach(axis, robot.exits, slicing.floor)),
        input: (value) => change({ at: value, shown: true }, false),
        commit: () => store.commit(),
      });
      place.replaceChildren(at.element);
    }
    at.set(slice.at);
    buttons.hidden = picture.hidden = !slicing.plane;
    if (!slicing.plane) return void setText(note, slicing.failure?.reason ?? "");
    const chosen = quantityOf(slice.quantity);
    const here = SLICE_AXES[slice.normal].map((name) => position["xyz".indexOf(name)]);
    const { plane, cells: found } = slicing;
    other([plane, found.done, chosen.field, ...here, app.palette], () => {
      const options = { width: app.mapWidth, here, title: mapTitle(slicing, chosen) };
      picture.innerHTML = heatMap(plane, found, chosen, options, app.palette);
    });
    setText(note, told());
  }

  function told() {
    if (slicing.failure) return `The slice failed: ${slicing.failure.reason}.`;
    const { held, reasons, done } = slicing.cells;
    const count = held.filter((state) => state === 1).length;
    const why = Object.entries(reasons).map(
      ([kind, n]) => `${n} ${REASONS[kind] ?? kind.replaceAll("_", " ")}`,
    );
    const rest = why.length > 0 ? `; ${why.join(", ")}` : "";
    return [
      `${done} of ${held.length} positions computed, ${count} held${rest}.`,
      "Click or tap on a position to go there. At each position the lengths are set under the platform's",
      "own weight, and the load acts on these lengths.",
    ].join(" ");
  }

  function go(sign) {
    const cell = slicing.cells && extreme(slicing.cells, store.state.slice.quantity, sign);
    if (cell) moves.goto(positionOf(slicing.plane, ...cell));
  }

  function walk([du, dv]) {
    const { u, v, normal: across } = slicing.plane;
    const [first, second] = SLICE_AXES[across].map((name) => store.state.position["xyz".indexOf(name)]);
    const nearest = ([min, max, count], value, step) =>
      Math.min(count - 1, Math.max(0, Math.round(((value - min) / (max - min)) * (count - 1)) + step));
    moves.goto(positionOf(slicing.plane, nearest(u, first, du), nearest(v, second, dv)));
  }
}

/** A quantity as charts want it. */
export function quantityOf(field) {
  const [, words, unit] = QUANTITIES.find(([name]) => name === field) ?? QUANTITIES[0];
  return { field, words, unit };
}

/** Pixels of the slice for the 3D view. */
export function slicePixels({ cells }, field) {
  return pixels(cells, field, rangeOf(cells, field));
}

/** What a map shows, in a sentence. */
export function mapTitle({ plane, cells }, quantity) {
  const { field, words } = quantity;
  const range = rangeOf(cells, field);
  const [factor, unit] = shownIn(quantity, range);
  const [least, greatest] = (range ?? []).map((value) => digits(factor * value, 3));
  const numbers = range ? `, ${least} to ${greatest} ${unit}` : "";
  return `${words} over the plane ${plane.normal} = ${digits(plane.at, 4)} m${numbers}`;
}
