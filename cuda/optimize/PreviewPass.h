// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PreviewPass_h
#define limpid_optimize_PreviewPass_h

#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"

#include <memory>
#include <optional>
#include <vector>

namespace limpid
{
/**
 * The first policy pass on one grid. It assumes transmittance 1 and ignores the light when
 * computing the extinction for the camera, which gives the most visibility for one sweep
 * (Documentation/Method.md). For a method without iterations it is the only pass.
 */
class PreviewPass
{
public:
  explicit PreviewPass(std::shared_ptr<PreparedScene> scene)
    : Scene(std::move(scene))
  {
  }

  /// `previous`: see Solver.
  void Make(const Camera& camera, const Light& light, const Settings& settings,
    const CarriedChange& previous = {});

  /// Frees the extinctions of previous passes.
  void Forget();

  /// One line for the user: what computed the last pass.
  const std::string& BackendName() const { return this->Backend.Name(); }

  PreparedScene& Prepared() const { return *this->Scene; }
  const Grid& Nodes() const { return this->Scene->Nodes(); }
  const float* Base() const { return this->Scene->Arrays().baseExtinction; }

  /// The extinction of the last pass, Nodes().NodeCount() values [1/length].
  const float* Extinction() const { return this->DataOf(this->ForCamera); }

  /// The extinction for the light if it is separate (HasLightExtinction), else that for the
  /// camera.
  const float* LightExtinction() const
  {
    return HasLightExtinction(this->Given.settings) ? this->DataOf(this->ForLight)
                                                    : this->Extinction();
  }

  /// Scores of the base and of the found extinction; the first call of each costs a sweep.
  Score BaseScore();
  Score BestScore();

private:
  const float* DataOf(const std::vector<float>& found) const
  {
    return found.empty() ? this->Base() : found.data();
  }

  template <class Work>
  void OnBackend(const Work& work);

  void MakeByPolicy(const Settings& settings);
  void MakeByMethod();
  SourceSweeps& CameraSweeps();
  Score ScoreOf(const float* extinction);

  std::shared_ptr<PreparedScene> Scene;
  ChosenBackend Backend;
  Problem Given;                            ///< the problem of the last pass
  std::unique_ptr<SourceSweeps> FromCamera; ///< created on first use
  Problem Judged;                           ///< the problem with the importance of scores
  std::unique_ptr<SourceSweeps> ForScores;  ///< created if scores use another importance
  std::vector<float> ForCamera;             ///< empty if it is the base extinction
  std::vector<float> ForLight;
  std::vector<PullWithReferences> Pulls; ///< beside the regularisation
  std::optional<Score> Before;
  std::optional<Score> After;
};
}

#endif
