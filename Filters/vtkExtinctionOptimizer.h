// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkExtinctionOptimizer
 * @brief   find the extinction field that lets important regions be seen
 *
 * Minimises the energy of Eq. (21) in [HG24] over the extinction at every point of an image, seen
 * from one camera and lit by one light.
 *
 * Input port 0: vtkImageData, see vtkVisibilityAlgorithm; array 2, the base extinction, only with
 * ExtinctionSource ARRAY. The array "Opacity" is made for ScalarOpacityUnitDistance.
 *
 * Output port 0: vtkImageData, a shallow copy of the input with float point arrays
 *   "Extinction"         optimised extinction for the camera, joint mode: and light [1/length],
 *   "LightExtinction"    separate mode only: optimised extinction for the light [1/length],
 *   "Opacity"            1 - exp(-Extinction * unit distance), for stock volume rendering,
 *   "BaseExtinction"     the extinction that the optimisation started from [1/length],
 *   "Importance"         the importance that was used [0, 1],
 *   "Transmittance"      camera to point through Extinction [0, 1],
 *   "LightTransmittance" light to point [0, 1],
 *   "MissedImportance"   of the importance, what cannot be seen: less the share of its matter that
 *                        was kept and whose light reaches the camera; 0 without matter [0, 1],
 * an input array of the same name is replaced, with a warning; and field data with one tuple each:
 * "VisibilityScore" and "BaseVisibilityScore" (S of Eq. (32), [length^2]), "VisibleFraction" and
 * "BaseVisibleFraction" (of the important matter in the data, the share whose light reaches the
 * camera, [0, 1]), "SacrificedFraction" (the share that was removed, [0, 1]), "Energy",
 * "Iterations", "Settled" (1: another iteration would change next to nothing; 0: they ended at a
 * limit), "Seconds", "Backend", "CameraPosition", "CameraFocalPoint", "CameraViewUp",
 * "LightPosition", "ScalarOpacityUnitDistance" (all as used), and with OptimizeViewpoint
 * "StartVisibilityScore" and "StartVisibleFraction" (of the extinction alone, if that had to be
 * found), "HighestAttainableFraction" (of all views that were looked from) and "Proof" (what was
 * proved of the view, in a sentence; both with the guide ATTAINABLE). "AttainableFraction",
 * "AttainableScore" and "AttainableLightScore" are what no extinction within the bounds could
 * exceed; 0 for other methods than OPTIMIZED, the last also for a light without weight.
 *
 * Output port 1: vtkTable, one row per iteration.
 *
 * After an error the outputs are empty; after an abort output 0 is the input as it came.
 * An image without volume (a slice, a row, a point) keeps its base extinction, with a warning.
 *
 * Processes of MPI that are each asked for a piece (in ParaView they are) optimise the image
 * together: each asks its input for that piece and a layer of neighbours' cells, and the result has
 * the bits of one process. An error or an abort on one of them is one of all. What they cannot do
 * together yet, each does with the whole image, and keeps its piece: the methods but OPTIMIZED,
 * OptimizeViewpoint, and the backend CUDA.
 *
 * @sa vtkVisibilityAlgorithm vtkViewpointSearch vtkOcclusionPhantom
 */

#ifndef vtkExtinctionOptimizer_h
#define vtkExtinctionOptimizer_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkVisibilityAlgorithm.h"

#include <memory> // for the hidden core

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
   * The table on the Convergence output: iteration, level, energies, seconds, and score and
   * fractions of every iteration. These are always of the importance as given: with
   * ImportanceSmoothing, or without a view weight, they are those of the best so far.
   */
  vtkTable* GetConvergence();

  ///@{
  /**
   * Whether the filter places what nobody has placed: the camera as long as CameraPosition is
   * (0, 0, 1) and CameraFocalPoint (0, 0, 0), as in a new vtkCamera, and the light as long as
   * LightPosition is (0, 0, 1), as in a new vtkLight. The camera then stands where
   * vtkRenderer::ResetCamera would put it, the light above and behind it. Off: these positions are
   * taken as they are. Default is on.
   */
  vtkSetMacro(AutomaticPlacement, vtkTypeBool);
  vtkGetMacro(AutomaticPlacement, vtkTypeBool);
  vtkBooleanMacro(AutomaticPlacement, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Camera by VTK's conventions, in world coordinates. Defaults are those of vtkCamera: position
   * (0, 0, 1), focal point (0, 0, 0), view up (0, 1, 0), but see AutomaticPlacement.
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
   * Vertical opening of a perspective camera [degrees]. Matters with RestrictToView only, and for
   * a camera that is placed automatically. Default is 30.
   */
  vtkSetMacro(CameraViewAngle, double);
  vtkGetMacro(CameraViewAngle, double);
  ///@}

  ///@{
  /**
   * Whether all rays run along the view direction. Default is off.
   */
  vtkSetMacro(CameraParallelProjection, vtkTypeBool);
  vtkGetMacro(CameraParallelProjection, vtkTypeBool);
  vtkBooleanMacro(CameraParallelProjection, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Half the height of the picture of a parallel camera [length]. Matters with RestrictToView
   * only. Default is 1.
   */
  vtkSetMacro(CameraParallelScale, double);
  vtkGetMacro(CameraParallelScale, double);
  ///@}

  ///@{
  /**
   * Width of the picture over its height. Matters with RestrictToView only. Default is 1.
   */
  vtkSetMacro(CameraAspectRatio, double);
  vtkGetMacro(CameraAspectRatio, double);
  ///@}

  ///@{
  /**
   * Whether the camera is optimised, too (Section 3.4): it moves on the sphere round
   * CameraFocalPoint, and a move is kept if more can be seen with the extinction that is then
   * optimised for it. The field data "CameraPosition", "CameraViewUp" tell where it came to, and
   * "StartVisibilityScore" what the extinction alone achieved, if that had to be found. Several
   * times slower.
   * Default is off.
   */
  vtkSetMacro(OptimizeViewpoint, vtkTypeBool);
  vtkGetMacro(OptimizeViewpoint, vtkTypeBool);
  vtkBooleanMacro(OptimizeViewpoint, vtkTypeBool);
  ///@}

  ///@{
  /**
   * What tells which way the camera is to go. ATTAINABLE: what an extinction of its own could show
   * from each view at most, looked for on all sides; the extinction is optimised once, where that
   * is highest, and the field data "Proof" say what was proved. PROXY: the majorant times
   * importance, whatever hides it. COUPLED: the extinction that was optimised last. Default is
   * ATTAINABLE.
   */
  LIMPID_SET_CLAMPED(ViewpointGuide, int, PROXY, ATTAINABLE);
  vtkGetMacro(ViewpointGuide, int);
  ///@}

  ///@{
  /**
   * Whether a run starts from the result of the last one, if the size of the image is the same:
   * faster while a camera moves or time goes on, but the result may depend on what was before.
   * Joint mode only. Default is off.
   */
  vtkSetMacro(WarmStart, vtkTypeBool);
  vtkGetMacro(WarmStart, vtkTypeBool);
  vtkBooleanMacro(WarmStart, vtkTypeBool);
  ///@}

protected:
  vtkExtinctionOptimizer();
  ~vtkExtinctionOptimizer() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
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

  void Optimize(vtkInformationVector** inputVector, vtkImageData* output, vtkTable* convergence);

  struct Internals; // speaks to the core, so that no core type shows here
  std::unique_ptr<Internals> State;
};

#endif
