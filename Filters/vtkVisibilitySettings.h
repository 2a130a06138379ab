// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkVisibilitySettings
 * @brief   settings that define what should be visible in a scene, and how it is computed
 *
 * The weights of Eq. (21) in [HG24], the source of importance, the light, and the solver.
 * vtkExtinctionOptimizer, vtkViewpointSearch and vtkTransmittanceVolumeMapper each own one, as a
 * vtkVolume owns a vtkVolumeProperty, and forward methods of the same names to it. Two owners can
 * share one: mapper->SetVisibilitySettings(filter->GetVisibilitySettings()).
 *
 * A value outside of the range of a property is clamped to it, with a warning. GetNameMinValue and
 * GetNameMaxValue return the range, as those of vtkSetClampMacro do.
 *
 * Defaults are those of the preset "Default", see SetPreset. Some depend on the owner.
 * vtkTransmittanceVolumeMapper has ScalarComponent UNDECIDED, see there, and RestrictToView on.
 * Filters have TemporalCoherence 0, so that results do not depend on earlier runs.
 * vtkViewpointSearch has MaximumIterations 1 and Smoothness 0, since six more sweeps for every
 * direction hardly change its score. It uses the weights and the solver only if it optimises for
 * every view, with one light per view and RestrictToView off.
 *
 * @sa vtkVisibilityAlgorithm vtkTransmittanceVolumeMapper
 */

#ifndef vtkVisibilitySettings_h
#define vtkVisibilitySettings_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkObject.h"
#include "vtkVisibilitySettingsMacros.h" // for the choices

class vtkPiecewiseFunction;

class VTKLIMPIDFILTERS_EXPORT vtkVisibilitySettings : public vtkObject
{
public:
  static vtkVisibilitySettings* New();
  vtkTypeMacro(vtkVisibilitySettings, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  LIMPID_VISIBILITY_CHOICES();

  ///@{
  /**
   * Applies a preset by its name (case-insensitive). It sets the weights, ClearingThreshold,
   * ProtectImportance, Emphasis, ImportanceSmoothing, Smoothness and TemporalCoherence; filters
   * keep the last at 0. "Default" clears what hides important structures and keeps these whole.
   * "Keep Context" clears only what hides much. "Strong Reveal" makes important structures
   * translucent where they hide others that are as important. "Paper" has the values of [HG24]. An
   * unknown name is an error and changes nothing. Returns whether there is such a preset.
   */
  bool SetPreset(const char* name);
  static int GetNumberOfPresets();
  static const char* GetPresetName(int index);
  ///@}

  ///@{
  /**
   * Component of the scalar array that is the scalar field, counted from 0; -1: the magnitude of
   * the tuple, which for a single component is its value. Default is -1.
   */
  vtkSetMacro(ScalarComponent, int);
  vtkGetMacro(ScalarComponent, int);
  ///@}

  ///@{
  /**
   * Component of the importance array, counted from 0; -1: the magnitude of the tuple, which for a
   * single component is its value. Default is -1.
   */
  vtkSetMacro(ImportanceComponent, int);
  vtkGetMacro(ImportanceComponent, int);
  ///@}

  ///@{
  /**
   * Whether ImportanceFunction maps the importance array to importance. Off: the values of the
   * array are the importance, clamped to [0, 1]. Default is off.
   */
  vtkSetMacro(UseImportanceFunction, vtkTypeBool);
  vtkGetMacro(UseImportanceFunction, vtkTypeBool);
  vtkBooleanMacro(UseImportanceFunction, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Function from the values of the importance array to importance; its values are clamped to [0,
   * 1]. Default is none.
   */
  virtual void SetImportanceFunction(vtkPiecewiseFunction*);
  vtkGetObjectMacro(ImportanceFunction, vtkPiecewiseFunction);
  ///@}

  ///@{
  /**
   * Method that computes the extinction. OPTIMIZED minimises Eq. (21). ORDINARY uses the extinction
   * of the transfer function. The others are those that [HG24] compares with in Section 4.3; all
   * are scored by the same S. VIOLA_2004 [VKG04] clips what is in front of the most important
   * object of every ray. MARCHESIN_2010 [MMD10] blends colours as a mean weighted by importance,
   * independent of their order; the extinction is the base extinction, and S does not describe its
   * picture. AMENT_2017 [AZD17] reduces the extinction in front of and behind important structures,
   * for the camera and separately for the light; see the properties whose names begin with Ament.
   * vtkViewpointSearch ignores this property. Default is OPTIMIZED.
   */
  LIMPID_SET_CLAMPED(Method, int, OPTIMIZED, AMENT_2017);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /**
   * AMENT_2017 only: exponent lambda of 1 - g, at least zero. Both weights q and r are multiplied
   * by (1 - g)^(2 lambda), so that voxels of high importance g keep their extinction. Default is 1.
   */
  LIMPID_SET_CLAMPED(AmentExponent, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmentExponent, double);
  ///@}

  ///@{
  /**
   * AMENT_2017 only: weight p of the base extinction, which keeps voxels as they are. It must be
   * above zero; other values are an error of the owner. Default is 1.
   */
  vtkSetMacro(AmentRegularization, double);
  vtkGetMacro(AmentRegularization, double);
  ///@}

  ///@{
  /**
   * AMENT_2017 only: weight q of clearing what hides important structures from the camera, per
   * radius of the image's bounding sphere; at least zero. Default is 100.
   */
  LIMPID_SET_CLAMPED(AmentOccluders, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmentOccluders, double);
  ///@}

  ///@{
  /**
   * AMENT_2017 only: weight r of clearing what lies behind important structures, as seen from the
   * camera, per radius of the image's bounding sphere; at least zero. Default is 0.
   */
  LIMPID_SET_CLAMPED(AmentBackground, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmentBackground, double);
  ///@}

  ///@{
  /**
   * AMENT_2017 only: weight q for the extinction that the light sees, per radius of the image's
   * bounding sphere; at least zero. Default is 100.
   */
  LIMPID_SET_CLAMPED(AmentLightOccluders, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmentLightOccluders, double);
  ///@}

  ///@{
  /**
   * AMENT_2017 only: weight r for the extinction that the light sees, per radius of the image's
   * bounding sphere; at least zero. Default is 0.
   */
  LIMPID_SET_CLAMPED(AmentLightBackground, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmentLightBackground, double);
  ///@}

  ///@{
  /**
   * AMENT_2017 only: number of passes that smooth the share of extinction that is kept, in [0,
   * 100]. Default is 1.
   */
  LIMPID_SET_CLAMPED(AmentSmoothing, int, 0, 100);
  vtkGetMacro(AmentSmoothing, int);
  ///@}

  ///@{
  /**
   * Share of the visibility that must be at stake before a voxel of the densest matter is cleared.
   * The larger it is, the more context is kept, independent of the density and size of the data. It
   * is delta in the weight p = delta q / (R mu-max) of Eq. (22); at least zero. 0: p is
   * RegularizationWeight, as in [HG24]. Default is 3e-3.
   */
  LIMPID_SET_CLAMPED(ClearingThreshold, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(ClearingThreshold, double);
  ///@}

  ///@{
  /**
   * Weight p of the regularisation term, Eq. (22), in normalised coordinates; dimensionless, at
   * least zero. It is used if ClearingThreshold is 0; setting the weight to another value sets
   * ClearingThreshold to 0. Default is 1e-3.
   */
  virtual void SetRegularizationWeight(double weight);
  vtkGetMacro(RegularizationWeight, double);
  ///@}

  ///@{
  /**
   * Weight q of the view term, Eq. (23); dimensionless, at least zero. Zero: the view is not
   * optimised. Default is 10.
   */
  LIMPID_SET_CLAMPED(ViewWeight, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(ViewWeight, double);
  ///@}

  ///@{
  /**
   * Weight r of the light term, Eq. (24); dimensionless, at least zero. Zero: the lighting is not
   * optimised. Default is 1.
   */
  LIMPID_SET_CLAMPED(LightWeight, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(LightWeight, double);
  ///@}

  ///@{
  /**
   * Kind of light. POINT: it shines from LightPosition. DIRECTIONAL: parallel rays, from
   * LightPosition towards the camera's focal point. For the mapper, these are properties of its own
   * light, see LightSource there. Default is POINT.
   */
  LIMPID_SET_CLAMPED(LightType, int, POINT, DIRECTIONAL);
  vtkGetMacro(LightType, int);
  ///@}

  ///@{
  /**
   * Position of the light in world coordinates. If it is (0, 0, 1), as in a new vtkLight, the owner
   * places the light: 50 degrees above and 10 degrees to the right of the camera, at the camera's
   * distance from its focal point. See also vtkExtinctionOptimizer::SetAutomaticPlacement. Default
   * is (0, 0, 1).
   */
  vtkSetVector3Macro(LightPosition, double);
  vtkGetVector3Macro(LightPosition, double);
  ///@}

  ///@{
  /**
   * JOINT: one extinction for camera and light, Eqs. (22)-(24). SEPARATE: one extinction each,
   * Section 4.2; shadows use the extinction for the light. Default is JOINT.
   */
  LIMPID_SET_CLAMPED(Mode, int, JOINT, SEPARATE);
  vtkGetMacro(Mode, int);
  ///@}

  ///@{
  /**
   * Minimiser. POLICY: policy sweeps. ADAM: the projected Adam of [HG24], from coarse to fine
   * grids. Default is POLICY.
   */
  LIMPID_SET_CLAMPED(Solver, int, POLICY, ADAM);
  vtkGetMacro(Solver, int);
  ///@}

  ///@{
  /**
   * Largest number of iterations of the policy solver, at least zero. Default is 8.
   */
  LIMPID_SET_CLAMPED(MaximumIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * Iterations of Adam at a quarter, half and the full resolution, each at least zero. Default is
   * (32, 32, 64).
   */
  virtual void SetIterationsPerLevel(int quarter, int half, int full);
  virtual void SetIterationsPerLevel(const int iterations[3])
  {
    this->SetIterationsPerLevel(iterations[0], iterations[1], iterations[2]);
  }
  vtkGetVector3Macro(IterationsPerLevel, int);
  ///@}

  ///@{
  /**
   * Step length of Adam in units of the majorant, Eq. (25), in (0, 1]; other values are an error of
   * the owner. Default is 0.05.
   */
  vtkSetMacro(LearningRate, double);
  vtkGetMacro(LearningRate, double);
  ///@}

  ///@{
  /**
   * Tolerance of convergence, at least zero. The optimisation stops if the mean change of an
   * iteration is below this share of the majorant, Eq. (25). It also stops if the mean change is
   * below five times this and a policy sweep changes the energy by less than a tenth of this share
   * of it. Default is 1e-3.
   */
  LIMPID_SET_CLAMPED(Tolerance, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Time limit of the optimisation for a view [s], at least zero. Zero: no limit. Default is 0.
   */
  LIMPID_SET_CLAMPED(MaximumSeconds, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumSeconds, double);
  ///@}

  ///@{
  /**
   * Derivative of the energy. VOLUME: the exact derivative of the volume integral. RAY: Eqs.
   * (19)-(20) as printed, without the weight of diverging rays. Default is VOLUME.
   */
  LIMPID_SET_CLAMPED(Derivative, int, VOLUME, RAY);
  vtkGetMacro(Derivative, int);
  ///@}

  ///@{
  /**
   * Rays per voxel and axis on the slice farthest from the eye, in [0.1, 16]. Default is 1.
   */
  LIMPID_SET_CLAMPED(RayDensity, double, 0.1, 16);
  vtkGetMacro(RayDensity, double);
  ///@}

  ///@{
  /**
   * Whether to skip computations that provably cannot change the result. Default is on.
   */
  vtkSetMacro(SkipUnneeded, vtkTypeBool);
  vtkGetMacro(SkipUnneeded, vtkTypeBool);
  vtkBooleanMacro(SkipUnneeded, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether only what is inside the picture counts. Off: the whole image counts. Default is off.
   */
  vtkSetMacro(RestrictToView, vtkTypeBool);
  vtkGetMacro(RestrictToView, vtkTypeBool);
  vtkBooleanMacro(RestrictToView, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The cameras that share one extinction. The mean of their view terms replaces Eq. (23), and
   * scores are means. SINGLE_VIEW: the camera. STEREO_PAIR: the two eyes of a viewer, EyeAngle
   * apart around the focal point. ORBIT: NumberOfViews cameras around the focal point, at the
   * height and distance of the camera. They are equally spaced about the world axis that points
   * upwards in the camera's picture. For vtkExtinctionOptimizer, one of them is the camera. For
   * vtkTransmittanceVolumeMapper, their directions are fixed, so that the result does not change
   * while the camera orbits, and a light that moves with the camera is ignored. One iteration
   * sweeps one camera, and MaximumIterations is the limit for each of them. Methods other than
   * OPTIMIZED use the camera alone; vtkViewpointSearch ignores this property. Default is
   * SINGLE_VIEW.
   */
  LIMPID_SET_CLAMPED(Views, int, SINGLE_VIEW, ORBIT);
  vtkGetMacro(Views, int);
  ///@}

  ///@{
  /**
   * Number of cameras of an ORBIT, in [1, 360]. Default is 8.
   */
  LIMPID_SET_CLAMPED(NumberOfViews, int, 1, 360);
  vtkGetMacro(NumberOfViews, int);
  ///@}

  ///@{
  /**
   * Angle between the eyes of a STEREO_PAIR, as in vtkCamera [degrees], in [0, 180). Default is 2.
   */
  vtkSetMacro(EyeAngle, double);
  vtkGetMacro(EyeAngle, double);
  ///@}

  ///@{
  /**
   * Share of the important structures that must be kept, in [0, 1]: a voxel of importance g keeps
   * at least this share of g times its base extinction. 0: important structures may be removed to
   * show others behind them, as in [HG24], which tears holes into them. 1: voxels of importance 1
   * keep all of their extinction. Default is 1.
   */
  LIMPID_SET_CLAMPED(ProtectImportance, double, 0, 1);
  vtkGetMacro(ProtectImportance, double);
  ///@}

  ///@{
  /**
   * How far extinction may rise above the base extinction, as a share of the distance to the
   * majorant of Eq. (25), in [0, 1]. 0: extinction never exceeds that of the data, so that nothing
   * is seen that is not in the data, and VisibleFraction never decreases if only the view counts
   * (LightWeight 0). 1: extinction may rise to the majorant, as in [HG24]. Default is 0.
   */
  LIMPID_SET_CLAMPED(Emphasis, double, 0, 1);
  vtkGetMacro(Emphasis, double);
  ///@}

  ///@{
  /**
   * Filter of the importance before the optimisation. MEDIAN: a centre-weighted median of 3 x 3 x 3
   * points removes importance that only one to three neighbouring points have, see
   * cuda/energy/Despeckle.h. Otherwise, noise in the importance causes specks in the picture.
   * Scores, fractions and MissedImportance always use the importance as given. AS_GIVEN: no filter,
   * as in [HG24]. Default is MEDIAN.
   */
  LIMPID_SET_CLAMPED(ImportanceSmoothing, int, AS_GIVEN, MEDIAN);
  vtkGetMacro(ImportanceSmoothing, int);
  ///@}

  ///@{
  /**
   * Weight of smoothing the changes of extinction between neighbouring voxels, as a share of the
   * weights of view and light, in [0, 10]; see cuda/optimize/Smoothing.h. It takes six further
   * sweeps near the optimum. 0: no smoothing, as in [HG24]. Default is 0.2.
   */
  LIMPID_SET_CLAMPED(Smoothness, double, 0, 10);
  vtkGetMacro(Smoothness, double);
  ///@}

  ///@{
  /**
   * Weight of the pull to the previous result of this owner, as a share of the weights of view and
   * light; at least zero. It avoids flicker while a camera moves or time advances: what was clear
   * or opaque stays so if less than this share is to be gained. The reference is the previous
   * result as a change of its base extinction. It is not used for another box or other settings, it
   * counts 0.4 times for other data, and it counts less for a camera or a light in another
   * direction, down to nothing at 20 degrees. With this, results depend on earlier ones. 0: they do
   * not, as in [HG24]. Default is 0.2, and 0 for filters. vtkViewpointSearch has no previous
   * result.
   */
  LIMPID_SET_CLAMPED(TemporalCoherence, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(TemporalCoherence, double);
  ///@}

  ///@{
  /**
   * Where to compute. AUTO: the fastest backend that works on this machine; results of the owner
   * name it. CPU, CUDA: this backend, or an error if it is unavailable. Default is AUTO.
   */
  LIMPID_SET_CLAMPED(Backend, int, AUTO, CUDA);
  vtkGetMacro(Backend, int);
  ///@}

  /**
   * Includes the modification time of the importance function.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkVisibilitySettings();
  ~vtkVisibilitySettings() override;

private:
  vtkVisibilitySettings(const vtkVisibilitySettings&) = delete;
  void operator=(const vtkVisibilitySettings&) = delete;

  int ScalarComponent = -1;
  int ImportanceComponent = -1;
  vtkTypeBool UseImportanceFunction = 0;
  vtkPiecewiseFunction* ImportanceFunction = nullptr;
  int Method = OPTIMIZED;
  double AmentExponent = 1;
  double AmentRegularization = 1;
  double AmentOccluders = 100;
  double AmentBackground = 0;
  double AmentLightOccluders = 100;
  double AmentLightBackground = 0;
  int AmentSmoothing = 1;
  int LightType = POINT;
  double LightPosition[3] = { 0, 0, 1 };
  int Mode = JOINT;
  int Solver = POLICY;
  int MaximumIterations = 8;
  int IterationsPerLevel[3] = { 32, 32, 64 };
  double LearningRate = 0.05;
  double Tolerance = 1e-3;
  double MaximumSeconds = 0;
  int Derivative = VOLUME;
  double RayDensity = 1;
  vtkTypeBool SkipUnneeded = 1;
  vtkTypeBool RestrictToView = 0;
  int Views = SINGLE_VIEW;
  int NumberOfViews = 8;
  double EyeAngle = 2;
  int Backend = AUTO;

  // The values of the preset "Default".
  double ClearingThreshold = 0;
  double RegularizationWeight = 0;
  double ViewWeight = 0;
  double LightWeight = 0;
  double ProtectImportance = 0;
  double Emphasis = 0;
  int ImportanceSmoothing = AS_GIVEN;
  double Smoothness = 0;
  double TemporalCoherence = 0;
};

#endif
