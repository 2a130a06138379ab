// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ScoreSweep_h
#define limpid_viewpoint_ScoreSweep_h

#include "backend/CompiledDevice.h"
#include "sweep/SumRays.h"
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

  /// May be called by several threads. The parts are used up.
  virtual Visible Score(std::vector<ViewFields::Part>&& parts) const = 0;
};

/// For parts of these fields, which stay with the caller.
template <class AnyDevice>
std::unique_ptr<ScoreSweep> MakeScoreSweep(
  std::shared_ptr<AnyDevice> device, const ViewFields& fields);
}

#endif
