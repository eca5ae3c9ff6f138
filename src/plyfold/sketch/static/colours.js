/**
 * The colours of the pictures. They are chosen in colours.py; the page has them as CSS variables.
 *
 * theme = {ink, paper, dot, accent, wrong, cusp, touch, lit, good, winding: [of 1, 2..], negative: [of -1, -2..], sheets: [..],
 *          "on-winding", "on-negative": ink or white, whichever is read better on these}
 */

const COLOURS = ["ink", "paper", "dot", "accent", "wrong", "cusp", "touch", "lit", "good"];
const LISTS = ["winding", "negative", "on-winding", "on-negative", "sheets"];

/** The colours where an element stands. */
export function themeOf(element) {
  const style = getComputedStyle(element);
  const value = (name) => style.getPropertyValue(`--${name}`).trim();
  return Object.fromEntries([...COLOURS.map((name) => [name, value(name)]), ...LISTS.map((name) => [name, value(name).split(" ")])]);
}

/** The shade for a winding number; the last one stands for everything beyond it. */
const shade = (shades, winding) => shades[Math.min(Math.abs(winding), shades.length) - 1];

/** The fill of a cell, or null where the cloth is not. */
export const windingColour = (theme, winding) =>
  winding === 0 ? null : shade(winding > 0 ? theme.winding : theme.negative, winding);

/** The colour of a number in its cell. */
export const onWinding = (theme, winding) =>
  winding === 0 ? theme.ink : shade(theme[winding > 0 ? "on-winding" : "on-negative"], winding);

export const sheetColour = ({ sheets }, sheet) => sheets[sheet % sheets.length];
