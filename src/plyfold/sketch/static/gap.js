// Sliders for lengths as shares of the drawing's size: in the middle is the length that plyfold chooses.

import { allPoints } from "./document.js";
import { bounds } from "./geometry.js";
import { lineOf, shown } from "./store.js";

const WAIT = 60; // milliseconds until a slider that moves is listened to

/** A part of the larger side; null for no drawing. */
function partOf(document, part) {
  const box = document && bounds(allPoints(document));
  return box && Math.max(box[2] - box[0], box[3] - box[1]) / part;
}

/** The gap that plyfold chooses: a twentieth of the larger side. */
export const chosenGap = (document) => partOf(document, 20);

/** The width of ribbons that the page chooses. */
export const chosenWidth = (document) => partOf(document, 12);

/** How often a length is twice the one that plyfold chooses: 1 for two times as wide, −1 for half as wide. */
export const doublings = (length, chosen) => (length && chosen ? Math.log2(length / chosen) : 0);

export const followGap = (page, slider, text) => followLength(page, { field: "gap", of: shown, chosenFor: chosenGap }, slider, text);
export const followWidth = (page, slider, text) => followLength(page, { field: "width", of: lineOf, chosenFor: chosenWidth }, slider, text);

/** A slider sets a length, and follows it: to what is kept, to another drawing, and while the drawing grows. */
function followLength({ store }, { field, of, chosenFor }, slider, text) {
  let waiting = null;
  const say = (power) => (text.textContent = power ? `× ${(2 ** power).toFixed(2)}` : "");
  const take = () => {
    waiting = null;
    const chosen = chosenFor(of(store.state));
    store.set({ [field]: slider.valueAsNumber && chosen ? 2 ** slider.valueAsNumber * chosen : null });
  };
  const follow = (state) => {
    if (waiting) return;
    const power = doublings(state[field], chosenFor(of(state)));
    slider.value = power;
    say(power);
  };
  slider.addEventListener("input", () => {
    clearTimeout(waiting);
    waiting = setTimeout(take, WAIT);
    say(slider.valueAsNumber);
  });
  store.follow((state, before) => {
    if (state[field] !== before[field] || (state[field] && of(state)?.strokes !== of(before)?.strokes)) follow(state);
  });
  follow(store.state);
}
