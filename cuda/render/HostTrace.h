// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Tracing of a ray on the processor: samples in blocks, in the widest vector registers available.
// Each kind of compositing is compiled in a file of its own, since one takes as long to compile as
// the rest of rendering.

#ifndef limpid_render_HostTrace_h
#define limpid_render_HostTrace_h

#include "backend/Simd.h"
#include "render/BlockSampler.h"
#include "render/ExtinctionOverlay.h"
#include "render/TraceByImportance.h"

namespace limpid
{
using HostPixel = Pixel<BlockSampler::Optical>;
using TraceOneRay = void (*)(const RayScene& scene, const Ray& ray, HostPixel& pixel);

template <Compositing compositing, bool lit, bool overlaid>
void HostTrace(const RayScene& scene, const Ray& ray, HostPixel& pixel)
{
  RunMultiversioned([&]() LIMPID_INLINE_LAMBDA
    { TraceAs<compositing, BlockSampler, lit, overlaid>(scene, ray, pixel); });
}

/// The functions that trace rays for scenes with and without a gradient (lit) and an overlay.
template <Compositing compositing>
TraceOneRay HostTraceBy(bool lit, bool overlaid)
{
  constexpr TraceOneRay all[2][2] = { { HostTrace<compositing, false, false>,
                                        HostTrace<compositing, false, true> },
    { HostTrace<compositing, true, false>, HostTrace<compositing, true, true> } };
  return all[lit][overlaid];
}

extern template TraceOneRay HostTraceBy<Compositing::FrontToBack>(bool lit, bool overlaid);
extern template TraceOneRay HostTraceBy<Compositing::FromObject>(bool lit, bool overlaid);
extern template TraceOneRay HostTraceBy<Compositing::ImportanceMean>(bool lit, bool overlaid);
}

#endif
