import assert from "node:assert/strict";
import { test } from "node:test";
import { decode, encode, initial, restore, Store } from "../state.js";

const robot = {
  name: "two",
  cables: 2,
  free: [],
  start: { pose: [0.1, 0.2, 1.5, 1, 0, 0, 0], payload: 5 },
  study: { samplings: { all: { observations: 512 } } },
};

test("a link gives the state back", () => {
  const first = initial(robot);
  const state = { ...first, position: [1, -2, 0.5], way: "kept", lengths: [3, 4], tolerances: { a: 0.5 } };
  const { state: again, refused } = restore(decode(`#state=${encode(state, first)}`), first);
  assert.deepEqual(again, state);
  assert.deepEqual(refused, []);
});

test("a link of the first state holds nothing but its format", () => {
  const first = initial(robot);
  assert.deepEqual(decode(`#state=${encode(first, first)}`), { format: "cdpr-explorer/1" });
});

test("names outside ASCII survive a link", () => {
  const first = initial(robot);
  const state = { ...first, tolerances: { "Stützpunkt → 1": 2 } };
  assert.deepEqual(restore(decode(`#state=${encode(state, first)}`), first).state, state);
});

test("a link that is broken holds no state", () => {
  for (const hash of ["", "#other", "#state=%%%", "#state=AAAA", "#state=WzFd"])
    assert.equal(decode(hash), null);
});

test("fields of another kind are left out and named", () => {
  const first = initial(robot);
  const saved = {
    position: [1, 2],
    payload: "heavy",
    way: "odd",
    lengths: [1, null],
    unknown: 1,
    force: [1, 2, 3],
  };
  const { state, refused } = restore(saved, first);
  assert.deepEqual(refused.sort(), ["lengths", "payload", "position", "unknown", "way"]);
  assert.deepEqual(state, { ...first, force: [1, 2, 3] });
});

test("a state of another format is refused", () => {
  const first = initial(robot);
  const { state, refused } = restore({ format: "cdpr-explorer/9", payload: 7 }, first);
  assert.deepEqual(refused, ["format cdpr-explorer/9"]);
  assert.deepEqual(state, first);
});

test("undo and redo step over what was committed", () => {
  const store = new Store(initial(robot));
  store.set({ payload: 6 });
  store.set({ payload: 7 }, { commit: true });
  store.set({ payload: 8 }, { commit: true });
  store.undo();
  assert.equal(store.state.payload, 7);
  store.undo();
  assert.equal(store.state.payload, 5);
  assert.equal(store.canUndo, false);
  store.redo();
  store.redo();
  assert.equal(store.state.payload, 8);
  assert.equal(store.canRedo, false);
});

test("a change after undo ends what could be redone", () => {
  const store = new Store(initial(robot));
  store.set({ payload: 6 }, { commit: true });
  store.undo();
  store.set({ payload: 9 }, { commit: true });
  assert.equal(store.canRedo, false);
  store.undo();
  assert.equal(store.state.payload, 5);
});

test("listeners hear of changes, and not of what an answer brings", () => {
  const store = new Store(initial(robot));
  const heard = [];
  store.listen((now, before, stepped) => heard.push([now.payload, before.payload, stepped]));
  store.set({ payload: 6 }, { commit: true });
  store.set({ payload: 7 }, { quiet: true });
  store.undo();
  assert.deepEqual(heard, [
    [6, 5, false],
    [5, 7, true],
  ]);
});

test("a state that would break the page is corrected where it is read", () => {
  const first = initial(robot);
  const saved = {
    way: "kept",
    lengths: [1, 2, 3],
    free: ["roll", "up"],
    tolerances: { a: -1 },
    pins: [{ position: [1, 2, 3] }, null],
    changes: { modulus: null, reference: "high", least: 5 },
    slice: { normal: "w", cells: 1e6, quantity: "colour", shown: true },
  };
  const { state, refused } = restore(saved, first);
  assert.deepEqual(refused.sort(), ["free", "pins", "tolerances"]);
  assert.deepEqual([state.way, state.lengths], ["pose", null]);
  assert.deepEqual(state.changes, { ...first.changes, least: 5 });
  assert.deepEqual(state.slice, { ...first.slice, shown: true });
});
