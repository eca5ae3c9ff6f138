// One value that holds everything the page shows; whoever follows it is told of each new one.

import { START as CAMERA } from "./camera.js";
import { EMPTY } from "./document.js";
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
  offers: null, // the answer to `offers`: what can be done where there is no surface
  previewed: null, // the kind of the offer that is pointed at, or "ribbon"
  ribbon: null, // what open strokes would be or are as ribbons: {line: the document with them, made, width, loops, error}
  width: null, // of ribbons; null for the one that the page chooses
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

/** How the cloth lies, if that is about what is seen. */
export const lieShown = (state) => (answerShown(state) && state.lie?.sheets ? state.lie : null);

/** Where the surface that is seen touches itself. */
export const touchesShown = (state) => lieShown(state)?.touches ?? answerShown(state)?.verdict.touches ?? [];

/** What can be done about what is seen. */
export const offersShown = (state) => (answerShown(state)?.verdict.immersible === false && state.offers) || [];

/** The offer of a kind: "repair", "cusps" or "pieces". */
export const offerOf = (state, kind) => offersShown(state).find((offer) => offer.kind === kind) ?? null;

/** The document whose open strokes are to be ribbons: the one that is seen, or the one that ribbons were made of. */
export function lineOf(state) {
  const { history: { present }, ribbon } = state;
  if (ribbon && present === ribbon.made) return ribbon.line;
  return errorShown(state)?.kind === "unfinished" && present.strokes.some(({ closed, points }) => !closed && points.length > 1) ? present : null;
}

/** The ribbons that are known of what is seen. */
export const ribbonShown = (state) => (state.ribbon && state.ribbon.line === lineOf(state) ? state.ribbon : null);

/** The strokes that would have to be turned round for every second loop to be a hole. Open strokes have no number in answers. */
export function turnable(state) {
  const answer = answerShown(state);
  return answer && shown(state).strokes.every(({ closed }) => closed) ? answer.verdict.turn : [];
}
