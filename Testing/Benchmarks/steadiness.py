# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How steady pictures are while a camera moves and time goes on, by TemporalCoherence.

  python3 Testing/Benchmarks/steadiness.py [--coherence 0,0.1] [--degrees 1] [--frames 12]
    [--steps 20] [--size 400] [--output Documentation/Benchmarks/Steadiness.json] [SCENE...]

SCENE: a name in LIMPID_TEST_DATA, or Head, Flame, Shells, Vessels of the phantom; all of
LIMPID_TEST_DATA and Vessels by default. PYTHONPATH as for Testing/Python; it draws pictures:
Testing/with-display.sh lends a display. Then, for the page:
  python3 Testing/Benchmarks/pages/make.py Documentation/Benchmarks --pages steadiness
"""

import argparse
import glob
import os
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "Python"), str(HERE / "pages")]

import images  # noqa: E402
import machine  # noqa: E402
import volume_views  # noqa: E402
from limpid.vtkLimpidFilters import vtkExtinctionOptimizer, vtkOcclusionPhantom  # noqa: E402
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

PHANTOMS = ("Head", "Flame", "Shells", "Vessels")
NOTICEABLE = 30  # of 255


def load(name, resolution=128):
    """Image, property, importance function; of a phantom the function of an array: None."""
    if name not in PHANTOMS:
        return volume_views.scene(name) or sys.exit(f"{name} is not in LIMPID_TEST_DATA.")
    source = vtkOcclusionPhantom()
    source.SetScene(getattr(vtkOcclusionPhantom, name.upper()))
    source.SetResolution(resolution)
    source.Update()
    image = source.GetOutput()
    image.GetPointData().SetActiveScalars("Scalars")
    unit = image.GetSpacing()[0]
    extinction = ((0, 0), (0.15, 1), (0.4, 5), (0.7, 14), (1, 30))
    opacity = volume_views.opacity_of(*((value, -np.expm1(-per_length * unit))
                                        for value, per_length in extinction))
    color = volume_views.colors_of((0, 0.1, 0.2, 0.6), (0.2, 0.6, 0.6, 0.7), (0.4, 1, 1, 0.9),
                                   (0.7, 0.9, 0.2, 0.1), (1, 0.8, 0, 0))
    return image, volume_views.property_of(color, opacity, unit), None


def optimizer_for(scene):
    """A filter on a scene, whose camera is to be placed."""
    image, volume_property, importance = scene
    optimizer = vtkExtinctionOptimizer()
    optimizer.SetInputData(image)
    scalars = image.GetPointData().GetScalars().GetName()
    optimizer.SetInputArrayToProcess(0, 0, 0, 0, scalars)
    optimizer.SetInputArrayToProcess(1, 0, 0, 0, "Importance" if importance is None else scalars)
    optimizer.SetScalarOpacityFunction(volume_property.GetScalarOpacity())
    optimizer.SetScalarOpacityUnitDistance(volume_property.GetScalarOpacityUnitDistance())
    if importance is not None:
        optimizer.UseImportanceFunctionOn()
        optimizer.SetImportanceFunction(importance)
    optimizer.AutomaticPlacementOff()
    return optimizer


class Turning:
    """A volume in a view whose camera goes round it, one converged picture per step."""

    def __init__(self, scene, size, coherence=0.0):
        image, volume_property, importance = scene
        self.view = volume_views.View((size, size))
        self.mapper = vtkTransmittanceVolumeMapper()
        self.mapper.SetTemporalCoherence(coherence)
        self.mapper.SetImportanceArray("Importance" if importance is None else "")
        if importance is not None:
            self.mapper.UseImportanceFunctionOn()
            self.mapper.SetImportanceFunction(importance)
        self.view.add(image, volume_property, self.mapper)
        self.view.look()
        self.view.interact(False)

    def go(self, degrees, frames):
        """Mean number of pixels of which a channel changes noticeably from one picture to the
        next, and the mean score of all but the first."""
        before = self.view.picture()
        changed, scores = [], []
        for _ in range(frames - 1):
            self.view.camera.Azimuth(degrees)
            self.view.renderer.ResetCameraClippingRange()
            picture = self.view.picture()
            changed.append((np.abs(picture - before).max(axis=2) > NOTICEABLE).sum())
            scores.append(self.mapper.GetVisibilityScore())
            before = picture
        return float(np.mean(changed)), float(np.mean(scores))


def turn(scene, options):
    """The camera turns: with the solution of the first picture, without any, and with each value
    of TemporalCoherence."""
    frozen = Turning(scene, options.size)
    frozen.view.picture()
    frozen.mapper.PauseOptimizationOn()
    off = Turning(scene, options.size)
    off.mapper.SetOptimization(vtkTransmittanceVolumeMapper.OFF)
    result = {"frozen": frozen.go(options.degrees, options.frames)[0],
              "off": off.go(options.degrees, options.frames)[0], "pixels": [], "score": []}
    for coherence in options.coherence:
        pixels, score = Turning(scene, options.size, coherence).go(options.degrees, options.frames)
        result["pixels"].append(pixels)
        result["score"].append(score)
    return result


def time_steps(image, count):
    """The scalars, moved on by a voxel every other step, with other noise in each."""
    scalars = image.GetPointData().GetScalars()
    columns, rows, slices = image.GetDimensions()
    values = vtk_to_numpy(scalars).astype(np.float32).reshape(slices, rows, columns)
    low, high = values.min(), values.max()
    random = np.random.default_rng(1)
    for step in range(count):
        noise = random.normal(0, 0.02 * (high - low), values.shape).astype(np.float32)
        yield volume_views.image_of(
            image.GetDimensions(), image.GetSpacing(), image.GetOrigin(),
            Scalars=np.clip(np.roll(values, step // 2, axis=2) + noise, low, high).ravel())


def pass_time(scene, options):
    """Time goes on: mean share of filled nodes that flip from one step to the next, and mean score,
    by the filter. A node flips that changes by more than half the majorant, more than its base by a
    quarter."""
    image, volume_property, importance = scene
    importance = importance or volume_views.opacity_of((0, 0), (0.6, 0), (0.8, 1), (1, 1))
    result = {"flips": [], "score": []}
    for coherence in options.coherence:
        optimizer = vtkExtinctionOptimizer()
        optimizer.SetPreset("Paper")
        optimizer.SetInputArrayToProcess(0, 0, 0, 0, "Scalars")
        optimizer.SetInputArrayToProcess(1, 0, 0, 0, "Scalars")
        optimizer.SetScalarOpacityFunction(volume_property.GetScalarOpacity())
        optimizer.SetScalarOpacityUnitDistance(volume_property.GetScalarOpacityUnitDistance())
        optimizer.UseImportanceFunctionOn()
        optimizer.SetImportanceFunction(importance)
        optimizer.SetTemporalCoherence(coherence)
        before, flips, scores = None, [], []
        for step in time_steps(image, options.steps):
            optimizer.SetInputData(step)
            optimizer.Update()
            output = optimizer.GetOutput()
            base, found = images.values(output, "BaseExtinction"), images.values(output, "Extinction")
            scores.append(output.GetFieldData().GetArray("VisibilityScore").GetValue(0))
            if before is not None:
                filled = (base > 0) | (found > 0)
                changed = [np.abs(now - last)[filled] / base.max()
                           for now, last in zip((base, found), before)]
                flips.append(((changed[1] > 0.5) & (changed[1] > changed[0] + 0.25)).mean())
            before = base, found
        result["flips"].append(float(np.mean(flips)))
        result["score"].append(float(np.mean(scores)))
    return result


def all_scenes():
    pattern = os.path.join(os.environ.get("LIMPID_TEST_DATA", ""), "*.scene.json")
    return [*sorted(os.path.basename(path)[:-len(".scene.json")] for path in glob.glob(pattern)),
            "Vessels"]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--coherence", default="0,0.05,0.1,0.2")
    parser.add_argument("--degrees", type=float, default=1)
    parser.add_argument("--frames", type=int, default=12)
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--size", type=int, default=400)
    parser.add_argument("--output")
    options = parser.parse_args()
    options.coherence = [float(value) for value in options.coherence.split(",")]
    measured = {"machine": machine.facts(), "coherence": options.coherence,
                "degrees": options.degrees, "frames": options.frames, "steps": options.steps,
                "size": options.size, "scenes": {}}
    for name in options.scenes or all_scenes():
        print(name, file=sys.stderr)
        scene = load(name)
        measured["scenes"][name] = {"turn": turn(scene, options), "time": pass_time(scene, options)}
    machine.save(measured, options.output)


if __name__ == "__main__":
    main()
