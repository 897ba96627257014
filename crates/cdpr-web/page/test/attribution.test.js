import assert from "node:assert/strict";
import { test } from "node:test";
import { attribution, blankWords, shares } from "../attribution.js";
import { effectBars } from "../charts/effects.js";
import { effectsTitle, sentence } from "../panels/charts.js";

const uniform = (half) => ({ law: { uniform: { min: -half, max: half } } });
const study = {
  error_models: { t: { youngs_modulus: uniform(1), cog: uniform(1), a: uniform(1) } },
  samplings: { all: { error_model: "t" } },
};

// Effects of a modulus, the centre of mass and two anchor points [mm], of the observations' variance [mm²].
const of = (modulus, { variance, cog = 0.1, observations = 2048 }) => ({
  inputs: [
    { name: "youngs_modulus", entry: "youngs_modulus", effect_mm: modulus },
    { name: "cog.x", entry: "cog", effect_mm: cog },
    { name: "a1.x", entry: "a", effect_mm: 0 },
    { name: "a2.x", entry: "a", effect_mm: 0 },
  ].map((one) => ({ ...one, low_mm: one.effect_mm - 0.01, high_mm: one.effect_mm + 0.01 })),
  replicates: 4,
  observations,
  variance,
});

const said = (effects, more = {}) =>
  sentence({
    robot: { study },
    sampling: { effects, sample: { failed: {}, observations: 1 }, hasEffects: true, ...more },
  });

test("shares follow from squared effects and add up to one", () => {
  const effects = [
    { entry: "a", effect_mm: 3 },
    { entry: "a", effect_mm: -4 },
    { entry: "b", effect_mm: 5 },
  ];
  const { parts, variance } = shares(effects, { a: uniform(1), b: uniform(1) });
  for (const { share } of parts) assert.ok(Math.abs(share - 0.5) < 1e-15);
  assert.ok(Math.abs(variance - 50 / 3) < 1e-12);
  assert.deepEqual(shares([{ entry: "a", effect_mm: 0 }], {}).parts, [{ entry: "a", share: 0 }]);
});

test("a tolerance matters most where its effect explains nearly all of the variance", () => {
  const effects = of(3, { variance: 3.1 });
  assert.equal(attribution(effects, study).winner, "youngs_modulus");
  assert.match(said(effects), /matters most here: youngs_modulus \(cable modulus\), with 100 % of what/);
  assert.match(said(effects), /97 % of the variance/);
  assert.equal(blankWords(attribution(effects, study)), "");
});

test("effects that explain little name no tolerance, and say how little", () => {
  // The centre of mass acts by its distance from the middle alone: no sign, no effect, most of the variance.
  const effects = of(3, { variance: 15 });
  const found = attribution(effects, study);
  assert.deepEqual([found.little, found.winner], [true, null]);
  assert.match(said(effects), /not known here: the effects explain 20 % of the variance/);
  assert.doesNotMatch(said(effects), /modulus/);
  assert.match(blankWords(found), /No shares: the effects explain 20 % of the variance/);
});

test("a tolerance is no winner if what is not explained may be of another one", () => {
  const effects = of(3, { variance: 6.5, cog: 1.7 });
  assert.equal(attribution(effects, study).winner, null);
  assert.doesNotMatch(said(effects), /tolerance that matters/);
  assert.match(said(effects), /explain 61 % of the variance; of that youngs_modulus .* has most, 76 %/);
});

test("few robots name no tolerance", () => {
  const effects = of(3, { variance: 3.1, observations: 16 });
  assert.equal(attribution(effects, study).winner, null);
  for (const busy of [true, false]) assert.doesNotMatch(said(effects, { busy }), /modulus/);
  assert.match(said(effects, { busy: true }), /So far 4 times 16 robots are observed/);
  assert.match(said(effects), /4 times 16 robots are too few/);
  assert.match(blankWords(attribution(effects, study)), /512 robots at least/);
  assert.doesNotMatch(said(effects, { busy: true, hasEffects: false }), /modulus/);
});

test("squares of effects that are chance explain nothing", () => {
  // Of 128 times 4 robots each effect is 2 / sqrt(512) standard deviations by chance.
  const inputs = Array.from({ length: 150 }, (_, k) => ({
    name: `a${k}.x`,
    entry: "a",
    effect_mm: (2 / Math.sqrt(512)) * (k % 2 ? 1 : -1),
  }));
  const found = attribution({ inputs, replicates: 4, observations: 128, variance: 1 }, study);
  assert.ok(found.explained < 1e-9, String(found.explained));
});

test("inputs have the names that files and reports give them", () => {
  const effects = of(3, { variance: 3.1 });
  const bars = effectBars(effects.inputs, { width: 500, title: effectsTitle(effects) }, {});
  assert.match(bars, />youngs_modulus</);
  assert.match(effectsTitle(effects), /youngs_modulus 3\.00 m/);
});
