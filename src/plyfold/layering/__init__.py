"""Layerings: vertical orders of the sheets that lift an immersed disk into a layered surface (§3 of the paper)."""
