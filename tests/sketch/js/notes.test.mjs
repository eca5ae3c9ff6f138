import assert from "node:assert/strict";
import { test } from "node:test";

import { notesOf, spikesNote } from "../../../src/plyfold/sketch/static/notes.js";

const repairs = (...kinds) => kinds.map((kind) => ({ kind, where: [0, 0], size: 1 }));

test("nothing was done: nothing is said", () => {
  const answer = { repairs: repairs("gap bridged"), contacts: [] };
  assert.equal(notesOf(answer), "");
  assert.equal(spikesNote(answer), "");
});

test("spikes, contacts and other changes are said, each kind once", () => {
  const answer = { repairs: repairs("spike taken out", "vertex moved", "vertex moved", "repeated point dropped", "repeated point dropped"), contacts: [[1, 1]] };
  assert.equal(spikesNote(answer), "A spike is taken out before.");
  assert.equal(notesOf(answer), "a spike is taken out before; points in contact at one place, told apart by moving them outward, infinitely little; repeated point dropped, 2 times");
  assert.equal(spikesNote({ ...answer, repairs: repairs("spike taken out", "spike taken out") }), "2 spikes are taken out before.");
});

test("points that are moved where nothing is in contact are said to be moved", () => {
  assert.equal(notesOf({ repairs: repairs("vertex moved"), contacts: [] }), "one point moved a little, where crossings fall together");
});
