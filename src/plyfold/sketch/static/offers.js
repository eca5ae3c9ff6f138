// The offers: buttons beside the cross that says "no", and what they would do while they are pointed at.

import { actionNamed } from "./actions.js";
import { actionsIn, button } from "./buttons.js";
import { toScreen } from "./camera.js";
import { offersShown } from "./store.js";

const ROOM = 18; // pixels between the cross and the buttons

/** A button that shows what it would do: under the pointer, and while the keyboard is there. */
export function previewing({ store }, made) {
  const { preview } = actionNamed(made.dataset.action);
  made.setAttribute("aria-describedby", "sentence"); // which says what it would do
  const show = (previewed) => () => store.state.previewed !== previewed && store.set({ previewed });
  for (const kind of ["pointerenter", "focus"]) made.addEventListener(kind, show(preview));
  for (const kind of ["pointerleave", "blur"]) made.addEventListener(kind, show(null));
  return made;
}

export function createOffers(page, box) {
  box.append(...actionsIn("offers").map((action) => previewing(page, button(page, action))));
  page.store.follow((state) => {
    const offers = offersShown(state);
    box.hidden = !offers.length || state.busy || state.path.length > 0;
    if (!box.hidden) place(page, box, state.answer.verdict.where[0] ?? offers[0].where[0]);
  });
}

/** Beside the cross, on that side where there is room; where the page is small, the style sheet puts them in a row. */
function place(page, box, cross) {
  const { width, height } = page.size();
  const [x, y] = cross ? toScreen(page.store.state.camera, cross) : [width / 2, ROOM];
  const right = x + ROOM + box.offsetWidth < width - FREE.right ? x + ROOM : x - ROOM - box.offsetWidth;
  const below = y + ROOM + box.offsetHeight < height - FREE.bottom ? y + ROOM : y - ROOM - box.offsetHeight;
  box.style.left = `${within(right, FREE.left, width - FREE.right - box.offsetWidth)}px`;
  box.style.top = `${within(below, FREE.top, height - FREE.bottom - box.offsetHeight)}px`;
}

// Where the table's other buttons lie.
const FREE = { left: 76, right: 12, top: 72, bottom: 72 };
const within = (value, least, most) => Math.max(least, Math.min(most, value));
