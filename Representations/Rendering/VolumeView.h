// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What belongs to one volume in one renderer: its optimisation, its shadows, its picture.

#ifndef limpid_VolumeView_h
#define limpid_VolumeView_h

#include "DepthPeeling.h"
#include "Frame.h"
#include "FrameBudget.h"
#include "KeptPictures.h"
#include "Memory.h"
#include "OpaqueDepth.h"
#include "PictureBackend.h"
#include "PictureQuad.h"
#include "SharpenedPicture.h"
#include "SlicedPicture.h"
#include "ViewGeometry.h"
#include "ViewOptimization.h"
#include "ViewShadows.h"
#include "VolumeData.h"

#include "render/Renderer.h"

#include "vtkWeakPointer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

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

  /// Draw in two steps: makes everything that the rays of the frame's pictures need, and draws
  /// one part of them, 0 or 1. Draws nothing where the first step threw or was aborted.
  FrameResult Prepare(const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  void DrawPart(const RayParts& parts, std::size_t part);

  /// Makes a part of the picture without optimisation beside the finished one that was shown last,
  /// so that it is shown at once where it is asked for. Takes about as long as a moving frame, but
  /// for shadows. Returns whether something is left to be done. Throws as Draw does.
  bool PrepareOriginal(const VolumeData& data);

  /// Draws the last frame's visible pixels in one colour, for a selection.
  void DrawMask(const float color[3]);

  /// Forgets what has been optimised, or gives back what can be made again; while the volume is
  /// drawn, for instance when an observer asks for it, as soon as that is over.
  void Reset();
  void Release();
  void ReleaseGraphicsResources(vtkWindow* window);

  /// Where the volume is in the present frame of the renderer. Ahead: drawn before its turn, so
  /// that one in front of it could be drawn, or along with another one.
  enum class Turn
  {
    NotYet,
    Ahead,
    Over
  };
  Turn InFrame = Turn::NotYet;

  /// If VTK peels the volume: how, and which volumes are drawn along with it, from back to front.
  DepthPeeling Peeling;
  std::vector<vtkWeakPointer<vtkVolume>> Peeled;

private:
  using Action = std::function<void()>;
  void WhileDrawing(const Action& action, const Action& again);
  void WhileDrawing(const Action& action) { this->WhileDrawing(action, action); }
  std::optional<ViewGeometry> BeginFrame(
    const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  void PrepareFrame(const FrameSettings& frame, const VolumeData& data,
    const ViewGeometry& geometry, FrameMessages& messages);
  void PrepareNow(const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  void DrawNow(const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  PictureSubject SubjectOf(const FrameSettings& frame, const VolumeData& data,
    const ViewGeometry& geometry, const OpaqueDepth& opaque) const;
  bool ShowKept(const FrameSettings& frame, const PictureSubject& subject,
    const OpaqueDepth& opaque, FrameMessages& messages);
  void Keep(PictureSubject subject, const FrameMessages& messages);
  bool MakeOriginal(const VolumeData& data);
  bool AdvanceOriginal(double seconds);
  bool MakePicture(const View& view);
  OpaqueDepth OpaqueOf(const FrameSettings& frame, const ViewGeometry& geometry) const;
  bool DrawWhole(const FrameSettings& frame, const OpaqueDepth& opaque);
  bool DrawInSlices(const FrameSettings& frame, const OpaqueDepth& opaque);
  void Show(const FrameSettings& frame, const OpaqueDepth& opaque);
  void ShowShared(const Communicator& ranks, const OpaqueDepth& opaque);
  bool DrawBetween(const OpaqueDepth& opaque, const std::vector<DepthRange>& ranges);
  void DrawPartNow(const RayParts& parts, std::size_t part);
  void EndDrawing();
  void ReleaseNow();
  static void OnEvent(vtkObject* caller, unsigned long event, void* self, void* data);
  void ChoosePictures(BackendKind wish, const Grid& grid);
  void UpdateRenderer(const FrameSettings& frame, const VolumeData& data);
  void UseImportance(const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  void Optimize(const FrameSettings& frame, const VolumeData& data, const ViewGeometry& geometry,
    const std::function<bool()>& isAborted, FrameMessages& messages, FrameResult& result);
  double PixelSize(const FrameSettings& frame, const ViewGeometry& geometry);
  static View RaysOf(const FrameSettings& frame, const ViewGeometry& geometry,
    const std::vector<glm::dvec4>& planes, const PictureFrame& picture);
  void PlacePicture(const FrameSettings& frame, const ViewGeometry& geometry,
    const std::vector<glm::dvec4>& planes, double pixelSize);
  std::function<bool()> AbortCheck() const;

  vtkWeakPointer<vtkRenderer> Target;
  vtkWeakPointer<vtkVolume> Volume;
  std::function<void()> WhenHidden;
  vtkNew<vtkCallbackCommand> Observer;

  bool IsDrawing = false;
  bool OnRanks = false;      ///< whether several processes draw the frame together
  bool ResetAfter = false;   ///< of the drawing that goes on
  bool ReleaseAfter = false; ///< likewise

  Renderer Caster;
  PictureBackend Backend;
  std::uint64_t ScalarsVersion = 0;
  std::uint64_t FunctionsVersion = 0;
  std::uint64_t ImportanceVersion = 0; ///< 0: pictures need none

  ViewOptimization Optimization{ this->Caster };
  ViewShadows Shadows{ this->Caster };
  FrameResult LastResult;
  std::function<void()> PrepareAgain; ///< for parts of the frame

  FrameBudget Budget;
  FrameClock Clock;
  bool GoesOn = false; ///< whether the last frame was one of several on the way to the still one

  std::optional<ViewGeometry> Geometry; ///< of the frame; none: there is nothing to be drawn
  std::optional<OpaqueDepth> Opaque;    ///< likewise
  PictureFrame Frame;
  View Rays;     ///< of the frame's pictures, but for where they begin and end
  Picture Image; ///< of the frame; of several parts, their alpha only
  Picture Part;
  SlicedPicture Fine;          ///< at rest, in full resolution
  SharpenedPicture Sharpening; ///< the way there, in frames that follow each other
  SlicedPicture Original;      ///< the finished one without optimisation, in the making
  KeptPictures Pictures;
  bool RestsOptimized = false; ///< whether the last frame showed a kept one with optimisation
  double CastSeconds = 0;      ///< what the pictures of the frame took
  PictureQuad Quad;
};
}

#endif
