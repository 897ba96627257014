import assert from "node:assert/strict";
import { test } from "node:test";
import { bins, quantile, summary } from "../charts/statistics.js";
import { css, map, roundUp, ticks, viridis } from "../charts/scale.js";
import {
  digits,
  entryWords,
  lengthUnit,
  parameterWords,
  readable,
  residual,
  short,
  vectorShort,
  withUnit,
} from "../format.js";
import { undoStep } from "../dom.js";
import { observationsCsv } from "../export.js";
import { fieldText, parseNumber } from "../numbers.js";
import { groundWords, notHeld } from "../panels/stage.js";
import { between } from "../mechanics.js";
import { affordable } from "../sampling.js";
import { angles, product, quaternion, turned, turnedAngles, vectorBetween } from "../rotation.js";

const close = (a, b, tolerance = 1e-12) =>
  a.forEach((value, k) => assert.ok(Math.abs(value - b[k]) < tolerance, `${a} is not ${b}`));

test("statistics of a few values", () => {
  const found = summary([4, null, 1, 3, 2]);
  assert.equal(found.count, 4);
  assert.equal(found.failed, 1);
  assert.equal(found.mean, 2.5);
  assert.ok(Math.abs(found.std - Math.sqrt(5 / 3)) < 1e-15);
  assert.equal(found.q50, 2.5);
  assert.equal(quantile([0, 10], 0.05), 0.5);
});

test("every observation is in one bin", () => {
  const values = Array.from({ length: 1000 }, (_, k) => Math.sin(k) + k / 500);
  const { edges, counts } = bins(summary(values));
  assert.equal(
    counts.reduce((a, b) => a + b),
    1000,
  );
  assert.equal(edges.length, counts.length + 1);
  assert.deepEqual(bins(summary([2, 2, 2])), { edges: [2, 2], counts: [3] });
});

test("a sample without values has a count only", () => {
  assert.deepEqual(summary([null, null]), { count: 0, failed: 2 });
});

test("ticks are round and within the ends", () => {
  assert.deepEqual(ticks(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1]);
  assert.deepEqual(ticks(-0.3, 0.3, 3), [-0.2, 0, 0.2]);
  assert.equal(roundUp(0.0123), 0.015);
  assert.equal(roundUp(800), 1000);
  assert.equal(map([2, 4], [10, 20])(3), 15);
});

test("colours begin and end where they should", () => {
  assert.equal(css(viridis(0)), "#440154");
  assert.equal(css(viridis(1)), "#fde725");
  assert.equal(css(viridis(7)), "#fde725");
});

test("numbers as they are shown", () => {
  assert.equal(digits(0.00123456), "0.001235");
  assert.equal(digits(-12.5, 2), "−13");
  assert.equal(digits(1234567), "1.235e6");
  assert.equal(digits(null), "none");
  assert.equal(withUnit(54764.8, "N/m"), "54.76 kN/m");
  assert.equal(withUnit(540.12, "N"), "540.1 N");
  assert.equal(short(0.00754), "7.540 mm");
  assert.equal(short(25), "25.00 m");
  assert.equal(residual(3.6e-15, "m"), "3.6e-15 m");
});

test("names of parameters in words", () => {
  assert.equal(parameterWords("a3.x"), "anchor point 3 x");
  assert.equal(parameterWords("cog.z"), "centre of mass z");
  assert.equal(parameterWords("dt12"), "tension set-point 12");
  assert.equal(parameterWords("tilt1.u"), "pulley tilt 1 u");
  assert.equal(parameterWords("youngs_modulus"), "cable modulus");
  assert.equal(parameterWords("pulley block"), "pulley block");
  assert.equal(entryWords("b"), "exit points");
});

test("angles and quaternions are each other's inverse", () => {
  for (const rpy of [
    [0, 0, 0],
    [10, -20, 30],
    [-170, 60, 100],
    [5, 0, 179],
  ]) {
    close(angles(quaternion(rpy)), rpy, 1e-9);
    assert.ok(quaternion(rpy)[0] >= 0);
  }
});

test("R = Rz(yaw) Ry(pitch) Rx(roll)", () => {
  close(turned(quaternion([90, 0, 90]), [0, 1, 0]), [0, 0, 1]);
  close(turned(quaternion([0, 0, 90]), [1, 0, 0]), [0, 1, 0]);
});

test("a turn about an axis of the base frame comes after the rotation", () => {
  close(turnedAngles([10, 0, 90], 2, 5), [10, 0, 95], 1e-9);
  const by = vectorBetween(quaternion([10, 20, 30]), quaternion(turnedAngles([10, 20, 30], 0, 7)));
  close(by, [(7 * Math.PI) / 180, 0, 0]);
});

test("the rotation between two quaternions takes the one to the other", () => {
  const [a, b] = [quaternion([10, 20, 30]), quaternion([-40, 5, 170])];
  const vector = vectorBetween(a, b);
  const angle = Math.hypot(...vector);
  const step = [Math.cos(angle / 2), ...vector.map((part) => (part / angle) * Math.sin(angle / 2))];
  const found = product(step, a);
  close(
    found.map((part) => part * Math.sign(found[0])),
    b,
  );
});

test("rounding errors of two equilibria are no displacement", () => {
  const at = (z, angle) => ({ pose: [1, 2, z, Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)] });
  const same = between(at(3, 0), at(3 + 4e-13, 1e-12));
  assert.deepEqual(same, { displacement: [0, 0, 0], rms: 0, rotation: [0, 0, 0] });
  const moved = between(at(3, 0), at(3 - 1e-6, 0));
  close([...moved.displacement, moved.rms], [0, 0, -1e-6, 1e-6]);
  close(between(at(3, 0), at(3, 1e-4)).rotation, [0, 0, 1e-4], 1e-9);
  assert.equal(between(null, at(3, 0)).rms, null);
});

test("observations are as many as their time allows, and a power of two", () => {
  assert.equal(affordable(100, 0.01, 20000), 8192);
  assert.equal(affordable(2500, 0.01, 20000), 20000);
  assert.equal(affordable(100, 50, 2048), 16);
});

test("a vector has the decimals that its length needs", () => {
  assert.equal(vectorShort([6.4e-17, -2e-16, -0.00048]), "(0, 0, −0.48) mm");
  assert.equal(vectorShort([0.0127, -0.0003, 0]), "(12.7, −0.3, 0) mm");
  assert.equal(vectorShort([0, 0, 3.4804]), "(0, 0, 3.48) m");
  assert.equal(vectorShort([0, 0, 0]), "(0, 0, 0) mm");
});

test("a number may have a decimal comma", () => {
  const read = (text) => parseNumber(text).value;
  assert.deepEqual(
    ["1.7", "1,7", " 2,5 ", "−0,5", "+3", ".5", ",5", "5.", "1,5e-3"].map(read),
    [1.7, 1.7, 2.5, -0.5, 3, 0.5, 0.5, 5, 0.0015],
  );
  assert.ok(Object.is(read("-0"), 0));
});

test("what is no number, or none in its range, has a problem in words", () => {
  for (const text of ["abc", "1.2.3", "1,234.5", "1 000", "0x10", "Infinity", "1e999", "12 kg", "--1"])
    assert.match(parseNumber(text).problem, /is not a number/, text);
  assert.match(parseNumber(" ").problem, /Type a number/);
  assert.match(
    parseNumber("-5", { min: 0, why: "the ground is there" }).problem,
    /least value is 0: the ground/,
  );
  assert.match(parseNumber("9", { max: 8 }).problem, /greatest value is 8/);
});

test("what a field shows is read back as the same number", () => {
  for (const value of [0, 1.7, -9.486832981, 1e-7, 2.5e12]) {
    assert.equal(parseNumber(fieldText(value)).value, value);
  }
  assert.equal(fieldText(6.5062500000000005), "6.50625");
});

test("lengths have the unit that their size asks for", () => {
  assert.equal(short(7.844e-7), "0.7844 µm");
  assert.equal(short(-9.9e-5), "−99.00 µm");
  assert.equal(short(0), "0 mm");
  assert.equal(vectorShort([0, 0, -7.844e-7]), "(0, 0, −0.784) µm");
  assert.deepEqual(
    [2, 0.5, 1e-4, 9e-5].map((size) => lengthUnit(size)[1]),
    ["m", "mm", "mm", "µm"],
  );
});

test("reasons of the models have no more digits than a reader wants", () => {
  assert.equal(
    readable("at position (0, -1.25, 6.5062500000000005) m: 3.552713678800501e-15 N, 10.4 %"),
    "at position (0, -1.25, 6.50625) m: 3.552714e-15 N, 10.4 %",
  );
});

test("a failure after an equilibrium was found does not say that there is none", () => {
  const [kept, posed] = [{ way: "kept" }, { way: "pose" }];
  assert.equal(notHeld(kept, { kind: "direct_not_converged" }), "No equilibrium found on these lengths");
  assert.equal(notHeld(posed, { kind: "infeasible_tension" }), "Not held here");
  for (const kind of ["cable_overstrained", "overstrained"])
    assert.match(notHeld(kept, { kind }), /^Beyond the strain for which the models hold/);
  for (const kind of [
    "unstable",
    "indifferent",
    "not_unique",
    "inverse_not_converged",
    "equilibrium_lost",
    "invalid_input",
  ])
    assert.doesNotMatch(notHeld(kept, { kind }), /No equilibrium|Not held/, kind);
});

test("a platform at the ground, and anchor points and cables below it, are told", () => {
  const app = (z, lowest, ground = 0) => ({
    ground,
    store: { state: { position: [0, 0, z] } },
    mechanics: {
      picture: {
        loaded: {
          anchors: [
            [0, 0, 1],
            [0, 0, lowest],
          ],
        },
      },
    },
  });
  assert.equal(groundWords(app(1, 0.5)), "");
  assert.match(groundWords(app(0, 0.1)), /at the ground, z = 0 m, and goes no lower/);
  assert.match(groundWords(app(0.2, -0.3)), /below the ground, z = 0 m: down to z = −0.3000 m/);
  assert.equal(groundWords(app(-5, -6, null)), "");
  const hanging = app(1, 0.5);
  hanging.mechanics.picture.loaded.cables = [
    [0, 0, 3, 1, 0, 0.2],
    [0, 0, 3, 1, 0, -8],
  ].map((points) => ({ points }));
  assert.equal(groundWords(hanging), "Cables that hang below the ground, z = 0 m: 2.");
});

test("keys of undo and redo", () => {
  const keys = (key, more) => undoStep({ key, ctrlKey: true, metaKey: false, shiftKey: false, ...more });
  assert.deepEqual(
    [keys("z"), keys("Z", { shiftKey: true }), keys("y"), keys("a")],
    ["undo", "redo", "redo", null],
  );
  assert.equal(keys("z", { ctrlKey: false }), null);
  assert.equal(keys("z", { ctrlKey: false, metaKey: true }), "undo");
});

test("a table of observations has seed, inputs with units, outputs, and reasons of failures", () => {
  const inputs = [
    { name: "mass", unit: "kg" },
    { name: "weather", unit: null },
  ];
  const failure = { kind: "infeasible_tension", reason: 'none, "at all"' };
  const text = observationsCsv({
    seed: 7,
    inputs,
    outputs: ["dx_mm", "rms_mm"],
    rows: [
      { inputs: [1.5, -0.25], outputs_mm: [0.5, 2], failure: null },
      { inputs: [0, 3], outputs_mm: null, failure },
    ],
  });
  assert.deepEqual(text.split("\n"), [
    "index,seed,d_mass [kg],d_weather,dx_mm,rms_mm,status,reason",
    "0,7,1.5,-0.25,0.5,2,ok,",
    '1,7,0,3,,,infeasible_tension,"none, ""at all"""',
    "",
  ]);
});
