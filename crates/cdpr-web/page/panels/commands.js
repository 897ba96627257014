// The commands that give the numbers on screen, to be copied.

import { button, h } from "../dom.js";
import { commands } from "../commands.js";
import { unobserved } from "../robot.js";
import { save } from "../saving.js";
import { panel } from "./panel.js";

/** @param {object} app */
export function commandsPanel(app) {
  const list = h("div", { class: "commands" });
  let drawn = "";
  return panel(
    "As commands",
    { update },
    h(
      "p",
      { class: "hint" },
      "The same numbers by the program, to the last digits; run it where the robot file is.",
    ),
    list,
  );

  function update() {
    const { state } = app.store;
    const { picture } = app.mechanics;
    const found = commands({
      state,
      file: app.name,
      lengths: state.lengths ?? (app.mechanics.failure ? null : (picture?.lengths ?? null)),
      observed: app.robot.study !== null && unobserved(app.robot.study, state) === null,
      pose: { position: state.position, rpy_deg: state.rpy_deg },
      slice: app.slicing.plane,
      hasModes: app.robot.inertia,
    });
    const key = JSON.stringify(found);
    if (key === drawn) return;
    drawn = key;
    list.replaceChildren(
      ...found.map(({ title, text, needs }) => {
        const copied = button(
          "Copy",
          async () => {
            copied.textContent = (await copy(text)) ? "Copied" : "Select and copy";
          },
          { "aria-label": `Copy the command: ${title}` },
        );
        return h(
          "div",
          { class: "command" },
          h("h3", { text: title }),
          h("pre", { tabindex: "0" }, h("code", { text })),
          h(
            "div",
            { class: "buttons" },
            copied,
            needs.includes("robot") ? button("Save the changed robot", () => save(app, "robot")) : null,
            needs.includes("study") ? button("Save the study", () => save(app, "study")) : null,
          ),
        );
      }),
    );
  }
}

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = h("textarea", { class: "hidden-text" });
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}
