// Plane geometry on points [x, y], y up. A path is {points, closed}. Points are told apart by identity, not by place.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1]];
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
export const scaled = (a, factor) => [a[0] * factor, a[1] * factor];
export const middle = (a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** Positive if a, b, c turn left, negative if right. */
export const orientation = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/** Whether two segments cross in a point inside both; touching does not count. */
export function cross(a, b, c, d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

/** How far along a–b (0 to 1) the line c–d meets it. */
export function meetingPlace(a, b, c, d) {
  const before = orientation(c, d, a);
  return before / (before - orientation(c, d, b));
}

export function nearestOnSegment(point, a, b) {
  const along = minus(b, a);
  const length = along[0] ** 2 + along[1] ** 2;
  const part = length ? ((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / length : 0;
  return add(a, scaled(along, Math.min(Math.max(part, 0), 1)));
}

export const distanceToSegment = (point, a, b) => distance(point, nearestOnSegment(point, a, b));

/** The length of a closed path once round. */
export const lengthOf = (points) => edges({ points, closed: true }).reduce((sum, [a, b]) => sum + distance(a, b), 0);

export function edges({ points, closed }) {
  const last = closed && points.length > 2 ? points.length : points.length - 1;
  return Array.from({ length: Math.max(last, 0) }, (_, i) => [points[i], points[(i + 1) % points.length]]);
}

/** @returns [left, bottom, right, top], or null for no points. */
export function bounds(points) {
  if (!points.length) return null;
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of points) {
    if (x < box[0]) box[0] = x;
    if (y < box[1]) box[1] = y;
    if (x > box[2]) box[2] = x;
    if (y > box[3]) box[3] = y;
  }
  return box;
}

export function inside(point, polygon) {
  let within = false;
  for (const [a, b] of edges({ points: polygon, closed: true })) {
    if (a[1] > point[1] !== b[1] > point[1] && orientation(a, b, point) > 0 === b[1] > a[1]) within = !within;
  }
  return within;
}

/** Signed area, positive for a counter-clockwise polygon. */
export function area(polygon) {
  return edges({ points: polygon, closed: true }).reduce((sum, [a, b]) => sum + a[0] * b[1] - a[1] * b[0], 0) / 2;
}

/** The point that is `share` of the way from a to b. */
export const mix = (a, b, share) => [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
