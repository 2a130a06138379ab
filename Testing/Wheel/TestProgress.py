# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Progress of all long calls, and the bar that shows it with the time that is left.

import contextlib
import io
import unittest

import limpid

import phantom
from phantom import COLORS, SCENE

DRAWN = {name: value for name, value in SCENE.items() if name != "importance_function"}
CALLS = {
    "optimize": lambda progress: limpid.optimize(phantom.scalars(), **SCENE, progress=progress),
    "viewpoints": lambda progress: limpid.viewpoints(
        phantom.scalars(), **SCENE, number_of_directions=42, progress=progress),
    "render": lambda progress: limpid.render(
        phantom.scalars(), **DRAWN, color_function=COLORS, width=400, height=400,
        progress=progress)}


class Terminal(io.StringIO):
    def isatty(self):
        return True


class Clock:
    """A clock that is set by hand."""

    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


def bar_on(stream, *events):
    """What a bar writes of (time since the start, share, text)."""
    clock = Clock()
    bar = limpid.ProgressBar(stream, clock=clock)
    for elapsed, share, text in events:
        clock.now = 100.0 + elapsed
        bar(share, text)
    return stream.getvalue()


class TestCalls(unittest.TestCase):
    def test_all_long_ones_tell_shares_that_never_fall_and_end_at_one(self):
        for name, call in CALLS.items():
            told = []
            with self.subTest(name):
                call(lambda share, text: told.append((share, text)))
                shares = [share for share, _ in told]
                self.assertEqual(shares, sorted(shares))
                self.assertEqual(shares[-1], 1)
                self.assertTrue(all(text for _, text in told))

    def test_all_long_ones_show_a_bar(self):
        for name, call in CALLS.items():
            said = io.StringIO()
            with self.subTest(name), contextlib.redirect_stderr(said):
                call(True)
                self.assertIn("100 % [" + 30 * "#" + "]", said.getvalue())

    def test_an_exception_of_the_listener_ends_them(self):
        def fail(share, text):
            raise LookupError("the listener's own")
        for name, call in CALLS.items():
            with self.subTest(name), self.assertRaisesRegex(LookupError, "own"):
                call(fail)

    def test_what_cannot_be_called_is_refused(self):
        for name, call in CALLS.items():
            with self.subTest(name), self.assertRaisesRegex(ValueError, "progress is 3"):
                call(3)


class TestBar(unittest.TestCase):
    def test_tells_the_time_that_is_left(self):
        said = bar_on(Terminal(), (0, 0, "Begin"), (10, 0.25, "Go on"), (90, 0.5, "Go on"))

        self.assertIn("  0 % [..............................] 0 s: Begin", said)
        self.assertIn(" 25 % [########......................] 10 s, about 30 s left: Go on", said)
        self.assertIn("1 min 30 s, about 1 min 30 s left", said)

    def test_writes_one_line_in_a_terminal_and_ends_it(self):
        said = bar_on(Terminal(), (1, 0.1, "A long text"), (2, 0.5, "Short"), (3, 1, "Short"))

        self.assertEqual(said.count("\n"), 1)
        self.assertTrue(said.endswith("\n"))
        lines = said.strip("\r\n").split("\r")
        self.assertGreaterEqual(len(lines[1]), len(lines[0]))  # it covers the line before

    def test_writes_a_line_now_and_then_elsewhere(self):
        said = bar_on(io.StringIO(), *((second, second / 20, "Go on") for second in range(21)))

        self.assertNotIn("\r", said)
        self.assertEqual(said.count("\n"), 5)  # at 0, 5, 10, 15 and 20 s

    def test_says_long_times_in_hours(self):
        said = bar_on(Terminal(), (3600, 0.5, "Go on"))
        self.assertIn("1 h 00 min, about 1 h 00 min left", said)


if __name__ == "__main__":
    unittest.main()
