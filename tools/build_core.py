"""Compile ``plyfold.core`` when plyfold is built or installed: a hook of hatchling, which runs this file.

Cython turns each module that has a ``.pxd`` file beside it into C; any C compiler will do. Where there is none, it is
zig, which the package index has for most machines. CPython's limited API is enough, and its headers are in
``tools/headers``, so they need not be installed, and what is made runs with Python 3.11 and all later ones. Whatever
goes wrong, plyfold is installed all the same: its modules are plain Python as they stand.
"""

from __future__ import annotations

import os
import runpy
import shlex
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from zipfile import ZipFile

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

ROOT = Path(__file__).resolve().parent.parent
CORE = ROOT / "src" / "plyfold" / "core"
HEADERS = ROOT / "tools" / "headers"

# Whole numbers wrap, and products are never fused with sums: exact products must not be.
FLAGS = ["-O3", "-fPIC", "-shared", "-fwrapv", "-ffp-contract=off", "-fno-strict-aliasing", "-w", "-s"]
LIMITED = "-DPy_LIMITED_API=0x030B0000"
ZIG = [sys.executable, "-m", "ziglang", "cc", "-mcpu=baseline", "-fno-sanitize=undefined"]
# Types are in the .pxd files, and of local variables those that follow; indices are checked, and never negative.
CYTHON = ["-3", "-Xannotation_typing=False", "-Xinfer_types=True", "-Xwraparound=False", "-Xcdivision=True"]


@cache
def own_compiler() -> tuple[str, ...]:
    """Return the command of the machine's C compiler, if there is one that works."""
    named = shlex.split(os.environ.get("CC", ""))
    found = [named] if named else [[name] for name in ("cc", "gcc", "clang") if shutil.which(name)]
    return next((tuple(command) for command in found if _works(command)), ())


def _works(command: list[str]) -> bool:
    """Tell whether a compiler makes libraries: some come without the headers and libraries of C."""
    with TemporaryDirectory() as folder:
        source = Path(folder, "try.c")
        source.write_text("#include <math.h>\n#include <stdlib.h>\ndouble f(double x) { return floor(x); }\n")
        try:
            made = subprocess.run(
                [*command, *FLAGS, str(source), "-o", f"{folder}/try"], check=False, capture_output=True
            )
        except OSError:
            return False
        return made.returncode == 0


class CoreHook(BuildHookInterface):  # type: ignore[type-arg]
    """Builds the compiled modules into ``core/machine``, and puts them into wheels."""

    def dependencies(self) -> list[str]:
        """Ask for a compiler from the package index where there is none."""
        return [] if _is_unwanted() or own_compiler() else ["ziglang>=0.13"]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile; whatever goes wrong, plain Python works."""
        if self.target_name != "wheel" or _is_unwanted():
            return
        try:
            made = compile_core()
        except Exception as error:
            self.app.display_warning(f"plyfold.core is not compiled, and slow: {error}")
            return
        if version != "editable":
            build_data |= {"pure_python": False, "tag": _tag()}
            build_data["force_include"] |= {str(path): str(path.relative_to(ROOT / "src")) for path in made}


def _is_unwanted() -> bool:
    """Tell whether plain Python is asked for, or is all that there is: free threads have no limited API."""
    is_cpython = sys.implementation.name == "cpython" and not sysconfig.get_config_var("Py_GIL_DISABLED")
    return bool(os.environ.get("PLYFOLD_PURE")) or not is_cpython


def _tag() -> str:
    """Return which Pythons and machines a wheel is for."""
    from packaging.tags import sys_tags

    own = (tag.platform for tag in sys_tags() if "manylinux" not in tag.platform and "musllinux" not in tag.platform)
    return f"cp311-abi3-{next(own)}"


def compile_core() -> list[Path]:
    """Compile all modules that have C types, and return the files made; the stamp of their sources comes last."""
    machine = CORE / "machine"
    shutil.rmtree(machine, ignore_errors=True)
    with TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as workers:
        with ZipFile(HEADERS / "cpython-3.11.zip") as headers:
            headers.extractall(folder)
        shutil.copy(HEADERS / "pyconfig.h", folder)
        made = list(workers.map(lambda source: _compiled(source, folder), _modules()))
        machine.mkdir()
        made = [Path(shutil.copy(path, machine)) for path in made]
    stamp = machine / "stamp"
    stamp.write_text(runpy.run_path(str(CORE / "stamp.py"))["stamp_of"](str(CORE)))
    return [*made, stamp]


def _modules() -> Iterator[Path]:
    return (types.with_suffix(".py") for types in sorted(CORE.glob("*.pxd")))


def _compiled(source: Path, folder: str) -> Path:
    """Compile a module in a folder with the headers."""
    written, made = Path(folder, source.stem).with_suffix(".c"), Path(folder, source.stem + _suffix())
    module = source.relative_to(ROOT / "src")
    _run(sys.executable, "-m", "cython", *CYTHON, str(module), "-o", str(written), cwd=ROOT / "src")
    compiler = own_compiler() or ZIG
    _run(*compiler, *FLAGS, LIMITED, f"-I{folder}", str(written), *_libraries(), "-o", str(made), cwd=folder)
    return made


def _run(*command: str, cwd: Path | str) -> None:
    """Run a command; what zig keeps for later goes away with the folder of the build."""
    environment = os.environ | {"ZIG_GLOBAL_CACHE_DIR": f"{cwd}/zig", "ZIG_LOCAL_CACHE_DIR": f"{cwd}/zig"}
    done = subprocess.run(command, check=False, cwd=cwd, env=environment, capture_output=True, text=True)
    if done.returncode:
        raise OSError(f"{shlex.join(command)}\n{done.stderr[-2000:]}")


def _suffix() -> str:
    return ".pyd" if sys.platform == "win32" else ".abi3.so"


def _libraries() -> list[str]:
    """Return what the linker must be told about the symbols of Python, which are in the running program."""
    if sys.platform == "darwin":
        return ["-undefined", "dynamic_lookup"]
    return [str(Path(sys.base_prefix, "libs", "python3.lib"))] if sys.platform == "win32" else []
