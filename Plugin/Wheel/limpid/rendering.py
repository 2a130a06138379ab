# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Draws a volume, lit and shadowed."""

import numpy as np

from . import _core
from .arguments import number, whole_number
from .fields import Layout, converted, emptied, mapped
from .functions import table_of
from .scene import extinction_function_of, ramp_of, unit_distance_of
from .views import camera_of, clip_to_world, light_of
from .volume import Volume

SAMPLES = 4096  # of transfer functions
LARGEST_PICTURE = 1 << 15  # pixels along an axis


def transfer_functions(extinction, colors):
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


def color_nodes(color_function):
    """Nodes (n, 4), checked."""
    nodes = table_of("color_function", color_function, 4)
    if not np.all((nodes[:, 1:] >= 0) & (nodes[:, 1:] <= 1)):
        raise ValueError("color_function has a channel outside [0, 1] (channels outside this range "
                         "cannot be displayed). Divide by 255 if the colors are bytes.")
    return nodes


def field_like_scalars(source, role, given, layout):
    """A field of the caller's in that layout, flat; None: not given."""
    if given is None:
        return None
    return layout.flat(converted(source.field(role, given), layout))


def drawable(scalars, mask, layout):
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


def straight_alpha(rgba):
    """Colors that are not multiplied by alpha, of a picture (height, width, 4) of uint8 whose
    colors are."""
    alpha = rgba[..., 3:].astype(np.uint32)
    colors = (rgba[..., :3].astype(np.uint32) * 255 + alpha // 2) // np.maximum(alpha, 1)
    return np.dstack([np.minimum(colors, 255), alpha]).astype(np.uint8)


def render(volume, *, color_function, scalars=None, extinction_function=None,
           opacity_function=None, unit_distance=None, spacing=None, origin=None, direction=None,
           extinction=None, light_extinction=None, camera=None, width=600, height=600, light=None,
           lit=True, shadows=True, shadow_strength=0.7, ambient=0.35, anisotropy=0.6, specular=2.0,
           specular_power=20.0, light_intensity=1.0, sample_distance=1.0):
    """Draws a volume with single scattering, Eqs. (1)-(6), as the display Optimized Volume does.

    volume, scalars, extinction_function, opacity_function, unit_distance, spacing, origin,
        direction, camera, light: as for optimize; a Viewpoint is a camera, too. NaN is empty.
    color_function: nodes [scalar, red, green, blue], colors in [0, 1].
    extinction: what optimize has found for this volume and this function, an array or a name
        [1/length]; None: the function's is drawn.
    light_extinction: what casts the shadows, if that is another extinction [1/length].
    width, height: of the picture [pixels].
    lit: off: every point has the color of the function.
    shadows: whether the volume casts shadows on itself; shadow_strength: how much of them [0, 1].
    ambient: share of the light that comes from all sides [0, 1].
    anisotropy: of the Henyey-Greenstein phase function (-1, 1).
    specular, specular_power: weight, not below zero, and exponent of the highlights.
    light_intensity: 1: what faces light and viewer keeps its color.
    sample_distance: between samples of a ray, in units of the smallest spacing, above zero.

    Returns the picture: uint8 (height, width, 4), red, green, blue, alpha, the top row first, the
    colors not multiplied by alpha, as PIL, matplotlib and PyVista want it. It is drawn by the
    processor. Raises ValueError for arguments that cannot be worked with. Ctrl-C ends it.
    """
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
        layout.flat(*emptied((mapped(values, function, layout),), mask)), copy=False)
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
    picture = _core.render(
        source.grid.in_core(layout.order), layout.flat(drawable(values, mask, layout)),
        transfer_functions(function, color_nodes(color_function)), base, found,
        field_like_scalars(source, "light extinction", light_extinction, layout), lighting,
        _core.View(*size, matrix.T.ravel().tolist(),
                   number("sample_distance", sample_distance, "rays would not advance",
                          "Give a number above zero.")))
    return straight_alpha(picture.reshape(size[1], size[0], 4)[::-1])
