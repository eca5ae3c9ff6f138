// The 3D page: shows one surface, given as compact arrays by viewer.py. `show` returns a handle that can take another
// surface later. Units in the scene: the drawing is about 2 across, centred at the origin, z up.

import { clothGeometry, decode, moveTo, paint, positionsAt } from "cloth";
import {
  Color, DirectionalLight, DoubleSide, Group, HemisphereLight, Line2, LineGeometry, LineMaterial, Mesh,
  MeshStandardMaterial, OrbitControls, OrthographicCamera, PCFShadowMap, PerspectiveCamera, PlaneGeometry, Raycaster,
  Scene, ShadowMaterial, Vector2, Vector3, WebGLRenderer,
} from "three";

const FIELD_OF_VIEW = 32;
const START_DIRECTION = new Vector3(-0.42, -1, 0.72).normalize();
const NEARLY_UP = new Vector3(0, -1e-4, 1).normalize();
const SEE_THROUGH = 0.42;

// One action: its name, its key, what it does, and whether it is on. Buttons and keys both come from this table.
const ACTIONS = [
  { name: "Top view", key: "t", hint: "From straight above: equals the drawing", perform: (v) => v.lookFromAbove(), on: (v) => v.camera === v.flat },
  { name: "Perspective", key: "p", hint: "From the side, in perspective", perform: (v) => v.lookFromSide(), on: (v) => v.camera === v.deep },
  { name: "Fit", key: "f", hint: "Fit the surface to the window", perform: (v) => v.fit() },
  { name: "See-through", key: "x", hint: "Make the surface transparent", perform: (v) => v.set({ seeThrough: !v.options.seeThrough }), on: (v) => v.options.seeThrough },
  { name: "Dark", key: "d", hint: "Dark or light", perform: (v) => v.set({ dark: !v.dark }), on: (v) => v.dark },
];

const COLOURINGS = [
  ["cloth", "Cloth"],
  ["layer", "Layers"],
  ["sheet", "Sheets"],
];

/** Reorder the triangles from far to near along `direction`, so that transparent ones blend in the right order. */
function sortTriangles(geometry, direction) {
  const positions = geometry.getAttribute("position").array;
  const index = geometry.getIndex();
  const depth = new Float32Array(index.count / 3);
  for (let t = 0; t < depth.length; t++) {
    for (let i = 9 * t; i < 9 * t + 9; i += 3) {
      depth[t] += positions[i] * direction.x + positions[i + 1] * direction.y + positions[i + 2] * direction.z;
    }
  }
  const order = Uint32Array.from(depth.keys()).sort((a, b) => depth[b] - depth[a]);
  order.forEach((t, place) => index.array.set([3 * t, 3 * t + 1, 3 * t + 2], 3 * place));
  index.needsUpdate = true;
}

/** The visible side has its own colour; the back is drawn in one warm tint. */
function clothMaterial(backName) {
  const back = new Color(backName);
  const material = new MeshStandardMaterial({
    vertexColors: true, side: DoubleSide, shadowSide: DoubleSide, roughness: 0.62, metalness: 0,
    polygonOffset: true, polygonOffsetFactor: 1.5, polygonOffsetUnits: 2, forceSinglePass: true,
  });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.back = { value: back };
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nuniform vec3 back;")
      .replace("#include <color_fragment>", "#include <color_fragment>\nif (!gl_FrontFacing) diffuseColor.rgb = mix(back, diffuseColor.rgb, 0.12);");
  };
  return material;
}

/** The coordinates of the boundary's vertices, once round. */
function around({ boundary }, positions) {
  return [...boundary, boundary[0]].flatMap((vertex) => [...positions.subarray(3 * vertex, 3 * vertex + 3)]);
}

function boundaryLine(surface) {
  return spaceLine(around(surface, surface.vertices), surface.palette.ink);
}

/** Red lines where sheets pass through each other. */
function intersectionLines(surface) {
  return surface.intersections.map((polyline) => spaceLine(polyline, surface.palette.intersection));
}

function spaceLine(positions, color) {
  const material = new LineMaterial({ color, linewidth: 2.4, alphaToCoverage: false });
  return new Line2(new LineGeometry().setPositions(positions), material);
}

// ---- scene -----------------------------------------------------------------------------------------------------

/** Light from the whole sky, and a little from below for those who look at the back. */
function softLights() {
  const sky = new HemisphereLight(0xffffff, 0xe6dccf, 1.55);
  sky.position.set(0, 0, 1);
  const below = new DirectionalLight(0xfff4e6, 1.7);
  below.position.set(0.5, -0.8, -1.6);
  return [sky, below];
}

function keyLight(radius) {
  const light = new DirectionalLight(0xffffff, 2.3);
  light.position.set(-0.9, 0.7, 2.6).setLength(4 * radius);
  light.castShadow = true;
  light.shadow.mapSize.set(2048, 2048);
  light.shadow.radius = 5;
  light.shadow.bias = -0.0006;
  light.shadow.normalBias = 0.012 * radius;
  const frame = light.shadow.camera;
  [frame.left, frame.right, frame.bottom, frame.top, frame.near, frame.far] = [-1, 1, -1, 1, 1, 7].map((x) => x * radius);
  return light;
}

function ground(radius) {
  const plane = new Mesh(new PlaneGeometry(12 * radius, 12 * radius), new ShadowMaterial({ opacity: 0.16, depthWrite: false }));
  plane.receiveShadow = true;
  plane.renderOrder = -1;
  return plane;
}

/** What `set` takes. A morph of 0 is the round disk, 1 laid flat over the drawing, 2 lifted. */
const OPTIONS = { explode: 1, stretch: 1, seeThrough: false, morph: 2, colouring: "cloth", dark: null, highlightSheet: null };

class Viewer {
  constructor(element, data) {
    this.element = element;
    this.canvas = element.querySelector("canvas");
    this.options = OPTIONS;
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.scene = new Scene();
    this.flat = new OrthographicCamera();
    this.deep = new PerspectiveCamera(FIELD_OF_VIEW);
    this.flat.up.set(0, 0, 1);
    this.deep.up.set(0, 0, 1);
    this.camera = this.deep;
    this.scale = 1;
    this.controls = this.makeControls();
    this.setSurface(data);
    this.buildToolbar();
    this.followPage();
    this.resize();
    this.lookFromSide();
  }

  // ---- what the handle of `show` is for

  /** Show another surface from the same direction. */
  update(data) {
    this.setSurface(data);
    this.apply(this.options);
    this.fit();
  }

  set(changes) {
    const before = this.options;
    this.options = { ...before, ...changes };
    this.apply(Object.fromEntries(Object.entries(changes).filter(([name, value]) => before[name] !== value)));
    this.refresh();
  }

  topView() {
    this.lookFromAbove();
    this.refresh();
  }

  dispose() {
    this.leaving.abort();
    this.watching.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
  }

  // ---- the inside

  apply(changes) {
    const actions = {
      explode: () => this.setScale(),
      stretch: () => this.setScale(),
      seeThrough: () => this.setSeeThrough(),
      morph: () => this.move(),
      colouring: () => this.paint(),
      highlightSheet: () => this.paint(),
      dark: () => this.setDark(),
    };
    Object.keys(changes).forEach((name) => actions[name]?.());
    this.requestFrame();
  }

  makeControls() {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.enableDamping = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    controls.dampingFactor = 0.12;
    controls.zoomToCursor = true;
    controls.addEventListener("change", () => this.requestFrame());
    return controls;
  }

  setSurface(data) {
    this.surface = decode(data);
    this.scene.clear();
    this.geometry = clothGeometry(this.surface);
    this.cloth = new Mesh(this.geometry, clothMaterial(this.surface.palette.back));
    this.cloth.castShadow = this.cloth.receiveShadow = true;
    this.line = boundaryLine(this.surface);
    this.passing = intersectionLines(this.surface);
    this.body = new Group().add(this.cloth, this.line, ...this.passing);
    this.scene.add(this.body, ...softLights());
    this.move();
    this.paint();
  }

  /** Put the cloth where it is at the time of its way that is to be seen. */
  move() {
    this.positions = positionsAt(this.surface, this.options.morph);
    moveTo(this.geometry, this.surface, this.positions);
    this.line.geometry.setPositions(around(this.surface, this.positions));
    this.passing.forEach((line) => Object.assign(line, { visible: this.options.morph === 2 }));
    this.sortedAlong = null;
    this.setScale();
  }

  paint() {
    const { colouring, highlightSheet } = this.options;
    paint(this.geometry, colouring, this.surface, highlightSheet === null ? [] : [highlightSheet].flat());
  }

  /** Half the diagonal of the surface at the current vertical scale: everything fits in this sphere. */
  get radius() {
    const box = this.geometry.boundingBox;
    const size = box.getSize(new Vector3());
    return Math.hypot(size.x, size.y, size.z * this.scale) / 2;
  }

  setScale() {
    const { explode, stretch } = this.options;
    this.scale = this.body.scale.z = this.surface.stretch * explode * stretch;
    this.scene.remove(this.key, this.ground);
    this.key = keyLight(this.radius);
    this.ground = ground(this.radius);
    this.ground.position.z = this.geometry.boundingBox.min.z * this.scale - 0.06 * this.radius;
    this.scene.add(this.key, this.ground);
    this.sortIfSeeThrough();
    this.requestFrame();
  }

  setSeeThrough() {
    const { seeThrough } = this.options;
    const { material } = this.cloth;
    material.transparent = seeThrough;
    material.opacity = seeThrough ? SEE_THROUGH : 1;
    material.depthWrite = !seeThrough;
    material.needsUpdate = true;
    this.cloth.castShadow = !seeThrough;
    this.sortIfSeeThrough();
  }

  sortIfSeeThrough() {
    if (!this.options.seeThrough) return;
    const direction = this.camera.getWorldDirection(new Vector3());
    direction.z *= this.scale;
    if (this.sortedAlong && direction.distanceTo(this.sortedAlong) < 0.02) return;
    this.sortedAlong = direction;
    sortTriangles(this.geometry, direction);
  }

  // ---- cameras

  look(camera, direction) {
    this.camera = this.controls.object = camera;
    camera.position.copy(direction).multiplyScalar(10 * this.radius);
    this.controls.target.set(0, 0, 0);
    this.fit();
  }

  lookFromAbove() {
    this.look(this.flat, NEARLY_UP);
  }

  lookFromSide() {
    this.look(this.deep, START_DIRECTION);
  }

  /** Keep the direction of view, and choose distance or zoom so that the whole surface is seen. */
  fit() {
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.set(0, 0, 0);
    this.shape();
    this.camera.position.copy(direction).multiplyScalar(this.distance(direction));
    this.camera.zoom = 1;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.requestFrame();
  }

  /** How far the eye must be for the whole boundary of the surface to lie inside the picture. */
  distance(direction) {
    if (this.camera === this.flat) return 4 * this.radius;
    const tangent = Math.tan((FIELD_OF_VIEW / 2) * (Math.PI / 180));
    const right = new Vector3().crossVectors(this.camera.up, direction).normalize();
    const up = new Vector3().crossVectors(direction, right);
    const point = new Vector3();
    let distance = 0;
    for (const vertex of this.surface.boundary) {
      point.fromArray(this.positions, 3 * vertex).multiply(this.body.scale);
      const reach = Math.max(Math.abs(up.dot(point)) / 0.78, Math.abs(right.dot(point)) / (0.92 * this.aspect));
      distance = Math.max(distance, direction.dot(point) + reach / tangent);
    }
    return distance;
  }

  shape() {
    const { min, max } = this.geometry.boundingBox;
    const tall = Math.max((max.y - min.y) / 0.78, (max.x - min.x) / (0.92 * this.aspect)) / 2;
    const wide = tall * this.aspect;
    Object.assign(this.flat, { left: -wide, right: wide, top: tall, bottom: -tall, near: 0.01, far: 40 * this.radius });
    Object.assign(this.deep, { aspect: this.aspect, near: 0.005 * this.radius, far: 60 * this.radius });
    this.flat.updateProjectionMatrix();
    this.deep.updateProjectionMatrix();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    this.aspect = width / height || 1;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.shape();
    this.requestFrame();
  }

  requestFrame() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      if (!this.canvas.checkVisibility({ visibilityProperty: true })) return;
      this.controls.update();
      this.sortIfSeeThrough();
      this.renderer.render(this.scene, this.camera);
    });
  }

  // ---- page around the picture

  get dark() {
    return this.options.dark ?? this.night.matches;
  }

  setDark() {
    if (this.options.dark !== null) this.element.dataset.theme = this.options.dark ? "dark" : "light";
    this.line.material.color.set(this.dark ? this.surface.palette.paleInk : this.surface.palette.ink);
    this.requestFrame();
  }

  /** The size and the theme of the page, and the pointer over the cloth. */
  followPage() {
    this.night = matchMedia("(prefers-color-scheme: dark)");
    this.leaving = new AbortController();
    const { signal } = this.leaving;
    this.night.addEventListener("change", () => this.setDark(), { signal });
    this.canvas.addEventListener("pointermove", (event) => event.buttons === 0 && this.tell(this.sheetUnder(event)), { signal });
    this.canvas.addEventListener("pointerleave", () => this.tell(null), { signal });
    this.watching = new ResizeObserver(() => this.resize());
    this.watching.observe(this.element);
    this.setDark();
  }

  sheetUnder({ offsetX, offsetY }) {
    const { clientWidth, clientHeight } = this.canvas;
    const place = new Vector2((2 * offsetX) / clientWidth - 1, 1 - (2 * offsetY) / clientHeight);
    const ray = new Raycaster();
    ray.setFromCamera(place, this.camera);
    const [hit] = ray.intersectObject(this.cloth);
    return hit ? this.surface.sheet[this.geometry.getIndex().array[3 * hit.faceIndex] / 3 | 0] : null;
  }

  /** Light up the sheet under the pointer, and say so to the page. */
  tell(sheet) {
    if (sheet === this.hovered) return;
    this.hovered = sheet;
    this.set({ highlightSheet: sheet });
    const detail = sheet === null ? null : { sheet, cell: this.surface.sheetCell[sheet], border: null };
    this.element.dispatchEvent(new CustomEvent("plyfold-hover", { detail }));
  }

  /** Buttons and sliders, where the page has a place for them; keys in any case. */
  buildToolbar() {
    const bar = this.element.querySelector("[role=toolbar]");
    const buttons = bar ? ACTIONS.map((action) => bar.appendChild(this.button(action))) : [];
    bar?.append(this.colourChoice(), this.motionSlider(), this.explodeSlider());
    this.refresh = () => buttons.forEach((button, i) => {
      if (ACTIONS[i].on) button.setAttribute("aria-pressed", ACTIONS[i].on(this));
    });
    this.element.addEventListener("keydown", (event) => this.press(event));
    this.canvas.addEventListener("dblclick", () => this.fit());
    queueMicrotask(this.refresh);
  }

  button(action) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = action.name;
    button.title = `${action.hint} (${action.key.toUpperCase()})`;
    button.setAttribute("aria-keyshortcuts", action.key.toUpperCase());
    button.addEventListener("click", () => this.perform(action));
    return button;
  }

  colourChoice() {
    const select = document.createElement("select");
    COLOURINGS.forEach(([value, name]) => select.add(new Option(name, value)));
    select.addEventListener("change", () => this.set({ colouring: select.value }));
    return labelled("Colour", select);
  }

  motionSlider() {
    const slider = range({ min: 0, max: 2, value: 2, title: "From the round disk over the flat drawing to the lifted surface" });
    slider.addEventListener("input", () => {
      this.set({ morph: slider.valueAsNumber });
      this.fit();
    });
    return labelled("Disk to surface", slider);
  }

  explodeSlider() {
    const slider = range({ min: -1, max: 1, value: 0, title: "Vertical scale of the heights" });
    slider.addEventListener("input", () => {
      this.set({ explode: 6 ** slider.valueAsNumber });
      this.fit();
    });
    return labelled("Explode", slider);
  }

  perform(action) {
    action.perform(this);
    this.refresh();
  }

  press(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select")) return;
    const action = ACTIONS.find(({ key }) => key === event.key.toLowerCase());
    if (action) this.perform(action);
    else if (event.target.matches("input") || !this.steer(event.key)) return; // arrows are the slider's
    event.preventDefault();
  }

  steer(key) {
    const moves = {
      ArrowLeft: () => this.controls.rotateLeft(0.12),
      ArrowRight: () => this.controls.rotateLeft(-0.12),
      ArrowUp: () => this.controls.rotateUp(0.12),
      ArrowDown: () => this.controls.rotateUp(-0.12),
      "+": () => this.controls.dollyIn(1.12),
      "=": () => this.controls.dollyIn(1.12),
      "-": () => this.controls.dollyOut(1.12),
    };
    if (!(key in moves)) return false;
    moves[key]();
    this.requestFrame();
    return true;
  }
}

function range(attributes) {
  return Object.assign(document.createElement("input"), { type: "range", step: 0.02, ...attributes });
}

function labelled(text, control) {
  const label = document.createElement("label");
  label.append(text, control);
  return label;
}

/** Show a surface inside `element`; without WebGL, say so instead. */
export function show(element, data) {
  try {
    return new Viewer(element, data);
  } catch (error) {
    element.querySelector("[role=status]").textContent = `This browser cannot draw in 3D: ${error.message}`;
    return null;
  }
}
