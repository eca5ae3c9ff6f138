import assert from "node:assert/strict";
import { test } from "node:test";

import { loop } from "../../../src/plyfold/sketch/static/document.js";
import { keyName, shownKey } from "../../../src/plyfold/sketch/static/keys.js";
import { discard, keep, kept, newId, recall } from "../../../src/plyfold/sketch/static/storage.js";

/** What a browser keeps, with room for so many letters. */
function store(room = Infinity) {
  const held = new Map();
  const used = () => [...held.values()].join("").length;
  return {
    get length() {
      return held.size;
    },
    key: (i) => [...held.keys()][i],
    getItem: (name) => held.get(name) ?? null,
    removeItem: (name) => held.delete(name),
    setItem(name, text) {
      if (used() - (held.get(name) ?? "").length + text.length > room) throw new Error("no room");
      held.set(name, text);
    },
  };
}

const triangle = loop([[0, 0], [4, 0], [0, 3]]);

test("a drawing kept comes back, the newest first, and goes when it is discarded", () => {
  const storage = store();
  keep(storage, "a", triangle, "first", 1);
  keep(storage, "b", triangle, null, 2);
  storage.setItem("something else", "[");
  assert.deepEqual(kept(storage).map(({ id }) => id), ["b", "a"]);
  assert.deepEqual(recall(storage, "a"), { id: "a", saved: 1, name: "first", document: triangle });
  discard(storage, "a");
  assert.equal(recall(storage, "a"), null);
});

test("where there is no room the oldest goes, but never the drawing itself", () => {
  const storage = store(420);
  for (let i = 0; i < 6; i++) assert.ok(keep(storage, `d${i}`, triangle, null, i));
  const ids = kept(storage).map(({ id }) => id);
  assert.equal(ids[0], "d5");
  assert.ok(ids.length < 6 && !ids.includes("d0"));
  assert.ok(!keep(store(10), "x", triangle));
});

test("what was spoiled is no drawing", () => {
  const storage = store();
  storage.setItem("plyfold.drawing.x", "{");
  storage.setItem("plyfold.drawing.y", '{"document": {"plyfold": 9}}');
  assert.deepEqual(kept(storage), []);
});

test("names of drawings differ", () => {
  assert.equal(new Set(Array.from({ length: 200 }, newId)).size, 200);
});

test("keys have one name each", () => {
  const pressed = (key, held = {}) => keyName({ key, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, ...held });
  assert.equal(pressed("z", { ctrlKey: true }), "Ctrl+Z");
  assert.equal(pressed("Z", { metaKey: true, shiftKey: true }), "Ctrl+Shift+Z");
  assert.equal(pressed("?", { shiftKey: true }), "?");
  assert.equal(pressed("ArrowLeft"), "ArrowLeft");
  assert.equal(shownKey("ArrowLeft"), "←");
  assert.equal(shownKey("Ctrl+Shift+Z"), "Ctrl+Shift+Z");
  assert.equal(shownKey("+"), "+");
});
