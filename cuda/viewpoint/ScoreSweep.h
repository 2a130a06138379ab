// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ScoreSweep_h
#define limpid_viewpoint_ScoreSweep_h

#include "sweep/Sweep.h"
#include "viewpoint/ViewFields.h"

#include <memory>
#include <vector>

namespace limpid
{
/// Sums up what families of rays see.
class ScoreSweep
{
public:
  virtual ~ScoreSweep() = default;

  /// May be called by several threads.
  virtual Visible Score(const std::vector<ViewFields::Part>& parts) const = 0;
};

std::unique_ptr<ScoreSweep> CpuScoreSweep();

/// For parts of these fields, which stay with the caller. Throws limpid::Error if there is no CUDA.
std::unique_ptr<ScoreSweep> CudaScoreSweep(const ViewFields& fields);
}

#endif
