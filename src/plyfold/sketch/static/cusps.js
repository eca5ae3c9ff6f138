// Cusps: points of a loop where the surface's angle is some full turns larger than the one that is seen. A stroke has the
// index of each in `cusps`, {number of the point: turns}; a stroke without cusps has no `cusps`. They stay with their
// points, which are told apart by identity.

/** The tool counts up to here, and then takes the mark away. */
export const MOST_TURNS = 3;

export const cuspsOf = ({ cusps = {} }) => Object.entries(cusps).map(([vertex, index]) => ({ vertex: Number(vertex), index }));
export const indexAt = ({ cusps }, vertex) => cusps?.[vertex] ?? 0;

/** A stroke with these cusps, {vertex, index} each, and no others. */
export function withCusps({ points, closed }, marks) {
  const cusps = Object.fromEntries(marks.filter(({ index }) => index > 0).map(({ vertex, index }) => [vertex, index]));
  return Object.keys(cusps).length ? { points, closed, cusps } : { points, closed };
}

export const withCusp = (stroke, vertex, index) =>
  withCusps(stroke, [...cuspsOf(stroke).filter((mark) => mark.vertex !== vertex), { vertex, index }]);

/** Other points in place of a stroke's: the cusps go along with those that are still there. */
export function withPoints(stroke, points, closed = stroke.closed) {
  const marks = cuspsOf(stroke).map(({ vertex, index }) => ({ vertex: points.indexOf(stroke.points[vertex]), index }));
  return withCusps({ points, closed }, marks.filter(({ vertex }) => vertex >= 0));
}

/** One more turn; after the last one, none. */
export const nextIndex = (index) => (index < MOST_TURNS ? index + 1 : 0);
