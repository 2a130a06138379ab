# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Finds from where most of the important structures can be seen."""

from __future__ import annotations

import dataclasses
import html
import math
import sys
import time
from typing import TYPE_CHECKING, Any, Iterator, Literal, Mapping, TypedDict, Union

import numpy as np
import numpy.typing as npt

from . import _core, sphere
from .arguments import number, number_between, require_choice, vector, warn, whole_number
from .given import Array, FieldLike, Floats, Picture, Progress, Rows, Vector, VolumeLike
from .grid import Grid
from .images import loaded_pyvista
from .png_file import image_tag
from .preview import Preview
from .progress import report_to
from .scene import Scene, scene_of
from .settings import Settings
from .storage import Saved, reads
from .structures import settings_for
from .views import Camera, CameraPosition

if sys.version_info >= (3, 11):
    from typing import Unpack
elif TYPE_CHECKING:
    from typing_extensions import Unpack

if TYPE_CHECKING:
    import pyvista

MOST_THUMBNAILS = 6  # in a notebook


@dataclasses.dataclass(frozen=True)
class Viewpoint(CameraPosition):
    """A camera and what it sees. `optimize` and `render` take it for their camera, and PyVista for
    ``plotter.camera_position``.

    Attributes
    ----------
    position : (float, float, float)
        Where the camera is [length].
    focal_point : (float, float, float)
        What it looks at [length].
    view_up : (float, float, float)
        What is upwards in the picture.
    view_angle : float
        Vertical opening, of a perspective camera only [degrees].
    parallel_projection : bool
        Whether all rays run along the view direction.
    parallel_scale : float
        Half the height of the picture, of a parallel camera only [length].
    aspect_ratio : float
        Width of the picture over its height.
    direction : (float, float, float)
        Unit vector to the camera from the volume's centre, or from camera_focal_point.
    visibility_score : float
        S of Eq. (32) [length^2].
    visible_fraction : float
        Share of the important matter whose light reaches the camera [0, 1].
    """

    position: tuple[float, float, float]
    focal_point: tuple[float, float, float]
    view_up: tuple[float, float, float]
    view_angle: float
    parallel_projection: bool
    parallel_scale: float
    aspect_ratio: float
    direction: tuple[float, float, float]
    visibility_score: float
    visible_fraction: float


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Viewpoints(Saved):
    """What `viewpoints` has found. Its items are the ranked viewpoints, best first.

    In a notebook, it shows itself as a table with pictures of the important structures.

    Attributes
    ----------
    viewpoints : tuple of Viewpoint
        The ranked viewpoints, best first.
    directions : numpy.ndarray of float, shape (n, 3)
        Directions of the S-sphere: unit vectors like Viewpoint.direction.
    triangles : numpy.ndarray of int, shape (2n - 4, 3)
        The triangles between them: indices of directions, counterclockwise from outside.
    visibility_scores : numpy.ndarray of float, shape (n,)
        S of every direction, NaN if the search was stopped before [length^2].
    visible_fractions : numpy.ndarray of float, shape (n,)
        Share of the important matter that is visible from every direction [0, 1].
    evaluations : int
        Number of scores and derivatives that were computed.
    seconds : float
        Time of the search [s].
    backend : str
        What computed: "CPU, 2 threads".
    preview : object
        What thumbnails are drawn of: every n-th point of the scene, at most 96 along an axis.
    """

    viewpoints: tuple[Viewpoint, ...]
    directions: Floats
    triangles: npt.NDArray[np.integer[Any]]
    visibility_scores: Floats
    visible_fractions: Floats
    evaluations: int
    seconds: float
    backend: str
    preview: Preview

    def __len__(self) -> int:
        return len(self.viewpoints)

    def __getitem__(self, rank: int) -> Viewpoint:
        return self.viewpoints[rank]

    def __iter__(self) -> Iterator[Viewpoint]:
        return iter(self.viewpoints)

    def to_pyvista(self, radius: float = 1.0, centre: Vector = (0.0, 0.0, 0.0)) \
            -> pyvista.PolyData:
        """The S-sphere as a surface of PyVista.

        Parameters
        ----------
        radius : float, default 1
            Radius of the sphere [length].
        centre : (float, float, float), default (0, 0, 0)
            Its centre [length].

        Returns
        -------
        pyvista.PolyData
            Closed triangles with the point arrays ``VisibilityScore`` [length^2] and
            ``VisibleFraction`` [0, 1].

        Raises
        ------
        ImportError
            PyVista is not installed.
        """
        faces = np.column_stack([np.full(len(self.triangles), 3), self.triangles])
        surface: pyvista.PolyData = loaded_pyvista().PolyData(
            radius * self.directions + np.asarray(centre), faces.ravel())
        surface.point_data["VisibilityScore"] = self.visibility_scores
        surface.point_data["VisibleFraction"] = self.visible_fractions
        surface.set_active_scalars("VisibilityScore")
        return surface

    def thumbnail(self, rank: int = 0, size: int = 160) -> Picture:
        """A small picture of the important structures alone, from one of the viewpoints.

        It is drawn by `render`, from every n-th point of the volume, at most 96 along an axis.

        Parameters
        ----------
        rank : int, default 0
            Which of the viewpoints, 0 is the best.
        size : int, default 160
            Width and height [pixels].

        Returns
        -------
        numpy.ndarray of uint8
            The picture as `render` returns it.
        """
        one = self.viewpoints[rank]
        names = [field.name for field in dataclasses.fields(Camera)]
        return self.preview.draw(self.preview.important(),
                                 Camera(**{name: getattr(one, name) for name in names}), size)

    KIND = "Viewpoints"

    def _contents(self) -> tuple[dict[str, Any], dict[str, Any]]:
        preview = self.preview
        grid = {field.name: np.asarray(getattr(preview.grid, field.name)).tolist()
                for field in dataclasses.fields(preview.grid)}
        header = {name: getattr(self, name) for name in ("evaluations", "seconds", "backend")}
        header.update(grid=grid, steps=preview.steps,
                      viewpoints=[dataclasses.asdict(one) for one in self.viewpoints])
        return header, {
            "directions": self.directions, "triangles": self.triangles,
            "visibility_scores": self.visibility_scores,
            "visible_fractions": self.visible_fractions,
            "preview_extinction": preview.base_extinction, "preview_importance": preview.importance}

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        columns = "".join(
            f"<td>{image_tag(self.thumbnail(rank), f'viewpoint {rank}')}<br><b>{rank}</b>: "
            f"{100 * one.visible_fraction:.1f} % visible, S {one.visibility_score:.6g}</td>"
            for rank, one in enumerate(self.viewpoints[:MOST_THUMBNAILS]))
        return (f"<div><b>limpid.Viewpoints</b>: {len(self)} ranked of {len(self.directions)} "
                f"directions<table><caption>Important structures alone</caption><tr>{columns}</tr>"
                f"</table>{self.seconds:.2f} s on {html.escape(self.backend)}</div>")

    def __repr__(self) -> str:
        if not self.viewpoints:
            return (f"<limpid.Viewpoints: none of {len(self.directions)} directions is ranked; "
                    f"{self.seconds:.2f} s on {self.backend}>")
        best = self.viewpoints[0]
        return (f"<limpid.Viewpoints: {len(self)} ranked, the best at "
                f"({', '.join(f'{x:.6g}' for x in best.position)}), from where "
                f"{100 * best.visible_fraction:.1f} % of the important structures can be seen, S "
                f"{best.visibility_score:.6g}; {len(self.directions)} directions in "
                f"{self.seconds:.2f} s on {self.backend}>")


def orbit_of(grid: Grid, focal_point: Any, distance: Any, view_angle: Any, parallel: bool,
             aspect: Any, up: tuple[float, float, float]) -> dict[str, Any]:
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


def search_settings(number_of_viewpoints: int, separation_angle: float, refine: bool,
                    directions: Floats, allowed: _core.AllowedViews) -> _core.SearchSettings:
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


def allowed_views(up: tuple[float, float, float], elevation_range: Any, avoided_directions: Any,
                  avoidance_angle: Any) -> _core.AllowedViews:
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


def unit_vector(name: str, value: Any, why: str) -> tuple[float, float, float]:
    """`value` as a tuple of three floats of length one."""
    given = vector(name, value, why)
    length = math.hypot(*given)
    if not length > 0:
        raise ValueError(f"{name} is {given} (it is not a direction: {why}). Give a direction, "
                         "like (0, 0, 1).")
    return given[0] / length, given[1] / length, given[2] / length


def proxy_of(scene: Scene, field: str) -> Array | None:
    """The extinction that is looked at, flat; None: the base extinction. See viewpoints."""
    scene.warn_of_nothing_to_see("every view has the score 0, so none is better than another")
    if field != "importance_proxy":
        return None
    return np.float32(scene.largest_extinction()) * scene.layout.flat(scene.importance)


def scores_of(samples: list[Any], column: int) -> Floats:
    """A column of the samples of Viewpoints.cxx, NaN where a view was not scored."""
    return np.array([sample[column] if sample[2] else math.nan for sample in samples])


#: What a search takes of limpid.Settings.
OF_SEARCH = ("protect_importance", "importance_smoothing", "ray_density", "backend")


def settings_of_search(given: Mapping[str, Any]) -> Settings:
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


class SearchSettingsByName(TypedDict, total=False):
    """Keyword arguments of viewpoints that are settings, see OF_SEARCH."""

    preset: str
    settings: Settings
    protect_importance: float
    importance_smoothing: Literal["off", "median"]
    ray_density: float
    backend: Literal["auto", "cpu", "cuda"]


@reads(Viewpoints.KIND)
def viewpoints_from(header: dict[str, Any], arrays: Mapping[str, npt.NDArray[Any]]) -> Viewpoints:
    """A result from the header and the arrays of a file."""
    one: dict[str, Any]
    ranked = []
    for one in header["viewpoints"]:
        vectors = {name: tuple(value) for name, value in one.items() if isinstance(value, list)}
        ranked.append(Viewpoint(**{**one, **vectors}))
    grid = Grid(**{**header["grid"], "shape": tuple(header["grid"]["shape"])})
    preview = Preview(grid, tuple(header["steps"]), arrays["preview_extinction"],
                      arrays["preview_importance"])
    return Viewpoints(viewpoints=tuple(ranked), directions=arrays["directions"],
                      triangles=arrays["triangles"],
                      visibility_scores=arrays["visibility_scores"],
                      visible_fractions=arrays["visible_fractions"],
                      evaluations=header["evaluations"], seconds=header["seconds"],
                      backend=header["backend"], preview=preview)


def viewpoints(volume: VolumeLike = None, *, scalars: FieldLike = None,
               importance: Union[FieldLike, Mapping[int, float]] = None,
               importance_function: Rows | None = None, extinction: FieldLike = None,
               extinction_function: Rows | None = None, opacity_function: Rows | None = None,
               unit_distance: float | None = None, spacing: Vector | None = None,
               origin: Vector | None = None, direction: Rows | None = None,
               importance_component: int | None = None, structures: FieldLike = None,
               field: Literal["attainable", "base_extinction", "importance_proxy"] = "attainable",
               sampling: Literal["icosphere", "fibonacci", "latitude_longitude"] = "icosphere",
               number_of_directions: int = 642, camera_focal_point: Vector | None = None,
               camera_distance: float = 3.0, camera_view_angle: float = 30.0,
               camera_parallel_projection: bool = False, camera_aspect_ratio: float = 1.0,
               camera_view_up: Vector = (0, 1, 0),
               elevation_range: tuple[float, float] = (-90, 90),
               avoided_directions: Union[Rows, tuple[()]] = (), avoidance_angle: float = 30.0,
               number_of_viewpoints: int = 4, separation_angle: float = 30.0, refine: bool = True,
               progress: Progress = None,
               **settings: Unpack[SearchSettingsByName]) -> Viewpoints:
    """Finds from where most of the important structures can be seen.

    It scores views from all around a volume by S of Eq. (32), climbs from the best of them along
    its derivative (Eqs. (29)-(31)), and ranks what is reached.

    Views are scored from a sphere round the volume's centre, upright by Eq. (10). The cameras of
    the ranked viewpoints stand in the same directions, where the volume's box fills 95 % of the
    width or height of their pictures.

    Parameters
    ----------
    volume : image or array, optional
        As for `optimize`, like all arguments up to `structures`.
    scalars : array or str, optional
        The scalars, or the name of an array of the image.
    importance : array, str or mapping, optional
        The importance [0, 1], or what `importance_function` maps to it; with `structures`,
        {label: importance}.
    importance_function : rows of [value, importance], optional
        Nodes of a function that maps `importance` to [0, 1].
    extinction : array or str, optional
        The base extinction [1/length].
    extinction_function : rows of [scalar, extinction], optional
        Nodes of a function, in place of `extinction` [1/length].
    opacity_function : rows of [scalar, opacity], optional
        Nodes of a function, opacities on one unit distance [0, 1], in place of both.
    unit_distance : float, optional
        Distance to which opacities refer [length]. Default is the mean length of a cell.
    spacing : (float, float, float), optional
        Distance of the points of an array along each axis [length]. Default is 1.
    origin : (float, float, float), optional
        Position of the first point of an array [length]. Default is 0.
    direction : (3, 3) array, optional
        Matrix whose columns are the directions of an array's axes. Default is x, y, z.
    importance_component : int, optional
        Component of an importance with several values per point, from 0 on, or -1 for the length of
        the tuple.
    structures : array or str, optional
        Labels of a segmentation, whole numbers.
    field : {"attainable", "base_extinction", "importance_proxy"}, default "attainable"
        The extinction that is looked at. "attainable": one of its own for every ray, the best that
        there is: no optimisation for the view could show more, and it nearly reaches that.
        "importance_proxy": the majorant of Eq. (25) times importance, as if nothing else were
        there. "base_extinction": that of the volume, which with `extinction` may be what `optimize`
        has found.
    sampling : {"icosphere", "fibonacci", "latitude_longitude"}, default "icosphere"
        How directions are spread over the sphere. "icosphere": a subdivided icosahedron.
        "fibonacci": a spiral from pole to pole, of any number of directions.
        "latitude_longitude": rings about the y axis.
    number_of_directions : int, default 642
        Directions that are scored, 1 to 100000, the nearest number that the sampling has; that of
        an icosphere is 12, 42, 162, 642, 2562 and so on.
    camera_focal_point : (float, float, float), optional
        What the cameras look at [length]. Default is the volume.
    camera_distance : float, default 3
        From where views are scored: distance from the focal point or the centre, 1 or more [radii
        of the sphere round the volume].
    camera_view_angle : float, default 30
        Vertical opening of the pictures; has no influence on scores [degrees].
    camera_parallel_projection : bool, default False
        Whether the cameras look along parallel rays.
    camera_aspect_ratio : float, default 1
        Width of the pictures over their height; has no influence on scores.
    camera_view_up : (float, float, float), default (0, 1, 0)
        What is upwards in pictures, and what elevations are above; of any length.
    elevation_range : (float, float), default (-90, 90)
        From which elevations above the plane at right angles to camera_view_up a viewpoint may
        look: (0, 90) is the hemisphere above. Directions are scored all the same [degrees].
    avoided_directions : rows of (x, y, z), default ()
        Vectors from what the cameras look at that no viewpoint may come close to.
    avoidance_angle : float, default 30
        Least angle between a viewpoint and an avoided direction [degrees].
    number_of_viewpoints : int, default 4
        Most viewpoints that are ranked, and ascents that are made.
    separation_angle : float, default 30
        Least angle between two of them [degrees].
    refine : bool, default True
        Whether to climb from the best directions to better ones between them.
    progress : callable or bool, optional
        Called with the share of the work that is done, 1 at the end, and a text; the search stops
        with the best so far if it returns False. True: a `ProgressBar` with the time that is left.
    **settings
        Members of `Settings` by name: protect_importance and importance_smoothing, which count for
        "attainable", ray_density and backend; preset="Paper", or another, for the first two;
        settings=Settings(...), of which the others do not count.

    Returns
    -------
    Viewpoints
        The ranked viewpoints, and the score of every direction.

    Raises
    ------
    ValueError
        Arguments cannot be worked with.
    TypeError
        There is no setting of that name.
    KeyboardInterrupt
        Ctrl-C ends the search.

    Examples
    --------
    >>> views = viewpoints(image, importance_function=[[165, 0], [230, 1]])
    >>> views[0].visible_fraction
    """
    start = time.perf_counter()
    chosen = settings_of_search(settings)
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
                                    settings_for(structures, chosen.in_core()), report)
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
                      preview=Preview.of(scene), evaluations=found["evaluations"],
                      seconds=time.perf_counter() - start, backend=found["backend"])
