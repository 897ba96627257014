// The robot in space, as it rests and as it computes, from the data of the page, by the script of the explorer.
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const byId = (id) => document.getElementById(id);
  const STEPS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

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
  if (!data.robot) return;

  const { exits, anchors, center_of_mass, floor, poses } = data.robot;
  const element = byId("plot-robot");
  const size = Math.max(...[0, 1, 2].map((axis) => {
    const values = [...exits.map((exit) => exit[axis]), ...(axis === 2 ? [floor] : [])];
    return Math.max(...values) - Math.min(...values);
  }));
  const digits = (value) => Number(value.toPrecision(3)).toString();
  const times = (name) => STEPS[byId(name).value];
  const sagOf = (pose) => Math.max(...pose.unloaded.cables.map((cable) => cable.sag_mm));

  // States as the view has them: points one after the other.
  const state = (one) => ({
    ...one,
    cables: one.cables.map((cable) => ({
      ...cable, points: cable.points.flat(), wheel: cable.wheel.flat(), slack: false, limit: null,
    })),
  });

  // It is drawn once it comes near the window.
  const robot = { exits, anchors, center_of_mass, cables: exits.length, held: [], start: null, ground_z: floor };
  const nearness = new IntersectionObserver(async ([{ isIntersecting }]) => {
    if (!isIntersecting) return;
    nearness.disconnect();
    try {
      await packed.run("explorer-script");
      const content = poses.map(({ unloaded, loaded }) => ({ unloaded: state(unloaded), loaded: state(loaded) }));
      element.robot = cdprExplorer.still(element, { robot, poses: content, region: data.region });
      draw();
      element.dataset.drawn = "yes";
    } catch (error) {
      element.textContent = `The robot is not drawn here: ${error.message}.`;
    }
  }, { rootMargin: "600px" });

  function draw() {
    element.robot?.show({
      pose: byId("pose").value,
      isLoaded: document.querySelector("input[name=state]:checked").value === "loaded",
      sag: times("sag"),
      deflection: times("motion"),
      hasRegion: byId("region")?.checked ?? false,
    });
  }

  // What is drawn larger than it is, and how large it is.
  function say() {
    const pose = poses[byId("pose").value];
    for (const name of ["sag", "motion"]) {
      byId(`${name}-times`).textContent = `\u00d7${times(name)}${times(name) === 1 ? " (true)" : ""}`;
    }
    byId("robot-note").textContent =
      `Sag drawn \u00d7${times("sag")}, truly at most ${digits(sagOf(pose))} mm; arrow and outline of the ` +
      `deflection \u00d7${times("motion")}, truly ${digits(pose.deflection_mm)} mm.`;
  }

  // The largest step with which the deflection stays below a share of the robot's size; the sag is true.
  function fit() {
    const length = poses[byId("pose").value].deflection_mm / 1e3;
    byId("motion").value = Math.max(0, STEPS.findLastIndex((step) => step * length <= 0.06 * size));
  }

  fit();
  say();
  nearness.observe(element);
  for (const controls of document.querySelectorAll("#figure-robot .controls")) {
    controls.addEventListener("input", (event) => {
      if (event.target.id === "pose") fit();
      say();
      draw();
    });
    controls.addEventListener("submit", (event) => event.preventDefault());
  }
})();
