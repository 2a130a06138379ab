// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_ComputeBackend_h
#define limpid_backend_ComputeBackend_h

#include <memory>

namespace limpid
{
class RenderBackend;
class ScoreSweep;
class SolverBackend;
class ViewFields;

/// Makes the parts of the core that compute, for the processor or for a GPU. The steps of the
/// computation ask here, and know neither.
class ComputeBackend
{
public:
  virtual ~ComputeBackend() = default;

  virtual std::unique_ptr<SolverBackend> MakeSolverBackend() const = 0;

  virtual std::unique_ptr<RenderBackend> MakeRenderBackend() const = 0;

  /// For parts of these fields, which stay with the caller.
  virtual std::unique_ptr<ScoreSweep> MakeScoreSweep(const ViewFields& fields) const = 0;
};

/// The processor.
const ComputeBackend& ProcessorBackend();

/// The GPU. Throws limpid::Error if there is none.
const ComputeBackend& CudaBackend();

/// The one or the other.
inline const ComputeBackend& BackendOf(bool cuda)
{
  return cuda ? CudaBackend() : ProcessorBackend();
}
}

#endif
