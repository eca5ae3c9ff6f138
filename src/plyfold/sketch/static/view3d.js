/** The lifted surface beside the drawing, shown by the very module that exported 3D pages use. */

const MODULE = "/draw/viewer.js";

/**
 * @param element  an element of class "viewer"
 * @param onHover  told {cell, sheets, border} or null
 * @returns {show(mesh), say(sentence), set(options), top(), fit()}
 */
export function createView3d(element, onHover) {
  const status = element.querySelector("[role=status]");
  let handle = null;
  let newest = 0;
  const say = (sentence) => {
    status.textContent = sentence;
    element.classList.toggle("waiting", Boolean(sentence));
  };
  requestIdleCallback(() => import(MODULE)); // three.js is large: the page is there first, and the first surface finds it
  element.addEventListener("plyfold-hover", ({ detail }) =>
    onHover(detail && { cell: detail.cell, sheets: detail.sheet === null ? [] : [detail.sheet], border: detail.border }));
  return {
    say,
    async show(mesh) {
      const mine = (newest += 1);
      const { show } = await import(MODULE);
      if (mine !== newest) return;
      say("");
      if (handle) handle.update(mesh);
      else handle = show(element, mesh);
    },
    set: (options) => handle?.set(options),
    top: () => handle?.topView(),
    fit: () => handle?.fit(),
  };
}
