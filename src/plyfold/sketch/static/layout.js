/**
 * The disk layout (§2.2 of the paper) as a drawing in SVG: the round disk with the borders on its rim, and for each sheet
 * with borders of its own the region that they span.
 */

import { sheetColour, themeOf } from "./colours.js";

const NAMESPACE = "http://www.w3.org/2000/svg";

function element(name, attributes) {
  const made = document.createElementNS(NAMESPACE, name);
  Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
  return made;
}

const pathThrough = (points) => `M${points.map(([x, y]) => `${x.toFixed(4)} ${(-y).toFixed(4)}`).join("L")}`;

const words = ({ sheet, cell, borders }) =>
  `Sheet ${sheet} over cell ${cell}: border${borders.length > 1 ? "s" : ""} ${borders.join(", ")}`;

function paintNothing(svg, sentence) {
  svg.append(element("text", { class: "nothing" }));
  svg.lastChild.textContent = sentence;
}

/**
 * Draw the layout of `lie` into an <svg>; where there is none, it says so. `onHover({cell, sheets, border} | null)` is told what the
 * pointer is over.
 */
export function paintLayout(svg, lie, onHover) {
  const theme = themeOf(svg);
  const colourOf = (sheet) => sheetColour(theme, sheet);
  svg.replaceChildren();
  svg.setAttribute("viewBox", "-1.12 -1.12 2.24 2.24");
  if (!lie?.layout) return paintNothing(svg, lie ? "Only a disk has a layout." : "The layout of a disk appears here.");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", `Disk layout: ${lie.layout.groups.length} sheets with borders of their own.`);
  svg.append(element("circle", { r: 1, class: "rim" }));
  const sheetOf = new Map(lie.sheets.flatMap((borders, sheet) => borders.map((border) => [border, sheet])));
  const hovers = (part, hover) => {
    part.addEventListener("pointerenter", () => onHover(hover));
    part.addEventListener("pointerleave", () => onHover(null));
    return part;
  };
  lie.layout.groups.forEach((group) => svg.append(hovers(regionOf(group, colourOf(group.sheet)), hoverOf(group))));
  lie.layout.borders.forEach((points, border) => {
    const sheet = sheetOf.get(border);
    const hover = { cell: lie.sheet_cell[sheet], sheets: [sheet], border };
    svg.append(hovers(arcOf(points, border, sheet, colourOf(sheet), lie.changed_borders.includes(border)), hover));
  });
  if (lie.layout.borders.length <= 60) lie.layout.borders.forEach((points, border) => svg.append(numberOf(points, border)));
}

const hoverOf = ({ sheet, cell }) => ({ cell, sheets: [sheet], border: null });

function regionOf(group, colour) {
  const part = element("g", { class: "sheet", "data-sheet": group.sheet });
  const title = element("title", {});
  title.textContent = words(group);
  part.append(title);
  if (group.region.length > 2) {
    part.append(element("path", { d: `${pathThrough(group.region)}Z`, fill: colour, "fill-opacity": 0.32 }));
  }
  group.arcs.forEach((points) =>
    part.append(element("path", { d: pathThrough(points), class: "arc", stroke: colour })));
  return part;
}

function arcOf(points, border, sheet, colour, changed) {
  const attributes = { d: pathThrough(points), class: changed ? "border changed" : "border", stroke: colour };
  return element("path", { ...attributes, "data-border": border, "data-sheet": sheet });
}

function numberOf(points, border) {
  const [x, y] = points[Math.floor(points.length / 2)];
  const label = element("text", { x: 1.065 * x, y: -1.065 * y });
  label.textContent = border;
  return label;
}

/** Show which sheets the pointer is over, here or elsewhere on the page. */
export function lightLayout(svg, hover) {
  const lit = new Set((hover?.sheets ?? []).map(String));
  svg.querySelectorAll("[data-sheet]").forEach((part) => part.classList.toggle("lit", lit.has(part.dataset.sheet)));
}
