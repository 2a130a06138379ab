// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_SolverBackend_h
#define limpid_optimize_SolverBackend_h

#include "backend/CompiledDevice.h"
#include "energy/CeilingKernel.h"
#include "math/Require.h"
#include "optimize/Problem.h"
#include "sweep/SumRays.h"

#include <memory>
#include <string>
#include <vector>

namespace limpid
{
class PreparedScene;

/// The rays of one source through the fields of a problem.
class SourceSweeps
{
public:
  virtual ~SourceSweeps() = default;

  /// Returns the score of an extinction, grid.NodeCount() values, by the measure of the problem's
  /// method. The first call also sweeps the base extinction, unless that is `extinction`.
  virtual Score ScoreOf(const ExtinctionInPlace& extinction) = 0;

  /// Returns the ceiling of the source over all extinctions above a lower bound, grid.NodeCount()
  /// values [1/length]; null stands for 0.
  virtual Ceiling CeilingOf(const float* least, const MostExtinction<float>& most) = 0;

  /// Performs the first policy sweep, which assumes transmittance 1 and considers this source
  /// only. `weight`: weight of its term. Writes `next`, grid.NodeCount() values [1/length], where
  /// values may change.
  virtual void SweepPolicyOnce(double weight, std::vector<float>& next) = 0;
};

/// Runs the iterations of a solver on the processor or a GPU. Problems must outlive their use.
class SolverBackend
{
public:
  virtual ~SolverBackend() = default;

  /// Describes the backend for the user, given the name of what computes in this process.
  virtual std::string Describe(const std::string& here) const { return here; }

  /// Makes a method for a problem from a first iterate. `warm`: whether the iterate is near the
  /// optimum.
  virtual std::unique_ptr<Minimizer> MakeMinimizer(
    const Problem& problem, StartingExtinction&& start, bool warm) = 0;

  virtual std::unique_ptr<SourceSweeps> SweepsFrom(
    const Problem& problem, const RaySource& source) = 0;

  /// Makes the rays of all cameras. Scores are means over cameras. Of the extinctions from their
  /// policy sweeps the minimum is taken, so that nothing cleared for one camera obstructs it; the
  /// mean would show less than the base extinction.
  std::unique_ptr<SourceSweeps> SweepsFromCameras(const Problem& problem);

  /// Computes the extinction of a method without iterations, grid.NodeCount() values [1/length].
  /// `extinction` holds the base extinction at first.
  virtual void FindByMethod(const Problem& problem, std::vector<float>& extinction) = 0;

  /// Computes the transmittance from a source through an extinction of the problem, see
  /// TransmittanceSweep; in thick media also by RefineTransmittance.
  virtual void FindTransmittance(const Problem& problem, const RaySource& source, double rayDensity,
    const float* extinction, float* transmittance) = 0;
};

template <class AnyDevice>
std::unique_ptr<SolverBackend> MakeSolverBackend(std::shared_ptr<AnyDevice> device);

/// The backend chosen for a user's preference.
class ChosenBackend
{
public:
  /// For problems of a scene. Throws limpid::Error if CUDA was requested and is not available for
  /// its grid, or if settings are not supported in distributed runs. A backend already on the GPU
  /// stays there: its memory is occupied, but by this process.
  void Choose(const Settings& settings, const PreparedScene& scene);

  SolverBackend* operator->() const { return this->Solvers.get(); }

  /// Runs `work` on the backend. If the GPU fails and CUDA was not requested explicitly, the
  /// processor permanently replaces it: `restore()` recreates what was on the GPU, and `work` runs
  /// again.
  template <class Work, class Restore>
  decltype(auto) Do(const Work& work, const Restore& restore)
  {
    try
    {
      return work();
    }
    catch (const DeviceError& error)
    {
      if (!this->GiveUpGpu(error.what()))
      {
        throw;
      }
    }
    restore();
    return work();
  }

  /// Whether fields are in the memory of the shared device, see ExtinctionOnDevice.
  bool IsOnGpu() const { return this->OnGpu; }

  /// One line for the user.
  const std::string& Name() const { return this->Line; }

private:
  /// Replaces the GPU by the processor if allowed; returns whether it did.
  bool GiveUpGpu(const std::string& reason);

  std::shared_ptr<SolverBackend> Solvers;
  std::string Line;
  BackendKind Wish = BackendKind::Auto;
  bool OnGpu = false;
  bool GpuFailed = false;
};
}

#endif
