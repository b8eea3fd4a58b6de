// Data that the page carries: facts as JSON, arrays as base64 (tools/report/page_array.hpp).

const facts = JSON.parse(document.getElementById("facts").textContent);

/** The numbers of the array NAME, or null where the page has none. */
function arrayOf(name) {
  const element = document.getElementById(name);
  if (!element) {
    return null;
  }
  const text = atob(element.textContent);
  element.textContent = ""; // It is not needed twice.
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) {
    bytes[i] = text.charCodeAt(i);
  }
  const kinds = { Uint8Array, Uint16Array, Uint32Array, Float32Array, Float64Array };
  const numbers = new kinds[element.dataset.type](bytes.buffer);
  const low = Number(element.dataset.low), high = Number(element.dataset.high);
  return low === high ? numbers : Float32Array.from(numbers, n => low + n / 65535 * (high - low));
}

/** The text NAME of the page, with the texts that it includes by #include "NAME" and without what only C++ includes. */
function shaderText(name) {
  return document.getElementById(name).textContent
    .replace(/^#include <.*>$/gm, "")
    .replace(/^#include "(.*)"$/gm, (line, other) => shaderText(other));
}

const samples = {
  count: facts.samples,
  faces: arrayOf("sample_faces"),
  weights: arrayOf("sample_weights"),
  radii: arrayOf("sample_radii"),
  kinds: arrayOf("sample_kinds"),
  neighbors: arrayOf("sample_neighbors"),
  distances: arrayOf("sample_distances"),
  radius(i) { return this.radii[this.radii.length > 1 ? i : 0]; },
  /** 1 + class; 0 without classes. */
  kind(i) { return this.kinds[this.kinds.length > 1 ? i : 0]; },
  /** What two samples must be apart. */
  leastDistance(i, j) {
    return this.kind(i) > 0 ? facts.classes.distances[this.kind(i) - 1][this.kind(j) - 1] : this.radius(i) + this.radius(j);
  },
  /** To the nearest other one, in distances that they must keep; null where there is none in reach. */
  relativeDistance(i) {
    const other = this.neighbors[i];
    return other === i ? null : this.distances[i] / this.leastDistance(i, other);
  },
};

/** The unit vector that tools/report/surface_data.hpp tells by two numbers, or zeros. */
function unpackNormal(a, b, to, at) {
  if (a === 65535) {
    to[at] = to[at + 1] = to[at + 2] = 0;
    return;
  }
  let x = a / 65534 * 2 - 1, y = b / 65534 * 2 - 1;
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) {
    const folded = (1 - Math.abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - Math.abs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  const size = Math.hypot(x, y, z);
  to[at] = x / size;
  to[at + 1] = y / size;
  to[at + 2] = z / size;
}

/** Points, their normals, and the point of each corner; null where the page shows no surface. */
function readSurface() {
  if (!facts.view.surface) {
    return null;
  }
  const positions = arrayOf("positions"), packed = arrayOf("normals"), corners = arrayOf("corners");
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < packed.length / 2; ++i) {
    unpackNormal(packed[2 * i], packed[2 * i + 1], normals, 3 * i);
  }
  return { positions, normals, corners };
}

/** What the shader looks distances up in, four numbers to a texel; null where disks are left out. */
function readDisks() {
  const scale = facts.view.disks;
  if (!scale) {
    return null;
  }
  const frames = arrayOf("face_frames"), bases = arrayOf("face_bases");
  const columns = arrayOf("face_columns"), rows = arrayOf("face_rows");
  const counts = arrayOf("cell_windows");
  const x = arrayOf("window_x"), y = arrayOf("window_y"), sigmas = arrayOf("window_sigmas");
  const left = arrayOf("window_left"), right = arrayOf("window_right");
  const owners = arrayOf("window_samples");
  const faces = new Float32Array(8 * bases.length);
  const cells = new Float32Array(counts.length + 1);
  const windows = new Float32Array(8 * x.length);
  const setNormal = (angle, at) => {
    windows[at] = angle === 0 ? 0 : Math.cos((angle - 1) / 65534 * 2 * Math.PI);
    windows[at + 1] = angle === 0 ? 0 : Math.sin((angle - 1) / 65534 * 2 * Math.PI);
  };
  let cell = 0, w = 0;
  for (let f = 0; f < bases.length; ++f) {
    faces.set([frames[3 * f], frames[3 * f + 1], frames[3 * f + 2], bases[f], columns[f], rows[f], cell], 8 * f);
    for (let i = 0; i < columns[f] * rows[f]; ++i, ++cell) {
      cells[cell] = w;
      const cornerX = i % columns[f] / scale.cells_per_unit;
      const cornerY = Math.floor(i / columns[f]) / scale.cells_per_unit;
      for (const end = w + counts[cell]; w < end; ++w) {
        windows[8 * w] = x[w] + cornerX;
        windows[8 * w + 1] = y[w] + cornerY;
        windows[8 * w + 2] = sigmas[w];
        windows[8 * w + 3] = owners[w];
        setNormal(left[w], 8 * w + 4);
        setNormal(right[w], 8 * w + 6);
      }
    }
  }
  cells[cell] = w;
  return { faces, cells, windows };
}
