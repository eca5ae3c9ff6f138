// Undo and redo: a stack of immutable documents.

/** @returns a history with nothing to undo. */
export const begin = (present) => ({ past: [], present, future: [] });

const MOST_STEPS = 500;

/** Put a new document on top; what had been undone is forgotten. The same document again changes nothing. */
export function record(history, document) {
  if (document === history.present) return history;
  return { past: [...history.past, history.present].slice(-MOST_STEPS), present: document, future: [] };
}

export const canUndo = (history) => history.past.length > 0;
export const canRedo = (history) => history.future.length > 0;

export function undo(history) {
  if (!canUndo(history)) return history;
  return { past: history.past.slice(0, -1), present: history.past.at(-1), future: [history.present, ...history.future] };
}

export function redo(history) {
  if (!canRedo(history)) return history;
  const [present, ...future] = history.future;
  return { past: [...history.past, history.present], present, future };
}
