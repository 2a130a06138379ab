# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The energy of Eq. (21) in PyTorch, differentiated automatically.

Rays, samples, weights and units are Limpid's (Documentation/Method.md, sections 1 to 3): from each
eye one ray per voxel and axis on the farthest slice, two samples per layer at the points of Gauss'
rule, a sample stands for its half of the layer. Extinction is sampled by grid_sample; what does not
depend on it (positions, lengths, importance times area) is computed once. In one respect this is
simpler: the area of a half layer is its mean, not that of where light is stopped.
"""

import math

import numpy as np
import torch
from torch.nn.functional import grid_sample

from onion import CAMERA, LAMP, LIGHT, RADIUS, REGULARIZATION, VIEW

GAUSS_POINTS = (0.21132486540518712, 0.78867513459481288)
SAMPLERS = ("planes", "trilinear")


class Rays:
    """All rays from an eye and their samples, in double precision.

    Arrays have the indices (sample, row, column); positions are grid_sample's, from -1 to 1.
    """

    def __init__(self, nodes, eye):
        self.spacing = 2.0 / (nodes - 1)
        self.last = nodes - 1
        self.eye = (eye + 1.0) / self.spacing  # [index]
        self.depth_axis = int(np.argmax(np.abs(self.eye - 0.5 * self.last)))
        self.sign = -1 if self.eye[self.depth_axis] > 0 else 1
        self.axes = [axis for axis in range(3) if axis != self.depth_axis]
        ends = [self.sign * (end - self.eye[self.depth_axis]) for end in (0, self.last)]
        self.near, self.far = min(ends), max(ends)
        if self.near <= 0:
            raise ValueError(f"The eye {eye} is not outside the box (rays would have to start "
                             "inside). Move it away.")
        columns, rows = (self.slopes(axis) for axis in self.axes)
        self.place(columns, rows)

    def slopes(self, axis):
        """Middles of equal parts of the slopes under which the box is seen."""
        corners = [(end - self.eye[axis]) / depth
                   for end in (0, self.last) for depth in (self.near, self.far)]
        low, high = min(corners), max(corners)
        if max(-low, high) > 1:
            raise ValueError(f"A ray moves sideways by {max(-low, high):.2f} voxels per slice "
                             "(one axis is not enough then). Move the eye away or to the side.")
        count = max(16, math.ceil((high - low) * self.far - 1e-9))
        return low + (high - low) / count * (np.arange(count) + 0.5)

    def crossing(self, axis, slopes):
        """Depths at which rays enter and leave the slab of the box along an axis."""
        with np.errstate(divide="ignore"):
            ends = (np.array([[0.0], [self.last]]) - self.eye[axis]) / slopes
        return ends.min(axis=0), ends.max(axis=0)

    def place(self, columns, rows):
        layers = self.near + np.arange(self.last)[:, None]
        begin = (layers + (0.0, 0.5)).ravel()[:, None, None]
        depth = (layers + GAUSS_POINTS).ravel()[:, None, None]
        a, b = columns[None, None, :], rows[None, :, None]
        (enter_u, leave_u), (enter_v, leave_v) = (
            self.crossing(axis, slopes) for axis, slopes in zip(self.axes, (columns, rows)))
        enter = np.maximum(enter_u[None, None, :], enter_v[None, :, None])
        leave = np.minimum(leave_u[None, None, :], leave_v[None, :, None])
        front = np.clip(enter, begin, begin + 0.5)
        back = np.maximum(np.clip(leave, begin, begin + 0.5), front)
        per_depth = self.spacing * np.sqrt(1 + a**2 + b**2)
        self.length = (back - front) * per_depth  # of what a sample stands for
        cell = self.spacing**3 * (columns[1] - columns[0]) * (rows[1] - rows[0])
        self.area = cell * (front**2 + front * back + back**2) / 3 / per_depth
        self.positions = [None, None, None]
        for axis, offset in ((self.axes[0], a * depth), (self.axes[1], b * depth),
                             (self.depth_axis, self.sign * depth)):
            self.positions[axis] = 2 * (self.eye[axis] + offset) / self.last - 1


def positions_of(rays, rows):
    """Positions of the samples of some rows of rays along each axis: (sample, row, column)."""
    shape = rays.length[:, rows].shape
    return [
        torch.as_tensor(np.broadcast_to(p[:, rows] if p.shape[1] > 1 else p, shape).clip(-1, 1))
        for p in rays.positions]


class Trilinear:
    """Samples at some rows of rays, as indices (sample, row, column), by one grid_sample of the
    volume. On the CPU that works in parallel over its batch only, so the rays are dealt out to as
    many batches as there are threads."""

    def __init__(self, rays, rows, like):
        grid = torch.stack(positions_of(rays, rows), dim=-1).to(like)
        samples = grid.shape[0]
        self.shape = grid.shape[:-1]
        self.batches = torch.get_num_threads() if like.device.type == "cpu" else 1
        grid = grid.flatten(1, 2)
        missing = -grid.shape[1] % self.batches
        grid = torch.cat([grid, grid[:, :missing]], dim=1)
        grid = grid.view(samples, self.batches, -1, 3).transpose(0, 1)
        self.grid = grid.unsqueeze(1).contiguous()  # indices (batch, 1, sample, ray, axis)

    @staticmethod
    def prepare(field, _):
        return field

    def __call__(self, field):
        batch = field.expand(self.batches, 1, *field.shape)
        found = grid_sample(batch, self.grid, padding_mode="border", align_corners=True)
        found = found.view(self.batches, self.shape[0], -1).transpose(0, 1).flatten(1)
        return found[:, : self.shape[1] * self.shape[2]].view(self.shape)


class Planes:
    """The same values by the volume blended to the planes through the points of Gauss' rule and one
    two-dimensional grid_sample on every plane: half the reads, and vectorised on the CPU."""

    def __init__(self, rays, rows, like):
        positions = positions_of(rays, rows)
        self.grid = torch.stack([positions[axis] for axis in rays.axes], dim=-1).to(like)

    @staticmethod
    def prepare(field, rays):
        order = [2 - rays.depth_axis, 2 - rays.axes[1], 2 - rays.axes[0]]
        slices = field.permute(order)
        slices = slices.flip(0) if rays.sign < 0 else slices
        shares = torch.tensor(GAUSS_POINTS, dtype=field.dtype, device=field.device)
        planes = torch.lerp(slices[:-1, None], slices[1:, None], shares.view(1, 2, 1, 1))
        return planes.flatten(0, 1).unsqueeze(1)

    def __call__(self, planes):
        return grid_sample(planes, self.grid, padding_mode="border", align_corners=True).squeeze(1)


class VisibleFromEye:
    """S of Eq. (32) from an eye. `parts`: the rays come in so many groups of rows, one after the
    other, so that fewer samples are held at a time."""

    def __init__(self, nodes, eye, importance, sampler, parts):
        self.kind = {"planes": Planes, "trilinear": Trilinear}[sampler]
        self.rays = Rays(nodes, eye)
        self.parts = []
        prepared = self.kind.prepare(importance, self.rays)
        for rows in np.array_split(np.arange(self.rays.length.shape[1]), parts):
            sampled = self.kind(self.rays, rows, importance)
            length = torch.as_tensor(self.rays.length[:, rows]).to(importance)
            shown = sampled(prepared) * torch.as_tensor(self.rays.area[:, rows]).to(importance)
            # A half layer shows its g times area times (T in front - T behind). Summed by parts,
            # T behind a sample counts with the change to the next sample.
            change = torch.diff(shown, dim=0, append=torch.zeros_like(shown[:1]))
            self.parts.append((sampled, -length, change, shown[0].sum()))
        del self.rays.length, self.rays.area, self.rays.positions

    @staticmethod
    def of_part(prepared, sampled, minus_length, change, first):
        transmittance = torch.exp(torch.cumsum(sampled(prepared) * minus_length, dim=0))
        return first + torch.dot(transmittance.flatten(), change.flatten())

    def value(self, extinction):
        prepared = self.kind.prepare(extinction, self.rays)
        return sum(self.of_part(prepared, *part) for part in self.parts)

    def backward(self, extinction, weight):
        """Adds weight times the derivative to extinction.grad; returns S."""
        prepared = self.kind.prepare(extinction, self.rays)
        leaf = prepared.detach().requires_grad_(True)
        total = 0.0
        for part in self.parts:
            score = self.of_part(leaf, *part)
            (weight * score).backward()
            total += score.detach()
        prepared.backward(leaf.grad)
        return total


class OnionEnergy:
    """F of Eq. (21) of the onion scene in world units, each term for itself; `camera_only`: the
    others are not there."""

    def __init__(self, base, importance, sampler, parts, camera_only=False):
        nodes = base.shape[0]
        self.base = base
        self.volume = (2.0 / (nodes - 1)) ** 3
        self.camera = VisibleFromEye(nodes, CAMERA, importance, sampler, parts)
        self.lamp = None if camera_only else VisibleFromEye(nodes, LAMP, importance, sampler, parts)

    def regularization(self, extinction):
        weight = 0.5 * REGULARIZATION * RADIUS * self.volume
        return weight * (extinction - self.base).square().sum()

    @torch.no_grad()
    def value(self, extinction):
        seen = -VIEW * self.camera.value(extinction)
        if self.lamp is None:
            return 0.0, seen, 0.0
        return self.regularization(extinction), seen, -LIGHT * self.lamp.value(extinction)

    def value_and_gradient(self, extinction):
        """The terms, and their derivative in extinction.grad; the graph of a term is gone before
        the next begins."""
        extinction.grad = None
        seen = self.camera.backward(extinction, -VIEW)
        if self.lamp is None:
            return 0.0, -VIEW * seen, 0.0
        kept = self.regularization(extinction)
        kept.backward()
        lit = self.lamp.backward(extinction, -LIGHT)
        return kept.detach(), -VIEW * seen, -LIGHT * lit
