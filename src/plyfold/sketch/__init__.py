"""The sketching page: draw a loop and see at once how it lies (§4 of the paper).

A thin local server answers the page's questions with the pure functions of the library. What they say to each other is
written in ``PROTOCOL.md``.
"""
