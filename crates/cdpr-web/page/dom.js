// Elements of the page: `h` builds one, the others are its controls.

import { fieldText, parseNumber } from "./numbers.js";

/**
 * Builds an element.
 * @param {string} tag
 * @param {Object<string, *>} [properties] attributes; `class`, `text`, and functions as listeners of `onNAME`
 * @param {...(Node|string|null|false)} children
 * @returns {HTMLElement}
 */
export function h(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "text") element.textContent = value;
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children.filter((child) => child !== null && child !== false && child !== undefined));
  return element;
}

let counter = 0;

/** A new identifier, unique on the page. */
export function unique(prefix) {
  counter += 1;
  return `cdprx-${prefix}-${counter}`;
}

/** Sets the text of an element where it has changed, so that readers and layouts are left in peace. */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/**
 * A memory of what was drawn last: the function that it returns draws only where one of the parts is another.
 * @returns {function(Array<*>, function(): void): void}
 */
export function whenOther() {
  let last = null;
  return (parts, draw) => {
    if (last?.length === parts.length && parts.every((part, k) => part === last[k])) return;
    last = parts;
    draw();
  };
}

/**
 * A text field for a number. What is typed is a draft, and marked as one, until Enter or leaving the field
 * commits it; Escape and Ctrl+Z take it back. The browser's own undo is off: the page has one stack.
 * @param {{label?: string, id?: string, min?: number, max?: number, why?: string, hint?: string,
 *   commit: function(number): void}} options `commit` gets what was typed, once it is a number in range
 * @returns {{input: HTMLInputElement, note: HTMLElement, set: function(number): void}}
 */
function typedNumber({ label, id = null, min, max, why, hint, commit }) {
  const note = h("p", { id: unique("note"), class: "fieldnote", role: "status" });
  const input = h("input", {
    id,
    type: "text",
    class: "number",
    inputmode: "decimal",
    autocomplete: "off",
    spellcheck: "false",
    title: hint,
    "aria-label": label,
    "aria-describedby": note.id,
  });
  // The text of the number that the page computes with.
  let computed = "";
  const show = (text) => {
    computed = input.value = text;
    say("");
  };
  const say = (problem) => {
    const draft = input.value !== computed;
    input.classList.toggle("draft", draft);
    input.setAttribute("aria-invalid", String(problem !== ""));
    const still = computed === "" ? "" : ` ${computed} is computed.`;
    setText(note, problem ? problem + still : draft ? "Enter computes it, Escape takes it back." : "");
  };
  const tell = () => {
    if (input.value === computed) return;
    const { value, problem } = parseNumber(input.value, { min, max, why });
    if (problem) return say(problem);
    show(fieldText(value));
    commit(value);
  };
  input.addEventListener("input", () => say(""));
  input.addEventListener("blur", tell);
  input.addEventListener("beforeinput", (event) => {
    if (event.inputType.startsWith("history")) event.preventDefault();
  });
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") return tell();
    if (input.value === computed || !(event.key === "Escape" || undoStep(event))) return;
    event.preventDefault();
    event.stopPropagation();
    show(computed);
  });
  const set = (value) => {
    const text = fieldText(value);
    if (text !== computed) show(text);
  };
  return { input, note, set };
}

/** The step that keys ask for: `undo`, `redo` or null. */
export function undoStep({ ctrlKey, metaKey, shiftKey, key }) {
  if (!ctrlKey && !metaKey) return null;
  const letter = key.toLowerCase();
  if (letter === "z") return shiftKey ? "redo" : "undo";
  return letter === "y" ? "redo" : null;
}

/**
 * A number that is typed.
 * @param {{label: string, unit?: string, min?: number, max?: number, why?: string, hint?: string,
 *   change: function(number): void}} options `change` gets what was typed, `why` says what bounds it
 * @returns {{element: HTMLElement, input: HTMLInputElement, set: function(number): void}}
 */
export function numberField({ label, unit = "", min, max, why, hint, change }) {
  const id = unique("field");
  const { input, note, set } = typedNumber({ id, min, max, why, hint, commit: change });
  const element = h(
    "div",
    { class: "field" },
    h("label", { for: id }, label, unit ? h("span", { class: "unit" }, ` [${unit}]`) : null),
    input,
    note,
  );
  return { element, input, set };
}

/**
 * A slider with a number next to it. Positions are 0 to 1000, mapped by `scale`.
 * @param {{label: string, unit?: string,
 *   scale: {to: function(number): number, from: function(number): number}, digits?: number, min?: number,
 *   max?: number, input: function(number): void, commit: function(): void}} options
 */
export function slider({ label, unit = "", scale, digits = 4, min, max, input, commit }) {
  const id = unique("slider");
  const range = h("input", { id, type: "range", min: 0, max: 1000, step: 1 });
  const field = typedNumber({
    label: unit ? `${label} [${unit}]` : label,
    min,
    max,
    commit: (value) => {
      input(value);
      commit();
    },
  });
  // The number that the slider itself has set: its position stays, though the number is rounded.
  let own = "";
  range.addEventListener("input", () => {
    const value = Number(scale.to(range.valueAsNumber / 1000).toPrecision(Math.max(3, digits - 3)));
    own = fieldText(value);
    set(value);
    input(value);
  });
  range.addEventListener("change", commit);
  const element = h(
    "div",
    { class: "slider" },
    h("label", { for: id }, label, unit ? h("span", { class: "unit" }, ` [${unit}]`) : null),
    range,
    field.input,
    field.note,
  );
  const set = (value) => {
    field.set(value);
    if (fieldText(value) !== own) {
      own = "";
      range.value = String(Math.round(1000 * scale.from(value)));
    }
    range.setAttribute("aria-valuetext", `${Number(value.toPrecision(digits))} ${unit}`.trim());
  };
  return { element, set };
}

/** The scale of a slider from `min` to `max`, in equal steps. */
export function linear(min, max) {
  return {
    to: (t) => min + (max - min) * t,
    from: (value) => Math.min(1, Math.max(0, (value - min) / (max - min))),
  };
}

/** The scale of a slider from `min` to `max`, both positive, in equal ratios. */
export function logarithmic(min, max) {
  const ratio = Math.log(max / min);
  return {
    to: (t) => min * Math.exp(ratio * t),
    from: (value) => Math.min(1, Math.max(0, Math.log(Math.max(value, min) / min) / ratio)),
  };
}

/**
 * A button.
 * @param {string} text
 * @param {function(): void} press
 * @param {Object<string, *>} [properties]
 */
export function button(text, press, properties = {}) {
  return h("button", { type: "button", onclick: press, ...properties }, text);
}

/**
 * A choice of one among a few, as a row of radio buttons.
 * @param {string} legend
 * @param {Array<[string, string, string?]>} options value, text and hint of each
 * @param {function(string): void} choose
 */
export function choice(legend, options, choose) {
  const name = unique("choice");
  const inputs = options.map(([value, , hint]) =>
    h("input", {
      type: "radio",
      name,
      value,
      title: hint,
      onchange: () => choose(value),
    }),
  );
  const element = h(
    "fieldset",
    { class: "choice" },
    h("legend", {}, legend),
    ...inputs.map((input, k) => h("label", { title: options[k][2] }, input, h("span", {}, options[k][1]))),
  );
  const set = (value) => {
    for (const input of inputs) input.checked = input.value === value;
  };
  return { element, set };
}

/** A list to choose from. */
export function select(label, options, choose) {
  const id = unique("select");
  const box = h(
    "select",
    { id, onchange: () => choose(box.value) },
    ...options.map(([value, text]) => h("option", { value }, text)),
  );
  const element = h("div", { class: "field" }, h("label", { for: id }, label), box);
  return {
    element,
    set: (value) => {
      box.value = value;
    },
  };
}

/** A box to tick. */
export function check(label, toggle, hint) {
  const input = h("input", { type: "checkbox", onchange: () => toggle(input.checked) });
  const element = h("label", { class: "check", title: hint }, input, h("span", {}, label));
  return {
    element,
    set: (value) => {
      input.checked = value;
    },
  };
}
