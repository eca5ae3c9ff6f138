// What the drawing would become: by an offer, or with ribbons in place of open strokes.

import { markCusp, turned, vertexAt, withStrokes } from "./document.js";
import { lineOf, offerOf, ribbonShown } from "./store.js";

const asLoops = (loops) => loops.map((given) => ({ ...given, closed: true }));

/** Loops of an answer in the direction in which they were drawn; answers run with the surface on the left. */
export const asDrawn = ({ reversed: wasTurned }, loops) => (wasTurned ? asLoops(loops).map(turned) : asLoops(loops));

/** The drawing as an offer would have it. */
export function offeredDocument({ history: { present }, answer }, { kind, cusps, loops }) {
  if (kind === "pieces") return withStrokes(present, asLoops(loops));
  if (kind === "repair") return withStrokes(present, asDrawn(answer, loops));
  return cusps.reduce((document, { where, index }) => markCusp(document, vertexAt(present, where, Infinity), index), present);
}

/** A document with ribbons in place of its open strokes, in order. */
export function withRibbons(line, loops) {
  const left = asLoops(loops);
  return withStrokes(line, line.strokes.map((stroke) => (stroke.closed ? stroke : left.shift())));
}

/** What is shown while an offer is pointed at: {areas, strokes}, or null. */
export function trialOf(state) {
  if (state.previewed === "ribbon") {
    const loops = ribbonShown(state)?.loops;
    return loops && lineOf(state) === state.history.present ? { areas: [], strokes: withRibbons(lineOf(state), loops).strokes } : null;
  }
  const offer = offerOf(state, state.previewed);
  return offer && { areas: offer.areas, strokes: offeredDocument(state, offer).strokes };
}
