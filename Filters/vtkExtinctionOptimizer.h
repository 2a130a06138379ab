// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkExtinctionOptimizer
 * @brief   find the extinction field that makes important structures visible
 *
 * Minimises the energy of Eq. (21) in [HG24] over the extinction at every point of an image, for
 * one camera and one light.
 *
 * Input port 0: vtkImageData, see vtkVisibilityAlgorithm. Array 2, the base extinction, is used
 * only if ExtinctionSource is ARRAY. ScalarOpacityUnitDistance is also the unit distance of the
 * array "Opacity".
 *
 * Output port 0: a shallow copy of the input, an image or data of the input's type (for which
 * GetOutputDataObject returns it), with float point arrays
 *   "Extinction"         optimised extinction for the camera; in joint mode, also for the light
 *                        [1/length],
 *   "LightExtinction"    separate mode only: optimised extinction for the light [1/length],
 *   "Opacity"            1 - exp(-Extinction * unit distance), for stock volume rendering,
 *   "BaseExtinction"     the extinction that the optimisation started from [1/length],
 *   "Importance"         the importance that was used [0, 1],
 *   "Transmittance"      from the camera to the point, through Extinction [0, 1],
 *   "LightTransmittance" from the light to the point [0, 1],
 *   "MissedImportance"   the importance that cannot be seen: importance minus the share of its
 *                        matter that was kept and whose light reaches the camera; 0 without
 *                        matter [0, 1].
 * An input array of the same name is replaced, with a warning. ResultArrays says which of them are
 * written.
 *
 * Output port 0 also has field data with one tuple each:
 *   "VisibilityScore", "BaseVisibilityScore": S of Eq. (32) [length^2],
 *   "VisibleFraction", "BaseVisibleFraction": the share of the important structures in the data
 *     whose light reaches the camera [0, 1],
 *   "SacrificedFraction": the share of it that was removed [0, 1],
 *   "Energy", "Iterations", "Seconds", "Backend",
 *   "ControlFactor": 1 if the change was found at the resolution of the data, 2 for half of it
 * along each axis, and so on, see ControlResolution, "Settled": 1 if another iteration would change
 * next to nothing, 0 if they ended at a limit, "CameraPosition", "CameraFocalPoint",
 * "CameraViewUp", "LightPosition", "ScalarOpacityUnitDistance": the values that were used,
 *   "AttainableFraction", "AttainableScore", "AttainableLightScore": bounds that no extinction
 *     within its limits could exceed; 0 for methods other than OPTIMIZED; the last is also 0
 *     for a light without weight,
 *   "StartVisibilityScore", "StartVisibleFraction": with OptimizeViewpoint, the values that the
 *     extinction alone achieved, if they had to be computed,
 *   "HighestAttainableFraction": with OptimizeViewpoint and the guide ATTAINABLE, the highest of
 *     all evaluated views,
 *   "Proof": likewise, a sentence that says what was proved about the view,
 *   "Targets": what is visible of structures with a target share; it is there if any has one.
 *
 * Output port 1: vtkTable, one row per iteration.
 *
 * Output port 2: vtkTable, one row per structure if input array 3 has labels: "Label", "Name",
 * "Importance" as given, "Target" (-1: none), and shares of what the data have of the structure, in
 * [0, 1]:
 *   "Visible", "BaseVisible": its light reaches the camera, through the result and the base
 *     extinction,
 *   "Removed": it was removed,
 *   "Attainable": the bound that Visible cannot exceed from this camera, whatever is cleared,
 *   "HiddenByOther", "HiddenBy<Name>": it is hidden by each structure; only for up to 256;
 * and "Weight", the importance that was used.
 * Visible, Removed and all HiddenBy add up to 1.
 *
 * ControlResolution and MemoryLimit choose the grid on which the change of the extinction is found.
 * On a coarser one than that of the data, scores, shares and arrays are still those of the data, by
 * sweeps through it. If the data with these do not fit into MemoryLimit, they are those of the
 * coarser grid, and "Transmittance", "LightTransmittance" and "MissedImportance" are left out, with
 * a warning. The data are then converted a few layers at a time, without "BaseExtinction" and
 * "Importance", unless they are cell arrays, blanked points, structures or references, or WarmStart
 * is on.
 *
 * If structures have targets, the optimisation is repeated with other importances until as much of
 * them is visible, or no further run helps, at most 20 times (limpid::TargetSearch). A target above
 * Attainable cannot be met by any opacity: a warning says so, and from where more could be seen.
 *
 * After an error the outputs are empty. After an abort, output 0 is the unchanged input. An image
 * without volume (a slice, a row, a point) keeps its base extinction, with a warning.
 *
 * MPI processes that are each asked for a piece, as in ParaView, optimise the image together. Each
 * requests its piece and one layer of ghost cells from its input, and the result equals that of one
 * process bit by bit. An error or an abort on one process stops all. The following is not supported
 * in distributed runs: methods other than OPTIMIZED, OptimizeViewpoint, and the backend CUDA. In
 * these cases, each process computes the whole image and keeps its piece.
 *
 * @sa vtkVisibilityAlgorithm vtkViewpointSearch vtkOcclusionPhantom
 */

#ifndef vtkExtinctionOptimizer_h
#define vtkExtinctionOptimizer_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkVisibilityAlgorithm.h"

#include <memory> // for the hidden core
#include <set>    // for a member
#include <string> // for a member

class vtkTable;

class VTKLIMPIDFILTERS_EXPORT vtkExtinctionOptimizer : public vtkVisibilityAlgorithm
{
public:
  static vtkExtinctionOptimizer* New();
  vtkTypeMacro(vtkExtinctionOptimizer, vtkVisibilityAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ViewpointGuides
  {
    PROXY = 0,
    COUPLED = 1,
    ATTAINABLE = 2
  };

  /**
   * The table on the output Convergence: iteration, level, energies, seconds, and the score and
   * fractions of every iteration. Scores always use the importance as given; with
   * ImportanceSmoothing, or if ViewWeight is 0, they are those of the best iterate so far.
   */
  vtkTable* GetConvergence();

  /// The table on the output Structures, see above.
  vtkTable* GetStructureTable();

  ///@{
  /**
   * Whether the filter places a camera or a light that was not placed. A camera counts as not
   * placed if CameraPosition is (0, 0, 1) and CameraFocalPoint is (0, 0, 0), as in a new vtkCamera;
   * a light, if LightPosition is (0, 0, 1), as in a new vtkLight. The camera is then placed where
   * vtkRenderer::ResetCamera would put it, and the light above and behind it. Off: these positions
   * are used as given. Default is on.
   */
  vtkSetMacro(AutomaticPlacement, vtkTypeBool);
  vtkGetMacro(AutomaticPlacement, vtkTypeBool);
  vtkBooleanMacro(AutomaticPlacement, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Camera by VTK's conventions, in world coordinates. Defaults are those of vtkCamera: position
   * (0, 0, 1), focal point (0, 0, 0), view up (0, 1, 0). See also AutomaticPlacement.
   */
  vtkSetVector3Macro(CameraPosition, double);
  vtkGetVector3Macro(CameraPosition, double);
  vtkSetVector3Macro(CameraFocalPoint, double);
  vtkGetVector3Macro(CameraFocalPoint, double);
  vtkSetVector3Macro(CameraViewUp, double);
  vtkGetVector3Macro(CameraViewUp, double);
  ///@}

  ///@{
  /**
   * Vertical view angle of a perspective camera [degrees], between 0 and 180. It is used only with
   * RestrictToView and for a camera that is placed automatically. Default is 30.
   */
  vtkSetMacro(CameraViewAngle, double);
  vtkGetMacro(CameraViewAngle, double);
  ///@}

  ///@{
  /**
   * Whether the projection is parallel: all rays have the direction of the view. Default is off.
   */
  vtkSetMacro(CameraParallelProjection, vtkTypeBool);
  vtkGetMacro(CameraParallelProjection, vtkTypeBool);
  vtkBooleanMacro(CameraParallelProjection, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Half the height of the picture of a parallel camera [length]. It is used only with
   * RestrictToView. Default is 1.
   */
  vtkSetMacro(CameraParallelScale, double);
  vtkGetMacro(CameraParallelScale, double);
  ///@}

  ///@{
  /**
   * Aspect ratio of the picture, width over height. It is used only with RestrictToView. Default is
   * 1.
   */
  vtkSetMacro(CameraAspectRatio, double);
  vtkGetMacro(CameraAspectRatio, double);
  ///@}

  ///@{
  /**
   * Whether the camera is optimised as well (Section 3.4): it moves on the sphere around
   * CameraFocalPoint. A move is kept if more can be seen with the extinction that is then optimised
   * for it. The field data "CameraPosition" and "CameraViewUp" have the final camera;
   * "StartVisibilityScore" has the score that optimising the extinction alone achieved, if it had
   * to be computed. Takes several times as long. Default is off.
   */
  vtkSetMacro(OptimizeViewpoint, vtkTypeBool);
  vtkGetMacro(OptimizeViewpoint, vtkTypeBool);
  vtkBooleanMacro(OptimizeViewpoint, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The function that guides the camera. ATTAINABLE: an upper bound of what an optimised extinction
   * could show from each view, searched on all sides; the extinction is optimised once, for the
   * view with the highest bound, and the field data "Proof" say what was proved. PROXY: the
   * majorant times importance, regardless of what hides it. COUPLED: the extinction that was
   * optimised last. Default is ATTAINABLE.
   */
  LIMPID_SET_CLAMPED(ViewpointGuide, int, PROXY, ATTAINABLE);
  vtkGetMacro(ViewpointGuide, int);
  ///@}

  ///@{
  /**
   * Names of the point arrays that are written, see above. Others are not computed, which takes
   * less memory and time. Scores do not depend on it. A name that is none of them is an error of
   * the run. Default is all.
   */
  void AddResultArray(const char* name);
  void RemoveAllResultArrays();
  int GetNumberOfResultArrays();
  const char* GetResultArray(int index);
  ///@}

  ///@{
  /**
   * Whether a run starts from the result of the previous one, if the size of the image is
   * unchanged. This is faster while a camera moves or time advances, but results may depend on
   * previous runs. Joint mode only. Default is off.
   */
  vtkSetMacro(WarmStart, vtkTypeBool);
  vtkGetMacro(WarmStart, vtkTypeBool);
  vtkBooleanMacro(WarmStart, vtkTypeBool);
  ///@}

protected:
  vtkExtinctionOptimizer();
  ~vtkExtinctionOptimizer() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkExtinctionOptimizer(const vtkExtinctionOptimizer&) = delete;
  void operator=(const vtkExtinctionOptimizer&) = delete;

  vtkTypeBool AutomaticPlacement = 1;
  double CameraPosition[3] = { 0, 0, 1 };
  double CameraFocalPoint[3] = { 0, 0, 0 };
  double CameraViewUp[3] = { 0, 1, 0 };
  double CameraViewAngle = 30;
  vtkTypeBool CameraParallelProjection = 0;
  double CameraParallelScale = 1;
  double CameraAspectRatio = 1;
  vtkTypeBool OptimizeViewpoint = 0;
  int ViewpointGuide = ATTAINABLE;
  vtkTypeBool WarmStart = 0;
  std::set<std::string> ResultArrays;

  void Optimize(vtkInformationVector** inputVector, vtkImageData* output, vtkTable* convergence,
    vtkTable* structures);

  int RequestOfMesh(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  struct Internals; // hides core types from this header
  std::unique_ptr<Internals> State;
};

#endif
