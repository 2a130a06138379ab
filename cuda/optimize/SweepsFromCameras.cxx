// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Backend.h"
#include "optimize/SolverBackend.h"

#include <algorithm>

namespace limpid
{
namespace
{
constexpr Index valuesPerTask = 65536;

/// The rays of several cameras.
class SweepsOfSeveral : public SourceSweeps
{
public:
  SweepsOfSeveral(std::vector<std::unique_ptr<SourceSweeps>> cameras, std::size_t nodes)
    : Cameras(std::move(cameras))
    , Nodes(nodes)
  {
  }

  Score ScoreOf(const ExtinctionInPlace& extinction) override
  {
    std::vector<Score> scores;
    for (const auto& camera : this->Cameras)
    {
      scores.push_back(camera->ScoreOf(extinction));
    }
    return MeanOf(scores);
  }

  Ceiling CeilingOf(const float* least, const MostExtinction<float>& most) override
  {
    std::vector<Ceiling> ceilings;
    for (const auto& camera : this->Cameras)
    {
      ceilings.push_back(camera->CeilingOf(least, most));
    }
    return MeanOf(ceilings);
  }

  void SweepPolicyOnce(double weight, std::vector<float>& next) override
  {
    const std::vector<float> untouched = next;
    std::vector<float> found;
    for (std::size_t i = 0; i < this->Cameras.size(); ++i)
    {
      found = untouched;
      this->Cameras[i]->SweepPolicyOnce(weight, found);
      ParallelFor(Index(this->Nodes), valuesPerTask,
        [&](Index node)
        {
          float& least = next[std::size_t(node)];
          const float one = found[std::size_t(node)];
          least = i == 0 ? one : std::min(least, one);
        });
    }
  }

private:
  std::vector<std::unique_ptr<SourceSweeps>> Cameras;
  std::size_t Nodes;
};
}

std::unique_ptr<SourceSweeps> SolverBackend::SweepsFromCameras(const Problem& problem)
{
  std::vector<std::unique_ptr<SourceSweeps>> cameras;
  for (const TermSource& source : problem.sources)
  {
    if (source.kind == SourceKind::Camera)
    {
      cameras.push_back(this->SweepsFrom(problem, source.rays));
    }
  }
  if (cameras.size() == 1)
  {
    return std::move(cameras.front());
  }
  return std::make_unique<SweepsOfSeveral>(
    std::move(cameras), static_cast<std::size_t>(problem.grid.NodeCount()));
}
}
