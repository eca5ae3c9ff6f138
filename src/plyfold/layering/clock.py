"""The clock under the name by which layerings know it."""

from plyfold.clock import Clock

__all__ = ["Clock"]
