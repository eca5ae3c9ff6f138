import assert from "node:assert/strict";
import { test } from "node:test";

import { loop } from "../../../src/plyfold/sketch/static/document.js";
import { keyName, shownKey } from "../../../src/plyfold/sketch/static/keys.js";
import { discard, keep, kept, newId, newPlace, recall } from "../../../src/plyfold/sketch/static/storage.js";

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
  const { text } = keep(storage, newPlace("a"), triangle, "first", 1);
  keep(storage, newPlace("b"), triangle, null, 2);
  storage.setItem("something else", "[");
  assert.deepEqual(kept(storage).map(({ id }) => id), ["b", "a"]);
  assert.deepEqual(recall(storage, "a"), { id: "a", saved: 1, name: "first", text, document: triangle });
  discard(storage, "a");
  assert.equal(recall(storage, "a"), null);
});

test("where there is no room nothing else goes, and it is told", () => {
  const storage = store(420);
  const places = Array.from({ length: 6 }, (_, i) => keep(storage, newPlace(`d${i}`), triangle, null, i));
  const fit = places.filter(Boolean).length;
  assert.ok(fit > 1 && fit < 6);
  assert.deepEqual(places.map(Boolean), places.map((_, i) => i < fit));
  assert.deepEqual(kept(storage).map(({ saved }) => saved).reverse(), [...Array(fit).keys()]);
});

test("any number of drawings is kept", () => {
  const storage = store();
  for (let i = 0; i < 200; i++) keep(storage, newPlace(), triangle, null, i);
  assert.equal(kept(storage).length, 200);
});

test("of two pages with one drawing the second to write goes on under a name of its own", () => {
  const storage = store();
  const begun = keep(storage, newPlace("a"), triangle);
  const [first, twin] = [begun, begun].map((place, i) => keep(storage, place, loop([[i, 0], [4, 0], [0, 6]])));
  assert.equal(first.id, "a");
  assert.notEqual(twin.id, "a");
  const again = [first, twin].map((place, i) => keep(storage, place, loop([[i, 0], [4, 0], [0, 9]])));
  assert.deepEqual(again.map(({ id }) => id), [first.id, twin.id]);
  assert.deepEqual(again.map(({ id }) => recall(storage, id).document.strokes[0].points[0]), [[0, 0], [1, 0]]);
});

test("a drawing that another page has discarded is kept again", () => {
  const storage = store();
  const place = keep(storage, newPlace("a"), triangle);
  discard(storage, "a");
  assert.equal(keep(storage, place, triangle).id, "a");
});

test("a picture takes no room among the drawings; one that was kept among them is still there", () => {
  const image = { href: `data:image/png;base64,${"A".repeat(9000)}`, place: [0, 0, 4, 3], opacity: 0.5 };
  const storage = store(1000);
  keep(storage, newPlace("a"), { ...triangle, image });
  assert.deepEqual(recall(storage, "a").document.image, { ...image, href: null });
  const before = store();
  before.setItem("plyfold.drawing.b", JSON.stringify({ saved: 1, name: null, document: { ...triangle, image } }));
  assert.deepEqual(recall(before, "b").document.image, image);
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
