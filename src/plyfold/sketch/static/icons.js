// Line icons, 24 by 24, drawn with the colour of the text.

const PATHS = {
  draw: "M3 20c3-7 6-9 9-6s6 1 8-9",
  points: "M4 18 10 6l5 9 5-7M4 18h0M10 6h0M15 15h0M20 8h0",
  edit: "M5 3l13 9-6 1.5L9 19z",
  erase: "M8 20l-4-4a1.5 1.5 0 0 1 0-2L13 5a1.5 1.5 0 0 1 2 0l4 4a1.5 1.5 0 0 1 0 2l-9 9zM8 10l7 7M8 20h12",
  cusp: "M4 20 12 5l8 15M12 5a4 4 0 1 0 4 4",
  hand: "M12 3v18M3 12h18M12 3 9 6M12 3l3 3M12 21l-3-3M12 21l3-3M3 12l3-3M3 12l3 3M21 12l-3-3M21 12l-3 3",
  undo: "M8 5 4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",
  redo: "M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",
  reverse: "M17 3l3 3-3 3M20 6H8a4 4 0 0 0-4 4M7 21l-3-3 3-3M4 18h12a4 4 0 0 0 4-4",
  close: "M12 4a8 8 0 1 1-6 2.7M6 2.5v4.2h4.2",
  join: "M4 12h5M15 12h5M9 8v8M15 8v8",
  smooth: "M3 15c3 0 3-6 6-6s3 6 6 6 3-6 6-6",
  lock: "M7 11V8a5 5 0 0 1 10 0v3M5 11h14v9H5z",
  snap: "M5 5h0M12 5h0M19 5h0M5 12h0M12 12h0M19 12h0M5 19h0M12 19h0M19 19h0",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  zoomIn: "M12 5v14M5 12h14",
  zoomOut: "M5 12h14",
  cursor: "M12 3v6M12 15v6M3 12h6M15 12h6",
  fresh: "M6 3h8l4 4v14H6zM14 3v4h4M12 11v6M9 14h6",
  open: "M3 19V6h6l2 2h8v3M3 19l3-8h16l-3 8z",
  gallery: "M4 4h7v7H4zM13 4h7v7h-7zM4 13h7v7H4zM13 13h7v7h-7z",
  drawings: "M12 8v4l3 2M4 12a8 8 0 1 0 2.5-5.8M4 4v4h4",
  share: "M10 14a4 4 0 0 0 6 0l3-3a4 4 0 0 0-6-6l-1 1M14 10a4 4 0 0 0-6 0l-3 3a4 4 0 0 0 6 6l1-1",
  exports: "M12 4v11M8 11l4 4 4-4M5 20h14",
  help: "M9 9a3 3 0 1 1 4 3c-1 .5-1 1-1 2M12 18h0",
  theme: "M20 14a8 8 0 1 1-10-10 6.5 6.5 0 0 0 10 10z",
  deletePoint: "M6 7h12M9 7V4h6v3M8 7l1 13h6l1-13",
  copyAnswers: "M9 9h11v11H9zM5 15H4V4h11v1",
};

/** An icon as an SVG element, hidden from those who hear the page. */
export function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = svg.appendChild(document.createElementNS(svg.namespaceURI, "path"));
  path.setAttribute("d", PATHS[name]);
  return svg;
}

export const hasIcon = (name) => name in PATHS;
