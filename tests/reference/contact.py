"""The least energy of heights that keep distances, by the textbook: a primal active-set method on dense matrices."""

import numpy as np

TINY = 1e-10


def least_heights(energy, stacked, least):
    """Return z with the least ½ zᵀKz and z[upper] − z[lower] ≥ least; the lowest is 0.

    Start from heights that keep all distances with room to spare; go towards the minimum over the rows that count as
    equal, as far as no other row stops it (then that one counts too); at the minimum give up the row that pulls most.
    """
    rows = np.zeros((len(stacked), len(energy)))
    rows[np.arange(len(stacked)), stacked[:, 0]] = -1
    rows[np.arange(len(stacked)), stacked[:, 1]] = 1
    z, active = start(stacked, least, len(energy)), []
    for _ in range(100 * len(stacked)):
        target, force = balance(energy, rows[active], least[active])
        step, blocking = longest(rows, least, z, target - z, active)
        z = z + step * (target - z)
        if blocking is not None:
            active.append(blocking)
        elif len(force) and force.min() < -TINY:
            del active[int(np.argmin(force))]
        else:
            return z - z.min()
    raise AssertionError("no end")


def start(stacked, least, count):
    z = np.zeros(count)
    for _ in range(count):
        for (lower, upper), distance in zip(stacked.tolist(), least.tolist(), strict=True):
            z[upper] = max(z[upper], z[lower] + distance + 1)
        if all(z[u] - z[lo] > d for (lo, u), d in zip(stacked.tolist(), least.tolist(), strict=True)):
            return z
    raise AssertionError("no start")


def balance(energy, rows, least):
    """Minimum with equal rows, by the whole system for heights and forces; vertex 0 stays at 0."""
    n, c = len(energy), len(rows)
    whole = np.zeros((n + c, n + c))
    whole[:n, :n], whole[n:, :n], whole[:n, n:] = energy, rows, -rows.T
    whole[0, :], whole[0, 0] = 0, 1
    solution = np.linalg.solve(whole, np.concatenate([np.zeros(n), least]))
    return solution[:n], solution[n:]


def longest(rows, least, z, step, active):
    room, closing = rows @ z - least, -(rows @ step)
    closing[active] = 0
    share = np.divide(room, closing, out=np.full(len(room), np.inf), where=closing > TINY)
    first = int(np.argmin(share))
    return (max(share[first], 0.0), first) if share[first] < 1 else (1.0, None)
