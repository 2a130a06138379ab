// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkVisibilityAlgorithm
 * @brief   base class of filters that compute how much of the important structures can be seen
 *
 * Has the common inputs of these filters: the scene, which is an image with extinction and
 * importance; the weights of Eq. (21) in [HG24]; and the backend.
 *
 * Input port 0: vtkImageData with point or cell arrays of any numeric type, chosen with
 * SetInputArrayToProcess. Cell arrays are averaged to the points first. In a single process also
 * other data with cells that have a volume: they are sampled at the points of an image, see
 * SampleData.
 *   index 0: scalar field; default: the active scalars;
 *   index 1: importance, dimensionless; default: "(Automatic)", which is the array "Importance".
 *     If there is none, it is the scalar field mapped by ImportanceFunction. Without that, the
 *     largest scalars are assumed to be important, with a warning: importance rises from their
 *     95th to their 99th percentile, or above these if they lie in noise;
 *   index 2: extinction [1/length], for filters that use one; default: "BaseExtinction";
 *   index 3: labels of structures, whole numbers, which replace the importance, see AddStructure;
 *     default: none. Of cells, a point has the label of most cells around it. Their importance is
 *     never smoothed, see ImportanceSmoothing;
 *   index 4: reference extinction [1/length], for ReferencePull; default: none.
 *
 * Points with a NaN or an infinite value and blanked points are empty: they have neither extinction
 * nor importance. For point arrays, the points of blanked cells are empty, too; in cell arrays,
 * blanked cells count as zero. By "vtkGhostType", hidden and duplicate points are blanked, and
 * hidden, duplicate and refined cells.
 *
 * Any point may hide any other, so with several processes each one needs the whole image. A source
 * that cannot provide it is an error.
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
   * The settings of importance, weights, light and solver. Null changes nothing.
   */
  virtual void SetVisibilitySettings(vtkVisibilitySettings* settings);
  vtkVisibilitySettings* GetVisibilitySettings() { return this->Settings; }
  ///@}

  /// The methods of vtkVisibilitySettings, see there.
  LIMPID_FORWARD_VISIBILITY_SETTINGS();

  /**
   * Applies a preset, see vtkVisibilitySettings::SetPreset, but sets TemporalCoherence to 0.
   */
  virtual bool SetPreset(const char* name);

  ///@{
  /**
   * Source of the base extinction: OPACITY_FUNCTION of the scalar field, or ARRAY, which is array
   * 2. Default is OPACITY_FUNCTION.
   */
  LIMPID_SET_CLAMPED(ExtinctionSource, int, OPACITY_FUNCTION, ARRAY);
  vtkGetMacro(ExtinctionSource, int);
  ///@}

  ///@{
  /**
   * Opacity over one unit distance as a function of the scalar field, as in vtkVolumeProperty. The
   * base extinction is -ln(1 - opacity) / unit distance, where the opacity is at most 1 - 1e-6.
   * Without a function, or if it has no points, opacity rises linearly from 0 to 1 over the range
   * of the scalar field. The extinction of the function's largest value is the majorant of Eq.
   * (25), whichever values occur in the data. Default is none.
   */
  virtual void SetScalarOpacityFunction(vtkPiecewiseFunction*);
  vtkGetObjectMacro(ScalarOpacityFunction, vtkPiecewiseFunction);
  ///@}

  ///@{
  /**
   * Unit distance of the opacity function [length], at least zero. Zero: the diagonal of the image
   * over the cube root of its number of cells, as in ParaView's volume representation. Default is
   * 0.
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

  struct SceneReader; // converts image and properties to the core's scene; hides core types from
                      // this header

  vtkSmartPointer<vtkVisibilitySettings> Settings;
  int ExtinctionSource = OPACITY_FUNCTION;
  vtkPiecewiseFunction* ScalarOpacityFunction = nullptr;
  double ScalarOpacityUnitDistance = 0;

private:
  vtkVisibilityAlgorithm(const vtkVisibilityAlgorithm&) = delete;
  void operator=(const vtkVisibilityAlgorithm&) = delete;
};

#endif
