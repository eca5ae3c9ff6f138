"""Worker processes: time limits, pages that go, and processes that come and go with them."""

import json
import socket
import threading

import numpy as np
import pytest

from plyfold.sketch.workers import Question, Workers
from sketch.by_hand import LIMIT, wait_until

RAMP = json.dumps(
    {"version": 3, "points": [[0, 0], [9, 0], [9, 6], [3, 6], [3, -3], [4, -3], [4, 5], [8, 5], [8, 1], [0, 1]]}
).encode()
SLOW = json.dumps({"version": 3, "points": np.random.default_rng(1).random((5000, 2)).tolist()}).encode()


@pytest.fixture(scope="module")
def workers():
    running = Workers()
    yield running
    running.close()


def kind(answer):
    return json.loads(answer.body).get("error", {}).get("kind")


def test_what_takes_too_long_is_ended_and_the_next_question_answered(workers):
    late = workers.ask(Question("look", SLOW, {}, 0.3))
    assert (late.status, kind(late)) == (503, "time limit")
    assert "0.3 seconds" in json.loads(late.body)["error"]["sentence"]
    assert workers.ask(Question("look", RAMP, {}, LIMIT)).status == 200


def test_a_page_that_goes_ends_its_question(workers):
    page, server = socket.socketpair()
    threading.Thread(target=close_when_asked, args=(page, workers)).start()
    assert kind(workers.ask(Question("look", SLOW, {}, LIMIT), server)) == "superseded"
    server.close()


def close_when_asked(page, workers):
    wait_until(lambda: workers._working, "the question has arrived")
    page.close()


def test_a_page_that_already_sends_its_next_question_has_not_gone(workers):
    page, server = socket.socketpair()
    page.sendall(b"POST")
    assert workers.ask(Question("look", RAMP, {}, LIMIT), server).status == 200
    assert server.recv(4) == b"POST"
    page.close()
    server.close()


def test_only_the_newest_of_many_questions_of_a_page_is_answered(workers):
    found = {}

    def ask(number, body):
        found[number] = kind(workers.ask(Question("look", body, {}, LIMIT, ("page", "look"))))

    threads = []
    for number, body in enumerate([SLOW] * 4 + [RAMP]):
        threads.append(threading.Thread(target=ask, args=(number, body)))
        threads[-1].start()
        if body is SLOW:
            wait_until(lambda n=number: len(found) == n and len(workers._working) == 1, "it has taken its place")
    for thread in threads:
        thread.join(LIMIT)
    assert found == {0: "superseded", 1: "superseded", 2: "superseded", 3: "superseded", 4: None}


def test_no_error_gets_out_of_a_worker(workers):
    answer = workers.ask(Question("dance", b"", {}, LIMIT))
    assert (answer.status, kind(answer)) == (500, "internal")
    assert b"Traceback" not in answer.body
