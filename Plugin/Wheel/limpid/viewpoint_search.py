# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Finds from where most of the important structures can be seen."""

import dataclasses
import math
import time

import numpy as np

from . import _core, sphere
from .arguments import number, number_between, require_choice, vector, warn, whole_number
from .progress import report_to
from .scene import scene_of
from .settings import Settings
from .structures import settings_for
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
    aspect_ratio: float  #: width of the picture over its height
    direction: tuple  #: unit vector to the camera from the volume's centre, or camera_focal_point
    visibility_score: float  #: S of Eq. (32) [length^2]
    visible_fraction: float  #: share of the important matter whose light reaches the camera [0, 1]


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Viewpoints:
    """What viewpoints has found. Its items are the ranked viewpoints, best first.

    The S-sphere is one of n directions; in PyVista:
    pv.PolyData.from_regular_faces(radius * found.directions, found.triangles).
    """

    viewpoints: tuple  #: of Viewpoint, best first
    directions: np.ndarray  #: (n, 3), unit vectors like Viewpoint.direction
    triangles: np.ndarray  #: (2n - 4, 3), indices of directions, counterclockwise from outside
    visibility_scores: np.ndarray  #: (n,), S of every direction, NaN if stopped before [length^2]
    visible_fractions: np.ndarray  #: (n,), see Viewpoint [0, 1]
    evaluations: int  #: scores and derivatives
    seconds: float
    backend: str  #: what computed: "CPU, 2 threads"

    def __len__(self):
        return len(self.viewpoints)

    def __getitem__(self, rank):
        return self.viewpoints[rank]

    def __repr__(self):
        if not self.viewpoints:
            return (f"<limpid.Viewpoints: none of {len(self.directions)} directions is ranked; "
                    f"{self.seconds:.2f} s on {self.backend}>")
        best = self.viewpoints[0]
        return (f"<limpid.Viewpoints: {len(self)} ranked, the best at "
                f"({', '.join(f'{x:.6g}' for x in best.position)}), from where "
                f"{100 * best.visible_fraction:.1f} % of the important structures can be seen, S "
                f"{best.visibility_score:.6g}; {len(self.directions)} directions in "
                f"{self.seconds:.2f} s on {self.backend}>")


def orbit_of(grid, focal_point, distance, view_angle, parallel, aspect, up):
    """The arguments of the core's orbit, checked, for cameras round a grid; see viewpoints."""
    distance = number_between(
        "camera_distance", distance, 1, math.inf, "below 1, some cameras would be inside the "
        "volume and would not see what is behind them", "Give 1 or more, for instance 3.")
    view_angle = number("camera_view_angle", view_angle,
                        "the perspective projection is undefined", "Give degrees.")
    if not 0 < view_angle < 180:
        raise ValueError(f"camera_view_angle is {view_angle:g} degrees (the perspective projection "
                         "is undefined). Give an angle between 0 and 180 degrees.")
    aspect = number("camera_aspect_ratio", aspect, "it is the shape of the picture",
                    "Give the width of the picture over its height.")
    if not aspect > 0:
        raise ValueError(f"camera_aspect_ratio is {aspect:g} (the picture would have no width). "
                         "Give the width of the picture over its height.")
    centre = grid.centre()
    if focal_point is not None:
        focal_point = vector("camera_focal_point", focal_point, "the cameras look at this point")
        offset = np.linalg.norm(focal_point - centre) / grid.radius()
        if distance < 1 + offset:
            raise ValueError(f"camera_focal_point is {focal_point}, {offset:.3g} radii of the "
                             "sphere round the volume from its centre, and camera_distance is "
                             f"{distance:g} radii (some cameras would be inside the volume). Move "
                             f"it closer to the centre, or give camera_distance {1 + offset:.3g} "
                             "or more.")
        centre = focal_point
    return {"centre": tuple(centre), "distance": distance * grid.radius(),
            "view_angle": view_angle, "parallel_projection": bool(parallel),
            "parallel_scale": grid.radius(), "aspect_ratio": aspect, "up": up}


def search_settings(number_of_viewpoints, separation_angle, refine, directions, allowed):
    """The core's settings of a search, checked; see viewpoints."""
    search = _core.SearchSettings()
    search.viewpoints = whole_number(
        "number_of_viewpoints", number_of_viewpoints, 1, 2 ** 31 - 1,
        "a search needs at least one", "Give a whole number, 1 or more.")
    search.separation = math.radians(number_between(
        "separation_angle", separation_angle, 0, 180, "directions are 0 to 180 degrees apart",
        "Give an angle from 0 to 180 degrees."))
    search.refine = bool(refine)
    search.first_step = 0.5 * sphere.spacing(directions)
    search.allowed = allowed
    return search


def allowed_views(up, elevation_range, avoided_directions, avoidance_angle):
    """The directions that viewpoints may have, as the core has them; see viewpoints."""
    try:
        lowest, highest = map(float, elevation_range)
    except (TypeError, ValueError):
        lowest = highest = math.nan
    if not -90 <= lowest <= highest <= 90:
        raise ValueError(f"elevation_range is {elevation_range!r} (it limits the elevation of "
                         "views above the horizon). Give two angles from -90 to 90 degrees, the "
                         "smaller one first, like (0, 90).")
    angle = number_between("avoidance_angle", avoidance_angle, 0, 180, "directions are 0 to "
                           "180 degrees apart", "Give an angle from 0 to 180 degrees.")
    avoided = np.array([unit_vector("An avoided direction", direction, "nothing would be "
                                    "avoided") for direction in avoided_directions]).reshape(-1, 3)
    return _core.AllowedViews(up, math.radians(lowest), math.radians(highest), avoided,
                              math.radians(angle))


def unit_vector(name, value, why):
    """`value` as a tuple of three floats of length one."""
    given = vector(name, value, why)
    length = math.hypot(*given)
    if not length > 0:
        raise ValueError(f"{name} is {given} (it is not a direction: {why}). Give a direction, "
                         "like (0, 0, 1).")
    return tuple(x / length for x in given)


def proxy_of(scene, field):
    """The extinction that is looked at, flat; None: the base extinction. See viewpoints."""
    scene.warn_of_nothing_to_see("every view has the score 0, so none is better than another")
    if field != "importance_proxy":
        return None
    return np.float32(scene.largest_extinction()) * scene.layout.flat(scene.importance)


def scores_of(samples, column):
    """A column of the samples of Viewpoints.cxx, NaN where a view was not scored."""
    return np.array([sample[column] if sample[2] else math.nan for sample in samples])


#: What a search takes of limpid.Settings.
OF_SEARCH = ("protect_importance", "importance_smoothing", "ray_density", "backend")


def settings_of_search(given):
    """Settings from keyword arguments. Raises TypeError or ValueError for those that a search has
    no use for."""
    for name in given:
        if name not in (*OF_SEARCH, "preset", "settings"):
            raise TypeError(f"A search has no setting {name!r} (it would have no effect). Use "
                            f"these: {', '.join(OF_SEARCH)}, preset, settings.")
    settings = Settings.of(given)
    if settings.method != "optimized":
        raise ValueError(f"method is {settings.method!r} (the search scores the extinction of the "
                         "method 'optimized'). Use the method 'optimized'.")
    if settings.views != "single_view" or settings.warm_start or settings.temporal_coherence > 0:
        raise ValueError("views, warm_start or temporal_coherence is set (a search scores each "
                         "direction independently). Leave them out.")
    return settings


def viewpoints(volume=None, *, scalars=None, importance=None, importance_function=None,
               extinction=None, extinction_function=None, opacity_function=None,
               unit_distance=None, spacing=None, origin=None, direction=None,
               importance_component=None, structures=None, field="attainable", sampling="icosphere",
               number_of_directions=642, camera_focal_point=None, camera_distance=3.0,
               camera_view_angle=30.0, camera_parallel_projection=False, camera_aspect_ratio=1.0,
               camera_view_up=(0, 1, 0), elevation_range=(-90, 90), avoided_directions=(),
               avoidance_angle=30.0, number_of_viewpoints=4, separation_angle=30.0, refine=True,
               progress=None, **settings):
    """Scores views from all around a volume by S of Eq. (32), climbs from the best of them along
    its derivative (Eqs. (29)-(31)), and ranks what is reached.

    Views are scored from a sphere round the volume's centre, upright by Eq. (10). The cameras of
    the ranked viewpoints stand in the same directions, where the volume's box fills 95 % of the
    width or height of their pictures.

    volume ... structures: as for optimize.
    field: the extinction that is looked at. "attainable": one of its own for every ray, the best
        that there is: no optimisation for the view could show more, and it nearly reaches that.
        "importance_proxy": the majorant of Eq. (25) times importance, as if nothing else were
        there. "base_extinction": that of the volume, which with
        `extinction` may be what optimize has found.
    sampling: how directions are spread over the sphere. "icosphere": a subdivided icosahedron.
        "fibonacci": a spiral from pole to pole, of any number of directions.
        "latitude_longitude": rings about the y axis.
    number_of_directions: 1 to 100000, the nearest that the sampling has; that of an icosphere is
        12, 42, 162, 642, 2562 and so on.
    camera_focal_point: what the cameras look at [length]; None: the volume.
    camera_distance: from where views are scored: distance from the focal point or the centre, in
        radii of the sphere round the volume, not below 1.
    camera_view_angle: of the pictures from below to above; has no influence on scores [degrees].
    camera_parallel_projection: whether the cameras look along parallel rays.
    camera_aspect_ratio: width of the pictures over their height, likewise.
    camera_view_up: what is upwards in pictures, and what elevations are above; of any length.
    elevation_range: from which elevations above the plane at right angles to it a viewpoint may
        look: (0, 90) is the hemisphere above. Directions are scored all the same [degrees].
    avoided_directions, avoidance_angle: vectors from what the cameras look at that no viewpoint may
        come closer to than this angle [degrees].
    number_of_viewpoints: most that are ranked, and ascents that are made.
    separation_angle: least angle between two of them [degrees].
    refine: climb from the best directions to better ones between them.
    progress: called with the share of the work that is done, 1 at the end, and a text; stops with
        the best so far if it returns False.
    settings: protect_importance and importance_smoothing, which count for "attainable",
        ray_density and backend, as in limpid.Settings; preset="Paper", or another, for the first
        two; settings=limpid.Settings(...), of which the others do not count.

    Returns Viewpoints. Raises ValueError for arguments that cannot be worked with, TypeError for
    names that there are not. Ctrl-C ends it.
    """
    start = time.perf_counter()
    settings = settings_of_search(settings)
    require_choice("field", field, ("attainable", "base_extinction", "importance_proxy"))
    require_choice("sampling", sampling, tuple(sphere.SAMPLINGS))
    report = report_to(progress)
    count = whole_number("number_of_directions", number_of_directions, 1, sphere.MOST_POINTS,
                         "a search needs at least one, and more are not distinguishable",
                         f"Give a whole number from 1 to {sphere.MOST_POINTS}.")
    directions, triangles = sphere.SAMPLINGS[sampling](count)
    up = unit_vector("camera_view_up", camera_view_up, "pictures need an upward direction")
    allowed = allowed_views(up, elevation_range, avoided_directions, avoidance_angle)
    search = search_settings(number_of_viewpoints, separation_angle, refine, directions, allowed)
    scene = scene_of(volume, scalars, importance, importance_function, extinction,
                     extinction_function, opacity_function, unit_distance, spacing, origin,
                     direction, importance_component, structures)
    orbit = orbit_of(scene.grid, camera_focal_point, camera_distance, camera_view_angle,
                     camera_parallel_projection, camera_aspect_ratio, up)
    found = _core.search_viewpoints(*scene.in_core(), scene.majorant, proxy_of(scene, field),
                                    field == "attainable", _core.Orbit(**orbit),
                                    camera_focal_point is not None, directions, search,
                                    settings_for(structures, settings.in_core()), report)
    if report:
        report.finish()
    if not found["viewpoints"] and not (report and report.is_stopped):
        warn("No direction that was scored is within elevation_range and far enough from all "
             "avoided ones (no viewpoint can be ranked). Widen the range, avoid less, or raise "
             "number_of_directions.")

    ranked = tuple(Viewpoint(position=tuple(position), focal_point=tuple(focal_point),
                             view_up=tuple(view_up), view_angle=orbit["view_angle"],
                             parallel_projection=orbit["parallel_projection"],
                             parallel_scale=scale, aspect_ratio=orbit["aspect_ratio"],
                             direction=tuple(way), visibility_score=score,
                             visible_fraction=fraction)
                   for way, position, focal_point, view_up, scale, score, fraction
                   in found["viewpoints"])
    samples = found["samples"]
    return Viewpoints(viewpoints=ranked, directions=directions, triangles=triangles,
                      visibility_scores=scores_of(samples, 0),
                      visible_fractions=scores_of(samples, 1),
                      evaluations=found["evaluations"], seconds=time.perf_counter() - start,
                      backend=found["backend"])
