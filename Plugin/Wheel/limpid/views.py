# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Cameras and lights, by VTK's conventions, and where they stand when nobody has placed them."""

from __future__ import annotations

import collections.abc
import dataclasses
import math
from typing import Any, Iterator, Mapping

import numpy as np

from . import _core
from .arguments import number, vector
from .given import CameraLike, Floats, LightLike
from .grid import Grid


class CameraPosition:
    """What PyVista takes for plotter.camera_position: three items, position, focal point, view up.
    These do not tell the view angle and the projection: see give_to."""

    position: tuple[float, float, float]
    focal_point: tuple[float, float, float]
    view_up: tuple[float, float, float]
    view_angle: float
    parallel_projection: bool
    parallel_scale: float
    aspect_ratio: float

    def __len__(self) -> int:
        return 3

    def __getitem__(self, index: Any) -> Any:
        return (self.position, self.focal_point, self.view_up)[index]

    def __iter__(self) -> Iterator[tuple[float, float, float]]:
        return iter((self.position, self.focal_point, self.view_up))

    @property
    def cpos(self) -> list[tuple[float, float, float]]:
        """The camera as PyVista has it: ``pyvista.Plotter.show(cpos=camera.cpos)``.

        Position [length], focal point [length] and view up. View angle and projection are not among
        them, see `give_to`.
        """
        return [self.position, self.focal_point, self.view_up]

    def give_to(self, camera: Any) -> None:
        """Places a camera of PyVista, with view angle and projection.

        Parameters
        ----------
        camera : pyvista.Camera
            The camera that is changed, ``plotter.camera`` for instance.
        """
        camera.position, camera.focal_point, camera.up = self
        camera.view_angle = self.view_angle
        camera.parallel_projection = self.parallel_projection
        camera.parallel_scale = self.parallel_scale


@dataclasses.dataclass(frozen=True)
class Camera(CameraPosition):
    """A camera in world coordinates. In PyVista: ``plotter.camera_position = camera.cpos``.

    Parameters
    ----------
    position : (float, float, float)
        Where the camera is [length].
    focal_point : (float, float, float)
        What it looks at [length].
    view_up : (float, float, float), default (0, 1, 0)
        What is upwards in the picture; of any length.
    view_angle : float, default 30
        Vertical opening, of a perspective camera only [degrees].
    parallel_projection : bool, default False
        Whether all rays run along the view direction.
    parallel_scale : float, default 1
        Half the height of the picture, of a parallel camera only [length].
    aspect_ratio : float, default 1
        Width of the picture over its height, for the setting restrict_to_view.

    Raises
    ------
    ValueError
        A vector has not three finite numbers, or a number is not finite.
    """

    position: tuple[float, float, float]
    focal_point: tuple[float, float, float]
    view_up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    view_angle: float = 30.0
    parallel_projection: bool = False
    parallel_scale: float = 1.0
    aspect_ratio: float = 1.0

    def __post_init__(self) -> None:
        for name in ("position", "focal_point", "view_up"):
            value = vector(f"The camera's {name}", getattr(self, name),
                           "rays are constructed from it")
            object.__setattr__(self, name, value)
        for name in ("view_angle", "parallel_scale", "aspect_ratio"):
            size = number(f"The camera's {name}", getattr(self, name),
                          "the size of the picture depends on it", "Give a finite number.")
            object.__setattr__(self, name, size)
        object.__setattr__(self, "parallel_projection", bool(self.parallel_projection))

    def in_core(self) -> _core.Camera:
        """The camera as the core has it."""
        return _core.Camera(self.position, self.focal_point, self.view_up, self.view_angle,
                            self.parallel_projection, self.parallel_scale, self.aspect_ratio)

    def axes(self) -> tuple[Floats, Floats, Floats, float]:
        """Right, up and forward in the picture, and the distance of the focal point [length]."""
        way = np.subtract(self.focal_point, self.position)
        distance = float(np.linalg.norm(way))
        if not distance > 0:
            raise ValueError(f"The camera's position and focal_point are {self.position} (the view "
                             "direction is undefined). Move one of the two.")
        right = np.cross(way, self.view_up)
        if not np.linalg.norm(right) > 1e-12 * distance * np.linalg.norm(self.view_up):
            right = np.cross(way, np.eye(3)[np.argmin(np.abs(way))])  # any will do
        right /= np.linalg.norm(right)
        forward = way / distance
        return right, np.cross(right, forward), forward, distance


@dataclasses.dataclass(frozen=True)
class Light:
    """The light that the extinction is optimised for, in world coordinates.

    Parameters
    ----------
    position : (float, float, float)
        Where the light is [length].
    directional : bool, default False
        Whether its rays are parallel, from the position towards the focal point.
    focal_point : (float, float, float), optional
        Of a directional light [length]. Default is the camera's.

    Raises
    ------
    ValueError
        A vector has not three finite numbers.
    """

    position: tuple[float, float, float]
    directional: bool = False
    focal_point: tuple[float, float, float] | None = None

    def __post_init__(self) -> None:
        position = vector("The light's position", self.position, "shadows are computed from it")
        object.__setattr__(self, "position", position)
        object.__setattr__(self, "directional", bool(self.directional))
        if self.focal_point is not None:
            focal_point = vector("The light's focal_point", self.focal_point,
                                 "it is the target of the light")
            object.__setattr__(self, "focal_point", focal_point)

    def in_core(self, camera: Camera) -> _core.Light:
        """The light as the core has it."""
        focal_point = camera.focal_point if self.focal_point is None else self.focal_point
        return _core.Light(self.position, focal_point if self.directional else None)


def members_of(given: Any, names: Mapping[str, tuple[str, ...]]) -> dict[str, Any]:
    """What a mapping or an object has of these names. `names`: of members, each with the names by
    which a mapping or an object may call it."""
    if isinstance(given, collections.abc.Mapping):
        return {name: given[key] for name, keys in names.items() for key in keys if key in given}
    return {name: getattr(given, key) for name, keys in names.items()
            for key in keys if hasattr(given, key)}


def camera_of(given: CameraLike, grid: Grid) -> Camera:
    """A Camera from what a user gives.

    given: a Camera; an object or a mapping with its members, as cameras of PyVista and VTK and
        scene files are; (position, focal point, view up), as PyVista's camera_position; None: where
        Reset Camera puts a new one, on the z axis through the volume's centre.
    """
    if given is None:
        position, focal_point, scale = _core.placed_camera(grid.in_core((0, 1, 2)))
        return Camera(position, focal_point, parallel_scale=scale)
    if isinstance(given, Camera):
        return given
    names = {field.name: (field.name,) for field in dataclasses.fields(Camera)}
    members = members_of(given, {**names, "view_up": ("up", "view_up")})
    if "position" not in members and not isinstance(given, str) and \
            hasattr(given, "__len__") and len(given) == 3:
        members = dict(zip(("position", "focal_point", "view_up"), given))
    if "position" not in members or "focal_point" not in members:
        raise ValueError(f"camera is {given!r} (a camera needs a position and a focal_point). Give "
                         "a limpid.Camera, a camera of PyVista, or (position, focal point, view "
                         "up).")
    return Camera(**members)


def light_of(given: LightLike, camera: Camera) -> Light:
    """A Light from what a user gives.

    given: a Light; its position; an object or a mapping with its members, as lights of PyVista and
        scene files are; None: 50 degrees above and 10 degrees to the right of the camera, as far
        from the focal point.
    """
    if given is None:
        x, y, z = _core.placed_light(camera.in_core())
        return Light((x, y, z))
    if isinstance(given, Light):
        return given
    members = members_of(given, {"position": ("position",), "focal_point": ("focal_point",),
                                 "directional": ("directional",), "positional": ("positional",)})
    if "positional" in members:
        members["directional"] = not members.pop("positional")
    return Light(**members) if "position" in members else Light(given)


def clip_to_world(camera: Camera, grid: Grid, aspect: float) -> Floats:
    """The matrix from clip coordinates, each in [-1, 1], near -1, to homogeneous world coordinates,
    (4, 4), for columns; what lies in front of the camera and in the volume is between near and far.

    aspect: width of the picture over its height.
    """
    right, up, forward, _ = camera.axes()
    middle = float(np.dot(grid.centre() - camera.position, forward))
    reach = 1.01 * grid.radius()
    far = max(middle + reach, reach)
    eye = np.array(camera.position)

    def column(vector3: Floats, weight: float) -> Floats:
        return np.append(vector3, weight)

    if camera.parallel_projection:
        near = middle - reach
        scale = camera.parallel_scale
        return np.column_stack([column(aspect * scale * right, 0), column(scale * up, 0),
                                column(0.5 * (far - near) * forward, 0),
                                column(eye + 0.5 * (far + near) * forward, 1)])
    # 1 / depth is a straight line between 1 / near and 1 / far.
    near = max(middle - reach, 1e-3 * far)
    tangent = math.tan(math.radians(0.5 * camera.view_angle))
    slope, mean = 0.5 * (1 / far - 1 / near), 0.5 * (1 / far + 1 / near)
    return np.column_stack([column(aspect * tangent * right, 0), column(tangent * up, 0),
                            slope * column(eye, 1), column(forward, 0) + mean * column(eye, 1)])
