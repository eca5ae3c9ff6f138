// What must not change while a drawing is smoothed or its points are moved: which strands cross which, in what order.

import { bounds, cross, distance, edges, meetingPlace, orientation } from "./geometry.js";

/**
 * Whether the way a–b–c may be exchanged for the straight line a–c so that no crossing with any of `edges`, pairs of
 * points, is made or lost, and none changes its place in the order along any strand. Edges that end at b are the way
 * itself. In doubt, where something touches, the answer is no.
 */
export function mayStraighten(a, b, c, edges) {
  const turn = orientation(a, b, c);
  if (turn === 0) return between(a, b, c);
  const corner = { a, b, c, turn, box: bounds([a, b, c]) };
  const passages = [];
  for (const [p, q] of edges) {
    if (p === b || q === b || apart(p, q, corner.box)) continue;
    const passage = passageThrough(p, q, corner);
    if (passage === BLOCKED) return false;
    if (passage) passages.push(passage);
  }
  return inSameOrder(passages);
}

const BLOCKED = "blocked";
const between = (a, b, c) => distance(a, b) + distance(b, c) <= distance(a, c) * (1 + 1e-12);

function apart(p, q, [left, bottom, right, top]) {
  return (p[0] < left && q[0] < left) || (p[0] > right && q[0] > right)
    || (p[1] < bottom && q[1] < bottom) || (p[1] > top && q[1] > top);
}

/** An edge may pass by, or go in across a–b–c and out across a–c (returned with both places). */
function passageThrough(p, q, { a, b, c, turn }) {
  for (const [here, from, to] of [[a, b, c], [c, a, b]]) {
    if (p === here || q === here) return inWedge(p === here ? q : p, here, from, to, turn) ? BLOCKED : null;
  }
  if (touches(p, q, a, b, c)) return BLOCKED;
  const first = cross(a, b, p, q);
  const second = cross(b, c, p, q);
  const straight = cross(a, c, p, q);
  if (!first && !second && !straight) return inTriangle(p, a, b, c, turn) ? BLOCKED : null;
  if (first === second || !straight) return BLOCKED;
  const bent = first ? meetingPlace(a, b, p, q) : 1 + meetingPlace(b, c, p, q);
  return { bent, straight: meetingPlace(a, c, p, q) };
}

const inWedge = (point, at, from, to, turn) => orientation(at, from, point) * turn >= 0 && orientation(at, point, to) * turn >= 0;

function inTriangle(point, a, b, c, turn) {
  return [[a, b], [b, c], [c, a]].every(([from, to]) => orientation(from, to, point) * turn >= 0);
}

/** Whether a corner lies on the line p–q, or an end of the edge on a line of the triangle, near each other. */
function touches(p, q, a, b, c) {
  return [a, b, c].some((corner) => orientation(p, q, corner) === 0)
    || [[a, b], [b, c], [a, c]].some(([from, to]) => orientation(from, to, p) === 0 || orientation(from, to, q) === 0);
}

function inSameOrder(passages) {
  passages.sort((one, other) => one.bent - other.bent);
  return passages.every((passage, i) => i === 0 || passages[i - 1].straight < passage.straight);
}

// ---- the whole code ----------------------------------------------------------------------------------------------

/**
 * The crossing code of some paths: for each path, the crossings in order along it, numbered as they come, each with
 * the side from which the other strand comes. A single closed path has no first point: all starts give the same code.
 */
export function crossingCode(paths) {
  const visits = paths.map(() => []);
  const all = paths.flatMap((path, number) => edges(path).map(([a, b], index) => ({ a, b, number, index })));
  let found = 0;
  for (let i = 0; i < all.length; i++) {
    for (let j = i + 1; j < all.length; j++) {
      if (cross(all[i].a, all[i].b, all[j].a, all[j].b)) visit(visits, all[i], all[j], found++);
    }
  }
  for (const along of visits) along.sort((one, other) => one.place - other.place);
  if (paths.length !== 1 || !paths[0].closed) return write(visits);
  return visits[0].map((_, start) => write([[...visits[0].slice(start), ...visits[0].slice(0, start)]])).sort()[0] ?? "";
}

function visit(visits, one, other, crossing) {
  const side = orientation(one.a, one.b, other.b) > 0 ? 1 : -1;
  for (const [edge, across, sign] of [[one, other, side], [other, one, -side]]) {
    const place = edge.index + meetingPlace(edge.a, edge.b, across.a, across.b);
    visits[edge.number].push({ place, crossing, sign });
  }
}

function write(visits) {
  const names = new Map();
  const name = (crossing) => names.get(crossing) ?? names.set(crossing, names.size + 1).get(crossing);
  return visits.map((along) => along.map(({ crossing, sign }) => `${name(crossing)}${sign > 0 ? "+" : "-"}`).join("")).join("|");
}
