// Drawings kept in this browser, each under a name of its own. A page writes only to the drawing it has begun, so that
// neither another page nor a link ever overwrites work.

import { checked } from "./link.js";

const PREFIX = "plyfold.drawing.";
const MOST_KEPT = 60;

export const newId = () => `${Date.now().toString(36)}-${Math.random().toString(36).slice(2, 8)}`;

/** Keep a drawing. @returns false if the browser has no room even after the oldest ones are gone. */
export function keep(storage, id, document, name = null, saved = Date.now()) {
  const text = JSON.stringify({ saved, name, document });
  for (;;) {
    try {
      storage.setItem(PREFIX + id, text);
      kept(storage).slice(MOST_KEPT).forEach((drawing) => discard(storage, drawing.id));
      return true;
    } catch {
      const oldest = kept(storage).filter((drawing) => drawing.id !== id).at(-1);
      if (!oldest) return false;
      discard(storage, oldest.id);
    }
  }
}

export const discard = (storage, id) => storage.removeItem(PREFIX + id);

/** @returns {id, saved, name, document}, or null if there is no such drawing. */
export function recall(storage, id) {
  try {
    const { saved, name, document } = JSON.parse(storage.getItem(PREFIX + id));
    return { id, saved, name, document: checked(document) };
  } catch {
    return null;
  }
}

/** All drawings kept, the newest first. */
export function kept(storage) {
  const names = Array.from({ length: storage.length }, (_, i) => storage.key(i)).filter((key) => key.startsWith(PREFIX));
  return names.map((key) => recall(storage, key.slice(PREFIX.length))).filter(Boolean).sort((a, b) => b.saved - a.saved);
}
