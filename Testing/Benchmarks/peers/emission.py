# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""An integrator for Mitsuba 3: the radiance of a medium that emits and absorbs.

Mitsuba's media have no emission, and prbvolpath finds light at surfaces and emitters alone. Here
the emission is the medium's albedo times its extinction, and nothing is scattered: the integral of
albedo x extinction x transmittance along a ray, by tentative collisions with the majorant, each of
which adds its expected share and lets the expected rest go on. Backward, the path is replayed: what
comes after a collision is what is left of the sum.
"""

import drjit as dr
import mitsuba as mi
from mitsuba.ad.integrators.common import RBIntegrator


class EmissionIntegrator(RBIntegrator):
    """Sees the medium inside the first shape that a ray hits, up to the shape's other side."""

    @dr.syntax
    def sample(self, mode, scene, sampler, ray, δL, state_in, active, **_):
        primal = mode == dr.ADMode.Primal
        active = mi.Bool(active)
        shell = scene.ray_intersect(ray, active)
        active &= shell.is_valid()
        hit = mi.Bool(active)
        medium = shell.target_medium(ray.d)
        medium[~active] = dr.zeros(mi.MediumPtr)
        active &= medium != None  # noqa: E711; a ray that grazes an edge may be outside already
        ray = mi.Ray3f(shell.spawn_ray(ray.d))
        exit = scene.ray_intersect(ray, active)
        active &= exit.is_valid()  # nor does it need to meet the other side
        ray.maxt = exit.t

        seen = mi.Spectrum(0 if primal else state_in)  # backward: what is left of it
        adjoint = mi.Spectrum(δL if δL is not None else 0)
        throughput = mi.Spectrum(1)
        while dr.hint(active, label=f"emission ({mode.name})"):
            with dr.resume_grad(when=not primal):
                collision = medium.sample_interaction(
                    ray, sampler.next_1d(active), mi.UInt32(0), active)
                active &= collision.is_valid()
                shown = throughput * collision.sigma_s / collision.combined_extinction
                kept = collision.sigma_n / collision.combined_extinction
                seen[active] += dr.detach(shown if primal else -shown)
                if dr.hint(not primal, mode="scalar"):
                    rest = seen / dr.maximum(1e-8, dr.detach(kept))
                    dr.backward(dr.select(active, adjoint * (shown + kept * dr.detach(rest)), 0))
                throughput[active] *= dr.detach(kept)
                ray.maxt[active] = dr.detach(ray.maxt - collision.t)
                ray.o[active] = dr.detach(collision.p)
                active &= dr.any(throughput > 0)
        return seen if primal else adjoint, hit, [], seen


mi.register_integrator("emission", EmissionIntegrator)
