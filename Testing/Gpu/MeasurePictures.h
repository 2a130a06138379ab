// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see Measure.h.

#ifndef limpid_testing_gpu_MeasurePictures_h
#define limpid_testing_gpu_MeasurePictures_h

#include "Measure.h"

#include "backend/CompiledDevice.h"

#include <memory>
#include <vector>

namespace limpid::benchmark
{
/// Pictures of a scene with the extinction that was found, at the nodes of the scene's grid
/// [1/length].
void MeasurePictures(const std::shared_ptr<CompiledDevice>& device, const GpuScene& scene,
  const std::vector<float>& extinction, const Effort& effort, SceneResult& result);
}

#endif
