# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Answers the commands of limpid_energy --camera-only (README.md) with Mitsuba 3; energy.py starts
it. Every value and gradient has new random numbers."""

import argparse
import time

import drjit as dr
import mitsuba as mi
import numpy as np

import onion
from serving import answer_all

VARIANT = "llvm_ad_mono"


class Server:
    """The camera's term at 0.8 times the base extinction of the onion scene."""

    def __init__(self, options):
        self.options = options
        self.base, self.importance = onion.onion(options.onion)
        self.directions = onion.directions(self.base, self.importance)
        self.score = None
        self.gradients = [None, None]  # the one before the last, and the last

    def plan(self, _):
        from mitsuba_score import Score  # pylint: disable=import-outside-toplevel; after main

        start, cpu = time.perf_counter(), time.process_time()
        self.score = Score(self.options.onion, onion.EVALUATED * self.base, self.importance,
                           self.options.integrator, self.options.pixels)
        return self.seconds_since(start, cpu)

    @staticmethod
    def seconds_since(start, cpu):
        return {"seconds": time.perf_counter() - start, "cpu": time.process_time() - cpu}

    def answer(self, score, start, cpu):
        return {"regularization": 0.0, "view": -onion.VIEW * score, "light": 0.0,
                **self.seconds_since(start, cpu)}

    def value(self, _):
        start, cpu = time.perf_counter(), time.process_time()
        return self.answer(self.score.value(), start, cpu)

    def gradient(self, _):
        start, cpu = time.perf_counter(), time.process_time()
        score, gradient = self.score.value_and_gradient()
        answer = self.answer(score, start, cpu)
        self.gradients = [self.gradients[1], gradient.astype(np.float64)]
        return answer

    def slopes(self, _):
        gradient = -onion.VIEW * self.gradients[1]
        return {name: float((gradient * along).sum()) for name, along in self.directions.items()}

    def noise(self, _):
        """Of the last two gradients at the nodes, over the gradient: root mean squares. The mean of
        the product of two that know nothing of each other is that of the square without noise."""
        before, last = self.gradients
        noise, signal = np.mean((before - last) ** 2) / 2, np.mean(before * last)
        return {"share": float(np.sqrt(noise / max(signal, 1e-300)))}

    def build(self, _):
        return {"name": f"Mitsuba {mi.__version__}, {VARIANT}", "threads": dr.thread_count(),
                "device": "CPU"}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--onion", type=int, default=64)
    parser.add_argument("--threads", type=int, default=dr.thread_count())
    parser.add_argument("--integrator", default="prbvolpath")
    parser.add_argument("--pixels", type=int, default=256, help="of the picture's side: rays")
    options = parser.parse_args()
    dr.set_thread_count(options.threads)
    mi.set_variant(VARIANT)
    import emission  # noqa: F401 pylint: disable=import-outside-toplevel,unused-import; registers

    answer_all(Server(options))


if __name__ == "__main__":
    main()
