// The cloth of the 3D page: its arrays, where its points are at each time of the way from the round disk to the lifted
// surface, how its layers are torn apart, and what it looks like in which light. Units: the drawing is about 2 across, centred
// at the origin, z up.

import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, HemisphereLight, LineMaterial, LineSegments2,
  LineSegmentsGeometry, Mesh, MeshStandardMaterial, PlaneGeometry, ShadowMaterial,
} from "three";

// ---- data ------------------------------------------------------------------------------------------------------

function bytes(text) {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) out[i] = raw.charCodeAt(i);
  return out.buffer;
}

/** Turn the base64 fields of the page's data into typed arrays. */
export function decode(data) {
  return {
    ...data,
    vertices: new Float32Array(bytes(data.vertices)),
    faces: new Uint32Array(bytes(data.faces)),
    sheet: new Uint32Array(bytes(data.sheet)),
    level: new Uint32Array(bytes(data.level)),
    boundary: new Uint32Array(bytes(data.boundary)),
    cusps: new Uint32Array(bytes(data.cusps)),
    intersections: data.intersections.map((polyline) => new Float32Array(bytes(polyline))),
    frames: data.frames.map((frame) => new Float32Array(bytes(frame))),
  };
}

// ---- motion ----------------------------------------------------------------------------------------------------

/** Share of the heights that a flat disk keeps, so that its sheets lie in their order. */
const THICKNESS = 0.02;

/**
 * Where the vertices are at a time: 0 the round disk, 1 laid flat over the drawing, 2 lifted. The frames are those at
 * equal times from 0 to just before 1; between two of them points move straight.
 */
export function positionsAt(surface, time) {
  const { vertices, frames } = surface;
  if (time >= 2) return vertices;
  const positions = new Float32Array(vertices);
  const height = Math.max(time - 1, THICKNESS);
  for (let i = 2; i < positions.length; i += 3) positions[i] *= height;
  if (time < 1 && frames.length) between(positions, surface, time * frames.length);
  return positions;
}

function between(positions, { vertices, frames }, place) {
  const before = Math.floor(place);
  const share = place - before;
  const [from, to] = [frames[before], frames[before + 1]];
  for (let vertex = 0; vertex < positions.length / 3; vertex++) {
    for (const axis of [0, 1]) {
      const end = to ? to[2 * vertex + axis] : vertices[3 * vertex + axis];
      positions[3 * vertex + axis] = from[2 * vertex + axis] * (1 - share) + end * share;
    }
  }
}

// ---- geometry --------------------------------------------------------------------------------------------------

/** Every triangle gets corners of its own, so that colours may change across an edge while normals stay smooth. */
export function clothGeometry(surface) {
  const corners = surface.faces.length;
  const geometry = new BufferGeometry();
  for (const name of ["position", "normal", "color"]) {
    geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * corners), 3));
  }
  geometry.setIndex(new BufferAttribute(Uint32Array.from(surface.faces.keys()), 1));
  return geometry;
}

/** Put the corners where the vertices are now, with the normals they have there, and the layers so far apart. */
export function moveTo(geometry, surface, positions, apart = 0) {
  const shared = new BufferGeometry();
  shared.setAttribute("position", new BufferAttribute(positions, 3));
  shared.setIndex(new BufferAttribute(surface.faces, 1));
  shared.computeVertexNormals();
  spread(shared.getAttribute("position"), surface.faces, geometry.getAttribute("position"));
  spread(shared.getAttribute("normal"), surface.faces, geometry.getAttribute("normal"));
  if (apart) tear(geometry.getAttribute("position").array, surface, apart);
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
}

function spread(source, faces, target) {
  faces.forEach((vertex, corner) => target.array.set(source.array.subarray(3 * vertex, 3 * vertex + 3), 3 * corner));
  target.needsUpdate = true;
}

/** Move each layer up or down as a piece, by its level; the middle stays where it is. */
function tear(corners, surface, apart) {
  const middle = (surface.level.reduce((one, other) => Math.max(one, other), 1) + 1) / 2;
  for (let corner = 0; corner < surface.faces.length; corner++) {
    corners[3 * corner + 2] += apart * (levelAt(surface, corner) - middle);
  }
}

const levelAt = ({ level, sheet }, corner) => level[sheet[Math.floor(corner / 3)]];

/** The next corner of the same triangle. */
const following = (corner) => (corner % 3 === 2 ? corner - 2 : corner + 1);

/**
 * The edges where the cloth ends, each by the corner that it begins at: `rim` is the drawing itself, and along `seams`
 * it is torn where the layer changes; both sides are listed.
 */
export function openEdges(surface) {
  const { faces, vertices } = surface;
  const name = (from, to) => faces[from] * (vertices.length / 3) + faces[to];
  const near = atEdges(surface);
  const corners = [...faces.keys()].filter((corner) => near[faces[corner]] && near[faces[following(corner)]]);
  const across = new Map(corners.map((corner) => [name(following(corner), corner), corner]));
  const level = (corner) => levelAt(surface, corner);
  const other = (corner) => across.get(name(corner, following(corner)));
  return {
    rim: corners.filter((corner) => other(corner) === undefined),
    seams: corners.filter((corner) => other(corner) !== undefined && level(corner) !== level(other(corner))),
  };
}

/** Marks the vertices on the boundary, and those that triangles of several layers meet at. */
function atEdges(surface) {
  const { faces, boundary, vertices } = surface;
  const marks = new Uint8Array(vertices.length / 3);
  const known = new Uint32Array(marks.length);
  faces.forEach((vertex, corner) => {
    const level = levelAt(surface, corner);
    if (known[vertex] && known[vertex] !== level) marks[vertex] = 1;
    known[vertex] = level;
  });
  boundary.forEach((vertex) => (marks[vertex] = 1));
  return marks;
}

/** Lines along edges, each given by the corner that it begins at. */
export function edgePositions(geometry, corners) {
  const places = geometry.getAttribute("position").array;
  return corners.flatMap((corner) =>
    [corner, following(corner)].flatMap((end) => [places[3 * end], places[3 * end + 1], places[3 * end + 2]]));
}

/** A corner of the cloth at each cusp, on each layer that meets there. */
export function cuspCorners(surface) {
  const cusps = new Set(surface.cusps);
  const corners = [...surface.faces.keys()].filter((corner) => cusps.has(surface.faces[corner]));
  const name = (corner) => `${surface.faces[corner]} ${levelAt(surface, corner)}`;
  return [...new Map(corners.map((corner) => [name(corner), corner])).values()];
}

/** Dots at some corners, as lines that are hardly longer than nothing: wide ones are round at their ends. */
export function dotPositions(geometry, corners) {
  const places = geometry.getAttribute("position").array;
  return corners.flatMap((corner) => {
    const [x, y, z] = places.subarray(3 * corner, 3 * corner + 3);
    return [x, y, z, x, y, z + 1e-4];
  });
}

/** Lines in space between pairs of points, so many pixels wide. */
export function spaceLines(positions, color, linewidth = 2.4) {
  const material = new LineMaterial({ color, linewidth, alphaToCoverage: false });
  const geometry = new LineSegmentsGeometry();
  if (positions.length) geometry.setPositions(positions);
  return Object.assign(new LineSegments2(geometry, material), { visible: positions.length > 0 });
}

/** Move the same lines to other places. */
export function moveLines({ geometry }, positions) {
  if (!positions.length) return;
  const { data } = geometry.getAttribute("instanceStart");
  data.array.set(positions);
  data.needsUpdate = true;
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
}

/** The pairs of neighbouring points of a polyline. */
export function pairs(polyline) {
  const out = [];
  for (let i = 0; i + 6 <= polyline.length; i += 3) out.push(...polyline.subarray(i, i + 6));
  return out;
}

/** Reorder the triangles from far to near along `direction`, so that transparent ones blend in the right order. */
export function sortTriangles(geometry, direction) {
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

/**
 * Where an eye that looks against `towards` must be along `side` to have the cloth in the middle, and half of what it then
 * sees at most, at the height of the origin; rays to the border of the picture go aside by `slope`, and heights count
 * `scale` times.
 */
export function extent(geometry, scale, side, towards, slope) {
  const places = geometry.getAttribute("position").array;
  const [more, less] = [1, -1].map((sign) => towards.clone().multiplyScalar(slope).addScaledVector(side, sign));
  let [high, low] = [-Infinity, -Infinity];
  for (let i = 0; i < places.length; i += 3) {
    const [x, y, z] = [places[i], places[i + 1], places[i + 2] * scale];
    high = Math.max(high, more.x * x + more.y * y + more.z * z);
    low = Math.max(low, less.x * x + less.y * y + less.z * z);
  }
  return { middle: (high - low) / 2, half: (high + low) / 2 };
}

// ---- colours ---------------------------------------------------------------------------------------------------

/**
 * The visible side has its own colour. The back is one warm tint, or, where colours tell sheets or layers apart
 * (`setOwnBack`), a darker shade of the same colour.
 */
export function clothMaterial(backName) {
  const uniforms = { back: { value: new Color(backName) }, ownBack: { value: 0 } };
  const material = new MeshStandardMaterial({
    vertexColors: true, side: DoubleSide, shadowSide: DoubleSide, roughness: 0.62, metalness: 0,
    polygonOffset: true, polygonOffsetFactor: 1.5, polygonOffsetUnits: 2, forceSinglePass: true,
  });
  material.userData = uniforms;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nuniform vec3 back;\nuniform float ownBack;")
      .replace("#include <color_fragment>", `#include <color_fragment>
        if (!gl_FrontFacing) diffuseColor.rgb = mix(mix(back, diffuseColor.rgb, 0.12), 0.5 * diffuseColor.rgb, ownBack);`);
  };
  return material;
}

export function setOwnBack(material, own) {
  material.userData.ownBack.value = own ? 1 : 0;
}

function heights(positions) {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 2; i < positions.length; i += 3) {
    low = Math.min(low, positions[i]);
    high = Math.max(high, positions[i]);
  }
  return { low, high };
}

function clothColour(surface) {
  const { low, high } = heights(surface.vertices);
  const [bottom, top] = surface.palette.cloth.map((c) => new Color(c));
  const mixed = new Color();
  const height = (corner) => surface.vertices[3 * surface.faces[corner] + 2];
  return (corner) => mixed.lerpColors(bottom, top, (height(corner) - low) / (high - low || 1));
}

function tableColour(names, indexOfTriangle) {
  const colours = names.map((name) => new Color(name));
  return (corner) => colours[indexOfTriangle(Math.floor(corner / 3))];
}

function colouring(kind, surface) {
  const { palette, sheet, level } = surface;
  if (kind === "layer") return tableColour(palette.layers, (triangle) => level[sheet[triangle]] - 1);
  if (kind === "sheet") return tableColour(palette.sheets, (triangle) => sheet[triangle] % palette.sheets.length);
  return clothColour(surface);
}

/** Colour the cloth; all but the lit sheets, if there are any, are paler. */
export function paint(geometry, kind, surface, lit) {
  const attribute = geometry.getAttribute("color");
  const colourOf = colouring(kind, surface);
  const pale = new Color(surface.palette.pale);
  const shade = new Color();
  for (let corner = 0; corner < attribute.count; corner++) {
    shade.copy(colourOf(corner));
    if (lit.length && !lit.includes(surface.sheet[Math.floor(corner / 3)])) shade.lerp(pale, 0.6);
    attribute.setXYZ(corner, shade.r, shade.g, shade.b);
  }
  attribute.needsUpdate = true;
}

// ---- light -----------------------------------------------------------------------------------------------------

/** Light from the whole sky, and a little from below for those who look at the back. */
export function softLights() {
  const sky = new HemisphereLight(0xffffff, 0xe6dccf, 1.55);
  sky.position.set(0, 0, 1);
  const below = new DirectionalLight(0xfff4e6, 1.7);
  below.position.set(0.5, -0.8, -1.6);
  return [sky, below];
}

export function keyLight(radius) {
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

export function ground(radius) {
  const plane = new Mesh(new PlaneGeometry(12 * radius, 12 * radius), new ShadowMaterial({ opacity: 0.16, depthWrite: false }));
  plane.receiveShadow = true;
  plane.renderOrder = -1;
  return plane;
}
