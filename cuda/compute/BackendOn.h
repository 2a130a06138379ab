// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_compute_BackendOn_h
#define limpid_compute_BackendOn_h

#include "backend/ComputeBackend.h"
#include "optimize/SolverBackend.h"
#include "render/RenderPasses.h"
#include "viewpoint/ScoreSweep.h"

#include <memory>
#include <utility>

namespace limpid
{
/// The parts of the core that compute, created for one device.
template <class AnyDevice>
class BackendOn : public ComputeBackend
{
public:
  explicit BackendOn(std::shared_ptr<AnyDevice> device)
    : Device(std::move(device))
  {
  }

  std::unique_ptr<SolverBackend> MakeSolverBackend() const override
  {
    return limpid::MakeSolverBackend(this->Device);
  }

  std::unique_ptr<ScoreSweep> MakeScoreSweep(const ViewFields& fields) const override
  {
    return limpid::MakeScoreSweep(this->Device, fields);
  }

  std::unique_ptr<RenderBackend> MakeRenderBackend() const override
  {
    return std::make_unique<RenderPasses<AnyDevice>>(this->Device);
  }

private:
  std::shared_ptr<AnyDevice> Device;
};
}

#endif
