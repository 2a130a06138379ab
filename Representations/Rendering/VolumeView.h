// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What belongs to one volume in one renderer: its optimisation, its shadows, its picture.

#ifndef limpid_VolumeView_h
#define limpid_VolumeView_h

#include "FrameBudget.h"
#include "PictureQuad.h"
#include "SceneLight.h"
#include "ViewGeometry.h"
#include "VolumeData.h"

#include "optimize/Levels.h"
#include "optimize/PassTime.h"
#include "optimize/Progressive.h"
#include "render/Renderer.h"

#include "vtkWeakPointer.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkCallbackCommand;
class vtkObject;

namespace limpid
{
/// What a frame is to be like.
struct FrameSettings
{
  bool optimize = true; ///< off: the extinction of the transfer functions
  bool measure = true;  ///< off: no score
  bool once = false;    ///< for the camera of the first still frame only
  bool paused = false;  ///< leave the extinction as it is
  Settings solver;
  Lighting lighting; ///< but for the light itself, its colour and whether it is on
  bool lit = true;
  bool hasOwnLight = false;
  Light ownLight; ///< in world coordinates
  double sampleDistance = 1;
  bool jitter = false;
  double frameTime = 0.1; ///< of a moving frame [s]
  double easeTime = 0.3;  ///< time constant of changes while moving [s]
  bool adaptive = true;   ///< off: moving frames are like still ones
  bool stepwise = false;  ///< still frames take one step of the optimisation only
};

/// What a frame showed.
struct FrameResult
{
  Score score;
  Score baseScore;
  bool converged = true;
  int iterations = 0;
  std::string light;
  std::string backend;
};

class VolumeView
{
public:
  /// `whenHidden` is called after the volume was made invisible and the memory was given back.
  VolumeView(vtkRenderer* renderer, vtkVolume* volume, std::function<void()> whenHidden);
  ~VolumeView();
  VolumeView(const VolumeView&) = delete;
  VolumeView& operator=(const VolumeView&) = delete;

  bool IsOf(vtkRenderer* renderer, vtkVolume* volume) const;
  bool IsOrphaned() const; ///< renderer or volume are gone
  bool IsHidden() const;
  bool IsIn(vtkWindow* window) const;

  /// Draws the volume and returns what was shown. What went wrong but left something to be drawn
  /// is added to the errors or warnings. Throws when nothing can be drawn.
  FrameResult Draw(const FrameSettings& frame, const VolumeData& data,
    std::vector<std::string>& errors, std::vector<std::string>& warnings);

  /// Draws the last picture's visible pixels in one colour, for a selection.
  void DrawMask(const float color[3]);

  void Reset();   ///< forgets what has been optimised
  void Release(); ///< gives back what can be made again
  void ReleaseGraphicsResources(vtkWindow* window);

  /// Where the volume is in the present frame of the renderer. Ahead: drawn before its turn, so
  /// that one in front of it could be drawn.
  enum class Turn
  {
    NotYet,
    Ahead,
    Over
  };
  Turn InFrame = Turn::NotYet;

private:
  using Clock = std::chrono::steady_clock;

  static void OnEvent(vtkObject* caller, unsigned long event, void* self, void* data);
  bool IsStill(const FrameSettings& frame) const;
  void ChoosePictures(const FrameSettings& frame, const Grid& grid);
  void UpdateRenderer(const VolumeData& data);
  ChosenLight ChooseLight(const FrameSettings& frame) const;
  void SetLight(const FrameSettings& frame, const ChosenLight& light);
  void MakeShadows(const FrameSettings& frame, const Grid& grid, bool fine);
  void Optimize(const FrameSettings& frame, const VolumeData& data, const Camera& camera,
    const ChosenLight& light, FrameResult& result);
  bool TakeView(const FrameSettings& frame, const Camera& camera, const ChosenLight& light);
  bool Advance(const FrameSettings& frame);
  void Show(const FrameSettings& frame, bool changed);
  Scores Measure(const FrameSettings& frame, const Camera& camera, bool changed);
  void ShowBase();
  double PixelSize(const FrameSettings& frame, const ViewGeometry& geometry);
  void MakePicture(const FrameSettings& frame, const ViewGeometry& geometry, double pixelSize);
  double SecondsInFrame() const;

  vtkWeakPointer<vtkRenderer> Target;
  vtkWeakPointer<vtkVolume> Volume;
  std::function<void()> WhenHidden;
  vtkNew<vtkCallbackCommand> Observer;

  Renderer Caster;
  std::optional<BackendKind> PicturesFor; ///< for which wish it was chosen what makes pictures
  std::uint64_t ScalarsVersion = 0;
  std::uint64_t FunctionsVersion = 0;

  std::unique_ptr<Progressive> Optimizer;
  std::uint64_t SceneVersion = 0;
  std::uint64_t DataVersion = 0; ///< of the data that the view below is for
  bool HasView = false;          ///< whether camera and light below were set
  bool IsOnceView = false;       ///< whether they are those of a first still frame
  bool IsBaseView = false;       ///< whether nothing was to be found for them
  Settings ViewSettings;         ///< with which they were taken
  Camera ViewCamera;             ///< that the optimiser works for, in data coordinates
  Light ViewLight;
  std::optional<Scores> Elsewhere; ///< as the camera below sees what is kept for the one above
  Camera ElsewhereCamera;
  bool ShowsBase = true;
  double Remaining = 0; ///< share of the last change that has not eased in yet
  FrameResult LastResult;

  FrameBudget Budget;
  PassTime ShadowTime;
  std::size_t ShadowLevel = 0; ///< how coarse the shadows of the last moving frame were
  Index ShadowNodes = 0;       ///< of their grid
  Clock::time_point FrameStart;
  double SecondsSinceLastFrame = 0;
  bool GoesOn = false; ///< whether the last frame was one of several on the way to the still one

  Picture Image;
  PictureFrame Frame;
  double Depth = 0.5; ///< of the picture in the depth buffer
  PictureQuad Quad;
};
}

#endif
