// From the drawing (y up) to the screen (y down) and back: the one place where y is turned over.

import { bounds } from "./geometry.js";

export const START = Object.freeze({ scale: 1, x: 0, y: 0 });

export const toScreen = ({ scale, x, y }, point) => [x + scale * point[0], y - scale * point[1]];
export const toDrawing = ({ scale, x, y }, place) => [(place[0] - x) / scale, (y - place[1]) / scale];
export const panned = (camera, [right, down]) => ({ ...camera, x: camera.x + right, y: camera.y + down });

/** Zoom by a factor, with the drawing under a place of the screen kept there. */
export function zoomed(camera, factor, [across, down]) {
  return { scale: camera.scale * factor, x: across + factor * (camera.x - across), y: down + factor * (camera.y - down) };
}

/** The camera that shows all points with a margin; the origin in the middle if there are none. */
export function fitted(points, width, height) {
  const box = bounds(points);
  if (!box) return { scale: 1, x: width / 2, y: height / 2 };
  const [left, bottom, right, top] = box;
  const scale = Math.min((0.78 * width) / (right - left || 1), (0.74 * height) / (top - bottom || 1));
  return { scale, x: width / 2 - (scale * (left + right)) / 2, y: height / 2 + (scale * (bottom + top)) / 2 };
}
