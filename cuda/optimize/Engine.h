// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Engine_h
#define limpid_optimize_Engine_h

#include "energy/VisibilityTerm.h"
#include "optimize/Problem.h"

#include <memory>
#include <string>
#include <vector>

namespace limpid
{
/// What an eye of a problem sees, swept wherever.
class EyeSweeps
{
public:
  virtual ~EyeSweeps() = default;

  /// Of an extinction, grid.NodeCount() values [1/length].
  virtual Visible Score(const float* extinction) = 0;

  /// The first policy sweep, which knows of no transmittance and of this eye alone, with the weight
  /// of its term. Writes `found`, grid.NodeCount() values [1/length], where anything may change.
  virtual void Pass(double weight, std::vector<float>& found) = 0;
};

/// What runs the iterations: the processor or a GPU. Problems stay with the caller.
class Engine
{
public:
  virtual ~Engine() = default;

  /// A method for a problem from a first iterate [1/length]; empty: from the base extinction.
  /// `warm` tells that it is near the optimum.
  virtual std::unique_ptr<Minimizer> MakeMinimizer(
    const Problem& problem, std::vector<float>&& start, bool warm) = 0;

  virtual std::unique_ptr<EyeSweeps> Look(const Problem& problem, const RaySource& eye) = 0;

  /// FillTransmittance through an extinction of the problem.
  virtual void Transmittance(const Problem& problem, const RaySource& eye, double rayDensity,
    const float* extinction, float* transmittance) = 0;
};

/// Makes an empty first iterate the base extinction.
void StartFromBase(const Problem& problem, std::vector<float>& start);

std::shared_ptr<Engine> CpuEngine();

/// Throws limpid::Error if there is none.
std::shared_ptr<Engine> CudaEngine();

/// The engine that a user's wish comes to.
class EngineChoice
{
public:
  /// Throws limpid::Error if CUDA was asked for and cannot be had for such a grid. What computes on
  /// the GPU stays there: its memory is not free, but it is ours.
  void Choose(const Settings& settings, const Grid& grid);

  Engine& operator*() const { return *this->Chosen; }
  Engine* operator->() const { return this->Chosen.get(); }

  /// For the user, one line.
  const std::string& Name() const { return this->Line; }

private:
  std::shared_ptr<Engine> Chosen;
  std::string Line;
  bool OnGpu = false;
};

/// Bytes that an optimisation on the GPU needs, about.
std::size_t CudaBytes(const Grid& grid, const Settings& settings);
}

#endif
