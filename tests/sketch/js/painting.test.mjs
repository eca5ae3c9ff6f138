import assert from "node:assert/strict";
import { test } from "node:test";

import { toDrawing, toScreen } from "../../../src/plyfold/sketch/static/camera.js";
import { onWinding, sheetColour, windingColour } from "../../../src/plyfold/sketch/static/colours.js";
import { gridStep, paint, snapped } from "../../../src/plyfold/sketch/static/painting.js";

/** A canvas that writes down what it is told. */
function recorder() {
  const calls = [];
  const target = {};
  const record = (name) => (...values) => calls.push([name, ...values]);
  return [new Proxy(target, { get: (own, name) => own[name] ?? record(name) }), calls];
}

const THEME = {
  ink: "ink", paper: "paper", dot: "dot", accent: "accent", wrong: "wrong", cusp: "cusp", touch: "touch", lit: "lit", good: "good",
  winding: ["one", "two"], negative: ["minus one"], "on-winding": ["dark", "pale"], "on-negative": ["dark"], sheets: ["first", "second"],
};
const CAMERA = { scale: 2, x: 100, y: 100 };
const BLANK = {
  size: { width: 200, height: 200 }, camera: CAMERA, theme: THEME, document: { strokes: [], image: null }, joins: [], openEnds: [],
  answer: null, offered: [], trial: null, touches: [], lie: null, tool: "draw", path: [], next: null, selected: null, cursor: null, hover: null, snap: false, image: null,
};

const ANSWER = { crossings: [], cells: [], contacts: [], repairs: [], verdict: { where: [] } };

test("the grid has lines of round numbers, far enough apart", () => {
  for (const scale of [1e-6, 0.03, 1, 2, 77, 1e6]) {
    const step = gridStep({ scale });
    assert.ok(step * scale >= 22 && step * scale <= 56);
    assert.match(step.toExponential(3), /^[125]\.000e/);
    assert.deepEqual(snapped({ scale }, [2.2 * step, -0.8 * step]).map((value) => Math.round(value / step)), [2, -1]);
  }
});

test("y is up in the drawing and down on the screen", () => {
  assert.deepEqual(toScreen(CAMERA, [10, 20]), [120, 60]);
  assert.deepEqual(toDrawing(CAMERA, [120, 60]), [10, 20]);
});

test("every stroke, cell, number and cross is painted in its place", () => {
  const [context, calls] = recorder();
  const strokes = [{ points: [[0, 0], [40, 0], [40, 40]], closed: true }];
  const cell = { cell: 1, winding: -1, outline: strokes[0].points, holes: [], label: [30, 10], radius: 10 };
  const verdict = { where: [[20, 20]] };
  paint(context, { ...BLANK, document: { strokes, image: null }, answer: { ...ANSWER, cells: [cell], verdict } });
  assert.ok(calls.some(([name, ...values]) => name === "moveTo" && `${values}` === `${toScreen(CAMERA, [0, 0])}`));
  assert.deepEqual(calls.find(([name]) => name === "fillText"), ["fillText", "−1", 160, 80]);
  const [x, y] = toScreen(CAMERA, [20, 20]);
  assert.ok(calls.some(([name, ...values]) => name === "moveTo" && `${values}` === `${[x - 9, y - 9]}`));
});

test("the last shade stands for all beyond it, and sheets' colours come round again", () => {
  assert.deepEqual([-3, -1, 0, 1, 2, 9].map((winding) => windingColour(THEME, winding)), ["minus one", "minus one", null, "one", "two", "two"]);
  assert.deepEqual([-3, 0, 1, 9].map((winding) => onWinding(THEME, winding)), ["dark", "ink", "dark", "pale"]);
  assert.deepEqual([0, 1, 2].map((sheet) => sheetColour(THEME, sheet)), ["first", "second", "first"]);
});

test("contacts are diamonds, large and filled where the surface touches itself, and spikes have a dashed ring", () => {
  const [context, calls] = recorder();
  const answer = { ...ANSWER, contacts: [[0, 0], [9, 9]], repairs: [{ kind: "spike taken out", where: [5, 5] }] };
  paint(context, { ...BLANK, answer, touches: [[9, 9]] });
  const corners = (place, radius) => {
    const [x, y] = toScreen(CAMERA, place);
    return [[x + radius, y], [x, y + radius], [x - radius, y], [x, y - radius]].map(String);
  };
  const lines = calls.filter(([name]) => name === "lineTo").map(([, ...values]) => String(values));
  assert.deepEqual(lines, [...corners([0, 0], 4.5), ...corners([9, 9], 4.5), ...corners([9, 9], 8)]);
  assert.deepEqual(calls.find(([name]) => name === "arc").slice(1, 3), toScreen(CAMERA, [5, 5]));
  assert.ok(calls.some(([name, dash]) => name === "setLineDash" && dash.length));
});

test("what an offer would make is painted over the drawing, which fades, with the places that it changes", () => {
  const [context, calls] = recorder();
  const strokes = [{ points: [[0, 0], [40, 0], [40, 40]], closed: true }];
  const trial = { areas: [[[5, 5], [6, 5], [6, 6]]], strokes: [{ points: [[7, 7], [8, 7], [8, 8]], closed: true }] };
  paint(context, { ...BLANK, document: { strokes, image: null }, trial });
  const begins = calls.filter(([name]) => name === "moveTo").map(([, ...values]) => String(values));
  for (const place of [[0, 0], [5, 5], [7, 7]]) assert.ok(begins.includes(String(toScreen(CAMERA, place))));
  assert.equal(calls.filter(([name]) => name === "fill").length, 2); // the place, and the arrow of the drawing
});

test("vertices that are near each other are smaller", () => {
  const radii = (step) => {
    const [context, calls] = recorder();
    const points = [0, 1, 2, 3].map((i) => [i * step, 0]);
    paint(context, { ...BLANK, tool: "edit", document: { strokes: [{ points, closed: false }], image: null } });
    return calls.filter(([name]) => name === "arc").map(([, , , radius]) => radius);
  };
  const [near, far] = [radii(2), radii(20)];
  assert.equal(near.length, 4);
  assert.ok(near.every((radius, i) => radius < far[i]));
});

test("cusps are marked with their index, and offered ones too", () => {
  const [context, calls] = recorder();
  const strokes = [{ points: [[0, 0], [40, 0], [40, 40]], closed: true, cusps: { 1: 2 } }];
  paint(context, { ...BLANK, document: { strokes, image: null }, offered: [{ where: [40, 40], index: 1 }] });
  const [offered, marked] = calls.filter(([name]) => name === "fillText");
  assert.deepEqual(offered, ["fillText", "1", 180, 20.5]);
  assert.deepEqual(marked, ["fillText", "2", 180, 100.5]);
  assert.ok(calls.some(([name, dash]) => name === "setLineDash" && dash.length === 2));
});

test("what other loops take away from a cell is not painted", () => {
  const [context, calls] = recorder();
  const square = (size) => [[-size, -size], [size, -size], [size, size], [-size, size]];
  const cell = { cell: 1, winding: 1, outline: square(40), holes: [square(10).reverse()], label: [25, 0], radius: 15 };
  paint(context, { ...BLANK, answer: { ...ANSWER, cells: [cell] } });
  assert.deepEqual(calls.find(([name]) => name === "fill"), ["fill", "evenodd"]);
  assert.equal(calls.filter(([name]) => name === "closePath").length, 2);
});
