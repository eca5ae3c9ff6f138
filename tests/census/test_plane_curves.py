"""The census against the reference, which compares curves by all their names, and against published counts."""

import json
from dataclasses import replace

import numpy as np
import pytest

from plyfold import GaussCode, bounds_disk, count_immersions, count_layerings, immersions, least_homotopy
from plyfold.census import Summary, census_table, plane_curves
from plyfold.census.summary import PLANE_CURVES, disagreements
from plyfold.errors import InputError
from plyfold.tables.table import joined
from reference import planar_maps


def codes_of(table):
    return [GaussCode.parse(code.decode()) for code in table["code"]]


def table_of(n_crossings, parts=1):
    batches = [batch for part in range(parts) for batch in plane_curves(n_crossings, part, parts)]
    return joined([census_table(batch) for batch in batches])


def as_reference(code):
    return planar_maps.with_smallest_outer_dart(planar_maps.gauss_code(code.partner, code.ccw, code.outer))


@pytest.mark.parametrize("n_crossings", range(6))
def test_every_curve_once_as_in_the_reference(n_crossings):
    found = {code.canonical() for code in codes_of(table_of(n_crossings))}
    known = {GaussCode(*code).canonical() for code in planar_maps.census(n_crossings)}
    assert found == known
    assert len(found) == PLANE_CURVES[n_crossings]


@pytest.mark.parametrize("n_crossings", range(5))
def test_figures_of_every_curve(n_crossings):
    for code, row in zip(codes_of(table := table_of(n_crossings)), table.rows(), strict=True):
        reference = as_reference(code)
        turning = planar_maps.turning_number(reference)
        winding = [int(np.sign(turning) or 1) * number for number in planar_maps.windings(reference)]
        assert (row["turning"], row["lowest"], row["highest"]) == (abs(turning), min(winding), max(winding))
        names = planar_maps.symmetric_copies(reference)
        assert row["symmetries"] * len(names) == max(8 * n_crossings, 1) or n_crossings == 0


def test_immersions_and_layerings_are_those_of_single_calls():
    table = table_of(6)
    for code, row in zip(codes_of(table), table.rows(), strict=True):
        may_bound = row["turning"] == 1 and row["lowest"] == 0
        assert row["immersions"] == (count_immersions(code) if may_bound else 0)
        if row["immersions"]:
            layerings = [count_layerings(immersion) for immersion in immersions(code)]
            assert (row["lifting"], row["layerings"]) == (sum(map(bool, layerings)), sum(layerings))
        elif row["turning"] == 1:
            assert not bounds_disk(code)


@pytest.mark.parametrize("n_crossings", range(8))
def test_counts_that_others_published(n_crossings):
    parts = [Summary.of(n_crossings, census_table(batch)) for batch in plane_curves(n_crossings)]
    summary = Summary.together(parts)
    assert not list(disagreements(summary))
    known = {0: (1, 1, 1), 2: (1, 1, 1), 4: (7, 7, 7), 6: (86, 88, 88)}
    assert (summary.disks, summary.immersions, summary.lifting) == known.get(n_crossings, (0, 0, 0))


@pytest.mark.slow
def test_the_first_immersions_that_do_not_lift():
    summary = Summary.of(8, table_of(8))
    assert not list(disagreements(summary))
    assert (summary.disks, summary.immersions, summary.lifting) == (1682, 1725, 1721)
    assert (summary.partly, summary.never) == (4, 0)


@pytest.mark.parametrize("parts", [1, 2, 3, 50])
def test_parts_are_the_whole_and_do_not_overlap(parts):
    found = sorted(table_of(6, parts)["code"].tolist())
    assert len(found) == len(set(found)) == PLANE_CURVES[6]


def test_summaries_survive_json_and_add_up():
    tables = [census_table(batch) for part in range(4) for batch in plane_curves(7, part, 4)]
    notes = [Summary.of(7, table).note() for table in tables]
    assert Summary.together(map(Summary.from_note, notes)) == Summary.of(7, joined(tables))


@pytest.mark.parametrize("n_crossings", [0, 1, 4])
def test_least_homotopies_are_columns(n_crossings):
    table = joined([census_table(batch, homotopies=True) for batch in plane_curves(n_crossings)])
    for row in list(table.rows())[::7]:
        found = least_homotopy(GaussCode.parse(row["code"].decode()))
        assert (row["swept"], row["unavoidable"]) == (found.area, found.winding_area)
        assert row["branch_points"] == found.branch_points
    summary = Summary.of(n_crossings, table)
    assert not list(disagreements(summary))
    assert Summary.from_note(json.loads(json.dumps(summary.note()))) == summary
    assert summary.swept >= summary.unavoidable > 0
    wrong = replace(summary, disks=summary.disks + 1, swept=summary.unavoidable - 1)
    assert len(list(disagreements(wrong))) == 2


@pytest.mark.parametrize(("n_crossings", "part", "of"), [(-1, 0, 1), (21, 0, 1), (3, 2, 2), (3, -1, 2), (3, 0, 0)])
def test_there_is_no_such_census(n_crossings, part, of):
    with pytest.raises(InputError):
        next(plane_curves(n_crossings, part, of))


def test_a_wrong_count_is_told():
    summary = Summary.of(3, table_of(3))
    assert len(list(disagreements(Summary(3, curves=summary.curves + 1, names=summary.names)))) == 1
    assert len(list(disagreements(Summary(3, curves=summary.curves, names=summary.names - 8)))) == 1
