"""Least homotopies: every closed curve contracts, in loops that each bound a disk."""
