# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The visibility score S of Eq. (32), of the onion scene and its camera, by Mitsuba 3.

S is the integral over directions and along each ray of g mu T d^2, d the distance from the eye.

* "emission" (emission.py): a medium that emits g d^2 mu and absorbs mu is seen with the radiance
  that is the inner integral.
* "prbvolpath", Mitsuba's own: a point light at the eye in a medium with half the extinction, whose
  transmittance on the way there and back is T, once scattered: the radiance is
  albedo (mu / 2) T / (4 pi d^2) summed along the ray, so an albedo of g d^4 does it.

Pixels count with their solid angle. Rays go where something is important, and there is one in every
pixel: pixels stratify them. The grid's samples are in the middles of cells, so the box of the
volume is half a spacing larger than that of the nodes; between nodes both are trilinear.
"""

import math

import drjit as dr
import mitsuba as mi
import numpy as np

import onion

CORE_RADIUS = 0.4  # where importance ends
KINDS = {  # power of the distance in the albedo, share of the extinction, S per weighted radiance
    "emission": (2, 1.0, 1.0),
    "prbvolpath": (4, 0.5, 8 * math.pi),
}


class Score:
    """S and its derivative by the extinction; `pixels` along each side of the picture."""

    def __init__(self, nodes, extinction, importance, integrator, pixels):
        power, self.share, factor = KINDS[integrator]
        axis = np.linspace(-1.0, 1.0, nodes) - onion.CAMERA[:, None]
        distance = np.sqrt(axis[2][:, None, None]**2 + axis[1][:, None]**2 + axis[0]**2)
        far = distance[importance > 0].max()
        spacing = 2.0 / (nodes - 1)
        way = np.linalg.norm(onion.CORE - onion.CAMERA)
        half = math.asin((CORE_RADIUS + math.sqrt(3.0) * spacing) / way)
        self.scene = mi.load_dict(scene(
            integrator, pixels, math.degrees(2 * half), 1 + spacing / 2,
            self.share * extinction, importance * (distance / far) ** power))
        self.parameters = mi.traverse(self.scene)
        self.key = "box.interior_medium.sigma_t.data"
        side = math.tan(half) * ((np.arange(pixels) + 0.5) * 2 / pixels - 1)
        area = (2 * math.tan(half) / pixels) ** 2
        solid_angle = area * (1 + side**2 + side[:, None] ** 2) ** -1.5
        self.weights = mi.TensorXf(np.float32(factor * far**power * solid_angle[..., None]))
        self.seed = 0

    def picture(self):
        """Its pixels, weighted, of new random numbers each time."""
        self.seed += 2
        image = mi.render(self.scene, self.parameters, spp=1, seed=self.seed,
                          seed_grad=self.seed + 1)
        return dr.sum(image * self.weights, axis=None)

    def value(self):
        return float(self.picture().array[0])

    def value_and_gradient(self):
        """S, and its derivative by the extinction of every node, indices (z, y, x)."""
        extinction = mi.TensorXf(dr.detach(self.parameters[self.key]))
        dr.enable_grad(extinction)
        self.parameters[self.key] = extinction
        self.parameters.update()
        score = self.picture()
        dr.backward(score)
        gradient = dr.grad(extinction)
        dr.eval(gradient)
        dr.disable_grad(extinction)
        self.parameters[self.key] = dr.detach(extinction)
        self.parameters.update()
        return float(score.array[0]), self.share * gradient.numpy()[..., 0]


def scene(integrator, pixels, field_of_view, half_side, extinction, albedo):
    place = mi.ScalarTransform4f
    to_box = place().translate([-half_side] * 3).scale(2 * half_side)

    def grid(field):
        return {"type": "gridvolume", "raw": True, "filter_type": "trilinear",
                "wrap_mode": "clamp", "to_world": to_box,
                "grid": mi.VolumeGrid(np.ascontiguousarray(field[..., None], np.float32))}

    return {
        "type": "scene",
        "integrator": {"type": integrator, "max_depth": 2},
        "sensor": {
            "type": "perspective", "fov": field_of_view,
            "to_world": place().look_at(origin=list(onion.CAMERA), target=list(onion.CORE),
                                        up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": pixels, "height": pixels,
                     "pixel_format": "luminance", "component_format": "float32",
                     "rfilter": {"type": "box"}},
            "sampler": {"type": "independent"}},
        "light": {"type": "point", "position": list(onion.CAMERA), "intensity": 1.0},
        "box": {
            "type": "cube", "to_world": place().scale(half_side), "bsdf": {"type": "null"},
            "interior": {"type": "heterogeneous", "sigma_t": grid(extinction),
                         "albedo": grid(albedo)}},
    }
