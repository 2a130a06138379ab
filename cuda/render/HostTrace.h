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

template <Compositing compositing, bool lit, bool overlaid, bool tinted>
void HostTrace(const RayScene& scene, const Ray& ray, HostPixel& pixel)
{
  RunMultiversioned([&]() LIMPID_INLINE_LAMBDA
    { TraceAs<compositing, BlockSampler, lit, overlaid, tinted>(scene, ray, pixel); });
}

/// The functions that trace rays for scenes with and without a gradient (lit) and an overlay, with
/// or without scene.structures (tinted).
template <Compositing compositing, bool tinted>
TraceOneRay HostTraceBy(bool lit, bool overlaid)
{
  constexpr TraceOneRay all[2][2] = { { HostTrace<compositing, false, false, tinted>,
                                        HostTrace<compositing, false, true, tinted> },
    { HostTrace<compositing, true, false, tinted>, HostTrace<compositing, true, true, tinted> } };
  return all[lit][overlaid];
}

extern template TraceOneRay HostTraceBy<Compositing::FrontToBack, false>(bool lit, bool overlaid);
extern template TraceOneRay HostTraceBy<Compositing::FrontToBack, true>(bool lit, bool overlaid);
extern template TraceOneRay HostTraceBy<Compositing::FromObject, false>(bool lit, bool overlaid);
extern template TraceOneRay HostTraceBy<Compositing::FromObject, true>(bool lit, bool overlaid);
extern template TraceOneRay HostTraceBy<Compositing::ImportanceMean, false>(
  bool lit, bool overlaid);
extern template TraceOneRay HostTraceBy<Compositing::ImportanceMean, true>(bool lit, bool overlaid);
}

#endif
