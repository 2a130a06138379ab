# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws a volume, lit and shadowed."""

from __future__ import annotations

import numpy as np

from . import _core
from .arguments import number, whole_number
from .fields import Layout, converted, emptied, mapped
from .functions import ExtinctionFunction, table_of
from .given import (Array, CameraLike, FieldLike, Floats, LightLike, Mask, Picture, Progress, Rows,
                    Singles, Vector, VolumeLike)
from .progress import report_to
from .scene import extinction_function_of, ramp_of, unit_distance_of
from .views import camera_of, clip_to_world, light_of
from .volume import Volume

SAMPLES = 4096  # of transfer functions
LARGEST_PICTURE = 1 << 15  # pixels along an axis


def transfer_functions(extinction: ExtinctionFunction, colors: Floats) -> _core.TransferFunctions:
    """The core's transfer functions: both sampled at equal steps, constant outside.

    extinction: a function of the scalar [1/length].
    colors: nodes (n, 4): value, red, green, blue [0, 1].
    """
    ends = [*extinction.range(), colors[0, 0], colors[-1, 0]]
    low, high = min(ends), max(ends)
    if not high > low:
        high = low + max(1e-3 * abs(low), 1e-30)  # a table needs two values
    values = np.linspace(low, high, SAMPLES)
    channels = [np.interp(values, colors[:, 0], colors[:, channel]) for channel in (1, 2, 3)]
    return _core.TransferFunctions(low, high, extinction(values).astype(np.float32),
                                   np.column_stack(channels).astype(np.float32))


def color_nodes(color_function: Rows) -> Floats:
    """Nodes (n, 4), checked."""
    nodes = table_of("color_function", color_function, 4)
    if not np.all((nodes[:, 1:] >= 0) & (nodes[:, 1:] <= 1)):
        raise ValueError("color_function has a channel outside [0, 1] (channels outside this range "
                         "cannot be displayed). Divide by 255 if the colors are bytes.")
    return nodes


def field_like_scalars(source: Volume, role: str, given: FieldLike,
                       layout: Layout) -> Array | None:
    """A field of the caller's in that layout, flat; None: not given."""
    if given is None:
        return None
    return layout.flat(converted(source.field(role, given), layout))


def drawable(scalars: Array, mask: Mask | None, layout: Layout) -> Singles:
    """The scalars in that layout, NaN where there is no number: such points are empty.

    mask: where there is no scalar; None: nowhere.
    """
    values = converted(scalars, layout)
    if mask is not None:
        values = converted(np.where(mask, np.float32(np.nan), values), layout)
    if not np.isfinite([values.min(), values.max()]).all():
        values = np.where(np.isfinite(values), values, np.float32(np.nan))
        values = converted(values, layout)
    return values


def straight_alpha(rgba: Picture) -> Picture:
    """Colors that are not multiplied by alpha, of a picture (height, width, 4) of uint8 whose
    colors are."""
    alpha = rgba[..., 3:].astype(np.uint32)
    colors = (rgba[..., :3].astype(np.uint32) * 255 + alpha // 2) // np.maximum(alpha, 1)
    return np.dstack([np.minimum(colors, 255), alpha]).astype(np.uint8)


def render(volume: VolumeLike, *, color_function: Rows, scalars: FieldLike = None,
           extinction_function: Rows | None = None, opacity_function: Rows | None = None,
           unit_distance: float | None = None, spacing: Vector | None = None,
           origin: Vector | None = None, direction: Rows | None = None,
           extinction: FieldLike = None, light_extinction: FieldLike = None,
           camera: CameraLike = None, width: int = 600, height: int = 600,
           light: LightLike = None, lit: bool = True, shadows: bool = True,
           shadow_strength: float = 0.7, ambient: float = 0.35, anisotropy: float = 0.6,
           specular: float = 2.0, specular_power: float = 20.0, light_intensity: float = 1.0,
           sample_distance: float = 1.0, progress: Progress = None) -> Picture:
    """Draws a volume with single scattering, Eqs. (1)-(6), as the display Optimized Volume does.

    Parameters
    ----------
    volume : image or array
        As for `optimize`. NaN is empty.
    color_function : rows of [scalar, red, green, blue]
        Nodes of the colors [0, 1].
    scalars : array or str, optional
        The scalars, or the name of an array of the image. Default is `volume`, or its active
        scalars.
    extinction_function : rows of [scalar, extinction], optional
        Nodes of the extinction [1/length].
    opacity_function : rows of [scalar, opacity], optional
        Nodes of opacities on one unit distance [0, 1], in place of `extinction_function`. Without
        both it is a straight line from 0 to 1 over the range of the scalars.
    unit_distance : float, optional
        Distance to which opacities refer [length]. Default is the mean length of a cell.
    spacing : (float, float, float), optional
        Distance of the points of an array along each axis [length]. Default is 1.
    origin : (float, float, float), optional
        Position of the first point of an array [length]. Default is 0.
    direction : (3, 3) array, optional
        Matrix whose columns are the directions of an array's axes. Default is x, y, z.
    extinction : array or str, optional
        What `optimize` has found for this volume and this function [1/length]. Default is the
        function's extinction.
    light_extinction : array or str, optional
        What casts the shadows, if that is another extinction [1/length].
    camera : Camera, Viewpoint, or as for `optimize`, optional
        From where to look [length].
    width : int, default 600
        Width of the picture [pixels].
    height : int, default 600
        Height of the picture [pixels].
    light : Light, or as for `optimize`, optional
        Where the light is [length]. Default is above the camera.
    lit : bool, default True
        Whether there is light; else every point has the color of the function.
    shadows : bool, default True
        Whether the volume casts shadows on itself.
    shadow_strength : float, default 0.7
        How dark the shadows are [0, 1].
    ambient : float, default 0.35
        Share of the light that comes from all sides [0, 1].
    anisotropy : float, default 0.6
        Asymmetry of the Henyey-Greenstein phase function (-1, 1).
    specular : float, default 2
        Weight of the highlights, dimensionless, not below zero.
    specular_power : float, default 20
        Exponent of the highlights, dimensionless, not below zero.
    light_intensity : float, default 1
        Brightness, dimensionless; at 1, what faces light and viewer keeps its color.
    sample_distance : float, default 1
        Distance of the samples of a ray, above zero [smallest spacing].
    progress : callable or bool, optional
        Called some times per second with the share of the picture that is done, 1 at the end, and a
        text; what it returns does not matter. True: a `ProgressBar` with the time that is left.

    Returns
    -------
    numpy.ndarray of uint8, shape (height, width, 4)
        Red, green, blue and alpha, the top row first, the colors not multiplied by alpha, as PIL,
        matplotlib and PyVista want it. It is drawn by the processor.

    Raises
    ------
    ValueError
        Arguments cannot be worked with.
    KeyboardInterrupt
        Ctrl-C ends it.

    Examples
    --------
    >>> picture = render(image, color_function=[[0, 1, 1, 1]], extinction=found.extinction,
    ...                  camera=found.camera)
    >>> pathlib.Path("picture.png").write_bytes(png(picture))
    """
    report = report_to(progress)
    source = Volume(volume, [scalars], spacing, origin, direction)
    values = source.field("scalar", scalars)
    layout = Layout.for_all([values])
    distance = unit_distance_of(unit_distance, source.grid)
    function = extinction_function_of(extinction_function, opacity_function, distance) or \
        ramp_of(values, source.mask, distance)
    mask = source.mask  # of the scalars
    found = field_like_scalars(source, "extinction", extinction, layout)
    if found is None and light_extinction is not None:
        raise ValueError("light_extinction is given without extinction (it complements the "
                         "extinction for the camera). Give both.")
    base = None if found is None else np.nan_to_num(
        layout.flat(emptied(mapped(values, function, layout), mask)), copy=False)
    view = camera_of(camera, source.grid)

    lighting = _core.Lighting()
    lighting.enabled = bool(lit)
    lighting.light = light_of(light, view).in_core(view)
    lighting.shadows = bool(shadows)
    for name, value in {"shadow_strength": shadow_strength, "ambient": ambient,
                        "anisotropy": anisotropy, "specular": specular,
                        "specular_power": specular_power,
                        "light_intensity": light_intensity}.items():
        setattr(lighting, name, number(name, value, "brightness is computed from it",
                                       "Give a finite number."))
    size = [whole_number(name, value, 1, LARGEST_PICTURE, "it is a number of pixels",
                         f"Give a whole number from 1 to {LARGEST_PICTURE}.")
            for name, value in (("width", width), ("height", height))]
    matrix = clip_to_world(view, source.grid, size[0] / size[1])
    picture = np.asarray(_core.render(
        source.grid.in_core(layout.order), layout.flat(drawable(values, mask, layout)),
        transfer_functions(function, color_nodes(color_function)), base, found,
        field_like_scalars(source, "light extinction", light_extinction, layout), lighting,
        _core.View(size[0], size[1], matrix.T.ravel().tolist(),
                   number("sample_distance", sample_distance, "rays would not advance",
                          "Give a number above zero.")), report))
    if report:
        report.finish()
    return straight_alpha(picture.reshape(size[1], size[0], 4)[::-1])
