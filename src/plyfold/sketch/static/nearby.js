// The points of paths linked to their neighbours, and a grid of squares that finds the edges near a place: points may
// move and be taken out, and each search still looks at a few edges only.

import { bounds } from "./geometry.js";

// The longer side of everything, in squares.
const SQUARES = 128;
const HALF = 2 ** 25;

/** A path as a ring or chain of links {point, before, after, fixed}; at the ends of a chain there is null. Cusps are fixed. */
export function linked({ points, closed, cusps = {} }) {
  const links = points.map((point, i) => ({ point, before: null, after: null, fixed: i in cusps, squares: null, seen: 0 }));
  links.forEach((link, i) => {
    link.before = links[i - 1] ?? (closed ? links.at(-1) : null);
    link.after = links[i + 1] ?? (closed ? links[0] : null);
  });
  return links;
}

/** A grid over chains of links. Every link stands for the edge to the one after it. */
export function gridOver(chains) {
  const [left, bottom, right, top] = bounds(chains.flatMap((links) => links.map(({ point }) => point))) ?? [0, 0, 0, 0];
  const side = Math.max(right - left, top - bottom) / SQUARES || 1;
  const held = new Map();
  let searches = 0;

  const squaresOf = ([x, y, u, v]) => [x - left, y - bottom, u - left, v - bottom].map((place) => Math.floor(place / side));

  /** Hold the edge from a link on where it is now, too. Where it was before does no harm. */
  function hold(link) {
    if (!link.after) return;
    const now = squaresOf(bounds([link.point, link.after.point]));
    const before = link.squares;
    if (before && within(now, before)) return;
    link.squares = before ? union(now, before) : now;
    for (const square of squares(link.squares)) {
      if (before && has(before, square)) continue;
      const key = keyOf(square);
      const links = held.get(key);
      if (links) links.push(link);
      else held.set(key, [link]);
    }
  }

  /** All edges that may come near a box, as pairs of points, each once. */
  function near(box) {
    searches += 1;
    const found = [];
    for (const square of squares(squaresOf(box))) {
      for (const link of held.get(keyOf(square)) ?? []) {
        if (link.seen === searches || !link.after) continue;
        link.seen = searches;
        found.push([link.point, link.after.point]);
      }
    }
    return found;
  }

  chains.forEach((links) => links.forEach(hold));
  return { hold, near };
}

/** Take a link out of its chain; the edge before it then ends at the one after it. */
export function unlink(link) {
  link.before.after = link.after;
  link.after.before = link.before;
  link.after = null;
}

function* squares([i, j, k, l]) {
  for (let column = i; column <= k; column++) for (let row = j; row <= l; row++) yield [column, row];
}

const keyOf = ([column, row]) => (column + HALF) * 2 * HALF + row + HALF;
const has = ([i, j, k, l], [column, row]) => i <= column && column <= k && j <= row && row <= l;
const within = ([i, j, k, l], box) => has(box, [i, j]) && has(box, [k, l]);
const union = (one, other) => one.map((place, n) => (n < 2 ? Math.min : Math.max)(place, other[n]));
