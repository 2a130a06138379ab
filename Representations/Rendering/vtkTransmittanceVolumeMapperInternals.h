// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The implementation of vtkTransmittanceVolumeMapper between a call to Render and the picture; it
// is the interface to the core.

#ifndef vtkTransmittanceVolumeMapperInternals_h
#define vtkTransmittanceVolumeMapperInternals_h

#include "vtkTransmittanceVolumeMapper.h"

#include "ArrayContents.h"
#include "DrawingOrder.h"
#include "MessageLog.h"
#include "StartingImportance.h"
#include "StructureTint.h"
#include "VolumeData.h"
#include "VolumeView.h"

#include "vtkNew.h"
#include "vtkTable.h"
#include "vtkTimeStamp.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkHardwareSelector;
class vtkDataArray;
class vtkImageData;
class vtkProp;
class vtkVolumeProperty;

struct vtkTransmittanceVolumeMapper::Internals
{
  explicit Internals(vtkTransmittanceVolumeMapper* self)
    : Self(self)
  {
  }

  // Several processes.
  bool IsShared() const;
  double* FindWholeBounds(vtkImageData* image, double bounds[6]) const;
  bool AnyRank(bool here) const { return this->Ranks->AnyOf(here); }
  void UpdateRanks();
  void Disband();

  // Drawing.
  void Render(vtkRenderer* renderer, vtkVolume* volume);
  template <class Action>
  void WhileDrawing(const Action& action);
  void RenderInTurn(vtkRenderer* renderer, vtkVolume* volume);
  void RenderParts(vtkRenderer* renderer, vtkVolume* volume);
  void RenderSelection(vtkRenderer* renderer, vtkVolume* volume, vtkHardwareSelector* selector);
  bool PrepareOriginals();
  bool CanMeasureStructures() const;
  void MeasureStructures();
  vtkTable* KnownStructures();
  vtkTable* LegendOfStructures();
  void ReleaseMemory();
  void ReleaseData();
  limpid::VolumeView& ViewOf(vtkRenderer* renderer, vtkVolume* volume);
  void DrawWhatIsBehind(vtkRenderer* renderer, vtkVolume* volume);
  void PrepareFromBack(vtkRenderer* renderer, vtkVolume* volume, limpid::VolumeView& leader);
  void ForVolumesBehind(vtkRenderer* renderer, vtkVolume* volume,
    const std::function<void(vtkTransmittanceVolumeMapper*, vtkVolume*)>& action);
  void DrawFrame(limpid::VolumeView& view, vtkRenderer* renderer, vtkVolume* volume, bool inParts);
  void Draw(limpid::VolumeView& view, vtkRenderer* renderer, vtkVolume* volume, bool inParts);

  // Conversion of properties for the core.
  vtkImageData* RequireImage() const;
  limpid::FieldSource ScalarSource(vtkImageData* image, vtkVolume* volume);
  limpid::FieldSource ExtinctionSource(vtkImageData* image) const;
  struct Importance
  {
    limpid::FieldSource source;
    vtkMTimeType functionTime = 0; ///< modification time of the importance function; 0: none
    std::string warning;           ///< says what was assumed; may be empty
  };
  limpid::ImportanceChoice ChooseImportance(
    vtkImageData* image, const limpid::FieldSource& scalars) const;
  bool AssumeImportance(vtkImageData* image, limpid::ImportanceChoice& choice);
  Importance ImportanceOf(vtkImageData* image, const limpid::ImportanceChoice& choice);
  limpid::FieldSource GivenImportance(vtkImageData* image) const;
  void UpdateImportance(
    vtkImageData* image, limpid::ImportanceChoice choice, limpid::FrameSettings& frame);
  void LeaveImportance(vtkImageData* image, const limpid::ImportanceChoice& choice,
    const std::string& reason, limpid::FrameSettings& frame);
  void ChooseColors(limpid::FrameSettings& frame);
  void NoticeChanges(vtkImageData* image, std::vector<vtkDataArray*> arrays);
  limpid::CropRegion CropRegionOf(vtkVolume* volume) const;
  void RequirePossibleNumbers() const;
  limpid::FrameSettings MakeFrameSettings(vtkRenderer* renderer, vtkVolume* volume);
  void DropUnsupportedOnRanks(limpid::FrameSettings& frame);
  void LeaveWhatIsNotShared(limpid::FrameSettings& frame);
  limpid::Lighting MakeLighting() const;

  // Messages about properties that could not be drawn as requested.
  bool ReportsMessages() const;
  void Warn(const std::string& text);
  void Error(const std::string& text);
  std::string MessageOf(const std::exception& error) const;
  void ReportIgnored(vtkVolume* volume);
  void ReportNumbers(vtkVolumeProperty* property);
  void ReportNeighbours(vtkRenderer* renderer, vtkVolume* volume, bool inParts);
  bool ReportVolume(vtkRenderer* renderer, vtkVolume* other, const limpid::Box& box, bool later);

  vtkTransmittanceVolumeMapper* Self;
  std::shared_ptr<const limpid::Communicator> Ranks = limpid::ThisProcess(); ///< draw together
  limpid::ArrayContents Contents;
  limpid::ImportanceRamp Ramp;                 ///< the assumption if importance is not specified
  std::pair<vtkMTimeType, int> RampOf{ 0, 0 }; ///< scalars: time and component
  vtkTimeStamp RampTime;                       ///< when Ramp was computed
  bool UsesImportance = false; ///< whether a frame has needed importance for more than scores
  limpid::VolumeData Data;
  std::vector<std::unique_ptr<limpid::VolumeView>> Views;
  limpid::FrameResult Last;            ///< result of the last frame, in any view
  limpid::VolumeView* Shown = nullptr; ///< that view; null if there is none any more
  vtkNew<vtkTable> Structures;         ///< see GetStructureTable
  vtkNew<vtkTable> StructureLegend;    ///< see GetStructureLegendTable
  limpid::MessageLog Log;
  std::string Messages; ///< messages of the last frame
  std::vector<limpid::LabelColor> LabelColors;
  std::vector<limpid::LegendLine> Legend; ///< of the structures in the last frame
  int Drawing = 0;                        ///< number of nested calls to Render
  bool ReleaseAfter = false;
};

#endif
