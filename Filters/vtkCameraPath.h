// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkCameraPath
 * @brief   an even way of a camera through views that show much
 *
 * Takes the sphere of vtkViewpointSearch, its first output, and makes a polyline of where a camera
 * stands, frame by frame, in directions that the search has scored. It goes along ridges of the
 * score, turns evenly, and the pictures stay upright. All frames look at the centre from the same
 * distance, the least from which every one of them shows all of the image's box.
 *
 * Point arrays of the output, one value per frame:
 *   "CameraPosition", "CameraFocalPoint", "CameraViewUp"  the camera,
 *   "ViewDirection"    from its focal point, of unit length,
 *   "VisibilityScore"  of the extinction that was searched, linear between the directions,
 *   "KeyView"          1 at key views, else 0,
 *   "Time"             THROUGH_TIME: the time step; else from 0 to below 1.
 * The field data are those of the sphere: CameraViewAngle, CameraParallelProjection and so on.
 *
 * ROUND_TRIP goes through the best views and back to the first one. THROUGH_TIME has one frame per
 * time step of the input, which is updated for each of them, and follows what can be seen. Where
 * the input fails at a time step, there is no path, and one error that names this time step and
 * repeats what the input says.
 *
 * @sa vtkViewpointSearch
 */

#ifndef vtkCameraPath_h
#define vtkCameraPath_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkVisibilitySettingsMacros.h" // for setters of values in a range

#include <memory> // for the hidden core

class VTKLIMPIDFILTERS_EXPORT vtkCameraPath : public vtkPolyDataAlgorithm
{
public:
  static vtkCameraPath* New();
  vtkTypeMacro(vtkCameraPath, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Ways
  {
    ROUND_TRIP = 0,
    THROUGH_TIME = 1
  };

  ///@{
  /**
   * Which way. Default is ROUND_TRIP.
   */
  LIMPID_SET_CLAMPED(Way, int, ROUND_TRIP, THROUGH_TIME);
  vtkGetMacro(Way, int);
  ///@}

  ///@{
  /**
   * Most views that a round trip goes through, the best ones, at least 1. Default is 4.
   */
  LIMPID_SET_CLAMPED(NumberOfKeyViews, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfKeyViews, int);
  ///@}

  ///@{
  /**
   * Least angle between any two of these [degrees], 0 to 180. Default is 30.
   */
  LIMPID_SET_CLAMPED(SeparationAngle, double, 0, 180);
  vtkGetMacro(SeparationAngle, double);
  ///@}

  ///@{
  /**
   * Number of frames of a round trip, in [2, 100000]. Default is 120.
   */
  LIMPID_SET_CLAMPED(NumberOfFrames, int, 2, 100000);
  vtkGetMacro(NumberOfFrames, int);
  ///@}

  ///@{
  /**
   * Share of the locally best score that key views have at least, 0 to 1: lower is smoother.
   * THROUGH_TIME, every time step is one. Default is 0.9.
   */
  LIMPID_SET_CLAMPED(LeastShare, double, 0, 1);
  vtkGetMacro(LeastShare, double);
  ///@}

  ///@{
  /**
   * Between which elevations the camera stays [degrees], as in vtkViewpointSearch. Near the poles
   * an upright picture turns fast. Default is (-75, 75).
   */
  LIMPID_SET_CLAMPED_VECTOR2(ElevationRange, double, -90, 90);
  vtkGetVector2Macro(ElevationRange, double);
  ///@}

protected:
  vtkCameraPath();
  ~vtkCameraPath() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCameraPath(const vtkCameraPath&) = delete;
  void operator=(const vtkCameraPath&) = delete;

  int Way = ROUND_TRIP;
  int NumberOfKeyViews = 4;
  double SeparationAngle = 30;
  int NumberOfFrames = 120;
  double LeastShare = 0.9;
  double ElevationRange[2] = { -75, 75 };

  struct Internals;
  std::unique_ptr<Internals> State;
};

#endif
