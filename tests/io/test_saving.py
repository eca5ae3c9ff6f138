"""Files that exist already, by name or at the end of a link, and what is no file at all."""

import os
import stat
import threading

import pytest

from plyfold.errors import InputError
from plyfold.io.saving import refuse_existing, save_bytes


@pytest.fixture
def linked(tmp_path):
    """A file in a folder of its own, and a link to it."""
    (tmp_path / "deep").mkdir()
    target = tmp_path / "deep" / "real.glb"
    target.write_bytes(b"old")
    link = tmp_path / "link.glb"
    link.symlink_to("deep/real.glb")
    return link, target


def test_a_link_is_written_through(linked):
    link, target = linked
    save_bytes(link, b"new", force=True)
    assert link.is_symlink()
    assert str(link.readlink()) == "deep/real.glb"
    assert target.read_bytes() == b"new"
    assert [path.name for path in target.parent.iterdir()] == ["real.glb"]


def test_without_force_the_file_behind_a_link_is_safe(linked):
    link, target = linked
    with pytest.raises(FileExistsError, match=str(link)):
        save_bytes(link, b"new")
    assert target.read_bytes() == b"old"


def test_a_link_to_nothing_makes_the_file_that_it_names(tmp_path):
    link = tmp_path / "link.glb"
    link.symlink_to("later.glb")
    save_bytes(link, b"new")
    assert link.is_symlink()
    assert (tmp_path / "later.glb").read_bytes() == b"new"


def test_a_link_into_a_missing_folder_is_named_as_it_was_given(tmp_path):
    link = tmp_path / "link.glb"
    link.symlink_to("nowhere/later.glb")
    with pytest.raises(OSError, match=r"link\.glb"):
        save_bytes(link, b"new")


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664])
def test_permissions_are_kept(tmp_path, mode):
    target = tmp_path / "out.obj"
    target.write_bytes(b"old")
    target.chmod(mode)
    save_bytes(target, b"new", force=True)
    assert stat.S_IMODE(target.stat().st_mode) == mode
    assert target.read_bytes() == b"new"


def test_new_files_have_the_usual_permissions(tmp_path):
    (tmp_path / "usual").write_bytes(b"")
    save_bytes(tmp_path / "new", b"new")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_a_pipe_is_written_to_and_stays_one(tmp_path):
    pipe, read = tmp_path / "pipe.obj", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()), daemon=True)
    reader.start()
    save_bytes(pipe, b"through", force=True)
    reader.join(timeout=10)
    assert read == [b"through"]
    assert stat.S_ISFIFO(pipe.stat().st_mode)


@pytest.mark.parametrize("force", ["no", None, 1])
def test_force_is_true_or_false(tmp_path, force):
    with pytest.raises(InputError, match="force"):
        refuse_existing(tmp_path / "out.glb", force)
