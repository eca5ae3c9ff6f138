"""Levels of strands straight from the curve, over all its immersions at once (§5 of the paper)."""
