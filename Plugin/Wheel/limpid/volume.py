# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What a user calls a volume: an image of PyVista's or VTK's, or arrays."""

from __future__ import annotations

from typing import Any, Iterable, Sequence

import numpy as np

from .arguments import warn
from .given import Array, Mask
from .grid import Grid
from .named_axes import axes_of, doubt_about_axes, has_shape, placement_of, values_of

HIDDEN = 3  # flags of a blanked point (duplicate, hidden) in VTK's ghost arrays
BLANKED = {"point_data": HIDDEN, "cell_data": 41}  # of a cell: duplicate, refined, hidden


def is_image(volume: Any) -> bool:
    """Whether it has what an image has; the package knows neither VTK nor PyVista."""
    return all(hasattr(volume, name) for name in ("dimensions", "spacing", "point_data"))


def refuse_other_data(volume: Any) -> None:
    """Raises ValueError for data of VTK's and PyVista's that are no image, nor an array."""
    if is_image(volume) or not hasattr(volume, "GetClassName"):
        return
    if isinstance(volume, np.ndarray):  # PyVista's have the methods of VTK's array
        return
    if volume.GetClassName() == "vtkImageData":
        advice = "Give pyvista.wrap(volume): this VTK is older than 9.4."
    elif hasattr(volume, "GetNumberOfBlocks"):
        advice = "Choose one of its blocks."
    elif hasattr(volume, "GetPolys"):
        advice = "It is a surface without an inside: give the volume that it was made from."
    else:
        advice = ("Convert it, in PyVista with pyvista.create_grid(volume, dimensions=(100, 100, "
                  "100)).sample(volume).")
    raise ValueError(f"The volume is a {type(volume).__name__} (rays are traced through a single "
                     f"image with uniform spacing). {advice}")


def refuse_blanked(image: Any) -> None:
    """Raises ValueError where points or cells are blanked: the filters know what to do then."""
    for place, flags in BLANKED.items():
        data = getattr(image, place)
        if "vtkGhostType" in data.keys() and np.any(np.asarray(data["vtkGhostType"]) & flags):
            raise ValueError(f"The image has blanked parts, by vtkGhostType in its {place} "
                             "(blanking is not supported here). Set their scalars to NaN and "
                             "remove that array.")


class Volume:
    """Fields over one grid.

    volume: an image; an array of scalars, shape (X, Y, Z), indexed [x, y, z]; or None.
    others: the other arrays of that shape; the grid has it from them if `volume` is None.
    spacing, origin, direction: see Grid; not with an image, which has them.
    """

    def __init__(self, volume: Any, others: Sequence[Any], spacing: Any = None,
                 origin: Any = None, direction: Any = None) -> None:
        placement = {"spacing": spacing, "origin": origin, "direction": direction}
        given = {name: value for name, value in placement.items() if value is not None}
        refuse_other_data(volume)
        self.image = volume if is_image(volume) else None
        self.scalars = volume if self.image is None else None
        self.axes: tuple[int, int, int] = (0, 1, 2)  #: of an array as it is given: those that are x, y and z
        self.mask: Mask | None = None  #: where a masked array has no value, shape grid.shape; None: nowhere
        if self.image is not None:
            if given:
                raise ValueError(f"{' and '.join(given)} and an image are given (an image has its "
                                 "own). Leave them out, or give an array.")
            refuse_blanked(self.image)
            self.grid = Grid.of_image(self.image)
        else:
            self.grid = self._grid([volume, *others], given)
        if not self.grid.has_volume():
            raise ValueError(f"The volume has {' x '.join(map(str, self.grid.shape))} points (it "
                             "has no volume, so nothing is occluded). Give at least two points "
                             "along each axis.")

    def _grid(self, arrays: Iterable[Any], given: dict[str, Any]) -> Grid:
        first = next((array for array in arrays if has_shape(array)), None)
        if first is None:
            values = next((array for array in arrays if isinstance(array, (list, tuple))), None)
            if values is not None:
                raise ValueError(f"A {type(values).__name__} was given for values at points (it has "
                                 "no shape). Give an array, for example numpy.array of it.")
            raise ValueError("There is neither a volume nor an array of extinction and importance "
                             "(there is nothing to process). Give an image or arrays.")
        axes = axes_of(first)
        shape = np.shape(values_of(first))
        if len(shape) not in (3, 4):
            raise ValueError(f"The volume has the shape {shape} (the axes must be x, y and z). "
                             "Give an array with three axes.")
        if axes is not None:
            self.axes = axes[0], axes[1], axes[2]
        grid = Grid(tuple(shape[axis] for axis in self.axes), **{**placement_of(first), **given})
        self._compare(given, Grid(grid.shape, **placement_of(first)), placement_of(first))
        doubt = doubt_about_axes(grid.shape, grid.spacing) if axes is None else None
        if doubt:
            warn(doubt)
        return grid

    @staticmethod
    def _compare(given: dict[str, Any], own: Grid, told: dict[str, Any]) -> None:
        """Raises ValueError where what is given is not what the array itself tells."""
        for name in set(given) & set(told):
            ours, theirs = getattr(own, name), getattr(Grid(own.shape, **{name: given[name]}), name)
            if not np.allclose(ours, theirs, rtol=1e-6, atol=1e-6 * own.diagonal()):
                raise ValueError(f"{name} is {given[name]!r}, and the array's own is "
                                 f"{np.asarray(ours).tolist()} (these contradict each other). "
                                 f"Leave {name} out, or give the array without it.")

    def as_given(self, field: Array) -> Array:
        """A field of shape grid.shape as the volume itself is: arrays in the order of its axes,
        images flat, x fastest. Not copied, unless it is for an image and in another order."""
        if self.image is not None:
            return field.ravel(order="F")
        return field.transpose(np.argsort(self.axes))

    def field(self, role: str, given: Any, default: str | None = None,
              component: int | None = None) -> Array:
        """An array of shape `grid.shape`, of any type, never copied but for the length of tuples.

        role: what it is, for messages.
        given: an array, or the name of one of the image's; None: the image's array `default`, by
            default its active scalars, or the array of scalars that is the volume.
        component: of an array with several values per point: from 0 on, or -1 for the length of
            the tuple; None: there is one.
        """
        if given is None and self.image is None and default is None:
            given = self.scalars
        if given is None and self.image is None:
            raise ValueError(f"There is no {role} (the scene cannot be built without it). Give an "
                             "array, or an image with one.")
        if given is None:
            given = default or self._active_name()
        if isinstance(given, str):
            given = self._named(role, given)
        array = self._in_order(given)
        if array.dtype.kind not in "fiub":
            raise ValueError(f"The {role} array has the type {array.dtype} (values must be real "
                             "numbers). Give an array of real numbers.")
        self._require_points(role, array)
        array = component_of(role, array, component)
        self._add_mask(np.ma.getmask(array))
        return np.asarray(array)

    def _in_order(self, given: Any) -> Array:
        """An array, masked if it is given so, shape grid.shape, maybe with components behind."""
        array = given if isinstance(given, np.ma.MaskedArray) else values_of(given)
        points = int(np.prod(self.grid.shape))
        if self.image is not None and array.ndim in (1, 2) and array.shape[0] == points:
            # VTK's order: x fastest
            return array.reshape(self.grid.shape + array.shape[1:], order="F")
        axes = axes_of(given) or (*self.axes, 3)[:array.ndim]
        return array if axes == tuple(range(array.ndim)) or array.ndim != len(axes) else \
            array.transpose(axes)

    def _require_points(self, role: str, array: Array) -> None:
        shape = self.grid.shape
        cells = tuple(count - 1 for count in shape)
        if array.shape[:3] == cells or array.shape[:1] == (int(np.prod(cells)),):
            raise ValueError(f"The {role} array has the shape {array.shape}, one value for each of "
                             f"the volume's {cells} cells (values must be given at points). Give "
                             "values at points: in PyVista, those of "
                             "image.cell_data_to_point_data().")
        if array.shape[:3] != shape or array.ndim > 4:
            raise ValueError(f"The {role} array has the shape {array.shape} and the volume has "
                             f"{shape} points (the shapes must be equal). Give one number for each "
                             "point, indexed [x, y, z].")

    def _add_mask(self, mask: Any) -> None:
        if mask is not np.ma.nomask and mask.any():
            self.mask = mask if self.mask is None else self.mask | mask

    def has_array(self, name: str) -> bool:
        """Whether it is an image with an array of points of that name."""
        return self.image is not None and name in self.image.point_data.keys()

    def _active_name(self) -> str:
        image: Any = self.image
        name = getattr(image.point_data, "active_scalars_name", None)
        if name is None and hasattr(image, "GetPointData"):
            active = image.GetPointData().GetScalars()
            name = active.GetName() if active else None
        return name or "(the active scalars)"

    def _named(self, role: str, name: str) -> Array:
        if self.image is None:
            raise ValueError(f"The {role} is {name!r}, a name, and the volume is an array (only "
                             "images have named arrays). Give the array itself.")
        names = list(self.image.point_data.keys())
        if name in names:
            return np.asarray(self.image.point_data[name])
        of_cells = list(self.image.cell_data.keys())
        if name in of_cells or not names and of_cells:
            raise ValueError(f"The {role} array {name!r} is not among the image's arrays of "
                             f"points, and those of its cells are {', '.join(map(repr, of_cells))} "
                             "(values must be given at points). Give the image with values at "
                             "points: in PyVista, image.cell_data_to_point_data().")
        raise ValueError(f"The {role} array {name!r} is not among the image's arrays of points "
                         "(the scene cannot be built without it). Choose one of these: "
                         f"{', '.join(map(repr, names)) or 'there is none'}.")


def component_of(role: str, array: Array, component: int | None) -> Array:
    """One number per point of an array (X, Y, Z) or (X, Y, Z, components), see Volume.field."""
    count = array.shape[3] if array.ndim == 4 else 1
    if component is None and count > 1:
        advice = ("Choose one with importance_component, from 0 on, or -1 for the length of the "
                  "tuple." if role == "importance" else "Give one of them, array[..., 0] say.")
        raise ValueError(f"The {role} array has {count} values per point (a scalar is needed). "
                         f"{advice}")
    if component is not None and not -1 <= component < count:
        raise ValueError(f"The component of the {role} is {component}, and its array has {count} "
                         "(this component does not exist). Choose one from 0 on, or -1 for the "
                         "length of the tuple.")
    if array.ndim == 3:
        return array
    if component == -1 and count > 1:
        return np.sqrt(sum(array[..., i].astype(float) ** 2 for i in range(count)))
    return array[..., max(component or 0, 0)]
