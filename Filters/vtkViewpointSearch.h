// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkViewpointSearch
 * @brief   find from where important regions of an image can be seen best
 *
 * Scores views from all around an image by S of Eq. (32) in [HG24], climbs from the best of them
 * along its derivative (Eqs. (29)-(31)), and ranks what is reached. Views are scored from a sphere
 * round the centre of the image, or round another point, upright by Eq. (10). All of the image
 * counts, whatever part of it a picture would show; light plays no part. The cameras of the ranked
 * viewpoints stand in the directions found, at the distance from which all of the image's box is in
 * the picture and fills 95 % of its width or height.
 *
 * Input port 0: vtkImageData, see vtkVisibilityAlgorithm; array 2, an extinction, with
 * ExtinctionSource ARRAY or Field EXTINCTION_ARRAY.
 *
 * Output port 0: vtkPolyData, the S-sphere: a closed triangulated sphere round the image, one point
 * per direction, with the point arrays
 *   "VisibilityScore" S [length^2], "VisibleFraction" (of the important matter in the data, the
 *                     share whose light reaches the camera) [0, 1],
 *   "AttainableFraction" with Field ATTAINABLE: the most that an optimisation for the view could
 *                     show of it, which "VisibleFraction" is then, too [0, 1],
 *   "NormalizedScore" 0 worst, 1 best of the directions (all the same: 1, or 0 if S is 0),
 *   "Azimuth", "Polar" the angles of Eq. (10) [degrees],
 *   "ViewDirection"   unit vector from the centre to the camera, R (0, 0, 1) of Eq. (10),
 *   "CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraParallelScale" by which it was
 *                     scored,
 *   "Rank"            1 is the best direction,
 *   "Valid"           1: it was scored; 0: there was an abort before; its scores and rank are 0.
 * Output port 1: vtkPolyData, Viewpoints: one vertex per ranked viewpoint, at the position of its
 * camera, best first, with the same point arrays but NormalizedScore; cameras show the whole box.
 * Output port 2: vtkPolyData, Paths: one polyline per ascent, from the sample to the better view,
 * through the positions of its cameras, with the same point arrays but NormalizedScore, Rank and
 * Valid.
 *
 * Every output has field data with one tuple each: "BestVisibilityScore", "BestVisibleFraction",
 * "BestCameraPosition", "BestCameraFocalPoint", "BestCameraViewUp", "BestAzimuth", "BestPolar" of
 * the first viewpoint; the same with "Worst" of the worst direction of the sphere (neither if
 * nothing was scored before an abort); "CameraFocalPoint" (the centre of the sphere of cameras),
 * "CameraUpAxis", "CameraViewAngle", "CameraAspectRatio", "CameraParallelProjection" and
 * "CameraParallelScale" of all views; "ImageCorners" (x, y and z of the eight corners of the box);
 * "Evaluations" (scores and derivatives), "Seconds",
 * "ScalarOpacityUnitDistance", "Backend".
 *
 * After an error the outputs are empty. With several processes of MPI each scores some of the
 * directions, of an image that all of them have whole; the first one climbs, and has the outputs.
 * Where the image would take a quarter of the memory of a machine, or a source gives each process a
 * piece whatever it is asked for, they score one direction after the other together, each with its
 * piece; the outputs are the same. OPTIMIZE_PER_VIEW needs the whole image.
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
   * Settings for a purpose, see vtkVisibilitySettings::SetPreset; TemporalCoherence and Smoothness
   * become 0.
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
   * The outputs: S-sphere, ranked viewpoints, ascents.
   */
  vtkPolyData* GetOutput();
  vtkPolyData* GetOutput(int port);
  vtkPolyData* GetViewpoints();
  vtkPolyData* GetPaths();
  ///@}

  ///@{
  /**
   * The extinction that is looked at. ATTAINABLE: one of its own for every ray, the best that the
   * bounds allow: what no optimisation for the view could exceed, and nearly what it reaches, for
   * the price of a score. IMPORTANCE_PROXY: the majorant of Eq. (25) times
   * importance, as if nothing else were there (Section 3.4 of [HG24]). BASE_EXTINCTION: what
   * ExtinctionSource gives. EXTINCTION_ARRAY: array 2, for instance the result of
   * vtkExtinctionOptimizer. OPTIMIZE_PER_VIEW: an extinction of its own for every view, optimised
   * with the weights and a light above and behind the camera; takes long.
   * Default is ATTAINABLE.
   */
  LIMPID_SET_CLAMPED(Field, int, IMPORTANCE_PROXY, ATTAINABLE);
  vtkGetMacro(Field, int);
  ///@}

  ///@{
  /**
   * How directions are spread over the sphere. Default is ICOSPHERE.
   */
  LIMPID_SET_CLAMPED(Sampling, int, ICOSPHERE, LATITUDE_LONGITUDE);
  vtkGetMacro(Sampling, int);
  ///@}

  ///@{
  /**
   * Number of directions, 1 to 100000; the nearest that the sampling can have, which for an
   * icosphere is 12, 42, 162, 642, 2562 and so on. Default is 642.
   */
  LIMPID_SET_CLAMPED(NumberOfDirections, int, 1, 100000);
  vtkGetMacro(NumberOfDirections, int);
  ///@}

  ///@{
  /**
   * Whether the cameras look at CameraFocalPoint; else at the centre of the image. Default is off.
   */
  vtkSetMacro(UseFocalPoint, vtkTypeBool);
  vtkGetMacro(UseFocalPoint, vtkTypeBool);
  vtkBooleanMacro(UseFocalPoint, vtkTypeBool);
  ///@}

  ///@{
  /**
   * What the cameras look at, and the centre of the sphere that they stand on, with UseFocalPoint.
   * The S-sphere stays round the image. Default is (0, 0, 0).
   */
  vtkSetVector3Macro(CameraFocalPoint, double);
  vtkGetVector3Macro(CameraFocalPoint, double);
  ///@}

  ///@{
  /**
   * From where views are scored: distance from what they look at, in radii of the sphere round the
   * image's box; not below 1, and so that all of them are outside that sphere. The cameras of
   * viewpoints stand where the box fills their pictures. Default is 3.
   */
  LIMPID_SET_CLAMPED(CameraDistance, double, 1, VTK_DOUBLE_MAX);
  vtkGetMacro(CameraDistance, double);
  ///@}

  ///@{
  /**
   * Vertical opening of the cameras, for whoever looks through them [degrees]. It has no influence
   * on scores. Default is 30.
   */
  vtkSetMacro(CameraViewAngle, double);
  vtkGetMacro(CameraViewAngle, double);
  ///@}

  ///@{
  /**
   * Width over height of the pictures that the viewpoints' cameras are for. It has no influence on
   * scores. Default is 1.
   */
  vtkSetMacro(CameraAspectRatio, double);
  vtkGetMacro(CameraAspectRatio, double);
  ///@}

  ///@{
  /**
   * Whether the cameras look along parallel rays. Default is off.
   */
  vtkSetMacro(CameraParallelProjection, vtkTypeBool);
  vtkGetMacro(CameraParallelProjection, vtkTypeBool);
  vtkBooleanMacro(CameraParallelProjection, vtkTypeBool);
  ///@}

  ///@{
  /**
   * What is upwards in the pictures, as far as it is across the direction of view, and what
   * elevations are above; of any length. The angles of Eq. (10), "Azimuth" and "Polar", are about
   * the y axis all the same. Default is (0, 1, 0).
   */
  vtkSetVector3Macro(CameraViewUp, double);
  vtkGetVector3Macro(CameraViewUp, double);
  ///@}

  ///@{
  /**
   * From which elevations above the plane at right angles to CameraViewUp a viewpoint may look
   * [degrees]: (0, 90) is the hemisphere above, (0, 0) the horizon. Scores of the S-sphere are
   * those of all directions. Default is (-90, 90).
   */
  LIMPID_SET_CLAMPED_VECTOR2(ElevationRange, double, -90, 90);
  vtkGetVector2Macro(ElevationRange, double);
  ///@}

  ///@{
  /**
   * Directions from what the cameras look at that no viewpoint may come closer to than
   * AvoidanceAngle [degrees]; of any length. There are none at first, and the angle is 30.
   */
  void AddAvoidedDirection(double x, double y, double z);
  void RemoveAllAvoidedDirections();
  int GetNumberOfAvoidedDirections() const;
  LIMPID_SET_CLAMPED(AvoidanceAngle, double, 0, 180);
  vtkGetMacro(AvoidanceAngle, double);
  ///@}

  ///@{
  /**
   * Most viewpoints that are ranked, and ascents that are made. Default is 4.
   */
  LIMPID_SET_CLAMPED(NumberOfViewpoints, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfViewpoints, int);
  ///@}

  ///@{
  /**
   * Least angle between two ranked viewpoints [degrees]. Default is 30.
   */
  LIMPID_SET_CLAMPED(SeparationAngle, double, 0, 180);
  vtkGetMacro(SeparationAngle, double);
  ///@}

  ///@{
  /**
   * Whether to climb from the best directions to better ones between them. Default is on.
   */
  vtkSetMacro(Refine, vtkTypeBool);
  vtkGetMacro(Refine, vtkTypeBool);
  vtkBooleanMacro(Refine, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Radius of the S-sphere, in radii of the sphere round the image's box. Default is 1.1.
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

  struct Internals; // speaks to the core, so that no core type shows here
  std::unique_ptr<Internals> State;
};

#endif
