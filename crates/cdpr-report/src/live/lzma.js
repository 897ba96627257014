// Unpacks a file of `xz --format=lzma`: a range coder of bits over literals and matches (I. Pavlov, LZMA
// specification, 2015, whose names these are).
"use strict";
const probabilities = (size) => new Uint16Array(size).fill(1024);

// Reads bits of the bytes from `next` on, each with a probability that adapts.
function rangeCoder(packed, next) {
  let range = 0xffffffff;
  let code = 0;
  for (const end = next + 4; next < end; next++) code = ((code << 8) | packed[next]) >>> 0;
  return { bit, direct, tree, reverse };

  function bit(probs, at) {
    const bound = (range >>> 11) * probs[at];
    const is = code >= bound ? 1 : 0;
    if (is) {
      range -= bound;
      code -= bound;
      probs[at] -= probs[at] >> 5;
    } else {
      range = bound;
      probs[at] += (2048 - probs[at]) >> 5;
    }
    if (range < 0x1000000) {
      range = (range << 8) >>> 0;
      code = ((code << 8) | packed[next++]) >>> 0;
    }
    return is;
  }

  function direct(bits) {
    let value = 0;
    for (; bits > 0; bits--) {
      range >>>= 1;
      const is = code >= range ? 1 : 0;
      if (is) code -= range;
      value = 2 * value + is;
      if (range < 0x1000000) {
        range = (range << 8) >>> 0;
        code = ((code << 8) | packed[next++]) >>> 0;
      }
    }
    return value;
  }

  // A number of that many bits, the most significant one first; with `reverse` the last one first.
  function tree(probs, bits, first = 0) {
    let m = 1;
    for (let k = 0; k < bits; k++) m = 2 * m + bit(probs, first + m);
    return m - (1 << bits);
  }

  function reverse(probs, bits, first = 0) {
    let [m, value] = [1, 0];
    for (let k = 0; k < bits; k++) {
      const is = bit(probs, first + m);
      m = 2 * m + is;
      value |= is << k;
    }
    return value;
  }
}

const unlzma = (packed) => {
  const lc = packed[0] % 9;
  const lp = Math.floor(packed[0] / 9) % 5;
  const pb = Math.floor(packed[0] / 45);
  let out = new Uint8Array(4 * packed.length);
  let size = 0;
  // Behind properties, size of the dictionary and of the file (13 bytes), and a byte that is always zero.
  const { bit, direct, tree, reverse } = rangeCoder(packed, 14);

  function lengths() {
    const [choice, low, mid, high] = [2, 128, 128, 256].map(probabilities);
    return (posState) => {
      if (!bit(choice, 0)) return 2 + tree(low, 3, 8 * posState);
      return bit(choice, 1) ? 18 + tree(high, 8) : 10 + tree(mid, 3, 8 * posState);
    };
  }

  const literals = probabilities(0x300 << (lc + lp));
  const [isMatch, isRep0Long] = [192, 192].map(probabilities);
  const [isRep, isRepG0, isRepG1, isRepG2] = [12, 12, 12, 12].map(probabilities);
  const [slots, positions, align] = [256, 128, 16].map(probabilities);
  const [matchLength, repLength] = [lengths(), lengths()];
  let state = 0;
  let rep = [0, 0, 0, 0];

  function literal() {
    const before = size > 0 ? out[size - 1] : 0;
    const first = 0x300 * (((size & ((1 << lp) - 1)) << lc) | (before >> (8 - lc)));
    let symbol = 1;
    if (state >= 7) {
      let match = out[size - rep[0] - 1];
      while (symbol < 256) {
        const top = (match >> 7) & 1;
        match <<= 1;
        const is = bit(literals, first + ((1 + top) << 8) + symbol);
        symbol = 2 * symbol + is;
        if (is !== top) break;
      }
    }
    while (symbol < 256) symbol = 2 * symbol + bit(literals, first + symbol);
    out[size++] = symbol;
    state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
  }

  function distance(length) {
    const slot = tree(slots, 6, 64 * Math.min(length - 2, 3));
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    const base = (2 | (slot & 1)) * 2 ** bits;
    if (slot < 14) return base + reverse(positions, bits, base - slot);
    return base + direct(bits - 4) * 16 + reverse(align, 4);
  }

  // The length of a match with one of the last four distances; 1 of a byte.
  function repeated(at, posState) {
    if (!bit(isRepG0, state)) {
      if (bit(isRep0Long, at)) return repLength(posState);
      state = state < 7 ? 9 : 11;
      return 1;
    }
    const which = bit(isRepG1, state) ? 2 + bit(isRepG2, state) : 1;
    rep.unshift(...rep.splice(which, 1));
    return repLength(posState);
  }

  for (;;) {
    if (size + 300 > out.length) {
      const grown = new Uint8Array(2 * out.length);
      grown.set(out);
      out = grown;
    }
    const posState = size & ((1 << pb) - 1);
    const at = 16 * state + posState;
    if (!bit(isMatch, at)) {
      literal();
      continue;
    }
    let length;
    if (bit(isRep, state)) {
      length = repeated(at, posState);
      if (length > 1) state = state < 7 ? 8 : 11;
    } else {
      length = matchLength(posState);
      rep = [distance(length), rep[0], rep[1], rep[2]];
      // The mark of the end.
      if (rep[0] === 0xffffffff) return out.slice(0, size);
      state = state < 7 ? 7 : 10;
    }
    if (rep[0] >= size) throw new Error("the packed data are damaged");
    for (; length > 0; length--, size++) out[size] = out[size - rep[0] - 1];
  }
};
