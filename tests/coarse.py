"""The gallery with fewer points: the same curves, for tests that would take long with many."""

from plyfold import gallery

CURVES = {name: named.coarse() for name, named in gallery.CURVES.items()}
OUTLINES = {name: named.coarse() for name, named in gallery.OUTLINES.items()}
