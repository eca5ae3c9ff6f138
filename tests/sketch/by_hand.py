"""What people do with the page: they draw with real pointer events, and read what it says."""

import math
import time

import numpy as np

from plyfold import gallery

WORD = {"immersible": "A disk of cloth", "none": "No disk", "unfinished": "Not a loop yet"}

LIMIT = 300
"""Seconds after which something must have gone wrong: never how long a thing takes, however busy the machine is."""


def wait_until(happened, what):
    """Ask again and again whether something has happened."""
    end = time.monotonic() + LIMIT
    while not happened():
        assert time.monotonic() < end, f"{what}: not after {LIMIT} seconds"
        time.sleep(0.02)


def named(name, size=380):
    """Return a curve of the gallery in pixels around the middle, with a point every few of them."""
    points = gallery.CURVES[name].draw(40)
    low, high = points.min(axis=0), points.max(axis=0)
    points = (points - (low + high) / 2) * (size / (high - low).max())
    return dense(points)


def dense(corners, step=8.0):
    along = []
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        count = max(1, int(math.dist(start, end) / step))
        along += [start + (end - start) * i / count for i in range(count)]
    return np.array(along)


def places(page, points):
    box = page.locator("#drawing").bounding_box()
    middle = np.array([box["x"] + box["width"] / 2, box["y"] + box["height"] / 2 - 20])
    return (middle + np.asarray(points) * [1, -1]).tolist()


def draw(page, points):
    way = places(page, points)
    page.mouse.move(*way[0])
    page.mouse.down()
    for place in way[1:]:
        page.mouse.move(*place)
    page.mouse.up()


def verdict(page, text):
    page.wait_for_function("text => document.getElementById('verdict').textContent.startsWith(text)", arg=text)
    return page.inner_text("#sentence")


def figure(page, name):
    return page.locator("#figures div", has=page.locator(f"dt:text-is('{name}')")).locator("dd").inner_text()


def settled(page):
    page.wait_for_function("() => !document.body.classList.contains('asking')")


def saved(page):
    """Return the drawing that the page keeps now."""
    return page.evaluate("JSON.parse(localStorage['plyfold.drawing.' + sessionStorage['plyfold.id']]).document")


def eight():
    t = np.linspace(0, 2 * np.pi, 120)
    return np.c_[180 * np.sin(t), 110 * np.sin(2 * t)]


def drag(page, start, end):
    page.mouse.move(*start)
    page.mouse.down()
    for share in (0.3, 0.6, 0.9, 1.0):
        page.mouse.move(*(np.array(start) + share * (np.array(end) - start)).tolist())
    page.mouse.up()


def draw_by_finger(page, points):
    session = page.context.new_cdp_session(page)
    kinds = ["touchStart"] + ["touchMove"] * (len(points) - 1)
    for kind, (x, y) in zip(kinds, places(page, points), strict=True):
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


def touch(session, kind, *places):
    session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in places]})


def draw_by_pen(page, points, palm):
    """Draw with a pen; ``palm``, if any, is a place where the hand rests, and whether it came before the pen or during.

    The palm moves a little, and is lifted after the pen.
    """
    session = page.context.new_cdp_session(page)
    way = places(page, points)
    place, when = palm or (None, None)
    if when == "before":
        touch(session, "touchStart", place)
    pen(session, "mousePressed", way[0])
    for number, here in enumerate(way[1:]):
        if when == "during" and number == len(way) // 3:
            touch(session, "touchStart", place)
        if place and number == len(way) // 2:
            touch(session, "touchMove", [place[0] + 3, place[1] - 2])
        pen(session, "mouseMoved", here)
    pen(session, "mouseReleased", way[-1])
    if place:
        touch(session, "touchEnd")


def pen(session, kind, place):
    about = {"x": place[0], "y": place[1], "pointerType": "pen", "button": "left", "buttons": 1, "clickCount": 1}
    session.send("Input.dispatchMouseEvent", {"type": kind} | about)
