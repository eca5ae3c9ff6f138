// From what the pen did to a stroke worth keeping: thinned, smoothed, simplified, with the crossings it was drawn with.

import { mayStraighten } from "./crossings.js";
import { withPoints } from "./cusps.js";
import { add, bounds, cross, distance, distanceToSegment, meetingPlace, mix, scaled } from "./geometry.js";
import { gridOver, linked, unlink } from "./nearby.js";

const SMOOTHINGS = 3;
// Where a quick pen left few points: this far apart, in pixels, and so many parts and rounds for each edge.
const SPARSE = 8;
const PARTS = 4;
const SPARSE_SMOOTHINGS = 16;

/** Leave out points that are nearer than `spacing` to the one kept before; the last one always stays. */
export function thinned(points, spacing) {
  const kept = points.slice(0, 1);
  for (const point of points.slice(1)) {
    if (distance(point, kept.at(-1)) >= spacing) kept.push(point);
  }
  const end = points.at(-1);
  if (kept.length > 1 && kept.at(-1) !== end) kept.splice(distance(end, kept.at(-1)) < spacing / 2 ? -1 : kept.length, 1, end);
  return kept;
}

/**
 * Move every point towards its neighbours, one after the other, and only where no crossing changes: the new place lies
 * in the triangle of the three, so it is enough that the triangle may be straightened.
 */
function smooth({ links, grid }) {
  for (const link of links) {
    if (!link.before || !link.after || link.fixed) continue;
    const [a, b, c] = [link.before.point, link.point, link.after.point];
    if (!mayStraighten(a, b, c, grid.near(bounds([a, b, c])))) continue;
    link.point = add(scaled(b, 0.5), scaled(add(a, c), 0.25));
    grid.hold(link.before);
    grid.hold(link);
  }
}

/**
 * Take out points one by one, as long as every point taken stays within `tolerance` of the line and no crossing is
 * made, lost or moved past another (with the path itself, or with obstacles).
 */
function simplify({ links, grid }, tolerance) {
  const passed = new Map(links.map((link) => [link, []])); // the points left out after each link
  let kept = links;
  let before;
  do {
    before = kept.length;
    let left = before;
    let justRemoved = false;
    for (const link of kept) {
      justRemoved = !justRemoved && left > 3 && removeIfFree(link, tolerance, grid, passed);
      if (justRemoved) left -= 1;
    }
    kept = kept.filter((link) => passed.has(link));
  } while (kept.length < before);
  return kept;
}

function removeIfFree(link, tolerance, grid, passed) {
  const { before, after } = link;
  if (!before || !after || link.fixed) return false;
  const out = [...passed.get(before), link.point, ...passed.get(link)];
  if (out.some((point) => distanceToSegment(point, before.point, after.point) > tolerance)) return false;
  const corner = [before.point, link.point, after.point];
  if (!mayStraighten(...corner, grid.near(bounds(corner)))) return false;
  unlink(link);
  passed.set(before, out).delete(link);
  grid.hold(before);
  return true;
}

/** Smooth and simplify, with the crossings of the path as it is, also with `obstacles`, other paths. */
export function tidied(path, tolerance, obstacles = [], rounds = SMOOTHINGS) {
  const links = linked(path);
  const work = { links, grid: gridOver([links, ...obstacles.map(linked)]) };
  for (let round = 0; round < rounds; round++) smooth(work);
  return withPoints(path, simplify(work, tolerance).map(({ point }) => point));
}

/** What the pen did, as a stroke: `pixel` is the size of one. Where its end comes back to its beginning it is closed. */
export function penStroke(raw, pixel, obstacles = []) {
  const points = thinned(raw, 1.5 * pixel);
  const loop = closedLoop(points, 22 * pixel);
  const path = { points: loop ?? points, closed: loop !== null };
  const spacing = middleSpacing(path.points);
  if (spacing <= SPARSE * pixel) return tidied(path, 0.5 * pixel, obstacles);
  return tidied(divided(path, spacing / PARTS), 0.5 * pixel, obstacles, SPARSE_SMOOTHINGS);
}

/** The distance from point to point that half of the distances do not exceed. */
function middleSpacing(points) {
  const spacings = points.slice(1).map((point, i) => distance(points[i], point)).sort((a, b) => a - b);
  return spacings[spacings.length >> 1] ?? 0;
}

/** The same path with points on its edges, at least as dense as `spacing`. */
export function divided({ points, closed }, spacing) {
  const next = (i) => points[(i + 1) % points.length];
  const edges = points.slice(0, closed ? points.length : -1);
  const dense = edges.flatMap((point, i) => {
    const parts = Math.ceil(distance(point, next(i)) / spacing) || 1;
    return Array.from({ length: parts }, (_, part) => mix(point, next(i), part / parts));
  });
  return { points: closed ? dense : [...dense, points.at(-1)], closed };
}

/** The stroke as a loop if its ends are near, or null. Ends that shoot past each other are cut at their crossing. */
export function closedLoop(points, near) {
  const length = points.slice(1).reduce((sum, point, i) => sum + distance(points[i], point), 0);
  if (points.length < 4 || length < 3 * near || distance(points[0], points.at(-1)) > near) return null;
  return cutAtCrossing(points, near) ?? cutBeside(points, near);
}

function cutAtCrossing(points, near) {
  const head = points.findIndex((point) => distance(point, points[0]) > near);
  const tail = points.findLastIndex((point) => distance(point, points.at(-1)) > near);
  for (let i = head - 1; i >= 0; i--) {
    for (let j = Math.max(tail, i + 2); j < points.length - 1; j++) {
      const edges = [points[i], points[i + 1], points[j], points[j + 1]];
      if (cross(...edges)) return [mix(points[i], points[i + 1], meetingPlace(...edges)), ...points.slice(i + 1, j + 1)];
    }
  }
  return null;
}

/** An end that runs beside the beginning stops where it is nearest to the first point. */
function cutBeside(points, near) {
  const tail = points.findLastIndex((point) => distance(point, points.at(-1)) > near);
  let nearest = points.length - 1;
  for (let j = nearest; j > tail; j--) if (distance(points[j], points[0]) < distance(points[nearest], points[0])) nearest = j;
  return points.slice(0, nearest);
}
