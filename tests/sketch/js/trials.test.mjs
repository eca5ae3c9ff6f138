import assert from "node:assert/strict";
import { test } from "node:test";

import { loop } from "../../../src/plyfold/sketch/static/document.js";
import { begin, record } from "../../../src/plyfold/sketch/static/history.js";
import { START, lineOf, offerOf, offersShown, ribbonShown } from "../../../src/plyfold/sketch/static/store.js";
import { offeredDocument, trialOf, withRibbons } from "../../../src/plyfold/sketch/static/trials.js";

const drawing = loop([[0, 0], [4, 0], [0, 3]]);
const lesser = [{ points: [[0, 0], [1, 0], [0, 1]], cusps: {} }];
const NONE = { where: [], areas: [], cusps: [], loops: null };
const offers = [
  { ...NONE, kind: "repair", loops: lesser, areas: [[[1, 1], [2, 1], [1, 2]]] },
  { ...NONE, kind: "cusps", cusps: [{ where: [4, 0.001], index: 2 }] },
  { ...NONE, kind: "pieces", loops: [...lesser, ...lesser] },
];
const no = { reversed: false, verdict: { immersible: false } };
const state = { ...START, history: begin(drawing), answer: no, answered: drawing, offers };

test("offers are about the drawing that is seen, and only where there is no surface", () => {
  assert.equal(offersShown(state).length, 3);
  assert.equal(offerOf(state, "cusps"), offers[1]);
  assert.deepEqual(offersShown({ ...state, answered: null }), []);
  assert.deepEqual(offersShown({ ...state, answer: { verdict: { immersible: true } } }), []);
  assert.equal(offerOf({ ...state, offers: null }, "repair"), null);
});

test("an offer that is taken takes the drawing's place, in the direction in which it was drawn", () => {
  const [repair, cusps, pieces] = offers;
  assert.deepEqual(offeredDocument(state, repair).strokes, [{ points: lesser[0].points, closed: true }].map((stroke) => ({ ...stroke, cusps: {} })));
  const clockwise = { ...state, answer: { ...no, reversed: true } };
  assert.deepEqual(offeredDocument(clockwise, repair).strokes[0].points, [[0, 0], [0, 1], [1, 0]]);
  assert.deepEqual(offeredDocument(clockwise, pieces).strokes[1].points, lesser[0].points);
  assert.deepEqual(offeredDocument(state, cusps).strokes[0].cusps, { 1: 2 });
});

test("what is pointed at is shown, and nothing else", () => {
  assert.equal(trialOf(state), null);
  const shown = trialOf({ ...state, previewed: "repair" });
  assert.deepEqual(shown.areas, offers[0].areas);
  assert.equal(shown.strokes.length, 1);
  assert.equal(trialOf({ ...state, previewed: "ribbon" }), null);
});

const line = { ...drawing, strokes: [...drawing.strokes, { points: [[9, 0], [9, 9]], closed: false }] };
const unfinished = { ...START, history: begin(line), answer: { error: { kind: "unfinished" } }, answered: line };

test("open strokes become ribbons, and loops stay", () => {
  assert.equal(lineOf(unfinished), line);
  const { strokes } = withRibbons(line, lesser);
  assert.equal(strokes[0], line.strokes[0]);
  assert.deepEqual(strokes[1].points, lesser[0].points);
  assert.ok(strokes[1].closed);
  const known = { ...unfinished, previewed: "ribbon", ribbon: { line, made: null, loops: lesser } };
  assert.deepEqual(trialOf(known).strokes, strokes);
});

test("a ribbon that was made remembers its line until something else is drawn", () => {
  const made = withRibbons(line, lesser);
  const after = { ...unfinished, history: record(unfinished.history, made), ribbon: { line, made, loops: lesser } };
  assert.equal(lineOf(after), line);
  assert.equal(ribbonShown(after), after.ribbon);
  assert.equal(trialOf({ ...after, previewed: "ribbon" }), null);
  assert.equal(lineOf({ ...after, history: record(after.history, drawing), answered: drawing, answer: no }), null);
});
