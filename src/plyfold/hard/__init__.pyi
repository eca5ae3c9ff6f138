from .flaps import PALEY as PALEY
from .flaps import FlapDisk as FlapDisk
from .flaps import flap_disk as flap_disk
from .formulas import FormulaDisk as FormulaDisk
from .formulas import formula_disk as formula_disk
from .symmetric import Unliftable as Unliftable
from .symmetric import search_symmetric as search_symmetric
