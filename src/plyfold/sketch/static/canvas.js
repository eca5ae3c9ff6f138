// The drawing area: its size, its painting, and the pointers on it. Fingers draw; two of them move and zoom the paper.

import { panned, toDrawing, zoomed } from "./camera.js";
import { themeOf } from "./colours.js";
import { joins } from "./document.js";
import { distance, middle, minus } from "./geometry.js";
import { hoverAt } from "./hover.js";
import { paint } from "./painting.js";
import { answerShown, errorShown, lieShown, offerOf, ribbonShown, shown, touchesShown } from "./store.js";
import { TOOLS, cancel } from "./tools.js";
import { trialOf } from "./trials.js";

const REACH = { mouse: 9, pen: 12, touch: 20 };

export function createCanvas(page, canvas) {
  const { store } = page;
  const context = canvas.getContext("2d");
  const images = loadedImages(() => request());
  let waiting = false;

  function request() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      const ratio = fitToScreen(canvas);
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      paint(context, pictureOf(page, themeOf(canvas), images(shown(store.state).image)));
      canvas.dispatchEvent(new CustomEvent("painted"));
    });
  }

  new ResizeObserver(request).observe(canvas);
  store.follow((state, before) => {
    request();
    if (state.tool !== before.tool) canvas.dataset.tool = state.tool;
  });
  canvas.dataset.tool = store.state.tool;
  listen(page, canvas);
  request();
  return { request };
}

/** What is to be seen. */
function pictureOf({ store, size }, theme, image) {
  const { state } = store;
  const answer = answerShown(state);
  const document = shown(state);
  const { camera, tool, path, selected, cursor, pointer, hover, snap } = state;
  return {
    size: size(), camera, theme, document, image, tool, path, selected, cursor, hover, snap, answer, lie: lieShown(state),
    touches: touchesShown(state),
    offered: offerOf(state, "cusps")?.cusps ?? [],
    trial: trialOf(state),
    joins: answer ? joins(document.strokes, answer.repairs) : [],
    openEnds: [...(errorShown(state)?.where ?? []), ...(ribbonShown(state)?.error?.where ?? [])],
    next: tool === "points" ? (cursor ?? pointer) : null,
  };
}

function fitToScreen(canvas) {
  const ratio = Math.min(devicePixelRatio, 3);
  const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  return ratio;
}

/** The picture to draw after, once it is there. */
function loadedImages(onLoad) {
  const image = new Image();
  image.addEventListener("load", onLoad);
  return (wanted) => {
    if (!wanted) return null;
    if (image.src !== wanted.href) image.src = wanted.href;
    return image.complete && image.naturalWidth ? image : null;
  };
}

// ---- pointers -----------------------------------------------------------------------------------------------------

/** While a pen is on the screen, or just above it, a touch is the hand that holds it. */
function palmsOf(canvas) {
  let penIsNear = false;
  const follow = (isNear) => ({ pointerType }) => {
    if (pointerType === "pen") penIsNear = isNear;
  };
  for (const kind of ["pointerenter", "pointerdown", "pointermove"]) canvas.addEventListener(kind, follow(true));
  for (const kind of ["pointerleave", "pointercancel"]) canvas.addEventListener(kind, follow(false));
  return ({ pointerType }) => pointerType === "touch" && penIsNear;
}

function listen(page, canvas) {
  const isPalm = palmsOf(canvas);
  const fingers = new Map(); // where each pointer is, in pixels of the canvas
  const place = (event) => [event.offsetX, event.offsetY];
  const drawn = (event) => toDrawing(page.store.state.camera, place(event));
  const reach = (event) => (REACH[event.pointerType] ?? REACH.mouse) / page.store.state.camera.scale;
  let tool = null;
  let before = page.store.state; // what a stroke began with

  const giveUp = () => {
    const { path, ahead, history } = before;
    const { history: now } = page.store.state;
    cancel(page);
    tool = null;
    if (now === history) page.store.set({ path, ahead });
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (isPalm(event)) return;
    if (event.pointerType === "pen" && fingers.size) { // the hand came first
      fingers.clear();
      giveUp();
    }
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, place(event));
    if (fingers.size > 1) giveUp();
    else if (event.button !== 2) {
      before = page.store.state;
      tool = event.button === 1 || page.spaceHeld ? TOOLS.hand : TOOLS[page.store.state.tool];
      page.store.set({ busy: true, cursor: null, hover: null });
      tool.down?.(page, drawn(event), reach(event));
    }
  });

  canvas.addEventListener("pointermove", (event) => {
    if (!page.store.state.busy) tool = null; // it was given up
    if (!fingers.has(event.pointerId)) return event.pointerType === "touch" ? undefined : hover(page, drawn(event), reach(event));
    if (fingers.size > 1) pinch(page, fingers, event.pointerId, place(event));
    const from = fingers.get(event.pointerId);
    fingers.set(event.pointerId, place(event));
    page.altHeld = event.altKey;
    page.pan = () => page.store.set({ camera: panned(page.store.state.camera, minus(place(event), from)) });
    const events = event.getCoalescedEvents?.() ?? [];
    return tool?.move?.(page, (events.length ? events : [event]).map(drawn));
  });

  const lift = (event) => {
    if (!fingers.delete(event.pointerId)) return undefined;
    if (event.type === "pointercancel") return tool && giveUp();
    const ended = page.store.state.busy ? tool : null;
    tool = null;
    page.store.set({ busy: false });
    return ended?.up?.(page);
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("pointerleave", () => page.store.set({ hover: null, pointer: null }));
  canvas.addEventListener("dblclick", (event) => TOOLS[page.store.state.tool].double?.(page, drawn(event), reach(event)));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    page.store.set({ camera: zoomed(page.store.state.camera, Math.exp(-event.deltaY / 400), place(event)) });
  }, { passive: false });
}

function hover({ store }, place, reach) {
  store.set({ pointer: place, hover: store.state.path.length ? null : hoverAt(store.state, place, reach) });
}

/** Two fingers: what was between them stays between them. */
function pinch({ store }, fingers, id, now) {
  const still = [...fingers].find(([other]) => other !== id)[1];
  const before = fingers.get(id);
  const moved = panned(store.state.camera, minus(middle(still, now), middle(still, before)));
  store.set({ camera: zoomed(moved, distance(still, now) / (distance(still, before) || 1), middle(still, now)) });
}
