import assert from "node:assert/strict";
import { test } from "node:test";

import { cuspsOf, indexAt, nextIndex, withPoints } from "../../../src/plyfold/sketch/static/cusps.js";
import * as drawing from "../../../src/plyfold/sketch/static/document.js";
import { dragPoint } from "../../../src/plyfold/sketch/static/dragging.js";
import { erased } from "../../../src/plyfold/sketch/static/erasing.js";
import { asText, checked, decode, encode } from "../../../src/plyfold/sketch/static/link.js";
import { tidied } from "../../../src/plyfold/sketch/static/strokes.js";

const pentagon = drawing.loop([[0, 0], [10, 0], [12, 8], [5, 14], [-2, 8]]);
const marked = drawing.markCusp(drawing.markCusp(pentagon, { stroke: 0, vertex: 3 }, 2), { stroke: 0, vertex: 1 }, 1);
const places = (document) => Object.fromEntries(drawing.allCusps(document).map(({ place, index }) => [place, index]));
const MARKED = { "10,0": 1, "5,14": 2 };

test("the mark at a point is set, read and taken away, and the old document stays", () => {
  assert.deepEqual(marked.strokes[0].cusps, { 1: 1, 3: 2 });
  assert.equal(indexAt(marked.strokes[0], 3), 2);
  assert.equal(indexAt(pentagon.strokes[0], 3), 0);
  const none = [1, 3].reduce((document, vertex) => drawing.markCusp(document, { stroke: 0, vertex }, 0), marked);
  assert.deepEqual(none, pentagon);
  assert.ok(!("cusps" in pentagon.strokes[0]));
});

test("clicks count to three and then take the mark away", () => {
  assert.deepEqual([0, 1, 2, 3].map(nextIndex), [1, 2, 3, 0]);
});

test("cusps stay with their points through every change", () => {
  assert.deepEqual(places(drawing.insertPoint(marked, { stroke: 0, vertex: 1 }, [5, -1])), MARKED);
  assert.deepEqual(places(drawing.deletePoint(marked, { stroke: 0, vertex: 0 })), MARKED);
  assert.deepEqual(places(drawing.deletePoint(marked, { stroke: 0, vertex: 1 })), { "5,14": 2 });
  assert.deepEqual(places(drawing.reversed(marked)), MARKED);
  assert.deepEqual(places(drawing.withTurned(marked, [0])), MARKED);
  assert.deepEqual(drawing.reversed(drawing.reversed(marked)), marked);
  assert.deepEqual(places(drawing.toggleClosed(marked)), MARKED);
  assert.deepEqual(places(drawing.movePoint(marked, { stroke: 0, vertex: 1 }, [11, -1])), { "11,-1": 1, "5,14": 2 });
  assert.deepEqual(places(dragPoint(marked, { stroke: 0, vertex: 1 }, [11, -1], 5)), { "11,-1": 1, "5,14": 2 });
});

test("what is rubbed out takes its cusps along, and no others", () => {
  const strokes = erased(marked.strokes, [10, 0], 1);
  assert.deepEqual(places({ strokes }), { "5,14": 2 });
  assert.ok(strokes.every(({ closed }) => !closed));
});

test("smoothing leaves cusps where they are", () => {
  const points = Array.from({ length: 80 }, (_, i) => [100 * Math.cos(i * Math.PI / 40), 100 * Math.sin(i * Math.PI / 40)]);
  const stroke = { ...drawing.loop(points).strokes[0], cusps: { 17: 1 } };
  const after = tidied(stroke, 3);
  assert.ok(after.points.length < 40);
  assert.deepEqual(cuspsOf(after).map(({ vertex, index }) => [after.points[vertex], index]), [[points[17], 1]]);
});

test("other points in place of a stroke's keep the cusps that are among them", () => {
  const [stroke] = marked.strokes;
  assert.deepEqual(withPoints(stroke, stroke.points.slice(2)).cusps, { 1: 2 });
  assert.ok(!("cusps" in withPoints(stroke, [[10, 0], [5, 14], [0, 0]])));
});

test("of several loops one is turned round alone", () => {
  const two = drawing.withStrokes(marked, [...marked.strokes, { points: [[2, 2], [4, 2], [3, 4]], closed: true }]);
  const after = drawing.withTurned(two, [1]);
  assert.equal(after.strokes[0], two.strokes[0]);
  assert.deepEqual(after.strokes[1].points, [[2, 2], [3, 4], [4, 2]]);
});

test("links and files hold cusps, and those of version 1 are read", async () => {
  assert.deepEqual(await decode(await encode(marked)), marked);
  assert.deepEqual(checked(JSON.parse(asText(marked))), marked);
  const { strokes, image, view } = pentagon;
  assert.deepEqual(checked({ plyfold: 1, strokes, image, view }), pentagon);
  const link = "#d=" + Buffer.from(new Uint8Array(await new Response(new Blob([JSON.stringify({ plyfold: 1, strokes, image, view })])
    .stream().pipeThrough(new CompressionStream("deflate-raw"))).arrayBuffer())).toString("base64url");
  assert.deepEqual(await decode(link), pentagon);
});

test("cusps that are none are refused", () => {
  for (const cusps of [{ 5: 1 }, { a: 1 }, { 0: 0.5 }, { 0: -1 }, { 0: "1" }]) {
    assert.throws(() => checked({ plyfold: 2, strokes: [{ points: pentagon.strokes[0].points, closed: true, cusps }] }), /no drawing/);
  }
});
