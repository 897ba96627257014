// Links and files: the state, pictures, tables, the robot and the study.

import { button, h } from "../dom.js";
import { panel } from "./panel.js";

const SAVES = [
  ["png", "Picture of the view (PNG)"], ["histogram", "Histogram (SVG)"], ["effects", "Effects (SVG)"], ["map", "Slice (SVG)"], ["csv", "Table of the cables (CSV)"],
  ["observations", "Observations (CSV)"], ["robot", "Robot (JSON)"], ["study", "Study (JSON)"], ["state", "State of this page (JSON)"],
];

/** @param {object} app */
export function filesPanel(app) {
  const told = h("p", { class: "hint", role: "status" });
  const input = h("input", { type: "file", accept: ".json,application/json", class: "visually-hidden", tabindex: "-1", "aria-hidden": "true" });
  input.addEventListener("change", async () => {
    const [file] = input.files;
    if (file) told.textContent = app.open(await file.text(), file.name);
    input.value = "";
  });
  const link = button("Copy a link with this state", async () => {
    try {
      await navigator.clipboard.writeText(app.link());
      told.textContent = "The link is copied. It opens this page in this state.";
    } catch {
      told.textContent = `Copy the address of this page: ${app.link()}`;
    }
  });
  const saves = SAVES.map(([kind, words]) => button(words, () => { told.textContent = app.save(kind); }, { "data-kind": kind }));
  return panel("Link, files and pictures", { update() {
    for (const one of saves) one.disabled = !app.canSave(one.dataset.kind);
  } }, h("div", { class: "buttons" }, app.embedded ? null : link, button("Open a saved state …", () => input.click())), input,
  h("h3", { text: "Save" }), h("div", { class: "buttons" }, ...saves), told);
}
