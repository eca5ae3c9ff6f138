// Everything that can be done, once: name, label, keys, group, what it does, when it can be done, whether it is on.
// Buttons, shortcuts, menus and help are all made from this table.

import * as commands from "./commands.js";
import { EMPTY, deletePoint, lastStrokeOnly, reversed, toggleClosed, withImage, withStrokes, withTurned } from "./document.js";
import { canRedo, canUndo } from "./history.js";
import { closedAll, smoothedDrawing } from "./tidying.js";
import { answerShown, errorShown, lieShown, lineOf, offerOf, turnable } from "./store.js";
import { makeRibbon } from "./ribbons.js";
import { asDrawn } from "./trials.js";
import { zoomed } from "./camera.js";

const drawn = (state) => state.history.present.strokes.length > 0;
const allClosed = (state) => drawn(state) && !state.path.length && state.history.present.strokes.every(({ closed }) => closed);
const several = (count) => count !== null && count !== undefined && count !== "0" && count !== "1";
const present = (page) => page.store.state.history.present;
const selectedStroke = ({ selected, history }) => (selected && history.present.strokes.length > 1 ? selected.stroke : null);
const toggle = (field) => (page) => page.store.set({ [field]: !page.store.state[field] });

const tool = (name, label, key, hint) => ({
  name, label, keys: [key], hint, group: "tools",
  perform: (page) => {
    commands.finishPath(page, false);
    page.store.set({ tool: name, selected: null, carried: null });
  },
  pressed: (state) => state.tool === name,
});

const walking = (name, label, key, kind, by) => ({
  name, label, keys: [key], group: "answers", hint: `${label}, round and round`,
  perform: (page) => commands.walk(page, kind, by),
  enabled: (state) => several(lieShown(state)?.[`${kind}s`]),
});

const zooming = (name, label, keys, factor) => ({
  name, label, keys, group: "view", hint: label,
  perform: ({ store, size }) => store.set({ camera: zoomed(store.state.camera, factor, [size().width / 2, size().height / 2]) }),
});

const exporting = (format, label, enabled = drawn) => ({
  name: `export-${format}`, label, keys: [], group: "exports", hint: label,
  perform: (page) => commands.exportAs(page, format),
  enabled,
});

/** What can be done where there is no surface; seen before it is done while it is pointed at. */
const offering = (name, kind, label, key, hint) => ({
  name, label, keys: [key], group: "offers", hint, preview: kind,
  labelNow: (state) => offerOf(state, kind)?.label ?? label,
  perform: (page) => commands.takeOffer(page, kind),
  enabled: (state) => offerOf(state, kind) !== null,
});

/** Whether there may be a surface: what is known of the loop does not rule it out. */
const liftable = (state) => drawn(state) && answerShown(state)?.verdict.immersible !== false;

export const ACTIONS = [
  tool("draw", "Draw", "D", "Draw with mouse, pen or finger"),
  tool("points", "Points", "P", "Place points one by one; the first point again closes the loop, a double click ends it"),
  tool("edit", "Edit", "E", "Drag points, with Alt a single one of a smooth line; drag a line to insert one; double click to delete one"),
  tool("erase", "Erase", "X", "Rub out parts of strokes"),
  tool("cusp", "Cusps", "U", "Click where the surface turns once more than is seen; again for two and three turns, and for none"),
  tool("hand", "Move", "H", "Move the paper (also with Space held, or two fingers)"),

  { name: "undo", label: "Undo", keys: ["Ctrl+Z"], group: "history", hint: "Take the last change back", perform: commands.undoStep,
    enabled: (state) => (canUndo(state.history) || state.path.length > 0) },
  { name: "redo", label: "Redo", keys: ["Ctrl+Shift+Z", "Ctrl+Y"], group: "history", hint: "Do again what was taken back",
    perform: commands.redoStep, enabled: (state) => canRedo(state.history) || state.ahead.length > 0 },

  { name: "reverse", label: "Reverse", labelNow: (state) => (selectedStroke(state) === null ? "Reverse" : "Turn loop"), keys: ["R"], group: "change",
    hint: "Draw it in the other direction; with a point chosen, its loop alone: holes run the other way",
    perform: (page) => commands.reverse(page, selectedStroke(page.store.state)), enabled: drawn },
  { name: "close", label: "Close", labelNow: (state) => (allClosed(state) ? "Cut open" : "Close"), keys: ["C"], group: "change", hint: "Join the ends of a stroke, or open a loop",
    perform: (page) => (page.store.state.path.length ? commands.finishPath(page, true) : commands.edit(page, toggleClosed(present(page)))),
    enabled: (state) => drawn(state) || state.path.length > 2 },
  { name: "join", label: "Join", keys: ["J"], group: "change", hint: "Make a loop of all open strokes",
    perform: (page) => commands.edit(page, withStrokes(present(page), asDrawn(page.store.state.answer, page.store.state.answer.loops))),
    enabled: (state) => Boolean(answerShown(state)) && state.history.present.strokes.some(({ closed }) => !closed) },
  { name: "smooth", label: "Smooth", keys: ["M"], group: "change", hint: "Smooth and simplify; the crossings stay as they are",
    perform: (page) => commands.edit(page, smoothedDrawing(page)), enabled: drawn },
  { name: "deletePoint", label: "Delete", keys: ["Delete", "Backspace"], group: "change", hint: "Delete the chosen point",
    perform: (page) => {
      commands.editIfAllowed(page, deletePoint(present(page), page.store.state.selected));
      page.store.set({ selected: null, carried: null });
    },
    enabled: (state) => state.selected !== null },
  { name: "lock", label: "Lock", keys: ["L"], group: "change", hint: "Refuse moves that change the crossings", perform: toggle("locked"), pressed: (state) => state.locked },
  { name: "snap", label: "Snap", keys: ["S"], group: "change", hint: "Points go to the grid and to ends nearby", perform: toggle("snap"), pressed: (state) => state.snap },

  zooming("zoomOut", "Zoom out", ["-"], 0.8),
  zooming("zoomIn", "Zoom in", ["+", "="], 1.25),
  { name: "fit", label: "Fit", keys: ["F"], group: "view", hint: "Show the whole drawing", perform: commands.fit },
  { name: "cursor", label: "Keyboard", keys: ["K"], group: "view", hint: "Place and move points by keyboard",
    perform: (page) => page.toggleCursor(), pressed: (state) => state.cursor !== null },

  walking("previousImmersion", "Previous immersion", "ArrowLeft", "immersion", -1),
  walking("nextImmersion", "Next immersion", "ArrowRight", "immersion", 1),
  walking("layeringDown", "Previous layering", "ArrowDown", "layering", -1),
  walking("layeringUp", "Next layering", "ArrowUp", "layering", 1),
  offering("repair", "repair", "Leave out small loops", "Shift+K", "Leave out small loops, or undo crossings, that keep it from being an outline"),
  offering("markCusps", "cusps", "Cusps here", "Shift+U", "Mark the cusps that would help, as they are shown"),
  offering("showPieces", "pieces", "Show the pieces", "Shift+I", "Draw the loops that it can be cut into, each the outline of a disk"),
  { name: "ribbon", label: "Make it a ribbon", keys: ["Shift+R"], group: "answers", hint: "Give open strokes a width", preview: "ribbon",
    perform: makeRibbon, enabled: (state) => errorShown(state)?.kind === "unfinished" && lineOf(state) !== null },
  { name: "holes", label: "Make holes", keys: ["Shift+H"], group: "answers", hint: "Turn loops round so that every second one, from outside, is a hole",
    perform: (page) => commands.edit(page, withTurned(present(page), turnable(page.store.state))), enabled: (state) => turnable(state).length > 0 },
  { name: "closeLoop", label: "Close the loop", keys: ["Shift+J"], group: "answers", hint: "Bridge the gap between the ends",
    perform: (page) => commands.edit(page, closedAll(present(page))),
    enabled: (state) => errorShown(state)?.kind === "unfinished" && state.history.present.strokes.length === 1 },
  { name: "lastOnly", label: "Keep the last stroke only", keys: ["Shift+L"], group: "answers", hint: "Leave out all strokes but the last",
    perform: (page) => commands.edit(page, lastStrokeOnly(present(page))),
    enabled: (state) => ["unfinished", "drawing"].includes(errorShown(state)?.kind) && state.history.present.strokes.length > 1 },
  { name: "copyAnswers", label: "Copy", keys: ["Shift+C"], group: "answers", hint: "Copy the answers as text", perform: (page) => page.copyAnswers(), enabled: drawn },

  { name: "scene", label: "Surface or disk layout", keys: ["V"], group: "surface", hint: "Change between the surface and the disk layout",
    perform: ({ store }) => store.set({ scene: store.state.scene === "surface" ? "layout" : "surface" }) },

  { name: "fresh", label: "New", keys: ["N"], group: "file", hint: "Begin a new drawing; this one is kept", perform: (page) => commands.openDrawing(page, EMPTY) },
  { name: "open", label: "Open", keys: ["Ctrl+O"], group: "file", hint: "Open SVG, GeoJSON, JSON, CSV, WKT, OBJ, or a picture to draw after", perform: (page) => page.chooseFile() },
  { name: "gallery", label: "Gallery", keys: ["G"], group: "file", hint: "Curves to begin with", perform: (page) => page.showGallery() },
  { name: "drawings", label: "Drawings", keys: ["Shift+G"], group: "file", hint: "Drawings kept in this browser", perform: (page) => page.showDrawings() },
  { name: "share", label: "Link", keys: ["Shift+S"], group: "file", hint: "Copy a link that holds the whole drawing", perform: commands.share, enabled: drawn },
  { name: "exports", label: "Save as", keys: ["Ctrl+E"], group: "file", hint: "Save as a picture, a mesh or a page", perform: (page) => page.showExports(), enabled: drawn },
  { name: "help", label: "Help", keys: ["?"], group: "file", hint: "All keys", perform: (page) => page.showHelp() },
  { name: "theme", label: "Theme", keys: ["Shift+D"], group: "file", hint: "Change between light and dark", perform: (page) => page.changeTheme() },
  { name: "saveFile", label: "Save the drawing", keys: ["Ctrl+S"], group: "exports", hint: "Save as JSON; no server is needed", perform: commands.saveFile, enabled: drawn },
  { name: "back", label: "Go back", keys: ["Shift+B"], group: "exports", hidden: true, hint: "Open the drawing before again",
    perform: commands.goBack },
  { name: "dropImage", label: "Take the picture away", keys: ["Shift+P"], group: "exports", hidden: true, hint: "Take away the picture to draw after",
    perform: (page) => commands.edit(page, withImage(present(page), null)), enabled: (state) => Boolean(state.history.present.image) },

  exporting("svg", "SVG · drawing, opens again"),
  exporting("png", "PNG · drawing, opens again"),
  exporting("html", "HTML · page with the surface", liftable),
  exporting("glb", "GLB · surface", liftable),
  exporting("obj", "OBJ · surface", liftable),
  exporting("stl", "STL · surface", liftable),
  exporting("ply", "PLY · surface", liftable),
  exporting("3mf", "3MF · surface", liftable),
  exporting("tikz", "TikZ · drawing"),
];

export const actionNamed = (name) => ACTIONS.find((action) => action.name === name);
/** While a stroke or a drag is under way, the view is all that can be changed. */
export const isEnabled = (action, state) => (!state.busy || action.group === "view") && (action.enabled?.(state) ?? true);

/** The action of a key, if it can be done now. */
export const actionOf = (key, state) => ACTIONS.find((action) => action.keys.includes(key) && isEnabled(action, state));
