"""The census: every generic closed curve in the plane with so many crossings, each once, and what it bounds."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
