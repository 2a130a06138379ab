# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How far a computation is, for whoever waits for it."""


class Report:
    """Between the core and a caller's `progress`: the share that is told never falls, and the last
    one is 1 unless the caller has stopped the work.

    tell: called with a share in [0, 1] and a text; returns False to stop.
    """

    def __init__(self, tell):
        self.tell = tell
        self.share = 0.0
        self.text = "Done"
        self.is_stopped = False

    def __call__(self, share, text):
        self.share = max(self.share, min(share, 1.0))
        self.text = text or self.text
        self.is_stopped = self.tell(self.share, text) in (False,)
        return not self.is_stopped

    def finish(self):
        """Tells that all is done."""
        if self.share < 1 and not self.is_stopped:
            self(1.0, self.text)


def report_to(progress):
    """A Report, checked; None: nobody wants to know."""
    if progress is not None and not callable(progress):
        raise ValueError(f"progress is {progress!r} (it is called with the fraction of the work "
                         "done and a text). Give a function, like print.")
    return None if progress is None else Report(progress)
