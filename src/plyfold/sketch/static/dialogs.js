// What opens over the page: the gallery, drawings kept, formats to save in, and help. One dialog element serves all.

import { toScreen, fitted } from "./camera.js";
import { ACTIONS } from "./actions.js";
import { SILENT, addressOf } from "./answers.js";
import { button, actionsIn } from "./buttons.js";
import { openDrawing, openKept, openShape, tell } from "./commands.js";
import { allPoints } from "./document.js";
import { save } from "./keeping.js";
import { CURSOR_KEYS } from "./keyboard.js";
import { shownKey } from "./keys.js";
import { discardPicture } from "./pictures.js";
import { discard, kept } from "./storage.js";

const find = (id) => document.getElementById(id);
const make = (tag, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};

function show(title, ...content) {
  find("dialog-title").textContent = title;
  find("dialog-body").replaceChildren(...content);
  find("dialog").showModal();
  find("dialog").scrollTop = 0;
  find("dialog-body").scrollTop = 0;
}

export const closeDialog = () => find("dialog").close();

export function listenToDialog() {
  find("dialog-close").addEventListener("click", closeDialog);
  find("dialog").addEventListener("click", (event) => {
    if (event.target === find("dialog")) closeDialog();
  });
}

/** Ask something. @returns the choice, or null if the dialog was closed without one. */
export function question(title, text, choices) {
  return new Promise((resolve) => {
    let chosen = null;
    const buttons = choices.map((textContent) => make("button", { type: "button", textContent }));
    buttons.forEach((made) => made.addEventListener("click", () => {
      chosen = made.textContent;
      closeDialog();
    }));
    const onClose = () => {
      if (find("dialog").open) return; // this was the dialog before
      find("dialog").removeEventListener("close", onClose);
      resolve(chosen);
    };
    find("dialog").addEventListener("close", onClose);
    show(title, make("p", { textContent: text }), make("div", { className: "choices" }, ...buttons));
  });
}

/** A small picture of strokes. */
function thumbnail(document_) {
  const namespace = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(namespace, "svg");
  svg.setAttribute("viewBox", "0 0 120 90");
  svg.setAttribute("aria-hidden", "true");
  const camera = fitted(allPoints(document_), 120, 90);
  for (const { points, closed } of document_.strokes) {
    const path = svg.appendChild(document.createElementNS(namespace, "path"));
    const places = points.map((point) => toScreen(camera, point).map((value) => value.toFixed(1)).join(" "));
    path.setAttribute("d", `M${places.join("L")}${closed ? "Z" : ""}`);
  }
  return svg;
}

function card(document_, title, detail, onOpen) {
  const open = make("button", { type: "button", className: "card" }, thumbnail(document_), make("strong", { textContent: title }), make("span", { textContent: detail }));
  open.addEventListener("click", () => {
    closeDialog();
    onOpen();
  });
  return open;
}

export async function showGallery(page) {
  const { curves } = await fetch(addressOf("gallery")).then((response) => response.json()).catch(() => ({}));
  if (!curves) return tell(page, `${SILENT}: start plyfold sketch again.`);
  const cards = curves.map(({ name, title, document: drawing, crossings, immersions }) => {
    const detail = `${name}: ${crossings} crossing${crossings === "1" ? "" : "s"}, ${immersions === "0" ? "no disk" : `${immersions} immersion${immersions === "1" ? "" : "s"}`}`;
    return card(drawing, title, detail, () => openDrawing(page, drawing, name));
  });
  return show("Curves to begin with", make("div", { className: "cards" }, ...cards));
}

/** The shapes of a file, to pick one from, or all of them as one outline. */
export function showShapes(page, { shapes, ...whole }) {
  const all = card(whole.document, "All as one outline", strokesOf(whole.document), () => openShape(page, whole));
  const cards = shapes.map((shape, i) => {
    const title = shape.name || `Shape ${i + 1}`;
    return card(shape.document, title, strokesOf(shape.document), () => openShape(page, { ...shape, name: `${whole.name}: ${title}` }));
  });
  show(`${whole.name} has ${shapes.length} shapes`, make("div", { className: "cards" }, all, ...cards));
}

/** The hour of today's drawings, and the day of older ones. */
function timeOf(date, now = new Date()) {
  const hour = date.toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" });
  if (date.toDateString() === now.toDateString()) return `Today, ${hour}`;
  const year = date.getFullYear() === now.getFullYear() ? {} : { year: "numeric" };
  return `${date.toLocaleDateString([], { day: "numeric", month: "short", ...year })}, ${hour}`;
}

function strokesOf({ strokes, image }) {
  if (!strokes.length) return image ? "Picture to draw after" : "Empty drawing";
  if (strokes.length > 1) return `${strokes.length} ${strokes.every(({ closed }) => closed) ? "loops" : "strokes"}`;
  return strokes[0].closed ? "Loop" : "Open stroke";
}

export function showDrawings(page) {
  const others = kept(localStorage).filter(({ id }) => id !== page.place.id);
  const cards = others.map((other) => {
    const { id, name, saved, document: drawing } = other;
    const when = timeOf(new Date(saved));
    const discardButton = make("button", { type: "button", className: "discard", textContent: "Discard" });
    discardButton.setAttribute("aria-label", `Discard the drawing of ${when}`);
    const item = make("div", { className: "kept" }, card(drawing, name ?? strokesOf(drawing), when, () => openKept(page, other)), discardButton);
    discardButton.addEventListener("click", () => {
      discard(localStorage, id);
      discardPicture(id).catch(() => {}); // where no picture can be kept, there is none
      item.remove();
      save(page); // there may be room now
    });
    return item;
  });
  const nothing = make("p", { textContent: "No other drawing is kept in this browser yet." });
  show("Drawings kept in this browser", cards.length ? make("div", { className: "cards" }, ...cards) : nothing);
}

export function showExports(page) {
  const buttons = actionsIn("exports").map((action) => button(page, action));
  buttons.forEach((made) => made.addEventListener("click", closeDialog));
  show("Save as", make("div", { className: "formats" }, ...buttons));
}

const SURFACE_KEYS = [
  ["← → ↑ ↓", "Turn it"],
  ["+  -", "Come nearer, go back"],
  ["T  P", "From above, as it is drawn; in perspective"],
  ["F", "Show all of it"],
  ["X", "See through it"],
];
const GROUPS = { tools: "Tools", history: "History", change: "Change", view: "View", answers: "Answers", offers: "Offers", surface: "Surface", file: "File", exports: "Save" };

export function showHelp() {
  const tables = Object.entries(GROUPS).map(([group, title]) => {
    const actions = ACTIONS.filter((action) => action.group === group && action.keys.length);
    return keyTable(title, actions.map(({ keys, hint }) => [keys.map(shownKey).join("  "), hint]));
  });
  show("Keys", make("div", { className: "keys" }, ...tables, keyTable("With the keyboard cursor (K)", CURSOR_KEYS), keyTable("In the surface", SURFACE_KEYS)));
}

function keyTable(title, rows) {
  const list = make("dl", {}, ...rows.flatMap(([keys, hint]) => [
    make("dt", {}, ...keys.split("  ").map((key) => make("kbd", { textContent: key }))), make("dd", { textContent: hint })]));
  return make("section", {}, make("h3", { textContent: title }), list);
}
