# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Finds the extinction that makes important structures visible."""

from __future__ import annotations

import dataclasses
import html
import sys
from typing import TYPE_CHECKING, Any, Literal, Mapping, Union

import numpy as np
import numpy.typing as npt

from . import _core
from .arguments import choice, warn
from .given import (CameraLike, FieldLike, LightLike, Picture, Progress, Rows, Singles, Vector,
                    VolumeLike)
from .images import image_of
from .png_file import image_tag
from .preview import Preview
from .previous import Memory, Previous
from .progress import report_to
from .scene import scene_of
from .settings import Settings, SettingsByName
from .storage import Saved, reads
from .structures import StructureShares, settings_for, targets_by_label
from .views import Camera, camera_of, light_of

if sys.version_info >= (3, 11):
    from typing import Unpack
elif TYPE_CHECKING:
    from typing_extensions import Unpack

if TYPE_CHECKING:
    import pyvista

#: A row of Optimization.convergence, in the order of RowsOf in Optimize.cxx.
CONVERGENCE = np.dtype([
    ("iteration", int), ("level", int), ("energy", float), ("regularization_energy", float),
    ("view_energy", float), ("light_energy", float), ("visibility_score", float),
    ("visible_fraction", float), ("sacrificed_fraction", float), ("seconds", float)])


#: Numbers of an Optimization that filters have in field data, and their names there.
FIELD_DATA = {"visibility_score": "VisibilityScore", "base_visibility_score": "BaseVisibilityScore",
              "visible_fraction": "VisibleFraction",
              "base_visible_fraction": "BaseVisibleFraction",
              "sacrificed_fraction": "SacrificedFraction",
              "attainable_fraction": "AttainableFraction", "attainable_score": "AttainableScore",
              "attainable_light_score": "AttainableLightScore", "energy": "Energy",
              "iterations": "Iterations", "seconds": "Seconds", "backend": "Backend"}

#: Attributes of an Optimization that the header of a file has as they are.
IN_HEADER = (*FIELD_DATA, "unit_distance", "settled", "control_factor", "targets")


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Optimization(Saved):
    """What `optimize` has found.

    Arrays have the shape and the order in memory of the input. For an image they are flat, x
    fastest, as its own are: ``image["found"] = result.extinction``. In a notebook, a result shows
    itself as a table and two pictures.

    Attributes
    ----------
    extinction : numpy.ndarray of float32
        The extinction for the camera, in joint mode also for the light [1/length].
    light_extinction : numpy.ndarray of float32 or None
        The extinction for the light, in separate mode [1/length].
    dimensions : (int, int, int)
        Points along x, y and z.
    camera : Camera
        The camera as used; with optimize_viewpoint where it came to.
    unit_distance : float
        Distance to which opacities refer [length].
    visibility_score : float
        S of Eq. (32) [length^2].
    base_visibility_score : float
        S of the base extinction [length^2].
    visible_fraction : float
        Share of the important matter whose light reaches the camera [0, 1].
    base_visible_fraction : float
        The same share through the base extinction [0, 1].
    sacrificed_fraction : float
        Share of the important matter that was removed [0, 1].
    attainable_fraction : float
        The most that visible_fraction could be [0, 1].
    attainable_score : float
        The most that visibility_score could be [length^2].
    attainable_light_score : float
        The most that S from the light could be [length^2].
    energy : float
        Eq. (21), in world units [length^2].
    iterations : int
        Number of iterations.
    settled : bool
        Whether another iteration would change next to nothing; else there was a limit.
    seconds : float
        Time of the computation [s].
    backend : str
        What computed: "CPU, 2 threads".
    convergence : numpy.ndarray
        A row per iteration, the first is that of the base extinction; its names are those of the
        columns: energies [length^2], visibility_score [length^2], fractions [0, 1], seconds [s].
    memory : object
        What the next run needs of this one as `previous`.
    preview : object
        What thumbnails are drawn of: every n-th point of the scene, at most 96 along an axis.
    control_factor : int
        2: the change was found at half the resolution, and so on.
    structures : dict of int to StructureShares, or None
        What is seen of each structure, by its label; None without structures.
    targets : str
        What is visible of structures with targets, in words.
    """

    extinction: Singles
    light_extinction: Singles | None
    dimensions: tuple[int, int, int]
    camera: Camera
    unit_distance: float
    visibility_score: float
    base_visibility_score: float
    visible_fraction: float
    base_visible_fraction: float
    sacrificed_fraction: float
    attainable_fraction: float
    attainable_score: float
    attainable_light_score: float
    energy: float
    iterations: int
    settled: bool
    seconds: float
    backend: str
    convergence: npt.NDArray[Any]
    memory: Memory
    preview: Preview
    control_factor: int = 1
    structures: dict[int, StructureShares] | None = None
    targets: str = ""

    def opacity(self, unit_distance: float | None = None) -> Singles:
        """Opacity of the extinction, 1 - exp(-extinction * distance), for volume renderers that
        want opacities.

        Parameters
        ----------
        unit_distance : float, optional
            Distance to which the opacity refers [length]. Default is that of the scene.

        Returns
        -------
        numpy.ndarray of float32
            An array like `extinction` [0, 1].
        """
        distance = self.unit_distance if unit_distance is None else unit_distance
        opacity = np.multiply(self.extinction, np.float32(-distance))
        np.expm1(opacity, out=opacity)
        return np.negative(opacity, out=opacity)

    def to_pyvista(self, unit_distance: float | None = None) -> pyvista.ImageData:
        """The result as an image of PyVista, with the names of the filter's arrays.

        Parameters
        ----------
        unit_distance : float, optional
            Distance to which the opacity refers [length]. Default is that of the scene.

        Returns
        -------
        pyvista.ImageData
            Point arrays ``Extinction`` [1/length], ``Opacity`` [0, 1], in separate mode also
            ``LightExtinction`` [1/length]; field data ``VisibilityScore`` [length^2],
            ``VisibleFraction`` [0, 1] and the other scores.

        Raises
        ------
        ImportError
            PyVista is not installed.

        Examples
        --------
        >>> found.to_pyvista().save("found.vti")
        """
        arrays = {"Extinction": self.extinction, "Opacity": self.opacity(unit_distance)}
        if self.light_extinction is not None:
            arrays["LightExtinction"] = self.light_extinction
        return image_of(self.memory.grid, "Opacity",
                        {name: self.memory.in_order(array) for name, array in arrays.items()},
                        {name: getattr(self, member) for member, name in FIELD_DATA.items()})

    def thumbnail(self, size: int = 240, *, before: bool = False,
                  camera: CameraLike = None) -> Picture:
        """A small picture, colored by importance: gray is context, orange is important.

        It is drawn by `render`, from every n-th point of the volume, at most 96 along an axis.

        Parameters
        ----------
        size : int, default 240
            Width and height [pixels].
        before : bool, default False
            Whether to draw the base extinction instead of the one that was found.
        camera : Camera, optional
            From where to look. Default is the camera of the result.

        Returns
        -------
        numpy.ndarray of uint8
            The picture as `render` returns it.
        """
        preview = self.preview
        extinction = preview.base_extinction if before else \
            preview.kept(self.memory.in_order(self.extinction))
        view = self.camera if camera is None else camera_of(camera, self.memory.grid)
        return preview.draw(extinction, view, size)

    KIND = "Optimization"

    def _contents(self) -> tuple[dict[str, Any], dict[str, Any]]:
        preview = self.preview
        header = {name: getattr(self, name) for name in IN_HEADER}
        header.update(camera=dataclasses.asdict(self.camera), memory=self.memory.as_header(),
                      steps=preview.steps, structures=None if self.structures is None else
                      [shares.as_header() for shares in self.structures.values()])
        return header, {
            "extinction": self.extinction, "light_extinction": self.light_extinction,
            "convergence": self.convergence, "preview_extinction": preview.base_extinction,
            "preview_importance": preview.importance}

    def __repr__(self) -> str:
        return (f"<limpid.Optimization of {' x '.join(map(str, self.dimensions))} points: "
                f"{100 * self.base_visible_fraction:.1f} % of the important structures visible "
                f"before, {100 * self.visible_fraction:.1f} % after, "
                f"{100 * self.attainable_fraction:.1f} % at most, "
                f"{100 * self.sacrificed_fraction:.1f} % removed; "
                f"S {self.base_visibility_score:.6g} before, {self.visibility_score:.6g} after; "
                f"{self.iterations} iterations in {self.seconds:.2f} s on {self.backend}>")

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        rows = {"visible before": self.base_visible_fraction, "visible after": self.visible_fraction,
                "visible at most": self.attainable_fraction, "removed": self.sacrificed_fraction}
        table = "".join(f"<tr><td>{name}</td><td>{100 * share:.1f} %</td></tr>"
                        for name, share in rows.items())
        pictures = "".join(image_tag(self.thumbnail(before=before), text)
                           for before, text in ((True, "before"), (False, "after")))
        size = " × ".join(map(str, self.dimensions))
        return (f"<div><b>limpid.Optimization</b> of {size} points<br>{pictures}"
                f"<table><caption>Important structures</caption>{table}</table>"
                f"S {self.base_visibility_score:.6g} before, {self.visibility_score:.6g} after; "
                f"{self.iterations} iterations in {self.seconds:.2f} s on "
                f"{html.escape(self.backend)}</div>")


@reads(Optimization.KIND)
def optimization_from(header: dict[str, Any],
                      arrays: Mapping[str, npt.NDArray[Any]]) -> Optimization:
    """A result from the header and the arrays of a file."""
    memory = Memory.from_header(header["memory"])
    shares = None if header["structures"] is None else \
        [StructureShares.from_header(row) for row in header["structures"]]
    return Optimization(
        extinction=arrays["extinction"], light_extinction=arrays.get("light_extinction"),
        dimensions=memory.grid.shape, camera=Camera(**header["camera"]),
        convergence=arrays["convergence"], memory=memory,
        preview=Preview.restored(memory.grid, header["steps"], arrays["preview_extinction"],
                                 arrays["preview_importance"]),
        structures=None if shares is None else {row.label: row for row in shares},
        **{name: header[name] for name in IN_HEADER})


def require_one_camera(settings: Settings, before: Previous) -> None:
    """Raises ValueError for what cannot go together with a camera that moves."""
    if settings.views != "single_view":
        raise ValueError(f"optimize_viewpoint is on and views is {settings.views!r} (only a single "
                         "camera can be optimised). Leave one of them out.")
    if settings.method != "optimized":
        raise ValueError(f"optimize_viewpoint is on and method is {settings.method!r} (only the "
                         "method 'optimized' supports this). Use the method 'optimized', or leave "
                         "optimize_viewpoint out.")
    if before.counts:
        raise ValueError("optimize_viewpoint is on and previous is given (the previous result may "
                         "not cover the new view). Leave one of them out.")


def optimize(volume: VolumeLike = None, *, scalars: FieldLike = None,
             importance: Union[FieldLike, Mapping[int, float]] = None,
             importance_function: Rows | None = None, extinction: FieldLike = None,
             extinction_function: Rows | None = None, opacity_function: Rows | None = None,
             unit_distance: float | None = None, spacing: Vector | None = None,
             origin: Vector | None = None, direction: Rows | None = None,
             camera: CameraLike = None, light: LightLike = None,
             importance_component: int | None = None, structures: FieldLike = None,
             targets: Mapping[int, float] | None = None, optimize_viewpoint: bool = False,
             viewpoint_guide: Literal["attainable", "proxy", "coupled"] = "attainable",
             reference: FieldLike = None,
             previous: Union[Optimization, None, tuple[()]] = (), progress: Progress = None,
             **settings: Unpack[SettingsByName]) -> Optimization:
    """Finds the extinction that minimises Eq. (21) for one camera and one light.

    Arrays have one number per point, shape (X, Y, Z), indexed [x, y, z]; those of images may be
    flat, x fastest, as VTK has them. Arrays of float32 are used where they are if their memory has
    no gaps and both have the same order of axes, whichever that is (Fortran's and VTK's, C's); of
    others there is one copy in float32, and functions make one array each. A point with NaN,
    infinity or a negative extinction is taken as empty, and importance is moved into [0, 1], with a
    warning.

    Parameters
    ----------
    volume : image or array, optional
        An image of PyVista, VTK or SimpleITK, a DataArray of xarray, or an array of scalars. None
        where `extinction` and `importance` are arrays.
    scalars : array or str, optional
        The scalars, or the name of an array of the image. Default is `volume`, or its active
        scalars.
    importance : array, str or mapping, optional
        The importance [0, 1], or what `importance_function` maps to it; with `structures`,
        {label: importance}, and other labels have none. Default is the image's array "Importance",
        or with `importance_function` the scalars. With none of these, the largest scalars are taken
        for important, between their 95th and 99th percentile, or above where these are in noise,
        with a warning.
    importance_function : rows of [value, importance], optional
        Nodes of a function that maps `importance` to [0, 1].
    extinction : array or str, optional
        The base extinction [1/length].
    extinction_function : rows of [scalar, extinction], optional
        Nodes of a function, in place of `extinction` [1/length].
    opacity_function : rows of [scalar, opacity], optional
        Nodes of a function, opacities on one unit distance [0, 1], in place of both. With none of
        the three it is a straight line from 0 to 1 over the range of the scalars.
    unit_distance : float, optional
        Distance to which opacities refer [length]. Default is the mean length of a cell.
    spacing : (float, float, float), optional
        Distance of the points of an array along each axis [length]. Default is 1.
    origin : (float, float, float), optional
        Position of the first point of an array [length]. Default is 0.
    direction : (3, 3) array, optional
        Matrix whose columns are the directions of an array's axes. Default is x, y, z. An image has
        its own spacing, origin and direction.
    camera : Camera, camera of PyVista, or (position, focal point, view up), optional
        From where the volume is seen [length]; a mapping with these names, too. Default is on the z
        axis, where Reset Camera puts a new one.
    light : Light, light of PyVista, or position, optional
        Where the light is [length]. Default is above the camera.
    importance_component : int, optional
        Component of an importance with several values per point, from 0 on, or -1 for the length of
        the tuple.
    structures : array or str, optional
        Labels of a segmentation, whole numbers. Without `importance`, all labels but 0 are
        important, with a warning. Labels are never interpolated, their importance is.
    targets : mapping, optional
        {label: share of the structure that should be visible [0, 1]}. The optimisation is repeated
        with other importances until it is, or no further run helps, at most 20 times; a warning
        says which targets are not met, and why. Without `importance`, structures with targets are
        the important ones.
    optimize_viewpoint : bool, default False
        Whether to move the camera on the sphere round its focal point, too (Section 3.4).
    viewpoint_guide : {"attainable", "proxy", "coupled"}, default "attainable"
        What tells the way. "attainable": what could be seen from each view at most; the extinction
        is optimised once, where that is highest. "proxy": the majorant times importance. "coupled":
        the extinction found last.
    reference : array or str, optional
        An extinction to stay near, with the setting reference_pull above 0 [1/length].
    previous : Optimization or None, optional
        What `optimize` has found for another view or time step of the same box, None for the first.
        With warm_start=True the iterations start from it. With temporal_coherence=0.2, say, the
        result stays near it where little is to be gained, unless it is of other settings or of a
        view more than 20 degrees away.
    progress : callable or bool, optional
        Called after every iteration with the share of the work that is done, 1 at the end, and a
        text; the optimisation stops with the best so far if it returns False. True: a `ProgressBar`
        with the time that is left.
    **settings
        Members of `Settings` by name, such as view_weight=20, and preset="Paper" or
        settings=Settings(...) for several at once, which the former replace.

    Returns
    -------
    Optimization
        The extinction, and what can be seen through it.

    Raises
    ------
    ValueError
        Data or settings cannot be worked with.
    TypeError
        There is no setting of that name.
    KeyboardInterrupt
        Ctrl-C ends the computation.

    Examples
    --------
    >>> found = optimize(image, extinction_function=[[0, 0], [255, 0.5]],
    ...                  importance_function=[[165, 0], [230, 1]], progress=True)
    """
    chosen = Settings.of(settings)
    core_settings = settings_for(structures, chosen.in_core())
    views = chosen.views_in_core()
    guide = choice("viewpoint_guide", viewpoint_guide, _core.ViewpointGuide)
    report = report_to(progress)
    before = Previous(previous, chosen)
    if optimize_viewpoint:
        require_one_camera(chosen, before)
    scene = scene_of(volume, scalars, importance, importance_function, extinction,
                     extinction_function, opacity_function, unit_distance, spacing, origin,
                     direction, importance_component, structures, before.layout(),
                     targets_by_label(targets, structures))
    before.require_box(scene.grid)
    scene.warn_of_nothing_to_see("there is nothing to clear the view for: the extinction stays as "
                                 "it is")
    view = camera_of(camera, scene.grid)
    lamp = light_of(light, view)
    memory = Memory.of(scene, chosen)
    found = _core.optimize(*scene.in_core(), scene.majorant, view.in_core(), lamp.in_core(view),
                           core_settings, views, guide if optimize_viewpoint else None,
                           [scene.flat("reference", reference)], before.initial(scene),
                           before.change(memory), *scene.structures_in_core(), report)
    if report:
        report.finish()

    view = dataclasses.replace(view, position=found.pop("camera_position"),
                               view_up=found.pop("camera_view_up"))
    of_light = found.pop("light_extinction", None)
    shares = found.pop("structures", None)
    target_warning = found.pop("target_warning", None)
    resolution = found.pop("resolution")
    if resolution:
        warn(f"optimised at {resolution} (more does not fit into the memory limit): scores are those "
             "of this resolution. Raise memory_limit if there is more memory.")
    if target_warning:
        warn(target_warning)
    return Optimization(extinction=scene.as_given(found.pop("extinction")),
                        light_extinction=None if of_light is None else scene.as_given(of_light),
                        dimensions=scene.grid.shape, camera=view, unit_distance=scene.unit_distance,
                        memory=memory.with_change(found.pop("change", None)),
                        preview=Preview.of(scene),
                        structures=None if shares is None or scene.segmentation is None else
                        StructureShares.all_of(scene.segmentation, shares),
                        convergence=np.array(found.pop("convergence"), dtype=CONVERGENCE), **found)
