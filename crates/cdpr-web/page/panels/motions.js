// Motions: the softest one and the natural modes, told and animated.

import { button, h, setText } from "../dom.js";
import { digits, withUnit } from "../format.js";
import { panel } from "./panel.js";

/** @param {object} app */
export function motionsPanel(app) {
  const { store } = app;
  const list = h("div", { class: "motions", role: "radiogroup", "aria-label": "Motion that the view shows" });
  const note = h("p", { class: "hint" });
  let drawn = "";
  const made = panel("Softest motion and modes", { update }, list, note);
  return { ...made, wanted: () => made.element.open || store.state.view.motion !== "still" };

  function update() {
    const { found: modes } = app.modes;
    const { motion } = store.state.view;
    const options = [["still", "no motion", ""]];
    for (const [k, one] of (modes?.motions ?? []).entries()) {
      options.push([
        `motion:${k}`,
        k === 0 ? "softest motion" : `motion ${k + 1}`,
        withUnit(one.stiffness, "N/m"),
      ]);
    }
    for (const [k, one] of (modes?.frequencies ?? []).entries())
      options.push([`mode:${k}`, `mode ${k + 1}`, `${digits(one.frequency)} Hz`]);
    const key = JSON.stringify([options, motion]);
    if (key !== drawn) {
      const focused = list.contains(document.activeElement) ? document.activeElement.dataset.value : null;
      list.replaceChildren(
        ...options.map(([value, words, number]) => {
          const one = button(
            "",
            () => store.set({ view: { ...store.state.view, motion: value } }, { commit: true }),
            { role: "radio", "aria-checked": String(value === motion), "data-value": value },
          );
          one.append(h("span", {}, words), h("span", { class: "number" }, number));
          return one;
        }),
      );
      if (focused) list.querySelector(`[data-value="${focused}"]`)?.focus();
      drawn = key;
    }
    setText(note, app.modes.failure ? `No motions here: ${app.modes.failure}.` : noteOf(app));
  }
}

/** What is said of the motions, most important first. */
export function noteOf({ modes: { found: modes }, reduced, mechanics }) {
  const sentences = ["With the load, on these lengths. The size of a motion is exaggerated."];
  if (modes?.frequencies?.length > 0)
    sentences.push("Frequencies leave out the mass of the cables; `cdpr modes` has it.");
  if (mechanics.failure) sentences.unshift("These are of the last state that was found.");
  if (modes?.warning) sentences.unshift(`Note: ${modes.warning.replace(/\s+/g, " ")}.`);
  if (modes?.reason) sentences.unshift(`No natural frequencies: ${modes.reason}.`);
  if (modes?.neutral > 0) sentences.push(`Nothing resists ${modes.neutral} of the motions.`);
  if (reduced) {
    sentences.push(
      "Your system asks for less motion: the view shows its end, and an outline where it begins.",
    );
  }
  return sentences.join(" ");
}

/** The motion that is chosen, of the state or the modes; null without one. */
export function chosenMotion(app, loaded) {
  const [kind, k] = app.store.state.view.motion.split(":");
  if (kind === "motion" && k === "0" && loaded.softest) return loaded.softest;
  if (kind === "motion") return app.modes.found?.motions[k] ?? null;
  if (kind === "mode") return app.modes.found?.frequencies[k] ?? null;
  return null;
}
