// Asks the stored module by the worker of the page: `node ask.mjs`, with {robot, asks} on the standard
// input and the list of answers on the standard output.

import { readFileSync } from "node:fs";
import vm from "node:vm";

const dist = new URL("../dist/", import.meta.url);
const lzma = new URL("../../cdpr-report/src/live/lzma.js", import.meta.url);
const unlzma = vm.runInThisContext(`${readFileSync(lzma, "utf8")}; unlzma`);
const module = unlzma(readFileSync(new URL("cdpr_web.wasm.lzma", dist)));
const said = [];
globalThis.self = { postMessage: (message) => said.push(message) };
vm.runInThisContext(readFileSync(new URL("worker.js", dist), "utf8"));
self.onmessage({ data: { module } });
if (!said.at(-1).ready) throw new Error(`the module does not start: ${said.at(-1).broken}`);
const { robot, asks } = JSON.parse(readFileSync(0, "utf8"));
self.onmessage({ data: { id: 1, version: 0, robot, asks } });
process.stdout.write(JSON.stringify(said.at(-1).answers));
