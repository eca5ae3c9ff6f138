// What was done to a drawing before it was looked at, in words.

import { counted } from "./wording.js";

export const SPIKE = "spike taken out";
const MOVED = "vertex moved";
/** What is told by marks on the drawing, or in words of its own. */
const TOLD = ["gap bridged", MOVED, SPIKE];

const many = (count, one, more) => (count === 1 ? one : `${count} ${more}`);

/** That spikes are not part of what the verdict is about; an empty text where there are none. */
export function spikesNote({ repairs }) {
  const spikes = repairs.filter(({ kind }) => kind === SPIKE).length;
  return spikes ? `${many(spikes, "A spike is", "spikes are")} taken out before.` : "";
}

/** Contacts, and points that are moved for other reasons. */
function movesNote({ repairs, contacts }) {
  const moved = repairs.filter(({ kind }) => kind === MOVED);
  if (contacts.length) return `points in contact at ${many(contacts.length, "one place", "places")}, told apart by moving them outward, infinitely little`;
  return moved.length ? `${many(moved.length, "one point", "points")} moved a little, where crossings fall together` : "";
}

/** All that was changed. */
export function notesOf(answer) {
  const others = answer.repairs.map(({ kind }) => kind).filter((kind) => !TOLD.includes(kind));
  const spikes = spikesNote(answer).replace(/\.$/, "").replace(/^A/, "a");
  return [spikes, movesNote(answer), counted(others)].filter(Boolean).join("; ");
}
