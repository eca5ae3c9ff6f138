// Buttons made from actions, and the keys that belong to them.

import { ACTIONS, actionNamed, actionOf, isEnabled } from "./actions.js";
import { hasIcon, icon } from "./icons.js";
import { keyName, shownKey } from "./keys.js";
import { cancel } from "./tools.js";

/** Do what an action says, if it can be done now. */
export function perform(page, action) {
  if (isEnabled(action, page.store.state)) action.perform(page);
}

/** A real button for an action; it follows the store. */
export function button(page, action, { label = true } = {}) {
  const made = document.createElement("button");
  Object.assign(made, { type: "button", title: tip(action) });
  made.dataset.action = action.name;
  if (action.keys.length) made.setAttribute("aria-keyshortcuts", action.keys.map((key) => key.replace("Ctrl", "Control")).join(" "));
  if (hasIcon(action.name)) made.append(icon(action.name));
  const words = Object.assign(document.createElement("span"), { textContent: action.label, className: label ? "label" : "unseen" });
  made.append(words);
  made.addEventListener("click", () => perform(page, action));
  refresh(made, action, page.store.state);
  return made;
}

const tip = ({ hint, keys }) => (keys.length ? `${hint} (${shownKey(keys[0])})` : hint);

function refresh(made, action, state) {
  const disabled = !isEnabled(action, state);
  if (made.disabled !== disabled) made.disabled = disabled;
  if (action.labelNow) made.lastChild.textContent = action.labelNow(state);
  if (action.pressed) made.setAttribute("aria-pressed", String(action.pressed(state)));
}

export const actionsIn = (group) => ACTIONS.filter((action) => action.group === group && !action.hidden);

const WITHOUT_LABEL = new Set(["tools", "history", "view"]);

/** Fill every place in the page that asks for a group of buttons, and keep all buttons up to date. */
export function fillButtons(page) {
  for (const place of document.querySelectorAll("[data-buttons]")) {
    const group = place.dataset.buttons;
    const actions = group === "copy" ? [actionNamed("copyAnswers")] : actionsIn(group);
    place.append(...actions.map((action) => button(page, action, { label: !WITHOUT_LABEL.has(group) })));
  }
  page.store.follow((state) => {
    for (const made of document.querySelectorAll("[data-action]")) refresh(made, actionNamed(made.dataset.action), state);
  });
}

const WRITING = "input:not([type=range]), textarea, select";

/** Keys perform actions, unless something else on the page wants them: a field, an open dialog, the 3D view. */
export function listenToKeys(page, pressFirst) {
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.target.closest(WRITING) || document.querySelector("dialog[open]")) return;
    if (event.key === "Escape" && page.store.state.busy) return cancel(page);
    if (pressFirst(event)) return event.preventDefault();
    const isArrow = event.key.startsWith("Arrow");
    if (isArrow && event.target.closest("[type=range], [role=tab], #surface")) return undefined;
    const action = actionOf(keyName(event), page.store.state);
    if (!action) return undefined;
    event.preventDefault();
    return perform(page, action);
  });
}
