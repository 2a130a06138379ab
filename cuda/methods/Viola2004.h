// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_Viola2004_h
#define limpid_methods_Viola2004_h

#include "methods/MethodScene.h"

namespace limpid
{
/**
 * The extinction that the clip of Viola et al. [VKG04] amounts to, sampled to the nodes: base
 * extinction where the rays beside a node have come to their most important object (RayObject),
 * nothing in front of that. Half a layer before and behind the clip, it is a share.
 *
 * `extinction`: in: the base; out [1/length]. Waits for nothing.
 */
template <class AnyDevice>
void FindViola2004(const MethodScene<AnyDevice>& scene, float* extinction);
}

#endif
