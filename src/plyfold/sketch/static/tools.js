// What the pointer does: for each tool, what happens when it goes down, moves and comes up. `place` is in units of the
// drawing, `reach` how near counts as at a thing.

import { distance } from "./geometry.js";
import { addStroke, deletePoint, edgeAt, insertPoint, movePoint, snapped, vertexAt, withStrokes } from "./document.js";
import { allowed, currentJoins, cycleCusp, edit, editIfAllowed, finishPath, tell } from "./commands.js";
import { dragPoint } from "./dragging.js";
import { erased } from "./erasing.js";
import { penStroke, thinned } from "./strokes.js";

const ERASER = 12;
const CLICK = 5;
// How far along a smooth stroke the points around a dragged one come along, in pixels.
const DRAGGED = 60;

const present = ({ store }) => store.state.history.present;

export function placed({ store }, place) {
  const { snap, camera, history } = store.state;
  return snap ? snapped(history.present, place, camera.scale) : place;
}

const draw = {
  down: (page, place) => page.store.set({ path: [placed(page, place)] }),
  move({ store }, places) {
    const { path, camera } = store.state;
    store.set({ path: [...path, ...thinned([path.at(-1), ...places], 1 / camera.scale).slice(1)] });
  },
  up(page) {
    const { path, camera, history } = page.store.state;
    page.store.set({ path: [] });
    if (path.every((point) => distance(point, path[0]) * camera.scale < CLICK)) return;
    const raw = [...path.slice(0, -1), placed(page, path.at(-1))];
    const bridged = currentJoins(page).map((points) => ({ points, closed: false }));
    edit(page, addStroke(history.present, penStroke(raw, 1 / camera.scale, [...history.present.strokes, ...bridged])));
  },
};

const points = {
  down(page, place, reach) {
    const { path } = page.store.state;
    const point = placed(page, place);
    if (path.length > 2 && distance(point, path[0]) < reach) finishPath(page, true);
    else if (!path.length || distance(point, path.at(-1)) > 0) page.store.set({ path: [...path, point], ahead: [] });
  },
  double: (page) => finishPath(page, false),
};

const editing = {
  down(page, place, reach) {
    const { store } = page;
    const vertex = vertexAt(present(page), place, reach);
    if (vertex) return store.set({ selected: vertex, grabbed: present(page) });
    const edge = edgeAt(present(page), place, reach);
    if (!edge) return store.set({ selected: null });
    const at = { stroke: edge.stroke, vertex: edge.vertex };
    const grabbed = insertPoint(present(page), at, edge.point);
    return store.set({ preview: grabbed, selected: at, grabbed });
  },
  move(page, places) {
    const { store } = page;
    const { selected, grabbed, camera } = store.state;
    if (!selected) return page.pan();
    const place = placed(page, places.at(-1));
    const moved = page.altHeld ? movePoint(grabbed, selected, place) : dragPoint(grabbed, selected, place, DRAGGED / camera.scale);
    return store.set(allowed(page, moved) ? { preview: moved, refused: false } : { refused: true });
  },
  up(page) {
    const { preview, refused } = page.store.state;
    if (preview) edit(page, preview);
    page.store.set({ refused: false });
    if (refused) tell(page, "Locked: the point stays where the crossings do not change.", ["lock"]);
  },
  double(page, place, reach) {
    const vertex = vertexAt(present(page), place, reach);
    if (vertex) editIfAllowed(page, deletePoint(present(page), vertex));
    page.store.set({ selected: null });
  },
};

const erase = {
  down: (page, place) => rub(page, [place]),
  move: rub,
  up(page) {
    if (page.store.state.preview) edit(page, page.store.state.preview);
  },
};

function rub({ store }, places) {
  const { preview, history, camera } = store.state;
  const before = preview ?? history.present;
  const strokes = places.reduce((left, place) => erased(left, place, ERASER / camera.scale), before.strokes);
  if (strokes !== before.strokes) store.set({ preview: withStrokes(before, strokes) });
}

const cusp = {
  down(page, place, reach) {
    const document = present(page);
    const vertex = vertexAt(document, place, reach);
    if (vertex) return cycleCusp(page, document, vertex);
    const edge = edgeAt(document, place, reach);
    return edge ? cycleCusp(page, insertPoint(document, edge, edge.point), edge) : page.store.set({ selected: null });
  },
};

const hand = { move: (page) => page.pan() };

export const TOOLS = { draw, points, edit: editing, erase, cusp, hand };

/** Give up what is under way; nothing is changed. */
export const cancel = ({ store }) => store.set({ preview: null, path: [], ahead: [], busy: false, refused: false });
