// Packs a file by gzip as small as zopfli can make it, 5 % smaller than gzip -9: `node pack.mjs FILE PACKED`.

import { readFile, writeFile } from "node:fs/promises";
import zopfli from "@gfx/zopfli";

const [file, packed] = process.argv.slice(2);
await writeFile(packed, await zopfli.gzipAsync(await readFile(file), { numiterations: 15 }));
