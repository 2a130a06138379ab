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
/// The rays of one source through the fields of a problem.
class SourceSweeps
{
public:
  virtual ~SourceSweeps() = default;

  /// What the source sees of an extinction, grid.NodeCount() values [1/length], by the measure of
  /// the problem's method. The first call costs a sweep more, of the base extinction, unless it is
  /// that.
  virtual Score ScoreOf(const float* extinction) = 0;

  /// What the source could see at most of any extinction from a lower bound on, grid.NodeCount()
  /// values [1/length]; null: 0.
  virtual Ceiling CeilingOf(const float* least, const MostExtinction<float>& most) = 0;

  /// The first policy sweep, which knows of no transmittance and of this source alone, with the
  /// weight of its term. Writes `next`, grid.NodeCount() values [1/length], where anything may
  /// change.
  virtual void SweepPolicyOnce(double weight, std::vector<float>& next) = 0;
};

/// What runs the iterations of a solver: the processor or a GPU. Problems stay with the caller.
class SolverBackend
{
public:
  virtual ~SolverBackend() = default;

  /// A method for a problem from a first iterate, of this rank's piece where ranks share the scene.
  /// `warm` tells that it is near the optimum.
  virtual std::unique_ptr<Minimizer> MakeMinimizer(
    const Problem& problem, StartingExtinction&& start, bool warm) = 0;

  virtual std::unique_ptr<SourceSweeps> SweepsFrom(
    const Problem& problem, const RaySource& source) = 0;

  /// Those of all cameras: the mean of what they see; of what their policy sweeps find the least,
  /// so that nothing that is cleared for one of them is in its way (the mean shows less than the
  /// base extinction).
  std::unique_ptr<SourceSweeps> SweepsFromCameras(const Problem& problem);

  /// The extinction that a method without iterations makes, grid.NodeCount() values [1/length];
  /// `extinction`: the base extinction at first.
  virtual void FindByMethod(const Problem& problem, std::vector<float>& extinction) = 0;

  /// Transmittance from a source through an extinction of the problem, see TransmittanceSweep,
  /// and in thick media RefineTransmittance.
  virtual void FindTransmittance(const Problem& problem, const RaySource& source, double rayDensity,
    const float* extinction, float* transmittance) = 0;
};

template <class AnyDevice>
std::unique_ptr<SolverBackend> MakeSolverBackend(std::shared_ptr<AnyDevice> device);

/// The backend that a user's wish comes to.
class ChosenBackend
{
public:
  /// Throws limpid::Error if CUDA was asked for and cannot be had for such a grid. What computes on
  /// the GPU stays there: its memory is not free, but it is ours.
  void Choose(const Settings& settings, const Grid& grid);

  SolverBackend* operator->() const { return this->Solvers.get(); }

  /// Does `work` by the backend. Where the GPU fails in it and nobody insists on CUDA, the
  /// processor takes its place for good: `restore()` makes what was on the GPU anew, and the work
  /// is done again.
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

  /// For the user, one line.
  const std::string& Name() const { return this->Line; }

private:
  /// Whether the processor may go on, and does.
  bool GiveUpGpu(const std::string& reason);

  std::shared_ptr<SolverBackend> Solvers;
  std::string Line;
  BackendKind Wish = BackendKind::Auto;
  bool OnGpu = false;
  bool GpuFailed = false;
};
}

#endif
