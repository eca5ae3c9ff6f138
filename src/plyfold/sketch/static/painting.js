/**
 * The picture on the canvas. What is to be seen is said in full:
 *
 * picture = {size: {width, height}, camera, theme, document, joins: [[a, b]..], openEnds: [[x, y]..],
 *            answer: to `look` or null, lie: to `lie` or null,           both about this very document
 *            touches: [[x, y]..],                                        where the surface touches itself
 *            offered: [{where, index}..],                                cusps that would help
 *            trial: {areas, strokes} that an offer would make, or null
 *            tool, path: points being placed, next: where the next one would be, selected: {stroke, vertex},
 *            cursor: [x, y] of the keyboard, hover: {cell, sheets, border}, snap, image: loaded picture or null}
 * The theme is that of colours.js.
 */

import { toDrawing, toScreen } from "./camera.js";
import { onWinding, sheetColour, windingColour } from "./colours.js";
import { allCusps } from "./document.js";
import { distance } from "./geometry.js";
import { SPIKE } from "./notes.js";

const TURN = 2 * Math.PI;
const SPACING = 22;
const FADED = 0.4;
// Vertices nearer to each other than this are small, so that each is still seen.
const CROWDED = 11;

export function paint(context, picture) {
  const scene = { context, ...picture, at: (point) => toScreen(picture.camera, point) };
  const { size, answer, lie, document } = scene;
  context.clearRect(0, 0, size.width, size.height);
  paintGrid(scene);
  if (scene.image) paintImage(scene);
  if (answer) answer.cells.forEach((cell) => paintCell(scene, cell));
  if (answer) paintHover(scene);
  context.globalAlpha = scene.trial ? FADED : 1;
  document.strokes.forEach((stroke) => paintStroke(scene, stroke));
  context.globalAlpha = 1;
  if (scene.trial) paintTrial(scene, scene.trial);
  paintJoins(scene);
  if (lie) paintLie(scene);
  if (answer) paintAnswer(scene);
  scene.openEnds.forEach((place) => paintRing(scene, place));
  if (scene.tool === "edit" || scene.tool === "cusp") paintVertices(scene);
  scene.offered.forEach(({ where, index }) => paintCusp(scene, where, index, true));
  allCusps(document).forEach(({ place, index }) => paintCusp(scene, place, index));
  paintPath(scene);
  if (scene.cursor) paintCursor(scene, scene.cursor);
}

/** The distance of the grid's lines: 1, 2 or 5 times a power of ten, at least some pixels. */
export function gridStep({ scale }) {
  const least = SPACING / scale;
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((digit) => digit * power).find((step) => step >= least);
}

/** The point of the grid that is nearest. */
export const snapped = (camera, point) => {
  const step = gridStep(camera);
  return point.map((value) => Math.round(value / step) * step);
};

function paintGrid({ context, camera, size, theme, snap, at }) {
  const step = gridStep(camera) * (snap ? 1 : 2);
  const corner = toDrawing(camera, [0, 0]).map((value, axis) => (axis ? Math.ceil : Math.floor)(value / step) * step);
  const [left, top] = at(corner);
  context.fillStyle = theme.dot;
  for (let x = left; x < size.width; x += step * camera.scale) {
    for (let y = top; y < size.height; y += step * camera.scale) context.fillRect(x - 0.75, y - 0.75, 1.5, 1.5);
  }
}

function paintImage({ context, camera, document, at, image }) {
  const { place, opacity } = document.image;
  if (!place) return;
  const [left, top] = at([place[0], place[1] + place[3]]);
  context.globalAlpha = opacity ?? 0.5;
  context.drawImage(image, left, top, place[2] * camera.scale, place[3] * camera.scale);
  context.globalAlpha = 1;
}

function trace({ context, at }, points, closed) {
  points.forEach((point, i) => (i ? context.lineTo(...at(point)) : context.moveTo(...at(point))));
  if (closed) context.closePath();
}

/** All loops round a cell. */
function traceCell(scene, { outline, holes }) {
  scene.context.beginPath();
  [outline, ...holes].forEach((points) => trace(scene, points, true));
}

function line(scene, points, { closed = false, ...style }) {
  scene.context.beginPath();
  trace(scene, points, closed);
  stroke(scene, style);
}

function stroke({ context }, { colour, width = 2.5, dash = [], cap = "round" }) {
  Object.assign(context, { strokeStyle: colour, lineWidth: width, lineJoin: "round", lineCap: cap });
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

function paintCell(scene, cell) {
  const colour = windingColour(scene.theme, cell.winding);
  if (!colour) return;
  traceCell(scene, cell);
  scene.context.fillStyle = colour;
  scene.context.fill("evenodd");
}

function paintHover(scene) {
  const cell = scene.answer.cells.find((found) => found.cell === scene.hover?.cell);
  if (!cell) return;
  traceCell(scene, cell);
  stroke(scene, { colour: scene.theme.lit, width: 9 });
}

function paintStroke(scene, { points, closed }) {
  line(scene, points, { closed, colour: scene.theme.ink });
  paintDirection(scene, points, closed);
}

/** An arrow in the middle of the first long edge. */
function paintDirection({ context, theme, at }, points, closed) {
  const path = closed ? [...points, points[0]] : points;
  for (let i = 1; i < path.length; i++) {
    const [from, to] = [at(path[i - 1]), at(path[i])];
    if (distance(from, to) < 14 && i < Math.min(path.length - 1, 12)) continue;
    const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
    context.save();
    context.translate((from[0] + to[0]) / 2, (from[1] + to[1]) / 2);
    context.rotate(angle);
    context.beginPath();
    context.moveTo(7, 0);
    context.lineTo(-5, 5.5);
    context.lineTo(-2, 0);
    context.lineTo(-5, -5.5);
    context.fillStyle = theme.ink;
    context.fill();
    context.restore();
    return;
  }
}

/** What an offer would change, and the drawing that it would leave. */
function paintTrial(scene, { areas, strokes }) {
  const { context, theme } = scene;
  areas.forEach((points, number) => {
    context.beginPath();
    trace(scene, points, true);
    context.globalAlpha = FADED;
    context.fillStyle = sheetColour(theme, number);
    context.fill("nonzero");
    context.globalAlpha = 1;
  });
  strokes.forEach(({ points, closed }) => {
    line(scene, points, { closed, colour: theme.paper, width: 6 });
    line(scene, points, { closed, colour: theme.good, width: 3, dash: [9, 6] });
  });
}

function paintAnswer(scene) {
  const { answer, lie, theme } = scene;
  const { where } = answer.verdict;
  answer.crossings.forEach((place) => paintDot(scene, place, 3, theme.accent));
  answer.cells.forEach((cell) => paintNumber(scene, cell));
  answer.repairs.filter(({ kind }) => kind === SPIKE).forEach((spike) => paintRing(scene, spike.where, [3, 4]));
  answer.contacts.forEach((place) => paintDiamond(scene, place, 4.5, theme.paper, theme.ink));
  scene.touches.forEach((place) => paintDiamond(scene, place, 8, theme.touch, theme.paper));
  [...where, ...(lie?.obstruction?.where ?? [])].forEach((place) => paintCross(scene, place));
}

function paintJoins(scene) {
  for (const ends of scene.joins) {
    line(scene, ends, { colour: scene.theme.accent, dash: [3, 6] });
    ends.forEach((place) => paintDot(scene, place, 4, scene.theme.accent));
  }
}

/** Borders whose sheet has changed, those of the sheets under the pointer, and which strand passes over. */
function paintLie(scene) {
  const { theme, answer, lie } = scene;
  lie.changed_borders.forEach((border) => {
    line(scene, answer.borders[border], { colour: theme.lit, width: 7 });
    line(scene, answer.borders[border], { colour: theme.ink });
  });
  (scene.hover?.sheets ?? []).forEach((sheet) =>
    lie.sheets[sheet]?.forEach((border) =>
      line(scene, answer.borders[border], { colour: sheetColour(theme, sheet), width: 6 })));
  if (lie.casing) answer.visits.forEach(([before, after], visit) => lie.casing[visit] && paintOver(scene, before, after));
}

/** The strand that passes over where a border ends and another one starts, with a gap in the one below. */
function paintOver(scene, before, after) {
  const { borders } = scene.answer;
  const piece = [...ending(scene, borders[before], 9), ...ending(scene, borders[after].toReversed(), 9).toReversed().slice(1)];
  line(scene, piece, { colour: scene.theme.paper, width: 8, cap: "butt" });
  line(scene, piece, { colour: scene.theme.ink });
}

/** The last pixels of a polyline. */
function ending({ camera }, points, pixels) {
  const reach = pixels / camera.scale;
  const end = points.at(-1);
  let i = points.length - 1;
  while (i > 0 && distance(points[i - 1], end) < reach) i -= 1;
  if (i === 0) return points;
  const length = distance(points[i], points[i - 1]);
  const t = Math.min(1, Math.max(0, (reach - distance(points[i], end)) / length));
  const first = [0, 1].map((axis) => points[i][axis] + t * (points[i - 1][axis] - points[i][axis]));
  return [first, ...points.slice(i)];
}

function paintDot({ context, at }, place, radius, colour) {
  context.beginPath();
  context.arc(...at(place), radius, 0, TURN);
  context.fillStyle = colour;
  context.fill();
}

function paintNumber({ context, camera, theme, at }, { winding, label, radius }) {
  const room = radius * camera.scale;
  if (room < 7) return;
  context.font = `600 ${Math.min(17, room * 1.2)}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillStyle = onWinding(theme, winding);
  context.fillText(String(winding).replace("-", "−"), ...at(label));
}

/** The red cross of the paper. */
function paintCross(scene, place) {
  const { context, theme, at } = scene;
  const [x, y] = at(place);
  for (const [width, colour] of [[9, theme.paper], [4.5, theme.wrong]]) {
    context.beginPath();
    for (const side of [-1, 1]) {
      context.moveTo(x - 9 * side, y - 9);
      context.lineTo(x + 9 * side, y + 9);
    }
    Object.assign(context, { lineWidth: width, strokeStyle: colour, lineCap: "round" });
    context.stroke();
  }
}

function paintRing({ context, theme, at }, place, dash = []) {
  context.beginPath();
  context.arc(...at(place), 8, 0, TURN);
  stroke({ context }, { colour: theme.accent, dash });
}

/** A contact, large and filled where the surface touches itself: its shape tells it from crossings and cusps. */
function paintDiamond({ context, at }, place, radius, ground, rim) {
  const [x, y] = at(place);
  context.beginPath();
  [[radius, 0], [0, radius], [-radius, 0], [0, -radius]].forEach(([right, down]) => context.lineTo(x + right, y + down));
  context.closePath();
  context.fillStyle = ground;
  context.fill();
  stroke({ context }, { colour: rim, width: 1.6 });
}

function paintVertices(scene) {
  const { context, document, selected, theme, at } = scene;
  document.strokes.forEach(({ points }, stroke) =>
    points.forEach((point, vertex) => {
      const chosen = selected?.stroke === stroke && selected.vertex === vertex;
      const room = distance(at(point), at(points[vertex ? vertex - 1 : 1] ?? point));
      context.beginPath();
      context.arc(...at(point), chosen ? 7 : room < CROWDED ? 2.5 : 4, 0, TURN);
      context.fillStyle = chosen ? theme.accent : theme.paper;
      context.fill();
      Object.assign(context, { lineWidth: 1.6, strokeStyle: theme.ink });
      context.stroke();
    }));
}

/** A cusp and its index; one that is only offered has a dashed ring. */
function paintCusp({ context, theme, at }, place, index, isOffered = false) {
  const [x, y] = at(place);
  const [ink, ground] = isOffered ? [theme.cusp, theme.paper] : [theme.paper, theme.cusp];
  context.beginPath();
  context.arc(x, y, 10, 0, TURN);
  context.fillStyle = ground;
  context.fill();
  stroke({ context }, { colour: ink, width: 2, dash: isOffered ? [4, 3] : [] });
  Object.assign(context, { font: "700 13px system-ui, sans-serif", textAlign: "center", textBaseline: "middle", fillStyle: ink });
  context.fillText(String(index), x, y + 0.5);
}

function paintPath(scene) {
  const { path, next, theme } = scene;
  if (path.length === 0) return;
  line(scene, path, { colour: theme.accent, width: 3 });
  if (scene.tool !== "points") return;
  if (next) line(scene, [path.at(-1), next], { colour: theme.accent, width: 1.5, dash: [4, 5] });
  path.forEach((point, i) => paintDot(scene, point, i ? 3.5 : 6, theme.accent));
}

function paintCursor({ context, theme, at }, place) {
  const [x, y] = at(place);
  context.beginPath();
  for (const [dx, dy] of [[12, 0], [-12, 0], [0, 12], [0, -12]]) {
    context.moveTo(x + dx / 4, y + dy / 4);
    context.lineTo(x + dx, y + dy);
  }
  Object.assign(context, { lineWidth: 2, strokeStyle: theme.accent });
  context.stroke();
}
