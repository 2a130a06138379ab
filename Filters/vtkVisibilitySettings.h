// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkVisibilitySettings
 * @brief   what is to be seen in a scene, and how that is computed
 *
 * The weights of Eq. (21) in [HG24], where importance comes from, the light, and the solver.
 * vtkExtinctionOptimizer, vtkViewpointSearch and vtkTransmittanceVolumeMapper each own one, as a
 * vtkVolume owns a vtkVolumeProperty, and have methods of the same names, which pass their values
 * on to it. Two owners can share one:
 * mapper->SetVisibilitySettings(filter->GetVisibilitySettings()).
 *
 * A value outside of the range that a property has is moved to the nearer end of it, with a
 * warning, and GetNameMinValue and GetNameMaxValue tell the ends, as those of vtkSetClampMacro do.
 *
 * Defaults are those of the preset "Default", see SetPreset. Some depend on the owner:
 * vtkTransmittanceVolumeMapper has ScalarComponent UNDECIDED, see there, and RestrictToView on;
 * filters have TemporalCoherence 0, so that a result does not depend on what ran before;
 * vtkViewpointSearch has MaximumIterations 1 and Smoothness 0, as six sweeps more for every
 * direction hardly change its score. vtkViewpointSearch uses the weights and the solver only where
 * it optimises for every view, with a light of its own for each and with RestrictToView off.
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
   * Settings for a purpose, under one name, in capital letters or not: weights, ClearingThreshold,
   * ProtectImportance,
   * Emphasis, ImportanceSmoothing, Smoothness and TemporalCoherence, which filters keep at 0.
   * "Default": what hides something important is cleared, and what is important stays whole. "Keep
   * Context": only what hides much is cleared. "Strong Reveal": what is important becomes a veil
   * where it hides something as important. "Paper": the values of [HG24]. Another name is an error
   * and changes nothing. Returns whether there is such a preset.
   */
  bool SetPreset(const char* name);
  static int GetNumberOfPresets();
  static const char* GetPresetName(int index);
  ///@}

  ///@{
  /**
   * Component of the scalar array that is the scalar field, from 0 on; -1: the length of the tuple,
   * which for a single component is its value. Default is -1.
   */
  vtkSetMacro(ScalarComponent, int);
  vtkGetMacro(ScalarComponent, int);
  ///@}

  ///@{
  /**
   * Component of the importance array, from 0 on; -1: the length of the tuple, which for a single
   * component is its value. Default is -1.
   */
  vtkSetMacro(ImportanceComponent, int);
  vtkGetMacro(ImportanceComponent, int);
  ///@}

  ///@{
  /**
   * Whether ImportanceFunction maps the importance array to importance. Off: the array's values
   * are importance, moved into [0, 1]. Default is off.
   */
  vtkSetMacro(UseImportanceFunction, vtkTypeBool);
  vtkGetMacro(UseImportanceFunction, vtkTypeBool);
  vtkBooleanMacro(UseImportanceFunction, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Maps values of the importance array to importance; its values are moved into [0, 1].
   * Default is none.
   */
  virtual void SetImportanceFunction(vtkPiecewiseFunction*);
  vtkGetObjectMacro(ImportanceFunction, vtkPiecewiseFunction);
  ///@}

  ///@{
  /**
   * How what matters is shown. OPTIMIZED: by the extinction that minimises Eq. (21). ORDINARY: by
   * that of the transfer function. The others are what [HG24] compares with in Section 4.3, all
   * scored by the same S: VIOLA_2004 [VKG04] clips what is in front of the most important object of
   * every ray. MARCHESIN_2010 [MMD10] takes a mean colour by importance, in no order; the
   * extinction stays the base, and S is not one of transport. AMENT_2017 [AZD17] thins out what is
   * in front of and behind what is important, for the camera and, apart, for the light; see the
   * properties whose names begin with Ament. vtkViewpointSearch does not ask for it. Default is
   * OPTIMIZED.
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
   * AMENT_2017 only: weight p of the base extinction, which keeps voxels as they are; above zero.
   * Default is 1.
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
   * Share of the visibility that must be at stake before a voxel of the densest matter is cleared:
   * the larger it is, the more context is kept, however dense and large the data are. From it
   * follows p of Eq. (22), delta q / (R mu-max), not below zero. 0: p is RegularizationWeight, as
   * in [HG24]. Default is 3e-3.
   */
  LIMPID_SET_CLAMPED(ClearingThreshold, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(ClearingThreshold, double);
  ///@}

  ///@{
  /**
   * Weight p of the regularisation term, Eq. (22), in normalised coordinates: dimensionless, not
   * below zero. It counts where ClearingThreshold is 0, which becomes so when the weight changes.
   * Default is 1e-3.
   */
  virtual void SetRegularizationWeight(double weight);
  vtkGetMacro(RegularizationWeight, double);
  ///@}

  ///@{
  /**
   * Weight q of the view term, Eq. (23): dimensionless, not below zero; zero leaves the view as it
   * is. Default is 10.
   */
  LIMPID_SET_CLAMPED(ViewWeight, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(ViewWeight, double);
  ///@}

  ///@{
  /**
   * Weight r of the light term, Eq. (24): dimensionless, not below zero; zero leaves the light as
   * it is. Default is 1.
   */
  LIMPID_SET_CLAMPED(LightWeight, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(LightWeight, double);
  ///@}

  ///@{
  /**
   * POINT: the light shines from LightPosition. DIRECTIONAL: parallel rays, from LightPosition
   * towards the camera's focal point. Of the mapper: its own light, see LightSource there.
   * Default is POINT.
   */
  LIMPID_SET_CLAMPED(LightType, int, POINT, DIRECTIONAL);
  vtkGetMacro(LightType, int);
  ///@}

  ///@{
  /**
   * Position of the light in world coordinates. As long as it is (0, 0, 1), as in a new vtkLight,
   * the owner places the light: 50 degrees above and 10 degrees to the right of the camera, as far
   * from its focal point as the camera; but see vtkExtinctionOptimizer::SetAutomaticPlacement.
   * Default is (0, 0, 1).
   */
  vtkSetVector3Macro(LightPosition, double);
  vtkGetVector3Macro(LightPosition, double);
  ///@}

  ///@{
  /**
   * JOINT: one extinction for camera and light, Eqs. (22)-(24). SEPARATE: one for each,
   * Section 4.2; shadows are those of the extinction for the light. Default is JOINT.
   */
  LIMPID_SET_CLAMPED(Mode, int, JOINT, SEPARATE);
  vtkGetMacro(Mode, int);
  ///@}

  ///@{
  /**
   * POLICY: policy sweeps. ADAM: the projected Adam of [HG24], coarse to fine.
   * Default is POLICY.
   */
  LIMPID_SET_CLAMPED(Solver, int, POLICY, ADAM);
  vtkGetMacro(Solver, int);
  ///@}

  ///@{
  /**
   * Most iterations of the policy solver, not below zero. Default is 8.
   */
  LIMPID_SET_CLAMPED(MaximumIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * Iterations of Adam at a quarter, half and the full resolution, not below zero.
   * Default is (32, 32, 64).
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
   * Step length of Adam in units of the majorant, Eq. (25): above 0, at most 1. Default is 0.05.
   */
  vtkSetMacro(LearningRate, double);
  vtkGetMacro(LearningRate, double);
  ///@}

  ///@{
  /**
   * The optimisation stops when the mean change of an iteration is below this share of the
   * majorant, Eq. (25), or below five times this where policy sweeps change the energy by less than
   * a tenth of this share of it; not below zero. Default is 1e-3.
   */
  LIMPID_SET_CLAMPED(Tolerance, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The optimisation for a view stops after this time [s]; zero: no limit. Default is 0.
   */
  LIMPID_SET_CLAMPED(MaximumSeconds, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumSeconds, double);
  ///@}

  ///@{
  /**
   * VOLUME: exact derivative of the volume integral. RAY: Eqs. (19)-(20) as printed, without the
   * weight of the widening rays. Default is VOLUME.
   */
  LIMPID_SET_CLAMPED(Derivative, int, VOLUME, RAY);
  vtkGetMacro(Derivative, int);
  ///@}

  ///@{
  /**
   * Rays per voxel and axis on the slice farthest from the eye, 0.1 to 16. Default is 1.
   */
  LIMPID_SET_CLAMPED(RayDensity, double, 0.1, 16);
  vtkGetMacro(RayDensity, double);
  ///@}

  ///@{
  /**
   * Whether what provably cannot change the result is left out. Default is on.
   */
  vtkSetMacro(SkipUnneeded, vtkTypeBool);
  vtkGetMacro(SkipUnneeded, vtkTypeBool);
  vtkBooleanMacro(SkipUnneeded, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether only what the picture shows counts. Off: the whole image counts. Default is off.
   */
  vtkSetMacro(RestrictToView, vtkTypeBool);
  vtkGetMacro(RestrictToView, vtkTypeBool);
  vtkBooleanMacro(RestrictToView, vtkTypeBool);
  ///@}

  ///@{
  /**
   * For which cameras one extinction is found: the mean of their view terms takes the place of Eq.
   * (23), and scores are means. SINGLE_VIEW: the camera. STEREO_PAIR: the two eyes of a viewer,
   * EyeAngle apart about its focal point. ORBIT: NumberOfViews cameras, equally spaced about the
   * axis of the world that is upwards in the camera's picture, through its focal point, as high
   * and as far away as the camera; vtkExtinctionOptimizer has one at the camera,
   * vtkTransmittanceVolumeMapper in a fixed direction, so that nothing changes while a camera goes
   * round, and leaves a light out that goes with it. One iteration sweeps one camera, and there are
   * MaximumIterations for each. Methods other than OPTIMIZED are for the camera; vtkViewpointSearch
   * does not ask for it. Default is SINGLE_VIEW.
   */
  LIMPID_SET_CLAMPED(Views, int, SINGLE_VIEW, ORBIT);
  vtkGetMacro(Views, int);
  ///@}

  ///@{
  /**
   * Cameras of an ORBIT, 1 to 360. Default is 8.
   */
  LIMPID_SET_CLAMPED(NumberOfViews, int, 1, 360);
  vtkGetMacro(NumberOfViews, int);
  ///@}

  ///@{
  /**
   * Between the eyes of a STEREO_PAIR, as in vtkCamera [degrees], 0 to below 180. Default is 2.
   */
  vtkSetMacro(EyeAngle, double);
  vtkGetMacro(EyeAngle, double);
  ///@}

  ///@{
  /**
   * How much of the important structures stays where it is: a voxel of importance g keeps at least
   * this share of g times its base extinction, 0 to 1. 0: what is important may be removed to show
   * what is behind it, as in [HG24], which tears holes into it; 1: what has importance 1 stays
   * whole. Default is 1.
   */
  LIMPID_SET_CLAMPED(ProtectImportance, double, 0, 1);
  vtkGetMacro(ProtectImportance, double);
  ///@}

  ///@{
  /**
   * How far above its base extinction matter may become, as a share of the way to the majorant of
   * Eq. (25), 0 to 1. 0: matter never becomes thicker than in the data, so that what is seen is the
   * data's own, and VisibleFraction does not fall where only the view counts (LightWeight 0); 1: it
   * may become as thick as the thickest, as in [HG24]. Default is 0.
   */
  LIMPID_SET_CLAMPED(Emphasis, double, 0, 1);
  vtkGetMacro(Emphasis, double);
  ///@}

  ///@{
  /**
   * MEDIAN: before the optimisation, importance loses what one to three points have alone: a
   * centre-weighted median of 3 x 3 x 3 points, see cuda/energy/Despeckle.h. Noise in the
   * importance makes specks in the picture. Scores, fractions and MissedImportance are always those
   * of the importance as given. AS_GIVEN: nothing is smoothed, as in [HG24]. Default is MEDIAN.
   */
  LIMPID_SET_CLAMPED(ImportanceSmoothing, int, AS_GIVEN, MEDIAN);
  vtkGetMacro(ImportanceSmoothing, int);
  ///@}

  ///@{
  /**
   * How strongly what the optimisation changes is drawn to what it changes beside that: a share of
   * the weights of view and light, 0 to 10, see cuda/optimize/Smoothing.h. Near the optimum, six
   * further sweeps do it. 0: not at all, as in [HG24]. Default is 0.2.
   */
  LIMPID_SET_CLAMPED(Smoothness, double, 0, 10);
  vtkGetMacro(Smoothness, double);
  ///@}

  ///@{
  /**
   * How strongly a result is drawn to the last one of the same owner, so that it does not flicker
   * while a camera moves or time goes on: what was clear or opaque stays so where less than this
   * share of the weights of view and light is to be gained. The last result is taken as a change of
   * its base extinction; one for another box or for other settings does not count, one for other
   * data 0.4 times, and less and less does one for a camera or a light in another direction, up to
   * 20 degrees away. Results depend on what was before, then. 0: they do not, as in [HG24]. Default
   * is 0.2, and 0 for filters. vtkViewpointSearch has no last result.
   */
  LIMPID_SET_CLAMPED(TemporalCoherence, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(TemporalCoherence, double);
  ///@}

  ///@{
  /**
   * AUTO: the fastest that works here, which the owner's results name. CPU, CUDA: this or an
   * error. Default is AUTO.
   */
  LIMPID_SET_CLAMPED(Backend, int, AUTO, CUDA);
  vtkGetMacro(Backend, int);
  ///@}

  /**
   * Also that of the importance function.
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
