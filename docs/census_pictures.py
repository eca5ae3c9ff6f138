"""Draw the disks with ten crossings that cannot be lifted at all, as ``plyfold census 10`` found them."""

from __future__ import annotations

from panels import panels, titled

import plyfold as pf
from plyfold.draw import plot_arrangement

NEVER = (
    "a-a+b-b+c-d-e+c+f-f+g-h-h+e-i-j-j+i+d+g+ / outer 30",
    "a-a+b-b+c-d-e+c+f-f+g-g+h-e-i-j-j+i+d+h+ / outer 30",
    "a-a+b-b+c-d+e-c+f-f+g-g+d-h-i-j-j+i+h+e+ / outer 30",
    "a-a+b-b+c-d-e+c+f-g-g+f+h-e-i-j-j+i+d+h+ / outer 30",
    "a-a+b-b+c-d+e-c+f-g-g+f+d-h-i-j-j+i+h+e+ / outer 30",
    "a-a+b+c-d-e+c+f-g-g+f+h-e-i-j-j+i+d+h+b- / outer 28",
    "a-a+b+c-d+e-c+f-g-g+f+d-h-i-j-j+i+h+e+b- / outer 28",
    "a-a+b-c-d+b+e-f-f+e+g-d-h-i-i+h+c+j-j+g+ / outer 26",
    "a-a+b-c-d+b+e-e+f-g-g+d-h-i-i+h+c+j-j+f+ / outer 26",
)


def never() -> None:
    """Draw the nine, each from its code."""
    with panels("census-never", 3, 3, (9.6, 9.6)) as axes:
        for ax, code in zip(axes, NEVER, strict=True):
            curve = pf.GaussCode.parse(code).to_curve()
            assert pf.count_immersions(curve) == 2
            assert not pf.find_embedding(curve)
            plot_arrangement(pf.arrange(curve), ax=ax)
            titled(ax, code.partition(" ")[0])


if __name__ == "__main__":
    never()
