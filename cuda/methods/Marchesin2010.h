// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_Marchesin2010_h
#define limpid_methods_Marchesin2010_h

#include "methods/MethodScene.h"

namespace limpid
{
/**
 * Returns what a source sees of the base extinction if nothing occludes anything else. All samples
 * of a ray have the same transmittance (EqualTransmittance), as [HG24] scores Marchesin et al.
 * [MMD10] in Section 4.3. This S does not describe light transport. Waits.
 */
template <class AnyDevice>
Seen SeeMarchesin2010(const MethodScene<AnyDevice>& scene);
}

#endif
