import assert from "node:assert/strict";
import { test } from "node:test";

import { area, bounds, cross, distanceToSegment, inside, meetingPlace } from "../../../src/plyfold/sketch/static/geometry.js";

/** Numbers that look random and are the same in every run. */
function* numbers(seed) {
  for (let state = seed; ;) {
    state = (state * 48271) % 2147483647;
    yield state / 2147483647;
  }
}

/** Where two segments meet, by solving both equations. */
function solved([ax, ay], [bx, by], [cx, cy], [dx, dy]) {
  const determinant = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx);
  const s = ((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx)) / determinant;
  const t = ((cx - ax) * (by - ay) - (cy - ay) * (bx - ax)) / determinant;
  return s > 0 && s < 1 && t > 0 && t < 1 ? s : null;
}

test("segments cross where solving the equations says so", () => {
  const source = numbers(3);
  let crossed = 0;
  for (let i = 0; i < 2000; i++) {
    const ends = Array.from({ length: 4 }, () => [source.next().value, source.next().value]);
    const expected = solved(...ends);
    assert.equal(cross(...ends), expected !== null);
    if (expected !== null) assert.ok(Math.abs(meetingPlace(...ends) - expected) < 1e-9);
    crossed += expected !== null;
  }
  assert.ok(crossed > 100 && crossed < 1900);
});

test("segments that only touch do not cross", () => {
  assert.ok(!cross([0, 0], [1, 0], [1, 0], [2, 3]));
  assert.ok(!cross([0, 0], [2, 0], [1, 0], [1, 3]));
});

test("areas, boxes and distances of an L", () => {
  const shape = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [0, 2]];
  assert.equal(area(shape), 4);
  assert.equal(area(shape.toReversed()), -4);
  assert.deepEqual(bounds(shape), [0, 0, 3, 2]);
  assert.equal(bounds([]), null);
  assert.deepEqual([[0.5, 1.5], [2, 0.5], [2, 1.5], [-1, 1]].map((point) => inside(point, shape)), [true, true, false, false]);
  assert.equal(distanceToSegment([2, 2], [0, 0], [3, 0]), 2);
  assert.equal(distanceToSegment([6, 4], [0, 0], [3, 0]), 5);
});
