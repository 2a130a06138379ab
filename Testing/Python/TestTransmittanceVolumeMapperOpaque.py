# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What opaque geometry hides of a volume is not seen: in scores, and in coarse pictures.

import math
import unittest

import numpy as np
from vtkmodules.vtkFiltersSources import vtkPlaneSource

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper as Mapper

from mapper_tests import MapperTest, show
from volume_views import (View, actor_of, colors_of, gray_property, image_of, opacity_of,
                          plain_mapper, property_of, save, sphere, values)

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


def sampled(fields, points):
    """Trilinear, at points of [-1, 1]^3 (x, y, z in the last axis); 0 outside."""
    index = (points + 1) / SPACING
    inside = np.all((index >= 0) & (index <= NODES - 1), axis=-1)
    first = np.clip(index[inside].astype(int), 0, NODES - 2)
    weight = np.clip(index[inside] - first, 0, 1)
    found = np.zeros((len(fields), *points.shape[:-1]))
    for corner in range(8):
        step = [corner >> axis & 1 for axis in range(3)]
        share = np.prod([weight[..., axis] if step[axis] else 1 - weight[..., axis]
                         for axis in range(3)], axis=0)
        i, j, k = (first[..., axis] + step[axis] for axis in range(3))
        for number, field in enumerate(fields):
            found[number, inside] += share * field[k, j, i]
    return found


def axes_of(eye):
    """The directions to the right, upwards and ahead of a camera at `eye` that looks at the origin."""
    ahead = -np.array(eye) / np.linalg.norm(eye)
    right = np.cross(ahead, (0, 1, 0))
    right /= np.linalg.norm(right)
    return right, np.cross(right, ahead), ahead


def visible_shares(eye, ends, extinction=None):
    """A march of its own along the rays of pixels from `eye`: the shares of important matter that
    are seen in front of each of `ends`, functions of the eye and the rays, which give the distance at
    which a ray of unit depth ends. `extinction` [z, y, x] is in place of that of the functions."""
    scalars, importance = blobs()
    base = -np.log1p(-np.interp(scalars, *zip(*OPACITY))) / SPACING
    extinction = base if extinction is None else extinction
    shown = np.minimum(base, extinction)  # matter that is added does not count
    pixels = 150
    half = math.tan(math.radians(VIEW_ANGLE / 2))
    across = half * (2 * (np.arange(pixels) + 0.5) / pixels - 1)
    x, y = np.meshgrid(across, across)
    right, up, ahead = axes_of(eye)
    rays = x[..., None] * right + y[..., None] * up + ahead
    length = np.sqrt(1 + x**2 + y**2)
    last = [end(np.array(eye), rays) for end in ends]
    depth = np.zeros_like(x)
    seen = np.zeros(len(ends))
    important = 0.0
    step = 0.25 * SPACING
    reach = np.abs(ahead).sum()  # of the cube along the direction of view
    for z in np.arange(DISTANCE - reach + step / 2, DISTANCE + reach, step):
        in_base, in_shown, mu, g = sampled((base, shown, extinction, importance), eye + z * rays)
        thickness = mu * step * length
        light = np.exp(-depth - thickness / 2) * in_shown * g * z**2
        important += (g * in_base * z**2).sum()
        # The last step of a ray counts in part.
        seen += [(light * np.clip((end - z) / step + 0.5, 0, 1)).sum() for end in last]
        depth += thickness
    return seen / important


def blob_view(eye=(0, 0, DISTANCE), **properties):
    scalars, importance = blobs()
    image = image_of((NODES,) * 3, (SPACING,) * 3, (-1, -1, -1),
                     scalars=scalars.astype(np.float32).ravel(),
                     Importance=importance.astype(np.float32).ravel())
    view, mapper = show(image, blob_property(), size=(300, 300), **properties)
    view.camera.SetPosition(*eye)
    view.camera.SetFocalPoint(0, 0, 0)
    view.camera.SetViewUp(0, 1, 0)
    view.camera.SetViewAngle(VIEW_ANGLE)
    view.renderer.ResetCameraClippingRange()
    return view, mapper


def ball(center, radius):
    return sphere(center, radius, resolution=160)


def ball_ends(center, radius):
    def ends(eye, rays):
        # |eye + t ray - center| = radius
        start = eye - np.array(center)
        a = (rays**2).sum(axis=-1)
        b = rays @ start
        root = b**2 - a * (start @ start - radius**2)
        return np.where(root > 0, (-b - np.sqrt(np.abs(root))) / a, np.inf)
    return ends


def wall_ends(normal):
    """Of a wall through the origin, which lies between the eye and what it hides."""
    def ends(eye, rays):
        return np.array(normal) @ eye / -(rays @ normal)
    return ends


def no_ends(_, rays):
    return np.full(rays.shape[:-1], np.inf)


def wall(corner, one, other):
    source = vtkPlaneSource()
    source.SetOrigin(*corner)
    source.SetPoint1(*one)
    source.SetPoint2(*other)
    return source


LEANING = ((-3, -3, -1.8), (3, -3, 1.8), (-3, 3, -1.8))  # z = 0.6 x
MIDDLE = ((-3, -3, 0), (3, -3, 0), (-3, 3, 0))


def cases(eye):
    """A ball before one of the cores and one that cuts the other, a leaning wall through both, and
    a wall in the middle. With where rays from the eye end."""
    in_front = np.array((-0.45, 0.1, 0.2)) + 0.5 * np.array(eye) / np.linalg.norm(eye)
    in_core = (0.4, -0.2, -0.3)
    return {"ball in front": (ball(in_front, 0.22), ball_ends(in_front, 0.22)),
            "ball in a core": (ball(in_core, 0.12), ball_ends(in_core, 0.12)),
            "leaning wall": (wall(*LEANING), wall_ends((-0.6, 0, 1))),
            "wall in the middle": (wall(*MIDDLE), wall_ends((0, 0, 1)))}


# Along an axis, and oblique.
EYES = ((0, 0, DISTANCE), tuple(DISTANCE * np.array((0.48, 0.36, 0.8))))


class TestOpaque(MapperTest):
    def test_the_share_is_that_of_a_march_to_the_geometry(self):
        for eye in EYES:
            geometry = cases(eye)
            free, *shares = visible_shares(eye, [no_ends] + [ends for _, ends in geometry.values()])
            view, mapper = blob_view(eye, Method=Mapper.ORDINARY)
            view.window.Render()
            self.assertAlmostEqual(mapper.GetVisibleFraction(), free, delta=0.01 * free)
            for (name, (source, _)), expected in zip(geometry.items(), shares):
                with self.subTest(eye=eye, name=name):
                    view, mapper = blob_view(eye, Method=Mapper.ORDINARY)
                    view.renderer.AddActor(actor_of(source, WALL))
                    save(view.picture(), "opaque-" + name.replace(" ", "-"))
                    self.assertLess(expected, 0.97 * free)
                    self.assertAlmostEqual(mapper.GetVisibleFraction(), expected,
                                           delta=0.01 * expected)
                    self.assertAlmostEqual(mapper.GetBaseVisibleFraction(), expected,
                                           delta=0.01 * expected)
                    self.assert_fine(view)

    def test_the_share_of_an_optimized_volume_is_that_of_a_march(self):
        for eye in EYES:
            geometry = cases(eye)
            view, mapper = blob_view(eye, ScalarComponent=0, LightSource=Mapper.OWN,
                                     LightPosition=(1.0, 2.0, 5.0))
            self.frames_to_the_end(view, mapper)
            extinction = self.found_by_the_filter(view, mapper)
            free, *shares = visible_shares(
                eye, [no_ends] + [ends for _, ends in geometry.values()], extinction)
            self.assertAlmostEqual(mapper.GetVisibleFraction(), free, delta=0.01 * free)
            self.assertGreater(free, 1.1 * mapper.GetBaseVisibleFraction())
            for (name, (source, _)), expected in zip(geometry.items(), shares):
                with self.subTest(eye=eye, name=name):
                    actor = actor_of(source, WALL)
                    view.renderer.AddActor(actor)
                    view.window.Render()
                    self.assertAlmostEqual(mapper.GetVisibleFraction(), expected,
                                           delta=0.01 * expected)
                    view.renderer.RemoveActor(actor)

    def found_by_the_filter(self, view, mapper):
        """The extinction [z, y, x] that the filter finds for the same view."""
        optimizer = vtkExtinctionOptimizer()
        optimizer.SetInputDataObject(mapper.GetInput())
        optimizer.SetInputArrayToProcess(0, 0, 0, 0, "scalars")
        optimizer.SetVisibilitySettings(mapper.GetVisibilitySettings())
        optimizer.SetExtinctionSource(vtkExtinctionOptimizer.OPACITY_FUNCTION)
        optimizer.SetScalarOpacityFunction(opacity_of(*OPACITY))
        optimizer.SetScalarOpacityUnitDistance(SPACING)
        for name in ("Position", "FocalPoint", "ViewUp", "ViewAngle"):
            getattr(optimizer, "SetCamera" + name)(getattr(view.camera, "Get" + name)())
        optimizer.Update()
        return values(optimizer.GetOutput(), "Extinction").reshape(3 * (NODES,))

    def test_an_optimized_volume_is_seen_in_front_of_it(self):
        view, mapper = blob_view()
        view.window.Render()
        free = {name: getattr(mapper, "Get" + name)() for name in (
            "VisibleFraction", "VisibilityScore", "AttainableFraction", "SacrificedFraction",
            "AttainableScore", "AttainableLightScore")}
        actor = actor_of(wall(*MIDDLE), WALL)
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
        view.renderer.AddActor(actor_of(wall(*LEANING), WALL))
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
