// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Tracing of a ray on the processor: samples in blocks, in the widest vector registers available.
// Each of these functions takes seconds to compile for all instruction sets. Therefore only what
// most pictures need is compiled for each case.

#ifndef limpid_render_HostTrace_h
#define limpid_render_HostTrace_h

#include "render/BlockSampler.h"
#include "render/RayScene.h"
#include "render/Segment.h"

namespace limpid
{
using HostPixel = Pixel<BlockSampler::Optical>;
using TraceOneRay = void (*)(const RayScene& scene, const Ray& ray, HostPixel& pixel);

/// The functions that trace rays of a scene by TraceRay and by TraceMean.
TraceOneRay HostTraceFrontToBack(const RayScene& scene);
TraceOneRay HostTraceImportanceMean(const RayScene& scene);
}

#endif
