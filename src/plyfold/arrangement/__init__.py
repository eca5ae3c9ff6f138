"""Crossings, borders, cells, winding numbers and turning number of a closed curve (§2.1 of the paper)."""
