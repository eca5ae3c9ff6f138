"""The picture of the benchmarks: seconds over size, and the ratio to GEOS, for every family."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from tables import VERDICT, Row, by_family


def plot(rows: Sequence[Row], file: Path) -> None:
    """Draw both diagrams side by side, with logarithmic axes."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, (times, ratios) = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    for (family, own), marker in zip(by_family(rows).items(), "os^v<>DPX*hpd", strict=False):
        done = [row for row in own if row.ratio(VERDICT)]
        sizes = [row.size for row in done]
        (line,) = times.plot(sizes, [row.total(VERDICT) for row in done], marker=marker, markersize=4, label=family)
        times.plot(sizes, [row.seconds["GEOS"] for row in done], ":", color=line.get_color(), linewidth=1)
        ratios.plot(sizes, [row.ratio(VERDICT) for row in done], marker=marker, markersize=4)
    times.plot([], [], ":", color="grey", label="GEOS: node and polygonize")
    ratios.axhline(1, color="grey", linestyle=":", linewidth=1)
    for axes, title in ((times, "seconds: cells, verdict and all sheets"), (ratios, "the same, relative to GEOS")):
        axes.set(xscale="log", yscale="log", title=title, xlabel="vertices + crossings")
        axes.grid(alpha=0.3)
    times.legend(fontsize="x-small", loc="upper left")
    figure.savefig(file, dpi=110)
    plt.close(figure)
