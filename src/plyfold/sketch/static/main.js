// The page put together: the store, the answers, the pictures, the keys, and the drawing that it begins with.

import { actionNamed } from "./actions.js";
import { addressOf, followAnswers } from "./answers.js";
import { button, fillButtons, listenToKeys } from "./buttons.js";
import { createCanvas } from "./canvas.js";
import { copy, finishPath, fit, openDrawing, openFile, openShapes, tell } from "./commands.js";
import * as dialogs from "./dialogs.js";
import { isEmpty, withImage } from "./document.js";
import { followGap } from "./gap.js";
import { begin } from "./history.js";
import { hoverOfSheet, sameHover } from "./hover.js";
import { save, settingsOf, whole } from "./keeping.js";
import { pressCursor, toggleCursor } from "./keyboard.js";
import { lightLayout, paintLayout } from "./layout.js";
import { decode, hasDrawing } from "./link.js";
import { createOffers } from "./offers.js";
import { answersAsText, createPanel } from "./panel.js";
import { followRibbons } from "./ribbons.js";
import { kept, newPlace, recall } from "./storage.js";
import { createStore, lieShown, shown } from "./store.js";
import { followTheme } from "./theme.js";
import { createView3d } from "./view3d.js";

const find = (id) => document.getElementById(id);
const canvas = find("drawing");
const store = createStore();

const page = {
  store,
  place: newPlace(sessionStorage.getItem("plyfold.id") ?? undefined), // where the drawing is kept
  former: null, // the name of the drawing that was open before
  writing: null, // done as soon as a new picture is kept
  question: dialogs.question,
  spaceHeld: false,
  altHeld: false,
  size: () => ({ width: canvas.clientWidth, height: canvas.clientHeight }),
  pan: () => {},
  focusDrawing: () => canvas.focus(),
  toggleCursor: () => toggleCursor(page),
  chooseFile: () => find("file").click(),
  chooseShape: (file) => dialogs.showShapes(page, file),
  showGallery: () => dialogs.showGallery(page),
  showDrawings: () => dialogs.showDrawings(page),
  showExports: () => dialogs.showExports(page),
  showHelp: dialogs.showHelp,
  copyAnswers: async () => tell(page, (await copy(answersAsText(store.state))) ? "The answers are copied." : "The browser does not let this page copy."),
};

// ---- keeping ------------------------------------------------------------------------------------------------------

/** The drawing is kept after every change. A link in the address is no longer true then. */
function followWork() {
  store.follow((state, before) => {
    const changed = state.history.present !== before.history.present;
    if (!changed && state.immersion === before.immersion && state.layering === before.layering && state.gap === before.gap) return;
    save(page);
    if (changed && hasDrawing(location.hash)) history.replaceState(null, "", location.pathname);
  });
  addEventListener("pagehide", () => finishPath(page, false));
  addEventListener("beforeunload", (event) => {
    if (store.state.unkept || page.writing) event.preventDefault();
  });
}

/** Begin with the link in the address, the file that plyfold was started with, or what was drawn last. */
async function restore() {
  const last = recall(localStorage, page.place.id) ?? kept(localStorage)[0];
  if (last) await showKept(last);
  if (hasDrawing(location.hash)) return openLink();
  if (sessionStorage.getItem("plyfold.started")) return undefined;
  sessionStorage.setItem("plyfold.started", "yes");
  const given = await fetch(addressOf("start")).then((response) => response.json()).catch(() => ({}));
  return given.document && openShapes(page, given);
}

/** Another page's drawing is shown too, but goes on under a name of its own when it is changed. */
async function showKept(last) {
  const { document: drawing, place } = await whole(last);
  if (place.id === page.place.id) page.place = place;
  store.set({ history: begin(drawing), name: last.name, ...settingsOf(drawing) });
  fit(page);
}

async function openLink() {
  const fragment = location.hash;
  try {
    const drawing = await decode(fragment);
    if (JSON.stringify(drawing.strokes) !== JSON.stringify(store.state.history.present.strokes)) await openDrawing(page, drawing, "The drawing of the link");
    history.replaceState(null, "", fragment);
  } catch {
    history.replaceState(null, "", location.pathname);
    tell(page, "The link is not complete: it holds no drawing.");
  }
}

// ---- pictures beside the drawing ----------------------------------------------------------------------------------

function followPictures() {
  const onHover = (hover) => {
    const whole = hover && hover.cell === undefined ? hoverOfSheet(store.state, hover.sheets[0] ?? null) : hover;
    if (!sameHover(whole, store.state.hover)) store.set({ hover: whole });
  };
  page.surface = createView3d(find("surface"), onHover);
  const settle = () => {
    page.surface.set({ dark: isDark() });
    const toolbar = find("surface").querySelector("[role=toolbar]");
    if (toolbar) find("surface-tools").append(toolbar); // below the picture, where it hides nothing
  };
  store.follow((state, before) => {
    if (state.mesh !== before.mesh && state.mesh) page.surface.show(state.mesh).then(settle);
    if (!state.mesh) page.surface.say(state.unlifted ?? "");
    find("surface").classList.toggle("empty", !state.mesh);
    find("surface-tools").classList.toggle("absent", !state.mesh);
    find("surface-tools").hidden = state.scene !== "surface";
    if (lieShown(state) !== lieShown(before)) paintLayout(find("layout"), lieShown(state), onHover);
    if (state.hover !== before.hover) {
      lightLayout(find("layout"), state.hover);
      page.surface.set({ highlightSheet: state.hover?.sheets[0] ?? null });
    }
    if (state.scene !== before.scene) showScene(state.scene);
  });
  paintLayout(find("layout"), lieShown(store.state), onHover);
  showScene(store.state.scene);
  for (const tab of document.querySelectorAll("[data-scene]")) {
    tab.addEventListener("click", () => store.set({ scene: tab.dataset.scene }));
    tab.addEventListener("keydown", ({ key }) => key.startsWith("Arrow") && tabByArrow());
  }
}

const isDark = () => document.documentElement.dataset.theme === "dark";

function tabByArrow() {
  actionNamed("scene").perform(page);
  document.querySelector("[role=tab][aria-selected=true]").focus();
}

function showScene(scene) {
  for (const tab of document.querySelectorAll("[data-scene]")) {
    const chosen = tab.dataset.scene === scene;
    tab.setAttribute("aria-selected", String(chosen));
    tab.tabIndex = chosen ? 0 : -1;
    find(tab.dataset.scene).toggleAttribute("hidden", !chosen);
  }
}

// ---- files --------------------------------------------------------------------------------------------------------

function listenToFiles() {
  find("file").addEventListener("change", ({ target }) => {
    if (target.files[0]) openFile(page, target.files[0]);
    target.value = "";
  });
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer.files[0]) openFile(page, event.dataTransfer.files[0]);
  });
}

/** A picture to draw after that has no place yet fills most of the table, or the drawing's box. */
function placeImage(state) {
  const { image } = state.history.present;
  if (!image || image.place) return;
  const picture = new Image();
  picture.addEventListener("load", () => {
    const { width, height } = page.size();
    const size = Math.min((0.8 * width) / picture.naturalWidth, (0.8 * height) / picture.naturalHeight) / store.state.camera.scale;
    const [across, up] = [picture.naturalWidth * size, picture.naturalHeight * size];
    const middle = [(width / 2 - store.state.camera.x) / store.state.camera.scale, (store.state.camera.y - height / 2) / store.state.camera.scale];
    const { history: steps } = store.state;
    const placedImage = withImage(steps.present, { ...image, place: [middle[0] - across / 2, middle[1] - up / 2, across, up] });
    store.set({ history: { ...steps, present: placedImage } });
    tell(page, "Draw after the picture; it stays in the background.", ["dropImage"]);
  });
  picture.addEventListener("error", () => {
    const { history: steps } = store.state;
    store.set({ history: { ...steps, present: withImage(steps.present, null) } });
    tell(page, "The picture cannot be read.");
  });
  picture.src = image.href;
}

function followNotices() {
  const box = find("notice");
  let leaving = 0;
  store.follow((state, before) => {
    if (state.notice === before.notice) return;
    clearTimeout(leaving);
    box.hidden = !state.notice;
    if (!state.notice) return;
    box.replaceChildren(Object.assign(document.createElement("span"), { textContent: state.notice.text }));
    box.append(...state.notice.actions.map((name) => button(page, actionNamed(name))));
    leaving = setTimeout(() => store.set({ notice: null }), state.notice.actions.length ? 10000 : 5000);
  });
}

/** What cannot be kept is told for as long as that is so. */
function followUnkept() {
  const box = find("unkept");
  box.append(...["saveFile", "drawings"].map((name) => button(page, actionNamed(name))));
  store.follow(({ unkept }, before) => {
    if (unkept === before.unkept) return;
    box.hidden = !unkept;
    box.querySelector("span").textContent = unkept ?? "";
  });
}

/** Whether keys are meant for the drawing, not for a button. */
const isDrawing = (target) => target === canvas || target === document.body;

function listenToSpace() {
  const hold = (held) => ({ key, target }) => {
    if (key === " " && isDrawing(target)) page.spaceHeld = held;
  };
  addEventListener("keydown", hold(true));
  addEventListener("keyup", hold(false));
}

function endPath(event) {
  const { path, tool } = store.state;
  if (tool !== "points" || !path.length || !["Enter", "Escape"].includes(event.key)) return false;
  finishPath(page, event.key === "Enter");
  return true;
}

fillButtons(page);
dialogs.listenToDialog();
createPanel(page);
createCanvas(page, canvas);
followTheme(page);
followNotices();
followUnkept();
followPictures();
createOffers(page, find("offers"));
followGap(page, find("gap"), find("gap-value"));
followRibbons(page, find("ribbon-width"), find("width"), find("width-value"));
listenToFiles();
listenToSpace();
listenToKeys(page, (event) => isDrawing(event.target) && (pressCursor(page, event) || endPath(event)));
store.follow((state, before) => state.history.present.image !== before.history.present.image && placeImage(state));
fit(page);
await restore();
if (isEmpty(shown(store.state))) fit(page);
followWork();
followAnswers(store);
addEventListener("hashchange", () => hasDrawing(location.hash) && openLink());
document.documentElement.dataset.ready = "yes";
