// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The implementation of vtkViewpointSearch between a request and its end; it is the interface to
// the core.

#ifndef vtkViewpointSearchInternals_h
#define vtkViewpointSearchInternals_h

#include "vtkViewpointSearch.h"
#include "vtkVisibilityAlgorithmScene.h"

#include "distributed/Communicator.h"

#include <memory>
#include <vector>

namespace limpid
{
struct AllowedViews;
class Communicator;
struct FoundViews;
struct Orbit;
class PreparedScene;
struct ScoredView;
struct SearchSettings;
}

struct vtkViewpointSearch::Internals
{
  explicit Internals(vtkViewpointSearch* self)
    : Self(self)
    , Reader(self)
  {
  }

  /// Fills the S-sphere, the viewpoints and the paths. `isLaterPiece`: the outputs stay empty. If
  /// ranks share the samples, this rank scores some of them for the first piece; if they share the
  /// image, all ranks score together.
  void Search(vtkInformationVector** inputVector, bool isLaterPiece, vtkPolyData* const outputs[3]);
  void SearchAny(
    vtkInformationVector** inputVector, bool isLaterPiece, vtkPolyData* const outputs[3]);

  void RequirePossibleSettings() const;
  void WarnOfSceneWithoutScore(const limpid::PreparedScene& scene) const;
  limpid::Vec3 FocalPoint(const limpid::Grid& grid) const;
  void RequireAllowedViews() const;
  limpid::Vec3 UpAxis() const;
  limpid::AllowedViews AllowedViews() const;
  limpid::Orbit MakeOrbit(const limpid::Grid& grid) const;
  limpid::Settings MakeSettings() const;
  limpid::SearchSettings MakeSearchSettings(double spacing) const;
  void SearchOneField(limpid::PreparedScene& scene, limpid::FoundViews& found) const;
  void SearchOptimizedFields(
    const std::shared_ptr<limpid::PreparedScene>& scene, limpid::FoundViews& found) const;
  template <class Function>
  auto Interruptibly(const Function& function) const;
  template <class Score>
  std::vector<limpid::ScoredView> ScoreTogether(
    const std::vector<limpid::Vec3>& directions, const Score& score) const;
  template <class Score, class Find>
  void ScoreAndFind(const Score& score, const Find& find, limpid::FoundViews& found) const;
  limpid::ImageScene Read(vtkInformationVector** inputVector) const;
  bool IsTrueOnAnyRank(bool here) const;
  static bool HasWholeImage(vtkInformationVector** inputVector);
  bool IsLarge(vtkInformationVector** inputVector) const;

  static constexpr double BytesPerPoint = 48; // measured by Testing/Benchmarks/filter_memory.py

  vtkViewpointSearch* Self;
  SceneReader Reader;
  std::shared_ptr<const limpid::Communicator> Ranks = limpid::ThisProcess(); // they share samples
  bool SharesImage = false;          // they also share the image: all ranks score all samples
  std::vector<limpid::Vec3> Avoided; // directions, of any length
};

#endif
