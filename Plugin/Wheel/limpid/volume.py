# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""What a user calls a volume: an image of PyVista's or VTK's, or arrays."""

import numpy as np

from .grid import Grid

HIDDEN = 3  # flags of a blanked point (duplicate, hidden) in VTK's ghost arrays
BLANKED = {"point_data": HIDDEN, "cell_data": 41}  # of a cell: duplicate, refined, hidden


def is_image(volume):
    """Whether it has what an image has; the package knows neither VTK nor PyVista."""
    return all(hasattr(volume, name) for name in ("dimensions", "spacing", "point_data"))


def refuse_blanked(image):
    """Raises ValueError where points or cells are blanked: the filters know what to do then."""
    for place, flags in BLANKED.items():
        data = getattr(image, place)
        if "vtkGhostType" in data.keys() and np.any(np.asarray(data["vtkGhostType"]) & flags):
            raise ValueError(f"The image has blanked parts, by vtkGhostType in its {place} (they "
                             "would be taken as if they were there). Set their scalars to NaN and "
                             "remove that array.")


class Volume:
    """Fields over one grid.

    volume: an image; an array of scalars, shape (X, Y, Z), indexed [x, y, z]; or None.
    others: the other arrays of that shape; the grid has it from them if `volume` is None.
    spacing, origin, direction: see Grid; not with an image, which has them.
    """

    def __init__(self, volume, others, spacing=None, origin=None, direction=None):
        placement = {"spacing": spacing, "origin": origin, "direction": direction}
        given = {name: value for name, value in placement.items() if value is not None}
        self.image = volume if is_image(volume) else None
        self.scalars = None if volume is None or self.image is not None else np.asarray(volume)
        if self.image is not None:
            if given:
                raise ValueError(f"{' and '.join(given)} and an image are given (the image has its "
                                 "own). Leave them out, or give an array.")
            refuse_blanked(self.image)
            self.grid = Grid.of_image(self.image)
        else:
            self.grid = Grid(self._shape([self.scalars, *others]), **given)
        if not self.grid.has_volume():
            raise ValueError(f"The volume has {' x '.join(map(str, self.grid.shape))} points "
                             "(without a volume nothing can hide anything). Give at least two "
                             "points along each axis.")

    @staticmethod
    def _shape(arrays):
        arrays = [array for array in arrays if hasattr(array, "shape")]
        if not arrays:
            raise ValueError("There is neither a volume nor an array of extinction and importance "
                             "(there is nothing to be seen). Give an image or arrays.")
        if arrays[0].ndim != 3:
            raise ValueError(f"The volume has the shape {arrays[0].shape} (its axes are x, y and "
                             "z). Give an array with three axes.")
        return arrays[0].shape

    def field(self, role, given, default=None):
        """An array of shape `grid.shape`, of any type, never copied.

        role: what it is, for messages.
        given: an array, or the name of one of the image's; None: the image's array `default`, by
            default its active scalars, or the array of scalars that is the volume.
        """
        if given is None and self.image is None and default is None:
            given = self.scalars
        if given is None and self.image is None:
            raise ValueError(f"There is no {role} (the scene cannot be made without it). Give an "
                             "array, or an image with one.")
        if given is None:
            given = default or self._active_name()
        array = self._named(role, given) if isinstance(given, str) else np.asarray(given)
        if array.dtype.kind not in "fiub":
            raise ValueError(f"The {role} array has the type {array.dtype} (its values are "
                             "numbers). Give an array of real numbers.")
        if self.image is not None and array.shape == (np.prod(self.grid.shape),):
            array = array.reshape(self.grid.shape, order="F")  # VTK's order: x fastest
        if array.shape != self.grid.shape:
            raise ValueError(f"The {role} array has the shape {array.shape} and the volume has "
                             f"{self.grid.shape} points (values belong to points). Give one number "
                             "for each point, indexed [x, y, z].")
        return array

    def _active_name(self):
        data = self.image.point_data
        name = getattr(data, "active_scalars_name", None)
        if name is None and hasattr(self.image, "GetPointData"):
            active = self.image.GetPointData().GetScalars()
            name = active.GetName() if active else None
        return name or "(the active scalars)"

    def _named(self, role, name):
        if self.image is None:
            raise ValueError(f"The {role} is {name!r}, a name, and the volume is an array (only "
                             "images have names for arrays). Give the array itself.")
        names = list(self.image.point_data.keys())
        if name not in names:
            raise ValueError(f"The {role} array {name!r} is not among the image's arrays of points "
                             "(the scene cannot be made without it). Choose one of these: "
                             f"{', '.join(map(repr, names)) or 'there is none'}.")
        return np.asarray(self.image.point_data[name])
