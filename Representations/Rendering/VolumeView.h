// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What belongs to one volume in one renderer: its optimisation, its shadows, its picture.

#ifndef limpid_VolumeView_h
#define limpid_VolumeView_h

#include "Frame.h"
#include "FrameBudget.h"
#include "Memory.h"
#include "PictureQuad.h"
#include "ViewGeometry.h"
#include "ViewOptimization.h"
#include "VolumeData.h"

#include "optimize/PassTime.h"
#include "render/Renderer.h"

#include "vtkWeakPointer.h"

#include <cstdint>
#include <functional>
#include <optional>

class vtkCallbackCommand;
class vtkObject;

namespace limpid
{
/// With optimisation and light, and either solver; measured.
inline const MemoryNeed drawingNeed{ 56, fewerPoints };

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
  /// is added to the messages. Throws when nothing can be drawn.
  FrameResult Draw(const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);

  /// Draws the last picture's visible pixels in one colour, for a selection.
  void DrawMask(const float color[3]);

  /// Forgets what has been optimised, or gives back what can be made again; while the volume is
  /// drawn, for instance when an observer asks for it, as soon as that is over.
  void Reset();
  void Release();
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
  FrameResult DrawNow(const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  void EndDrawing();
  void ReleaseNow();
  static void OnEvent(vtkObject* caller, unsigned long event, void* self, void* data);
  void ChoosePictures(BackendKind wish, const Grid& grid);
  void UpdateRenderer(const FrameSettings& frame, const VolumeData& data);
  void Optimize(const FrameSettings& frame, const VolumeData& data, const Camera& camera,
    const std::function<bool()>& isAborted, FrameMessages& messages, FrameResult& result);
  void MakeShadows(const FrameSettings& frame, const Grid& grid, bool fine);
  double PixelSize(const FrameSettings& frame, const ViewGeometry& geometry);
  void MakePicture(const FrameSettings& frame, const ViewGeometry& geometry,
    const std::vector<glm::dvec4>& planes, double pixelSize);

  vtkWeakPointer<vtkRenderer> Target;
  vtkWeakPointer<vtkVolume> Volume;
  std::function<void()> WhenHidden;
  vtkNew<vtkCallbackCommand> Observer;

  bool IsDrawing = false;
  bool ResetAfter = false;   ///< of the drawing that goes on
  bool ReleaseAfter = false; ///< likewise

  Renderer Caster;
  std::optional<BackendKind> PicturesFor; ///< for which wish it was chosen what makes pictures
  std::uint64_t ScalarsVersion = 0;
  std::uint64_t FunctionsVersion = 0;

  ViewOptimization Optimization{ this->Caster };
  FrameResult LastResult;

  FrameBudget Budget;
  PassTime ShadowTime;
  std::size_t ShadowLevel = 0; ///< how coarse the shadows of the last moving frame were
  Index ShadowNodes = 0;       ///< of their grid
  FrameClock Clock;
  bool GoesOn = false; ///< whether the last frame was one of several on the way to the still one

  Picture Image;
  PictureFrame Frame;
  double Depth = 0.5; ///< of the picture in the depth buffer
  PictureQuad Quad;
};
}

#endif
