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

/// Creates the parts of the core that compute, for the processor or a GPU. The steps of the
/// computation use it and know neither.
class ComputeBackend
{
public:
  virtual ~ComputeBackend() = default;

  virtual std::unique_ptr<SolverBackend> MakeSolverBackend() const = 0;

  virtual std::unique_ptr<RenderBackend> MakeRenderBackend() const = 0;

  /// For parts of these fields, which must outlive the result.
  virtual std::unique_ptr<ScoreSweep> MakeScoreSweep(const ViewFields& fields) const = 0;
};

/// The backend of the processor.
const ComputeBackend& ProcessorBackend();

/// The backend of the GPU. Throws limpid::Error if there is none.
const ComputeBackend& CudaBackend();

/// Returns one of both backends.
inline const ComputeBackend& BackendOf(bool cuda)
{
  return cuda ? CudaBackend() : ProcessorBackend();
}
}

#endif
