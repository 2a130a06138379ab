# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Whether PyTorch and Limpid have the same scene, energy and derivative: `energy.py --check`.

Derivatives are compared along three directions, where nothing is said as shares of the largest.
"""

import os
import tempfile

import numpy as np

import programs

TERMS = ("regularization", "view", "light")
SCORE = 5e-3  # what a score may be off
OURS = "derivatives, Limpid to the march's central differences"
THEIRS = "derivatives, PyTorch to the march's central differences"
PAPER = "derivatives, Limpid with Derivative = Ray (the paper's, deviation D1) to these"


def evaluated(program):
    """Energy, slopes, fields and gradient of a program."""
    program.ask("plan")
    found = {"energy": program.ask("gradient"), "slopes": program.ask("slopes")}
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "fields.raw")
        program.ask(f"save {path}")
        fields = np.fromfile(path, dtype=np.float32).reshape(3, -1)
    found["base"], found["importance"], found["gradient"] = fields
    return found


def collect(path, nodes, threads):
    found = {"march": programs.march(path, nodes, threads)}
    with programs.limpid(path, nodes, threads) as program:
        found["Limpid"] = evaluated(program)
    with programs.limpid(path, nodes, threads, derivative="ray") as program:
        found["Limpid, Ray"] = evaluated(program)
    for sampler in ("planes", "trilinear"):
        with programs.torch(nodes, threads, sampler=sampler) as program:
            found[f"PyTorch, {sampler}"] = evaluated(program)
    with programs.torch(nodes, threads, precision="float64") as program:
        found["PyTorch, float64"] = evaluated(program)
        found["difference"] = {"slopes": program.ask("difference")}
    return found


def apart(one, other):
    """Largest deviation of derivatives along directions, as a share of the largest derivative."""
    largest = max(map(abs, other.values()))
    return max(abs(one[name] - value) for name, value in other.items()) / largest


def apart_each(one, other):
    """Largest deviation of derivatives along directions, each as a share of itself."""
    return max(abs(one[name] / value - 1) for name, value in other.items())


def energy_apart(one, other):
    return max(abs(one[term] - other[term]) / abs(other[term]) for term in TERMS)


def noise(one, other, chosen):
    """Root mean square of the difference of two fields over that of the second."""
    difference = (one - other)[chosen].astype(np.float64)
    return float(np.sqrt(np.mean(difference**2) / np.mean(other[chosen].astype(np.float64) ** 2)))


def smoothed(field, nodes):
    """Mean over 3 x 3 x 3 nodes; the border stays."""
    cube = field.reshape(nodes, nodes, nodes).astype(np.float64)
    for axis in range(3):
        inner = np.moveaxis(cube, axis, 0)
        inner[1:-1] = (inner[:-2] + inner[1:-1] + inner[2:]) / 3
    return cube.ravel()


def bounds(nodes):
    """How far derivatives may be apart [of the largest].

    sum: float32 sums as many optical depths as a ray has samples.
    difference: central differences with a step of 1e-4 of the extinction leave out a sixth of the
    square of what the optical depth changes by; that is below 24, the shell twice and the core.
    discrete: Limpid discretises the derivative of the integral, PyTorch differentiates the discrete
    integral. Sums over nodes see fields through hat functions, which takes h^2 / 12 of the second
    derivative, 2 / 0.12^2 of the thin shell's size, from each of two terms that cancel.
    """
    spacing = 2 / (nodes - 1)
    return {"sum": 2 * nodes * float(np.finfo(np.float32).eps), "difference": (1e-4 * 24) ** 2 / 6,
            "discrete": 2 * spacing**2 / 12 * 2 / 0.12**2}


def findings(found, nodes):
    """Rows of what is compared, how far it is apart, and the bound; None: no bound."""
    ours, march, double = found["Limpid"], found["march"], found["PyTorch, float64"]
    planes, trilinear = found["PyTorch, planes"], found["PyTorch, trilinear"]
    limit = bounds(nodes)
    filled = ours["base"] > 0
    scene = max(float(np.abs(planes["base"] - ours["base"]).max() / ours["base"].max()),
                float(np.abs(planes["importance"] - ours["importance"]).max()))

    def slopes(one, other):
        return apart(one["slopes"], other["slopes"])

    def terms(one, other):
        return energy_apart(one["energy"], other["energy"])

    return [
        ("fields of the scene, PyTorch to Limpid [of the largest]", scene,
         float(np.finfo(np.float32).eps)),
        ("terms of the energy, PyTorch to the march", terms(planes, march), SCORE),
        ("terms of the energy, Limpid to the march", terms(ours, march), SCORE),
        ("terms of the energy, Limpid to PyTorch", terms(ours, planes), SCORE),
        ("derivatives in float64, PyTorch to its own central differences",
         slopes(double, found["difference"]), limit["difference"]),
        ("derivatives, PyTorch in float32 to float64", slopes(planes, double), limit["sum"]),
        ("derivatives, PyTorch trilinear to planes", slopes(trilinear, planes), limit["sum"]),
        (THEIRS, slopes(planes, march), limit["discrete"]),
        (OURS, slopes(ours, march), limit["discrete"]),
        ("derivatives, Limpid to PyTorch", slopes(ours, planes), limit["discrete"]),
        ("the same, each of itself", apart_each(ours["slopes"], planes["slopes"]), None),
        (PAPER, slopes(found["Limpid, Ray"], march), None),
        ("gradient at filled nodes, rms, Limpid to PyTorch",
         noise(ours["gradient"], planes["gradient"], filled), None),
        ("the same after a mean over 3 x 3 x 3 nodes",
         noise(smoothed(ours["gradient"], nodes), smoothed(planes["gradient"], nodes), filled),
         None),
    ]


def converges(coarse, fine):
    """Whether derivatives are of second order in the spacing: what they are apart falls with its
    square, here up to a third."""
    good = True
    for text in (OURS, THEIRS):
        expected = (coarse["nodes"] - 1) ** 2 / (fine["nodes"] - 1) ** 2
        fallen = fine[text] / coarse[text]
        within = fallen <= expected * 4 / 3
        good = good and within
        print(f"  {text}: {fallen:.2g} of that with {coarse['nodes']} nodes (at most "
              f"{expected * 4 / 3:.2g}){'' if within else '  TOO FAR'}")
    return good


def compare(path, nodes, threads):
    """Prints all findings of a size and returns them by their text, with `good`: whether every one
    is within its bound."""
    result = {"nodes": nodes, "good": True}
    print(f"Onion scene, {nodes} x {nodes} x {nodes} nodes, extinction 0.8 times the base:")
    for text, value, bound in findings(collect(path, nodes, threads), nodes):
        within = bound is None or value <= bound
        result["good"] = result["good"] and within
        result[text] = value
        limit = "" if bound is None else f" (at most {bound:.2g})"
        print(f"  {text}: {value:.2g}{limit}{'' if within else '  TOO FAR'}")
    return result


def run(path, sizes, threads):
    """Prints all findings of all sizes; returns whether every one is within its bound."""
    good = True
    before = None
    for nodes in sorted(sizes):
        result = compare(path, nodes, threads)
        good = result["good"] and good
        good = (before is None or converges(before, result)) and good
        before = result
    return good
