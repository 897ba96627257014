import assert from "node:assert/strict";
import { test } from "node:test";
import { tensionChart, trackWords } from "../charts/tensions.js";
import { trackCsv } from "../export.js";
import { LIGHT } from "../palette.js";
import { angles, quaternion, vectorBetween } from "../rotation.js";
import { decode, encode, initial, restore } from "../state.js";
import { readPoses } from "../trajectory/table.js";
import { Player } from "../trajectory/player.js";
import { areRows, drawnRows, duration, poseAt, sampleTimes, tensionsAt, timed } from "../trajectory/track.js";

const close = (found, expected) =>
  found.forEach((row, k) =>
    row.forEach((value, j) => assert.ok(Math.abs(value - expected[k][j]) < 1e-9, `${found} not ${expected}`)),
  );

test("poses are read as people write them: marks between cells, decimal commas, units, times", () => {
  const expected = [
    [0, 0, 0, 1.5, 0, 0, 0],
    [2, 0.5, -1, 1.75, 0, 0, 90],
  ];
  for (const text of [
    "t_s,x_m,y_m,z_m,yaw_deg\n0,0,0,1.5,0\n2,0.5,-1,1.75,90\n",
    "# a planner\nTime [ms];X [mm];Y (mm);z_mm;yaw_rad\r\n0;0;0;1500;0\r\n2000;500,0;-1000;1750;1,5707963267948966\r\n",
    "\uFEFFsep=\t\nt\tx\ty\tz\tyaw_deg\n0\t0\t0\t1.5\t0\n2\t.5\t-1\t1.75\t90",
    "t x_cm y_cm z_cm yaw_deg note\n0 0 0 150 0 a\n\n2 50 -100 175 90 b",
    "t,x,y,z,qw,qx,qy,qz\n0,0,0,1.5,1,0,0,0\n2,0.5,-1,1.75,0.7071067811865476,0,0,0.7071067811865476",
  ]) {
    const { rows, hasTime, problem } = readPoses(text);
    assert.equal(problem, undefined, text);
    assert.equal(hasTime, true);
    close(rows, expected);
  }
  assert.deepEqual(readPoses("x y z speed\n0 0 1 5").further, ["speed"]);
  assert.deepEqual(readPoses("0,0,1\n1 ,0,1").rows, [
    [0, 0, 0, 1, 0, 0, 0],
    [0, 1, 0, 1, 0, 0, 0],
  ]);
});

test("a series of simulate is read with the orientation of the platform, not with the rotation from its rest", () => {
  const head = "t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad,t_exit_1_n,t_anchor_1_n";
  const half = Math.SQRT1_2;
  const series = [
    `${head},qw,qx,qy,qz`,
    `0.0,0.1,0.0,2.0,0.0,0.0,0.0,900.5,880.2,${half},0.0,0.0,${half}`,
    `0.01,0.1,0.0,1.5,0.0,0.0,1e-17,0.0,0.0,${half},0.0,0.0,${half}`,
  ].join("\n");
  const { rows, hasTime, cables, further, problem } = readPoses(series);
  assert.equal(problem, undefined);
  assert.equal(hasTime, true);
  assert.equal(cables, 1);
  assert.deepEqual(further, ["t_exit_1_n"]);
  close(rows, [
    [0, 0.1, 0, 2, 0, 0, 90, 880.2],
    [0.01, 0.1, 0, 1.5, 0, 0, 90, 0],
  ]);
  assert.deepEqual(tensionsAt(rows, 0.005), [440.1]);
});

test("tensions of a series are read in the order of the cables, if all are there and have a time", () => {
  const columns = (names) => readPoses(`${names}\n0,0,0,1,7,5\n1,0,0,1,8,6`);
  assert.deepEqual(columns("t_s,x,y,z,t_anchor_2_n,t_anchor_1_n").rows[0].slice(7), [5, 7]);
  for (const names of ["t_s,x,y,z,t_anchor_3_n,t_anchor_1_n", "w,x,y,z,t_anchor_2_n,t_anchor_1_n"]) {
    const { rows, cables, further } = columns(names);
    assert.deepEqual([cables, rows[0].length], [0, 7]);
    assert.ok(further.includes("t_anchor_1_n"));
  }
});

test("a motion that plays has the tensions of its table, and nothing is asked for", () => {
  const rows = [
    [0, 0, 0, 1, 0, 0, 0, 100, 20],
    [1, 1, 0, 1, 0, 0, 0, 300, 40],
  ];
  const changes = { least: null, greatest: null };
  const state = { trajectory: rows, free: [], changes, payload: 0, force: [0, 0, 0], moment: [0, 0, 0] };
  const asked = [];
  const app = {
    robot: { exits: [1, 2], limits: [{ min: 1, max: 150 }, { min: 25, max: 900 }] },
    store: { state: { ...state, ...poseAt(rows, 0) }, set() {}, commit() {} },
    engine: { drop() {}, ask: (...question) => asked.push(question) },
  };
  const player = new Player(app, () => {});
  player.update(app.store.state, 1);
  assert.deepEqual(asked, []);
  assert.deepEqual(player.track.times, [0, 1]);
  assert.deepEqual(player.track.found[0].limits, [null, "below"]);
  assert.match(trackWords(player.track), /^2 poses; tensions 20.0 to 300 N in motion, as the table has/);
  const cables = [1, 2].map((tension) => ({ tension, exit_tension: tension, slack: false, limit: null }));
  const picture = { loaded: { cables }, rms: 1 };
  player.time = 0.5;
  assert.equal(player.inMotion(picture), picture);
  player.playing = true;
  const shown = player.inMotion(picture);
  assert.deepEqual(
    shown.loaded.cables.map(({ tension, limit }) => [tension, limit]),
    [
      [200, "above"],
      [30, null],
    ],
  );
  assert.equal(shown.isInMotion, true);
});

test("of very many rows those with the extreme tensions are drawn", () => {
  const tension = (k) => (k === 4321 ? 999 : 10 + (k % 7));
  const rows = Array.from({ length: 9000 }, (_, k) => [k, 0, 0, 1, 0, 0, 0, tension(k), 50]);
  const drawn = drawnRows(rows);
  assert.ok(drawn.length <= 2000);
  assert.ok(drawn.some((row) => row[7] === 999));
  assert.ok(drawn.every((row, k) => k === 0 || row[0] > drawn[k - 1][0]));
  assert.equal(drawnRows(rows.slice(0, 50)).length, 50);
});

test("a rotation vector alone is the orientation", () => {
  const [x, y, z] = [0.3, -0.2, 0.5];
  const { rows } = readPoses(`x_m,y_m,z_m,rx_rad,ry_rad,rz_rad\n0,0,1,${x},${y},${z}\n`);
  const found = vectorBetween([1, 0, 0, 0], quaternion(rows[0].slice(4)));
  close([found], [[x, y, z]]);
  const right = Math.PI / 2;
  close(readPoses(`x,y,z,rx_rad,ry_rad,rz_rad\n0,0,1,0,0,${right}`).rows, [[0, 0, 0, 1, 0, 0, 90]]);
});

test("a table that cannot be read is refused with its line and what was expected", () => {
  for (const [text, words] of [
    ["", /is empty: expected x_m,y_m,z_m/],
    ["x,y\n1,2", /Line 1: the columns are x, y: expected x_m/],
    ["x,y,z,roll\n0,0,1,0", /column roll has no unit: expected roll_deg or roll_rad/],
    ["x_ft,y,z\n0,0,1", /column x_ft has an unknown unit/],
    ["x,y,z\n0,0,1\n0,up,1", /Line 3: y is “up”, which is not a number/],
    ["x,y,z\n0,0", /Line 2: z is “”/],
    ["t,x,y,z\n1,0,0,1\n0,0,0,1", /Line 3: the time 0 s is before/],
    ["x;y;z\n1,234;0;1", /1,234 can be read in two ways/],
    ["x;y;z\n1,5;0.5;1", /a decimal point, 1,5 a decimal comma/],
    ["x,y,z,qw,qx,qy,qz\n0,0,1,1,1,0,0", /the quaternion has the length 1.414/],
    ["x,y,z,qw,qx\n0,0,1,1,0", /expected x_m/],
    ["x,y,z,rx_rad,ry_rad\n0,0,1,0,0", /expected x_m/],
    ["x,y,z,rx,ry,rz\n0,0,1,0,0,0", /column rx has no unit: expected rx_deg or rx_rad/],
    ["x,y,z,rx_rad,ry_rad,rz_rad,roll_deg\n0,0,1,0,0,0,0", /expected x_m/],
    ["1,2,3,4", /4 numbers without names/],
    ["x,x,y,z\n0,0,0,1", /two columns x/],
  ])
    assert.match(readPoses(text).problem ?? "", words, text);
});

test("between two rows the platform goes straight and turns the short way", () => {
  const rows = [
    [0, 0, 0, 1, 0, 0, 170],
    [2, 2, 0, 1, 0, 0, -170],
    [2, 2, 0, 1, 0, 0, 0],
    [4, 2, 1, 1, 0, 90, 0],
  ];
  assert.deepEqual(poseAt(rows, 0.5).position, [0.5, 0, 1]);
  const { rpy_deg } = poseAt(rows, 1);
  assert.ok(Math.abs(Math.abs(rpy_deg[2]) - 180) < 1e-4, String(rpy_deg));
  assert.deepEqual(poseAt(rows, 2), { position: [2, 0, 1], rpy_deg: [0, 0, 0] });
  assert.deepEqual(poseAt(rows, 3), { position: [2, 0.5, 1], rpy_deg: [0, 45, 0] });
  for (const [time, position] of [
    [-1, [0, 0, 1]],
    [9, [2, 1, 1]],
  ])
    assert.deepEqual(poseAt(rows, time).position, position);
  // A share of a turn is a turn about the same axis.
  const [a, b] = [
    [20, -30, 60],
    [-50, 10, 100],
  ];
  const middle = poseAt(
    [
      [0, 0, 0, 0, ...a],
      [1, 0, 0, 0, ...b],
    ],
    0.5,
  ).rpy_deg;
  const mean = quaternion(a).map((value, k) => value + quaternion(b)[k]);
  close(
    [middle],
    [angles(mean.map((value) => value / Math.hypot(...mean))).map((one) => Number(one.toFixed(5)))],
  );
});

test("times follow from a speed, and a turn counts as the way of its lever arm", () => {
  const rows = timed(
    [
      [0, 0, 0, 1, 0, 0, 0],
      [0, 3, 4, 1, 0, 0, 0],
      [0, 3, 4, 1, 0, 0, 90],
    ],
    2,
    1,
  );
  assert.deepEqual(
    rows.map(([t]) => t),
    [0, 2.5, 3.2854],
  );
  assert.equal(duration(rows), 3.2854);
});

test("tensions are asked for between few rows, and at every second one of very many", () => {
  const { times, every } = sampleTimes([
    [0, 0, 0, 1, 0, 0, 0],
    [1, 1, 0, 1, 0, 0, 0],
    [4, 1, 1, 1, 0, 0, 0],
  ]);
  assert.equal(every, 1);
  assert.equal(times.length, 121);
  assert.ok(times.includes(1) && times[0] === 0 && times.at(-1) === 4);
  const many = sampleTimes(Array.from({ length: 4000 }, (_, k) => [k, 0, 0, 1, 0, 0, 0]));
  assert.deepEqual([many.every, many.times.length, many.times[1]], [2, 2000, 2]);
});

test("a short trajectory is in the link, a long one only in the saved state", () => {
  const first = initial({ name: "r", cables: 8, free: [], start: null, study: null });
  const rows = (count) => Array.from({ length: count }, (_, k) => [k, 0, 0, 1, 0, 0, 0]);
  for (const [count, expected] of [
    [5, 5],
    [500, 0],
  ]) {
    const state = { ...first, trajectory: rows(count) };
    const { state: linked } = restore(decode(`#state=${encode(state, first)}`), first);
    assert.equal(linked.trajectory.length, expected);
    assert.deepEqual(restore(JSON.parse(JSON.stringify(state)), first).state, state);
  }
  for (const wrong of [
    [[0, 0]],
    [
      [1, 0, 0, 1, 0, 0, 0],
      [0, 0, 0, 1, 0, 0, 0],
    ],
    "rows",
    [[0, 0, 0, null, 0, 0, 0]],
    [
      [0, 0, 0, 1, 0, 0, 0, 5],
      [1, 0, 0, 1, 0, 0, 0],
    ],
  ])
    assert.equal(areRows(wrong), false);
});

test("the chart has a line for each cable, a gap where nothing is held, and says so", () => {
  const held = (...tensions) => ({
    tensions,
    limits: tensions.map((t) => (t > 90 ? "above" : null)),
    deflection: 1e-3,
  });
  const track = {
    times: [0, 1, 2, 3],
    every: 1,
    done: 4,
    found: [held(10, 20), { failure: { reason: "no tensions, “none”" } }, held(30, 95), held(40, 50)],
  };
  const options = { width: 400, height: 100, selected: 1, bounds: [5, 90], title: "t" };
  const drawing = tensionChart(track, options, LIGHT);
  const lines = [...drawing.matchAll(/<path d="([^"]+)" stroke="(#[^"]+)"/g)];
  assert.equal(lines.length, 2);
  assert.deepEqual([lines[0][1].match(/M/g).length, lines[0][1].match(/L/g).length], [2, 1]);
  assert.notEqual(lines[0][2], lines[1][2]);
  assert.equal(drawing.match(/fill-opacity="0.3"/g).length, 1);
  assert.equal(drawing.match(/fill-opacity="0.12"/g).length, 1);
  assert.equal(drawing.match(/stroke-dasharray="5 4"/g).length, 2);
  assert.equal(
    trackWords(track),
    "4 poses; tensions 10.0 to 95.0 N; 1 with a tension out of its limits; 1 not held, first at 1.00 s: no tensions, “none”.",
  );
  const csv = trackCsv(track, (t) => ({ position: [t, 0, 1], rpy_deg: [0, 0, 0] }), 2).split("\n");
  assert.equal(
    csv[0],
    "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg,deflection_m,tension_1_N,tension_2_N,reason",
  );
  assert.equal(csv[1], "0,0,0,1,0,0,0,0.001,10,20,");
  assert.equal(csv[2], '1,1,0,1,0,0,0,,,,"no tensions, “none”"');
});
