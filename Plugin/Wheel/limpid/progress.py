# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How far a computation is, for whoever waits for it."""

from __future__ import annotations

import sys
import time
from typing import Callable, TextIO

from .given import Progress

BAR = 30  # characters
LINES_APART = 5.0  # seconds between lines where a line cannot be written again


def words_for(seconds: float) -> str:
    """A duration: "8 s", "2 min 05 s" or "1 h 10 min"."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


class ProgressBar:
    """Writes the share of the work that is done, the time that it took, and the time that is left.

    Functions make one for ``progress=True``. The time left assumes that the rest is as fast as what
    is done. An optimisation that converges early takes less. In a terminal and in a notebook one
    line is written again and again; elsewhere there is a line every 5 seconds.

    Parameters
    ----------
    stream : file, optional
        Where to write. Default is the standard error output.

    Examples
    --------
    >>> found = optimize(volume, progress=ProgressBar(sys.stdout))
    """

    def __init__(self, stream: TextIO | None = None, *,
                 clock: Callable[[], float] = time.monotonic) -> None:
        self._stream = sys.stderr if stream is None else stream
        self._clock = clock
        self._start = clock()
        self._last_line: float | None = None
        self._width = 0
        notebook = type(self._stream).__module__.startswith("ipykernel")
        self._rewrites = notebook or self._stream.isatty()

    def __call__(self, share: float, text: str) -> None:
        """Shows progress.

        Parameters
        ----------
        share : float
            Share of the work that is done [0, 1].
        text : str
            What is being done.
        """
        elapsed = self._clock() - self._start
        line = self.line(share, text, elapsed)
        if self._rewrites:
            padded = line.ljust(self._width)
            self._width = len(line)
            self._stream.write("\r" + padded + ("\n" if share >= 1 else ""))
        elif share >= 1 or self._last_line is None or elapsed - self._last_line >= LINES_APART:
            self._last_line = elapsed
            self._stream.write(line + "\n")
        self._stream.flush()

    @staticmethod
    def line(share: float, text: str, elapsed: float) -> str:
        """What is written.

        Parameters
        ----------
        share : float
            Share of the work that is done [0, 1].
        text : str
            What is being done.
        elapsed : float
            Time since the start [s].

        Returns
        -------
        str
            The line, without its end.
        """
        done = round(BAR * share)
        line = f"{100 * share:3.0f} % [{'#' * done}{'.' * (BAR - done)}] {words_for(elapsed)}"
        if share >= 1:
            return line
        left = f", about {words_for(elapsed * (1 - share) / share)} left" if share > 0 else ""
        return f"{line}{left}: {text}"


class Report:
    """Between the core and a caller's `progress`: the share that is told never falls, and the last
    one is 1 unless the caller has stopped the work.

    tell: called with a share in [0, 1] and a text; returns False to stop.
    """

    def __init__(self, tell: Callable[[float, str], object]) -> None:
        self.tell = tell
        self.share = 0.0
        self.text = "Done"
        self.is_stopped = False

    def __call__(self, share: float, text: str) -> bool:
        self.share = max(self.share, min(share, 1.0))
        self.text = text or self.text
        self.is_stopped = self.tell(self.share, text) in (False,)
        return not self.is_stopped

    def finish(self) -> None:
        """Tells that all is done."""
        if self.share < 1 and not self.is_stopped:
            self(1.0, self.text)


def report_to(progress: Progress) -> Report | None:
    """A Report, checked; None: nobody wants to know."""
    if progress is True:
        return Report(ProgressBar())
    if progress is None or progress is False:
        return None
    if not callable(progress):
        raise ValueError(f"progress is {progress!r} (it is called with the fraction of the work "
                         "done and a text). Give True, or a function, like print.")
    return Report(progress)
