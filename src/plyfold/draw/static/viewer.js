// The 3D page: shows one surface, given as compact arrays by viewer.py. `show` returns a handle that can take another
// surface later. Units in the scene: the drawing is about 2 across, centred at the origin, z up.

import {
  clothGeometry, clothMaterial, cuspCorners, decode, dotPositions, edgePositions, extent, ground, keyLight, moveLines, moveTo, openEdges, paint,
  pairs, positionsAt, setOwnBack, softLights, sortTriangles, spaceLines,
} from "cloth";
import {
  Group, Mesh, OrbitControls, OrthographicCamera, PCFShadowMap, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3,
  WebGLRenderer,
} from "three";

const FIELD_OF_VIEW = 32;
const START_DIRECTION = new Vector3(-0.42, -1, 0.72).normalize();
const NEARLY_UP = new Vector3(0, -1e-4, 1).normalize();
const SEE_THROUGH = 0.42;
// How far layers are torn apart at most, each from the next and the lowest from the highest; and the part of the free
// picture that a surface fills.
const APART = 1.1;
const TOWER = 3.3;
const FILLED = 0.9;
// How many pixels wide the dots at cusps are.
const DOT = 9;

// One action: its name, its key, what it does, and whether it is on. Buttons and keys both come from this table.
const ACTIONS = [
  { name: "Top view", key: "t", hint: "From straight above: equals the drawing", perform: (v) => v.lookFromAbove(), on: (v) => v.camera === v.flat },
  { name: "Perspective", key: "p", hint: "From the side, in perspective", perform: (v) => v.lookFromSide(), on: (v) => v.camera === v.deep },
  { name: "Fit", key: "f", hint: "Fit the surface to the window", perform: (v) => v.fit() },
  { name: "See-through", key: "x", hint: "Make the surface transparent", perform: (v) => v.set({ seeThrough: !v.options.seeThrough }), on: (v) => v.options.seeThrough },
  { name: "Dark", key: "d", hint: "Dark or light", perform: (v) => v.set({ dark: !v.dark }), on: (v) => v.dark },
];

const colouring = (value, name, key, hint) => ({
  name, key, hint, perform: (v) => v.set({ colouring: value }), on: (v) => v.options.colouring === value,
});

const COLOURINGS = [
  colouring("cloth", "Cloth", "1", "One cloth, lighter where it is higher, with a back of its own"),
  colouring("layer", "Layers", "2", "A colour for each layer"),
  colouring("sheet", "Sheets", "3", "A colour for each sheet, darker from below"),
];

/** Red lines where sheets pass through each other. */
function intersectionLines({ intersections, palette }) {
  return spaceLines(intersections.flatMap(pairs), palette.intersection);
}

/**
 * What `set` takes. `explode` goes from 0, the glued surface, to 1, its layers torn far apart; `stretch` scales heights.
 * A morph of 0 is the round disk, 1 laid flat over the drawing, 2 lifted.
 */
const OPTIONS = { explode: 0, stretch: 1, seeThrough: false, morph: 2, colouring: "cloth", dark: null, highlightSheet: null };

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
    this.night = matchMedia("(prefers-color-scheme: dark)");
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
    const move = () => this.move();
    const paint = () => this.paint();
    const actions = {
      explode: move,
      stretch: move,
      seeThrough: () => this.setSeeThrough(),
      morph: move,
      colouring: paint,
      highlightSheet: paint,
      dark: () => this.setDark(),
    };
    new Set(Object.keys(changes).map((name) => actions[name])).forEach((action) => action?.());
    this.requestFrame();
  }

  makeControls() {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.enableDamping = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    controls.dampingFactor = 0.12;
    controls.zoomToCursor = true;
    controls.addEventListener("change", () => this.requestFrame());
    controls.addEventListener("start", () => (this.fitted = false));
    return controls;
  }

  setSurface(data) {
    this.surface = decode(data);
    this.scene.clear();
    this.geometry = clothGeometry(this.surface);
    this.cloth = new Mesh(this.geometry, clothMaterial(this.surface.palette.back));
    this.cloth.castShadow = this.cloth.receiveShadow = true;
    this.setLines();
    this.body = new Group().add(this.cloth, ...this.lines, this.dots, this.passing);
    this.scene.add(this.body, ...softLights());
    this.move();
    this.paint();
  }

  /** The drawing, the seams that are seen when layers are torn apart, cusps, and where sheets pass through each other. */
  setLines() {
    const { rim, seams } = openEdges(this.surface);
    this.edges = [rim, seams];
    const { palette, sheetCell } = this.surface;
    const width = 2.4 * Math.min(1, Math.sqrt(60 / sheetCell.length)); // finer where there is much to see
    this.lines = this.edges.map((corners) => spaceLines(edgePositions(this.geometry, corners), palette.ink, width));
    this.cusps = cuspCorners(this.surface);
    this.dots = spaceLines(dotPositions(this.geometry, this.cusps), palette.cusp, DOT);
    this.passing = intersectionLines(this.surface);
    this.setDark();
  }

  /** Put the cloth where it is at the time of its way that is to be seen, torn as far as it is to be. */
  move() {
    const { morph, explode, stretch } = this.options;
    this.scale = this.body.scale.z = this.surface.stretch * stretch;
    const apart = explode * Math.min(APART, TOWER / this.surface.palette.layers.length);
    moveTo(this.geometry, this.surface, positionsAt(this.surface, morph), apart / this.scale);
    this.edges.forEach((corners, i) => moveLines(this.lines[i], edgePositions(this.geometry, corners)));
    moveLines(this.dots, dotPositions(this.geometry, this.cusps));
    this.lines[1].visible = explode > 0 && this.edges[1].length > 0;
    this.passing.visible = morph === 2 && explode === 0 && this.surface.intersections.length > 0;
    this.sortedAlong = null;
    this.setLights();
  }

  paint() {
    const { colouring, highlightSheet } = this.options;
    paint(this.geometry, colouring, this.surface, highlightSheet === null ? [] : [highlightSheet].flat());
    setOwnBack(this.cloth.material, colouring !== "cloth");
  }

  /** Half the diagonal of the surface at the current vertical scale: everything fits in this sphere. */
  get radius() {
    const box = this.geometry.boundingBox;
    const size = box.getSize(new Vector3());
    return Math.hypot(size.x, size.y, size.z * this.scale) / 2;
  }

  setLights() {
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

  /** Keep the direction of view, and go where the whole surface is seen, as large as heading and buttons let it be. */
  fit() {
    this.stop();
    const towards = this.camera.position.clone().sub(this.controls.target).normalize();
    const right = new Vector3().crossVectors(this.camera.up, towards).normalize();
    const up = new Vector3().crossVectors(towards, right);
    const { wide, tall } = this.free();
    const slope = this.camera === this.flat ? 0 : Math.tan((FIELD_OF_VIEW / 2) * (Math.PI / 180));
    const across = extent(this.geometry, this.scale, right, towards, slope * wide);
    const upward = extent(this.geometry, this.scale, up, towards, slope * tall);
    const half = Math.max(across.half / wide, upward.half / tall);
    this.half = slope ? this.half : half;
    this.controls.target.copy(right).multiplyScalar(across.middle).addScaledVector(up, upward.middle);
    this.camera.position.copy(this.controls.target).addScaledVector(towards, slope ? half / slope : 4 * this.radius);
    this.camera.zoom = 1;
    this.shape();
    this.controls.update();
    this.fitted = true;
    this.requestFrame();
  }

  /** Be at once where a turn that is under way would end. */
  stop() {
    const { enableDamping } = this.controls;
    this.controls.enableDamping = false;
    this.controls.update();
    this.controls.enableDamping = enableDamping;
  }

  /** The part of the picture that nothing lies over, and that a surface may fill, in parts of the picture's height. */
  free() {
    const { height, aspect, top, bottom } = this.size;
    return { wide: FILLED * aspect, tall: FILLED * Math.max(1 - (top + bottom) / height, 0.25) };
  }

  /** Tell both cameras the shape of the picture, with the middle of its free part as their middle. */
  shape() {
    const { width, height, aspect, top, bottom } = this.size;
    const { half = 1, radius } = this;
    Object.assign(this.flat, { left: -half * aspect, right: half * aspect, top: half, bottom: -half, near: 0.01, far: 40 * radius });
    Object.assign(this.deep, { aspect, near: 0.005 * radius, far: 60 * radius });
    [this.flat, this.deep].forEach((camera) => camera.setViewOffset(width, height, 0, (bottom - top) / 2, width, height));
  }

  /** The size of the picture in pixels, and how much of it heading and buttons take at the top and at the bottom. */
  measure() {
    const { clientWidth, clientHeight } = this.element;
    const [width, height] = [clientWidth || 1, clientHeight || 1];
    const outer = this.element.getBoundingClientRect();
    const header = this.element.querySelector("header")?.getBoundingClientRect();
    const bar = this.element.querySelector("[role=toolbar]")?.getBoundingClientRect();
    const top = header?.height ? header.bottom - outer.top : 0;
    const bottom = bar?.height ? outer.bottom - bar.top : 0;
    this.size = { width, height, aspect: width / height, top, bottom };
  }

  resize() {
    this.measure();
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(this.size.width, this.size.height, false);
    if (this.fitted) this.fit();
    else this.shape();
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
    const { ink, lineOnDark } = this.surface.palette;
    this.lines.forEach(({ material }) => material.color.set(this.dark ? lineOnDark : ink));
    this.requestFrame();
  }

  /** The size and the theme of the page, and the pointer over the cloth. */
  followPage() {
    this.leaving = new AbortController();
    const { signal } = this.leaving;
    this.night.addEventListener("change", () => this.setDark(), { signal });
    this.canvas.addEventListener("pointermove", (event) => event.buttons === 0 && this.tell(this.sheetUnder(event)), { signal });
    this.canvas.addEventListener("pointerleave", () => this.tell(null), { signal });
    this.watching = new ResizeObserver(() => this.resize());
    [this.element, ...this.element.querySelectorAll("header, [role=toolbar]")].forEach((part) => this.watching.observe(part));
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
    const actions = bar ? [...ACTIONS, ...COLOURINGS] : [];
    const buttons = actions.map((action) => this.button(action));
    bar?.append(...buttons.slice(0, ACTIONS.length), group("Colour", buttons.slice(ACTIONS.length)), this.motionSlider(), this.explodeSlider());
    this.refresh = () => buttons.forEach((button, i) => {
      if (actions[i].on) button.setAttribute("aria-pressed", actions[i].on(this));
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

  motionSlider() {
    const isDisk = this.surface.frames.length > 0;
    const title = `From ${isDisk ? "the round disk over " : ""}the flat drawing to the lifted surface`;
    const slider = range({ min: isDisk ? 0 : 1, max: 2, value: 2, title });
    slider.addEventListener("input", () => {
      this.set({ morph: slider.valueAsNumber });
      this.fit();
    });
    return labelled(isDisk ? "Disk to surface" : "Flat to surface", slider);
  }

  explodeSlider() {
    const slider = range({ min: 0, max: 1, value: 0, title: "Tear the layers apart, along the borders between sheets" });
    slider.addEventListener("input", () => {
      this.set({ explode: slider.valueAsNumber });
      this.fit();
    });
    return labelled("Explode layers", slider);
  }

  perform(action) {
    action.perform(this);
    this.refresh();
  }

  press(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const action = [...ACTIONS, ...COLOURINGS].find(({ key }) => key === event.key.toLowerCase());
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
    this.fitted = false;
    moves[key]();
    this.requestFrame();
    return true;
  }
}

function range(attributes) {
  return Object.assign(document.createElement("input"), { type: "range", step: 0.01, ...attributes });
}

function labelled(text, control) {
  const label = document.createElement("label");
  label.append(text, control);
  return label;
}

function group(name, parts) {
  const made = document.createElement("div");
  made.setAttribute("role", "group");
  made.setAttribute("aria-label", name);
  made.append(...parts);
  return made;
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
