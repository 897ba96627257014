import assert from "node:assert/strict";
import { test } from "node:test";
import { commands, quote, stem, studyName } from "../commands.js";

const state = {
  way: "pose",
  position: [-1, 0.5, 2],
  rpy_deg: [0, 0, 0],
  payload: 50,
  force: [0, 0, 0],
  moment: [0, 0, 0],
  free: [],
  changes: { modulus: 1, density: 1, reference: null, least: null, greatest: null, points: {} },
};
const given = {
  file: "cogiro.json",
  lengths: [9.5, 8],
  pose: state,
  slice: null,
  hasModes: true,
  observed: true,
};
const texts = (change, more = {}) =>
  commands({ ...given, ...more, state: { ...state, ...change } }).map(({ text }) => text);

test("a level pose with a payload", () => {
  const [deflection, , modes, study] = texts({});
  assert.equal(deflection, "cdpr deflection cogiro.json --pose=-1,0.5,2 --payload=50");
  assert.equal(modes, "cdpr modes cogiro.json --lengths=9.5,8 --pose=-1,0.5,2 --payload=50");
  assert.equal(study, "cdpr study run cogiro-study.json --out results");
});

test("angles, force, moment, free coordinates and tension reference", () => {
  const changes = { ...state.changes, reference: "mid" };
  const [deflection] = texts({
    rpy_deg: [-3, 0, 2],
    force: [-10, 0, 0],
    moment: [0, 0, 4],
    free: ["roll", "pitch"],
    changes,
  });
  assert.equal(
    deflection,
    "cdpr deflection cogiro.json --pose=-1,0.5,2 --rpy=-3,0,2 --free=roll,pitch --payload=50 " +
      "--force=-10,0,0 --moment=0,0,4 --tension-reference=mid",
  );
});

test("lengths that are kept", () => {
  const [direct] = texts({ way: "kept" });
  assert.equal(direct, "cdpr direct cogiro.json --lengths=9.5,8 --pose=-1,0.5,2 --payload=50");
});

test("a study that is of another state is no command", () => {
  const list = texts({ force: [5, 0, 0] }, { observed: false });
  assert.ok(list.every((text) => !text.includes("study")));
});

test("a slice has its normal as a range of one position", () => {
  const slice = { normal: "y", at: 0.5, u: [-2, 2, 9], v: [0, 3, 7] };
  const list = texts({}, { slice });
  assert.equal(
    list.at(-1),
    "cdpr workspace cogiro.json --region=-2:2:9,0.5:0.5:1,0:3:7 --payload=50 --out workspace",
  );
});

test("a changed robot is a file that the page writes", () => {
  const [first] = commands({ ...given, state: { ...state, changes: { ...state.changes, modulus: 0.5 } } });
  assert.match(first.text, /^cdpr deflection cogiro-changed\.json /);
  assert.deepEqual(first.needs, ["robot"]);
});

test("words of a shell are quoted where they need it", () => {
  assert.equal(quote("my robot's.json"), "'my robot'\\''s.json'");
  assert.equal(quote("data/robots/fast.json"), "data/robots/fast.json");
  assert.equal(stem("a/b c.JSON"), "b c");
  assert.equal(studyName("a/b.json"), "b-study.json");
});
