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
 * The first policy pass on one grid, which knows of no transmittance and leaves the light out of
 * the camera's extinction: the most visibility for one sweep (Documentation/Method.md). Of a method
 * that does not iterate: its only pass.
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

  /// Frees the extinctions that passes have made.
  void Forget();

  /// What has computed the last pass, one line for the user.
  const std::string& BackendName() const { return this->Backend.Name(); }

  PreparedScene& Prepared() const { return *this->Scene; }
  const Grid& Nodes() const { return this->Scene->Nodes(); }
  const float* Base() const { return this->Scene->Arrays().baseExtinction; }

  /// What the last pass has found, Nodes().NodeCount() values [1/length].
  const float* Extinction() const { return this->DataOf(this->ForCamera); }

  /// For the light, where there is another one (HasLightExtinction); else that for the camera.
  const float* LightExtinction() const
  {
    return HasLightExtinction(this->Given.settings) ? this->DataOf(this->ForLight)
                                                    : this->Extinction();
  }

  /// Of the base and of the found extinction; each costs a sweep when it is asked for first.
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
  Problem Given;                            ///< of the last pass
  std::unique_ptr<SourceSweeps> FromCamera; ///< made when first needed
  Problem Judged;                           ///< the same with the importance of scores
  std::unique_ptr<SourceSweeps> ForScores;  ///< made when that is another importance
  std::vector<float> ForCamera;             ///< empty: the base extinction
  std::vector<float> ForLight;
  CarriedExtinction Previous; ///< what these stayed near; nothing without coherence
  std::optional<Score> Before;
  std::optional<Score> After;
};
}

#endif
