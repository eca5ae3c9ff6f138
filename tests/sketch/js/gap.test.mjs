import assert from "node:assert/strict";
import { test } from "node:test";

import { loop } from "../../../src/plyfold/sketch/static/document.js";
import { chosenGap, doublings, outlineShown } from "../../../src/plyfold/sketch/static/gap.js";

const square = [{ points: [[0, 0], [60, 0], [60, 60], [0, 60]] }];
const hole = { points: [[15, 15], [15, 45], [45, 45], [45, 15]] };

test("the gap that is chosen is a twentieth of the larger side, or a fifth of the mean width", () => {
  assert.equal(chosenGap(square), 3);
  const strip = [[0, 0], [100, 0], [100, 1], [0, 1]];
  assert.equal(chosenGap([{ points: strip }]), 40 / 202);
  assert.equal(chosenGap([{ points: strip.toReversed() }]), 40 / 202);
  assert.equal(chosenGap([{ points: [[0, 0], [9, 0]] }]), 9 / 20);
  assert.equal(chosenGap([]), null);
});

test("holes make cloth narrow", () => {
  const bars = [1, 3, 5, 7].map((x) => ({ points: [[7.5 * x - 5, 1], [7.5 * x - 5, 59], [7.5 * x + 5, 59], [7.5 * x + 5, 1]] }));
  const left = 3600 - 4 * 580;
  assert.ok(Math.abs(chosenGap([...square, ...bars]) - Math.min(3, (0.4 * left) / (240 + 4 * 136))) < 1e-12);
  assert.equal(chosenGap([...square, hole]), 3);
});

test("the outline is that of the answer, and the strokes before there is one", () => {
  const { strokes } = loop(square[0].points);
  const history = { present: { strokes } };
  const state = { preview: null, history, answered: null, answer: null };
  assert.equal(outlineShown(state), strokes);
  assert.equal(outlineShown({ ...state, answered: { strokes }, answer: { loops: square } }), square);
});

test("a gap is told in doublings of the chosen one", () => {
  assert.equal(doublings(12, chosenGap(square)), 2);
  assert.equal(doublings(1.5, chosenGap(square)), -1);
  assert.equal(doublings(null, 3), 0);
  assert.equal(doublings(5, null), 0);
});
