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
        "IntersectingLayering",
        "LayeredSurface",
        "Layering",
        "Obstruction",
        "Surface",
        "Unknown",
        "UnwoundDisk",
        "arrangement",
        "best_immersion",
        "blank_word",
        "bounds_disk",
        "changed_borders",
        "count_embeddings",
        "count_immersions",
        "count_layered_surfaces",
        "count_layerings",
        "coverage",
        "decompose",
        "embed_cased",
        "embeddings",
        "errors",
        "find_embedding",
        "find_immersion",
        "find_layered_surface",
        "find_layering",
        "flip_distance",
        "gallery",
        "immersions",
        "irreducible_kernels",
        "layered_surfaces",
        "layerings",
        "least_intersecting_layering",
        "lift",
        "loop_turning_numbers",
        "map_disk",
        "nicest_layering",
        "read",
        "sample_immersion",
        "triangulate",
        "unwrap",
    ]
    assert all(hasattr(pf, name) for name in pf.__all__)


def test_arrangement_is_the_function_whatever_was_imported():
    import plyfold.arrangement.arrangement
    import plyfold.draw.surface_plot  # noqa: F401

    assert callable(pf.arrangement)
