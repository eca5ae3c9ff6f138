import assert from "node:assert/strict";
import { test } from "node:test";

import { bounds } from "../../../src/plyfold/sketch/static/geometry.js";
import { gridOver, linked, unlink } from "../../../src/plyfold/sketch/static/nearby.js";

function numbers(seed) {
  let state = seed;
  return () => ((state = (state * 48271) % 2147483647) / 2147483647);
}

const overlap = ([a, b, c, d], [e, f, g, h]) => a <= g && e <= c && b <= h && f <= d;

/** Every edge that comes near a box, by looking at all of them. */
function byLooking(chains, box) {
  const edges = chains.flatMap((links) => links.filter(({ after }) => after).map(({ point, after }) => [point, after.point]));
  return edges.filter((edge) => overlap(bounds(edge), box));
}

test("a grid finds every edge near a box once, while points move and are taken out", () => {
  for (let seed = 1; seed <= 30; seed++) {
    const random = numbers(seed);
    const place = () => [1000 * random() - 300, 200 * random()];
    const chains = [true, false].map((closed) => linked({ points: Array.from({ length: 60 }, place), closed }));
    const grid = gridOver(chains);
    for (let step = 0; step < 200; step++) {
      const links = chains[step % 2];
      const link = links[1 + Math.floor(random() * (links.length - 2))];
      if (link.before && link.after) {
        if (random() < 0.3) {
          const { before } = link;
          unlink(link);
          grid.hold(before);
        } else {
          link.point = place();
          grid.hold(link.before);
          grid.hold(link);
        }
      }
      const box = bounds([place(), place()]);
      const found = grid.near(box);
      assert.equal(new Set(found.map(([a, b]) => `${a} ${b}`)).size, found.length);
      const near = found.filter((edge) => overlap(bounds(edge), box));
      assert.deepEqual(near.map(String).sort(), byLooking(chains, box).map(String).sort());
    }
  }
});

test("links know their neighbours", () => {
  const [a, b, c] = linked({ points: [[0, 0], [1, 0], [1, 1]], closed: false });
  assert.deepEqual([a.before, a.after, b.after, c.after], [null, b, c, null]);
  const ring = linked({ points: [[0, 0], [1, 0], [1, 1]], closed: true });
  assert.equal(ring[0].before, ring[2]);
  assert.equal(ring[2].after, ring[0]);
});

test("a grid over nothing and over one place is no trouble", () => {
  assert.deepEqual(gridOver([]).near([0, 0, 1, 1]), []);
  const twice = linked({ points: [[5, 5], [5, 5]], closed: false });
  assert.equal(gridOver([twice]).near([4, 4, 6, 6]).length, 1);
});
