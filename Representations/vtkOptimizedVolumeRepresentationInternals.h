// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef vtkOptimizedVolumeRepresentationInternals_h
#define vtkOptimizedVolumeRepresentationInternals_h

#include "ArrayContents.h"
#include "vtkOptimizedVolumeRepresentation.h"
#include "vtkScoreAnnotation.h"
#include "vtkTransmittanceVolumeMapper.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"
#include "vtkPiecewiseFunction.h"
#include "vtkWeakPointer.h"

#include "scene/StartingImportance.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

/// The mapper in ParaView's kind of prop. It has no type of its own: users know the name of the
/// other one from messages.
class vtkRepresentedVolumeMapper : public vtkTransmittanceVolumeMapper
{
public:
  static vtkRepresentedVolumeMapper* New();

  /// Draws the prop that the renderer knows. ParaView's props hold another volume, which only they
  /// know, and draw that one.
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

  vtkVolume* Prop = nullptr;

  /// Whether the renderer came to it in a frame. It does not if the volume is out of the view, and
  /// what the mapper says is about an earlier frame then.
  bool HasDrawn = false;
};

struct vtkOptimizedVolumeRepresentation::Internals
{
  vtkNew<vtkRepresentedVolumeMapper> Mapper;
  limpid::ArrayContents Contents; ///< of what is shown
  vtkNew<vtkScoreAnnotation> Annotation;
  std::string SourceName;
  bool TellsName = false; // in the present frame
  bool ShowScore = true;
  bool ScoreInScreenshots = false;
  vtkWeakPointer<vtkPVRenderView> View; // that it is in

  std::string ImportanceArray = "Importance";
  bool ImportanceGiven = false; // off: colours stand in where there is no such array
  int ImportanceAssociation = vtkDataObject::FIELD_ASSOCIATION_POINTS;

  // What the volume's property has in place of functions that were not given.
  vtkNew<vtkColorTransferFunction> DefaultColors;
  vtkNew<vtkPiecewiseFunction> DefaultOpacity;
  std::pair<vtkMTimeType, int> DefaultsOf{ 0, 0 }; // see TimeAndComponentOf
  bool ColorsGiven = false;
  bool OpacityGiven = false;

  // What is important of the array that is shown, where nothing says it.
  vtkNew<vtkPiecewiseFunction> AssumedImportance;
  limpid::ImportanceRamp ShownRamp;
  std::pair<vtkMTimeType, int> AssumedOf{ 0, 0 };
  std::array<double, 4> SuggestedImportance = {};

  // Asked for, but not available.
  bool UseSeparateOpacityArray = false;
  bool UseTransfer2D = false;
  bool MapsScalars = true;
  bool MapsComponents = false;
  bool Interpolates = true;

  std::string Refusal;                  // of the input: why it cannot be drawn; empty if it can
  std::vector<unsigned long> Observers; // of the renderer's frames
  bool PeelsVolumes = false;            // whether it does, but for the present frame

  std::vector<std::string> Messages; // about the last picture
  std::string Text;                  // the same, and the mapper's, one a line
};

#endif
