// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkViewpointSearch
 * @brief   find the views from which the important structures of an image are seen best
 *
 * Scores views from all around an image by S of Eq. (32) in [HG24], climbs from the best ones along
 * the derivative of S (Eqs. (29)-(31)), and ranks the views that it reaches. Cameras stand on a
 * sphere around the centre of the image, or around another point, and are upright by Eq. (10). The
 * whole image counts, even if a picture would show only part of it; light is ignored. The cameras
 * of ranked viewpoints have the directions that were found, at the distance from which the box of
 * the image fills 95 % of the picture's width or height.
 *
 * Input port 0: see vtkVisibilityAlgorithm. Array 2, an extinction, is used if ExtinctionSource is
 * ARRAY or Field is EXTINCTION_ARRAY.
 *
 * Output port 0: vtkPolyData, the S-sphere: a closed triangulated sphere around the image, one
 * point per direction, with the point arrays
 *   "VisibilityScore" S [length^2],
 *   "VisibleFraction" the share of the important structures in the data whose light reaches the
 *                     camera [0, 1],
 *   "AttainableFraction" with Field ATTAINABLE: the highest share that an optimisation for the
 *                     view could show; "VisibleFraction" has the same values then [0, 1],
 *   "NormalizedScore" 0 worst, 1 best of the directions (if all are equal: 1, or 0 if S is 0),
 *   "Azimuth", "Polar" the angles of Eq. (10) [degrees],
 *   "ViewDirection"   unit vector from the centre to the camera, R (0, 0, 1) of Eq. (10),
 *   "CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraParallelScale"
 *                     the camera of the score,
 *   "Rank"            1 is the best direction,
 *   "Valid"           1: the direction was scored; 0: an abort came before, and its scores and
 *                     rank are 0.
 *
 * Output port 1: vtkPolyData, Viewpoints: one vertex per ranked viewpoint, at the position of its
 * camera, best first. It has these point arrays except NormalizedScore. Cameras show the whole box.
 *
 * Output port 2: vtkPolyData, Paths: one polyline per ascent through camera positions, from the
 * sample to the better view. It has these point arrays except NormalizedScore, Rank and Valid.
 *
 * Every output has field data with one tuple each: "BestVisibilityScore", "BestVisibleFraction",
 * "BestCameraPosition", "BestCameraFocalPoint", "BestCameraViewUp", "BestAzimuth" and "BestPolar"
 * of the first viewpoint; arrays named "Worst" instead of "Best" for the worst direction of the
 * sphere (both are missing if an abort came before any score); "CameraFocalPoint" (the centre of
 * the sphere of cameras), "CameraUpAxis", "CameraViewAngle", "CameraAspectRatio",
 * "CameraParallelProjection" and "CameraParallelScale" of all views; "ImageCorners" (x, y and z of
 * the eight corners of the box); "Evaluations" (number of scores and derivatives), "Seconds",
 * "ScalarOpacityUnitDistance", "Backend".
 *
 * After an error the outputs are empty. With several MPI processes, each has the whole image and
 * scores some of the directions; the first process climbs and has the outputs. If the image would
 * take a quarter of a machine's memory, or if a source ignores the request and gives each process a
 * piece, the processes score one direction after the other together, each with its piece. The
 * outputs are the same. OPTIMIZE_PER_VIEW needs the whole image.
 *
 * @sa vtkVisibilityAlgorithm vtkExtinctionOptimizer vtkCameraPath
 */

#ifndef vtkViewpointSearch_h
#define vtkViewpointSearch_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkVisibilityAlgorithm.h"

#include <memory> // for the hidden core

class vtkPolyData;

class VTKLIMPIDFILTERS_EXPORT vtkViewpointSearch : public vtkVisibilityAlgorithm
{
public:
  static vtkViewpointSearch* New();
  vtkTypeMacro(vtkViewpointSearch, vtkVisibilityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Applies a preset, see vtkVisibilitySettings::SetPreset, but sets TemporalCoherence and
   * Smoothness to 0.
   */
  bool SetPreset(const char* name) override;

  enum Fields
  {
    IMPORTANCE_PROXY = 0,
    BASE_EXTINCTION = 1,
    EXTINCTION_ARRAY = 2,
    OPTIMIZE_PER_VIEW = 3,
    ATTAINABLE = 4
  };

  enum Samplings
  {
    ICOSPHERE = 0,
    FIBONACCI = 1,
    LATITUDE_LONGITUDE = 2
  };

  ///@{
  /**
   * The outputs: the S-sphere, the ranked viewpoints, and the paths of the ascents.
   */
  vtkPolyData* GetOutput();
  vtkPolyData* GetOutput(int port);
  vtkPolyData* GetViewpoints();
  vtkPolyData* GetPaths();
  ///@}

  ///@{
  /**
   * The extinction that is scored. ATTAINABLE: for each ray, the best extinction that the bounds
   * allow. No optimisation for the view can exceed its score and most come close, at the cost of
   * one score. IMPORTANCE_PROXY: the majorant of Eq. (25) times importance, as if there were
   * nothing else (Section 3.4 of [HG24]). BASE_EXTINCTION: the extinction that ExtinctionSource
   * gives. EXTINCTION_ARRAY: array 2, for instance a result of vtkExtinctionOptimizer.
   * OPTIMIZE_PER_VIEW: an extinction that is optimised for each view, with the weights and a light
   * above and behind the camera; takes long. Default is ATTAINABLE.
   */
  LIMPID_SET_CLAMPED(Field, int, IMPORTANCE_PROXY, ATTAINABLE);
  vtkGetMacro(Field, int);
  ///@}

  ///@{
  /**
   * Distribution of directions over the sphere. Default is ICOSPHERE.
   */
  LIMPID_SET_CLAMPED(Sampling, int, ICOSPHERE, LATITUDE_LONGITUDE);
  vtkGetMacro(Sampling, int);
  ///@}

  ///@{
  /**
   * Number of directions, in [1, 100000]. The nearest number that the sampling allows is used; an
   * icosphere has 12, 42, 162, 642, 2562 and so on. Default is 642.
   */
  LIMPID_SET_CLAMPED(NumberOfDirections, int, 1, 100000);
  vtkGetMacro(NumberOfDirections, int);
  ///@}

  ///@{
  /**
   * Whether the cameras look at CameraFocalPoint. Off: they look at the centre of the image.
   * Default is off.
   */
  vtkSetMacro(UseFocalPoint, vtkTypeBool);
  vtkGetMacro(UseFocalPoint, vtkTypeBool);
  vtkBooleanMacro(UseFocalPoint, vtkTypeBool);
  ///@}

  ///@{
  /**
   * With UseFocalPoint, the point that the cameras look at, which is the centre of their sphere.
   * The S-sphere stays centred at the image. Default is (0, 0, 0).
   */
  vtkSetVector3Macro(CameraFocalPoint, double);
  vtkGetVector3Macro(CameraFocalPoint, double);
  ///@}

  ///@{
  /**
   * Distance of scored cameras from their focal point, in radii of the bounding sphere of the
   * image; at least 1. If UseFocalPoint moves the focal point so that a camera would stand inside
   * of that sphere, this is an error. The cameras of viewpoints stand where the box fills their
   * pictures. Default is 3.
   */
  LIMPID_SET_CLAMPED(CameraDistance, double, 1, VTK_DOUBLE_MAX);
  vtkGetMacro(CameraDistance, double);
  ///@}

  ///@{
  /**
   * Vertical view angle of the cameras [degrees], between 0 and 180. It does not affect scores.
   * Default is 30.
   */
  vtkSetMacro(CameraViewAngle, double);
  vtkGetMacro(CameraViewAngle, double);
  ///@}

  ///@{
  /**
   * Aspect ratio of the pictures of the viewpoints' cameras, width over height, above 0. It does
   * not affect scores. Default is 1.
   */
  vtkSetMacro(CameraAspectRatio, double);
  vtkGetMacro(CameraAspectRatio, double);
  ///@}

  ///@{
  /**
   * Whether the projection is parallel. Default is off.
   */
  vtkSetMacro(CameraParallelProjection, vtkTypeBool);
  vtkGetMacro(CameraParallelProjection, vtkTypeBool);
  vtkBooleanMacro(CameraParallelProjection, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Up direction of the pictures and axis of elevations, of any length. Its part across the
   * direction of view points upwards. The angles "Azimuth" and "Polar" of Eq. (10) always refer to
   * the y axis. Default is (0, 1, 0).
   */
  vtkSetVector3Macro(CameraViewUp, double);
  vtkGetVector3Macro(CameraViewUp, double);
  ///@}

  ///@{
  /**
   * Range of elevations of viewpoints above the plane perpendicular to CameraViewUp [degrees]: (0,
   * 90) is the upper hemisphere, (0, 0) the horizon. The S-sphere has scores for all directions.
   * Default is (-90, 90).
   */
  LIMPID_SET_CLAMPED_VECTOR2(ElevationRange, double, -90, 90);
  vtkGetVector2Macro(ElevationRange, double);
  ///@}

  ///@{
  /**
   * Directions from the focal point that no viewpoint may be closer to than AvoidanceAngle
   * [degrees]; of any length. By default there are none, and the angle is 30.
   */
  void AddAvoidedDirection(double x, double y, double z);
  void RemoveAllAvoidedDirections();
  int GetNumberOfAvoidedDirections() const;
  LIMPID_SET_CLAMPED(AvoidanceAngle, double, 0, 180);
  vtkGetMacro(AvoidanceAngle, double);
  ///@}

  ///@{
  /**
   * Largest number of ranked viewpoints and of ascents, at least 1. Default is 4.
   */
  LIMPID_SET_CLAMPED(NumberOfViewpoints, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfViewpoints, int);
  ///@}

  ///@{
  /**
   * Least angle between two ranked viewpoints [degrees], in [0, 180]. Default is 30.
   */
  LIMPID_SET_CLAMPED(SeparationAngle, double, 0, 180);
  vtkGetMacro(SeparationAngle, double);
  ///@}

  ///@{
  /**
   * Whether to climb from the best sampled directions to better ones between the samples. Default
   * is on.
   */
  vtkSetMacro(Refine, vtkTypeBool);
  vtkGetMacro(Refine, vtkTypeBool);
  vtkBooleanMacro(Refine, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Radius of the S-sphere, in radii of the bounding sphere of the image; above 0. Default is 1.1.
   */
  vtkSetMacro(SphereRadius, double);
  vtkGetMacro(SphereRadius, double);
  ///@}

protected:
  vtkViewpointSearch();
  ~vtkViewpointSearch() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkViewpointSearch(const vtkViewpointSearch&) = delete;
  void operator=(const vtkViewpointSearch&) = delete;

  int Field = ATTAINABLE;
  int Sampling = ICOSPHERE;
  int NumberOfDirections = 642;
  vtkTypeBool UseFocalPoint = 0;
  double CameraFocalPoint[3] = { 0, 0, 0 };
  double CameraDistance = 3;
  double CameraViewAngle = 30;
  double CameraAspectRatio = 1;
  vtkTypeBool CameraParallelProjection = 0;
  double CameraViewUp[3] = { 0, 1, 0 };
  double ElevationRange[2] = { -90, 90 };
  double AvoidanceAngle = 30;
  int NumberOfViewpoints = 4;
  double SeparationAngle = 30;
  vtkTypeBool Refine = 1;
  double SphereRadius = 1.1;

  struct Internals; // hides core types from this header
  std::unique_ptr<Internals> State;
};

#endif
