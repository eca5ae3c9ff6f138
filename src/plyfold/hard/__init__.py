"""Immersed disks that are hard to lift, or cannot be lifted: made from digraphs and formulas, or found by search."""

from plyfold.hard.flaps import PALEY, FlapDisk, flap_disk
from plyfold.hard.formulas import FormulaDisk, formula_disk
from plyfold.hard.symmetric import Unliftable, search_symmetric

__all__ = ["PALEY", "FlapDisk", "FormulaDisk", "Unliftable", "flap_disk", "formula_disk", "search_symmetric"]
