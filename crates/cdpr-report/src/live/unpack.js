// What the page carries packed: scripts, and the models of a robot that computes here.
"use strict";
const packed = (() => {
  const text = (id) => document.getElementById(id)?.textContent;

  const bytes = (id) => unlzma(decoded(text(id))).buffer;

  // The bytes of a text of the base 85: five characters are four bytes, from `(` on, with `!` for `<`.
  function decoded(digits) {
    const data = new Uint8Array(Math.floor((4 * digits.length) / 5));
    for (let i = 0, place = 0; i < digits.length; i += 5) {
      let value = 0;
      for (let k = i; k < i + 5; k++) {
        const code = k < digits.length ? digits.charCodeAt(k) : 124;
        value = 85 * value + (code === 33 ? 60 : code) - 40;
      }
      for (let shift = 24; shift >= 0 && place < data.length; shift -= 8) data[place++] = value >>> shift;
    }
    return data;
  }

  const loaded = new Map();

  // Runs a packed script, once.
  function run(id) {
    if (!loaded.has(id)) loaded.set(id, load(id));
    return loaded.get(id);
  }

  async function load(id) {
    const address = URL.createObjectURL(new Blob([bytes(id)], { type: "text/javascript" }));
    const script = document.createElement("script");
    const done = new Promise((resolve, reject) => {
      script.onload = resolve;
      script.onerror = () => reject(new Error(`the script ${id} does not run`));
    });
    script.src = address;
    document.head.append(script);
    await done;
    URL.revokeObjectURL(address);
  }

  // Puts a robot that computes into an element; returns what `mount` of the page of cdpr-web does.
  async function explore(element, options) {
    try {
      if (typeof WebAssembly === "undefined") throw new Error("this browser has no WebAssembly");
      await run("explorer-script");
      return cdprExplorer.mount(element, { ...options, module: bytes("module"), worker: text("worker") });
    } catch (error) {
      const note = document.createElement("p");
      note.setAttribute("role", "alert");
      note.textContent = `The robot cannot be computed here: ${error.message}.`;
      element.replaceChildren(note);
      return null;
    }
  }

  return { bytes, run, explore };
})();
