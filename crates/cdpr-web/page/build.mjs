// Bundles the page into crates/cdpr-web/dist: `npm run build`. With `--mock` the module is a stand-in.

import { build } from "esbuild";
import { readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import path from "node:path";

const here = path.dirname(fileURLToPath(import.meta.url));

/**
 * @param {{out: string, mock?: boolean, worker?: boolean}} options `worker`: whether the worker is bundled,
 *   too, for which wasm-bindgen has to have written `pkg`
 */
export async function bundle({ out, mock = false, worker = true }) {
  const common = {
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    legalComments: "inline",
    charset: "utf8",
    logLevel: "warning",
    define: { "import.meta.url": '""' },
  };
  const standIn = {
    name: "mock",
    setup: ({ onResolve }) => {
      onResolve({ filter: /pkg\/cdpr_web\.js$/ }, () => ({ path: path.join(here, "test/mock-live.js") }));
    },
  };
  const license = await readFile(path.join(here, "node_modules/three/LICENSE"), "utf8");
  const banner = { js: `/*! With three.js:\n${license}*/` };
  await Promise.all([
    build({
      ...common,
      banner,
      entryPoints: [path.join(here, "main.js")],
      outfile: path.join(out, "explorer.js"),
      globalName: "cdprExplorer",
    }),
    worker &&
      build({
        ...common,
        entryPoints: [path.join(here, "worker.js")],
        outfile: path.join(out, "worker.js"),
        plugins: mock ? [standIn] : [],
      }),
    build({
      entryPoints: [path.join(here, "explorer.css")],
      outfile: path.join(out, "explorer.css"),
      minify: true,
      logLevel: "warning",
    }),
  ]);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await bundle({ out: path.join(here, "../dist"), mock: process.argv.includes("--mock") });
}
