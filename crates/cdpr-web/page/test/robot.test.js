import assert from "node:assert/strict";
import { test } from "node:test";
import { bodyPoints, exaggerated, floorOf, followed, groundOf, moved, rings } from "../geometry.js";
import {
  arePoints,
  changedRobot,
  isChanged,
  ofStudy,
  pointNames,
  pointOf,
  pointsOf,
  scaled,
  studyOf,
  unobserved,
  width,
  withPoint,
} from "../robot.js";
import { initial } from "../state.js";
import { cellAt, mapFrame, mapScales } from "../charts/map.js";
import { viridis } from "../charts/scale.js";
import { cableStyle } from "../view/style.js";
import { emptyCells, extreme, fill, plane, positionOf, rangeOf, rowOrder } from "../slices.js";

const none = { modulus: 1, density: 1, reference: null, least: null, greatest: null, points: {} };
const uniform = (half) => ({ law: { uniform: { min: -half, max: half } } });

test("changes reach common and single cables, and leave the file alone", () => {
  const file = {
    cable: { youngs_modulus: 1e11, linear_density: 0.06, law: { segments: [{ tension: 0, modulus: 8e10 }] } },
    tension_limits: { min: 1, max: 5000 },
    cables: [{ cable: { youngs_modulus: 2e11, linear_density: 0.1 } }, { tension_limits: { max: 300 } }],
  };
  const before = structuredClone(file);
  const robot = changedRobot(file, {
    modulus: 0.5,
    density: 2,
    reference: "mid",
    least: 10,
    greatest: 400,
    points: {},
  });
  assert.deepEqual(file, before);
  assert.equal(robot.cable.youngs_modulus, 5e10);
  assert.equal(robot.cable.law.segments[0].modulus, 4e10);
  assert.equal(robot.cables[0].cable.linear_density, 0.2);
  assert.deepEqual(robot.tension_limits, { min: 10, max: 400 });
  assert.deepEqual(robot.cables[1].tension_limits, { max: 400 });
  assert.equal(robot.tension_reference, "mid");
  assert.deepEqual(changedRobot(file, none), file);
  assert.equal(isChanged({ ...none, reference: 5 }), false);
  assert.equal(isChanged({ ...none, density: 2 }), true);
});

test("a point that is moved is one of the robot, and a number of another robot's is refused", () => {
  const cables = [0, 1].map((k) => ({ exit_point: [k, 0, 3], anchor_point: [0, k, 0] }));
  const changes = withPoint(withPoint(none, "b2", [1, 0.5, 3]), "a1", [0.1, 0, 0]);
  const robot = changedRobot({ cables }, changes);
  assert.deepEqual(pointsOf(robot), {
    exits: [
      [0, 0, 3],
      [1, 0.5, 3],
    ],
    anchors: [
      [0.1, 0, 0],
      [0, 1, 0],
    ],
  });
  assert.deepEqual(cables[1].exit_point, [1, 0, 3]);
  assert.deepEqual(pointOf(pointsOf(robot), "b2"), [1, 0.5, 3]);
  assert.equal(isChanged(changes), true);
  assert.deepEqual(pointNames(2), ["b1", "b2", "a1", "a2"]);
  assert.equal(arePoints(changes.points, 2), true);
  for (const wrong of [{ b3: [0, 0, 0] }, { b1: [0, 0] }, { b1: [0, 0, null] }, [], null, "b1"])
    assert.equal(arePoints(wrong, 2), false);
});

test("laws scale with their deviations and keep their shapes", () => {
  assert.deepEqual(scaled(uniform(2), 0.5), uniform(1));
  const beta = { law: { beta: { alpha: 2, beta: 3, min: -1, max: 1 } } };
  assert.deepEqual(scaled(beta, 2).law.beta, { alpha: 2, beta: 3, min: -2, max: 2 });
  assert.equal(width(uniform(2)), 2);
  assert.equal(width({ law: { normal: { mean: 0, std: 3 } } }), 3);
  const weibull = { law: { weibull: { shape: 2, scale: 0.5 } } };
  assert.deepEqual(scaled(weibull, 3).law.weibull, { shape: 2, scale: 1.5 });
  assert.equal(width(weibull), 0.5);
  const lognormal = { law: { log_normal: { log_mean: 0, log_std: 0.2 } } };
  assert.deepEqual(scaled(lognormal, Math.E).law.log_normal, { log_mean: 1, log_std: 0.2 });
  assert.equal(width(scaled(lognormal, Math.E)), Math.E);
  const cut = { law: { truncated_normal: { mean: 0, std: 1, min: -2, max: 2 } } };
  assert.equal(width(scaled(cut, 2)), 2);
});

test("the study on screen has the pose, the scaled tolerances, and none that is zero", () => {
  const study = {
    format: "cdpr-study/1",
    name: "s",
    seed: 1,
    replicates: 4,
    confidence: 0.95,
    bootstrap_resamples: 200,
    error_models: { t: { mass: uniform(4), a: uniform(0.002) } },
    samplings: { all: { title: "All", error_model: "t", observations: 2048 } },
  };
  const state = {
    way: "pose",
    force: [0, 0, 0],
    moment: [0, 0, 0],
    position: [1, 2, 3],
    rpy_deg: [0, 0, 180],
    payload: 9,
    free: [],
    tolerances: { mass: 0, a: 2 },
    changes: none,
    observations: 512,
  };
  const made = studyOf(study, state, { robot: "r.json" });
  assert.deepEqual(made.error_models, { tolerances: { a: uniform(0.004) } });
  assert.deepEqual(made.samplings.all.pose.position, [1, 2, 3]);
  assert.ok(Math.abs(made.samplings.all.pose.quaternion[3] - 1) < 1e-15);
  assert.equal(made.samplings.all.observations, 512);
  assert.equal(made.payload, 9);
});

test("a slice covers the frame, and its cells are where the engine computes them", () => {
  const exits = [
    [-2, -1, 3],
    [2, -1, 3],
    [2, 1, 3.5],
    [-2, 1, 3],
  ];
  const found = plane({ normal: "z", at: 1.5, cells: 9 }, exits, 0);
  assert.deepEqual(found, { normal: "z", at: 1.5, u: [-2, 2, 9], v: [-1, 1, 5] });
  assert.deepEqual(positionOf(found, 2, 4), [-1, 1, 1.5]);
  assert.deepEqual(plane({ normal: "y", at: 0, cells: 5 }, exits, 0).v, [0, 3.5, 5]);
});

test("rows are asked for once each, those far apart first", () => {
  assert.deepEqual(rowOrder(5), [0, 4, 2, 1, 3]);
  assert.deepEqual(
    [...rowOrder(33)].sort((a, b) => a - b),
    Array.from({ length: 33 }, (_, k) => k),
  );
});

test("cells take rows; the range is of positions that are held, and of all where none is", () => {
  const cells = emptyCells({ u: [0, 1, 2], v: [0, 1, 2] });
  const rest = { least_stiffness: [3, 4], tension_min: [5, 6], tension_max: [7, 8], reasons: {} };
  assert.equal(rangeOf(cells, "deflection_mm"), null);
  fill(cells, 0, { held: [0, 0], deflection_mm: [9, null], ...rest });
  assert.deepEqual([...cells.held], [2, 2, 0, 0]);
  assert.deepEqual(rangeOf(cells, "deflection_mm"), [9, 9]);
  fill(cells, 1, { held: [1, 1], deflection_mm: [1, 2], ...rest, reasons: { beyond_limits: 1 } });
  assert.deepEqual(rangeOf(cells, "deflection_mm"), [1, 2]);
  assert.deepEqual(extreme(cells, "deflection_mm", 1), [1, 1]);
  assert.deepEqual(extreme(cells, "deflection_mm", -1), [0, 1]);
  assert.deepEqual([cells.done, cells.reasons.beyond_limits], [4, 1]);
});

test("a click in the middle of a cell finds the cell", () => {
  const found = { normal: "z", at: 0, u: [-2, 2, 9], v: [-1, 1, 5] };
  const [x, y] = mapScales(found, mapFrame(found, 400));
  for (const [column, row] of [
    [0, 0],
    [8, 4],
    [3, 2],
  ]) {
    const [px, py] = [x(-2 + column * 0.5), y(-1 + row * 0.5)];
    assert.deepEqual(cellAt(found, 400, [px, py]), [column, row]);
  }
  assert.equal(cellAt(found, 400, [0, 0]), null);
});

test("bodies have a volume: flat ones and bars get a thickness, a point mass is none", () => {
  assert.equal(
    bodyPoints(
      [
        [0, 0, 0],
        [0, 0, 0],
      ],
      10,
    ),
    null,
  );
  assert.equal(
    bodyPoints(
      [
        [1, 0, 0],
        [0, 1, 0],
        [-1, -1, 0],
      ],
      10,
    ).length,
    6,
  );
  assert.equal(
    bodyPoints(
      [
        [1, 0, 0],
        [-1, 0, 0],
      ],
      10,
    ).length,
    8,
  );
  const box = [
    [1, 1, 0],
    [-1, 1, 1],
    [1, -1, 0],
    [-1, -1, 1],
  ];
  assert.deepEqual(bodyPoints([...box, [0, 0, -1]], 10).length, 5);
});

test("a ring goes around each level of exit points", () => {
  const exits = [
    [1, 1, 3],
    [-1, -1, 3],
    [1, -1, 3],
    [-1, 1, 3],
  ];
  const isClosed = (order) =>
    order.forEach((k, j) => {
      const [a, b] = [exits[k], exits[order[(j + 1) % order.length]]];
      assert.deepEqual([Math.hypot(a[0] - b[0], a[1] - b[1]), a[2]], [2, b[2]]);
    });
  assert.equal(rings(exits).length, 1);
  rings(exits).forEach(isClosed);
  exits.push(...exits.map(([x, y]) => [x, y, 0.5]));
  assert.deepEqual(
    rings(exits).map((order) => order.length),
    [4, 4],
  );
  rings(exits).forEach(isClosed);
});

test("the ground is that of the file, else zero below a surveyed frame, else unknown", () => {
  const exits = [
    [0, 0, 3],
    [4, 4, 3],
  ];
  const anchors = [[0, 0, -0.2]];
  const at = (z) => ({ exits, anchors, start: { pose: [0, 0, z, 1, 0, 0, 0] } });
  assert.equal(groundOf(at(1)), 0);
  assert.equal(groundOf({ ...at(1), ground_z: -0.5 }), -0.5);
  // A platform that hangs below the origin, as where heights are counted from the frame.
  assert.deepEqual([groundOf(at(-2)), floorOf(at(-2))], [null, -2.2]);
  const low = { exits: [[0, 0, -1], ...exits], anchors, start: null };
  assert.deepEqual([groundOf(low), floorOf(low)], [null, -1]);
});

test("an exaggerated cable keeps its ends", () => {
  const points = [0, 0, 0, 1, 0, -0.1, 2, 0, 0];
  assert.deepEqual(exaggerated(points, 10), [0, 0, 0, 1, 0, -1, 2, 0, 0]);
  assert.deepEqual(followed(points, [0, 0, 1]), [0, 0, 0, 1, 0, 0.4, 2, 0, 1]);
});

test("what lies on a pulley is drawn where it is, however large the sag is drawn", () => {
  // Over a wheel from the exit point, up and forwards; then free to the anchor point.
  const points = [0, 0, 0, 0.1, 0, 0.2, 0.3, 0, 0.2, 1.3, 0, 0.1, 2.3, 0, 0.2];
  const drawn = exaggerated(points, 100, 2);
  assert.deepEqual(drawn.slice(0, 9), points.slice(0, 9));
  assert.ok(Math.abs(drawn[11] - (0.2 - 100 * 0.1)) < 1e-12);
  assert.deepEqual(drawn.slice(12), points.slice(12));
  const moving = followed(points, [0, 0, 1], 2);
  assert.deepEqual(moving.slice(0, 9), points.slice(0, 9));
  assert.ok(Math.abs(moving[11] - 0.6) < 1e-12 && Math.abs(moving[14] - 1.2) < 1e-12);
});

test("a state that robots are not observed in says why", () => {
  const study = {
    error_models: { t: { mass: uniform(4), a: uniform(0.002) } },
    samplings: { all: { error_model: "t" } },
  };
  const state = { way: "pose", force: [0, 0, 0], moment: [0, 0, 0], payload: 9, tolerances: { mass: 0 } };
  const why = (change) => unobserved(study, { ...state, ...change });
  assert.equal(why({}), null);
  assert.match(why({ payload: 0 }), /no load/);
  assert.equal(why({ payload: 0, force: [0, -3, 0] }), null);
  assert.equal(why({ payload: 0, moment: [0, 0, 1] }), null);
  assert.match(why({ tolerances: { mass: 0, a: 0 } }), /zero, so nothing deviates/);
  study.error_models.t = { dt: uniform(15) };
  assert.equal(why({}), null);
  assert.match(why({ way: "kept", lengths: [3, 4] }), /kept lengths have no tension set-points/);
});

test("robots are observed on the lengths that are kept and under the force, without set-points", () => {
  const study = {
    error_models: { t: { a: uniform(0.002), dt: uniform(15), dt3: uniform(5) } },
    samplings: { all: { title: "All", error_model: "t", observations: 8, pose: { position: [0, 0, 1] } } },
  };
  const load = { payload: 0, force: [0, 0, 0], moment: [0, 1, 0] };
  const held = { position: [0, 0, 1], rpy_deg: [0, 0, 0], tolerances: {}, free: ["x"], changes: none };
  const of = (more) => studyOf(study, { ...held, ...load, ...more }, { robot: "r.json" });
  const kept = of({ way: "kept", lengths: [3, 4] });
  assert.deepEqual(kept.samplings.all.lengths, [3, 4]);
  assert.equal(kept.samplings.all.free, undefined);
  assert.deepEqual(Object.keys(kept.error_models.tolerances), ["a"]);
  assert.deepEqual([kept.payload, kept.force, kept.moment], [0, undefined, [0, 1, 0]]);
  const posed = of({ way: "pose", lengths: null });
  assert.deepEqual([posed.samplings.all.lengths, posed.samplings.all.free], [undefined, ["x"]]);
  assert.deepEqual(Object.keys(posed.error_models.tolerances), ["a", "dt", "dt3"]);
  // The page begins with what such a study says.
  const { way, lengths, force, moment } = initial({ name: "r", ...ofStudy(kept) });
  assert.deepEqual([way, lengths, force, moment], ["kept", [3, 4], [0, 0, 0], [0, 1, 0]]);
});

test("a small motion moves and turns a pose", () => {
  const found = moved([0, 0, 0, 1, 0, 0, 0], { translation: [1, 0, 0], rotation: [0, 0, Math.PI] }, 0.5);
  [0.5, 0, 0, Math.SQRT1_2, 0, 0, Math.SQRT1_2].forEach((value, k) =>
    assert.ok(Math.abs(found[k] - value) < 1e-15),
  );
});

test("a study instead of the template gives pose, payload and tolerances", () => {
  const sampling = {
    error_model: "t",
    observations: 256,
    pose: { position: [1, 2, 3], rpy_deg: [0, 0, 90] },
  };
  const study = {
    payload: 50,
    samplings: { all: sampling },
    error_models: { t: {} },
    tension_reference: "mid",
  };
  const found = ofStudy(study);
  assert.equal(found.study, study);
  assert.equal(found.start.payload, 50);
  assert.deepEqual(found.start.pose.slice(0, 3), [1, 2, 3]);
  assert.ok(Math.abs(found.start.pose[6] - Math.SQRT1_2) < 1e-15);
  const { position, rpy_deg, changes, observations } = initial({ name: "r", ...found });
  assert.deepEqual([position, rpy_deg, changes.reference, observations], [[1, 2, 3], [0, 0, 90], "mid", 256]);
});

test("a slack cable has the colour of its tension, and no dark edge", () => {
  const options = { range: 600, faded: false, selected: false };
  const [taut, slack] = [false, true].map((slack) =>
    cableStyle({ tension: 506, slack, limit: null }, options),
  );
  assert.deepEqual(slack.color, viridis(506 / 600));
  assert.deepEqual(taut.color, slack.color);
  assert.deepEqual([taut.hasEdge, slack.hasEdge], [true, false]);
  const weak = cableStyle({ tension: 3, slack: true, limit: "min" }, options);
  assert.notDeepEqual(weak.color, slack.color);
  assert.equal(weak.mark, "warn");
  assert.equal(
    cableStyle({ tension: 3, slack: true, limit: "min" }, { ...options, selected: true }).mark,
    "ink",
  );
  assert.deepEqual(cableStyle({ tension: 3, slack: true, limit: "min" }, { ...options, faded: true }), {
    color: null,
    hasEdge: false,
    mark: null,
  });
});
