// Unpacks the module and starts the explorer.
"use strict";
(async () => {
  const element = document.getElementById("explorer");
  const text = (id) => document.getElementById(id).textContent;
  const say = (reason) => {
    const note = document.createElement("p");
    note.className = "cdpr-failure";
    note.setAttribute("role", "alert");
    note.textContent = `The robot cannot be computed here: ${reason}`;
    element.replaceChildren(note);
  };
  // The smallest module that uses the vector unit: v128.const, dropped.
  const WITH_LANES = [0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 23, 1, 21, 0, 253, 12,
    ...new Array(16).fill(0), 26, 11];
  try {
    if (typeof WebAssembly === "undefined" || typeof DecompressionStream === "undefined") {
      say("this browser has no WebAssembly, or cannot unpack data; take one of 2023 or later.");
      return;
    }
    const lanes = WebAssembly.validate(new Uint8Array(WITH_LANES));
    const packed = Uint8Array.from(atob(text(lanes ? "module" : "module-scalar")), (c) => c.charCodeAt(0));
    const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const module = await new Response(unpacked).arrayBuffer();
    const { robot, study, file } = JSON.parse(text("data"));
    cdprExplorer.mount(element, { robot, study, name: file, state: null, module, worker: text("worker") });
  } catch (error) {
    say(error.message);
  }
})();
