// One value that holds everything the page shows; whoever follows it is told of each new one.

import { START as CAMERA } from "./camera.js";
import { EMPTY } from "./document.js";
import { lengthOf } from "./geometry.js";
import { begin } from "./history.js";

export const START = Object.freeze({
  history: begin(EMPTY),
  name: null, // of the file or curve that the drawing came from
  preview: null, // the document while something is dragged
  grabbed: null, // the document as it was when a point was taken hold of
  tool: "draw", // draw, points, edit, erase, cusp or hand
  busy: false, // a stroke or drag is under way
  path: [], // the points of the stroke or polyline in the making
  ahead: [], // points of the polyline that were taken back, the next one first
  cursor: null, // where the keyboard draws
  carried: null, // the vertex that the keyboard moves, {stroke, vertex}
  refused: false, // the lock held a move back
  selected: null, // {stroke, vertex}
  pointer: null, // where the mouse is, in units of the drawing
  locked: false,
  snap: false,
  camera: CAMERA,
  answer: null, // to `look`, or {error}
  answered: null, // the document that the answer is about
  offer: null, // the answer to `cusps`: where they would help
  lie: null, // the answer to `lie`
  mesh: null, // the surface, or null
  unlifted: null, // why there is no surface: a sentence
  asking: false,
  immersion: "0",
  layering: "0",
  gap: null,
  scene: "surface", // or "layout"
  hover: null, // {cell, border, sheets}
  notice: null, // {text, actions: [action names]}
  unkept: null, // why the browser does not keep the drawing: a sentence
  theme: "system",
});

export function createStore(state = START) {
  const followers = new Set();
  return {
    get state() {
      return state;
    },
    set(patch) {
      const before = state;
      state = { ...state, ...patch };
      followers.forEach((follow) => follow(state, before));
    },
    follow(follower) {
      followers.add(follower);
    },
  };
}

/** The document as it is seen: while something is dragged, as it would become. */
export const shown = (state) => state.preview ?? state.history.present;

/** Whether the last answer is about what is seen. */
export const isAnswered = (state) => state.answered?.strokes === shown(state).strokes;

/** The answer, if it is about what is seen. */
export const answerShown = (state) => (isAnswered(state) && !state.answer.error ? state.answer : null);

/** What is wrong with the drawing that is seen, if it is no loop that can be used. */
export const errorShown = (state) => (isAnswered(state) ? (state.answer.error ?? null) : null);

/** The kink that the drawing would be a disk without, if it is no more than a quarter of it. */
export function smallKink(state) {
  const kink = answerShown(state)?.verdict.kink;
  if (!kink) return null;
  const lobes = kink.lobes.reduce((sum, lobe) => sum + lengthOf(lobe), 0);
  return lobes <= (lobes + lengthOf(kink.points)) / 4 ? kink : null;
}

/** How the cloth lies, if that is about what is seen. */
export const lieShown = (state) => (answerShown(state) && state.lie?.sheets ? state.lie : null);

/** Where the surface that is seen touches itself. */
export const touchesShown = (state) => lieShown(state)?.touches ?? answerShown(state)?.verdict.touches ?? [];

/** The cusps that would help, if that is about what is seen. */
export const offerShown = (state) => (answerShown(state) && state.offer?.cusps?.length ? state.offer : null);

/** The strokes that would have to be turned round for every second loop to be a hole. Open strokes have no number in answers. */
export function turnable(state) {
  const answer = answerShown(state);
  return answer && shown(state).strokes.every(({ closed }) => closed) ? answer.verdict.turn : [];
}
