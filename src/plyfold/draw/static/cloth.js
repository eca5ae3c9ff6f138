// The cloth of the 3D page: its arrays, where its points are at each time of the way from the round disk to the lifted
// surface, and its colours. Units: the drawing is about 2 across, centred at the origin, z up.

import { BufferAttribute, BufferGeometry, Color } from "three";

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

/** Put the corners where the vertices are now, with the normals they have there. */
export function moveTo(geometry, surface, positions) {
  const shared = new BufferGeometry();
  shared.setAttribute("position", new BufferAttribute(positions, 3));
  shared.setIndex(new BufferAttribute(surface.faces, 1));
  shared.computeVertexNormals();
  spread(shared.getAttribute("position"), surface.faces, geometry.getAttribute("position"));
  spread(shared.getAttribute("normal"), surface.faces, geometry.getAttribute("normal"));
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
}

function spread(source, faces, target) {
  faces.forEach((vertex, corner) => target.array.set(source.array.subarray(3 * vertex, 3 * vertex + 3), 3 * corner));
  target.needsUpdate = true;
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
