// The time line below the view: plays the trajectory, with the tensions of all cables.

import { button, h, select, setText, whenOther } from "../dom.js";
import { cableColor, tensionChart, tensionFrame, trackWords } from "../charts/tensions.js";
import { digits } from "../format.js";
import { duration } from "../trajectory/track.js";

const HEIGHT = 88;

/** @param {object} app */
export function timelinePanel(app) {
  const { player, robot } = app;
  const play = button("▶ Play", () => (player.playing ? player.pause() : player.play()), { class: "play" });
  const clock = h("output", { class: "clock" });
  const range = h("input", { type: "range", min: 0, max: 1000, step: "any", "aria-label": "time" });
  range.addEventListener("input", () => seek(start() + (range.valueAsNumber / 1000) * span()));
  range.addEventListener("change", () => player.seek(player.time, true));
  const factor = select(
    "speed",
    ["0.25", "1", "4", "16"].map((value) => [value, `× ${value}`]),
    (value) => {
      player.factor = Number(value);
    },
  );
  const cables = robot.exits.map((_, k) =>
    button(String(k + 1), () => app.select(app.selected === k ? null : k), {
      class: "cable",
      title: `tension of cable ${k + 1}`,
    }),
  );
  const chart = h("div", { class: "chart" });
  const cursor = h("div", { class: "cursor" });
  const track = h("div", { class: "track" }, chart, cursor);
  const words = h("p", { class: "hint", role: "status" });
  const element = h(
    "section",
    { class: "timeline", "aria-label": "Trajectory", hidden: true },
    h(
      "div",
      { class: "row" },
      play,
      clock,
      range,
      factor.element,
      h("div", { class: "keys", role: "group", "aria-label": "Cables" }, ...cables),
    ),
    track,
    words,
  );
  const other = whenOther();
  const sizes = new ResizeObserver(() => app.refresh());
  sizes.observe(track);
  track.addEventListener("pointerdown", (event) => {
    track.setPointerCapture(event.pointerId);
    player.pause();
    seek(timeAt(event));
  });
  track.addEventListener("pointermove", (event) => event.buttons === 1 && seek(timeAt(event)));
  track.addEventListener("pointerup", () => player.seek(player.time, true));
  return { element, update, dispose: () => sizes.disconnect() };

  function start() {
    return player.rows[0]?.[0] ?? 0;
  }

  function span() {
    return player.rows.length > 0 ? duration(player.rows) - start() : 0;
  }

  function seek(time) {
    player.pause();
    player.seek(time);
  }

  function frame() {
    return tensionFrame(Math.max(200, track.clientWidth), HEIGHT);
  }

  function timeAt(event) {
    const { left, right } = frame();
    const at = event.clientX - track.getBoundingClientRect().left;
    return start() + ((at - left) / (right - left)) * span();
  }

  function update() {
    element.hidden = player.track === null;
    if (element.hidden) return;
    const { palette, selected } = app;
    setText(play, player.playing ? "❚❚ Pause" : "▶ Play");
    setText(clock, `${player.time.toFixed(span() < 20 ? 2 : 1)} of ${digits(duration(player.rows), 3)} s`);
    const share = span() > 0 ? (player.time - start()) / span() : 0;
    range.value = String(1000 * share);
    factor.set(String(player.factor));
    cables.forEach((one, k) => {
      one.style.color = k === selected ? "" : cableColor(k, palette);
      one.setAttribute("aria-pressed", String(k === selected));
    });
    const width = Math.max(200, track.clientWidth);
    const bounds = boundsOf(app);
    other([player.track, player.track.done, width, selected, palette, ...bounds], () => {
      setText(words, trackWords(player.track));
      words.title = words.textContent;
      const title = `Tensions along the trajectory: ${words.textContent}`;
      chart.innerHTML = tensionChart(
        player.track,
        { width, height: HEIGHT, selected, bounds, title },
        palette,
      );
    });
    const { left, right } = frame();
    cursor.style.transform = `translateX(${(left + share * (right - left)).toFixed(1)}px)`;
    cursor.classList.toggle("off", !player.isOnPath);
  }
}

// Limits that all cables have.
function boundsOf({ robot: { limits }, store }) {
  const { least, greatest } = store.state.changes;
  return [
    least ?? Math.max(...limits.map(({ min }) => min)),
    greatest ?? Math.min(...limits.map(({ max }) => max)),
  ];
}
