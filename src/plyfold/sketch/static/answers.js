// What the server says of the drawing: three questions, each asked as soon as the one before is answered; and where there
// is no surface, what can be done about it. The newest drawing wins: whatever is still on its way for an older one is
// cancelled.

import { errorShown, isAnswered, shown } from "./store.js";

/** Of what page and server say to each other: PROTOCOL.md. */
export const PROTOCOL = 3;
export const addressOf = (question) => `/api/v${PROTOCOL}/${question}`;
const PAGE = crypto.getRandomValues(new Uint32Array(2)).join("-");
const TRIANGLES = 3000;
const NO_SURFACE = "There is no surface with this outline.";
const RETRY = 2000; // milliseconds
export const SILENT = "plyfold does not answer";
const AWAY = { kind: "away", where: [], hint: "start plyfold sketch again; the drawing is kept in this browser" };

/**
 * Ask the server. An older question that was cancelled may arrive after this one and take its place: then it is asked
 * again. @returns the answer, or one with an error; null if the question was cancelled.
 */
export async function ask(question, body, signal) {
  try {
    const headers = { "Content-Type": "application/json", "X-Plyfold-Page": PAGE };
    const response = await fetch(addressOf(question), { method: "POST", headers, body: JSON.stringify({ version: PROTOCOL, ...body }), signal });
    const answer = await response.json();
    if (answer.error?.kind !== "superseded") return answer;
    return signal && !signal.aborted ? ask(question, body, signal) : null;
  } catch (error) {
    if (error.name === "AbortError") return null;
    return { error: { ...AWAY, sentence: "The server has ended, or is busy starting" } };
  }
}

/** Keep the answers in the store up to date with the drawing and with what is asked about it. */
export function followAnswers(store, question = ask) {
  let running = new AbortController();
  const restart = (start) => {
    running.abort();
    running = new AbortController();
    start(store, question, running.signal).catch((error) => store.set({ notice: { text: String(error), actions: [] } }));
  };
  store.follow((state, before) => {
    if (shown(state).strokes !== shown(before).strokes) restart(look);
    else if (state.lie && state.lie === before.lie && asksOtherwise(state) && walked(state, before)) restart(isAnswered(state) ? lie : look);
    else if (state.lie && state.gap !== before.gap) restart(isAnswered(state) ? lift : look);
  });
  setInterval(() => errorShown(store.state)?.kind === "away" && restart(look), RETRY);
  if (shown(store.state).strokes.length) restart(look);
}

const walked = (state, before) => state.immersion !== before.immersion || state.layering !== before.layering;
const asksOtherwise = ({ lie: known, immersion, layering }) => known.immersion !== immersion || known.layering !== layering;
const NOTHING = { answer: null, answered: null, offers: null, lie: null, mesh: null, unlifted: null, asking: false };

async function look(store, question, signal) {
  const document = shown(store.state);
  if (!document.strokes.length) return store.set(NOTHING);
  store.set({ asking: true });
  const answer = await question("look", { strokes: document.strokes }, signal);
  if (!answer || signal.aborted) return undefined;
  const same = answer.code !== undefined && answer.code === store.state.answer?.code;
  const immersible = answer.verdict?.immersible;
  const { immersion, layering } = same || !store.state.answer ? store.state : { immersion: "0", layering: "0" };
  const gone = immersible ? {} : { mesh: null, unlifted: answer.verdict ? NO_SURFACE : null };
  const asking = typeof immersible === "boolean";
  store.set({ answer, answered: document, offers: null, previewed: null, lie: same ? store.state.lie : null, asking, immersion, layering, ...gone });
  if (immersible) return lie(store, question, signal);
  return immersible === false ? offer(store, question, signal) : undefined;
}

async function offer(store, question, signal) {
  const found = await question("offers", { strokes: store.state.answered.strokes }, signal);
  if (found && !signal.aborted) store.set({ offers: found.offers ?? [], asking: false });
}

async function lie(store, question, signal) {
  const { answer, answered, immersion, layering, lie: former } = store.state;
  if (!answer?.loops) return;
  const before = former && former.immersion !== immersion ? former.immersion : null;
  const found = await question("lie", { strokes: answered.strokes, immersion, layering, before }, signal);
  if (!found || signal.aborted) return;
  if (found.error) {
    store.set({ lie: null, mesh: null, unlifted: found.error.sentence, asking: false });
    return;
  }
  store.set({ lie: found, immersion: found.immersion ?? immersion, layering: found.layering ?? layering });
  await lift(store, question, signal);
}

async function lift(store, question, signal) {
  const { answered, lie: found, immersion, layering, gap } = store.state;
  if (!found?.sheets) return store.set({ asking: false });
  const body = { strokes: answered.strokes, immersion, layering, gap, triangles: TRIANGLES, allow_intersections: found.layerable === false };
  const lifted = await question("surface", body, signal);
  if (!lifted || signal.aborted) return undefined;
  const unlifted = (found.obstruction ?? lifted.obstruction ?? lifted.error)?.sentence ?? null;
  return store.set({ mesh: lifted.mesh ?? null, unlifted, asking: false });
}
