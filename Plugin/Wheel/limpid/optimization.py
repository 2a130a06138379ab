# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Finds the extinction that makes important structures visible."""

import dataclasses

import numpy as np

from . import _core
from .arguments import choice, warn
from .previous import Memory, Previous
from .progress import report_to
from .scene import scene_of
from .settings import Settings
from .structures import StructureShares, settings_for, targets_by_label
from .views import Camera, camera_of, light_of

#: A row of Optimization.convergence, in the order of RowsOf in Optimize.cxx.
CONVERGENCE = np.dtype([
    ("iteration", int), ("level", int), ("energy", float), ("regularization_energy", float),
    ("view_energy", float), ("light_energy", float), ("visibility_score", float),
    ("visible_fraction", float), ("sacrificed_fraction", float), ("seconds", float)])


@dataclasses.dataclass(frozen=True, repr=False, eq=False)
class Optimization:
    """What optimize has found. Arrays have the shape and the order in memory of the input; for an
    image they are flat, x fastest, as its own are: image["found"] = result.extinction.
    """

    extinction: np.ndarray  #: for the camera, in joint mode also for the light [1/length]
    light_extinction: np.ndarray  #: for the light, in separate mode; else None [1/length]
    dimensions: tuple  #: points along x, y and z
    camera: Camera  #: as used; with optimize_viewpoint where it came to
    unit_distance: float  #: of opacities [length]
    visibility_score: float  #: S of Eq. (32) [length^2]
    base_visibility_score: float  #: S of the base extinction [length^2]
    visible_fraction: float  #: share of the important matter whose light reaches the camera [0, 1]
    base_visible_fraction: float  #: of the base extinction [0, 1]
    sacrificed_fraction: float  #: share of the important matter that was removed [0, 1]
    attainable_fraction: float  #: the most that visible_fraction could be [0, 1]
    attainable_score: float  #: the most that visibility_score could be [length^2]
    attainable_light_score: float  #: the most that S from the light could be [length^2]
    energy: float  #: Eq. (21), in world units [length^2]
    iterations: int
    settled: bool  #: another iteration would change next to nothing; else there was a limit
    seconds: float
    backend: str  #: what computed: "CPU, 2 threads"
    convergence: np.ndarray  #: one row per iteration, of type CONVERGENCE, the first is the base's
    memory: Memory  #: what the next run needs of it as `previous`
    control_factor: int = 1  #: 2: the change was found at half the resolution, and so on
    structures: dict = None  #: StructureShares by label; None: none are given
    targets: str = ""  #: what is visible of structures with targets, in words

    def opacity(self, unit_distance=None):
        """Opacity of the extinction on one unit distance, 1 - exp(-extinction * distance), for
        volume renderers that want opacities; an array like `extinction`, in [0, 1].

        unit_distance: [length]; None: the one of the scene.
        """
        distance = self.unit_distance if unit_distance is None else unit_distance
        opacity = np.multiply(self.extinction, np.float32(-distance))
        np.expm1(opacity, out=opacity)
        return np.negative(opacity, out=opacity)

    def __repr__(self):
        return (f"<limpid.Optimization of {' x '.join(map(str, self.dimensions))} points: "
                f"{100 * self.base_visible_fraction:.1f} % of the important structures visible "
                f"before, {100 * self.visible_fraction:.1f} % after, "
                f"{100 * self.attainable_fraction:.1f} % at most, "
                f"{100 * self.sacrificed_fraction:.1f} % removed; "
                f"S {self.base_visibility_score:.6g} before, {self.visibility_score:.6g} after; "
                f"{self.iterations} iterations in {self.seconds:.2f} s on {self.backend}>")


def require_one_camera(settings, before):
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


def optimize(volume=None, *, scalars=None, importance=None, importance_function=None,
             extinction=None, extinction_function=None, opacity_function=None, unit_distance=None,
             spacing=None, origin=None, direction=None, camera=None, light=None,
             importance_component=None, structures=None, targets=None,
             optimize_viewpoint=False, viewpoint_guide="attainable", reference=None, previous=(),
             progress=None, **settings):
    """Finds the extinction that minimises Eq. (21) for one camera and one light.

    Arrays have one number per point, shape (X, Y, Z), indexed [x, y, z]; those of images may be
    flat, x fastest, as VTK has them. Arrays of float32 are used where they are if their memory has
    no gaps and both have the same order of axes, whichever that is (Fortran's and VTK's, C's); of
    others there is one copy in float32, and functions make one array each. A point with NaN,
    infinity or a negative extinction is taken as empty, and importance is moved into [0, 1], with a
    warning.

    volume: an image of PyVista's or VTK's, or an array of scalars; None where `extinction` and
        `importance` are arrays.
    scalars: an array, or the name of one of the image's; None: `volume`, or its active scalars.
    importance: the same for the importance; None: the image's array "Importance", or with
        `importance_function` the scalars. None of these: the largest scalars are taken for
        important, between their 95th and 99th percentile, or above where these are in noise, as
        the display does, with a warning.
    importance_function: nodes [value, importance] that map `importance` to [0, 1].
    importance_component: of an importance with several values per point, (X, Y, Z, components):
        which of them, from 0 on, or -1 for the length of the tuple; None: there is one.
    structures: labels of a segmentation, whole numbers: an array, or the name of one of the
        image's. Then `importance` is {label: importance}; other labels have none. None: all labels
        but 0 are important, with a warning. Labels are never interpolated, their importance is.
    targets: {label: share of the structure that should be visible, 0 to 1}. The optimisation is
        repeated with other importances until it is, or no further run helps, at most 20 times; a
        warning says which targets are not met, and why. Without `importance`, structures with
        targets are the important ones.
    extinction: an array of the base extinction, or a name [1/length].
    extinction_function: nodes [scalar, extinction], in place of `extinction` [1/length].
    opacity_function: nodes [scalar, opacity on one unit distance], in place of both. None of the
        three: a straight line from 0 to 1 over the range of the scalars.
    unit_distance: of opacities [length]; None: the mean length of a cell.
    spacing, origin, direction: of an array's points, see PyVista's ImageData; spacings 1, origin 0,
        a matrix (3, 3) whose columns are the directions of the axes; an image has its own.
    camera: a limpid.Camera, a camera of PyVista, (position, focal point, view up), or a mapping
        with these names; None: on the z axis, where Reset Camera puts a new one.
    light: a limpid.Light, a light of PyVista, or its position; None: above the camera.
    optimize_viewpoint: move the camera on the sphere round its focal point, too (Section 3.4).
    viewpoint_guide: what tells the way. "attainable": what could be seen from each view at most;
        the extinction is optimised once, where that is highest. "proxy": the majorant times
        importance. "coupled": the extinction found last.
    reference: an extinction to stay near with reference_pull above 0: an array, or the name of one
        of the image's [1/length].
    previous: what optimize has found for another view or time step of the same box, None for the
        first: with warm_start=True the iterations start from it, and with temporal_coherence=0.2,
        say, the result stays near it where little is to be gained, unless it is of other settings
        or of a view more than 20 degrees away.
    progress: called after every iteration with the share of the work that is done, 1 at the end,
        and a text; stops with the best so far if it returns False.
    settings: members of limpid.Settings by name, such as view_weight=20, and preset="Paper" or
        settings=limpid.Settings(...) for several at once, which the former replace.

    Returns an Optimization. Raises ValueError for data and settings that cannot be worked with,
    TypeError for names that there are not. Ctrl-C ends it.
    """
    settings = Settings.of(settings)
    core_settings = settings_for(structures, settings.in_core())
    views = settings.views_in_core()
    guide = choice("viewpoint_guide", viewpoint_guide, _core.ViewpointGuide)
    report = report_to(progress)
    before = Previous(previous, settings)
    if optimize_viewpoint:
        require_one_camera(settings, before)
    scene = scene_of(volume, scalars, importance, importance_function, extinction,
                     extinction_function, opacity_function, unit_distance, spacing, origin,
                     direction, importance_component, structures, before.layout(),
                     targets_by_label(targets, structures))
    before.require_box(scene.grid)
    scene.warn_of_nothing_to_see("there is nothing to clear the view for: the extinction stays as "
                                 "it is")
    view = camera_of(camera, scene.grid)
    lamp = light_of(light, view)
    memory = Memory.of(scene, settings)
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
                        structures=None if shares is None else
                        StructureShares.all_of(scene.segmentation, shares),
                        convergence=np.array(found.pop("convergence"), dtype=CONVERGENCE), **found)
