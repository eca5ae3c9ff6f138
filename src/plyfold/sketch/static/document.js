// The drawing: an immutable document, and edits that return a new one. What is undone, saved, shared and exported.
//   {plyfold: 2, strokes: [{points: [[x, y]..], closed, cusps: {vertex: index}}..], image: null | {href, place, opacity}, view: {}}
// Closed strokes are loops of one outline, each with the surface on its left; `cusps` is there where a stroke has some.

import { cuspsOf, withCusp, withPoints } from "./cusps.js";
import { bounds, distance, distanceToSegment, edges, middle, nearestOnSegment } from "./geometry.js";

export const VERSION = 2;
export const EMPTY = Object.freeze({ plyfold: VERSION, strokes: [], image: null, view: {} });

export const isEmpty = (document) => document.strokes.length === 0 && !document.image;
export const allPoints = (document) => document.strokes.flatMap(({ points }) => points);
export const loop = (points) => ({ ...EMPTY, strokes: [{ points, closed: true }] });
export const withStrokes = (document, strokes) => ({ ...document, strokes: strokes.filter(({ points }) => points.length) });
export const withImage = (document, image) => ({ ...document, image });
export const addStroke = (document, stroke) => withStrokes(document, [...document.strokes, stroke]);
export const lastStrokeOnly = (document) => withStrokes(document, document.strokes.slice(-1));

export function changeStroke(document, index, change) {
  return withStrokes(document, document.strokes.map((stroke, i) => (i === index ? change(stroke) : stroke)));
}

export const appendPoint = (document, index, point) =>
  changeStroke(document, index, (stroke) => ({ ...stroke, points: [...stroke.points, point] }));

export const movePoint = (document, { stroke, vertex }, point) =>
  changeStroke(document, stroke, (old) => ({ ...old, points: old.points.with(vertex, point) }));

export const insertPoint = (document, { stroke, vertex }, point) =>
  changeStroke(document, stroke, (old) => withPoints(old, old.points.toSpliced(vertex, 0, point)));

export const deletePoint = (document, { stroke, vertex }) =>
  changeStroke(document, stroke, (old) => withoutVertex(old, vertex));

function withoutVertex(stroke, vertex) {
  const left = stroke.points.toSpliced(vertex, 1);
  return withPoints(stroke, left, stroke.closed && left.length > 2);
}

/** A stroke in the other direction; a loop from the same first point. */
export function turned(stroke) {
  const { points, closed } = stroke;
  return withPoints(stroke, closed ? [points[0], ...points.slice(1).toReversed()] : points.toReversed());
}

/** The whole drawing in the other direction. Loops keep their places; open strokes come the other way round. */
export function reversed(document) {
  const open = document.strokes.filter(({ closed }) => !closed).map(turned);
  return withStrokes(document, document.strokes.map((stroke) => (stroke.closed ? turned(stroke) : open.pop())));
}

/** Some strokes in the other direction: a loop that was an outer boundary bounds a hole. */
export const withTurned = (document, indices) =>
  withStrokes(document, document.strokes.map((stroke, i) => (indices.includes(i) ? turned(stroke) : stroke)));

/** The index of a point as a cusp; 0 takes the mark away. */
export const markCusp = (document, { stroke, vertex }, index) => changeStroke(document, stroke, (old) => withCusp(old, vertex, index));

/** All cusps: {place, index}. */
export const allCusps = ({ strokes }) =>
  strokes.flatMap((stroke) => cuspsOf(stroke).map(({ vertex, index }) => ({ place: stroke.points[vertex], index })));

/** Close the last open stroke, or open a single closed one. */
export function toggleClosed(document) {
  const index = document.strokes.findLastIndex(({ points, closed }) => !closed && points.length > 2);
  const target = index < 0 ? document.strokes.length - 1 : index;
  return changeStroke(document, target, (stroke) => ({ ...stroke, closed: !stroke.closed }));
}

/** With six digits of the drawing's size: as much as can be seen. */
export function rounded(document) {
  const box = bounds(allPoints(document)) ?? [0, 0, 0, 0];
  const step = 10 ** (Math.floor(Math.log10(Math.max(box[2] - box[0], box[3] - box[1]) || 1)) - 5);
  const near = (value) => Number((Math.round(value / step) * step).toPrecision(15));
  return withStrokes(document, document.strokes.map((stroke) => ({ ...stroke, points: stroke.points.map((point) => point.map(near)) })));
}

// ---- finding ------------------------------------------------------------------------------------------------------

/** The vertex nearest to a place, within reach, as {stroke, vertex}, or null. */
export function vertexAt(document, place, reach) {
  let best = null;
  document.strokes.forEach(({ points }, stroke) => points.forEach((point, vertex) => {
    const far = distance(point, place);
    if (far <= (best?.far ?? reach)) best = { stroke, vertex, far };
  }));
  return best && { stroke: best.stroke, vertex: best.vertex };
}

/** Where a vertex would be inserted, on the nearest edge within reach: {stroke, vertex, point}, or null. */
export function edgeAt(document, place, reach) {
  let best = null;
  document.strokes.forEach((path, stroke) => edges(path).forEach(([a, b], i) => {
    const far = distanceToSegment(place, a, b);
    if (far <= (best?.far ?? reach)) best = { stroke, vertex: i + 1, point: nearestOnSegment(place, a, b), far };
  }));
  return best;
}

/** Ends of open strokes. */
export const ends = (strokes) => strokes.flatMap(({ points, closed }) => (closed ? [] : [points[0], points.at(-1)]));

/** The joins between strokes, as pairs of their ends, found from the middles that the server names. */
export function joins(strokes, repairs) {
  const free = ends(strokes);
  return repairs.filter(({ kind }) => kind === "gap bridged").map(({ where }) => {
    const pairs = free.flatMap((a, i) => free.slice(i + 1).map((b) => [a, b]));
    return pairs.sort((one, other) => distance(middle(...one), where) - distance(middle(...other), where))[0];
  }).filter(Boolean);
}

/** The paths of a drawing with its joins: what crossings are counted on. A stroke that joins itself is one closed path. */
export function paths({ strokes }, bridged = []) {
  if (strokes.length === 1 && bridged.length === 1) return [{ points: strokes[0].points, closed: true }];
  return [...strokes, ...bridged.map((points) => ({ points, closed: false }))];
}

/** The grid's lines are 1, 2 or 5 times a power of ten apart, and at least 18 pixels. */
export function gridStep(scale) {
  const least = 18 / scale;
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((digit) => digit * power).find((step) => step >= least);
}

/** A place drawn to the end of a stroke nearby, or else to the grid. */
export function snapped(document, place, scale) {
  const near = ends(document.strokes).find((end) => distance(end, place) < 12 / scale);
  const step = gridStep(scale);
  return near ?? place.map((x) => Math.round(x / step) * step);
}
