// The cables: tensions as bars against their limits, sag, lengths, and winding of single cables.

import { button, h, linear, logarithmic, setText, slider } from "../dom.js";
import { digits, short, withUnit } from "../format.js";
import { css, viridis } from "../charts/scale.js";
import { panel } from "./panel.js";

/** @param {object} app */
export function cablesPanel(app) {
  const { store, robot, mechanics } = app;
  const rows = robot.exits.map((_, k) => row(app, k));
  const body = h("tbody", {}, ...rows.map((one) => one.element));
  const winding = h("div", { class: "winding" });
  const wind = robot.exits.map((exit, k) => {
    const longest = 2.2 * app.size;
    return slider({
      label: `cable ${k + 1}`,
      unit: "m",
      scale: linear(0.05 * app.size, longest),
      digits: 8,
      min: 1e-6,
      input: (value) => store.set({ lengths: store.state.lengths.map((old, j) => (j === k ? value : old)) }),
      commit: () => store.commit(),
    });
  });
  const step = Number((10 ** Math.floor(Math.log10(app.size / 400))).toPrecision(1));
  const nudges = robot.exits.map((_, k) =>
    h(
      "div",
      { class: "wind" },
      wind[k].element,
      ...[-1, 1].map((sign) =>
        button(
          sign < 0 ? "reel in" : "pay out",
          () => {
            const lengths = store.state.lengths.map((old, j) =>
              j === k ? Number((old + sign * step).toFixed(9)) : old,
            );
            store.set({ lengths }, { commit: true });
          },
          {
            "aria-label": `${sign < 0 ? "reel in" : "pay out"} cable ${k + 1} by ${short(step)}`,
            title: `by ${short(step)}`,
          },
        ),
      ),
    ),
  );
  winding.append(h("h3", { text: "Unstrained lengths" }), ...nudges);
  const keep = button("Keep the lengths to change single ones", () => mechanics.keep());
  const note = h("p", { class: "hint" });
  return panel(
    "Cables",
    { open: true, update },
    h(
      "div",
      { class: "scroll" },
      h(
        "table",
        {},
        h("caption", { text: "Tensions at the platform under the load, between their limits" }),
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            ...["cable", "tension [N]", "in its limits", "no load [N]", "sag", "length [m]"].map((name) =>
              h("th", { scope: "col" }, name),
            ),
          ),
        ),
        body,
      ),
    ),
    note,
    keep,
    winding,
  );

  function update() {
    const picture = app.player.inMotion(mechanics.picture);
    const kept = store.state.way === "kept";
    keep.hidden = kept || !picture || Boolean(mechanics.failure);
    winding.hidden = !kept;
    if (kept) wind.forEach((one, k) => one.set(store.state.lengths[k]));
    if (!picture) return;
    rows.forEach((one, k) => one.update(picture, k));
    const slack = picture.loaded.cables.flatMap((cable, k) => (cable.slack ? [k + 1] : []));
    const out = picture.loaded.cables.flatMap((cable, k) =>
      cable.limit ? [`cable ${k + 1} ${limitWords(cable.limit)}`] : [],
    );
    setText(
      note,
      [
        ...(mechanics.failure ? ["These are of the last state that was found."] : []),
        ...(picture.isInMotion ? ["Tensions in motion, as the table has them; all else is at rest."] : []),
        slack.length > 0 ? `Slack: ${slack.join(", ")}.` : "No cable is slack.",
        out.length > 0 ? `Out of limits: ${out.join("; ")}.` : "All tensions are within their limits.",
      ].join(" "),
    );
    note.classList.toggle("warns", out.length > 0);
    body.classList.toggle("stale", Boolean(mechanics.failure));
  }
}

/** A limit in words. */
export function limitWords(limit) {
  return (
    {
      below: "below its least tension",
      above: "above its greatest tension",
      breaks: "above its breaking force",
    }[limit] ?? limit
  );
}

function row(app, k) {
  const cells = Array.from({ length: 5 }, () => h("td", {}));
  const select = button(String(k + 1), () => app.select(app.selected === k ? null : k), {
    class: "cable",
    "aria-pressed": "false",
    title: "mark this cable in the view",
  });
  const element = h("tr", {}, h("th", { scope: "row" }, select), ...cells);
  const bar = h("div", { class: "bar" }, h("span", { class: "value" }));
  cells[1].append(bar);
  const update = ({ loaded, unloaded, limits }, i) => {
    const cable = loaded.cables[i];
    setText(cells[0], `${digits(cable.tension)}${cable.limit ? " !" : cable.slack ? " slack" : ""}`);
    cells[0].title = cable.exit_tension === null ? "" : `${digits(cable.exit_tension)} N at the exit point`;
    const [min, max] = limits?.[i] ?? limitsOf(app, i);
    const { share, scale } = between(cable.tension, min, max);
    bar.firstChild.style.width = `${(100 * share).toFixed(2)}%`;
    bar.firstChild.style.background = css(viridis(cable.tension / app.range));
    bar.title = `from ${withUnit(min, "N")} to ${withUnit(max, "N")}, ${scale} scale`;
    setText(cells[2], unloaded ? digits(unloaded.cables[i].tension) : "none");
    setText(cells[3], short(cable.sag, 3));
    setText(cells[4], cable.length.toFixed(3));
    element.classList.toggle("warns", Boolean(cable.limit));
    select.setAttribute("aria-pressed", String(app.selected === i));
  };
  return { element, update };
}

function limitsOf({ robot, store }, k) {
  const { least, greatest } = store.state.changes;
  return [least ?? robot.limits[k].min, greatest ?? robot.limits[k].max];
}

// How far a tension is between its limits, from 0 to 1; logarithmic where the limits are far apart.
function between(tension, min, max) {
  const far = min > 0 && max > 20 * min;
  const place = far ? logarithmic(min, max) : linear(min, max);
  return { share: place.from(tension), scale: far ? "logarithmic" : "linear" };
}
