// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_Viola2004_h
#define limpid_methods_Viola2004_h

#include "methods/MethodScene.h"

namespace limpid
{
/**
 * Computes the extinction that corresponds to the clipping of Viola et al. [VKG04] at the nodes:
 * the base extinction where the rays around a node have reached their most important object
 * (RayObject), and 0 in front of it. Within half a layer of the clip it is a fraction.
 *
 * `extinction`: in: the base extinction, out: the result [1/length]. Asynchronous.
 */
template <class AnyDevice>
void FindViola2004(const MethodScene<AnyDevice>& scene, float* extinction);
}

#endif
