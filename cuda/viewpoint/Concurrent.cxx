// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/Concurrent.h"

#include "backend/Backend.h"
#include "math/PercentText.h"
#include "optimize/PreparedScene.h"
#include "viewpoint/HighestView.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limpid
{
namespace
{
/// Maximum number of cameras after the first one for which the extinction is optimised.
constexpr int mostMoves = 6;

/// Smallest move along the slope of the score [radians].
constexpr double smallestMove = 0.02;

class ConcurrentOptimizer
{
public:
  ConcurrentOptimizer(const SceneFields& scene, const Camera& camera, const Light& light,
    const Settings& settings, const Progress& progress)
    : Fields(scene)
    , Scene(std::make_shared<PreparedScene>(scene))
    , First(camera)
    , Lamp(light)
    , Options(settings)
    , Report(progress)
    , Sphere(OrbitOf(camera))
  {
    this->Best.camera = camera;
  }

  ConcurrentResult Run(Guide guide)
  {
    if (guide == Guide::Attainable && this->Sphere.distance > 0)
    {
      this->GoToCeiling();
      return std::move(this->Best);
    }
    std::unique_ptr<Solver> solver = this->SolveFor(this->First, 0);
    this->Best.startScore = solver->BestScore();
    this->Best.path = { this->First.position };
    const bool stopped = solver->Stopped();
    this->Best.solver = std::move(solver);
    if (!stopped && this->Sphere.distance > 0)
    {
      guide == Guide::Proxy ? this->FollowProxy() : this->FollowExtinction();
    }
    return std::move(this->Best);
  }

private:
  Vec3 Direction() const
  {
    return glm::normalize(this->Best.camera.position - this->Sphere.centre);
  }

  /// Returns the first camera, turned to another side of its focal point with the same up vector.
  Camera CameraAt(const Vec3& direction) const
  {
    Camera camera = this->First;
    camera.position = this->Sphere.centre + this->Sphere.distance * direction;
    if (glm::length(glm::cross(camera.viewUp, direction)) < 1e-6 * glm::length(camera.viewUp))
    {
      camera.viewUp = this->Sphere.At(direction).viewUp;
    }
    camera.corners.clear();
    return camera;
  }

  std::unique_ptr<Solver> SolveFor(const Camera& camera, int move)
  {
    auto solver = std::make_unique<Solver>(this->Scene, camera, this->Lamp, this->Options);
    solver->Run(
      [&](double share, const std::string& text)
      {
        const double done = (move + share) / (mostMoves + 1);
        return this->GoesOn(done, text);
      });
    return solver;
  }

  /// Reports progress until the answer is to stop.
  bool GoesOn(double share, const std::string& text)
  {
    this->IsStopped = this->IsStopped || (this->Report && !this->Report(share, text));
    return !this->IsStopped;
  }

  enum class Outcome
  {
    Taken,
    Rejected,
    Stopped
  };

  Outcome Try(const Vec3& direction, int move)
  {
    const Camera camera = this->CameraAt(direction);
    std::unique_ptr<Solver> solver = this->SolveFor(camera, move);
    if (solver->Stopped())
    {
      return Outcome::Stopped;
    }
    if (solver->BestScore().visibility <= this->Best.solver->BestScore().visibility)
    {
      return Outcome::Rejected;
    }
    this->Best.solver = std::move(solver);
    this->Best.camera = camera;
    this->Best.path.push_back(camera.position);
    return Outcome::Taken;
  }

  /// Moves to the highest ceiling found and optimises there. If the result does not exceed the
  /// ceiling of the first camera, it also optimises for that one.
  void GoToCeiling()
  {
    const NodeValues least = this->Scene->LeastExtinction(this->Options);
    ViewedFields viewed{ this->Fields.baseExtinction, this->Fields.importance };
    viewed.attainable = true;
    viewed.least = least.Data();
    const ViewScore score(
      this->Fields.grid, viewed, this->Options.rayDensity, this->Options.backend);
    const ScoredView start = ViewAt(score, this->Sphere, this->Direction());
    const ScoredView goal = this->HighestCeiling(score, start);
    const bool moves = IsBetter(goal, start);
    const Camera camera = moves ? this->CameraAt(goal.direction) : this->First;
    this->Best.path = { this->First.position };
    this->Take(camera, this->SolveFor(camera, mostMoves - 1));
    const double found = this->Best.solver->BestScore().fraction;
    if (!moves)
    {
      this->Best.startScore = this->Best.solver->BestScore();
    }
    else if (found < start.score.fraction && !this->Best.solver->Stopped())
    {
      std::unique_ptr<Solver> first = this->SolveFor(this->First, mostMoves);
      this->Best.startScore = first->BestScore();
      if (first->BestScore().fraction > found)
      {
        this->Take(this->First, std::move(first));
      }
    }
  }

  void Take(const Camera& camera, std::unique_ptr<Solver> solver)
  {
    this->Best.solver = std::move(solver);
    this->Best.camera = camera;
    if (this->Best.path.back() != camera.position)
    {
      this->Best.path.push_back(camera.position);
    }
  }

  /// Returns the view with the highest ceiling.
  ScoredView HighestCeiling(const ViewScore& score, const ScoredView& start)
  {
    constexpr double shareOfSearch = double(mostMoves - 1) / (mostMoves + 1);
    const HighestView highest = FindHighestView(score, this->Sphere, start,
      [this](double share) { return this->GoesOn(share * shareOfSearch, ""); });
    this->Best.views = highest.evaluations;
    this->Best.highestCeiling = std::max(highest.view.score.fraction, start.score.fraction);
    return highest.view;
  }

  /// Climbs to where most of the important structures would be seen if nothing occluded them. If
  /// the extinction optimised there is worse, it tries points before that.
  void FollowProxy()
  {
    const auto count = static_cast<std::size_t>(this->Fields.grid.NodeCount());
    const float majorant = static_cast<float>(this->Best.solver->Majorant());
    std::vector<float> proxy(count);
    for (std::size_t node = 0; node < count; ++node)
    {
      proxy[node] = majorant * this->Fields.importance[node];
    }
    const ViewScore score(
      this->Fields.grid, { proxy.data(), this->Fields.importance }, this->Options.rayDensity);
    const ScoredView start = ViewAt(score, this->Sphere, this->Direction());
    SearchSettings search;
    search.firstStep = firstMove;
    search.viewpoints = 1;
    const SearchResult climb = FindViewpoints(score, this->Sphere, { start }, search,
      [&](double share) { return this->GoesOn(share / (mostMoves + 1), ""); });
    const std::vector<ScoredView>& path =
      climb.paths.empty() ? std::vector<ScoredView>{} : climb.paths.front();
    int move = 1;
    std::size_t goal = path.size();
    Outcome outcome = Outcome::Rejected;
    while (outcome == Outcome::Rejected && goal > 1 && move <= mostMoves)
    {
      outcome = this->Try(path[goal - 1].direction, move++);
      goal = (goal + 1) / 2;
    }
  }

  /// Moves to where the current extinction shows more, alternating Eqs. (30) and (31).
  void FollowExtinction()
  {
    double length = firstMove;
    Vec3 slope = this->SlopeOfBest();
    for (int move = 1; move <= mostMoves && length >= smallestMove; ++move)
    {
      const double steepness = glm::length(slope);
      if (!(steepness > 0))
      {
        return;
      }
      const Vec3 next = std::cos(length) * this->Direction() + std::sin(length) * slope / steepness;
      const Outcome outcome = this->Try(glm::normalize(next), move);
      if (outcome == Outcome::Stopped)
      {
        return;
      }
      const bool taken = outcome == Outcome::Taken;
      length *= taken ? 1.5 : 0.4;
      slope = taken ? this->SlopeOfBest() : slope;
    }
  }

  Vec3 SlopeOfBest() const
  {
    const ViewScore score(this->Fields.grid,
      { this->Best.solver->Extinction().data(), this->Fields.importance },
      this->Options.rayDensity);
    return score.SlopeAt(this->Best.camera).slope;
  }

  const SceneFields& Fields;
  std::shared_ptr<PreparedScene> Scene;
  const Camera& First;
  const Light& Lamp;
  const Settings& Options;
  const Progress& Report;
  bool IsStopped = false;
  Orbit Sphere;
  ConcurrentResult Best;
};
}

std::string ConcurrentResult::Proof() const
{
  const double ceiling = this->solver->FindCeiling().fraction;
  if (!(this->highestCeiling > 0 && ceiling > 0))
  {
    return {};
  }
  const double found = this->solver->BestScore().fraction;
  return "The result reaches " + PercentText(found / ceiling) +
    " of the ceiling of its view, which is " +
    PercentText(std::min(ceiling / this->highestCeiling, 1.0)) + " of the highest ceiling of " +
    std::to_string(this->views) + " views.";
}

ConcurrentResult OptimizeConcurrently(const SceneFields& scene, const Camera& camera,
  const Light& light, const Settings& settings, Guide guide, const Progress& progress)
{
  return ConcurrentOptimizer(scene, camera, light, settings, progress).Run(guide);
}
}
