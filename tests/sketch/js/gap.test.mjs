import assert from "node:assert/strict";
import { test } from "node:test";

import { EMPTY, loop } from "../../../src/plyfold/sketch/static/document.js";
import { chosenGap, doublings } from "../../../src/plyfold/sketch/static/gap.js";

const tall = loop([[0, 0], [4, 0], [4, 60]]);

test("the gap that is chosen is a twentieth of the larger side", () => {
  assert.equal(chosenGap(tall), 3);
  assert.equal(chosenGap(EMPTY), null);
});

test("a gap is told in doublings of the chosen one", () => {
  assert.equal(doublings(12, chosenGap(tall)), 2);
  assert.equal(doublings(1.5, chosenGap(tall)), -1);
  assert.equal(doublings(null, 3), 0);
  assert.equal(doublings(5, null), 0);
});
