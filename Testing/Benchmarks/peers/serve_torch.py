# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Answers the commands of limpid_energy (README.md) with PyTorch; energy.py starts it."""

import argparse
import sys
import time

import torch

import onion
import ray_energy
from serving import answer_all, give_back


class Server:
    """The energy at 0.8 times the base extinction of the onion scene."""

    def __init__(self, options):
        self.options = options
        self.device = torch.device(options.device)
        base, importance = onion.onion(options.onion)
        self.directions = onion.directions(base, importance)
        kind = {"device": self.device, "dtype": getattr(torch, options.precision)}
        self.base = torch.as_tensor(base, **kind)
        self.importance = torch.as_tensor(importance, **kind)
        self.extinction = torch.as_tensor(onion.EVALUATED * base, **kind).requires_grad_(True)
        self.energy = None
        self.held = self.allocated()

    def allocated(self):
        return torch.cuda.memory_allocated() if self.device.type == "cuda" else 0

    def finish(self):
        if self.device.type == "cuda":
            torch.cuda.synchronize()

    def timed(self, function, *arguments):
        self.finish()
        start, cpu = time.perf_counter(), time.process_time()
        terms = function(*arguments)
        self.finish()
        taken = {"seconds": time.perf_counter() - start, "cpu": time.process_time() - cpu}
        names = ("regularization", "view", "light")
        return {**dict(zip(names, map(float, terms))), **taken}

    def plan(self, _):
        start = time.perf_counter()
        self.energy = ray_energy.OnionEnergy(
            self.base, self.importance, self.options.sampler, self.options.parts,
            self.options.camera_only)
        self.finish()
        seconds = time.perf_counter() - start
        give_back()
        return {"seconds": seconds}

    def value(self, _):
        return self.timed(self.energy.value, self.extinction)

    def gradient(self, _):
        return self.timed(self.energy.value_and_gradient, self.extinction)

    def slopes(self, _):
        gradient = self.extinction.grad.cpu().double().numpy()
        return {name: float((gradient * along).sum()) for name, along in self.directions.items()}

    def difference(self, _):
        """Central differences of this energy itself; of use in float64 only."""
        step = 1e-4
        start = self.extinction.detach()
        found = {}
        for name, along in self.directions.items():
            moved = step * torch.as_tensor(along).to(start)
            totals = [sum(map(float, self.energy.value(start + side * moved))) for side in (-1, 1)]
            found[name] = (totals[1] - totals[0]) / (2 * step)
        return found

    def save(self, path):
        """Base extinction, importance and gradient per volume, as limpid_energy writes them."""
        per_volume = self.extinction.grad / self.energy.volume
        with open(path, "wb") as file:
            for field in (self.base, self.importance, per_volume):
                file.write(field.float().cpu().numpy().tobytes())
        return {}

    def memory(self, _):
        """Of a GPU: bytes held between evaluations and at their peak, the scene's arrays apart."""
        self.extinction.grad = None
        kept = self.allocated()
        torch.cuda.reset_peak_memory_stats()
        self.energy.value_and_gradient(self.extinction)
        self.finish()
        return {"kept": kept - self.held, "peak": torch.cuda.max_memory_allocated() - self.held}

    def build(self, _):
        on_gpu = self.device.type == "cuda"
        return {"name": f"PyTorch {torch.__version__}", "threads": torch.get_num_threads(),
                "device": torch.cuda.get_device_name() if on_gpu else "CPU"}


def warm_up(options):
    """Loads what is loaded late, so that it is no part of what is measured."""
    small = Server(argparse.Namespace(**{**vars(options), "onion": 16}))
    small.plan(None)
    small.gradient(None)
    small.value(None)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--onion", type=int, default=64)
    parser.add_argument("--threads", type=int, default=torch.get_num_threads())
    parser.add_argument("--device", default="cpu")
    parser.add_argument("--precision", default="float32", choices=("float32", "float64"))
    parser.add_argument("--sampler", default="planes", choices=ray_energy.SAMPLERS)
    parser.add_argument("--parts", type=int, default=1)
    parser.add_argument("--camera-only", action="store_true")
    options = parser.parse_args()
    torch.set_num_threads(options.threads)
    if options.device == "cuda" and not torch.cuda.is_available():
        sys.exit("PyTorch finds no GPU (the energy was asked for on one). Leave cuda out.")
    warm_up(options)
    answer_all(Server(options))


if __name__ == "__main__":
    main()
