// Histogram and effects at the pose on screen, with what they say in a sentence.

import { h, setText, whenOther } from "../dom.js";
import { attribution, explainedPercent, littleWords } from "../attribution.js";
import { digits, entryWords, lengthUnit, named, parameterWords, sharePercent } from "../format.js";
import { effectBars, largest } from "../charts/effects.js";
import { histogram } from "../charts/histogram.js";
import { panel } from "./panel.js";

/** @param {object} app */
export function chartsPanel(app) {
  const { sampling, robot } = app;
  const verdict = h("p", { class: "says" });
  const says = h("p", { class: "says" });
  const failed = h("p", { class: "failure", hidden: true });
  const numbers = h("p", { class: "hint" });
  const counted = h("p", { class: "hint" });
  const first = h("div", { class: "chart" }),
    second = h("div", { class: "chart" });
  const parts = [
    h(
      "section",
      { "aria-label": "Histogram of the deflection" },
      h("h3", { text: "Deflection under the load, of robots within the tolerances" }),
      first,
      numbers,
      counted,
    ),
    h(
      "section",
      { "aria-label": "Largest effects" },
      h("h3", { text: "Largest effects" }),
      second,
      h(
        "p",
        { class: "hint" },
        "Mean deflection with the parameter above its nominal value less that with it below; 95 % intervals.",
      ),
    ),
  ];
  const pair = h("div", { class: "pair" }, ...parts);
  const charts = h("div", { class: "charts" }, verdict, says, failed, pair);
  const { element, update: updateOpen } = panel("Uncertainty", { open: true, update }, charts);
  const [firstOther, secondOther] = [whenOther(), whenOther()];
  const observer = new ResizeObserver(() => updateOpen());
  observer.observe(charts);
  return { element, update: updateOpen, dispose: () => observer.disconnect() };

  function update() {
    if (!robot.study) {
      failed.hidden = false;
      return void setText(failed, `No observations: ${robot.start_reason}`);
    }
    const { sample, effects, failure } = sampling;
    failed.hidden = !failure;
    if (failure) setText(failed, `No observations here: ${reasonWords(app, failure)}.`);
    pair.hidden = failure?.kind === "unobserved";
    charts.classList.toggle("stale", Boolean(failure) || !sampling.hasEffects);
    setText(verdict, sample ? sample.sentences.join(" ") : "");
    setText(says, sentence(app));
    const { palette } = app;
    const width = Math.max(240, Math.floor(first.clientWidth));
    firstOther([sample, width, palette], () => drawHistogram(sample, width));
    if (sample) setText(counted, `${countWords(app)} ${restWords(app)}`);
    secondOther([effects, width, palette], () => {
      if (!effects) return second.replaceChildren();
      second.innerHTML = effectBars(effects.inputs, { width, title: effectsTitle(effects) }, palette);
    });
  }

  function drawHistogram(sample, width) {
    const some = sample && sample.summary.count > 1;
    setText(numbers, some ? statisticsWords(sample) : "");
    if (!sample) setText(counted, "");
    if (!some) return first.replaceChildren();
    const options = { width, height: 190, nominal: sample.nominal, title: histogramTitle(sample) };
    first.innerHTML = histogram(sample.summary, options, app.palette);
  }
}

/** What matters most, in a sentence; that it is not known, where effects do not say it. */
export function sentence({ sampling, robot }) {
  const { effects, sample, failure, busy } = sampling;
  if (failure) return "";
  if (!effects) return busy ? "Robots within the tolerances are being observed …" : "";
  const found = attribution(effects, robot.study);
  const [one] = largest(effects.inputs, 1);
  if (!found.parts.length || !one) return "";
  const name = (entry) => named(entry, entryWords(entry));
  if (!sampling.hasEffects) {
    const before = found.winner ? `Of the state before: ${name(found.winner)} mattered most. ` : "";
    return `${before}This state is being observed …`;
  }
  const { observations, replicates } = effects;
  const robots = `${replicates} times ${observations} robots`;
  if (found.few) return busy ? `So far ${robots} are observed …` : fewWords(robots);
  if (found.little) return `What matters most is not known here: ${littleWords(found.explained)} ${INSTEAD}`;
  const soFar = busy ? `, so far from ${robots}` : "";
  if (one.low_mm <= 0 && one.high_mm >= 0) return `No tolerance stands out${soFar}.`;
  const length = lengths(one.effect_mm);
  return (
    `${mostWords(found, name, soFar)} The largest effect of a parameter ` +
    `is ${named(one.name, parameterWords(one.name))}, ${length(one.effect_mm)}, ` +
    `95 % interval ${length(one.low_mm)} to ${length(one.high_mm)}.${lossWords(sample)}`
  );
}

// What finds it where effects do not.
const INSTEAD = "Its study, under “As commands”, finds it.";

function fewWords(robots) {
  return `What matters most is not known here: ${robots} are too few. ${INSTEAD}`;
}

// The tolerance with the largest share: whether it matters most, or has most of what the effects explain.
function mostWords({ parts: [top], winner, explained }, name, soFar) {
  const [of, share] = [explainedPercent(explained), sharePercent(top.share)];
  return winner
    ? `The tolerance that matters most here${soFar}: ${name(top.entry)}, with ${share} of what the effects ` +
        `explain, ${of} of the variance.`
    : `What matters most is not certain here${soFar}: the effects explain ${of} of the variance; of that ` +
        `${name(top.entry)} has most, ${share}.`;
}

// Robots that have no deflection, where they are many.
function lossWords(sample) {
  const lost = Object.values(sample?.failed ?? {}).reduce((sum, count) => sum + count, 0);
  const share = lost / (sample?.observations ?? 1);
  return share < 0.05
    ? ""
    : ` ${sharePercent(share)} of the robots cannot be held here: this is of the others.`;
}

/** Statistics of the observations in words. */
export function statisticsWords({ summary, nominal }) {
  const { mean, std, q05, q50, q95, min, max } = summary;
  const length = lengths(mean);
  return (
    `Mean ${length(mean)}, standard deviation ${length(std)}; ` +
    `quantiles 5 % ${length(q05)}, 50 % ${length(q50)}, 95 % ${length(q95)}; ` +
    `from ${length(min)} to ${length(max)}; nominal robot ${length(nominal)} (triangle).`
  );
}

export function histogramTitle(sample) {
  return `Histogram of ${sample.summary.count} deflections. ${statisticsWords(sample)}`;
}

export function effectsTitle({ inputs }) {
  const [one] = largest(inputs, 1);
  const length = lengths(one?.effect_mm ?? 0, 3);
  const list = largest(inputs, 10).map(
    ({ name, effect_mm }) => `${name} ${length(effect_mm)}`,
  );
  return `The ten largest effects on the deflection: ${list.join(", ")}`;
}

// Texts of lengths [mm], all in the unit that one of them asks for.
function lengths(like_mm, count = 4) {
  const [factor, unit] = lengthUnit(like_mm / 1e3);
  return (value_mm) => `${digits((factor * value_mm) / 1e3, count)} ${unit}`;
}

// The reason of the mechanics is told above already; of a study that of its pose is enough.
function reasonWords({ mechanics }, { kind, reason }) {
  if (mechanics.failure && kind !== "unobserved") return "the pose is not held";
  return reason.replace(/^study\.json: .*? that the nominal robot can hold: /, "");
}

function countWords({ sampling: { sample }, store }) {
  const { observations, milliseconds, coarse, failed } = sample;
  const wanted = store.state.observations;
  const count = observations < wanted ? `${observations} of ${wanted}` : String(observations);
  const time = `${count} observations in ${digits(milliseconds, 3)} ms`;
  return `${time}${coarse ? ", few while it moves" : ""}; ${failuresWords(failed)}.`;
}

// Why there are fewer observations than are wanted, or that they are of another state than that on screen.
function restWords({ store: { state }, sampling: { sample, busy, hasSample } }) {
  if (!hasSample) return "They are of the state before.";
  if (busy || sample.observations >= state.observations) return "";
  const each = digits(sample.milliseconds / sample.observations, 2);
  return `One takes ${each} ms here: the command of all is under “As commands”.`;
}

function failuresWords(failed) {
  const list = Object.entries(failed)
    .filter(([, count]) => count > 0)
    .map(([kind, count]) => `${count} ${kind.replaceAll("_", " ")}`);
  return list.length > 0 ? `failed: ${list.join(", ")}` : "none failed";
}
