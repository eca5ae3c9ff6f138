"""Immersed disks that are hard to lift, or cannot be lifted: made from digraphs and formulas, or found by search."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
