// Sliders for lengths as shares of the drawing's size: in the middle is the length that plyfold chooses.

import { area, bounds, lengthOf } from "./geometry.js";
import { answerShown, lineOf, shown } from "./store.js";

const WAIT = 60; // milliseconds until a slider that moves is listened to

/** A part of the larger side of some paths; null where there are none. */
function partOf(paths, part) {
  const box = paths && bounds(paths.flatMap(({ points }) => points));
  return box && Math.max(box[2] - box[0], box[3] - box[1]) / part;
}

/** The gap that plyfold chooses over an outline: 1/20 of the larger side, or 1/5 of the cloth's mean width. */
export function chosenGap(loops) {
  const sum = (of) => loops.reduce((total, { points }) => total + of(points), 0);
  const width = (2 * Math.abs(sum(area))) / sum(lengthOf);
  return width > 0 ? Math.min(partOf(loops, 20), width / 5) : partOf(loops, 20);
}

/** The width of ribbons that the page chooses along strokes. */
export const chosenWidth = (strokes) => partOf(strokes, 12);

/** The loops of the outline that is seen, or its strokes, as long as nothing is known of them. */
export const outlineShown = (state) => answerShown(state)?.loops ?? shown(state).strokes;

/** How often a length is twice the one that plyfold chooses: 1 for two times as wide, −1 for half as wide. */
export const doublings = (length, chosen) => (length && chosen ? Math.log2(length / chosen) : 0);

export const followGap = (page, slider, text) => followLength(page, { field: "gap", of: outlineShown, chosenFor: chosenGap }, slider, text);
export const followWidth = (page, slider, text) => followLength(page, { field: "width", of: (state) => lineOf(state)?.strokes, chosenFor: chosenWidth }, slider, text);

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
    if (state[field] !== before[field] || (state[field] && of(state) !== of(before))) follow(state);
  });
  follow(store.state);
}
