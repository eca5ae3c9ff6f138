/** The colours of the pictures: sheets told apart by colour-blind eyes, winding numbers from light to strong. */

const WINDING = ["#dcebf8", "#abcff1", "#76aee4", "#4889d0", "#2768b0", "#134886"];
const NEGATIVE = ["#fbd9d6", "#f2a49d", "#dd6a66", "#bf3a44", "#9b1c30"];
// On a dark page from dim to bright.
const WINDING_AT_NIGHT = ["#1c3a5e", "#24568d", "#2f75ba", "#4a95da", "#78b6ec", "#abd4f3"];
const NEGATIVE_AT_NIGHT = ["#54262c", "#823039", "#b04550", "#d56f73", "#f0a6a2"];
const SHEETS = ["#2f7fc1", "#eaa221", "#1f9e7a", "#cf7fae", "#7cc3ea", "#d4582a", "#e9d94f", "#63539f"];

/** The fill of a cell, or null where the cloth is not. */
export function windingColour(winding, night = false) {
  const [above, below] = night ? [WINDING_AT_NIGHT, NEGATIVE_AT_NIGHT] : [WINDING, NEGATIVE];
  const shades = winding > 0 ? above : below;
  return winding === 0 ? null : shades[Math.min(Math.abs(winding), shades.length) - 1];
}

export const sheetColour = (sheet) => SHEETS[sheet % SHEETS.length];

/** Ink or white, whichever is read better on a winding number's colour. */
export function onWinding(winding, night = false) {
  const dark = night ? winding < 4 && winding > -4 : winding > 3 || winding < -2;
  return dark ? "#ffffff" : "#1d2638";
}
