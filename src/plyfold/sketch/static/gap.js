// The gap between sheets as a share of the drawing's size: the middle of the slider is the gap that plyfold chooses.

import { allPoints } from "./document.js";
import { bounds } from "./geometry.js";
import { shown } from "./store.js";

const WAIT = 60; // milliseconds until a slider that moves is listened to

/** The gap that plyfold chooses: a twentieth of the larger side. */
export function chosenGap(document) {
  const box = bounds(allPoints(document));
  return box && Math.max(box[2] - box[0], box[3] - box[1]) / 20;
}

/** How often the gap is twice the one that plyfold chooses: 1 for two times as wide, −1 for half as wide. */
export const doublings = (gap, chosen) => (gap && chosen ? Math.log2(gap / chosen) : 0);

/** The slider sets the gap, and follows it: to what is kept, to another drawing, and while the drawing grows. */
export function followGap({ store }, slider, text) {
  let waiting = null;
  const say = (power) => (text.textContent = power ? `× ${(2 ** power).toFixed(2)}` : "");
  const take = () => {
    waiting = null;
    const chosen = chosenGap(shown(store.state));
    store.set({ gap: slider.valueAsNumber && chosen ? 2 ** slider.valueAsNumber * chosen : null });
  };
  const follow = ({ gap, ...state }) => {
    if (waiting) return;
    const power = doublings(gap, chosenGap(shown(state)));
    slider.value = power;
    say(power);
  };
  slider.addEventListener("input", () => {
    clearTimeout(waiting);
    waiting = setTimeout(take, WAIT);
    say(slider.valueAsNumber);
  });
  store.follow((state, before) => {
    if (state.gap !== before.gap || (state.gap && shown(state).strokes !== shown(before).strokes)) follow(state);
  });
  follow(store.state);
}
