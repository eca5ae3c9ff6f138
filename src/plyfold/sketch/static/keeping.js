// Keeping the drawing that is open: its strokes are written at once after every change, its picture when it is new.
// While something cannot be kept, `unkept` in the store says so.

import { isEmpty, withImage } from "./document.js";
import { keepPicture, recallPicture } from "./pictures.js";
import { keep } from "./storage.js";

const NO_ROOM = "This drawing is not kept: the browser has no room left.";
const NO_ROOM_FOR_PICTURE = "The picture is not kept: the browser has no room left for it.";
const TWIN = "This drawing is open in another page too. Here it goes on as a drawing of its own.";

/** The drawing with the settings that belong to it. */
export function complete({ store }) {
  const { history, immersion, layering, gap } = store.state;
  const { immersion: _, layering: __, gap: ___, ...view } = history.present.view;
  const settings = { ...(immersion === "0" ? {} : { immersion }), ...(layering === "0" ? {} : { layering }), ...(gap ? { gap } : {}) };
  return { ...history.present, view: { ...view, ...settings } };
}

/** The settings that a drawing comes with. */
export const settingsOf = ({ view }) => {
  const { immersion = "0", layering = "0", gap = null } = view ?? {};
  return { immersion, layering, gap };
};

/** Keep the drawing. Where its picture is new, `page.writing` is done as soon as that is kept too, or cannot be. */
export function save(page) {
  const { store } = page;
  const document = complete(page);
  if (isEmpty(document)) return tellUnkept(page, null);
  const place = keep(localStorage, page.place, document, store.state.name);
  if (!place) return tellUnkept(page, NO_ROOM);
  if (place.id !== page.place.id && page.place.text) store.set({ notice: { text: TWIN, actions: [] } });
  page.place = place;
  sessionStorage.setItem("plyfold.id", place.id);
  if (!document.image || document.image.href === place.picture) return tellUnkept(page, null);
  return savePicture(page, document.image.href);
}

function tellUnkept({ store }, unkept) {
  if (store.state.unkept !== unkept) store.set({ unkept });
}

function savePicture(page, href) {
  const { id } = page.place;
  const mine = (page.writing = keepNewPicture(page, href).then((isKept) => {
    if (page.writing === mine) page.writing = null;
    if (page.place.id === id) tellUnkept(page, isKept ? null : NO_ROOM_FOR_PICTURE);
  }));
}

/** Keep a picture for the drawing that is open. @returns whether there is room for it. */
export async function keepNewPicture(page, href) {
  const { id } = page.place;
  try {
    await keepPicture(id, href);
  } catch {
    return false;
  }
  if (page.place.id === id) page.place = { ...page.place, picture: href };
  return true;
}

/** Of a drawing that is kept: the document with its picture, and the place. */
export async function whole({ id, text, document }) {
  const { image } = document;
  if (!image || image.href) return { document, place: { id, text, picture: null } };
  const picture = (await recallPicture(id).catch(() => null)) ?? null;
  return { document: withImage(document, picture && { ...image, href: picture }), place: { id, text, picture } };
}
