# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# A simulation that makes a picture of every step by Catalyst, on one process and on two.

import os
import re
import subprocess
import tempfile
import unittest

import numpy as np

import pictures
import runner

HERE = os.path.dirname(__file__)
PIPELINE = os.path.join(HERE, "..", "..", "Documentation", "Examples", "in_situ.py")
STEPS = 3


def pictures_of(processes):
    """What the simulation draws, and what it prints."""
    with tempfile.TemporaryDirectory() as folder:
        command = [os.environ["LIMPID_MPIEXEC"], "--oversubscribe", "-n", str(processes),
                   os.environ["LIMPID_PVBATCH"], "--symmetric", os.path.join(HERE, "simulation.py"),
                   PIPELINE, str(STEPS)]
        # This process is one of MPI, too, and its own marks would be taken for a launcher's.
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith(("OMPI_COMM", "OMPI_MCA", "OPAL_", "ORTE_", "PMIX_"))}
        environment.update(LIMPID_COLOR="RTData", LIMPID_PICTURES=folder)
        run = subprocess.run(command, env=environment, text=True, timeout=120, check=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        drawn = [pictures.read(os.path.join(folder, f"step_{step:04d}.png"))
                 for step in range(STEPS)]
    return drawn, run.stdout


class TestInSitu(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.alone, cls.said = pictures_of(1)
        cls.together, cls.said_together = pictures_of(2)

    def test_every_step_has_a_picture_of_its_own(self):
        for one, next_one in zip(self.alone, self.alone[1:]):
            self.assertGreater(np.abs(one - next_one).max(), 10)  # the same step: 1

    def test_two_processes_draw_the_pictures_of_one(self):
        for alone, together in zip(self.alone, self.together):
            apart = np.abs(alone - together).max(axis=2)
            # All but the score's letters, which are blended with the view in another way.
            self.assertLessEqual(apart[:4 * len(apart) // 5].max(), 1)

    def test_says_what_is_visible_once_per_step(self):
        steps = re.compile(r"step \d: (\d+\.\d) % of the important structures is visible \(was (\d+\.\d) %\)")
        said = steps.findall(self.said)

        self.assertEqual(len(said), STEPS, self.said)
        self.assertEqual(steps.findall(self.said_together), said)
        for visible, before in said:
            self.assertGreater(float(visible), float(before))


if __name__ == "__main__":
    runner.run()
