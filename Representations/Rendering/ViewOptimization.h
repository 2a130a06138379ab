// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The optimisation for one volume in one renderer, over its frames.

#ifndef limpid_ViewOptimization_h
#define limpid_ViewOptimization_h

#include "Frame.h"
#include "VolumeData.h"

#include "optimize/Progressive.h"
#include "render/Renderer.h"

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
  /// What it finds is shown by `pictures`.
  explicit ViewOptimization(Renderer& pictures)
    : Pictures(pictures)
  {
  }

  /**
   * Optimises for a frame for as long as it may, brings what was found into the pictures, at once
   * or bit by bit, and sets scores and progress in `result`. The camera is in data coordinates.
   * `opaque`: what of the volume it does not see, whatever the extinction; none: it sees all.
   * `isAborted` tells whether the user has had enough. Throws when the optimisation is impossible,
   * and Interrupted, which changes nothing, when it is not to begin.
   */
  void Advance(const FrameSettings& frame, const VolumeData& data, const Camera& camera,
    const std::optional<OpaqueGeometry>& opaque, const FrameClock& clock,
    const std::function<bool()>& isAborted, FrameResult& result);

  /// Shows the extinction of the transfer functions. What has been found stays, and is shown again
  /// by the next frame that shows it, at once.
  void ShowBase(const FrameSettings& frame, const VolumeData& data);

  /// Grows with every change of what was found.
  std::uint64_t Version() const { return this->Changes; }

  /// Forgets what has been found, and shows the extinction of the transfer functions.
  void Stop();

  /// Forgets also for which view that was.
  void Reset();

  /// Gives the memory back; for pictures that are new.
  void Release();

  /// The grid of what is shown; null: the extinction of the transfer functions is shown.
  const Grid* ShownGrid() const;

  /// Whether ranks show an extinction of their pieces, on which shadows cannot be coarser.
  bool ShowsPiece(const FrameSettings& frame) const;

private:
  bool HasShownFound() const { return !this->ShowsBase || this->HidesFound; }
  void TakeScene(const FrameSettings& frame, const VolumeData& data);
  bool TakeView(const FrameSettings& frame, const Camera& camera);
  bool Refine(const std::function<bool()>& isAborted);
  bool EasesFromCarried(const FrameSettings& frame);
  bool Work(
    const FrameSettings& frame, const FrameClock& clock, const std::function<bool()>& isAborted);
  void Show(const FrameSettings& frame, double seconds, bool changed, bool mayEase);
  Scores Measure(const FrameSettings& frame, const Camera& camera, bool changed);
  Scores InFront(const FrameSettings& frame, const Camera& camera,
    const std::optional<OpaqueGeometry>& opaque, const Scores& all, bool changed);
  Ceiling FindCeiling(const FrameSettings& frame, const Camera& camera,
    const std::optional<OpaqueGeometry>& opaque, const Score& found);

  Renderer& Pictures;
  std::unique_ptr<Progressive> Optimizer;
  vtkSmartPointer<vtkFloatArray> Base; ///< that it works with
  std::uint64_t SceneVersion = 0;
  std::uint64_t SceneTimeVersion = 0; ///< of the data in it
  std::uint64_t DataVersion = 0;      ///< of the data that the view below is for
  bool HasView = false;               ///< whether camera and light below were set
  bool IsOnceView = false;            ///< whether they are those of a first still frame
  bool IsBaseView = false;            ///< whether nothing was to be found for them
  Settings ViewSettings;              ///< with which they were taken
  std::vector<Camera> ViewCameras;    ///< that the optimiser works for, in data coordinates
  Light ViewLight;
  std::optional<Scores> Elsewhere; ///< as the camera below sees what is kept for those above
  Camera ElsewhereCamera;

  /// What was last seen in front of opaque geometry; fractions are of what is there.
  struct KnownInFront
  {
    Camera camera;
    OpaqueGeometry opaque;
    Scores scores;
  };
  std::optional<KnownInFront> Front;

  /// What the last camera that rested could see at most; fractions likewise.
  struct KnownCeiling
  {
    Camera camera;
    std::optional<OpaqueGeometry> opaque;
    Light light;
    Settings settings;
    Ceiling value;
  };
  std::optional<KnownCeiling> Most;
  bool ShowsBase = true;
  bool HidesFound = false;   ///< whether that stands in place of something that was shown before
  std::uint64_t Changes = 1; ///< of what was found
  std::uint64_t CasterVersion = 0; ///< of what casts shadows with the base; 0: the base does
  double Remaining = 0;            ///< share of the last change that has not eased in yet
};
}

#endif
