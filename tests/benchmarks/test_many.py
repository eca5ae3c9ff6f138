"""The outlines that many verdicts are measured with are what they are said to be."""

import numpy as np

import many
import plyfold as pf


def test_kinds():
    assert (pf.verdicts(many.simple(20))["crossings"] == 0).all()
    table = pf.verdicts(many.mixed(20))
    assert (table["verdict"] == np.array(["disk", "none"] * 10)).all()


def test_what_is_printed(capsys):
    many.measure("simple", many.simple(20))
    assert capsys.readouterr().out.startswith("simple: 20 outlines, 20 disks, 0.0 s of one core; for a million ")
