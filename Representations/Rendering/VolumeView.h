// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The state of one volume in one renderer: its optimisation, its shadows and its picture.

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
/// Memory for optimisation and lighting with either solver; measured.
inline const MemoryNeed drawingNeed{ 78, fewerPoints };

class VolumeView
{
public:
  /// `whenHidden`: called after the volume was made invisible and its memory was freed.
  /// `goesOn`: called regularly while a still frame that is not made in steps is drawn, with the
  /// share of its rays that have been cast; returns false to abort the frame.
  VolumeView(vtkRenderer* renderer, vtkVolume* volume, std::function<void()> whenHidden,
    std::function<bool(double share)> goesOn);
  ~VolumeView();
  VolumeView(const VolumeView&) = delete;
  VolumeView& operator=(const VolumeView&) = delete;

  bool IsOf(vtkRenderer* renderer, vtkVolume* volume) const;
  bool IsOrphaned() const; ///< whether renderer or volume were deleted
  bool IsHidden() const;
  bool IsIn(vtkWindow* window) const;

  /// Draws the volume and returns the results. Problems that still allow a picture are added to the
  /// messages. Throws if nothing can be drawn.
  FrameResult Draw(const FrameSettings& settings, const VolumeData& data, FrameMessages& messages);

  /// Draw in two steps: Prepare computes everything that the rays of the pictures need; DrawPart
  /// draws a segment of them, 0 or 1. It draws nothing if the first step threw or was aborted.
  FrameResult Prepare(
    const FrameSettings& settings, const VolumeData& data, FrameMessages& messages);
  void DrawPart(const RayParts& parts, std::size_t part);

  /// Computes a part of the picture without optimisation for the finished view that was shown last,
  /// so that it can be shown at once when requested. Takes about as long as a frame during
  /// interaction, plus shadows. Returns whether work is left. Throws like Draw.
  bool PrepareOriginal(const VolumeData& data);

  /// Finds what the camera of the last frame sees of each structure of the data, unless that is
  /// known. Takes about as long as ten scores. Collective. Throws if there is no memory.
  void MeasureStructures(const VolumeData& data);

  /// Returns what MeasureStructures has found for the last frame, in the order of the structures;
  /// null: nothing.
  const std::vector<StructureShares>* SharesOfStructures() const;

  /// Returns the structures with the importances of the last frame; null: those given are.
  const Structures* TriedStructures() const;

  /// Returns the row of the structure that the last frame shows most at a place of the renderer, in
  /// [0, 1] from its lower left corner; 0: none, or unknown. Not in distributed runs.
  StructureRow PickStructure(double x, double y, const VolumeData& data) const;

  /// Draws the visible pixels of the last frame in one colour, for a selection.
  void DrawMask(const float color[3]);

  /// Reset discards the optimisation; Release frees what can be computed again. If called while the
  /// volume is drawn, for instance by an observer, they take effect afterwards.
  void Reset();
  void Release();
  void ReleaseGraphicsResources(vtkWindow* window);

  /// State of the volume in the present frame of the renderer. Ahead: drawn before its turn, so
  /// that one in front of it could be drawn, or together with another one.
  enum class FrameStage
  {
    NotYet,
    Ahead,
    Over
  };
  FrameStage InFrame = FrameStage::NotYet;

  /// If VTK peels the volume: the peeling, and the volumes that are drawn with it, from back to
  /// front.
  DepthPeeling Peeling;
  std::vector<vtkWeakPointer<vtkVolume>> Peeled;

private:
  using Action = std::function<void()>;
  void WhileDrawing(const Action& action, const Action& again);
  void WhileDrawing(const Action& action) { this->WhileDrawing(action, action); }
  FrameSettings InTime(const FrameSettings& frame) const;
  std::optional<ViewGeometry> BeginFrame(
    const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  void PrepareFrame(const FrameSettings& frame, const VolumeData& data,
    const ViewGeometry& geometry, FrameMessages& messages);
  void PrepareNow(const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  void TellWhatDraws(FrameMessages& messages);
  void DrawNow(const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  PictureSubject SubjectOf(
    const FrameSettings& frame, const VolumeData& data, const ViewGeometry& geometry) const;
  bool ShowKept(const FrameSettings& frame, const PictureSubject& subject, FrameMessages& messages);
  void Keep(PictureSubject subject, const FrameMessages& messages);
  bool MakeOriginal(const VolumeData& data);
  bool AdvanceOriginal(double seconds);
  bool MakePicture(const View& view);
  OpaqueDepth OpaqueOf(const FrameSettings& frame, const ViewGeometry& geometry) const;
  bool DrawWhole(const FrameSettings& frame);
  bool DrawInSlices(const FrameSettings& frame);
  void Show(const FrameSettings& frame);
  void ShowShared(const Communicator& ranks);
  bool DrawBetween(const std::vector<DepthRange>& ranges);
  void DrawPartNow(const RayParts& parts, std::size_t part);
  void EndDrawing();
  void ReleaseNow();
  static void OnEvent(vtkObject* caller, unsigned long event, void* self, void* data);
  void ChoosePictures(const FrameSettings& frame, const Grid& grid);
  void UpdateRenderer(const FrameSettings& frame, const VolumeData& data);
  void UseImportance(const FrameSettings& frame, const VolumeData& data, FrameMessages& messages);
  void UseStructures(const FrameSettings& frame, const VolumeData& data);
  void Optimize(const FrameSettings& frame, const VolumeData& data, const ViewGeometry& geometry,
    const std::function<bool()>& isAborted, FrameMessages& messages, FrameResult& result);
  ViewOptimization::Look LastLook() const;
  double Coarseness(const FrameSettings& frame, const ViewGeometry& geometry);
  static View RaysOf(const FrameSettings& frame, const ViewGeometry& geometry,
    const std::vector<glm::dvec4>& planes, const PictureFrame& picture);
  void PlacePicture(const FrameSettings& frame, const ViewGeometry& geometry,
    const std::vector<glm::dvec4>& planes, double coarseness);
  bool IsAborted(double share);

  vtkWeakPointer<vtkRenderer> Target;
  vtkWeakPointer<vtkVolume> Volume;
  std::function<void()> WhenHidden;
  std::function<bool(double)> GoesOnAfter;
  vtkNew<vtkCallbackCommand> Observer;

  bool IsDrawing = false;
  bool OnRanks = false;      ///< whether several processes draw the frame together
  bool Reports = false;      ///< whether the frame tells GoesOnAfter its progress
  double RaysDone = 0;       ///< share of the frame's rays that have been cast
  bool ResetAfter = false;   ///< after the current drawing
  bool ReleaseAfter = false; ///< after the current drawing

  Renderer Caster;
  PictureBackend Backend;
  std::uint64_t ScalarsVersion = 0;
  std::uint64_t FunctionsVersion = 0;
  std::uint64_t ImportanceVersion = 0; ///< 0: pictures need no importance
  std::uint64_t StructuresVersion = 0; ///< 0: pictures have no colours of structures

  ViewOptimization Optimization{ this->Caster };
  ViewShadows Shadows{ this->Caster };
  FrameResult LastResult;
  std::function<void()> PrepareAgain; ///< for segments of the rays

  FrameBudget Budget;
  double Step = 1; ///< of the rays, see FrameBudget
  FrameClock Clock;
  bool GoesOn = false; ///< whether the last frame was one of several before a still one

  std::optional<ViewGeometry> Geometry; ///< of the frame; none: there is nothing to draw
  std::optional<OpaqueDepth> Opaque;    ///< of the frame
  PictureFrame Frame;
  View Rays;     ///< rays of the frame's pictures, except where they begin and end
  Picture Image; ///< of the frame; of several segments, only their alpha
  Picture Part;
  SlicedPicture Fine;          ///< still picture at full resolution
  SharpenedPicture Sharpening; ///< transition to it over successive frames
  SlicedPicture Original;      ///< the picture without optimisation, partly computed
  KeptPictures Pictures;
  bool RestsOptimized = false; ///< whether the last frame showed a kept picture with optimisation
  double CastSeconds = 0;      ///< time of the pictures of the frame
  PictureQuad Quad;
};
}

#endif
