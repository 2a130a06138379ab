// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef vtkOptimizedVolumeRepresentationInternals_h
#define vtkOptimizedVolumeRepresentationInternals_h

#include "ArrayContents.h"
#include "SampledData.h"
#include "vtkOptimizedVolumeRepresentation.h"
#include "vtkScoreAnnotation.h"
#include "vtkTransmittanceVolumeMapper.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"
#include "vtkPiecewiseFunction.h"
#include "vtkWeakPointer.h"

#include "scene/StartingImportance.h"

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// The mapper for ParaView's kind of prop. It has no class name of its own, since messages show
/// users that of its base class.
class vtkRepresentedVolumeMapper : public vtkTransmittanceVolumeMapper
{
public:
  static vtkRepresentedVolumeMapper* New();

  /// Draws the prop that the renderer knows. ParaView's props contain another volume, which only
  /// they know, and draw that one.
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

  vtkVolume* Prop = nullptr;

  /// Whether the renderer called it in this frame. It does not if the volume is out of the view;
  /// the mapper's results then refer to an earlier frame.
  bool HasDrawn = false;

  /// Whether the text in the view needs what the last picture shows of structures. It is measured
  /// after a frame that is not made in steps; otherwise the client asks for it.
  bool TellsShares = false;
};

struct vtkOptimizedVolumeRepresentation::Internals
{
  vtkNew<vtkRepresentedVolumeMapper> Mapper;
  limpid::ArrayContents Contents; ///< of the arrays that are shown
  vtkNew<vtkScoreAnnotation> Annotation;
  std::string SourceName;
  bool TellsName = false; // whether the text shows the name in this frame
  bool ShowScore = true;
  bool ScoreInScreenshots = false;
  bool StructureLegend = true;
  vtkWeakPointer<vtkPVRenderView> View; // the view that shows it

  std::string ImportanceArray = "Importance";
  bool ImportanceGiven = false; // off: the color array stands in if there is no importance array
  int ImportanceAssociation = vtkDataObject::FIELD_ASSOCIATION_POINTS;

  // Used by the volume's property in place of functions that are not set.
  vtkNew<vtkColorTransferFunction> DefaultColors;
  vtkNew<vtkPiecewiseFunction> DefaultOpacity;
  std::pair<vtkMTimeType, int> DefaultsOf{ 0, 0 }; // see TimeAndComponentOf
  bool ColorsGiven = false;
  bool OpacityGiven = false;

  // The ramp of the shown array that is assumed if importance is not specified.
  vtkNew<vtkPiecewiseFunction> AssumedImportance;
  limpid::ImportanceRamp ShownRamp;
  std::pair<vtkMTimeType, int> AssumedOf{ 0, 0 };
  std::array<double, 4> SuggestedImportance = {};

  // Requests that are not supported.
  bool UseSeparateOpacityArray = false;
  bool UseTransfer2D = false;
  bool MapsScalars = true;
  bool MapsComponents = false;
  bool Interpolates = true;

  vtkNew<vtkDoubleArray> StructureShares;

  limpid::SampledData Sampled;         // an image of input that is none
  std::string SampledOf;               // what it was made of
  std::set<std::string> SampledArrays; // names of its arrays; empty: all
  std::array<int, 3> ImageDimensions = {};

  std::string Refusal;                  // why the input cannot be drawn; empty if it can
  std::vector<unsigned long> Observers; // tags of observers of the renderer's frames
  bool PeelsVolumes = false;            // whether the renderer does so, except in the present frame

  std::vector<std::string> Messages; // of the representation, about the last picture
  std::string Text;                  // these and the mapper's messages, one per line
};

#endif
