// What the panel of motions says.

import assert from "node:assert/strict";
import test from "node:test";
import { noteOf } from "../panels/motions.js";

test("frequencies of cables that are slower than the platform are warned of", () => {
  const said = (modes) => noteOf({ modes: { found: modes }, reduced: false, mechanics: {} });
  assert.match(
    said({ warning: "the cables vibrate at 0.5 Hz\n    and more", neutral: 0 }),
    /^Note: the cables vibrate at 0\.5 Hz and more\. With the load/,
  );
  assert.doesNotMatch(said({ warning: null, neutral: 0 }), /Note/);
});
