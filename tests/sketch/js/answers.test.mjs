import assert from "node:assert/strict";
import { test } from "node:test";

import { ask, followAnswers } from "../../../src/plyfold/sketch/static/answers.js";
import { loop } from "../../../src/plyfold/sketch/static/document.js";
import { begin } from "../../../src/plyfold/sketch/static/history.js";
import { START, createStore } from "../../../src/plyfold/sketch/static/store.js";

/** A server that gives these answers, one after the other. */
function serving(...answers) {
  globalThis.fetch = async () => ({ json: async () => answers.shift() });
  return answers;
}

const superseded = { error: { kind: "superseded" } };

test("a question whose place was taken by one that was cancelled is asked again", async () => {
  const left = serving(superseded, superseded, { turning_number: 1 });
  assert.deepEqual(await ask("look", {}, new AbortController().signal), { turning_number: 1 });
  assert.equal(left.length, 0);
});

test("a question that was cancelled, or that nobody can cancel, is not asked again", async () => {
  const left = serving(superseded, superseded);
  assert.equal(await ask("look", {}, AbortSignal.abort()), null);
  assert.equal(await ask("look", {}), null);
  assert.equal(left.length, 0);
});

test("whatever else changes while an answer is on its way, it is asked for once", () => {
  const document = loop([[0, 0], [4, 0], [0, 3]]);
  const answered = { history: begin(document), answered: document, answer: { loops: [] }, lie: { immersion: "0", layering: "0" } };
  const store = createStore({ ...START, ...answered });
  const asked = [];
  const timer = globalThis.setInterval;
  globalThis.setInterval = () => 0;
  followAnswers(store, (question, body) => (asked.push(`${question} ${body.immersion ?? ""}`), new Promise(() => {})));
  globalThis.setInterval = timer;
  store.set({ immersion: "1" });
  store.set({ hover: null });
  store.set({ unkept: "no room" });
  assert.deepEqual(asked.filter((words) => words.startsWith("lie")), ["lie 1"]);
});
