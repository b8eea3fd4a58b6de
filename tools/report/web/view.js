// The surface in three dimensions, by three.js.

const tasks = { picture: 0, pick: 1, area: 2 }; // As in surface.frag.
const texelsPerRow = 4096; // As in surface.frag.
const fieldOfView = 24; // Degrees, as in pictures.
const pickWidth = 9, trialWidth = 96; // Pixels.
const movingTime = 25, stillTime = 250; // Milliseconds that a picture may take.
const glideTime = 120; // Milliseconds, on slow machines as well.
const coarsest = 0.4; // Least pixels to each of the screen's, along each side.
const mostTried = 1.5e6; // Triangles to draw before the first picture.
const pointWidth = 3.2; // Most pixels of a point.

/** Numbers as a texture, `parts` to a texel: 1 or 4. */
function dataTexture(numbers, parts) {
  const rows = Math.max(1, Math.ceil(numbers.length / parts / texelsPerRow));
  const padded = new Float32Array(rows * texelsPerRow * parts);
  padded.set(numbers);
  const texture = new THREE.DataTexture(padded, texelsPerRow, rows,
    parts === 1 ? THREE.RedFormat : THREE.RGBAFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}

/** Where each corner of the faces lies in the frame of its face, which begins at corner `base`. */
function inFrames(faces) {
  const at = new Float32Array(faces.length / 8 * 6);
  for (let f = 0; 8 * f < faces.length; ++f) {
    const [longest, x, y, base] = faces.subarray(8 * f, 8 * f + 4);
    at[6 * f + 2 * ((base + 1) % 3)] = longest;
    at[6 * f + 2 * ((base + 2) % 3)] = x;
    at[6 * f + 2 * ((base + 2) % 3) + 1] = y;
  }
  return at;
}

/** The normal of the face whose corners begin at `c`, twice as long as its area is large. */
function crossOfFace(places, c) {
  const corner = k => new THREE.Vector3().fromArray(places, c + 3 * k);
  const first = corner(0);
  return corner(1).sub(first).cross(corner(2).sub(first));
}

/** Why the view cannot be shown; anything else that is thrown is a fault of the page. */
class NoView extends Error {}

class View {
  /** Throws NoView. `changed` is called when a picture was drawn. */
  constructor(canvas, surface, disks, changed) {
    this.canvas = canvas;
    this.surface = surface;
    this.changed = changed;
    this.marked = -1;
    const context = canvas.getContext("webgl2", { alpha: true, antialias: false });
    if (!context) {
      throw new NoView("This browser shows no WebGL 2, which the view needs. Everything else is below.");
    }
    this.renderer = new THREE.WebGLRenderer({ canvas, context, alpha: true });
    this.renderer.setClearColor(0x000000, 0);
    this.ratio = { moving: 1, still: 1 };
    this.checkSizes(disks);
    this.makeScene(surface, disks);
    this.camera = new THREE.PerspectiveCamera(fieldOfView, 1, 0.01, 10);
    this.camera.up.fromArray(facts.view.up);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    Object.assign(this.controls, {
      enableDamping: true, enableKeys: false, screenSpacePanning: true,
      minDistance: 4 * this.spacing, maxDistance: 40, rotateSpeed: 0.8,
    });
    this.controls.addEventListener("change", () => this.move());
    this.direction = this.bestDirection();
    this.reset();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    this.draw(tasks.picture); // Now, so that faults show.
    this.chooseRatios();
    for (const mesh of [this.mesh, this.points]) {
      if (mesh.material.program && mesh.material.program.diagnostics) {
        throw new NoView("This browser's WebGL does not compile the shaders of the view. Everything else is below.");
      }
    }
  }

  checkSizes(disks) {
    const most = this.renderer.capabilities.maxTextureSize;
    const numbers = disks ? Math.max(disks.windows.length, disks.faces.length, 4 * disks.cells.length) : 0;
    if (most < texelsPerRow || numbers / 4 / texelsPerRow > most) {
      throw new NoView("The WebGL of this browser has too little room for the view. Everything else is below.");
    }
  }

  makeScene(surface, disks) {
    const { positions, normals, corners } = surface;
    const places = new Float32Array(3 * corners.length), facing = new Int16Array(4 * corners.length);
    corners.forEach((point, i) => {
      for (let axis = 0; axis < 3; ++axis) {
        places[3 * i + axis] = positions[3 * point + axis];
        facing[4 * i + axis] = Math.round(32767 * normals[3 * point + axis]);
      }
    });
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(facing, 4, true));
    geometry.setAttribute("in_frame", new THREE.BufferAttribute(disks ? inFrames(disks.faces) : new Float32Array(2 * corners.length), 2));
    const none = dataTexture(new Float32Array(4), 4);
    const scale = disks ? facts.view.disks : { unit: 1, cells_per_unit: 1, seam: 0 };
    this.parts = new Float32Array(4 * samples.count);
    for (let i = 0; i < samples.count; ++i) {
      this.parts[4 * i] = samples.radius(i) / scale.unit;
      this.parts[4 * i + 2] = samples.kind(i);
    }
    this.uniforms = {
      faces: { value: disks ? dataTexture(disks.faces, 4) : none },
      cells: { value: disks ? dataTexture(disks.cells, 1) : none },
      windows: { value: disks ? dataTexture(disks.windows, 4) : none },
      samples: { value: dataTexture(this.parts, 4) },
      cells_per_unit: { value: scale.cells_per_unit },
      seam: { value: scale.seam },
      light: { value: new THREE.Vector3(...facts.view.light).normalize() },
      task: { value: tasks.picture },
      shown: { value: samples.count },
      marked: { value: -1 },
      has_disks: { value: disks !== null },
      shows_disks: { value: true },
      shows_surface: { value: true },
      shows_samples: { value: true },
      shows_triangles: { value: false },
      by_part: { value: false },
      pixel: { value: 1 },
      spacing: { value: 1 },
      most: { value: pointWidth },
      ink: { value: new THREE.Color(0x11151a) },
      mark: { value: new THREE.Color(0xe69f00) },
    };
    this.mesh = new THREE.Mesh(geometry, this.material("surface"));
    this.points = new THREE.Points(this.pointGeometry(places), this.material("point"));
    this.scene = new THREE.Scene();
    for (const drawn of [this.mesh, this.points]) {
      drawn.frustumCulled = false;
      this.scene.add(drawn);
    }
  }

  material(name) {
    return new THREE.RawShaderMaterial({
      vertexShader: `#version 300 es\n${shaderText(`${name}.vert`)}`,
      fragmentShader: `#version 300 es\n${shaderText(`${name}.frag`)}`,
      uniforms: this.uniforms,
      side: THREE.DoubleSide,
    });
  }

  /** The samples as points; also finds out how far apart they are, about. */
  pointGeometry(places) {
    const at = new Float32Array(3 * samples.count);
    for (let i = 0; i < samples.count; ++i) {
      const corner = 9 * samples.faces[i];
      const second = samples.weights[2 * i], third = samples.weights[2 * i + 1];
      for (let axis = 0; axis < 3; ++axis) {
        at[3 * i + axis] = (1 - second - third) * places[corner + axis] +
          second * places[corner + 3 + axis] + third * places[corner + 6 + axis];
      }
    }
    let area = 0;
    for (let c = 0; c < places.length; c += 9) {
      area += crossOfFace(places, c).length() / 2;
    }
    this.spacing = Math.sqrt(area / samples.count);
    this.uniforms.spacing.value = this.spacing;
    const geometry = new THREE.BufferGeometry();
    const normals = new Float32Array(3 * samples.count), kinds = new Float32Array(samples.count);
    for (let i = 0; i < samples.count; ++i) {
      kinds[i] = samples.kind(i);
      crossOfFace(places, 9 * samples.faces[i]).normalize().toArray(normals, 3 * i);
    }
    geometry.setAttribute("position", new THREE.BufferAttribute(at, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
    geometry.setAttribute("kind", new THREE.BufferAttribute(kinds, 1));
    return geometry;
  }

  // Layers, colours and marks that are shown.

  setShown(count) {
    this.uniforms.shown.value = count;
    this.points.geometry.setDrawRange(0, count);
    this.requestFrame();
  }

  setLayers(layers) {
    this.uniforms.shows_surface.value = layers.surface;
    this.uniforms.shows_disks.value = layers.disks;
    this.uniforms.shows_samples.value = layers.samples;
    this.uniforms.shows_triangles.value = layers.triangles;
    this.points.visible = layers.samples;
    this.mesh.visible = layers.surface || layers.disks;
    this.requestFrame();
  }

  /** Colours each sample's disk by partOf(sample), of 0 to 1; as in pictures without it. */
  setColoring(partOf) {
    this.uniforms.by_part.value = partOf !== null;
    if (partOf) {
      const { data } = this.uniforms.samples.value.image;
      for (let i = 0; i < samples.count; ++i) {
        data[4 * i + 1] = partOf(i);
      }
      this.uniforms.samples.value.needsUpdate = true;
    }
    this.requestFrame();
  }

  /** Marks a sample, or none for -1. */
  mark(sample) {
    if (this.uniforms.marked.value !== sample) {
      this.uniforms.marked.value = sample;
      this.requestFrame();
    }
  }

  // Point of view.

  reset() {
    this.controls.enableDamping = false;
    this.controls.update(); // Nothing is left of what was turned.
    this.controls.enableDamping = true;
    this.lookFrom(this.direction);
    this.controls.update();
    this.requestFrame();
  }

  /** From a direction, so near that everything just fits. */
  lookFrom(direction) {
    const front = new THREE.Vector3(...direction);
    const right = new THREE.Vector3().crossVectors(this.camera.up, front).normalize();
    const up = new THREE.Vector3().crossVectors(front, right);
    const t = 0.95 * Math.tan(fieldOfView / 360 * Math.PI);
    const across = this.fit(right, front, t * this.camera.aspect);
    const along = this.fit(up, front, t);
    this.controls.target.copy(right).multiplyScalar(across.shift).addScaledVector(up, along.shift);
    this.camera.position.copy(this.controls.target)
      .addScaledVector(front, Math.max(across.distance, along.distance));
    this.camera.lookAt(this.controls.target);
  }

  /** Where along `axis` the eye must be, and how far away, so that all lies between two planes of slope t. */
  fit(axis, front, t) {
    const { positions } = this.surface;
    let above = -Infinity, below = Infinity;
    for (let i = 0; i < positions.length; i += 3) {
      const along = positions[i] * axis.x + positions[i + 1] * axis.y + positions[i + 2] * axis.z;
      const toEye = t * (positions[i] * front.x + positions[i + 1] * front.y + positions[i + 2] * front.z);
      above = Math.max(above, along + toEye);
      below = Math.min(below, along - toEye);
    }
    return { shift: (above + below) / 2, distance: (above - below) / (2 * t) };
  }

  /** Of the directions to choose from, the one that most of the surface is seen from. */
  bestDirection() {
    const step = Math.ceil(facts.view.from.length * this.surface.corners.length / 3 / mostTried);
    const from = facts.view.from.filter((_, i) => i % step === 0); // Fewer of large surfaces.
    if (from.length === 1) {
      return from[0];
    }
    const target = new THREE.WebGLRenderTarget(trialWidth, trialWidth);
    const areas = from.map(direction => {
      this.lookFrom(direction);
      const pixels = this.drawInto(target, tasks.area);
      return pixels.reduce((sum, value, i) => i % 4 === 0 ? sum + value : sum, 0);
    });
    target.dispose();
    return from[areas.indexOf(Math.max(...areas))];
  }

  /** Turns by angles in radians, around the axis that points up and towards it. */
  turn(around, upwards) {
    const toY = new THREE.Quaternion().setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
    const offset = this.camera.position.clone().sub(this.controls.target).applyQuaternion(toY);
    const spherical = new THREE.Spherical().setFromVector3(offset);
    spherical.theta += around;
    spherical.phi -= upwards;
    spherical.makeSafe();
    offset.setFromSpherical(spherical).applyQuaternion(toY.inverse());
    this.camera.position.copy(this.controls.target).add(offset);
    this.move();
  }

  /** Goes nearer for factors below 1. */
  zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.move();
  }

  // Drawing: in fewer pixels while the view moves, where all take too long.

  move() {
    this.movedAt = performance.now();
    clearTimeout(this.stillTimer);
    this.stillTimer = setTimeout(() => this.requestFrame(), 250);
    this.requestFrame();
  }

  requestFrame() {
    if (!this.frame) {
      this.frame = requestAnimationFrame(now => {
        this.frame = 0;
        this.noteTime(now);
        this.controls.update(); // Asks for the next frame while it glides.
        const isMoving = performance.now() - this.movedAt < 200;
        this.setRatio(isMoving ? this.ratio.moving : this.ratio.still);
        this.draw(tasks.picture);
        this.changed();
      });
    }
  }

  /** By how long a picture takes. Edges are smooth with two pixels to each of the screen's, or where those are small. */
  chooseRatios() {
    const full = window.devicePixelRatio, fine = Math.max(full, 2);
    const context = this.renderer.getContext(), pixel = new Uint8Array(4);
    const take = ratio => {
      this.setRatio(ratio);
      const begin = performance.now();
      this.draw(tasks.picture);
      context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, pixel); // Waits for it.
      return performance.now() - begin;
    };
    take(full); // The first one takes longer.
    const took = take(full);
    const expected = took * (fine / full) ** 2;
    this.ratio.still = expected < stillTime ? fine : full;
    this.ratio.moving = expected < movingTime ? fine
      : full * Math.min(1, Math.max(coarsest, Math.sqrt(movingTime / took)));
  }

  /** Fewer pixels after several late frames: one is chance. */
  noteTime(now) {
    const took = now - this.lastFrame;
    this.lastFrame = now;
    this.controls.dampingFactor = 1 - Math.exp(-Math.min(took || 0, 1000) / glideTime);
    this.late = took > 2 * movingTime && took < 1000 ? (this.late || 0) + 1 : 0;
    if (this.late >= 3) {
      this.late = 0;
      this.ratio.moving = Math.max(coarsest * window.devicePixelRatio, 0.75 * this.ratio.moving);
    }
  }

  setRatio(ratio) {
    if (this.renderer.getPixelRatio() !== ratio) {
      this.renderer.setPixelRatio(ratio);
    }
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth > 0 && clientHeight > 0) {
      const isFirst = this.movedAt === undefined;
      this.renderer.setSize(clientWidth, clientHeight, false);
      this.camera.aspect = clientWidth / clientHeight;
      if (isFirst || this.atReset()) {
        this.reset();
      }
      this.requestFrame();
    }
  }

  /** Whether nobody has turned the view since reset(). */
  atReset() {
    const front = this.camera.position.clone().sub(this.controls.target).normalize();
    return front.distanceTo(new THREE.Vector3(...this.direction)) < 1e-3;
  }

  draw(task) {
    const { camera, uniforms } = this;
    const distance = camera.position.length();
    camera.near = Math.max(distance - 1.02, 1e-3);
    camera.far = distance + 1.02; // The surface is within the unit ball.
    camera.updateProjectionMatrix();
    const height = this.renderer.domElement.height;
    const isPicture = task === tasks.picture;
    const shows = this.points.visible;
    uniforms.task.value = task;
    uniforms.pixel.value = 2 * Math.tan(fieldOfView / 360 * Math.PI) / (isPicture ? height : this.canvas.clientHeight);
    uniforms.most.value = isPicture ? pointWidth * this.renderer.getPixelRatio() : pickWidth;
    this.points.visible = shows && task !== tasks.area;
    this.renderer.render(this.scene, camera);
    this.points.visible = shows;
  }

  /** The pixels of another task. */
  drawInto(target, task) {
    this.renderer.setRenderTarget(target);
    this.draw(task);
    const pixels = new Uint8Array(4 * target.width * target.height);
    this.renderer.readRenderTargetPixels(target, 0, 0, target.width, target.height, pixels);
    this.renderer.setRenderTarget(null);
    return pixels;
  }

  /** The sample whose disk or point is at x, y from the upper left, or a few pixels away; else -1. */
  sampleAt(x, y) {
    const { clientWidth, clientHeight } = this.canvas;
    const half = (pickWidth - 1) / 2;
    this.pickTarget = this.pickTarget || new THREE.WebGLRenderTarget(pickWidth, pickWidth);
    this.camera.setViewOffset(clientWidth, clientHeight, Math.floor(x) - half, Math.floor(y) - half, pickWidth, pickWidth);
    const pixels = this.drawInto(this.pickTarget, tasks.pick);
    this.camera.clearViewOffset();
    let best = -1, nearest = Infinity;
    for (let i = 0; i < pickWidth * pickWidth; ++i) {
      const sample = pixels[4 * i] + 256 * pixels[4 * i + 1] + 65536 * pixels[4 * i + 2] - 1;
      const distance = Math.hypot(i % pickWidth - half, Math.floor(i / pickWidth) - half);
      if (sample >= 0 && distance < nearest) {
        nearest = distance;
        best = sample;
      }
    }
    return best;
  }
}
