// The commands of the program that give the numbers on screen.

import { isChanged } from "./robot.js";
import { SLICE_AXES } from "./slices.js";

/**
 * @param {{state: object, file: string, lengths: number[]|null,
 *   pose: {position: number[], rpy_deg: number[]}, slice: object|null, hasModes: boolean,
 *   observed: boolean}} given
 *   `pose` is where the platform stands, `slice` the plane in view, `observed` whether robots are observed
 * @returns {Array<{title: string, text: string, needs: string[]}>} `needs`: files that the page writes,
 *   `robot` or `study`
 */
export function commands({ state, file, lengths, pose, slice, hasModes, observed }) {
  const changed = isChanged(state.changes);
  const robot = quote(changed ? changedName(file) : file);
  const needs = changed ? ["robot"] : [];
  const wanted = [...poseOptions(state.position, state.rpy_deg), ...freeOptions(state)];
  const load = loadOptions(state);
  const reference = referenceOptions(state);
  const list = [];
  const add = (title, words, more = []) =>
    list.push({ title, text: ["cdpr", ...words].join(" "), needs: [...needs, ...more] });
  if (state.way === "pose") {
    add("Deflection, tensions and residuals", ["deflection", robot, ...wanted, ...load, ...reference]);
    add("Stiffness with tensions that also bear the load", [
      "stiffness",
      robot,
      ...wanted,
      ...load,
      ...reference,
    ]);
  } else if (lengths !== null) {
    add("Where the platform stands on these lengths", [
      "direct",
      robot,
      ...lengthOptions(lengths),
      ...poseOptions(pose.position, pose.rpy_deg),
      ...load,
    ]);
  }
  if (hasModes && lengths !== null) {
    add("Natural modes on these lengths", [
      "modes",
      robot,
      ...lengthOptions(lengths),
      ...poseOptions(pose.position, pose.rpy_deg),
      ...load,
    ]);
  }
  if (observed)
    add("Histogram and effects", ["study", "run", quote(studyName(file)), "--out", "results"], ["study"]);
  if (slice) {
    add("The slice", [
      "workspace",
      robot,
      ...boxOptions(slice),
      ...rpyOptions(state.rpy_deg),
      ...freeOptions(state),
      ...load,
      ...reference,
      "--out",
      "workspace",
    ]);
  }
  return list;
}

/** The name of the file of a robot that the page has changed. */
export function changedName(file) {
  return `${stem(file)}-changed.json`;
}

/** The name of the file of the study on screen. */
export function studyName(file) {
  return `${stem(file)}-study.json`;
}

/** A word that a shell takes as it is. */
export function quote(word) {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

/** A file name without folder and ending. */
export function stem(file) {
  return file.replace(/^.*[/\\]/, "").replace(/\.json$/i, "") || "robot";
}

function poseOptions(position, rpy_deg) {
  return [`--pose=${position.join(",")}`, ...rpyOptions(rpy_deg)];
}

function rpyOptions(rpy_deg) {
  return rpy_deg.some((angle) => angle !== 0) ? [`--rpy=${rpy_deg.join(",")}`] : [];
}

function lengthOptions(lengths) {
  return [`--lengths=${lengths.join(",")}`];
}

function freeOptions({ free }) {
  return free.length > 0 ? [`--free=${free.join(",")}`] : [];
}

function loadOptions({ payload, force, moment }) {
  return [
    ...(payload !== 0 ? [`--payload=${payload}`] : []),
    ...(force.some((value) => value !== 0) ? [`--force=${force.join(",")}`] : []),
    ...(moment.some((value) => value !== 0) ? [`--moment=${moment.join(",")}`] : []),
  ];
}

function referenceOptions({ changes }) {
  return changes.reference === null ? [] : [`--tension-reference=${changes.reference}`];
}

function boxOptions({ normal, at, u, v }) {
  const ranges = { [normal]: `${at}:${at}:1` };
  const [first, second] = SLICE_AXES[normal];
  ranges[first] = u.join(":");
  ranges[second] = v.join(":");
  return [`--region=${ranges.x},${ranges.y},${ranges.z}`];
}
