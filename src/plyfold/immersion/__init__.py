"""Immersed disks: the dual tree, Blank's words, groupings, sheets and gluing (§2 of the paper)."""
