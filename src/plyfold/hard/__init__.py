"""Immersed disks that are hard to lift, or cannot be lifted: made from digraphs and formulas, or found by search."""
