// Smoothing of what is already drawn.

import { changeStroke } from "./document.js";
import { currentJoins } from "./commands.js";
import { tidied } from "./strokes.js";

/** The drawing with every stroke smoothed and simplified, one after the other, and the same crossings. */
export function smoothedDrawing(page) {
  const { history, camera } = page.store.state;
  const bridged = currentJoins(page).map((points) => ({ points, closed: false }));
  return history.present.strokes.reduce((document, _, index) => changeStroke(document, index, (stroke) => {
    const others = document.strokes.filter((other) => other !== stroke);
    return tidied(stroke, 0.5 / camera.scale, [...others, ...bridged]);
  }), history.present);
}

export const closedAll = (document) => changeStroke(document, 0, (stroke) => ({ ...stroke, closed: true }));
