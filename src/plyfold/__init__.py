"""Closed curves that cross themselves: immersed disks, their layerings, and the surfaces they bound."""
