"""The unwound disk: its map, its motion, and places on it (figures 2, 4 and 6 of the paper)."""
