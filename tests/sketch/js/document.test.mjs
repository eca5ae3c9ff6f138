import assert from "node:assert/strict";
import { test } from "node:test";

import * as camera from "../../../src/plyfold/sketch/static/camera.js";
import * as drawing from "../../../src/plyfold/sketch/static/document.js";
import { begin, canRedo, canUndo, record, redo, undo } from "../../../src/plyfold/sketch/static/history.js";
import { asText, checked, decode, encode, hasDrawing } from "../../../src/plyfold/sketch/static/link.js";

const square = drawing.loop([[0, 0], [10, 0], [10, 10], [0, 10]]);
const open = (...points) => ({ points, closed: false });

test("undo and redo walk the documents, and a new one forgets what was undone", () => {
  const history = record(record(begin(1), 2), 3);
  assert.equal(undo(undo(history)).present, 1);
  assert.equal(redo(undo(history)).present, 3);
  const other = record(undo(history), 4);
  assert.ok(!canRedo(other));
  assert.equal(undo(other).present, 2);
  assert.ok(!canUndo(begin(1)));
  assert.equal(undo(begin(1)).present, 1);
  assert.equal(record(history, 3), history);
});

test("edits leave the old document as it was", () => {
  const before = structuredClone(square);
  const at = { stroke: 0, vertex: 1 };
  assert.deepEqual(drawing.movePoint(square, at, [12, 1]).strokes[0].points[1], [12, 1]);
  assert.equal(drawing.insertPoint(square, at, [5, -1]).strokes[0].points.length, 5);
  assert.equal(drawing.deletePoint(square, at).strokes[0].points.length, 3);
  assert.deepEqual(square, before);
});

test("deleting points ends with an open stroke, and then with nothing", () => {
  let document = square;
  for (let i = 0; i < 2; i++) document = drawing.deletePoint(document, { stroke: 0, vertex: 0 });
  assert.equal(document.strokes[0].closed, false);
  for (let i = 0; i < 2; i++) document = drawing.deletePoint(document, { stroke: 0, vertex: 0 });
  assert.ok(drawing.isEmpty(document));
});

test("the nearest vertex and the nearest edge are found within reach only", () => {
  assert.deepEqual(drawing.vertexAt(square, [9, 9], 3), { stroke: 0, vertex: 2 });
  assert.equal(drawing.vertexAt(square, [5, 5], 3), null);
  const { vertex, point } = drawing.edgeAt(square, [-1, 5], 2);
  assert.equal(vertex, 4);
  assert.deepEqual(point, [0, 5]);
});

test("joins are the pairs of ends around the middles that were named", () => {
  const strokes = [open([0, 0], [10, 0]), open([0, 2], [10, 1])];
  const repairs = [{ kind: "gap bridged", where: [10, 0.5] }, { kind: "gap bridged", where: [0, 1] }, { kind: "moved", where: [3, 3] }];
  assert.deepEqual(drawing.joins(strokes, repairs), [[[10, 0], [10, 1]], [[0, 0], [0, 2]]]);
});

test("turning round twice gives the drawing back; closing twice too", () => {
  assert.deepEqual(drawing.reversed(drawing.reversed(square)), square);
  assert.deepEqual(drawing.toggleClosed(drawing.toggleClosed(square)), square);
  assert.deepEqual(drawing.reversed(square).strokes[0].points[0], [0, 0]);
});

test("a link holds the whole drawing", async () => {
  const link = await encode({ ...square, view: { immersion: "1" } });
  assert.ok(hasDrawing(link));
  assert.match(link, /^#d=[\w-]+$/);
  assert.deepEqual(await decode(link), { ...square, view: { immersion: "1" } });
});

test("numbers come back as they were from links and files, at every scale", async () => {
  for (let power = -12; power <= 12; power++) {
    const points = Array.from({ length: 50 }, (_, i) => [Math.sin(9 * i) * 10 ** power, Math.cos(7 * i) * 10 ** power]);
    assert.deepEqual((await decode(await encode(drawing.loop(points)))).strokes[0].points, points);
    assert.deepEqual(checked(JSON.parse(asText(drawing.loop(points)))).strokes[0].points, points);
  }
});

test("rounded drawings have six digits of their size, at every scale", () => {
  for (let power = -12; power <= 12; power++) {
    const size = 3 * 10 ** power;
    const points = Array.from({ length: 50 }, (_, i) => [Math.sin(9 * i) * size, Math.cos(7 * i) * size]);
    const after = drawing.rounded(drawing.loop(points)).strokes[0].points;
    assert.ok(after.every(([x, y], i) => Math.hypot(x - points[i][0], y - points[i][1]) < 1e-5 * size));
    assert.ok(after.flat().every((value) => `${value}`.replace(/e.*/, "").replace(/[-.]/g, "").replace(/^0+|0+$/g, "").length <= 6));
  }
});

test("what is no drawing is refused", async () => {
  await assert.rejects(decode("#d=AAAA"));
  for (const wrong of [null, {}, { plyfold: 3, strokes: [] }, { plyfold: 2, strokes: [{ points: [[0, 0]], cusps: { 1: 1 } }] }, { plyfold: 1, strokes: [{ points: [[0, null]] }] }]) {
    assert.throws(() => checked(wrong), /no drawing/);
  }
  assert.equal(checked({ plyfold: 1, strokes: [], image: { href: "https://elsewhere/x.png" } }).image, null);
});

test("the camera goes to the screen and back, with y turned over once", () => {
  const view = { scale: 2, x: 100, y: 50 };
  assert.deepEqual(camera.toScreen(view, [10, 10]), [120, 30]);
  assert.deepEqual(camera.toDrawing(view, [120, 30]), [10, 10]);
  const near = camera.zoomed(view, 3, [120, 30]);
  assert.deepEqual(camera.toScreen(near, [10, 10]), [120, 30]);
  const fit = camera.fitted(square.strokes[0].points, 400, 300);
  assert.deepEqual(camera.toScreen(fit, [5, 5]), [200, 150]);
});
