// The page of a robot: ties state, engine, view and panels together.

import { Address } from "./address.js";
import { attribution } from "./attribution.js";
import { roundUp } from "./charts/scale.js";
import { h, setText, undoStep, whenOther } from "./dom.js";
import { point, rangeWithUnit, short, withUnit } from "./format.js";
import { extents, groundOf } from "./geometry.js";
import { layout, WIDE } from "./layout.js";
import { Mechanics } from "./mechanics.js";
import { Modes } from "./modes.js";
import { Moves } from "./moves.js";
import { DARK, LIGHT } from "./palette.js";
import { Paper } from "./paper.js";
import { cablesPanel } from "./panels/cables.js";
import { chartsPanel, sentence } from "./panels/charts.js";
import { commandsPanel } from "./panels/commands.js";
import { displayPanel } from "./panels/display.js";
import { filesPanel } from "./panels/files.js";
import { loadPanel } from "./panels/load.js";
import { motionsPanel } from "./panels/motions.js";
import { numbersPanel } from "./panels/numbers.js";
import { numbers, pinsPanel } from "./panels/pins.js";
import { pointsPanel } from "./panels/points.js";
import { posePanel } from "./panels/pose.js";
import { slicePanel, slicePixels } from "./panels/slice.js";
import { notHeld, stagePanel } from "./panels/stage.js";
import { timelinePanel } from "./panels/timeline.js";
import { tolerancesPanel } from "./panels/tolerances.js";
import { trajectoryPanel } from "./panels/trajectory.js";
import { changedRobot, isChanged, pointsOf } from "./robot.js";
import { pictureOf } from "./picture.js";
import { Sampling } from "./sampling.js";
import { Slicing } from "./slicing.js";
import { decode, initial, restore, Store } from "./state.js";
import { Player } from "./trajectory/player.js";
import { View } from "./view/scene.js";

const SETTLED = 500;

export class App {
  mapWidth = 380;
  selected = null;
  /** Whether the times of the trajectory are those of the speed. */
  speedCounts = true;
  /** The handles in the view: `translate`, `rotate`, `points`, `draw`, `off`. */
  handle = "translate";
  /** The name of the exit or anchor point that is chosen. */
  point = null;
  range = 1;
  version = 0;
  #settle = 0;
  #told = "";
  #queued = false;
  #otherSlice = whenOther();

  /**
   * @param {HTMLElement} element
   * @param {{engine: import("./engine.js").Engine, robot: object, file: object, name: string,
   *   saved: object|null, embedded: boolean}} options `robot`: answer to `describe`; `file`: the robot file
   */
  constructor(element, { engine, robot, file, name, saved, embedded }) {
    Object.assign(this, { element, engine, robot, file, name, embedded });
    this.size = extents(robot.exits).size;
    this.ground = groundOf(robot);
    this.arm = Math.max(...robot.anchors.map((anchor) => Math.hypot(...anchor)), 0.01 * this.size);
    this.first = initial(robot);
    const { state, refused } = restore(saved ?? (embedded ? null : decode(location.hash)), this.first);
    this.refused = refused;
    this.store = new Store(state);
    this.address = new Address(this.store, this.first);
    this.mechanics = new Mechanics(engine, this.store, () => this.#mechanicsChanged());
    this.sampling = new Sampling(engine, robot.study, () => this.refresh());
    this.slicing = new Slicing(engine, robot, () => {
      this.#drawSlice();
      this.refresh();
    });
    this.modes = new Modes(this, () => {
      this.#draw();
      this.refresh();
    });
    this.moves = new Moves(this);
    this.player = new Player(this, () => {
      this.#draw();
      this.refresh();
    });
    this.paper = new Paper(this, () => {
      this.#repaint();
      this.#update();
    });
    this.dark = matchMedia("(prefers-color-scheme: dark)");
    this.less = matchMedia("(prefers-reduced-motion: reduce)");
    this.#build();
    this.store.listen((now, before, stepped) => this.#changed(now, before, stepped));
    this.dark.addEventListener("change", this.#repaint);
    this.less.addEventListener("change", this.#redraw);
    this.#repaint();
    if (isChanged(state.changes) || state.changes.reference !== null) this.#newRobot();
    this.#ask({ restart: true });
  }

  get palette() {
    return this.dark.matches && !this.paper.printed ? DARK : LIGHT;
  }

  get reduced() {
    return this.less.matches;
  }

  getState() {
    return structuredClone(this.store.state);
  }

  setState(saved) {
    const { state } = restore(saved, this.first);
    this.jumpTo(state);
  }

  /** Takes over fields of a state that does not follow from the one before. */
  jumpTo(fields) {
    this.store.set(fields, { commit: true, quiet: true });
    this.mechanics.jump = null;
    this.#newRobot();
    this.#ask({ restart: true });
  }

  /** Marks a cable in view and table. */
  select(k) {
    this.selected = k;
    this.#draw();
    this.refresh();
  }

  /** Shows or hides the slice of the workspace, and its panel. */
  toggleSlice() {
    const { slice } = this.store.state;
    const shown = !slice.shown;
    this.store.set({ slice: { ...slice, shown } }, { commit: true });
    if (!shown) return;
    this.slicePanel.element.open = true;
    this.slicePanel.element.scrollIntoView({ block: "start" });
  }

  setHandle(mode) {
    this.handle = mode;
    this.view?.handles.set(mode);
    this.stage.setHandle(mode);
    this.#draw();
    this.refresh();
  }

  /** Observes where the platform has come to rest. */
  rest() {
    this.#ask({ mechanics: false });
  }

  /** Opens a file that is dropped: a state of this page or a table of poses. */
  async openFile(file) {
    if (!file.name.endsWith(".json")) return this.trajectoryPanel.open(file);
    this.live.textContent = this.open(await file.text(), file.name);
  }

  /** Chooses an exit or anchor point to be moved, or none. */
  choosePoint(name) {
    this.point = name;
    if (name) this.pointsPanel.element.open = true;
    this.setHandle("points");
  }

  /** The factor of the deflection: the one that is set, or one that makes it an eighth of the robot. */
  get deflectionFactor() {
    const { deflection } = this.store.state.view;
    const rms = this.mechanics.picture?.rms;
    if (deflection > 0) return deflection;
    return rms > 0 ? Math.max(1, roundUp((0.06 * this.size) / rms)) : 1;
  }

  /** The tolerance that certainly matters most; null where it is not known. */
  most() {
    const { effects, failure, hasEffects } = this.sampling;
    return hasEffects && !failure ? attribution(effects, this.robot.study).winner : null;
  }

  /** Draws all panels at the next frame. */
  refresh() {
    if (this.#queued) return;
    this.#queued = true;
    requestAnimationFrame(() => {
      this.#queued = false;
      this.#update();
    });
    clearTimeout(this.#settle);
    this.#settle = setTimeout(() => this.#settled(), SETTLED);
  }

  #update() {
    for (const panel of this.panels) panel.update();
    this.undo.disabled = !this.store.canUndo;
    this.redo.disabled = !this.store.canRedo;
  }

  /** Opens a saved state; returns what is to be said about it. */
  open(text, name) {
    let saved;
    try {
      saved = JSON.parse(text);
    } catch (error) {
      return `${name} is no JSON: ${error.message}`;
    }
    const { state, refused } = restore(saved, this.first);
    if (saved?.format !== state.format)
      return `${name} is no state of this page: its format is ${String(saved?.format)}, not ${state.format}`;
    this.jumpTo(state);
    const other = saved.robot && saved.robot !== this.robot.name ? ` It was saved for ${saved.robot}.` : "";
    return `${name} is open.${other}${refused.length > 0 ? ` Left out: ${refused.join(", ")}.` : ""}`;
  }

  dispose() {
    clearTimeout(this.#settle);
    this.address.dispose();
    this.engine.dispose();
    this.sampling.dispose();
    this.player.dispose();
    this.charts.dispose();
    this.timeline.dispose();
    this.sizes.disconnect();
    this.view?.dispose();
    this.dark.removeEventListener("change", this.#repaint);
    this.paper.dispose();
    this.less.removeEventListener("change", this.#redraw);
    this.#keyboard.removeEventListener("keydown", this.#keys);
    this.element.replaceChildren();
    this.element.classList.remove("cdprx", "embedded", "narrow");
  }

  #build() {
    this.stage = stagePanel(this);
    this.charts = chartsPanel(this);
    this.motions = motionsPanel(this);
    this.slicePanel = slicePanel(this);
    this.pointsPanel = pointsPanel(this);
    this.trajectoryPanel = trajectoryPanel(this);
    this.timeline = timelinePanel(this);
    const figures = numbersPanel(this);
    const side = [
      posePanel(this),
      loadPanel(this),
      this.pointsPanel,
      cablesPanel(this),
      this.charts,
      tolerancesPanel(this),
      this.trajectoryPanel,
      this.slicePanel,
      this.motions,
      displayPanel(this),
      pinsPanel(this),
      commandsPanel(this),
      filesPanel(this),
    ];
    if (this.element.clientWidth < WIDE) {
      for (const panel of side.slice(1)) panel.element.open = false;
    }
    this.panels = [this.stage, figures, this.timeline, ...side];
    Object.assign(this, layout(this, { stage: this.stage, figures, timeline: this.timeline, side }));
    this.#keyboard.addEventListener("keydown", this.#keys);
    try {
      this.view = new View(this.stage.surface, this.robot, {
        grab: (phase, pose) => this.moves.grab(phase, pose),
        grabPoint: (phase, place) => this.moves.grabPoint(phase, place),
        choosePoint: (name) => this.choosePoint(name),
        goto: (position) => this.moves.goto(position),
        waypoint: (position) => this.moves.waypoint(position),
      });
    } catch (error) {
      this.view = null;
      const reason = `No 3D view: this browser gives no WebGL (${error.message}). The numbers need none.`;
      this.stage.surface.append(h("p", { class: "failure", text: reason }));
    }
  }

  #keys = (event) => {
    const step = undoStep(event);
    if (step === null || event.defaultPrevented) return;
    event.preventDefault();
    this.store[step]();
  };

  // Of a page of its own, whatever has the focus.
  get #keyboard() {
    return this.embedded ? this.element : document;
  }

  #changed(now, before, stepped) {
    if (now.changes !== before.changes) this.#newRobot();
    if (stepped) this.mechanics.jump = null;
    const same = [
      "position",
      "rpy_deg",
      "lengths",
      "payload",
      "force",
      "moment",
      "free",
      "way",
      "changes",
    ].every((field) => now[field] === before[field]);
    if (same) {
      this.#draw();
      this.#ask({ mechanics: false });
    } else this.#ask({ restart: stepped || now.changes !== before.changes });
  }

  #newRobot() {
    this.version += 1;
    const changed = changedRobot(this.file, this.store.state.changes);
    Object.assign(this.robot, pointsOf(changed));
    this.view?.reshape();
    this.engine.setRobot(JSON.stringify(changed));
  }

  #ask({ restart = false, mechanics = true } = {}) {
    const { state } = this.store;
    if (mechanics) this.mechanics.update({ restart });
    if (this.player.playing) this.sampling.wait();
    else this.sampling.update(state, this.version);
    this.slicing.update(state, this.version);
    this.player.update(state, this.version);
    this.#drawSlice();
    this.modes.update();
    if (!this.embedded) this.address.write();
    this.refresh();
  }

  #mechanicsChanged() {
    const picture = this.player.inMotion(this.mechanics.picture);
    if (picture) {
      const greatest = Math.max(...picture.loaded.cables.map((cable) => cable.tension));
      if (greatest > this.range || greatest < 0.4 * this.range) this.range = roundUp(greatest);
    }
    const { state } = this.store;
    if (state.free.length > 0 && !this.player.playing) this.sampling.update(state, this.version);
    this.#draw();
    this.modes.update();
    this.refresh();
  }

  #draw() {
    if (this.view && this.mechanics.picture) this.view.show(pictureOf(this));
  }

  #redraw = () => this.#draw();

  #drawSlice() {
    const { plane, cells } = this.slicing;
    const { quantity } = this.store.state.slice;
    this.#otherSlice([plane, cells?.done, quantity], () => {
      this.view?.showSlice(plane, plane ? slicePixels(this.slicing, quantity) : null);
    });
  }

  #repaint = () => {
    this.view?.paint(this.palette);
    this.#draw();
    this.refresh();
  };

  #settled() {
    if (this.mechanics.busy || this.sampling.busy) return;
    const { state } = this.store;
    if (!this.embedded) this.address.write();
    this.modes.update();
    setText(this.live, this.#sentence());
    const told = JSON.stringify(state);
    if (told === this.#told) return;
    this.#told = told;
    this.element.dispatchEvent(new CustomEvent("cdpr-state", { detail: this.getState(), bubbles: true }));
  }

  #sentence() {
    const { picture, failure } = this.mechanics;
    if (failure || !picture) return failure ? `${notHeld(this.store.state, failure)}: ${failure.reason}` : "";
    const known = numbers(this);
    const [least, greatest] = known.tensions;
    return [
      `Platform at ${point(picture.loaded.pose.slice(0, 3))}.`,
      `Deflection ${short(picture.rms)}.`,
      `Tensions ${rangeWithUnit(least, greatest, "N")}.`,
      `Least stiffness ${withUnit(known.stiffness, "N/m")}.`,
      ...(this.sampling.hasSample ? this.sampling.sample.sentences : []),
      sentence(this),
    ].join(" ");
  }
}
