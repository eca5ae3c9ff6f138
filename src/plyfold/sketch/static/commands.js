// What can be done to the page: small steps that actions, tools and dialogs share. Each takes the page,
// {store, size(), question(), place, former, writing}, and changes its store.

import { PROTOCOL, SILENT, addressOf, ask } from "./answers.js";
import { fitted } from "./camera.js";
import { crossingCode } from "./crossings.js";
import { indexAt, nextIndex } from "./cusps.js";
import {
  EMPTY, addStroke, allPoints, ends, isEmpty, joins, markCusp, paths, reversed, rounded, vertexAt, withImage, withTurned,
} from "./document.js";
import { begin, record, redo, undo } from "./history.js";
import { complete, keepNewPicture, save, settingsOf, whole } from "./keeping.js";
import { LONGEST_LINK, asText, encode } from "./link.js";
import { answerShown, offerOf, shown } from "./store.js";
import { offeredDocument } from "./trials.js";
import { newPlace, recall } from "./storage.js";
import { counted } from "./wording.js";

export const tell = ({ store }, text, actions = []) => store.set({ notice: { text, actions } });

// ---- editing ------------------------------------------------------------------------------------------------------

export function edit({ store }, document) {
  store.set({ history: record(store.state.history, document), preview: null, ahead: [], notice: lastingNotice(store.state) });
}

/** The notice, unless its button would by now undo something else than it tells of. */
const lastingNotice = ({ notice }) => (notice?.actions.includes("undo") ? null : notice);

/** The joins of the drawing as it is, as far as they are known. */
export const currentJoins = ({ store }) => joins(shown(store.state).strokes, answerShown(store.state)?.repairs ?? []);

const codeOf = (page, document) => crossingCode(paths(document, movedJoins(page, document)));

/** The same joins, with the ends where they are in the changed document. */
function movedJoins(page, document) {
  const [before, after] = [ends(page.store.state.history.present.strokes), ends(document.strokes)];
  const bridged = joins(page.store.state.history.present.strokes, page.store.state.answer?.repairs ?? []);
  return before.length === after.length ? bridged.map((pair) => pair.map((end) => after[before.indexOf(end)])) : [];
}

/** Whether the lock allows a change: the crossing code stays as it is. */
export function allowed(page, document) {
  const { locked, history } = page.store.state;
  return !locked || codeOf(page, document) === codeOf(page, history.present);
}

export function editIfAllowed(page, document) {
  if (allowed(page, document)) edit(page, document);
  else tell(page, "Locked: that would change the crossings.", ["lock"]);
}

/** Put the points in the making into the drawing. */
export function finishPath(page, closed) {
  const { path, history } = page.store.state;
  page.store.set({ path: [], ahead: [] });
  if (path.length > 1) edit(page, addStroke(history.present, { points: path, closed: closed && path.length > 2 }));
}

/** Turn a loop round; the whole drawing, if none is named. */
export function reverse(page, stroke) {
  const { present } = page.store.state.history;
  edit(page, stroke === null ? reversed(present) : withTurned(present, [stroke]));
  if (stroke !== null) tell(page, "The loop runs the other way round.");
}

// ---- cusps --------------------------------------------------------------------------------------------------------

const TURNS = ["The point is no cusp any more.", "A cusp: the surface turns once more round it than is seen.", "A cusp: two turns more than is seen.", "A cusp: three turns more than is seen."];

/** One turn more at a point; none after the last one, and where the one that is there is refused. */
export function cycleCusp(page, document, { stroke, vertex }) {
  const { verdict } = answerShown(page.store.state) ?? {};
  const refused = verdict?.reason === "cusp" && vertexAt(document, verdict.where[0], Infinity);
  const index = refused.stroke === stroke && refused.vertex === vertex ? 0 : nextIndex(indexAt(document.strokes[stroke], vertex));
  edit(page, markCusp(document, { stroke, vertex }, index));
  page.store.set({ selected: { stroke, vertex } });
  tell(page, TURNS[index]);
}

// ---- offers -------------------------------------------------------------------------------------------------------

export function takeOffer(page, kind) {
  const offer = offerOf(page.store.state, kind);
  edit(page, offeredDocument(page.store.state, offer));
  tell(page, DONE[kind], ["undo"]);
}

const DONE = { repair: "It is changed as offered.", cusps: "The cusps are marked.", pieces: "These are the pieces." };

export function step(page, direction) {
  const { store } = page;
  const { path, ahead, busy, history } = store.state;
  if (busy) return;
  if (path.length && direction === undo) store.set({ path: path.slice(0, -1), ahead: [path.at(-1), ...ahead] });
  else if (ahead.length && direction === redo) store.set({ path: [...path, ahead[0]], ahead: ahead.slice(1) });
  else store.set({ history: direction(history), preview: null, selected: null, carried: null, ahead: [], notice: lastingNotice(store.state) });
}

export const undoStep = (page) => step(page, undo);
export const redoStep = (page) => step(page, redo);

// ---- walking ------------------------------------------------------------------------------------------------------

/** One further, or back; the server takes −1 for the last and starts again after it. */
export function walk({ store }, kind, by) {
  const { lie } = store.state;
  const count = lie?.[`${kind}s`];
  if (!lie || count === null || count === undefined || BigInt(count) < 2n) return;
  const next = (BigInt(store.state[kind]) + BigInt(by) + BigInt(count)) % BigInt(count);
  store.set(kind === "immersion" ? { immersion: String(next), layering: "0" } : { layering: String(next) });
}

// ---- opening ------------------------------------------------------------------------------------------------------

/** Show another drawing. The one before stays kept under its own name, and there is a way back. */
export async function openDrawing(page, document, name = null, place = newPlace()) {
  const { store } = page;
  finishPath(page, false);
  const hadWork = !isEmpty(store.state.history.present);
  if (hadWork && !(await mayLeave(page))) return;
  page.former = hadWork && !store.state.unkept ? page.place.id : null;
  page.place = place;
  store.set({
    history: begin(document), name, preview: null, path: [], ahead: [], selected: null, carried: null, answer: null, answered: null, lie: null,
    mesh: null, unlifted: null, ...settingsOf(document), hover: null, notice: null, tool: toolFor(document, store.state),
  });
  fit(page);
  if (page.former) tell(page, `${name ?? "A new drawing"} is open. The drawing before is kept.`, ["back"]);
}

const SAVE = "Save it as a file";
const LEAVE = "Leave it behind";

/** Whether the drawing may make way for another: if it is kept, or else if its owner says so. */
async function mayLeave(page) {
  save(page);
  await page.writing;
  const { unkept } = page.store.state;
  const choice = unkept && (await page.question("Leave this drawing behind?", unkept, [SAVE, LEAVE]));
  if (choice === SAVE) saveFile(page);
  return !unkept || choice !== null;
}

/** An empty paper is to be drawn on: tools that only change what is there make way. */
function toolFor(document, { tool, cursor }) {
  return isEmpty(document) && !["draw", "points"].includes(tool) ? (cursor ? "points" : "draw") : tool;
}

/** Show a drawing that is kept. */
export async function openKept(page, kept) {
  const { document, place } = await whole(kept);
  await openDrawing(page, document, kept.name, place);
}

export async function goBack(page) {
  const former = page.former && recall(localStorage, page.former);
  if (former) await openKept(page, former);
}

export function fit({ store, size }) {
  const { width, height } = size();
  store.set({ camera: fitted(allPoints(shown(store.state)), width, height) });
}

/** Open a file that was chosen or dropped. */
export async function openFile(page, file) {
  const headers = { "X-File-Name": encodeURIComponent(file.name), "X-Plyfold-Page": "open" };
  const response = await fetch(addressOf("open"), { method: "POST", headers, body: file }).catch(() => null);
  const answer = await response?.json();
  if (!answer || answer.error) return tell(page, answer?.error.sentence ?? SILENT);
  const { document: { strokes, image } } = answer;
  return strokes.length || !image ? openShapes(page, answer) : usePicture(page, image);
}

/** Open what was found in a file; where there are several shapes, the one that is chosen. */
export const openShapes = (page, found) => (found.shapes.length > 1 ? page.chooseShape(found) : openShape(page, found));

/** Open what a file holds, or a part of it, and say what was left out or changed. */
export async function openShape(page, { name, document, repairs }) {
  await openDrawing(page, { ...EMPTY, ...document }, name);
  const { notice } = page.store.state;
  if (repairs.length) tell(page, [notice?.text, `In the file: ${counted(repairs.map(({ kind }) => kind))}.`].filter(Boolean).join(" "), notice?.actions);
}

const USE = "Use it all the same";
const NO_PICTURE = "Leave the picture";
const TOO_LARGE = "The browser has no room left to keep it: it would go with this page.";

/** Put a picture behind the drawing, as soon as it is kept; where it cannot be, only if that is wanted. */
async function usePicture(page, image) {
  const isKept = await keepNewPicture(page, image.href);
  if (!isKept && (await page.question("Draw after this picture?", TOO_LARGE, [USE, NO_PICTURE])) !== USE) return;
  edit(page, withImage(page.store.state.history.present, image));
}

// ---- giving away --------------------------------------------------------------------------------------------------

/** The drawing as it is; or rounded, if it is too long for a link else and the answers stay as they are. */
async function linkOf(page) {
  const document = complete(page);
  const fragment = await encode(document);
  const answer = answerShown(page.store.state);
  if (fragment.length <= LONGEST_LINK || !answer) return fragment;
  const shorter = rounded(document);
  const told = await ask("look", { strokes: shorter.strokes });
  return told?.code === answer.code && told.verdict.immersions === answer.verdict.immersions ? encode(shorter) : fragment;
}

export async function share(page) {
  const fragment = await linkOf(page);
  if (fragment.length > LONGEST_LINK) {
    return tell(page, "This drawing is too long for a link. Save it as a file and send that instead.", ["saveFile"]);
  }
  history.replaceState(null, "", fragment);
  const copied = await copy(location.href);
  return tell(page, copied ? "The link is copied. It holds the whole drawing." : "The link is in the address bar. It holds the whole drawing.");
}

export const copy = (text) => navigator.clipboard.writeText(text).then(() => true, () => false);

export async function exportAs(page, format) {
  const { immersion, layering, gap } = page.store.state;
  tell(page, `Writing ${format.toUpperCase()} …`);
  const body = JSON.stringify({ version: PROTOCOL, document: complete(page), format, immersion, layering, gap });
  const response = await fetch(addressOf("export"), { method: "POST", headers: { "Content-Type": "application/json" }, body }).catch(() => null);
  if (!response?.ok || response.headers.get("Content-Disposition") === null) {
    const answer = await response?.json().catch(() => null);
    return tell(page, answer?.error?.sentence ?? SILENT);
  }
  download(await response.blob(), fileName(page.store.state.name, format));
  return tell(page, `${fileName(page.store.state.name, format)} is saved.`);
}

/** JSON needs no server: what is drawn can always be saved. */
export function saveFile(page) {
  download(new Blob([asText(complete(page))], { type: "application/json" }), fileName(page.store.state.name, "json"));
}

const fileName = (name, format) => `${(name ?? "drawing").replace(/\.[^.]*$/, "").replace(/[^\p{L}\p{N}-]+/gu, "-")}.${format === "tikz" ? "tex" : format}`;

function download(blob, name) {
  const anchor = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(anchor.href), 10000);
}

