"""Clocks, and the watch over long work."""

import _thread
import signal
import threading

import pytest

from plyfold.clock import UNWATCHED, Clock, Watch
from plyfold.errors import TimeLimitError

MANY = 1_000_000


def test_a_share_of_the_time_that_is_left():
    assert Clock(None).share(1 / 2).left is None
    assert Clock(1e6).share(1 / 4).limit == pytest.approx(2.5e5)
    assert Clock(0.0).share(1 / 2).over


def test_steps_are_told():
    told = []
    watch = Watch(Clock(None), lambda *step: told.append(step)).begin("smoothing")
    watch.step()
    watch.step(0.5)
    assert told == [("smoothing", 0.0), ("smoothing", 0.5)]


@pytest.mark.parametrize("size", [1, MANY])
class TestCalls:
    def test_answer(self, size):
        assert UNWATCHED.wait_for(lambda: 42, size) == 42

    def test_error(self, size):
        with pytest.raises(ZeroDivisionError):
            UNWATCHED.wait_for(lambda: 1 // 0, size)

    def test_none_is_begun_when_the_time_is_over(self, size):
        with pytest.raises(TimeLimitError) as caught:
            Watch(Clock(0.0), stage="dividing").wait_for(lambda: 1 // 0, size)
        assert caught.value.stage == "dividing"


@pytest.fixture
def endless():
    """A call that does not come back before the test is over."""
    over = threading.Event()
    others = set(threading.enumerate())
    yield over.wait
    over.set()
    for thread in set(threading.enumerate()) - others:
        thread.join()


def test_a_call_that_does_not_come_back_in_time(endless):
    with pytest.raises(TimeLimitError, match="while waiting") as caught:
        Watch(Clock(0.01), stage="waiting").wait_for(endless, MANY)
    assert caught.value.stage == "waiting"


def test_an_interrupt_gets_through(endless):
    def interrupted():
        _thread.interrupt_main(signal.SIGINT)
        endless()

    with pytest.raises(KeyboardInterrupt):
        UNWATCHED.wait_for(interrupted, MANY)
