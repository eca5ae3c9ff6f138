"""The cloth laid flat: triangles, pieces and multiplicities of an immersed disk (§2.2 of the paper)."""
