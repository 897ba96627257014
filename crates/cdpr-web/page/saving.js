// The files that the page offers, by kind.

import { effectBars } from "./charts/effects.js";
import { histogram } from "./charts/histogram.js";
import { heatMap } from "./charts/map.js";
import { changedName, stem, studyName } from "./commands.js";
import { cablesCsv, download, framed, observationsCsv, trackCsv } from "./export.js";
import { digits, point, short } from "./format.js";
import { PAPER } from "./palette.js";
import { effectsTitle, histogramTitle } from "./panels/charts.js";
import { mapTitle, quantityOf } from "./panels/slice.js";
import { changedRobot, isChanged, studyOf, unobserved } from "./robot.js";
import { poseAt } from "./trajectory/track.js";

const WIDTH = 640;
const SVG = "image/svg+xml";
const JSON_TYPE = "application/json";

/** Files by kind: words, whether there is something to save, and name, content and type. */
export const FILES = {
  png: { words: "Picture of the view (PNG)", ready: (app) => app.view && isFound(app) },
  histogram: { words: "Histogram (SVG)", ready: observed, file: histogramFile },
  effects: { words: "Effects (SVG)", ready: (app) => app.sampling.hasEffects, file: effectsFile },
  map: { words: "Slice (SVG)", ready: (app) => app.slicing.plane, file: mapFile },
  csv: { words: "Table of the cables (CSV)", ready: isFound, file: cablesFile },
  observations: { words: "Observations (CSV)", ready: observed, file: observationsFile },
  trajectory: { words: "Tensions along the trajectory (CSV)", ready: hasTrack, file: trackFile },
  robot: { words: "Robot (JSON)", ready: () => true, file: robotFile },
  study: { words: "Study (JSON)", ready: hasStudy, file: studyFile },
  state: { words: "State of this page (JSON)", ready: () => true, file: stateFile },
};

/** Saves a file of a kind; returns what is to be said about it. */
export async function save(app, kind) {
  if (kind === "png") return savePicture(app);
  try {
    const [name, content, type] = await FILES[kind].file(app);
    download(name, content, type);
    return `${name} is saved.`;
  } catch (error) {
    return `Not saved: ${error.message}.`;
  }
}

// Files are of the state on screen: not of one before it, nor of the last that was found.
function isFound({ mechanics }) {
  return mechanics.picture && !mechanics.failure;
}

function observed({ sampling }) {
  return sampling.hasSample && sampling.sample.summary.count > 1;
}

function hasTrack({ player: { track } }) {
  return track !== null && track.done >= track.times.length;
}

function hasStudy({ robot: { study }, store }) {
  return study && unobserved(study, store.state) === null;
}

function histogramFile({ name, sampling: { sample } }) {
  const options = { width: WIDTH, height: 300, nominal: sample.nominal, title: histogramTitle(sample) };
  return [`${stem(name)}-histogram.svg`, histogram(sample.summary, options, PAPER), SVG];
}

function effectsFile({ name, sampling: { effects } }) {
  const drawing = effectBars(effects.inputs, { width: WIDTH, title: effectsTitle(effects) }, PAPER);
  return [`${stem(name)}-effects.svg`, drawing, SVG];
}

function mapFile({ name, slicing, store }) {
  const quantity = quantityOf(store.state.slice.quantity);
  const options = { width: WIDTH, here: null, title: mapTitle(slicing, quantity) };
  return [`${stem(name)}-slice.svg`, heatMap(slicing.plane, slicing.cells, quantity, options, PAPER), SVG];
}

function cablesFile({ name, mechanics, robot }) {
  return [`${stem(name)}-cables.csv`, cablesCsv(mechanics.picture, robot.limits), "text/csv"];
}

function trackFile({ name, player: { track, rows }, robot }) {
  return [
    `${stem(name)}-trajectory.csv`,
    trackCsv(track, (time) => poseAt(rows, time), robot.cables),
    "text/csv",
  ];
}

async function observationsFile({ name, sampling }) {
  return [`${stem(name)}-observations.csv`, observationsCsv(await sampling.table()), "text/csv"];
}

function robotFile({ name, file, store: { state } }) {
  const changed = changedRobot(file, { ...state.changes, reference: null });
  return [isChanged(state.changes) ? changedName(name) : `${stem(name)}.json`, json(changed), JSON_TYPE];
}

function studyFile({ name, robot, store: { state } }) {
  const study = studyOf(robot.study, state, { robot: isChanged(state.changes) ? changedName(name) : name });
  return [studyName(name), json(study), JSON_TYPE];
}

function stateFile({ name, store }) {
  return [`${stem(name)}-state.json`, json(store.state), JSON_TYPE];
}

function savePicture({ name, robot, view, range, palette, mechanics: { picture }, store, deflectionFactor }) {
  const file = `${stem(name)}.png`;
  const place = point(picture.loaded.pose.slice(0, 3));
  const factors = `drawn × ${digits(deflectionFactor, 3)}; sag × ${digits(store.state.view.sag, 3)}`;
  const lines = [robot.name, `platform at ${place}; deflection ${short(picture.rms)}, ${factors}`];
  const canvas = framed(view.snapshot(), { range, lines, palette });
  canvas.toBlob((blob) => download(file, blob, "image/png"));
  return `${file} is saved.`;
}

function json(value) {
  return `${JSON.stringify(value, null, 2)}\n`;
}
