"""The summary of a census as a page: counts, what they agree with, and pictures of the extremal curves."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from plyfold.arrangement.arrangement import arrange
from plyfold.arrangement.gauss import GaussCode
from plyfold.census.summary import Summary, disagreements
from plyfold.draw.svg import arrangement_svg

__all__ = ["census_page", "summary_lines"]

_MOST_PICTURES = 24
_STYLE = """
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 64rem; margin: 2rem auto; padding: 0 1rem; }
table { border-collapse: collapse; } td { padding: .1rem 1rem .1rem 0; font-variant-numeric: tabular-nums; }
td + td { text-align: right; } .curves { display: flex; flex-wrap: wrap; gap: 1rem; }
figure { margin: 0; width: 14rem; } figure svg { width: 100%; height: auto; background: #fff; border-radius: .5rem; }
figcaption { font-size: .8rem; overflow-wrap: anywhere; }
"""


def summary_lines(summary: Summary) -> Iterator[tuple[str, str]]:
    """Yield what a census counted, as words and numbers."""
    yield "plane curves", f"{summary.curves:,}"
    yield "bound a disk", f"{summary.disks:,}"
    yield "immersions of these disks", f"{summary.immersions:,}"
    yield "curves with several immersions", f"{summary.several:,}"
    yield "immersions that can be lifted", f"{summary.lifting:,}"
    yield "their layerings", f"{summary.layerings:,}"
    yield "disks of which no immersion lifts", f"{summary.never:,}"
    yield "disks of which only some lift", f"{summary.partly:,}"
    yield "most immersions of one curve", f"{summary.most_immersions.most:,}"
    yield "most layerings of one curve", f"{summary.most_layerings.most:,}"
    if summary.swept:
        yield "cells swept by least homotopies", f"{summary.swept:,}"
        yield "of these unavoidable", f"{summary.unavoidable:,}"
    for points, curves in summary.branched.items():
        yield f"bound a disk with {points} branch points", f"{curves:,}"
    for turns, curves in summary.turning.items():
        yield f"turning number {turns}", f"{curves:,}"


def census_page(summary: Summary) -> str:
    """Return the summary as an HTML page that needs nothing else.

    Parameters
    ----------
    summary : Summary

    Returns
    -------
    str

    Notes
    -----
    Curves are drawn from their codes, which takes a tenth of a second each.

    Examples
    --------
    >>> from plyfold.census import census_table, plane_curves
    >>> page = census_page(Summary.of(2, census_table(next(plane_curves(2)))))
    >>> page.count("<svg")
    3
    """
    title = f"All plane curves with {summary.n_crossings} crossings"
    rows = "".join(f"<tr><td>{words}</td><td>{figure}</td></tr>" for words, figure in summary_lines(summary))
    wrong = list(disagreements(summary))
    agrees = "; ".join(wrong) if wrong else "The counts agree with A008983 of the OEIS and with the mass formula."
    pictures = "".join(_pictures(summary))
    return (
        f"<!doctype html><html lang='en'><meta charset='utf-8'><title>{title}</title><style>{_STYLE}</style>"
        f"<h1>{title}</h1><p>Each once, up to start, direction and reflection. {escape(agrees)}</p>"
        f"<table>{rows}</table>{pictures}</html>\n"
    )


def _pictures(summary: Summary) -> Iterator[str]:
    for heading, record in (
        ("Most immersions", summary.most_immersions),
        ("Most layerings", summary.most_layerings),
        ("Most symmetries of a disk", summary.most_symmetries),
    ):
        if record.code:
            yield f"<h2>{heading}: {record.most:,}</h2><div class='curves'>{_figure(record.code)}</div>"
    for heading, codes in (
        ("Disks that cannot be lifted at all", summary.never_codes),
        ("Disks of which only some immersions lift", summary.partly_codes),
    ):
        if codes:
            yield f"<h2>{heading}</h2><div class='curves'>{''.join(map(_figure, codes[:_MOST_PICTURES]))}</div>"


def _figure(code: str) -> str:
    drawn = arrangement_svg(arrange(GaussCode.parse(code).to_curve()))
    return f"<figure>{drawn}<figcaption>{escape(code)}</figcaption></figure>"
