"""What the subcommands have in common: the drawing they read, the files they write, and how they end."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plyfold.cli.drawing import add_drawing_options, read_outline
from plyfold.cli.progress import Stopwatch
from plyfold.cli.standard_output import say_written
from plyfold.clock import Clock, Watch
from plyfold.errors import InputError, NotImmersibleError, TimeLimitError
from plyfold.io.saving import refuse_output, save_bytes
from plyfold.loading import FOR_CROSSINGS, FOR_MESHES, load_libraries
from plyfold.obstruction import Obstruction

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement
    from plyfold.offers.repair import Repaired
    from plyfold.outline.curve import Outline

__all__ = [
    "BAD_INPUT",
    "DISK",
    "NO_DISK",
    "UNKNOWN",
    "add_command",
    "add_format",
    "add_outputs",
    "add_repair",
    "add_time_limit",
    "arrange_outline",
    "prepare",
    "read_arrangement",
    "read_as_given",
    "read_drawing",
    "refuse_outputs",
    "repaired",
    "say_notes",
    "title",
    "write_texts",
]

# Exit codes.
DISK, NO_DISK, BAD_INPUT, UNKNOWN = range(4)


def add_command(commands: Any, name: str, run: Callable[..., int], summary: str) -> argparse.ArgumentParser:
    """Add a subcommand that reads a drawing, with the options for reading it."""
    command: argparse.ArgumentParser = commands.add_parser(
        name, help=summary, description=summary[0].upper() + summary[1:] + "."
    )
    command.set_defaults(run=run)
    add_drawing_options(command)
    command.add_argument(
        "--general-position",
        choices=["perturb", "raise"],
        default="perturb",
        help="where strands touch: move vertices a little and say so, or refuse (default: %(default)s)",
    )
    return command


def add_time_limit(command: argparse.ArgumentParser, of: str = "the search for a layering") -> None:
    """Give a subcommand the option ``--time-limit``."""
    command.add_argument("--time-limit", type=_seconds, metavar="S", help=f"seconds for {of}; then it is unknown")


def _seconds(text: str) -> float:
    return _from_zero_on(text, f"{text} is not a number of seconds from 0 on")


def _from_zero_on(text: str, wrong: str) -> float:
    """Read a number from 0 on; say what is wrong if it is none."""
    with suppress(ValueError):
        if (number := float(text)) >= 0:
            return number
    raise argparse.ArgumentTypeError(wrong)


def add_repair(command: argparse.ArgumentParser, is_option: bool = True) -> None:
    """Give a subcommand the options of a repair: ``--repair`` itself, unless that is what it does, and the caps."""
    if is_option:
        command.add_argument(
            "--repair", action="store_true", help="leave out tiny loops and undo lenses first, where it is no disk"
        )
    command.add_argument(
        "--allow",
        type=_part,
        metavar="P",
        help="the part of the region that it may change (default: 1%%)",
    )
    command.add_argument(
        "--allow-layers",
        type=_part,
        metavar="P",
        help="the part of all that lies in layers, each counted, that it may change (default: 20%%)",
    )


def _part(text: str) -> float:
    """Read a part of a whole.

    Examples
    --------
    >>> _part("2%"), _part("0.02")
    (0.02, 0.02)
    """
    number = _from_zero_on(text.removesuffix("%"), f"{text} is no part of a whole, such as 1% or 0.01")
    return number / 100 if text.endswith("%") else number


def _caps(options: argparse.Namespace) -> dict[str, float | None]:
    """Return the parts that a repair may change, as far as they are given."""
    return {name: getattr(options, name, None) for name in ("allow", "allow_layers")}


def repaired(outline: Outline, options: argparse.Namespace, watch: Stopwatch, clock: Clock) -> Repaired:
    """Return an outline with small changes that make it that of a disk; raise an error if there are none such."""
    from plyfold.offers.repair import Repaired, repair

    load_libraries(FOR_CROSSINGS, watch)
    watch("repairing")
    caps = {name: part for name, part in _caps(options).items() if part is not None}
    found = repair(outline, **caps, time_limit=clock.left)
    if isinstance(found, Repaired):
        return found
    if isinstance(found, Obstruction):
        raise NotImmersibleError(found, hint="--allow and --allow-layers allow more")
    raise TimeLimitError(str(found), hint="allow more time")


def read_drawing(options: argparse.Namespace, watch: Stopwatch, clock: Clock | None = None) -> Outline:
    """Return the outline that is named, repaired if that is asked for; then say so."""
    is_repaired = getattr(options, "repair", False)
    if not is_repaired and any(part is not None for part in _caps(options).values()):
        raise InputError("--allow and --allow-layers say what --repair may change", hint="add --repair")
    outline = read_outline(options, watch)
    if not is_repaired:
        return outline
    found = repaired(outline, options, watch, clock or Clock(None))
    watch.stop()
    print(f"repaired: {found}", file=sys.stderr)
    return found.outline


def add_outputs(command: argparse.ArgumentParser, endings: str, required: bool = True) -> None:
    """Give a subcommand the options ``-o``, of which there must be one unless that is said, and ``--force``."""
    command.add_argument(
        "-o",
        "--output",
        action="append",
        required=required,
        default=None if required else [],
        metavar="OUT",
        help=f"one of {endings}; or - for standard output, in the format that --format names",
    )
    add_format(command)
    command.add_argument("--force", action="store_true", help="replace existing files, but never the drawing")


def add_format(command: argparse.ArgumentParser) -> None:
    """Give a subcommand the option that names the format of standard output."""
    command.add_argument("--format", metavar="ENDING", help="the format of what -o - writes to standard output")


def read_arrangement(options: argparse.Namespace, watch: Stopwatch, clock: Clock | None = None) -> Arrangement:
    """Return the arrangement of the drawing that is named."""
    return arrange_outline(read_drawing(options, watch, clock), options, watch, clock)


def arrange_outline(
    outline: Outline, options: argparse.Namespace, watch: Stopwatch, clock: Clock | None = None
) -> Arrangement:
    """Return the arrangement of an outline that was read."""
    from plyfold.arrangement.arrangement import watched_arrangement

    load_libraries(FOR_CROSSINGS, watch)
    return watched_arrangement(outline, options.general_position, Watch(clock or Clock(None), watch))


def prepare(
    options: argparse.Namespace, endings: tuple[str, ...], watch: Stopwatch, clock: Clock | None = None
) -> Arrangement:
    """Refuse outputs that cannot be written, then read the input, and say what was changed in it."""
    refuse_outputs(options, endings)
    arranged = read_arrangement(options, watch, clock)
    say_notes(arranged.outline)
    return arranged


def read_as_given(options: argparse.Namespace, watch: Stopwatch) -> Outline:
    """Return the outline with nothing moved, and say what was changed; refuse one that touches itself if asked to."""
    from plyfold.arrangement.arrangement import arrange

    drawn = read_drawing(options, watch)
    say_notes(drawn)
    load_libraries((*FOR_CROSSINGS, *FOR_MESHES), watch)
    if options.general_position == "raise":
        arrange(drawn, "raise")
    return drawn


def say_notes(outline: Outline | None) -> None:
    """Say on standard error what was changed in the input."""
    from plyfold.report import repair_lines

    for line in repair_lines(outline) if outline is not None else ():
        print(line.strip(), file=sys.stderr)


def refuse_outputs(options: argparse.Namespace, endings: tuple[str, ...]) -> None:
    """Refuse before any work is done what could not be written after it."""
    options.output = list(dict.fromkeys(options.output))
    _refuse_shared_files(options.file, options.output)
    for path in options.output:
        refuse_output(path, endings, options.force)


def _refuse_shared_files(file: str, outputs: list[str]) -> None:
    """Refuse outputs that are the drawing itself, or one file under two names, whatever links lead there."""
    drawing = _identity_of_input(file)
    for written in [path for output in outputs for path in _written(output)]:
        if _identity(written) == drawing:
            raise InputError(f"{written} is the drawing that is read", hint="write to another file")
    for first, second in combinations(outputs, 2):
        if _identity(first) == _identity(second):
            raise InputError(f"{first} and {second} are the same file", hint="name each output once")


def _written(output: str) -> list[str]:
    """Return the files that an output may bring with it: an OBJ has its materials beside it."""
    path = Path(output)
    return [output, str(path.with_suffix(".mtl"))] if path.suffix.lower() == ".obj" else [output]


def _identity_of_input(file: str) -> object:
    if file == "-":
        with suppress(OSError, AttributeError):  # it may be closed, or no file
            return _number(os.fstat(sys.stdin.fileno()))
    return _identity(file)


def _identity(path: str) -> object:
    """Return what is the same for all names of a file: its number, or, if it does not exist yet, its full path."""
    try:
        return _number(Path(path).stat())
    except OSError:
        return os.path.realpath(path)


def _number(found: os.stat_result) -> tuple[int, int]:
    return found.st_dev, found.st_ino


def write_texts(options: argparse.Namespace, content: dict[str, Callable[[], str]]) -> None:
    """Write the outputs, each by its ending, and say so; none is written if one of the formats refuses its content."""
    texts = {path: content[Path(path).suffix.lower()]() for path in options.output}
    for path, text in texts.items():
        save_bytes(path, text.encode(), options.force)
        say_written(path)


def title(file: str) -> str:
    """Return what a picture or page of a drawing is called."""
    return "plyfold" if file == "-" else Path(file.removeprefix("gallery:")).stem
