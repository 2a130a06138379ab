// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkCameraPath
 * @brief   a camera path of constant speed through the best viewpoints
 *
 * Takes the S-sphere, which is the first output of vtkViewpointSearch, and returns a polyline of
 * camera positions, one per frame, in directions that the search has scored. The path follows
 * ridges of the score and turns at a constant speed, and its pictures stay upright. All frames look
 * at the centre of the sphere from the same distance: the least at which every frame shows the
 * whole box of the image.
 *
 * Point arrays of the output, one value per frame:
 *   "CameraPosition", "CameraFocalPoint", "CameraViewUp"  the camera,
 *   "ViewDirection"    unit vector from the focal point to the camera,
 *   "VisibilityScore"  score of the searched extinction, linear between the sampled directions,
 *   "KeyView"          1 at key views, else 0,
 *   "Time"             THROUGH_TIME: the time step; ROUND_TRIP: from 0 to below 1.
 * The field data are those of the sphere: CameraViewAngle, CameraParallelProjection and so on.
 *
 * ROUND_TRIP passes through the best views and returns to the first one. THROUGH_TIME has one frame
 * per time step of the input and follows what can be seen; for this, it updates the input for each
 * time step. If the input fails at a time step, the output has no path, and one error names the
 * time step and repeats the input's message.
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
   * Kind of path: ROUND_TRIP or THROUGH_TIME. Default is ROUND_TRIP.
   */
  LIMPID_SET_CLAMPED(Way, int, ROUND_TRIP, THROUGH_TIME);
  vtkGetMacro(Way, int);
  ///@}

  ///@{
  /**
   * Largest number of views that a round trip passes through, at least 1; it takes the best ones.
   * Default is 4.
   */
  LIMPID_SET_CLAMPED(NumberOfKeyViews, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfKeyViews, int);
  ///@}

  ///@{
  /**
   * Least angle between any two of these views [degrees], in [0, 180]. Default is 30.
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
   * Least score of key views, as a share of the locally best score, in [0, 1]: the lower it is, the
   * smoother the path. With THROUGH_TIME, every time step is a key view. Default is 0.9.
   */
  LIMPID_SET_CLAMPED(LeastShare, double, 0, 1);
  vtkGetMacro(LeastShare, double);
  ///@}

  ///@{
  /**
   * Range of elevations of the camera [degrees], as in vtkViewpointSearch; each in [-90, 90]. Near
   * the poles an upright picture turns fast. Default is (-75, 75).
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
