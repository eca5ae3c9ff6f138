// Dragging a point of a stroke: where the stroke is smooth, the piece around the point comes along, so that it stays so.

import { changeStroke } from "./document.js";
import { add, distance, minus, orientation, scaled } from "./geometry.js";

/** The document with a point moved to a place, and the points around it less the farther they are, up to `radius`. */
export function dragPoint(document, { stroke, vertex }, place, radius) {
  return changeStroke(document, stroke, (old) => {
    const way = minus(place, old.points[vertex]);
    const share = shares(old, vertex, radius);
    return { ...old, points: old.points.map((point, i) => (i === vertex ? place : share.has(i) ? add(point, scaled(way, share.get(i))) : point)) };
  });
}

/** How much of the way each point around a vertex goes along: those before the next corner or end on either side. */
function shares({ points, closed }, vertex, radius) {
  const share = new Map();
  for (const side of [1, -1]) {
    let far = 0;
    for (let step = 1; step < points.length; step++) {
      const [before, i, after] = [step - 1, step, step + 1].map((steps) => index(vertex + side * steps, points.length, closed));
      if (i === null || after === null || isCorner(points[before], points[i], points[after])) break;
      far += distance(points[before], points[i]);
      if (far >= radius) break;
      share.set(i, Math.max(share.get(i) ?? 0, (1 - (far / radius) ** 2) ** 2));
    }
  }
  return share;
}

const index = (i, count, closed) => (closed ? (i + count) % count : i >= 0 && i < count ? i : null);

/** Whether the way turns by more than an eighth of a full turn. */
function isCorner(a, b, c) {
  const ahead = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
  return Math.abs(orientation(a, b, c)) > ahead;
}
