"""The table of layering times: a line per case, with the verdict and the casings where they are few enough."""

import layering


def cells(case):
    return [cell.strip() for cell in layering.row(case).strip("|").split("|")]


def test_known_verdicts():
    by_family = {(case.family, case.size): case for case in layering.cases()}
    assert cells(by_family["Paley", 7])[4] == "cyclic order"
    chain = cells(by_family["chain", 1])
    assert chain[2:5] == ["6", "3", "lifts"]
    assert float(chain[7]) > 0


def test_formulas_have_clauses_of_three_different_variables():
    clauses = layering.random_formula(20)
    assert len(clauses) == 20
    assert all(len({abs(literal) for literal in clause}) == 3 for clause in clauses)
