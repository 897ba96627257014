// Links and files: the state, pictures, tables, the robot and the study.

import { button, h } from "../dom.js";
import { FILES, save } from "../saving.js";
import { panel } from "./panel.js";

/** @param {object} app */
export function filesPanel(app) {
  const told = h("p", { class: "hint", role: "status" });
  const input = h("input", {
    type: "file",
    accept: ".json,application/json",
    class: "visually-hidden",
    tabindex: "-1",
    "aria-hidden": "true",
  });
  input.addEventListener("change", async () => {
    const [file] = input.files;
    if (file) told.textContent = app.open(await file.text(), file.name);
    input.value = "";
  });
  const link = button("Copy a link with this state", async () => {
    try {
      await navigator.clipboard.writeText(app.address.link);
      told.textContent = "The link is copied. It opens this page in this state.";
    } catch {
      told.textContent = `Copy the address of this page: ${app.address.link}`;
    }
  });
  const saves = Object.entries(FILES).map(([kind, { words }]) => [
    kind,
    button(words, async () => {
      told.textContent = await save(app, kind);
    }),
  ]);
  const open = button("Open a saved state …", () => input.click());
  const update = () => {
    for (const [kind, one] of saves) one.disabled = !FILES[kind].ready(app);
  };
  return panel(
    "Link, files and pictures",
    { update },
    h("div", { class: "buttons" }, link, open),
    input,
    h("h3", { text: "Save" }),
    h("div", { class: "buttons" }, ...saves.map(([, one]) => one)),
    told,
  );
}
