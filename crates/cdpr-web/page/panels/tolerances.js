// The tolerances: a slider for each entry of the error model, and how many robots are observed.

import { button, h, linear, select, setText, slider } from "../dom.js";
import { attribution, blankWords } from "../attribution.js";
import { entryWords, named, sharePercent, shownUnit } from "../format.js";
import { isOfSetPoints, tolerances, width, widthWords } from "../robot.js";
import { panel } from "./panel.js";

const COUNTS = [512, 2048, 8192, 20000];

/** @param {object} app */
export function tolerancesPanel(app) {
  const { store, robot, sampling } = app;
  if (!robot.study) {
    return panel(
      "Tolerances",
      { open: true, update() {} },
      h("p", { class: "note" }, `No study of this robot: ${robot.start_reason ?? "it has no template"}.`),
    );
  }
  const entries = Object.entries(tolerances(robot.study));
  const sliders = entries.map(([name, entry]) => {
    const [factor, unit] = shownUnit(unitOf(robot, name, entry));
    const nominal = width(entry) * factor;
    const one = slider({
      label: `${named(name, entryWords(name))}, ${widthWords(entry)}`,
      unit,
      scale: linear(0, 3 * nominal),
      min: 0,
      input: (value) => store.set({ tolerances: { ...store.state.tolerances, [name]: value / nominal } }),
      commit: () => store.commit(),
    });
    const share = h("span", {
      class: "share",
      title: "share of the variance that the effects explain here",
    });
    one.element.append(share);
    return { name, nominal, share, isOfSetPoints: isOfSetPoints([name, entry]), ...one };
  });
  const blank = h("p", { class: "hint" });
  const counts = [...new Set([...COUNTS, app.first.observations])].sort((a, b) => a - b);
  const options = counts.map((n) => [String(n), String(n)]);
  const count = select("observations", options, (value) => {
    store.set({ observations: Number(value) }, { commit: true });
  });
  return panel(
    "Tolerances",
    { open: true, update },
    h(
      "p",
      { class: "hint" },
      "How far each parameter may be off. The template's tolerances are assumptions: put in what you know.",
    ),
    ...sliders.map((one) => one.element),
    blank,
    count.element,
    button("As in the template", () => store.set({ tolerances: {} }, { commit: true })),
  );

  function update() {
    const found = sampling.effects ? attribution(sampling.effects, robot.study) : null;
    const why = found ? blankWords(found) : "";
    setText(blank, why);
    for (const { name, nominal, share, set, element, isOfSetPoints } of sliders) {
      // Kept lengths have no set-points.
      element.hidden = isOfSetPoints && store.state.way === "kept";
      set(nominal * (store.state.tolerances[name] ?? 1));
      const part = why ? undefined : found?.parts.find(({ entry }) => entry === name)?.share;
      setText(share, part === undefined ? "" : sharePercent(part));
      share.classList.toggle("stale", !sampling.hasEffects);
      share.style.setProperty("--share", String(part ?? 0));
    }
    count.set(String(store.state.observations));
  }
}

function unitOf({ parameters }, name, { parameters: acts }) {
  const [first] = acts ? Object.keys(acts) : [name];
  return parameters.find((parameter) => parameter.name === first || parameter.group === first)?.unit ?? "";
}
