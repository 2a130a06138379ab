// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PictureBackend.h"

#include "backend/ComputeBackend.h"

#include <cstddef>

namespace limpid
{
std::unique_ptr<RenderBackend> PictureBackend::Choose(BackendKind wish, const Grid& grid)
{
  if (this->FailedFor != wish)
  {
    this->FailedFor.reset();
    this->Words.clear();
  }
  constexpr std::size_t bytesPerNode = 32 + 28; // of pictures and optimisation
  const Index nodes = grid.NodeCount();
  const GpuNeed need{ nodes, bytesPerNode * static_cast<std::size_t>(nodes) };
  this->OnGpu =
    !this->FailedFor && wish != BackendKind::Cpu && ChooseBackend(BackendKind::Auto, need).cuda;
  this->For = wish;
  return BackendOf(this->OnGpu).MakeRenderBackend();
}

bool PictureBackend::GiveUpGpu(const std::string& reason)
{
  if (!this->OnGpu || !this->For)
  {
    return false;
  }
  this->FailedFor = this->For;
  this->Words = reason + " Until Backend is changed, the CPU draws the volume.";
  this->OnGpu = false;
  return true;
}
}
