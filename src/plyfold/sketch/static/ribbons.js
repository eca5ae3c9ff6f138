// Open strokes with a width: seen before they are made, and as wide as the slider says also after that.

import { ask } from "./answers.js";
import { edit, tell } from "./commands.js";
import { chosenWidth, followWidth } from "./gap.js";
import { lineOf, ribbonShown } from "./store.js";
import { withRibbons } from "./trials.js";

const widthOf = (state, line) => state.width ?? chosenWidth(line?.strokes);

/** Ask for the ribbons of a line, unless they are known. @returns what is known of them; null if that was cancelled. */
async function known({ store }, line, signal) {
  const width = widthOf(store.state, line);
  const before = ribbonShown(store.state);
  if (before?.width === width) return before;
  const answer = await ask("ribbon", { strokes: line.strokes, width }, signal);
  if (!answer || signal?.aborted) return null;
  const made = before?.made ?? null;
  const ribbon = { line, made, width, loops: answer.loops ?? null, error: answer.error ?? null };
  store.set({ ribbon });
  return ribbon;
}

/** Put ribbons in place of the open strokes of the drawing. */
export async function makeRibbon(page) {
  const { store } = page;
  const line = lineOf(store.state);
  const ribbon = await known(page, line);
  if (!ribbon || store.state.history.present !== line) return;
  if (ribbon.error) {
    tell(page, `${ribbon.error.sentence}: ${ribbon.error.hint}.`);
    return;
  }
  const made = withRibbons(line, ribbon.loops);
  edit(page, made);
  store.set({ ribbon: { ...ribbon, made }, previewed: null });
}

/** The ribbons that were made, with another width: not a step of its own. */
function widen({ store }, ribbon) {
  const { history } = store.state;
  if (ribbon.error || history.present !== ribbon.made) return;
  const made = withRibbons(ribbon.line, ribbon.loops);
  store.set({ ribbon: { ...ribbon, made }, history: { ...history, present: made } });
}

/** The slider, and what is seen while the button is pointed at or the slider moves. */
export function followRibbons(page, box, slider, text) {
  const { store } = page;
  let running = new AbortController();
  followWidth(page, slider, text);
  const show = async () => {
    running.abort();
    running = new AbortController();
    const line = lineOf(store.state);
    const ribbon = line && (await known(page, line, running.signal));
    if (ribbon) widen(page, ribbon);
  };
  slider.addEventListener("input", () => store.set({ previewed: "ribbon" }));
  slider.addEventListener("change", () => store.set({ previewed: null }));
  store.follow((state, before) => {
    box.hidden = lineOf(state) === null;
    const isWider = state.width !== before.width && !box.hidden;
    if (isWider || (state.previewed === "ribbon" && before.previewed !== "ribbon")) show();
  });
}
