"""What is packed: one version, and what a source distribution must hold to be built."""

import tomllib
from pathlib import Path

import plyfold as pf

ROOT = Path(__file__).parents[1]
BUILD = tomllib.loads((ROOT / "pyproject.toml").read_text())


def test_the_version_stands_in_one_place():
    project, hatch = BUILD["project"], BUILD["tool"]["hatch"]
    assert "version" not in project
    assert project["dynamic"] == ["version"]
    assert f'__version__ = "{pf.__version__}"' in (ROOT / hatch["version"]["path"]).read_text()


def test_a_source_distribution_can_be_built():
    """It holds the sources, what builds them, and all that the project's own file names; and no pictures."""
    packed = BUILD["tool"]["hatch"]["build"]["targets"]["sdist"]["include"]
    assert all((ROOT / path.lstrip("/")).exists() for path in packed)
    needed = [BUILD["project"]["readme"], *BUILD["project"]["license-files"], BUILD["tool"]["hatch"]["version"]["path"]]
    needed.append(BUILD["tool"]["hatch"]["build"]["hooks"]["custom"]["path"])
    assert all(any(f"/{path}".startswith(part) for part in packed) for path in needed)
    size = sum(path.stat().st_size for part in packed for path in (ROOT / part.lstrip("/")).rglob("*.png"))
    assert size < 100_000
