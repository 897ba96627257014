// A stand-in for the module while the page is developed without it: straight springs without weight.
// `dev.mjs --mock` bundles it instead of pkg/cdpr_web.js. Its numbers are for looking at, not for use.

import { turned } from "../rotation.js";

export function initSync() {}

export class Live {
  constructor(text) {
    this.robot = JSON.parse(text);
    if (!this.robot.cables?.length)
      throw new Error("robot.json: cables is empty: expected one cable at least");
  }

  free() {}

  ask(text) {
    const [[kind, given]] = Object.entries(JSON.parse(text));
    return JSON.stringify(this[kind](given));
  }

  describe() {
    const { cables, platform, name } = this.robot;
    const exits = cables.map((cable) => cable.exit_point);
    const middle = [0, 1, 2].map(
      (k) => (Math.min(...exits.map((e) => e[k])) + Math.max(...exits.map((e) => e[k]))) / 2,
    );
    const law = (w) => ({ law: { uniform: { min: -w, max: w } } });
    return {
      ok: {
        name,
        cables: cables.length,
        freedoms: 6,
        source: this.robot.source,
        start_reason: null,
        free: cables.length < 6 ? ["roll", "pitch"].slice(0, 6 - cables.length) : [],
        parameters: [
          { name: "mass", group: "mass", unit: "kg", nominal: platform.mass },
          ...cables.flatMap((c, k) =>
            ["x", "y", "z"].map((a, j) => ({
              name: `b${k + 1}.${a}`,
              group: "b",
              unit: "m",
              nominal: c.exit_point[j],
            })),
          ),
        ],
        exits,
        anchors: cables.map((c) => c.anchor_point),
        center_of_mass: platform.center_of_mass,
        mass: platform.mass,
        limits: cables.map((c) => ({ ...this.robot.tension_limits, ...c.tension_limits, at: "anchor" })),
        breaking: cables.map(() => null),
        start: { pose: [...middle, 1, 0, 0, 0], payload: platform.mass / 10 },
        held: [],
        inertia: Boolean(platform.inertia),
        study: {
          format: "cdpr-study/1",
          name: "mock",
          robot: "x.json",
          payload: 5,
          seed: 1,
          replicates: 4,
          confidence: 0.95,
          bootstrap_resamples: 200,
          error_models: { tolerances: { mass: law(4.6), b: law(0.005) } },
          samplings: {
            all: {
              title: "All parameters",
              pose: { position: middle },
              error_model: "tolerances",
              observations: 2048,
            },
          },
        },
      },
    };
  }

  state(pose, share) {
    const { cables, platform } = this.robot;
    const anchors = cables.map((c) => turned(pose.slice(3), c.anchor_point).map((v, k) => v + pose[k]));
    return {
      pose,
      rpy_deg: [0, 0, 0],
      anchors,
      center_of_mass: pose.slice(0, 3),
      stable: true,
      least_stiffness: 5e4,
      softest: { stiffness: 5e4, translation: [0.1, 0.9, 0], rotation: [0.8, 0, 0] },
      residual: { closure: 1e-15, force: 1e-13, moment: 1e-13 },
      method: "newton",
      iterations: 3,
      cables: cables.map((c, k) => {
        const points = [];
        const length = Math.hypot(...anchors[k].map((v, j) => v - c.exit_point[j]));
        for (let i = 0; i <= 16; i++) {
          const t = i / 16;
          points.push(
            ...c.exit_point.map(
              (v, j) => v + t * (anchors[k][j] - v) - (j === 2 ? 0.02 * length * 4 * t * (1 - t) : 0),
            ),
          );
        }
        const tension =
          ((platform.mass * 9.81) / cables.length) * (1 + share) * (1 + 0.3 * Math.sin(3 * k + pose[0]));
        return {
          points,
          wheel: [],
          tension,
          exit_tension: tension + 2,
          sag: 0.02 * length,
          slack: false,
          length,
          strain: 1e-3,
          limit: null,
        };
      }),
    };
  }

  hold({ pose, load = {} }) {
    const { exits } = this.describe().ok;
    if (pose[2] > Math.max(...exits.map((e) => e[2]))) {
      return {
        error: {
          kind: "infeasible_tension",
          reason: `at (${pose.slice(0, 3).join(", ")}) m: no tensions within the limits hold the platform`,
        },
      };
    }
    const drop = 1e-4 * (load.payload ?? 0);
    const loaded = [...pose];
    loaded[2] -= drop;
    return {
      ok: {
        lengths: this.robot.cables.map(() => 3),
        limits: this.robot.cables.map(() => [1, 5000]),
        displacement: [0, 0, -drop],
        rms: drop,
        rotation: [0, 0, 0],
        unloaded: this.state(pose, 0),
        loaded: this.state(loaded, 0.3),
      },
    };
  }

  stand({ start }) {
    return { ok: this.state(start, 0.3) };
  }

  wind({ load, start }) {
    const pose = [...start];
    for (let k = 0; k < 3; k++)
      pose[k] += 1e-4 * ((load[1].force ?? [0, 0, 0])[k] - (load[0].force ?? [0, 0, 0])[k]);
    return { ok: { state: this.state(pose, 0.3), path: [], jumps: [], reason: null } };
  }

  modes() {
    return {
      ok: {
        frequencies: [
          { frequency: 4.2, translation: [0, 1, 0], rotation: [0.5, 0, 0], cables: [], weight: 0 },
        ],
        motions: [{ stiffness: 5e4, translation: [0.1, 0.9, 0], rotation: [0.8, 0, 0] }],
        characteristic_length: 1,
        neutral: 0,
      },
    };
  }

  study({ text }) {
    this.text = text;
    return { ok: { inputs: [], entries: [] } };
  }

  observe({ replicate }) {
    const { observations, pose } = this.text.samplings.all;
    const values_mm = Array.from(
      { length: observations },
      (_, i) => 5 + pose.position[0] + Math.sin(i * 12.9898 + replicate) * Math.cos(i * 78.233),
    );
    return {
      ok: {
        values_mm,
        failed: {},
        scalar: { count: 0, why: null },
        nominal_mm: 5 + pose.position[0],
        sentences: ["Mean deflection 5 mm."],
        effects: { replicate },
      },
    };
  }

  table() {
    const { values_mm } = this.observe({ replicate: 0 }).ok;
    const rows = values_mm.map((value, k) => ({ inputs: [k / 1000], outputs_mm: [value], failure: null }));
    return { ok: { seed: 1, inputs: [{ name: "mass", unit: "kg" }], outputs: ["rms_mm"], rows } };
  }

  effects() {
    const inputs = this.describe().ok.parameters.map(({ name, group }, k) => {
      const effect_mm = Math.sin(k * 1.7) / (1 + k / 5);
      return { name, entry: group, effect_mm, low_mm: effect_mm - 0.05, high_mm: effect_mm + 0.05 };
    });
    return { ok: { inputs, confidence: 0.95, replicates: 4 } };
  }

  slice({ u, v, rows: [first, end] }) {
    const count = u[2] * (end - first);
    const at = (k) => Math.hypot((k % u[2]) - u[2] / 2, first + Math.floor(k / u[2]) - v[2] / 2);
    const field = (f) => Array.from({ length: count }, (_, k) => (at(k) < u[2] / 2.2 ? f(at(k)) : null));
    return {
      ok: {
        held: field(() => 1).map((value) => value ?? 0),
        deflection_mm: field((r) => 1 + r),
        least_stiffness: field((r) => 1e5 / (1 + r)),
        tension_min: field((r) => 10 + r),
        tension_max: field((r) => 300 + 10 * r),
        reasons: { infeasible_tension: 3 },
      },
    };
  }
}
