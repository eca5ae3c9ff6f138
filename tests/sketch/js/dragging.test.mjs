import assert from "node:assert/strict";
import { test } from "node:test";

import { loop } from "../../../src/plyfold/sketch/static/document.js";
import { dragPoint } from "../../../src/plyfold/sketch/static/dragging.js";

const circle = loop(Array.from({ length: 60 }, (_, i) => [100 * Math.cos((i * Math.PI) / 30), 100 * Math.sin((i * Math.PI) / 30)]));
const square = loop([[0, 0], [10, 0], [10, 10], [0, 10]]);
const at = (vertex) => ({ stroke: 0, vertex });

/** The largest turn of a closed loop, in degrees. */
function sharpestTurn({ strokes: [{ points }] }) {
  const directions = points.map(([x, y], i) => { const [u, v] = points[(i + 1) % points.length]; return Math.atan2(v - y, u - x); });
  return Math.max(...directions.map((angle, i) => Math.abs(Math.atan2(Math.sin(angle - directions.at(i - 1)), Math.cos(angle - directions.at(i - 1)))))) * 180 / Math.PI;
}

test("a dragged point of a smooth loop takes its neighbours along, and the loop stays smooth", () => {
  const dragged = dragPoint(circle, at(0), [130, 0], 60);
  assert.deepEqual(dragged.strokes[0].points[0], [130, 0]);
  assert.ok(sharpestTurn(dragged) < 30);
  assert.ok(sharpestTurn(dragPoint(circle, at(0), [130, 0], 1)) > 100); // a point alone makes a spike
  const moved = dragged.strokes[0].points.filter((point, i) => point !== circle.strokes[0].points[i]);
  assert.ok(moved.length > 7 && moved.length < 13);
});

test("what is farther along the stroke than the radius stays, however near it comes", () => {
  const there = Array.from({ length: 40 }, (_, i) => [10 * i, 0]);
  const back = Array.from({ length: 40 }, (_, i) => [390 - 10 * i, 5]);
  const hairpin = { ...square, strokes: [{ points: [...there, ...back], closed: false }] };
  const dragged = dragPoint(hairpin, at(20), [200, -30], 55);
  assert.deepEqual(dragged.strokes[0].points.slice(40), back);
});

test("corners, ends and polylines stay as they are", () => {
  assert.deepEqual(dragPoint(square, at(2), [12, 13], 100).strokes[0].points, [[0, 0], [10, 0], [12, 13], [0, 10]]);
  const line = { ...square, strokes: [{ points: Array.from({ length: 9 }, (_, i) => [i, 0]), closed: false }] };
  const { points } = dragPoint(line, at(4), [4, 3], 100).strokes[0];
  assert.deepEqual([points[0], points[8]], [[0, 0], [8, 0]]);
  assert.ok(points[1][1] > 2.9 && points[7][1] > 2.9);
});

test("back where it was, everything is", () => {
  const { points } = circle.strokes[0];
  const there = dragPoint(circle, at(7), points[7], 60).strokes[0].points;
  assert.ok(there.every(([x, y], i) => x === points[i][0] && y === points[i][1]));
});
