# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What Limpid writes to the log of VTK."""

import os
import subprocess
import sys
import unittest

PROGRAM = """
from limpid import vtkLimpidFilters
from images import phantom

for name in ("vtkExtinctionOptimizer", "vtkViewpointSearch"):
    made = getattr(vtkLimpidFilters, name)()
    made.SetInputData(phantom(12))
    made.SetExtinctionSource(made.ARRAY)
    if name == "vtkViewpointSearch":
        made.SetNumberOfDirections(12)
    made.Update()
"""


def log_with(**environment):
    """Runs the program; returns what it writes to standard error."""
    here = os.path.dirname(os.path.abspath(__file__))
    clean = {key: value for key, value in os.environ.items() if key != "LIMPID_LOG_VERBOSITY"}
    path = os.pathsep.join([here, *sys.path])
    return subprocess.run([sys.executable, "-c", PROGRAM], check=True, text=True,
                          stderr=subprocess.PIPE,
                          env={**clean, "PYTHONPATH": path, **environment}).stderr


class LogTest(unittest.TestCase):

    def test_says_nothing_by_default(self):
        self.assertEqual(log_with(), "")

    def test_tells_of_each_run_if_asked(self):
        log = log_with(LIMPID_LOG_VERBOSITY="INFO")
        for text in ("Extinction Optimizer: 12 x 12 x 12 points", "GB of memory needed",
                     "Iteration 1", "of the important structures visible",
                     "Viewpoint Search: 12 x 12 x 12 points, 12 directions", "viewpoints after"):
            self.assertIn(text, log)

    def test_takes_no_other_words_for_a_verbosity(self):
        self.assertEqual(log_with(LIMPID_LOG_VERBOSITY="loud"), "")


if __name__ == "__main__":
    unittest.main()
