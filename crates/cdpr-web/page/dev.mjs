// Writes the page of a robot as one file: `node dev.mjs ROBOT.json OUT.html [--mock] [--embedded]`. Module
// and worker are those of ../dist.

import { readFile, writeFile, mkdtemp } from "node:fs/promises";
import vm from "node:vm";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { bundle } from "./build.mjs";

const here = path.dirname(fileURLToPath(import.meta.url));
const [robot, out] = process.argv.slice(2).filter((word) => !word.startsWith("--"));
const mock = process.argv.includes("--mock");
const dist = await mkdtemp(path.join(tmpdir(), "cdprx-"));
await bundle({ out: dist, mock, worker: mock });
const read = (name) => readFile(path.join(dist, name), "utf8");
const made = (name) => path.join(here, "../dist", name);
// The smallest module stands for the real one, where the engine is the stand-in.
const module = mock
  ? Buffer.from([0, 97, 115, 109, 1, 0, 0, 0])
  : await unpacked(made("cdpr_web.wasm.lzma"));
const worker = mock ? await read("worker.js") : await readFile(made("worker.js"), "utf8");
const script = (text) => text.replaceAll("</script", "<\\/script");
const policy = [
  "default-src 'none'",
  "script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:",
  "style-src 'unsafe-inline'",
  "img-src data: blob:",
  "worker-src blob:",
  "connect-src 'none'",
].join("; ");
const page = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${path.basename(robot)}</title>
<style>${await read("explorer.css")}</style>
</head>
<body>
<div id="explorer"></div>
<script type="text/plain" id="worker">${script(worker)}</script>
<script type="text/plain" id="module">${module.toString("base64")}</script>
<script type="application/json" id="robot">${script(await readFile(robot, "utf8"))}</script>
<script>${script(await read("explorer.js"))}</script>
<script>
(async () => {
  const text = (id) => document.getElementById(id).textContent;
  const module = Uint8Array.from(atob(text("module")), (letter) => letter.charCodeAt(0)).buffer;
  window.live = cdprExplorer.mount(document.getElementById("explorer"), {
    robot: JSON.parse(text("robot")), module, worker: text("worker"),
    name: ${JSON.stringify(path.basename(robot))},
    embedded: ${process.argv.includes("--embedded")},
  });
})();
</script>
</body>
</html>
`;
await writeFile(out, page);

async function unpacked(file) {
  const lzma = await readFile(path.join(here, "../../cdpr-report/src/live/lzma.js"), "utf8");
  return Buffer.from(vm.runInThisContext(`${lzma}; unlzma`)(await readFile(file)));
}
console.log(`${out}: ${page.length} bytes`);
