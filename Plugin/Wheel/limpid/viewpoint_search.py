# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Finds from where most of what is important can be seen."""

import dataclasses
import math
import time

import numpy as np

from . import _core, sphere
from .arguments import number, number_between, require_choice, vector, whole_number
from .scene import scene_of
from .settings import Settings
from .views import CameraPosition


@dataclasses.dataclass(frozen=True)
class Viewpoint(CameraPosition):
    """A camera and what it sees; optimize and render take it for their camera, and PyVista for
    plotter.camera_position."""

    position: tuple  #: [length]
    focal_point: tuple  #: [length]
    view_up: tuple
    view_angle: float  #: [degrees]
    parallel_projection: bool
    parallel_scale: float  #: [length]
    direction: tuple  #: unit vector from the focal point to the camera
    visibility_score: float  #: S of Eq. (32) [length^2]
    visible_fraction: float  #: share of the important matter whose light reaches the camera [0, 1]


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Viewpoints:
    """What viewpoints has found. Its items are the ranked viewpoints, best first.

    The S-sphere is one of n directions; in PyVista:
    pv.PolyData.from_regular_faces(radius * found.directions, found.triangles).
    """

    viewpoints: tuple  #: of Viewpoint, best first
    directions: np.ndarray  #: (n, 3), unit vectors from the focal point to the cameras
    triangles: np.ndarray  #: (2n - 4, 3), indices of directions, counterclockwise from outside
    visibility_scores: np.ndarray  #: (n,), S of every direction [length^2]
    visible_fractions: np.ndarray  #: (n,), see Viewpoint [0, 1]
    evaluations: int  #: scores and derivatives
    seconds: float
    backend: str  #: what computed: "CPU, 2 threads"

    def __len__(self):
        return len(self.viewpoints)

    def __getitem__(self, rank):
        return self.viewpoints[rank]

    def __repr__(self):
        best = self.viewpoints[0]
        return (f"<limpid.Viewpoints: {len(self)} ranked, the best at "
                f"({', '.join(f'{x:.6g}' for x in best.position)}), from where "
                f"{100 * best.visible_fraction:.1f} % of what is important can be seen, S "
                f"{best.visibility_score:.6g}; {len(self.directions)} directions in "
                f"{self.seconds:.2f} s on {self.backend}>")


def orbit_of(grid, focal_point, distance, view_angle, parallel):
    """The arguments of the core's orbit, checked, for cameras round a grid; see viewpoints."""
    distance = number_between(
        "camera_distance", distance, 1, math.inf, "below 1 some of the cameras would stand inside "
        "the volume, and what is behind them could not be seen", "Give 1 or more, for instance 3.")
    number("camera_view_angle", view_angle, "no picture has it", "Give degrees.")
    if not 0 < view_angle < 180:
        raise ValueError(f"camera_view_angle is {view_angle} degrees (no picture has it). Give an "
                         "angle between 0 and 180 degrees.")
    centre = grid.centre()
    if focal_point is not None:
        focal_point = vector("camera_focal_point", focal_point, "the cameras look there")
        offset = np.linalg.norm(focal_point - centre) / grid.radius()
        if distance < 1 + offset:
            raise ValueError(f"camera_focal_point is {focal_point}, {offset:.3g} radii of the "
                             f"sphere round the volume from its centre, and camera_distance is "
                             f"{distance:g} radii (some of the cameras would stand inside the "
                             "volume). Move it closer to the centre, or give camera_distance "
                             f"{1 + offset:.3g} or more.")
        centre = focal_point
    return {"centre": tuple(centre), "distance": distance * grid.radius(),
            "view_angle": float(view_angle), "parallel_projection": bool(parallel),
            "parallel_scale": grid.radius()}


def search_settings(number_of_viewpoints, separation_angle, refine, directions):
    """The core's settings of a search, checked; see viewpoints."""
    search = _core.SearchSettings()
    search.viewpoints = whole_number(
        "number_of_viewpoints", number_of_viewpoints, 1, 2 ** 31 - 1,
        "a search is for at least one", "Give a whole number, 1 or more.")
    search.separation = math.radians(number_between(
        "separation_angle", separation_angle, 0, 180, "no two directions have it",
        "Give an angle from 0 to 180 degrees."))
    search.refine = bool(refine)
    search.first_step = 0.5 * sphere.spacing(directions)
    return search


def viewed_fields(scene, field):
    """The extinction that is looked at, and the base extinction, flat; see viewpoints."""
    require_choice("field", field, ("attainable", "base_extinction", "importance_proxy"))
    _, base, importance = scene.in_core()
    scene.warn_of_nothing_to_see("every view has the score 0, and none is better than another")
    if field != "importance_proxy":
        return base, None
    return np.float32(scene.largest_extinction()) * importance, base


def least_extinction(base, importance, protect_importance, field):
    """The lower bound of the extinction, flat; None: there is none."""
    share = number_between("protect_importance", protect_importance, 0, 1,
                           "it is a share of the extinction", "Give a number from 0 to 1.")
    return np.float32(share) * importance * base if field == "attainable" and share > 0 else None


def viewpoints(volume=None, *, scalars=None, importance=None, importance_function=None,
               extinction=None, extinction_function=None, opacity_function=None,
               unit_distance=None, spacing=None, origin=None, direction=None,
               field="attainable", number_of_directions=642, camera_focal_point=None,
               camera_distance=3.0, camera_view_angle=30.0, camera_parallel_projection=False,
               number_of_viewpoints=4, separation_angle=30.0, refine=True,
               protect_importance=0.0, ray_density=1.0, backend="auto"):
    """Scores views from all around a volume by S of Eq. (32), climbs from the best of them along
    its derivative (Eqs. (29)-(31)), and ranks what is reached.

    The cameras stand on a sphere round the volume's centre and look at it, upright by Eq. (10).

    volume ... direction: as for optimize.
    field: the extinction that is looked at. "attainable": one of its own for every ray, the best
        that there is: no optimisation for the view could show more, and it nearly reaches that.
        "importance_proxy": the majorant of Eq. (25) times importance, as if nothing else were
        there. "base_extinction": that of the volume, which with
        `extinction` may be what optimize has found.
    number_of_directions: 1 to 100000, the nearest that an icosphere has: 12, 42, 162, 642, 2562.
    camera_focal_point: what the cameras look at [length]; None: the centre.
    camera_distance: from what they look at, in radii of the sphere round the volume, not below 1.
    camera_view_angle: for whoever looks through them; has no influence on scores [degrees].
    camera_parallel_projection: whether they look along parallel rays.
    number_of_viewpoints: most that are ranked, and ascents that are made.
    separation_angle: least angle between two of them [degrees].
    refine: climb from the best directions to better ones between them.
    protect_importance: the share that important structures keep, as in limpid.Settings; of
        "attainable".
    ray_density, backend: as in limpid.Settings.

    Returns Viewpoints. Raises ValueError for arguments that cannot be worked with. Ctrl-C ends it.
    """
    start = time.perf_counter()
    settings = Settings(ray_density=ray_density, backend=backend).in_core()
    count = whole_number("number_of_directions", number_of_directions, 1, sphere.MOST_POINTS,
                         "without any there is nothing to compare, and more cannot be told apart",
                         f"Give a whole number from 1 to {sphere.MOST_POINTS}.")
    directions, triangles = sphere.icosphere(count)
    search = search_settings(number_of_viewpoints, separation_angle, refine, directions)
    scene = scene_of(volume, scalars, importance, importance_function, extinction,
                     extinction_function, opacity_function, unit_distance, spacing, origin,
                     direction)
    orbit = orbit_of(scene.grid, camera_focal_point, camera_distance, camera_view_angle,
                     camera_parallel_projection)
    grid, given, seen = scene.in_core()
    viewed, base = viewed_fields(scene, field)
    least = least_extinction(given, seen, protect_importance, field)
    found = _core.search_viewpoints(grid, viewed, seen, base, field == "attainable", least,
                                    _core.Orbit(**orbit), directions, search, settings)

    camera = {"focal_point": orbit["centre"], **{name: orbit[name] for name in (
        "view_angle", "parallel_projection", "parallel_scale")}}
    ranked = tuple(Viewpoint(position=tuple(position), view_up=tuple(view_up), direction=tuple(way),
                             visibility_score=score, visible_fraction=fraction, **camera)
                   for way, position, view_up, score, fraction in found["viewpoints"])
    samples = found["samples"]
    return Viewpoints(viewpoints=ranked, directions=directions, triangles=triangles,
                      visibility_scores=np.array([sample[3] for sample in samples]),
                      visible_fractions=np.array([sample[4] for sample in samples]),
                      evaluations=found["evaluations"], seconds=time.perf_counter() - start,
                      backend=found["backend"])
