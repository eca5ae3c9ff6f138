// The names of keys, as they are written in actions, tooltips and help.

const SHOWN = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Delete: "Del", " ": "Space" };

/** The name of what was pressed: "D", "Shift+C", "Ctrl+Z". On a Mac, Command counts as Ctrl. */
export function keyName({ key, ctrlKey, metaKey, altKey, shiftKey }) {
  const letter = key.length === 1 ? key.toUpperCase() : key;
  const isLetter = /^[A-Z]$/.test(letter) || key.length > 1;
  const held = [[ctrlKey || metaKey, "Ctrl"], [altKey, "Alt"], [shiftKey && isLetter, "Shift"]];
  return [...held.filter(([on]) => on).map(([, name]) => name), letter].join("+");
}

export const shownKey = (key) => key.split(/\+(?=.)/).map((part) => SHOWN[part] ?? part).join("+");
