// Fills the page and connects its controls.

const byId = id => document.getElementById(id);

// Facts to report.

const analysis = facts.analysis, meshFacts = facts.mesh;
/** What distances of samples are told in. */
const classes = analysis.classes;
const unit = classes.length > 0 ? "distances of classes" : facts.sample_radii ? "sums of radii" : "D";
const meshName = meshFacts.path.replace(/^.*[/\\](?=.)/, "");

function fillFigures() {
  document.title = `${meshName}: ${counted(samples.count, "sample", "samples")}`;
  byId("title").textContent = meshName;
  const radii = facts.sample_radii;
  byId("subtitle").textContent = `${counted(samples.count, "sample", "samples")}, no two closer than ` +
    (classes.length > 0 ? `the distances of their classes, ${rounded(facts.min_distance, 6)} at most, `
      : radii ? `their radii together, of ${rounded(radii.least, 4)} to ${rounded(radii.most, 4)} each, `
      : `${rounded(facts.min_distance, 6)} `) +
    (facts.metric === "geodesic" ? "along the surface" : `by the metric ${facts.metric}`);
  const cards = [
    [grouped(samples.count), "samples"],
    [rounded(facts.min_distance, 5), radii || classes.length > 0 ? "largest minimum distance, in mesh units" : "minimum distance D, in mesh units"],
    [rounded(facts.rho, 4), "packing density ρ"],
    [analysis.smallest === null ? "–" : analysis.smallest.toFixed(5), `smallest distance, in ${unit}`],
    [analysis.mean_nearest === null ? "–" : analysis.mean_nearest.toFixed(3), `nearest on average, in ${unit}`],
    [`${rounded(100 * analysis.uncovered, 2)} %`, "of the area has room for more"],
    [secondsText(facts.seconds.sample), `sampling on ${facts.device.name}`],
  ];
  for (const [value, name] of cards) {
    const card = element("div", undefined, "card");
    card.append(element("b", value), element("span", name));
    byId("cards").append(card);
  }
  fillTable(byId("sample-figures"), [
    ["Samples", grouped(samples.count)],
    ["Minimum distance D", radii || classes.length > 0 ? null : rounded(facts.min_distance, 8)],
    ["Radius of a disk", radii ? `${rounded(radii.least, 6)} to ${rounded(radii.most, 6)}` : rounded(facts.radius, 8)],
    ["Smallest distance", analysis.smallest === null ? null : `${analysis.smallest.toFixed(6)} ${unit}`],
    ["Distance of the nearest, on average", analysis.mean_nearest === null ? null : `${analysis.mean_nearest.toFixed(4)} ${unit}`],
    ["Without another one in reach", analysis.without_neighbor > 0 ? grouped(analysis.without_neighbor) : null],
    ["Packing density ρ", rounded(facts.rho, 6)],
    ["Room for more", `${rounded(100 * analysis.uncovered, 3)} ± ${rounded(100 * analysis.uncovered_error, 1)} % of the area`],
    ["Largest gap", `${analysis.largest_gap < analysis.reach ? "" : "at least "}${analysis.largest_gap.toFixed(3)} ${unit}`],
    ["Looked at", `${grouped(analysis.probes)} random places`],
  ]);
  fillClasses();
  fillTable(byId("surface-figures"), [
    ["Mesh", meshFacts.path],
    ["Triangles", grouped(meshFacts.triangles)],
    ["Faces of the file", meshFacts.polygons === null ? null : grouped(meshFacts.polygons)],
    ["Vertices", grouped(meshFacts.vertices)],
    ["Components", grouped(meshFacts.components) + (meshFacts.components_without_samples > 0
      ? `, ${grouped(meshFacts.components_without_samples)} without a sample` : "")],
    ["Boundary edges", grouped(meshFacts.boundary_edges)],
    ["Area", rounded(meshFacts.area, 8)],
    ["Diagonal", meshFacts.diagonal === null ? null : rounded(meshFacts.diagonal, 6)],
    ...Object.entries(meshFacts).filter(([name]) => /^(coordinates|edge_lengths|lift|weld|keep_seams|density_.*)$/.test(name))
      .map(([name, value]) => [`--${name.replace(/_/g, "-")}`, [value].flat().join(", ")]),
    ["Warnings", facts.warnings.length === 0 ? null : facts.warnings.map(warning => warning.message).join("; ")],
  ]);
  fillTable(byId("run-figures"), [
    ["Method", facts.method === "darts" ? "parallel dart throwing" : "darts of a pool of candidates"],
    ["Candidates", grouped(facts.candidates)],
    ["Seed", facts.seed],
    ["Metric", facts.metric],
    ["Runs", facts.runs > 1 ? `${facts.runs}, for the count` : null],
    ["Device", facts.device.name],
    ["Driver", facts.device.driver],
    ["Memory on the device", sizeText(facts.device_bytes)],
    ["Disks computed", grouped(facts.disks)],
    ["Windows of disks", grouped(facts.windows)],
    ["geodisk", `${facts.version}, commit ${facts.commit.slice(0, 12)}${facts.commit_is_dirty ? " with changes" : ""}`],
  ]);
  byId("command").textContent = facts.command;
  if (facts.view.left_out.length > 0) {
    byId("left-out").hidden = false;
    for (const sentence of facts.view.left_out) {
      byId("left-out").append(element("li", `Left out: ${sentence}`));
    }
  }
}

/** A legend beside the view, and the figures of each class. */
function fillClasses() {
  if (classes.length === 0) {
    return;
  }
  byId("coloring").options[0].textContent = "by class";
  byId("class-section").hidden = byId("class-legend").hidden = false;
  const row = byId("class-figures").insertRow();
  for (const name of ["", "Samples", "Distance", "ρ", "Smallest", "Nearest, mean", "Room for more", "Largest gap"]) {
    row.append(element("th", name));
  }
  classes.forEach((one, number) => {
    const swatch = element("span", undefined, "swatch");
    swatch.style.background = `rgb(${facts.view.class_colors[number].map(part => Math.round(255 * part)).join(" ")})`;
    const entry = element("li", `class ${number}: ${counted(one.samples, "sample", "samples")}, D = ${rounded(one.min_distance, 4)}`);
    entry.prepend(swatch);
    byId("class-legend").append(entry);
    const figures = byId("class-figures").insertRow();
    figures.append(element("th", `Class ${number}`));
    for (const text of [
      grouped(one.samples), rounded(one.min_distance, 6), one.rho === null ? "–" : rounded(one.rho, 4),
      one.smallest === null ? "–" : one.smallest.toFixed(5), one.mean_nearest === null ? "–" : one.mean_nearest.toFixed(3),
      `${rounded(100 * one.uncovered, 3)} %`, one.largest_gap.toFixed(3),
    ]) {
      figures.insertCell().textContent = text;
    }
  });
}

function fillCharts() {
  byId("nearest-chart").append(analysis.nearest
    ? histogramChart("Histogram of nearest distances", analysis.nearest.bin_width, analysis.nearest.counts,
      `nearest sample, in ${unit}`, "samples")
    : element("p", "No sample has another one in reach."));
  const pairs = analysis.pair_correlation;
  if (pairs) {
    byId("pairs-chart").append(curveChart("Geodesic pair correlation",
      pairs.g.map((_, i) => (i + 0.5) * pairs.bin_width), pairs.g, 1, "geodesic distance, in D", "g"));
  } else {
    byId("pairs").querySelector("figcaption").textContent =
      "There is no pair correlation where radii or classes vary, as there samples are not equally dense.";
  }
  const stages = Object.entries(facts.seconds);
  const names = {
    load: "reading", prepare: "preparing", device: "opening device", pipelines: "shaders", upload: "upload",
    sample: "sampling", readback: "reading back", measure: "measuring", spectrum: "spectrum", disks: "disks of the page",
    other: "other",
  };
  byId("time-chart").append(namedBars("Seconds by stage", stages.map(([name, value]) => [names[name] || name, value]), secondsText));
  byId("time-caption").textContent = `${secondsText(stages.reduce((sum, [, value]) => sum + value, 0))} from the start to the writing of this page. "Other" is what no stage counts, such as choosing options and freeing memory.`;
  fillSpectrum();
}

/** facts.spectrum: { frequency, power, anisotropy, expected, unit, caption }, the first three arrays of one length;
 * anisotropy in dB, expected is where no direction is another than the others. */
function fillSpectrum() {
  const spectrum = facts.spectrum;
  if (!spectrum) {
    return;
  }
  byId("spectrum").hidden = false;
  byId("power-chart").append(curveChart("Radial mean of the power", spectrum.frequency, spectrum.power, 1,
    `frequency, ${spectrum.unit}`, "power"));
  byId("anisotropy-chart").append(curveChart("Anisotropy", spectrum.frequency, spectrum.anisotropy, spectrum.expected,
    `frequency, ${spectrum.unit}`, "dB"));
  if (spectrum.caption) {
    byId("power-caption").textContent = spectrum.caption;
  }
}

// One sample.

let chosen = -1, hovered = -1;

function describe(view) {
  const sample = hovered >= 0 ? hovered : chosen;
  const list = byId("sample");
  list.textContent = "";
  list.dataset.sample = sample;
  if (view) {
    view.mark(sample);
  }
  if (sample < 0) {
    list.append(element("dt", view ? "Point at a disk, or give its number." : "Give the number of one."));
    return;
  }
  const other = samples.neighbors[sample], relative = samples.relativeDistance(sample);
  const entries = [
    ["Sample", String(sample)],
    [meshFacts.polygons === null ? "Face" : "Triangle", String(samples.faces[sample])],
    ["Class", samples.kind(sample) > 0 ? String(samples.kind(sample) - 1) : null],
    ["Radius", rounded(samples.radius(sample), 6)],
    ["Nearest", relative === null ? `none within ${analysis.reach} ${unit}` : `sample ${other}`],
    ["Its distance", relative === null ? null : rounded(samples.distances[sample], 6)],
    [`In ${unit}`, relative === null ? null : relative.toFixed(4)],
  ];
  for (const [name, value] of entries) {
    if (value !== null) {
      list.append(element("dt", name), element("dd", value));
    }
  }
}

function choose(sample, view) {
  chosen = sample;
  byId("number").value = sample >= 0 ? sample : "";
  describe(view);
}

// Controls.

function connectView(view) {
  const canvas = byId("view");
  let pointer = null, pressed = null, waits = false;
  canvas.addEventListener("pointermove", event => {
    pointer = event.buttons === 0 && event.pointerType === "mouse" ? event : null;
    if (!waits && pointer) {
      waits = true;
      requestAnimationFrame(() => {
        waits = false;
        if (pointer) {
          hovered = view.sampleAt(pointer.offsetX, pointer.offsetY);
          describe(view);
        }
      });
    }
  });
  canvas.addEventListener("pointerleave", () => {
    pointer = null;
    hovered = -1;
    describe(view);
  });
  canvas.addEventListener("pointerdown", event => {
    pressed = { x: event.offsetX, y: event.offsetY };
  });
  canvas.addEventListener("pointerup", event => {
    if (pressed && Math.hypot(event.offsetX - pressed.x, event.offsetY - pressed.y) < 4) {
      choose(view.sampleAt(event.offsetX, event.offsetY), view);
    }
    pressed = null;
  });
  const step = 0.12, nearer = 0.88;
  const keys = {
    ArrowLeft: () => view.turn(-step, 0),
    ArrowRight: () => view.turn(step, 0),
    ArrowUp: () => view.turn(0, step),
    ArrowDown: () => view.turn(0, -step),
    "+": () => view.zoom(nearer),
    "=": () => view.zoom(nearer),
    "-": () => view.zoom(1 / nearer),
    Home: () => view.reset(),
    Escape: () => choose(-1, view),
  };
  canvas.addEventListener("keydown", event => {
    if (keys[event.key] && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      keys[event.key]();
    }
  });
  canvas.addEventListener("webglcontextlost", event => {
    event.preventDefault();
    showMessage("The browser has taken WebGL away from this page; it comes back when there is room for it.");
  });
  canvas.addEventListener("webglcontextrestored", () => {
    byId("view-message").hidden = true;
    view.requestFrame();
  });
  byId("reset").addEventListener("click", () => view.reset());
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => setLayers(view));
}

function setLayers(view) {
  const layers = {};
  for (const name of ["surface", "disks", "samples", "triangles"]) {
    layers[name] = byId(`show-${name}`).checked;
  }
  // Alone before the background, points have the colour of text.
  const alone = !layers.surface && !layers.disks;
  view.uniforms.ink.value.set(alone ? getComputedStyle(document.body).color : "#03050a");
  view.setLayers(layers);
}

/** By what part of the scale each way of colouring takes, and what its ends are called. */
const colorings = {
  plain: null,
  order: {
    partOf: i => i / Math.max(1, samples.count - 1), low: "first", high: "last",
  },
  distance: {
    partOf: i => (samples.relativeDistance(i) || 2) * 2 - 2, low: `1 ${unit}`, high: "1.5 and more",
  },
};

function connectControls(view) {
  for (const name of ["surface", "disks", "samples", "triangles"]) {
    byId(`show-${name}`).addEventListener("change", () => setLayers(view));
  }
  byId("show-disks").disabled = byId("coloring").disabled = !facts.view.disks;
  byId("coloring").addEventListener("change", () => {
    const way = colorings[byId("coloring").value];
    byId("legend").hidden = !way;
    byId("legend-low").textContent = way ? way.low : "";
    byId("legend-high").textContent = way ? way.high : "";
    view.setColoring(way ? way.partOf : null);
  });
  const slider = byId("shown");
  slider.max = samples.count;
  slider.value = samples.count;
  const show = () => {
    byId("shown-text").textContent = Number(slider.value) === samples.count
      ? `all ${grouped(samples.count)} samples` : `the first ${grouped(slider.value)} of ${grouped(samples.count)}`;
    view.setShown(Number(slider.value));
  };
  slider.addEventListener("input", show);
  show();
  connectPlay(slider, show);
}

/** Lets the slider run from the first sample, or from where it is, to the last. */
function connectPlay(slider, show) {
  const seconds = 8;
  const button = byId("play");
  let from = null;
  const stop = () => {
    from = null;
    button.textContent = "\u25b6";
    button.setAttribute("aria-label", "Play the darts");
  };
  const go = now => {
    if (!from) {
      return;
    }
    const part = Math.min(1, from.part + (now - from.time) / 1000 / seconds);
    slider.value = Math.round(part ** 2 * samples.count); // Slow at first, when each is seen to come.
    show();
    if (part < 1) {
      requestAnimationFrame(go);
    } else {
      stop();
    }
  };
  button.addEventListener("click", () => {
    if (from) {
      stop();
      return;
    }
    const shown = Number(slider.value);
    from = { part: shown < samples.count ? Math.sqrt(shown / samples.count) : 0, time: performance.now() };
    button.textContent = "\u23f8";
    button.setAttribute("aria-label", "Pause");
    requestAnimationFrame(go);
  });
  slider.addEventListener("pointerdown", stop);
}

function showMessage(text) {
  byId("view-message").textContent = text;
  byId("view-message").hidden = false;
}

function withoutView(text) {
  showMessage(text);
  byId("view").hidden = true;
  for (const control of document.querySelectorAll(".view-control")) {
    control.hidden = true;
  }
}

function connectRest(view) {
  describe(view);
  byId("number").max = samples.count - 1;
  byId("number").addEventListener("input", event => {
    const number = Number(event.target.value);
    const isSample = event.target.value !== "" && Number.isInteger(number) && number >= 0 && number < samples.count;
    chosen = isSample ? number : -1;
    describe(view);
  });
  byId("copy").addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(facts.command);
      byId("copy").textContent = "Copied";
    } catch {
      window.getSelection().selectAllChildren(byId("command")); // To be copied by hand.
    }
  });
}

function openView() {
  if (!facts.view.surface) {
    withoutView("There is no surface to look at here, for the reason told below.");
    return null;
  }
  try {
    const view = new View(byId("view"), readSurface(), readDisks(), () => {
      document.documentElement.dataset.drawn = Number(document.documentElement.dataset.drawn || 0) + 1;
    });
    connectView(view);
    connectControls(view);
    setLayers(view);
    return view;
  } catch (error) {
    if (!(error instanceof NoView)) {
      withoutView(`The view cannot be shown: ${error.message}`);
      throw error;
    }
    withoutView(error.message);
    return null;
  }
}

fillFigures();
fillCharts();
connectRest(openView());
document.documentElement.dataset.ready = "true";
