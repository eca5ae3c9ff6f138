"""The names that users may rely on."""

import plyfold as pf


def test_public_names():
    assert sorted(pf.__all__) == [
        "Arrangement",
        "BlankWord",
        "Covered",
        "Curve",
        "GaussCode",
        "Immersion",
        "Layering",
        "Obstruction",
        "Surface",
        "Unknown",
        "arrangement",
        "best_immersion",
        "blank_word",
        "bounds_disk",
        "changed_borders",
        "count_immersions",
        "count_layerings",
        "coverage",
        "decompose",
        "embed_cased",
        "errors",
        "find_immersion",
        "find_layering",
        "flip_distance",
        "gallery",
        "immersions",
        "irreducible_kernels",
        "layerings",
        "lift",
        "loop_turning_numbers",
        "nicest_layering",
        "read",
        "sample_immersion",
        "triangulate",
    ]
    assert all(hasattr(pf, name) for name in pf.__all__)


def test_arrangement_is_the_function_whatever_was_imported():
    import plyfold.arrangement.core
    import plyfold.draw.plots  # noqa: F401

    assert callable(pf.arrangement)
