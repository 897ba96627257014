// Numbers as people type them: the one place where text becomes a number.

const DECIMAL = /^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i;

/**
 * The number that a text means, with a decimal point or a decimal comma.
 * @param {string} text
 * @param {{min?: number, max?: number, why?: string}} [range] `why`: what bounds the number, in words
 * @returns {{value: number}|{problem: string}} the problem as a sentence
 */
export function parseNumber(text, { min = -Infinity, max = Infinity, why = "" } = {}) {
  const plain = text.trim().replaceAll("−", "-");
  if (plain === "") return { problem: "Type a number, such as 1.7." };
  const value = DECIMAL.test(plain) ? Number(plain.replace(",", ".")) : NaN;
  if (!Number.isFinite(value)) return { problem: `“${text.trim()}” is not a number: type one such as 1.7.` };
  const [bound, words] = value < min ? [min, "least"] : value > max ? [max, "greatest"] : [null];
  if (bound === null) return { value: value || 0 };
  const reason = why ? `: ${why}` : "";
  return { problem: `The ${words} value is ${fieldText(bound)}${reason}.` };
}

/** A number as a field shows it, such that `parseNumber` reads the same number back. */
export function fieldText(value) {
  return String(Number(value.toPrecision(10)));
}
