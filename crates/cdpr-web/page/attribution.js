// Which tolerance matters most, by effects, and whether effects can say it.

import { tolerances } from "./robot.js";

// Robots from which on a tolerance is named: effects of fewer are mostly chance.
const ENOUGH = 512;
// Share of the variance below which effects say nothing about what matters.
const HALF = 0.5;

/**
 * Shares of the tolerances in the variance, by effects: the variance of a parameter that acts linearly is its
 * effect squared over 3 (uniform law), or over 8/π (normal law).
 * @param {Array<{entry: string, effect_mm: number}>} effects
 * @param {Object<string, object>} entries those of the error model
 * @param {number} chance the mean square of an effect by chance [mm²], which the squares are corrected by
 * @returns {{parts: Array<{entry: string, share: number}>, variance: number}} the largest first, and their
 *   variance [mm²] together
 */
export function shares(effects, entries, chance = 0) {
  const sums = new Map();
  for (const { entry, effect_mm } of effects) {
    const law = entries[entry]?.law ?? {};
    const part = (effect_mm ** 2 - chance) / ("normal" in law ? 8 / Math.PI : 3);
    sums.set(entry, (sums.get(entry) ?? 0) + part);
  }
  const positive = [...sums].map(([entry, part]) => [entry, Math.max(0, part)]);
  const variance = positive.reduce((sum, [, part]) => sum + part, 0);
  const parts = positive
    .map(([entry, part]) => ({ entry, share: variance > 0 ? part / variance : 0 }))
    .sort((a, b) => b.share - a.share);
  return { parts, variance };
}

/**
 * What the effects say about the tolerances. An effect has a sign: a parameter that acts by its size alone
 * has none, however much it matters, so that effects that explain little of the variance say nothing.
 * @param {object} effects those of a sampling: inputs, replicates, observations of each, their variance [mm²]
 * @param {object} study
 * @returns {{robots: number, parts: Array<{entry: string, share: number}>, explained: number,
 *   few: boolean, little: boolean, winner: string|null}}
 */
export function attribution(effects, study) {
  const { inputs, replicates, observations, variance } = effects;
  const robots = replicates * observations;
  const chance = (4 * variance) / robots;
  const { parts, variance: linear } = shares(inputs, tolerances(study), chance);
  const explained = variance > 0 ? Math.min(1, linear / variance) : 0;
  const [few, little] = [robots < ENOUGH, explained < HALF];
  const [top, second] = parts.map(({ share }) => share * explained);
  // What the effects leave open may be of any other tolerance.
  const isFirst = !few && !little && top > (second ?? 0) + 1 - explained;
  return { robots, parts, explained, few, little, winner: isFirst ? parts[0].entry : null };
}

/** Why the tolerances have no shares; empty where they have. */
export function blankWords({ few, little, explained }) {
  if (few) return `No shares yet: expected ${ENOUGH} robots at least.`;
  return little ? `No shares: ${littleWords(explained)}` : "";
}

/** That effects explain little. */
export function littleWords(explained) {
  return `the effects explain ${explainedPercent(explained)} of the variance.`;
}

/** The share of the variance that effects explain. */
export function explainedPercent(explained) {
  return explained < 0.01 ? "less than 1 %" : `${Math.round(100 * explained)} %`;
}
