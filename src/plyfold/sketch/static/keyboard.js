// Drawing without a pointer: a cursor that the arrow keys move. Enter places a point, or takes one up and puts it down.

import { toDrawing, toScreen } from "./camera.js";
import { add } from "./geometry.js";
import { deletePoint, movePoint, vertexAt } from "./document.js";
import { allowed, edit, editIfAllowed, finishPath, tell } from "./commands.js";
import { TOOLS, cancel, placed } from "./tools.js";

const STEP = 10;
const REACH = 14;
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export const CURSOR_KEYS = [
  ["← → ↑ ↓", "Move the cursor; with Shift in small steps"],
  ["Enter", "Place a point; in Edit, take up a point and put it down; in Cusps, mark it"],
  ["[ ]", "Go to the previous or next point"],
  ["Del", "Delete the point at the cursor"],
  ["Esc", "End the line, then leave"],
];

export function toggleCursor(page) {
  const { store } = page;
  if (store.state.cursor) return store.set({ cursor: null, carried: null });
  const { width, height } = page.size();
  const tool = ["edit", "cusp"].includes(store.state.tool) ? store.state.tool : "points";
  store.set({ tool, cursor: toDrawing(store.state.camera, [width / 2, height / 2]) });
  return page.focusDrawing();
}

/** @returns whether the key was meant for the cursor. */
export function pressCursor(page, event) {
  const { cursor } = page.store.state;
  if (!cursor || event.ctrlKey || event.metaKey || event.altKey) return false;
  const perform = ARROWS[event.key] ? moveBy : KEYS[event.key];
  if (!perform) return false;
  perform(page, event);
  return true;
}

const KEYS = {
  Enter: press,
  " ": press,
  "[": (page) => jump(page, -1),
  "]": (page) => jump(page, 1),
  Delete: deleteHere,
  Backspace: deleteHere,
  Escape: leave,
};

function moveBy(page, { key, shiftKey }) {
  const { camera, cursor } = page.store.state;
  const step = (shiftKey ? 1 : STEP) / camera.scale;
  moveTo(page, add(cursor, ARROWS[key].map((x) => x * step)));
}

function moveTo(page, place) {
  const { store } = page;
  const { carried, history, preview } = store.state;
  if (!carried) return store.set({ cursor: kept(page, place) });
  const moved = movePoint(preview ?? history.present, carried, place);
  return allowed(page, moved) ? store.set({ cursor: place, preview: moved }) : tell(page, "Locked: that would change the crossings.", ["lock"]);
}

/** The cursor never leaves the picture. */
function kept(page, place) {
  const { camera } = page.store.state;
  const { width, height } = page.size();
  const [x, y] = toScreen(camera, place);
  return toDrawing(camera, [Math.min(Math.max(x, 0), width), Math.min(Math.max(y, 0), height)]);
}

function press(page) {
  const { tool, cursor, camera } = page.store.state;
  if (tool === "edit") return takeOrPut(page);
  const reach = REACH / camera.scale;
  return tool === "cusp" ? TOOLS.cusp.down(page, cursor, reach) : TOOLS.points.down(page, placed(page, cursor), reach);
}

function takeOrPut(page) {
  const { store } = page;
  const { carried, preview, cursor } = store.state;
  if (carried) {
    if (preview) edit(page, preview);
    return store.set({ carried: null });
  }
  const vertex = here(page, cursor);
  return vertex && store.set({ carried: vertex, selected: vertex });
}

const here = ({ store }, place) => vertexAt(store.state.history.present, place, REACH / store.state.camera.scale);

function jump(page, by) {
  const { store } = page;
  const all = store.state.history.present.strokes.flatMap(({ points }, stroke) => points.map((point, vertex) => ({ stroke, vertex, point })));
  if (!all.length || store.state.carried) return;
  const { selected } = store.state;
  const now = all.findIndex(({ stroke, vertex }) => stroke === selected?.stroke && vertex === selected?.vertex);
  const { point, ...next } = all[(now + by + (now < 0 && by < 0 ? 1 : 0) + all.length) % all.length];
  store.set({ cursor: point, selected: next });
}

function deleteHere(page) {
  const { path, cursor, history } = page.store.state;
  if (path.length) return page.store.set({ path: path.slice(0, -1) });
  const vertex = here(page, cursor);
  if (vertex) editIfAllowed(page, deletePoint(history.present, vertex));
  return page.store.set({ selected: null, carried: null });
}

function leave(page) {
  const { path, carried } = page.store.state;
  if (path.length) finishPath(page, false);
  else if (carried) {
    cancel(page);
    page.store.set({ carried: null });
  } else page.store.set({ cursor: null, selected: null });
}
