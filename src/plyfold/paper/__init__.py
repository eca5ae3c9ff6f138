"""The paper's own procedures, judged by the exact ones (§2.3, §2.4 and §3 of the paper)."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
