# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What opaque geometry hides of a volume is not seen: in scores, and in coarse pictures.

import math
import unittest

import numpy as np
from vtkmodules.vtkFiltersSources import vtkPlaneSource

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import (View, actor_of, colors_of, gray_property, image_of, opacity_of,
                          plain_mapper, property_of, save, sphere)

NODES = 41
SPACING = 2.0 / (NODES - 1)
VIEW_ANGLE = 30.0
DISTANCE = 5.0
ORANGE = (0.9, 0.5, 0.1)
WALL = (0.2, 0.4, 0.3)


def blobs():
    """Scalars and importance at the nodes of the cube [-1, 1]^3: two important cores in haze."""
    axis = np.linspace(-1, 1, NODES)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    cores = sum(np.exp(-((x - a)**2 + (y - b)**2 + (z - c)**2) / 0.04)
                for a, b, c in ((-0.45, 0.1, 0.2), (0.4, -0.2, -0.3)))
    return np.clip(0.05 + cores, 0, 1), np.clip(2 * cores - 0.4, 0, 1)


OPACITY = ((0, 0.0), (0.05, 0.004), (0.5, 0.12), (1, 0.3))


def blob_property():
    return property_of(colors_of((0, 0.3, 0.3, 0.9), (1, *ORANGE)), opacity_of(*OPACITY), SPACING)


def sampled(field, points):
    """Trilinear, at points of [-1, 1]^3 (x, y, z in the last axis); 0 outside."""
    index = (points + 1) / SPACING
    inside = np.all((index >= 0) & (index <= NODES - 1), axis=-1)
    first = np.clip(index.astype(int), 0, NODES - 2)
    weight = np.clip(index - first, 0, 1)
    found = np.zeros(points.shape[:-1])
    for corner in range(8):
        step = [corner >> axis & 1 for axis in range(3)]
        share = np.prod([weight[..., axis] if step[axis] else 1 - weight[..., axis]
                         for axis in range(3)], axis=0)
        i, j, k = (first[..., axis] + step[axis] for axis in range(3))
        found += share * field[k, j, i]
    return np.where(inside, found, 0.0)


def visible_share(ends):
    """A march of its own along the rays of pixels from (0, 0, DISTANCE): the share of important
    matter that is seen in front of `ends(x, y)`, the distance at which a ray of unit depth ends."""
    scalars, importance = blobs()
    opacity = np.interp(scalars, *zip(*OPACITY))
    extinction = -np.log1p(-opacity) / SPACING
    pixels = 150
    half = math.tan(math.radians(VIEW_ANGLE / 2))
    across = half * (2 * (np.arange(pixels) + 0.5) / pixels - 1)
    x, y = np.meshgrid(across, across)
    length = np.sqrt(1 + x**2 + y**2)
    end = ends(x, y)
    depth = np.zeros_like(x)
    seen = 0.0
    important = 0.0
    step = 0.25 * SPACING
    for z in np.arange(DISTANCE - 1 + step / 2, DISTANCE + 1, step):
        points = np.stack((x * z, y * z, np.full_like(x, DISTANCE - z)), axis=-1)
        mu = sampled(extinction, points)
        matter = sampled(importance, points) * mu * z**2
        thickness = mu * step * length
        middle = np.exp(-depth - thickness / 2)
        important += matter.sum()
        # The last step of a ray counts in part.
        seen += (matter * middle * np.clip((end - z) / step + 0.5, 0, 1)).sum()
        depth += thickness
    return seen / important


def look(view):
    view.camera.SetPosition(0, 0, DISTANCE)
    view.camera.SetFocalPoint(0, 0, 0)
    view.camera.SetViewAngle(VIEW_ANGLE)
    view.renderer.ResetCameraClippingRange()


def blob_view(**properties):
    scalars, importance = blobs()
    image = image_of((NODES,) * 3, (SPACING,) * 3, (-1, -1, -1),
                     scalars=scalars.astype(np.float32).ravel(),
                     Importance=importance.astype(np.float32).ravel())
    view, mapper = show(image, blob_property(), size=(300, 300), **properties)
    look(view)
    return view, mapper


def ball(center, radius):
    return sphere(center, radius, resolution=160)


def ball_ends(center, radius):
    def ends(x, y):
        # |t (x, y, -1) + (0, 0, DISTANCE) - center| = radius
        along = np.stack((x, y, -np.ones_like(x)), axis=-1)
        start = np.array((0, 0, DISTANCE)) - np.array(center)
        a = (along**2).sum(axis=-1)
        b = (along * start).sum(axis=-1)
        root = b**2 - a * ((start**2).sum() - radius**2)
        return np.where(root > 0, (-b - np.sqrt(np.abs(root))) / a, np.inf)
    return ends


def wall(corner, one, other):
    source = vtkPlaneSource()
    source.SetOrigin(*corner)
    source.SetPoint1(*one)
    source.SetPoint2(*other)
    return source


# A ball before one of the cores and one that cuts the other, a leaning wall through both, and a
# wall in the middle. With where the ray (x, y, -1) from the eye ends.
CASES = {
    "ball in front": (lambda: ball((-0.45, 0.1, 0.7), 0.22), ball_ends((-0.45, 0.1, 0.7), 0.22)),
    "ball in a core": (lambda: ball((0.4, -0.2, -0.3), 0.12), ball_ends((0.4, -0.2, -0.3), 0.12)),
    # z = 0.6 x
    "leaning wall": (lambda: wall((-3, -3, -1.8), (3, -3, 1.8), (-3, 3, -1.8)),
                     lambda x, y: DISTANCE / (1 + 0.6 * x)),
    "wall in the middle": (lambda: wall((-3, -3, 0), (3, -3, 0), (-3, 3, 0)),
                           lambda x, y: np.full_like(x, DISTANCE)),
}


class TestOpaque(MapperTest):
    def test_the_share_is_that_of_a_march_to_the_geometry(self):
        view, mapper = blob_view(Method=Mapper.ORDINARY)
        view.window.Render()
        free = visible_share(lambda x, y: np.full_like(x, np.inf))
        self.assertAlmostEqual(mapper.GetVisibleFraction(), free, delta=0.01 * free)
        for name, (source, ends) in CASES.items():
            with self.subTest(name=name):
                view, mapper = blob_view(Method=Mapper.ORDINARY)
                view.renderer.AddActor(actor_of(source(), WALL))
                save(view.picture(), "opaque-" + name.replace(" ", "-"))
                expected = visible_share(ends)
                self.assertLess(expected, 0.97 * free)
                self.assertAlmostEqual(mapper.GetVisibleFraction(), expected,
                                       delta=0.01 * free)
                self.assertAlmostEqual(mapper.GetBaseVisibleFraction(), expected,
                                       delta=0.01 * free)
                self.assert_fine(view)

    def test_an_optimized_volume_is_seen_in_front_of_it(self):
        view, mapper = blob_view()
        view.window.Render()
        free = {name: getattr(mapper, "Get" + name)() for name in (
            "VisibleFraction", "VisibilityScore", "AttainableFraction", "SacrificedFraction",
            "AttainableScore", "AttainableLightScore")}
        actor = actor_of(CASES["wall in the middle"][0](), WALL)
        view.renderer.AddActor(actor)
        view.window.Render()
        for name in ("VisibleFraction", "VisibilityScore", "AttainableFraction",
                     "AttainableScore"):
            self.assertTrue(0 < getattr(mapper, "Get" + name)() < 0.9 * free[name], name)
        self.assertLessEqual(mapper.GetVisibleFraction(), mapper.GetAttainableFraction())
        for name in ("SacrificedFraction", "AttainableLightScore"):
            self.assertEqual(getattr(mapper, "Get" + name)(), free[name])
        # What goes away hides nothing, and what hides all leaves nothing.
        actor.VisibilityOff()
        view.window.Render()
        for name, value in free.items():
            self.assertEqual(getattr(mapper, "Get" + name)(), value, name)
        view.renderer.AddActor(actor_of(wall((-3, -3, 1.5), (3, -3, 1.5), (-3, 3, 1.5)), WALL))
        view.window.Render()
        self.assertEqual(mapper.GetVisibleFraction(), 0)
        self.assertEqual(mapper.GetVisibilityScore(), 0)
        self.assert_fine(view)

    def test_what_is_behind_the_volume_changes_no_bit(self):
        view, mapper = blob_view()
        view.window.Render()
        numbers = (mapper.GetVisibleFraction(), mapper.GetVisibilityScore(),
                   mapper.GetAttainableFraction())
        view.renderer.AddActor(actor_of(wall((-3, -3, -1.2), (3, -3, -1.2), (-3, 3, -1.2)), WALL))
        view.window.Render()
        self.assertEqual((mapper.GetVisibleFraction(), mapper.GetVisibilityScore(),
                          mapper.GetAttainableFraction()), numbers)

    def test_it_counts_where_surfaces_are_peeled(self):
        view, mapper = blob_view(Method=Mapper.ORDINARY)
        view.renderer.AddActor(actor_of(CASES["leaning wall"][0](), WALL))
        view.window.Render()
        expected = mapper.GetVisibleFraction()
        view.renderer.AddActor(actor_of(ball((0, 0, 2), 0.3), WALL, 0.3))
        view.renderer.UseDepthPeelingOn()
        view.renderer.UseDepthPeelingForVolumesOn()
        view.window.Render()
        self.assertAlmostEqual(mapper.GetVisibleFraction(), expected, delta=1e-6)
        self.assert_fine(view)

    def test_nothing_behind_it_shines_through_while_it_is_coarse(self):
        # A block behind the middle of a ball: wherever the ball is seen, nothing is before it.
        scalars = np.zeros((17, 17, 17), np.float32)
        scalars[:8] = 1
        image = image_of((17, 17, 17), (1, 1, 1), (-8, -8, -8), scalars=scalars.ravel())
        view = View((300, 300))
        mapper = plain_mapper()
        view.add(image, property_of(colors_of((0, *ORANGE), (1, *ORANGE)),
                                    opacity_of((0, 0), (0.01, 0), (1, 0.9)), 1.0), mapper)
        actor = actor_of(ball((0, 0, 0), 5), WALL)
        view.renderer.AddActor(actor)
        view.camera.SetPosition(0, 0, 50)
        view.camera.SetFocalPoint(0, 0, 0)
        view.renderer.ResetCameraClippingRange()
        view.picture()
        mapper.SetInteractiveFrameTime(0.002)
        view.interact(True)
        for _ in range(6):
            coarse = view.picture()
        save(coarse, "opaque-coarse")
        rows, columns = np.indices(coarse.shape[:2])
        scale = 150 / math.tan(math.radians(15)) / 50
        covered = np.hypot(rows - 149.5, columns - 149.5) < 5 * scale - 2
        self.assertLess(np.abs(coarse[covered] - 255 * np.array(WALL)).max(), 4)


if __name__ == "__main__":
    unittest.main()
