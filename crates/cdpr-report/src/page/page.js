// Draws what lies in space: the robot and the surfaces, from the data of the page, by plotly.js.
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const byId = (id) => document.getElementById(id);
  const color = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
  const dark = matchMedia("screen and (prefers-color-scheme: dark)");
  const config = {
    displaylogo: false, responsive: true, modeBarButtonsToRemove: ["tableRotation", "resetCameraLastSave3d"],
  };
  const STEPS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
  const BLUE = "#56b4e9", ORANGE = "#e69f00", VERMILLION = "#d55e00";

  // A view: an element and what draws it. It is drawn when it comes near the window and let go when it is far
  // away, because browsers hold but few WebGL contexts. The camera lives in `layout`, which plotly.js keeps up
  // to date.
  const views = new Map();
  function view(element, traces, scene) {
    const layout = { autosize: true, margin: { l: 0, r: 0, t: 0, b: 0 }, showlegend: false, scene: {} };
    const draw = async () => {
      await packed.run("plotly");
      const axes = scene();
      for (const axis of ["xaxis", "yaxis", "zaxis"]) {
        axes[axis] = {
          gridcolor: color("line"), zerolinecolor: color("line"), showbackground: false, showspikes: false,
          ...axes[axis],
        };
      }
      Object.assign(layout, {
        paper_bgcolor: color("paper"),
        font: { family: getComputedStyle(document.body).fontFamily, size: 12, color: color("ink") },
        hoverlabel: {
          align: "left", bgcolor: color("tint"), bordercolor: color("line"), font: { color: color("ink") },
        },
      });
      layout.scene = { ...axes, camera: layout.scene.camera ?? axes.camera };
      await Plotly.react(element, traces(), layout, config);
      element.dataset.drawn = "yes";
    };
    views.set(element, { draw, layout, near: false });
    turnByKeys(element);
    letThePageScroll(element);
    nearness.observe(element);
    return () => { if (views.get(element).near) draw(); };
  }
  const nearness = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const known = views.get(target);
      if (isIntersecting === known.near) continue;
      known.near = isIntersecting;
      if (isIntersecting) known.draw().catch((error) => { target.textContent = error.message; });
      else if (target.dataset.drawn) { Plotly.purge(target); delete target.dataset.drawn; }
    }
  }, { rootMargin: "600px" });
  const redraw = () => { for (const { draw, near } of views.values()) if (near) draw(); };
  dark.addEventListener("change", redraw);

  // The wheel scrolls the page until the view has been clicked.
  function letThePageScroll(element) {
    let active = false;
    element.addEventListener("pointerdown", () => { active = true; });
    element.addEventListener("pointerleave", () => { active = false; });
    const keep = (event) => { if (!active) event.stopPropagation(); };
    element.addEventListener("wheel", keep, { capture: true });
  }

  // Arrows turn the camera about the vertical and up and down; + and - change its distance.
  function turnByKeys(element) {
    element.addEventListener("keydown", (event) => {
      const { x, y, z } = element._fullLayout?.scene?.camera?.eye ?? {};
      if (x === undefined) return;
      let distance = Math.hypot(x, y, z);
      let [azimuth, height] = [Math.atan2(y, x), Math.asin(z / distance)];
      const keys = {
        ArrowLeft: () => { azimuth -= 0.1; }, ArrowRight: () => { azimuth += 0.1; },
        ArrowUp: () => { height = Math.min(height + 0.1, 1.5); },
        ArrowDown: () => { height = Math.max(height - 0.1, -1.5); },
        "+": () => { distance /= 1.1; }, "-": () => { distance *= 1.1; },
      };
      if (!keys[event.key]) return;
      keys[event.key]();
      event.preventDefault();
      const level = distance * Math.cos(height);
      const eye = {
        x: level * Math.cos(azimuth), y: level * Math.sin(azimuth), z: distance * Math.sin(height),
      };
      Plotly.relayout(element, { "scene.camera.eye": eye });
    });
  }

  // Narrow views are seen from farther away, and have no room for a colour bar.
  const isNarrow = (element) => element.clientWidth < 560;
  const from = (element, { x, y, z }, height) => {
    const times = isNarrow(element) ? 1.25 : 1;
    return { eye: { x: times * x, y: times * y, z: times * z }, center: { x: 0, y: 0, z: height } };
  };

  // The robot that computes, in a window over the page; it goes on where it was left.
  if (typeof WebAssembly !== "undefined") {
    const dialog = byId("live");
    let explorer = null;
    let left = { state: null, pose: null };
    const open = async () => {
      dialog.showModal();
      const { robot, study, file } = data.live;
      const pose = data.robot?.poses[byId("pose").value].pose ?? null;
      const state = left.pose === pose ? left.state : null;
      left = { state, pose };
      explorer = await packed.explore(byId("live-robot"),
        { robot, study, state, pose, name: file, embedded: true });
    };
    byId("live-offer").hidden = false;
    byId("live-open").addEventListener("click", open);
    byId("live-close").addEventListener("click", () => dialog.close());
    dialog.addEventListener("close", () => {
      left.state = explorer?.getState() ?? left.state;
      explorer?.dispose();
      explorer = null;
    });
  }

  const columns = (points) => [0, 1, 2].map((axis) => points.map((point) => point[axis]));
  const metres = (point) => "(" + point.map((value) => value.toFixed(4)).join(", ") + ") m";
  const digits = (value) => Number(value.toPrecision(3)).toString();

  if (data.robot) {
    const { exits, ring, floor, poses } = data.robot;
    const extent = (values) => Math.max(...values) - Math.min(...values);
    const size = Math.max(...columns([...exits, exits[0].with(2, floor)]).map(extent));
    // The largest step that leaves what it stretches below this share of the robot's size.
    const fitting = (length, share) =>
      Math.max(0, STEPS.findLastIndex((step) => step * length <= share * size));
    const lerp = (a, b, share) => a.map((value, axis) => value + share * (b[axis] - value));
    const times = (input) => STEPS[input.value];

    // The points of a cable with the distances of its free part from the chord stretched, on a chord whose
    // anchor point is `anchor`. What lies on a pulley stays there.
    function stretched({ points, free }, sag, anchor) {
      const [exit, end] = [points[free], points[points.length - 1]];
      const chord = end.map((value, axis) => value - exit[axis]);
      const squared = chord.reduce((sum, value) => sum + value * value, 0);
      return points.map((point, k) => {
        if (k < free) return point;
        const along = point.reduce((sum, value, axis) => sum + (value - exit[axis]) * chord[axis], 0);
        const share = along / squared;
        const [true_place, place] = [lerp(exit, end, share), lerp(exit, anchor, share)];
        return place.map((value, axis) => value + sag * (point[axis] - true_place[axis]));
      });
    }

    // The region in which the platform is held.
    function region() {
      if (!data.region || !byId("region").checked) return [];
      const { points, lines, triangles } = data.region;
      const corners = (k) => triangles.map((triangle) => triangle[k]);
      const along = lines.flatMap((line) => [...line.map((k) => points[k]), [null, null, null]]);
      const [x, y, z] = columns(triangles.length > 0 ? points : along);
      return triangles.length > 0
        ? [{ type: "mesh3d", x, y, z, i: corners(0), j: corners(1), k: corners(2), color: BLUE, opacity: 0.2,
          hoverinfo: "skip" }]
        : [{ type: "scatter3d", mode: "lines", x, y, z, line: { color: BLUE, width: 5 }, hoverinfo: "skip" }];
    }

    function traces() {
      const pose = poses[byId("pose").value];
      const loaded = document.querySelector("input[name=state]:checked").value === "loaded";
      const [sag, motion] = [times(byId("sag")), times(byId("motion"))];
      const state = loaded ? pose.loaded : pose.unloaded;
      const moved = (from, to) => lerp(from, to, motion);
      const anchors = loaded
        ? pose.unloaded.anchors.map((from, i) => moved(from, pose.loaded.anchors[i]))
        : state.anchors;
      const line = (points, extra) => {
        const [x, y, z] = columns(points);
        return { type: "scatter3d", mode: "lines", x, y, z, hoverinfo: "skip", ...extra };
      };
      const dots = (points, text, extra) => {
        const [x, y, z] = columns(points);
        const hovertemplate = "%{text}<extra></extra>";
        return { type: "scatter3d", mode: "markers", x, y, z, text, hovertemplate, ...extra };
      };
      const gap = [null, null, null];
      const top = [...ring, ring[0]].map((i) => exits[i]);
      const ground = top.map((exit) => exit.with(2, floor));
      const posts = exits.flatMap((exit) => [exit, exit.with(2, floor), gap]);
      const cables = state.cables.map((cable, i) => stretched(cable, sag, anchors[i]));
      const [x, y, z] = columns(cables.flatMap((points) => [...points, gap]));
      const of_cables = (value) =>
        state.cables.flatMap((cable, i) => [...cable.points.map(() => value(cable, i)), value(cable, i)]);
      const tensions = [...pose.unloaded.cables, ...pose.loaded.cables].map(({ tension }) => tension);
      const label = (cable, i) =>
        `cable ${i + 1}<br>tension ${cable.tension.toFixed(1)} N<br>sag ${cable.sag_mm.toFixed(2)} mm`;
      const platform = (points, tone, opacity) => {
        const [x, y, z] = columns(points);
        return { type: "mesh3d", x, y, z, color: tone, opacity, flatshading: true, hoverinfo: "skip",
          alphahull: pose.flat ? -1 : 0, delaunayaxis: pose.flat ?? "z" };
      };
      const wheels = state.cables.flatMap(({ wheel }) => [...wheel, gap]);
      const place = (field) => (loaded ? moved(pose.unloaded[field], pose.loaded[field]) : state[field]);
      return [
        line([...posts, ...top, gap, ...ground], { line: { color: color("post"), width: 3 } }),
        {
          type: "scatter3d", mode: "lines", x, y, z,
          text: of_cables(label), hovertemplate: "%{text}<extra></extra>",
          line: {
            width: 5, color: of_cables((cable) => cable.tension), colorscale: "Viridis",
            cmin: Math.min(...tensions), cmax: Math.max(...tensions),
            showscale: !isNarrow(byId("plot-robot")),
            colorbar: {
              title: { text: "tension [N]", side: "right" },
              thickness: 12, len: 0.6, x: 1, xanchor: "right", outlinewidth: 0,
            },
          },
        },
        line(wheels, { line: { color: color("post"), width: 3 } }),
        ...(loaded ? [platform(pose.unloaded.anchors, color("post"), 0.15)] : []),
        platform(anchors, ORANGE, 0.6),
        dots(exits, exits.map((exit, i) => `exit point B${i + 1}<br>${metres(exit)}`),
          { marker: { size: 4, color: color("ink") } }),
        dots(anchors, state.anchors.map((anchor, i) => `anchor point A${i + 1}<br>${metres(anchor)}`),
          { marker: { size: 3.5, color: VERMILLION } }),
        dots([place("position"), place("center_of_mass")],
          [`reference point P<br>${metres(state.position)}`,
            `centre of mass G<br>${metres(state.center_of_mass)}`],
          { marker: { size: 4, color: BLUE, symbol: ["cross", "circle"] } }),
        ...region(),
      ];
    }

    const scene = () => ({
      aspectmode: "data",
      xaxis: { title: { text: "x [m]" } },
      yaxis: { title: { text: "y [m]" } },
      zaxis: { title: { text: "z [m]" } },
      camera: from(byId("plot-robot"), { x: 1.15, y: -1.55, z: 0.75 }, -0.12),
    });
    const redrawn = view(byId("plot-robot"), traces, scene);

    // What is drawn larger than it is, and how large it is.
    function say() {
      const pose = poses[byId("pose").value];
      const largest = Math.max(...pose.unloaded.cables.map((cable) => cable.sag_mm));
      const drawn = (name) => "\u00d7" + times(byId(name));
      for (const name of ["sag", "motion"]) {
        byId(name + "-times").textContent = drawn(name) + (times(byId(name)) === 1 ? " (true)" : "");
      }
      byId("robot-note").textContent =
        `Sag drawn ${drawn("sag")}, truly at most ${digits(largest)} mm; ` +
        `deflection drawn ${drawn("motion")}, truly ${digits(pose.deflection_mm)} mm.`;
    }
    function fit() {
      const pose = poses[byId("pose").value];
      byId("sag").value = fitting(Math.max(...pose.unloaded.cables.map((cable) => cable.sag_mm)) / 1e3, 0.05);
      byId("motion").value = fitting(pose.deflection_mm / 1e3, 0.04);
    }
    fit();
    say();
    const controls = document.querySelector(".controls");
    controls.addEventListener("input", (event) => {
      if (event.target.id === "pose") fit();
      say();
      redrawn();
    });
    controls.addEventListener("submit", (event) => event.preventDefault());
    byId("region")?.addEventListener("input", redrawn);
  }

  for (const { name, x, y, z, labels, output } of data.surfaces) {
    const figure = document.querySelector(`[data-surface="${CSS.escape(name)}"]`);
    if (!figure) continue;
    const [space, map] = [figure.querySelector(".space"), figure.querySelector(".map")];
    const buttons = figure.querySelectorAll("button");
    const traces = () => [{
      type: "surface", x, y, z, colorscale: "Viridis", showscale: !isNarrow(space),
      colorbar: { title: { text: output, side: "right" }, thickness: 14, len: 0.7, outlinewidth: 0 },
      contours: { z: { show: true, usecolormap: false, color: "#ffffff", width: 1, highlight: false } },
      hovertemplate:
        `${labels[0]}: %{x:.5~g}<br>${labels[1]}: %{y:.5~g}<br>${output}: %{z:.5~g}<extra></extra>`,
    }];
    // Seen from where the surface is low, so that it faces the reader.
    const mean = (values) =>
      values.filter((value) => value !== null).reduce((sum, value, _, all) => sum + value / all.length, 0);
    const column = (k) => z.map((row) => row[k]);
    const falls = [mean(column(0)) > mean(column(x.length - 1)), mean(z[0]) > mean(z[y.length - 1])];
    const scene = () => ({
      aspectmode: "manual", aspectratio: { x: 1.2, y: 1.2, z: 0.8 },
      xaxis: { title: { text: labels[0] }, nticks: 6 },
      yaxis: { title: { text: labels[1] }, nticks: 6 },
      zaxis: { title: { text: output }, nticks: 6 },
      camera: from(space, { x: falls[0] ? 1.2 : -1.2, y: falls[1] ? 1.6 : -1.6, z: 1 }, -0.15),
    });
    const show = (what) => {
      space.hidden = what !== "space";
      map.hidden = what !== "map";
      for (const button of buttons) button.setAttribute("aria-pressed", button.dataset.show === what);
    };
    for (const button of buttons) button.addEventListener("click", () => show(button.dataset.show));
    show("space");
    view(space, traces, scene);
  }
})();
