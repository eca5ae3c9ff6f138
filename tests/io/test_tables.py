import io

import numpy as np
import pytest

from plyfold.errors import CurveError, FileFormatError, StrokeError
from plyfold.io.shapes import outline_of_shapes
from plyfold.io.tables import shapes_in_npy, shapes_in_table


def read_npy(data):
    return outline_of_shapes(shapes_in_npy(data))


def read_table(text):
    return outline_of_shapes(shapes_in_table(text))


TRIANGLE = [[0, 0], [4, 0], [0, 3]]


def npy(array, **options):
    file = io.BytesIO()
    np.save(file, array, **options)
    return file.getvalue()


@pytest.mark.parametrize(
    "text",
    [
        "0,0\n4,0\n0,3",
        "0 0\n4 0\n0 3\n",
        "0;0\n4;0\n0;3\n",
        "0\t0\n4\t0\n0\t3\n",
        "  0 , 0\r\n4  ,0\r\n0,   3\r\n",
        "0,0\r4,0\r0,3\r",
        "x,y\n0,0\n4,0\n0,3",
        "# a loop\n# x y\nx y\n0 0 # start\n4 0\n#\n0 3",
        "\n\n0,0\n4,0\n0,3\n\n\n",
        "0,0\n4,0\n0,3\n0,0",
        "0.0,-0.0\n4e0,0\n+0,.3e1",
    ],
)
def test_one_block_is_a_list_of_points_with_the_closing_edge_implied(text):
    curve = read_table(text)
    assert curve.points.tolist() == TRIANGLE
    assert curve.repairs == ()


def test_blocks_between_empty_lines_are_strokes():
    assert read_table("0,0\n4,0\n\n0,3\n4,0\n \n\n0,0\n0,3").points.tolist() == TRIANGLE
    with pytest.raises(StrokeError):
        read_table("0,0\n4,0\n\n0,3\n0,0")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0,0\n4,0\n0,three", "line 3: 'three' is not a finite number"),
        ("0,0\n\n# note\n4,nan\n0,3", "line 4: 'nan' is not a finite number"),
        ("0,0\n4,inf\n0,3", "line 2: 'inf'"),
        ("0,0\n4\n0,3", "line 2: 1 numbers"),
        ("x,y,z\n0,0,0,0\n4,0,0,0", "line 2: 4 numbers"),
        ("0,0;1,5\n", "line 1: 4 numbers"),
        ("0,,0\n", "line 1: '' is not"),
        ("x,y\nx,y\n0,0", "line 2: 'x' is not"),
        ("# nothing\n", "no points"),
        ("x y", "no points"),
    ],
)
def test_broken_tables_name_the_line(text, message):
    with pytest.raises(FileFormatError, match=message) as caught:
        read_table(text)
    assert caught.value.hint


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.int32, ">f8", np.uint8])
def test_npy(dtype):
    assert read_npy(npy(np.array(TRIANGLE, dtype=dtype))).points.tolist() == TRIANGLE


def test_npy_in_fortran_order():
    assert read_npy(npy(np.asfortranarray(TRIANGLE))).points.tolist() == TRIANGLE


def huge_header():
    file = io.BytesIO()
    np.lib.format.write_array_header_1_0(file, {"descr": "<f8", "fortran_order": False, "shape": (10**15, 2)})
    return file.getvalue()


@pytest.mark.parametrize(
    "data",
    [
        b"\x93NUMPY",
        b"\x93NUMPY\x01\x00\x05\x00{{{{{",
        b"\x93NUMPY\x09\x00",
        npy(TRIANGLE)[:-3],
        npy(np.array([{}, []], dtype=object), allow_pickle=True),
        huge_header(),
        b"something else",
    ],
    ids=range(7),
)
def test_broken_npy(data):
    with pytest.raises(FileFormatError, match="no plain NPY array") as caught:
        read_npy(data)
    assert "\n" not in caught.value.message


@pytest.mark.parametrize("array", [np.zeros((3, 3)), np.zeros(4), np.zeros((4, 2), dtype=complex), np.zeros((0, 2))])
def test_npy_without_a_curve(array):
    with pytest.raises(CurveError):
        read_npy(npy(array))


def test_npy_written_by_python_2_gives_no_warning():
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (3L, 2L), }"
    header = header.ljust(117) + b"\n"
    data = b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header + np.array(TRIANGLE, dtype="<f8").tobytes()
    assert read_npy(data).points.tolist() == TRIANGLE
