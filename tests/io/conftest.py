"""Files that are written to be read at once."""

import pytest

import plyfold as pf
from plyfold.errors import FileFormatError


@pytest.fixture
def read(tmp_path):
    def read(name, content, **options):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return pf.read(path, **options)

    return read


@pytest.fixture
def refused(read):
    """Content that is broken is refused with a complaint, and a hint."""

    def refused(name, content, complaint):
        with pytest.raises(FileFormatError, match=complaint) as caught:
            read(name, content)
        assert caught.value.hint

    return refused
