// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The optimisation for one volume in one renderer, over several frames.

#ifndef limpid_ViewOptimization_h
#define limpid_ViewOptimization_h

#include "Frame.h"
#include "ViewTargets.h"
#include "VolumeData.h"

#include "optimize/Progressive.h"
#include "render/Renderer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace limpid
{
class ViewOptimization
{
public:
  /// `pictures`: shows the result.
  explicit ViewOptimization(Renderer& pictures)
    : Pictures(pictures)
  {
  }

  /**
   * Optimises for a frame as long as its time allows, passes the result to the pictures, at once or
   * gradually, and sets scores and progress in `result`. The camera is in data coordinates.
   * `opaque`: geometry that hides parts of the volume for any extinction; none: it hides nothing.
   * `isAborted`: whether the user has aborted. Throws if the optimisation is impossible. Throws
   * Interrupted, without any change, if it must not start.
   */
  void Advance(const FrameSettings& frame, const VolumeData& data, const Camera& camera,
    const std::optional<OpaqueGeometry>& opaque, const FrameClock& clock,
    const std::function<bool()>& isAborted, FrameResult& result);

  /// What is looked at: a camera in data coordinates, opaque geometry as for Advance, and whether
  /// through the result or through the extinction of the transfer functions.
  struct Look
  {
    Camera camera;
    std::optional<OpaqueGeometry> opaque;
    bool optimized = true;
  };

  /// Finds what is seen of each structure of the data. `isAborted`: see Advance. Throws Interrupted
  /// if aborted.
  void MeasureStructures(
    const Look& look, const VolumeData& data, const std::function<bool()>& isAborted);

  /// Returns what MeasureStructures has found, unless the result has changed; null: nothing.
  const std::vector<StructureShares>* SharesOfStructures(const Look& look) const;

  /// Returns the structures with the importances of the result; null: those given are.
  const Structures* TriedStructures() const { return this->Targets.Tried(); }

  /// Returns the row of the structure of the data that is seen along a ray between two points
  /// in data coordinates, see PickedStructure; 0: none, or unknown.
  StructureRow PickStructure(
    const Vec3& begin, const Vec3& end, bool optimized, const VolumeData& data) const;

  /// Shows the extinction of the transfer functions. The result is kept, and the next optimised
  /// frame shows it at once.
  void ShowBase(const FrameSettings& frame, const VolumeData& data);

  /// Shows the result again instead of the extinction of the transfer functions, so that the next
  /// change begins there.
  void ShowFoundAgain();

  /// Returns whether anything was optimised, and its memory is not released.
  bool IsThere() const { return this->Optimizer != nullptr; }

  /// Returns a number that grows with every change of the result.
  std::uint64_t Version() const { return this->Changes; }

  /// Discards the result, and shows the extinction of the transfer functions.
  void Stop();

  /// Discards the result and the view that it was for.
  void Reset();

  /// Frees memory; for pictures that are new.
  void Release();

  /// Returns the grid of the extinction that is shown; null: that of the transfer functions is
  /// shown.
  const Grid* ShownGrid() const;

  /// Returns whether ranks show the extinction of their pieces; shadows cannot be coarser than it.
  bool ShowsPiece(const FrameSettings& frame) const;

private:
  bool HasShownFound() const { return !this->ShowsBase || this->HidesFound; }
  void TakeScene(const FrameSettings& frame, const VolumeData& data);
  bool TakeView(const FrameSettings& frame, const Camera& camera);
  bool Refine(const std::function<bool()>& isAborted);
  bool EasesFromCarried(const FrameSettings& frame);
  bool IsComplete() const;
  bool TriesOtherImportances(const VolumeData& data, const std::optional<OpaqueGeometry>& opaque,
    const std::function<bool()>& isAborted);
  bool Work(const FrameSettings& frame, const VolumeData& data,
    const std::optional<OpaqueGeometry>& opaque, const FrameClock& clock,
    const std::function<bool()>& isAborted);
  void Show(const FrameSettings& frame, double seconds, bool changed, bool mayEase);
  void SetFound(double share);
  Scores Measure(const FrameSettings& frame, const Camera& camera, bool changed);
  Scores InFront(const FrameSettings& frame, const Camera& camera,
    const std::optional<OpaqueGeometry>& opaque, const Scores& all, bool changed);
  Ceiling FindCeiling(const FrameSettings& frame, const Camera& camera,
    const std::optional<OpaqueGeometry>& opaque, const Score& found);

  Renderer& Pictures;
  ViewTargets Targets; ///< has the importance of the optimiser's scene
  std::unique_ptr<Progressive> Optimizer;
  DrawnPart Part;                     ///< of its scene
  std::shared_ptr<const void> Fields; ///< owns what its scene has
  std::uint64_t SceneVersion = 0;
  std::uint64_t SceneTimeVersion = 0; ///< version of the time step of its data
  std::uint64_t DataVersion = 0;      ///< version of the data that the view below is for
  bool HasView = false;               ///< whether camera and light below are set
  bool IsOnceView = false;            ///< whether they are those of a first still frame
  bool IsBaseView = false;            ///< whether there was nothing to optimise for them
  Settings ViewSettings;              ///< settings of the view below
  std::vector<Camera> ViewCameras;    ///< cameras of the optimisation, in data coordinates
  Light ViewLight;
  std::optional<Scores> Elsewhere; ///< scores of the result for ViewCameras, seen by the camera
                                   ///< below
  Camera ElsewhereCamera;

  /// The last known scores in front of opaque geometry; fractions refer to the matter there.
  struct KnownInFront
  {
    Camera camera;
    OpaqueGeometry opaque;
    Scores scores;
  };
  std::optional<KnownInFront> Front;

  /// The last known upper bounds, for a still camera; fractions refer to the matter in front of
  /// opaque geometry.
  struct KnownCeiling
  {
    Camera camera;
    std::optional<OpaqueGeometry> opaque;
    Light light;
    Settings settings;
    Ceiling value;
  };
  std::optional<KnownCeiling> Most;

  /// The last known shares of structures.
  struct KnownShares
  {
    Look look;
    std::uint64_t version = 0; ///< of the result
    std::vector<StructureShares> shares;
  };
  std::array<std::optional<KnownShares>, 2> OfStructures; ///< without optimisation, and with it
  bool ShowsBase = true;
  bool HidesFound = false;         ///< whether the base extinction replaces a result that was shown
                                   ///< before
  std::uint64_t Changes = 1;       ///< version of the result
  std::uint64_t CasterVersion = 0; ///< version of the data that cast shadows with the base; 0: the
                                   ///< base does
  double Remaining = 0;            ///< share of the last change that has not eased in yet
};
}

#endif
