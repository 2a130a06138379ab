# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Runs the tests of a script in pvpython."""

import sys
import unittest

import paraview
from paraview import simple

PARAVIEW = tuple(int(part) for part in paraview.__version__.split(".")[:2])


def run():
    """The exit code is 0 if all tests of the main module have passed."""
    if unittest.main(module="__main__", exit=False, verbosity=2).result.wasSuccessful():
        return  # at the end of a script ParaView closes its windows and processes itself
    # sys.exit does without that, and what is still there then makes ParaView crash (5.11, also
    # without a plugin: any view that was rendered is enough).
    simple.Disconnect()
    sys.exit(1)
