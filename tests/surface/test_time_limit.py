"""The time limit of ``lift`` covers all of it, and the error names the stage in which the time was over."""

import time

import numpy as np
import pytest
from scipy.sparse import csr_array

import plyfold as pf
from cloths import cloth_over
from coarse import CURVES
from plyfold.arrangement.crossings import find_contacts
from plyfold.arrangement.general_position import in_general_position
from plyfold.clock import Clock, Watch
from plyfold.errors import TimeLimitError
from plyfold.immersion.dual_tree import grow_dual_tree
from plyfold.immersion.grouping import find_groupings, list_groupings
from plyfold.immersion.word import write_word
from plyfold.mesh.cells import triangulate_cells
from plyfold.mesh.refine import constrained, noded_curve, refine, usual_area
from plyfold.surface.answers import Answers
from plyfold.surface.contact import Distances, Problem, least_forces, sprung_heights
from plyfold.surface.glue import stack_sheets
from plyfold.surface.heights import smooth_heights

STAGES = [
    "finding the crossings",
    "finding an immersion",
    "layering immersion 1",
    "triangulating the cells",
    "gluing the sheets",
    "smoothing heights",
]
PRETZEL = CURVES["pretzel"].curve


class HeldUp:
    """A listener to progress: as soon as a stage begins, hours pass on the clock."""

    def __init__(self, stage, monkeypatch):
        self.stage, self.told, self.delay, real = stage, [], 0.0, time.monotonic
        monkeypatch.setattr(time, "monotonic", lambda: real() + self.delay)

    def __call__(self, stage, done):
        self.told.append(stage)
        self.delay = 1e6 * (self.stage in self.told)


@pytest.mark.parametrize("stage", STAGES)
def test_every_stage_is_limited(stage, monkeypatch):
    with pytest.raises(TimeLimitError, match=f"while {stage}"):
        pf.lift(PRETZEL, time_limit=1e5, progress=HeldUp(stage, monkeypatch))


def test_no_time_at_all():
    layering = pf.find_layering(pf.find_immersion(PRETZEL))
    begun = {PRETZEL: STAGES[0], layering.immersion: STAGES[2], layering: STAGES[3]}
    for curve, stage in begun.items():
        with pytest.raises(TimeLimitError) as caught:
            pf.lift(curve, time_limit=0)
        assert caught.value.stage == stage


def test_in_the_middle_of_a_stage(monkeypatch):
    told = []

    def progress(stage, done):
        told.append(done)
        if done > 0:
            monkeypatch.setattr(time, "monotonic", lambda: real() + 1e6)

    real = time.monotonic
    with pytest.raises(TimeLimitError, match="while smoothing heights"):
        pf.lift(PRETZEL, time_limit=1e5, progress=progress)
    assert 0 < told[-1] < 1


@pytest.mark.parametrize("stage", ["looking for short intersections", *STAGES[3:]])
def test_with_intersections(stage, monkeypatch):
    failing = next(disk for disk in pf.immersions(CURVES["bennequin"].curve) if not pf.find_layering(disk))
    with pytest.raises(TimeLimitError, match=f"while {stage}"):
        pf.lift(failing, allow_intersections=True, time_limit=1e5, progress=HeldUp(stage, monkeypatch))


def glued():
    layering = pf.find_layering(pf.find_immersion(PRETZEL))
    cells = triangulate_cells(layering.immersion.arrangement, triangles=300)
    return layering, cells, stack_sheets(layering, cells)


class TestNothingGoesOn:
    """Each of the loops that may last, and each call of foreign code, asks for itself."""

    late = Watch(Clock(0.0))

    def test_crossings(self):
        with pytest.raises(TimeLimitError):
            find_contacts(PRETZEL.points, self.late)
        with pytest.raises(TimeLimitError):
            in_general_position(PRETZEL, "perturb", self.late)

    def test_groupings(self):
        word = write_word(grow_dual_tree(pf.arrange(CURVES["milnor"].curve)))
        with pytest.raises(TimeLimitError):
            find_groupings(word, self.late)
        with pytest.raises(TimeLimitError):
            list(list_groupings(find_groupings(word), self.late))

    def test_meshes(self):
        outline = noded_curve(pf.arrange(PRETZEL))
        with pytest.raises(TimeLimitError):
            constrained(outline, self.late)
        library = constrained(outline)
        winding = np.ones(library.triangles_count(), dtype=np.int64)
        with pytest.raises(TimeLimitError):
            refine(library, outline, winding, usual_area(outline, 1000, None), 1e-6, watch=self.late)

    @pytest.mark.parametrize("triangles", [0, 300])
    def test_gluing(self, triangles):
        layering, cells, _ = glued()
        with pytest.raises(TimeLimitError, match="triangulating"):
            triangulate_cells(layering.immersion.arrangement, triangles=triangles, watch=self.late)
        with pytest.raises(TimeLimitError, match="gluing"):
            stack_sheets(layering, cells, self.late)

    def test_heights(self):
        _, cells, mesh = glued()
        with pytest.raises(TimeLimitError, match="smoothing"):
            smooth_heights(cells.points, mesh, 1.0, watch=self.late)
        cloth = cloth_over(cells.points, mesh)
        force = np.zeros(len(cloth.area))
        nothing = np.zeros(len(force), dtype=bool)
        one = np.arange(len(force)) == 0
        for held in (nothing, one):
            with pytest.raises(TimeLimitError):
                Answers(cloth, held, self.late)
        with pytest.raises(TimeLimitError):
            cloth.smoothed(force, self.late)
        with pytest.raises(TimeLimitError):
            least_forces(np.eye(1), np.ones(1), 0, np.ones(1, dtype=bool), self.late)
        rows = Distances(csr_array(np.eye(1, len(force))), np.ones(1), 0, np.empty((0, 2), dtype=np.int64))
        with pytest.raises(TimeLimitError):
            sprung_heights(Problem(cloth, rows, nothing, force, 1e-6), self.late)
