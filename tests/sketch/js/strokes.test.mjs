import assert from "node:assert/strict";
import { test } from "node:test";

import { crossingCode, mayStraighten } from "../../../src/plyfold/sketch/static/crossings.js";
import { distanceToSegment, edges } from "../../../src/plyfold/sketch/static/geometry.js";
import { divided, penStroke, thinned, tidied } from "../../../src/plyfold/sketch/static/strokes.js";

const curve = (n, place) => ({ closed: true, points: Array.from({ length: n }, (_, i) => place((2 * Math.PI * i) / n)) });
const eight = curve(120, (t) => [100 * Math.sin(t), 60 * Math.sin(2 * t + 0.01)]);

function numbers(seed) {
  let state = seed;
  return () => ((state = (state * 48271) % 2147483647) / 2147483647);
}

function scribble(seed, closed) {
  const random = numbers(seed);
  const waves = Array.from({ length: 5 }, (_, i) => [random() - 0.5, random() - 0.5, 6 * random(), i + 1]);
  const along = (t) => waves.reduce(([x, y], [a, b, shift, k]) => [x + (a * 100 * Math.cos(k * t + shift)) / k ** 0.5, y + (b * 100 * Math.sin(k * t)) / k ** 0.5], [0, 0]);
  const jitter = () => 1.5 * (random() - 0.5);
  const path = curve(260, (t) => { const [x, y] = along(t); return [x + jitter(), y + jitter()]; });
  return { points: path.points, closed };
}

test("a figure eight has one crossing, met twice from different sides", () => {
  assert.match(crossingCode([eight]), /^1\+1-$|^1-1\+$/);
});

test("the code does not depend on the first point, and changes with the direction", () => {
  const turned = { closed: true, points: [...eight.points.slice(50), ...eight.points.slice(0, 50)] };
  assert.equal(crossingCode([turned]), crossingCode([eight]));
  const limacon = curve(90, (t) => [(1 + 2 * Math.cos(t)) * Math.cos(t), (1 + 2 * Math.cos(t)) * Math.sin(t)]);
  assert.equal(crossingCode([limacon]).length, 4);
});

test("a corner is not straightened across a point, an edge that only cuts the corner, or an edge along it", () => {
  const [a, b, c] = [[0, 0], [1, 1], [2, 0]];
  const blocked = (...points) => !mayStraighten(a, b, c, [[a, b], [b, c], points]);
  assert.ok(blocked([1, 0.5], [1, -3]));
  assert.ok(blocked([0, 0.6], [2, 0.7]));
  assert.ok(blocked([1, 0], [1, 3]));
  assert.ok(!blocked([1.1, 3], [1.1, -3]));
  assert.ok(!blocked([5, 3], [5, -3]));
});

test("two strands that cross each other inside the corner keep it bent", () => {
  const [a, b, c] = [[0, 0], [1, 1], [2, 0]];
  const strands = [[[0.8, 3], [1.3, -3]], [[1.3, 3], [0.8, -2]]];
  assert.ok(mayStraighten(a, b, c, strands.slice(0, 1)));
  const meeting = [[[0.7, 1], [1.3, -0.4]], [[1.3, 1], [0.7, -0.4]]];
  assert.ok(!mayStraighten(a, b, c, meeting));
});

test("a simplified scribble has the same crossings, far fewer points, and stays near", () => {
  for (let seed = 1; seed <= 40; seed++) {
    for (const closed of [true, false]) {
      const path = scribble(seed, closed);
      const simple = tidied(path, 1.2, [], 0);
      assert.equal(crossingCode([simple]), crossingCode([path]), `seed ${seed}`);
      assert.ok(simple.points.length < 0.7 * path.points.length);
      const far = path.points.map((p) => Math.min(...edges(simple).map(([a, b]) => distanceToSegment(p, a, b))));
      assert.ok(Math.max(...far) <= 1.2 + 1e-9);
    }
  }
});

test("smoothing keeps the crossings too, also with the strokes that were there before", () => {
  for (let seed = 1; seed <= 20; seed++) {
    const path = scribble(seed, false);
    const other = scribble(seed + 100, true);
    assert.equal(crossingCode([tidied(path, 0.8, [other]), other]), crossingCode([path, other]), `seed ${seed}`);
  }
});

test("the ends of an open stroke stay, and so does a triangle", () => {
  const path = scribble(7, false);
  const tidy = tidied(path, 5);
  assert.equal(tidy.points[0], path.points[0]);
  assert.equal(tidy.points.at(-1), path.points.at(-1));
  assert.equal(tidied({ points: [[0, 0], [1, 0], [0, 1]], closed: true }, 9).points.length, 3);
});

test("thinned points are apart, and the pen ends where it was lifted", () => {
  const points = Array.from({ length: 50 }, (_, i) => [0.7 * i, 0]);
  const kept = thinned(points, 3);
  assert.equal(kept.at(-1), points.at(-1));
  assert.ok(kept.slice(1, -1).every((point, i) => point[0] - kept[i][0] >= 3));
});

test("a divided path goes the same way", () => {
  const { points } = divided({ points: [[0, 0], [10, 0], [10, 4]], closed: false }, 3);
  assert.deepEqual(points, [[0, 0], [2.5, 0], [5, 0], [7.5, 0], [10, 0], [10, 2], [10, 4]]);
  assert.equal(divided({ points: [[0, 0], [4, 0], [4, 4]], closed: true }, 2).points.length, 7);
});

/** The sharpest turn of a closed path, in degrees. */
function sharpestTurn({ points }) {
  const directions = points.map(([x, y], i) => { const [u, v] = points[(i + 1) % points.length]; return Math.atan2(v - y, u - x); });
  return Math.max(...directions.map((angle, i) => Math.abs(Math.atan2(Math.sin(angle - directions.at(i - 1)), Math.cos(angle - directions.at(i - 1)))))) * 180 / Math.PI;
}

test("what a quick pen left as a few points becomes round, with the same crossings", () => {
  const few = curve(24, (t) => [200 * Math.sin(t), 120 * Math.sin(2 * t + 0.01)]);
  const drawn = penStroke([...few.points, few.points[0]], 1);
  assert.ok(sharpestTurn(few) > 40);
  assert.ok(sharpestTurn(drawn) < 20);
  assert.equal(crossingCode([drawn]), crossingCode([few]));
});
