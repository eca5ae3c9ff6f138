"""Pack the headers of CPython's limited API: ``python tools/vendor_headers.py``, with Python 3.11 and its headers.

They are the files that ``#include <Python.h>`` reads with ``Py_LIMITED_API``, as they are but for ``pyconfig.h``, which
differs from machine to machine and is written by hand. With them, core is compiled where Python came without headers.
"""

from __future__ import annotations

import re
import subprocess
import sysconfig
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

INCLUDE = Path(sysconfig.get_path("include"))
PACKED = Path(__file__).resolve().parent / "headers" / "cpython-3.11.zip"
PROGRAM = "#include <Python.h>\n#include <structmember.h>\n#include <frameobject.h>\n"


def headers() -> list[str]:
    """Return the names of the headers, below the folder of Python.h."""
    command = ["cc", "-M", "-DPy_LIMITED_API=0x030B0000", f"-I{INCLUDE}", "-xc", "-"]
    rule = subprocess.run(command, input=PROGRAM, capture_output=True, text=True, check=True).stdout
    read = {Path(name).relative_to(INCLUDE).as_posix() for name in re.findall(rf"{re.escape(str(INCLUDE))}\S+", rule)}
    return sorted(read - {"pyconfig.h"})


def main() -> None:
    """Write the archive, the same one every time."""
    with ZipFile(PACKED, "w", ZIP_DEFLATED, compresslevel=9) as archive:
        for name in headers():
            archive.writestr(ZipInfo(name), (INCLUDE / name).read_bytes(), ZIP_DEFLATED)


if __name__ == "__main__":
    main()
