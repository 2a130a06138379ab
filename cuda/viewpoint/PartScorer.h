// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_PartScorer_h
#define limpid_viewpoint_PartScorer_h

#include "sweep/Sweep.h"
#include "viewpoint/ViewFields.h"

#include <memory>
#include <vector>

namespace limpid
{
/// Sums up what families of rays see.
class PartScorer
{
public:
  virtual ~PartScorer() = default;

  /// May be called by several threads.
  virtual Visible Score(const std::vector<ViewFields::Part>& parts) const = 0;
};

std::unique_ptr<PartScorer> CpuPartScorer();

/// For parts of these fields, which stay with the caller. Throws limpid::Error if there is no CUDA.
std::unique_ptr<PartScorer> CudaPartScorer(const ViewFields& fields);
}

#endif
