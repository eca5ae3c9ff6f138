"""Pictures of every stage, and the self-contained 3D page.

The functions below draw with matplotlib, each on axes of your own, ``ax=``, or on a new figure, and return the axes;
``plyfold.draw.save(ax.figure, "loop.pdf")`` writes a file. New figures are not registered with pyplot; a notebook shows
them, and their axes, as the last line of a cell. In all of them a sheet has the same colour. ``svg`` draws an
arrangement by hand for notebooks, ``over_under`` layers from above as SVG and TikZ, ``viewer`` makes one HTML file that
shows a surface, and ``colours`` is the one place that chooses colours.

>>> from plyfold import draw
>>> from plyfold.gallery import CURVES
>>> ax = draw.plot_arrangement(CURVES["exit-ramp"].curve, borders=True)
>>> ax.figure.get_size_inches().tolist()
[5.0, 5.0]
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
