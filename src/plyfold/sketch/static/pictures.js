// The pictures to draw after, each under the name of its drawing, in the browser's database: drawings are written at
// once, into a store that is too small for photographs.

const DATABASE = "plyfold";
const STORE = "pictures";

/** @throws if the browser has no room for it, or keeps no databases. */
export const keepPicture = (id, href) => inStore("readwrite", (pictures) => pictures.put(href, id));

/** @returns its data address, or undefined if none is kept under this name. */
export const recallPicture = (id) => inStore("readonly", (pictures) => pictures.get(id));

export const discardPicture = (id) => inStore("readwrite", (pictures) => pictures.delete(id));

async function inStore(mode, ask) {
  const database = await opened();
  try {
    return await new Promise((resolve, reject) => {
      const transaction = database.transaction(STORE, mode);
      const asked = ask(transaction.objectStore(STORE));
      transaction.addEventListener("complete", () => resolve(asked.result));
      transaction.addEventListener("abort", () => reject(transaction.error));
    });
  } finally {
    database.close();
  }
}

const opened = () => new Promise((resolve, reject) => {
  const opening = indexedDB.open(DATABASE, 1);
  opening.addEventListener("upgradeneeded", () => opening.result.createObjectStore(STORE));
  opening.addEventListener("success", () => resolve(opening.result));
  opening.addEventListener("error", () => reject(opening.error));
});
