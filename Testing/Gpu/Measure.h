// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h: what takes how long on the GPU, and with the processor in
// the role of one to see whether this program works.

#ifndef limpid_testing_gpu_Measure_h
#define limpid_testing_gpu_Measure_h

#include "GpuScene.h"
#include "Results.h"

namespace limpid::benchmark
{
struct Effort
{
  bool quick = false;     ///< only to see whether this program works
  int repetitions = 30;   ///< of short things, at most
  double mostSeconds = 2; ///< no further repetition of a thing after [s]
  int directions = 642;   ///< of the viewpoint search
  int pictureSide = 1024; ///< [pixels]
  int copySize = 1 << 30; ///< of what is copied to learn the rate [bytes]
};

/// Name and copy rate of the GPU.
DeviceResult MeasureDevice(const Effort& effort);

/// What cannot be had says why, in its figure.
SceneResult MeasureScene(const GpuScene& scene, const Effort& effort);
}

#endif
