/** What is left of strokes after a round eraser has gone over them. */

import { withPoints } from "./cusps.js";
import { minus, mix } from "./geometry.js";

/** The part of an edge, from share to share of it, that lies in a circle; null if there is none. */
function inside(start, end, centre, radius) {
  const [dx, dy] = minus(end, start);
  const [px, py] = minus(start, centre);
  const [a, b, c] = [dx * dx + dy * dy, px * dx + py * dy, px * px + py * py - radius * radius];
  const root = Math.sqrt(b * b - a * c);
  if (!a || Number.isNaN(root)) return null;
  const [from, to] = [Math.max(0, (-b - root) / a), Math.min(1, (-b + root) / a)];
  return from < to ? [from, to] : null;
}

function piecesOf({ points, closed }, centre, radius) {
  const path = closed ? [...points, points[0]] : points;
  const pieces = [[path[0]]];
  for (let i = 1; i < path.length; i++) {
    const gone = inside(path[i - 1], path[i], centre, radius);
    if (gone) {
      if (gone[0] > 0) pieces.at(-1).push(mix(path[i - 1], path[i], gone[0]));
      pieces.push(gone[1] < 1 ? [mix(path[i - 1], path[i], gone[1])] : []);
      if (gone[1] === 1) continue;
    }
    pieces.at(-1).push(path[i]);
  }
  return pieces;
}

function erasedStroke(stroke, centre, radius) {
  const pieces = piecesOf(stroke, centre, radius);
  if (pieces.length === 1) return [stroke];
  // The first and the last piece of a loop are one, unless the eraser was at its first point.
  if (stroke.closed && pieces.at(-1).length) pieces[0] = [...pieces.pop(), ...pieces[0].slice(1)];
  return pieces.filter((points) => points.length > 1).map((points) => withPoints(stroke, points, false));
}

/** The strokes without what lies within `radius` of a point. */
export function erased(strokes, centre, radius) {
  const left = strokes.map((stroke) => erasedStroke(stroke, centre, radius));
  return left.every((pieces, i) => pieces[0] === strokes[i]) ? strokes : left.flat();
}
