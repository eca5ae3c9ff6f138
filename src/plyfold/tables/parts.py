"""A long table made in parts: by all cores or by a cluster, and gone on with where it was interrupted.

A folder beside the output holds the parts that are done: each is a file, written under another name and renamed, and a
note of what it holds. Parts depend on what was asked for alone, so a run that was killed goes on with those that are
missing, and whoever makes a part twice makes the same one.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from plyfold.clock import Progress
from plyfold.errors import InputError
from plyfold.io.saving import draft_in, refuse_existing, save_bytes
from plyfold.tables.files import join_tables, table_bytes
from plyfold.tables.table import DataTable

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["Hands", "Job", "Note", "count_parts", "write_table"]

_Given = TypeVar("_Given")
_Answer = TypeVar("_Answer")
Hands: TypeAlias = "int | Client | None"
Note: TypeAlias = dict[str, Any]

_WHAT = "what.json"


@dataclass(frozen=True)
class Job:
    """What a table holds, in parts.

    Attributes
    ----------
    what : dict
        All that the rows depend on, for JSON: parts made for something else are not taken.
    parts : sequence
        What each part is made of: its number, or more.
    make : callable
        Makes a part, given what it is made of: a table, and a note about it for JSON. Other processes call it, too.
    """

    what: Note
    parts: Sequence[Any]
    make: Callable[[Any], tuple[DataTable, Note]]


def write_table(
    job: Job,
    path: str | os.PathLike[str],
    workers: Hands = None,
    force: bool = False,
    progress: Progress | None = None,
) -> list[Note]:
    """Make all parts of a table that are missing, join them to one file, and return their notes in order.

    Parameters
    ----------
    job : Job
    path : path
        A .parquet, .csv or .jsonl file. The folder of the parts has the same name with ``.parts`` behind it.
    workers : int or distributed.Client, optional
        How many processes, as many as there are processors by default; or a Dask cluster whose machines see the same
        folder.
    force : bool, optional
        Replace an existing file.
    progress : callable, optional
        Is told what is done, as ``progress("parts", share)``.

    Returns
    -------
    list of dict

    Raises
    ------
    FileExistsError
        If the file exists and ``force`` is not set.
    InputError
        If the folder holds the parts of something else.
    """
    refuse_existing(path, force)
    target = Path(path)
    folder = target.with_name(target.name + ".parts")
    notes = _make_parts(job, folder, target.suffix.lower(), workers, progress)
    with draft_in(target.absolute().parent) as draft:
        join_tables([_part(folder, number, target.suffix) for number in range(len(job.parts))], draft, target.suffix)
        draft.replace(target)
    shutil.rmtree(folder)
    return notes


def count_parts(job: Job, workers: Hands = None, progress: Progress | None = None) -> list[Note]:
    """Make all parts of a table for their notes alone; parameters as in :func:`write_table`."""
    notes = dict(_calls(partial(_noted, job.make), list(enumerate(job.parts)), workers, progress))
    return [notes[number] for number in range(len(job.parts))]


def _noted(make: Callable[[Any], tuple[DataTable, Note]], numbered: tuple[int, Any]) -> tuple[int, Note]:
    number, part = numbered
    return number, make(part)[1]


def _make_parts(job: Job, folder: Path, ending: str, workers: Hands, progress: Progress | None) -> list[Note]:
    """Make the parts that a folder does not hold yet, and return the notes of all."""
    _begin(job, folder)
    missing = [(number, part) for number, part in enumerate(job.parts) if not _note(folder, number).exists()]
    # Other processes are sent a part at a time, and not all of them with each.
    for _ in _calls(partial(_make_part, job.make, folder, ending), missing, workers, progress):
        pass
    return [json.loads(_note(folder, number).read_text()) for number in range(len(job.parts))]


def _begin(job: Job, folder: Path) -> None:
    """Make the folder, or see that what is in it belongs to this job."""
    what = {**job.what, "parts": len(job.parts)}
    folder.mkdir(exist_ok=True)
    if not (folder / _WHAT).exists():
        save_bytes(folder / _WHAT, json.dumps(what).encode())
    if json.loads((folder / _WHAT).read_text()) != what:
        raise InputError(f"{folder} holds parts of something else", hint="remove that folder, or choose another output")


def _make_part(
    make: Callable[[Any], tuple[DataTable, Note]], folder: Path, ending: str, numbered: tuple[int, Any]
) -> int:
    """Write a part, and then the note, which says that it is whole."""
    number, part = numbered
    table, note = make(part)
    save_bytes(_part(folder, number, ending), table_bytes(table, ending), force=True)
    save_bytes(_note(folder, number), json.dumps(note).encode(), force=True)
    return number


def _part(folder: Path, number: int, ending: str) -> Path:
    return folder / f"part-{number:06}{ending}"


def _note(folder: Path, number: int) -> Path:
    return folder / f"part-{number:06}.json"


def _calls(
    call: Callable[[_Given], _Answer], given: list[_Given], workers: Hands, progress: Progress | None
) -> Iterator[_Answer]:
    """Call a function for all that is given, and yield what comes back as it comes."""
    for done, answer in enumerate(_answers(call, given, workers), start=1):
        yield answer
        if progress is not None:
            progress("parts", done / len(given))


def _answers(call: Callable[[_Given], _Answer], given: list[_Given], workers: Hands) -> Iterator[_Answer]:
    if workers is not None and not isinstance(workers, int):
        from plyfold.tables.cluster import on_cluster

        yield from on_cluster(workers, call, given)
        return
    workers = min(workers or os.cpu_count() or 1, len(given))
    if workers <= 1:
        yield from map(call, given)
        return
    # Processes that are forked would take the locks of other threads with them.
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        try:
            for future in as_completed([pool.submit(call, one) for one in given]):
                yield future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
