// Drawings kept in this browser, each under a name of its own. A page writes only to the drawing it has begun, so that
// neither another page nor a link ever overwrites work; and no drawing goes unless someone discards it.

import { checked } from "./link.js";

const PREFIX = "plyfold.drawing.";

export const newId = () => `${Date.now().toString(36)}-${Math.random().toString(36).slice(2, 8)}`;

/** Where a drawing is kept: its name there, the text last read or written, and the picture that is kept with it. */
export const newPlace = (id = newId()) => ({ id, text: null, picture: null });

/**
 * Keep a drawing, without its picture. Where another page has written since this one read or wrote, a duplicate of it
 * for example, the drawing goes on under a new name.
 * @returns the place where it is kept now, or null if the browser has no room for it.
 */
export function keep(storage, place, document, name = null, saved = Date.now()) {
  const text = JSON.stringify({ saved, name, document: withoutPicture(document) });
  const found = storage.getItem(PREFIX + place.id);
  const own = found === null || found === place.text ? place : newPlace();
  try {
    storage.setItem(PREFIX + own.id, text);
    return { ...own, text };
  } catch {
    return null;
  }
}

/** Pictures are large, and are kept elsewhere: what is left of one is where it lies. */
const withoutPicture = ({ image, ...document }) => ({ ...document, image: image && { ...image, href: null } });

export const discard = (storage, id) => storage.removeItem(PREFIX + id);

/** @returns {id, saved, name, text, document}, or null if there is no such drawing; its image.href is null if it is kept apart. */
export function recall(storage, id) {
  try {
    const text = storage.getItem(PREFIX + id);
    const { saved, name, document } = JSON.parse(text);
    const drawing = checked(document);
    const image = document.image?.href === null ? { ...document.image } : drawing.image;
    return { id, saved, name, text, document: { ...drawing, image } };
  } catch {
    return null;
  }
}

/** All drawings kept, the newest first. */
export function kept(storage) {
  const names = Array.from({ length: storage.length }, (_, i) => storage.key(i)).filter((key) => key.startsWith(PREFIX));
  return names.map((key) => recall(storage, key.slice(PREFIX.length))).filter(Boolean).sort((a, b) => b.saved - a.saved);
}
