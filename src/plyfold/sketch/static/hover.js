// What lies under the pointer, and what belongs together: a cell, the sheets over it, a border and its own sheet.

import { distanceToSegment, edges, inside } from "./geometry.js";
import { answerShown, lieShown } from "./store.js";

/** @returns {cell, border, sheets}, or null over the empty table. */
export function hoverAt(state, place, reach) {
  const answer = answerShown(state);
  if (!answer) return null;
  const border = borderAt(answer, place, reach);
  const cell = answer.cells.find((found) => isIn(found, place))?.cell ?? null;
  return border === null && cell === null ? null : { cell, border, sheets: sheetsOf(lieShown(state), cell, border) };
}

const isIn = ({ outline, holes }, place) => inside(place, outline) && !holes.some((hole) => inside(place, hole));

function borderAt({ borders }, place, reach) {
  const near = (points) => edges({ points, closed: false }).some(([a, b]) => distanceToSegment(place, a, b) < reach);
  const found = borders.findIndex(near);
  return found < 0 ? null : found;
}

/** The own sheet of the border, or else all sheets over the cell, the top one first. */
function sheetsOf(lie, cell, border) {
  if (!lie) return [];
  if (border !== null) return [lie.sheets.findIndex((own) => own.includes(border))];
  const level = (sheet) => lie.levels?.[sheet] ?? 0;
  return [...lie.sheet_cell.keys()].filter((sheet) => lie.sheet_cell[sheet] === cell).sort((a, b) => level(b) - level(a));
}

/** What belongs to a sheet: for pictures that know only sheets. */
export function hoverOfSheet(state, sheet) {
  const lie = lieShown(state);
  return lie && sheet !== null ? { cell: lie.sheet_cell[sheet] ?? null, border: null, sheets: [sheet] } : null;
}

export const sameHover = (one, other) => JSON.stringify(one) === JSON.stringify(other);
