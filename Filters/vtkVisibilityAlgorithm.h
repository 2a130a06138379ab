// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkVisibilityAlgorithm
 * @brief   a filter that asks how much of the important structures in an image can be seen
 *
 * What such filters have in common: the scene, that is an image with extinction and importance,
 * the weights of Eq. (21) in [HG24], and what computes.
 *
 * Input port 0: vtkImageData with arrays of its points or its cells (cell arrays are averaged to
 * the points first), of any numeric type, chosen with SetInputArrayToProcess:
 *   index 0: scalar field; default: the active scalars;
 *   index 1: importance, dimensionless; default, and what the name "(Automatic)" stands for:
 *     "Importance", or if there is none, the scalar field with ImportanceFunction, or else with
 *     what is assumed: its largest values are important, in a ramp from their 95th to their 99th
 *     percentile, or above where these are in noise, and there is a warning;
 *   index 2: extinction [1/length], where a filter is told to take one; default: "BaseExtinction".
 * Points with a NaN or an infinite value and blanked points are empty: they have neither extinction
 * nor importance. So are the points of blanked cells for arrays of points; in arrays of cells,
 * blanked cells count as zero. Blanked are, by "vtkGhostType", hidden and duplicate points, and
 * hidden, duplicate and refined cells.
 *
 * Any point may hide any other, so with several processes each one needs the whole image. Where a
 * source cannot give it to them, there is an error.
 *
 * Composite data are refused: what hides a structure may lie in another block.
 *
 * The unit of length is that of the input's spacing.
 *
 * @sa vtkExtinctionOptimizer vtkViewpointSearch
 */

#ifndef vtkVisibilityAlgorithm_h
#define vtkVisibilityAlgorithm_h

#include "vtkImageAlgorithm.h"
#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"        // for the settings
#include "vtkVisibilitySettings.h"  // for the methods that are passed on

class vtkPiecewiseFunction;

class VTKLIMPIDFILTERS_EXPORT vtkVisibilityAlgorithm : public vtkImageAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkVisibilityAlgorithm, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ExtinctionSources
  {
    OPACITY_FUNCTION = 0,
    ARRAY = 1
  };

  LIMPID_VISIBILITY_CHOICES();

  ///@{
  /**
   * Importance, weights, light and solver, see vtkVisibilitySettings; null changes nothing.
   */
  virtual void SetVisibilitySettings(vtkVisibilitySettings* settings);
  vtkVisibilitySettings* GetVisibilitySettings() { return this->Settings; }
  ///@}

  /// The methods of vtkVisibilitySettings, documented there.
  LIMPID_FORWARD_VISIBILITY_SETTINGS();

  /**
   * Settings for a purpose, see vtkVisibilitySettings::SetPreset; TemporalCoherence becomes 0.
   */
  virtual bool SetPreset(const char* name);

  ///@{
  /**
   * Where the base extinction comes from: OPACITY_FUNCTION of the scalar field, or ARRAY 2.
   * Default is OPACITY_FUNCTION.
   */
  LIMPID_SET_CLAMPED(ExtinctionSource, int, OPACITY_FUNCTION, ARRAY);
  vtkGetMacro(ExtinctionSource, int);
  ///@}

  ///@{
  /**
   * Opacity of the scalar field on one unit distance, as in vtkVolumeProperty. The base extinction
   * is -ln(1 - opacity) / unit distance, the opacity not above 1 - 1e-6. None or one without
   * points: a straight line from 0 to 1 over the range of the scalar field. The extinction of its
   * largest value is the majorant of Eq. (25), whatever values the data have. Default is none.
   */
  virtual void SetScalarOpacityFunction(vtkPiecewiseFunction*);
  vtkGetObjectMacro(ScalarOpacityFunction, vtkPiecewiseFunction);
  ///@}

  ///@{
  /**
   * Distance on which the opacity function holds [length]. Zero: diagonal of the image over the
   * cube root of the number of its cells, as ParaView's volume representation has it. Default is 0.
   */
  vtkSetMacro(ScalarOpacityUnitDistance, double);
  vtkGetMacro(ScalarOpacityUnitDistance, double);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkVisibilityAlgorithm();
  ~vtkVisibilityAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*) override;

  struct SceneReader; // from image and properties to the core's scene: no core type shows here

  vtkSmartPointer<vtkVisibilitySettings> Settings;
  int ExtinctionSource = OPACITY_FUNCTION;
  vtkPiecewiseFunction* ScalarOpacityFunction = nullptr;
  double ScalarOpacityUnitDistance = 0;

private:
  vtkVisibilityAlgorithm(const vtkVisibilityAlgorithm&) = delete;
  void operator=(const vtkVisibilityAlgorithm&) = delete;
};

#endif
