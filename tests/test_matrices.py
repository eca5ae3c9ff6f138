"""BLAS has one thread while anybody wants it so, and as many as before afterwards."""

import threading

import numpy as np
import pytest

import plyfold as pf
from coarse import CURVES
from plyfold.matrices import one_thread

threadpoolctl = pytest.importorskip("threadpoolctl")


@pytest.fixture(autouse=True)
def two_threads():
    with threadpoolctl.threadpool_limits(2, user_api="blas"):
        assert threads() == {2}
        yield


def threads():
    return {pool["num_threads"] for pool in threadpoolctl.threadpool_info() if pool["user_api"] == "blas"}


def test_one_within_another():
    with one_thread():
        with one_thread():
            assert threads() == {1}
        assert threads() == {1}
    assert threads() == {2}


def test_the_first_may_go_first():
    first, second = one_thread(), one_thread()
    first.__enter__()
    second.__enter__()
    first.__exit__(None, None, None)
    assert threads() == {1}
    second.__exit__(None, None, None)
    assert threads() == {2}


def test_errors_give_the_threads_back():
    with pytest.raises(ZeroDivisionError), one_thread():
        raise ZeroDivisionError
    assert threads() == {2}


def test_many_at_once():
    def work():
        for _ in range(20):
            with one_thread():
                np.linalg.solve(np.eye(3), np.ones(3))

    workers = [threading.Thread(target=work) for _ in range(6)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert threads() == {2}


def test_heights_are_found_with_one():
    seen = []
    pf.lift(CURVES["pretzel"].curve, triangles=300, progress=lambda stage, done: seen.append((done > 0, threads())))
    assert seen[0] == (False, {2})
    assert (True, {1}) in seen
    assert threads() == {2}


def test_without_the_library(monkeypatch):
    monkeypatch.setattr("plyfold.matrices._threads", lambda: None)
    with one_thread():
        assert threads() == {2}
