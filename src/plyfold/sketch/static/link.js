// A drawing in the fragment of an address: JSON, deflated, in the letters that addresses may have.

import { cuspsOf, withCusps } from "./cusps.js";
import { VERSION } from "./document.js";

const PREFIX = "#d=";

/** Links beyond this length are cut by mail programs and chats: the drawing goes into a file instead. */
export const LONGEST_LINK = 8000;

/** Whatever stands there may be meant as a drawing: if it is none, the page says so. */
export const hasDrawing = (fragment) => fragment.length > 1;

/** The drawing as a file. Numbers are written so that they come back as they were, whatever their scale. */
export const asText = ({ strokes, image, view }) => JSON.stringify({ plyfold: VERSION, strokes, image, view });

export async function encode(document) {
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(asText(document)));
  return PREFIX + btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** @returns the document. @throws if the fragment is not a whole drawing. */
export async function decode(fragment) {
  if (!fragment.startsWith(PREFIX)) throw new Error("this is no drawing");
  const letters = fragment.slice(PREFIX.length).replaceAll("-", "+").replaceAll("_", "/");
  const bytes = Uint8Array.from(atob(letters), (letter) => letter.charCodeAt(0));
  const text = new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), bytes));
  return checked(JSON.parse(text));
}

/**
 * What comes from elsewhere is taken only if it is a drawing: finite points, cusps at some of them, and nothing else.
 * Version 1 had no cusps.
 */
export function checked(value) {
  const isKnown = Number.isInteger(value?.plyfold) && value.plyfold >= 1 && value.plyfold <= VERSION;
  if (!isKnown || !Array.isArray(value.strokes) || !value.strokes.every(isStroke)) throw new Error("this is no drawing");
  const strokes = value.strokes.filter(({ points }) => points.length).map(({ points, closed, cusps }) => (
    withCusps({ points, closed: Boolean(closed) }, cuspsOf({ cusps: cusps ?? {} }))));
  return { plyfold: VERSION, strokes, image: checkedImage(value.image), view: { ...value.view } };
}

const isPoint = (point) => Array.isArray(point) && point.length === 2 && point.every(Number.isFinite);
const isStroke = (stroke) => Array.isArray(stroke?.points) && stroke.points.every(isPoint)
  && cuspsOf({ cusps: stroke.cusps ?? {} }).every(({ vertex, index }) => vertex in stroke.points && Number.isInteger(index) && index >= 0);

function checkedImage(image) {
  if (!/^data:image\/(png|jpeg|gif|webp);/.test(image?.href ?? "")) return null;
  return { href: image.href, place: image.place ?? null, opacity: Number(image.opacity ?? 0.5) };
}

async function through(transform, bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(transform);
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
