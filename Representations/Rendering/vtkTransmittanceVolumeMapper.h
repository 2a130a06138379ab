// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkTransmittanceVolumeMapper
 * @brief   draw a volume so that its important regions are seen
 *
 * A volume mapper, to be used with vtkVolume::SetMapper. It finds the extinction of Eq. (21) in
 * [HG24] for the camera and a light of the view in which it draws, and renders with it by Eqs.
 * (1)-(6): single scattering, with the transmittance of the light from a shadow volume. It computes
 * on the CPU, with all cores.
 *
 * Input port 0: vtkImageData with an array of its points or its cells (cell arrays are averaged to
 * the points first), of any numeric type, chosen as for all volume mappers with SelectScalarArray
 * and SetScalarMode. Points with a NaN or an infinite value and hidden (blanked) points are empty.
 * Extents, spacing and direction matrices of either handedness are honoured. A second array has the
 * importance, see SetImportanceArray.
 *
 * Colours, opacities and the unit distance are those of the first component of vtkVolumeProperty;
 * scalars are always interpolated linearly. The volume is lit if Shadows or the property's Shade is
 * on: with Shadows by single scattering with the transmittance of the light, with Shade alone by
 * the same with a transmittance of 1. With both off it emits and absorbs light, and without
 * optimization that is the picture of VTK's own mappers without shading. Gradient opacity,
 * two-dimensional transfer functions, and blend modes other than composite are not available: there
 * is a warning.
 *
 * Optimization states belong to renderer and volume: two views of the same volume do not disturb
 * each other. A still frame (the render window's DesiredUpdateRate is below 1) has full resolution,
 * the optimization is run to its end, and it does not depend on what was shown before. A moving
 * frame takes about InteractiveFrameTime: with one pass of the optimization on a grid, shadows on a
 * grid, and a picture on pixels that are as fine as the time allows, and changes ease in.
 *
 * Opaque geometry hides and is hidden correctly. Translucent geometry is drawn by VTK before any
 * volume, so it is right behind the volume only, and volumes that overlap cannot be drawn right;
 * there is a warning for both. Volumes that do not overlap are drawn in the right order if this
 * class draws them; see also SortBackToFront.
 *
 * Clipping planes and cropping make the points outside of them empty; these do not count in the
 * optimization and the score either.
 *
 * With several processes each one has its own piece only, and what crosses from piece to piece is
 * not built yet: there is a warning, and the volume is drawn without optimization and light and has
 * no score.
 *
 * The unit of length is that of the input's spacing, also where the volume is scaled.
 *
 * @sa vtkExtinctionOptimizer
 */

#ifndef vtkTransmittanceVolumeMapper_h
#define vtkTransmittanceVolumeMapper_h

#include "vtkLimpidRenderingModule.h" // for export macro
#include "vtkVolumeMapper.h"

#include <memory> // for the hidden core
#include <string> // for names

class vtkPiecewiseFunction;

class VTKLIMPIDRENDERING_EXPORT vtkTransmittanceVolumeMapper : public vtkVolumeMapper
{
public:
  static vtkTransmittanceVolumeMapper* New();
  vtkTypeMacro(vtkTransmittanceVolumeMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ScalarComponents
  {
    UNDECIDED = -2,
    MAGNITUDE = -1
  };

  enum Methods
  {
    OPTIMIZED = 0,
    ORDINARY = 1,
    VIOLA_2004 = 2,
    MARCHESIN_2010 = 3,
    AMENT_2017 = 4
  };

  enum Optimizations
  {
    OFF = 0,
    ONCE = 1,
    CONTINUOUS = 2
  };

  enum LightSources
  {
    SCENE = 0,
    OWN = 1
  };

  enum LightTypes
  {
    POINT = 0,
    DIRECTIONAL = 1
  };

  enum Modes
  {
    JOINT = 0,
    SEPARATE = 1
  };

  enum Solvers
  {
    POLICY = 0,
    ADAM = 1
  };

  enum Derivatives
  {
    VOLUME = 0,
    RAY = 1
  };

  enum Backends
  {
    AUTO = 0,
    CPU = 1,
    CUDA = 2
  };

  ///@{
  /**
   * Component of the scalar array that is shown; MAGNITUDE: the length of the tuple, which for a
   * single component is its value; UNDECIDED: like MAGNITUDE, but with a warning if there are
   * several components. Default is UNDECIDED.
   */
  vtkSetMacro(ScalarComponent, int);
  vtkGetMacro(ScalarComponent, int);
  ///@}

  ///@{
  /**
   * Name of the array with the importance, dimensionless, or with what ImportanceFunction maps to
   * it. Empty: the array "Importance", or if there is none and UseImportanceFunction is on, the
   * scalar array. Default is empty.
   */
  void SetImportanceArray(const char* name);
  const char* GetImportanceArray() const;
  ///@}

  ///@{
  /**
   * Where the array with the importance is: vtkDataObject::FIELD_ASSOCIATION_POINTS, _CELLS, or
   * _POINTS_THEN_CELLS. Default is FIELD_ASSOCIATION_POINTS_THEN_CELLS.
   */
  vtkSetMacro(ImportanceArrayAssociation, int);
  vtkGetMacro(ImportanceArrayAssociation, int);
  ///@}

  ///@{
  /**
   * Component of the importance array; -1: the length of the tuple, which for a single component
   * is its value. Default is -1.
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
   * How the volume is drawn. OPTIMIZED: see Optimization. ORDINARY: as the transfer functions have
   * it. The others are not available in this version: there is an error, and the volume is drawn
   * as with ORDINARY. Default is OPTIMIZED.
   */
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /**
   * OFF: the extinction of the transfer functions, and the score is that of it. ONCE: optimized
   * for camera and light of the first still frame, and kept until Reset is called or the data
   * change; changed functions and settings are followed. CONTINUOUS: optimized for every frame.
   * Default is CONTINUOUS.
   */
  vtkSetMacro(Optimization, int);
  vtkGetMacro(Optimization, int);
  ///@}

  ///@{
  /**
   * Whether the extinction stays as it is, whatever moves; functions that change are followed.
   * Default is off.
   */
  vtkSetMacro(PauseOptimization, vtkTypeBool);
  vtkGetMacro(PauseOptimization, vtkTypeBool);
  vtkBooleanMacro(PauseOptimization, vtkTypeBool);
  ///@}

  /**
   * Forgets what has been optimized, in all views; with ONCE the next still frame is the first.
   */
  void Reset();

  ///@{
  /**
   * Weight p of the regularisation term, Eq. (22), in normalised coordinates. Not below zero.
   * Default is 1e-3.
   */
  vtkSetMacro(RegularizationWeight, double);
  vtkGetMacro(RegularizationWeight, double);
  ///@}

  ///@{
  /**
   * Weight q of the view term, Eq. (23). Not below zero; zero leaves the view as it is.
   * Default is 10.
   */
  vtkSetMacro(ViewWeight, double);
  vtkGetMacro(ViewWeight, double);
  ///@}

  ///@{
  /**
   * Weight r of the light term, Eq. (24). Not below zero; zero leaves the light as it is.
   * Default is 1.
   */
  vtkSetMacro(LightWeight, double);
  vtkGetMacro(LightWeight, double);
  ///@}

  ///@{
  /**
   * JOINT: one extinction for camera and light, Eqs. (22)-(24). SEPARATE: one for each,
   * Section 4.2; shadows are those of the extinction for the light. Default is JOINT.
   */
  vtkSetMacro(Mode, int);
  vtkGetMacro(Mode, int);
  ///@}

  ///@{
  /**
   * POLICY: policy sweeps. ADAM: the projected Adam of [HG24], coarse to fine.
   * Default is POLICY.
   */
  vtkSetMacro(Solver, int);
  vtkGetMacro(Solver, int);
  ///@}

  ///@{
  /**
   * Most iterations of the policy solver. Default is 8.
   */
  vtkSetMacro(MaximumIterations, int);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * Iterations of Adam at a quarter, half and the full resolution. Default is (32, 32, 64).
   */
  vtkSetVector3Macro(IterationsPerLevel, int);
  vtkGetVector3Macro(IterationsPerLevel, int);
  ///@}

  ///@{
  /**
   * Step length of Adam in units of the largest base extinction. Default is 0.05.
   */
  vtkSetMacro(LearningRate, double);
  vtkGetMacro(LearningRate, double);
  ///@}

  ///@{
  /**
   * Stop when the mean change of an iteration is below this share of the largest base extinction.
   * Default is 1e-3.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Stop the optimization for a view after this time [s]; zero: no limit. Default is 0.
   */
  vtkSetMacro(MaximumSeconds, double);
  vtkGetMacro(MaximumSeconds, double);
  ///@}

  ///@{
  /**
   * VOLUME: exact derivative of the volume integral. RAY: Eqs. (19)-(20) as printed, without the
   * weight of the widening rays. Default is VOLUME.
   */
  vtkSetMacro(Derivative, int);
  vtkGetMacro(Derivative, int);
  ///@}

  ///@{
  /**
   * Rays of the optimization per voxel and axis on the slice farthest from the eye. Default is 1.
   */
  vtkSetMacro(RayDensity, double);
  vtkGetMacro(RayDensity, double);
  ///@}

  ///@{
  /**
   * Whether the optimization leaves out what provably cannot change the result. Default is on.
   */
  vtkSetMacro(SkipUnneeded, vtkTypeBool);
  vtkGetMacro(SkipUnneeded, vtkTypeBool);
  vtkBooleanMacro(SkipUnneeded, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether only what the view shows counts. Off: the whole image counts. Default is on.
   */
  vtkSetMacro(RestrictToView, vtkTypeBool);
  vtkGetMacro(RestrictToView, vtkTypeBool);
  vtkBooleanMacro(RestrictToView, vtkTypeBool);
  ///@}

  ///@{
  /**
   * AUTO: the fastest that works here, named by GetBackendName. CPU, CUDA: this or an error.
   * Default is AUTO.
   */
  vtkSetMacro(Backend, int);
  vtkGetMacro(Backend, int);
  ///@}

  ///@{
  /**
   * Which light casts the shadow and drives the optimization. SCENE: the strongest of the
   * renderer's lights that are switched on, by colour and intensity; other lights are not drawn,
   * and the strength of this one only tells which it is: how bright it is comes from
   * LightIntensity, its tint from its diffuse colour. OWN: LightType and LightPosition.
   * Default is SCENE.
   */
  vtkSetMacro(LightSource, int);
  vtkGetMacro(LightSource, int);
  ///@}

  ///@{
  /**
   * Of the own light. POINT: it shines from LightPosition. DIRECTIONAL: parallel rays, from
   * LightPosition towards the camera's focal point. Default is POINT.
   */
  vtkSetMacro(LightType, int);
  vtkGetMacro(LightType, int);
  ///@}

  ///@{
  /**
   * Position of the own light in world coordinates. As long as it is (0, 0, 1), as in a new
   * vtkLight, the light goes with the camera: 50 degrees above and 10 degrees to the right of it,
   * as far from its focal point. Default is (0, 0, 1).
   */
  vtkSetVector3Macro(LightPosition, double);
  vtkGetVector3Macro(LightPosition, double);
  ///@}

  ///@{
  /**
   * Whether the volume is lit by single scattering and casts shadows on itself, T_L of Eq. (4).
   * Default is on.
   */
  vtkSetMacro(Shadows, vtkTypeBool);
  vtkGetMacro(Shadows, vtkTypeBool);
  vtkBooleanMacro(Shadows, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Share of the shadow that is drawn, in [0, 1]. Default is 0.7.
   */
  vtkSetMacro(ShadowStrength, double);
  vtkGetMacro(ShadowStrength, double);
  ///@}

  ///@{
  /**
   * Share of the light that comes from all sides and reaches everything, in [0, 1]. Default is
   * 0.35.
   */
  vtkSetMacro(Ambient, double);
  vtkGetMacro(Ambient, double);
  ///@}

  ///@{
  /**
   * Parameter a of the Henyey-Greenstein phase function, between -1 (light is scattered back) and
   * 1 (it goes straight on). Default is 0.6.
   */
  vtkSetMacro(Anisotropy, double);
  vtkGetMacro(Anisotropy, double);
  ///@}

  ///@{
  /**
   * Weight k_s of the Blinn-Phong term of Eq. (5) where the base extinction is steepest; elsewhere
   * it is less in proportion to the gradient. Not below zero. Default is 2.
   */
  vtkSetMacro(Specular, double);
  vtkGetMacro(Specular, double);
  ///@}

  ///@{
  /**
   * Exponent of the Blinn-Phong term, not below zero. Default is 20.
   */
  vtkSetMacro(SpecularPower, double);
  vtkGetMacro(SpecularPower, double);
  ///@}

  ///@{
  /**
   * Brightness of the light, not below zero; at 1, what it reaches unhindered keeps about the
   * colour of the transfer function. Default is 1.
   */
  vtkSetMacro(LightIntensity, double);
  vtkGetMacro(LightIntensity, double);
  ///@}

  ///@{
  /**
   * Distance between samples along a ray, in units of the smallest spacing, above zero.
   * Default is 1.
   */
  vtkSetMacro(SampleDistance, double);
  vtkGetMacro(SampleDistance, double);
  ///@}

  ///@{
  /**
   * Whether the samples of each ray are shifted by a fixed pseudo-random amount: noise instead of
   * rings. Default is off.
   */
  vtkSetMacro(Jitter, vtkTypeBool);
  vtkGetMacro(Jitter, vtkTypeBool);
  vtkBooleanMacro(Jitter, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Time that a moving frame may take [s], above zero. Default is 0.1.
   */
  vtkSetMacro(InteractiveFrameTime, double);
  vtkGetMacro(InteractiveFrameTime, double);
  ///@}

  ///@{
  /**
   * Time constant with which changes of the extinction ease in while the view moves [s]; zero: they
   * are shown at once. Default is 0.3.
   */
  vtkSetMacro(EaseTime, double);
  vtkGetMacro(EaseTime, double);
  ///@}

  ///@{
  /**
   * Whether moving frames are made coarser to take no longer than InteractiveFrameTime. Off: they
   * are like still frames, however long they take. Default is on.
   */
  vtkSetMacro(AdaptiveQuality, vtkTypeBool);
  vtkGetMacro(AdaptiveQuality, vtkTypeBool);
  vtkBooleanMacro(AdaptiveQuality, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether a still frame takes one step of the optimization only, and GetConverged tells whether
   * more frames are to be rendered. For programs with a window that stays responsive; whoever sets
   * it renders until it has converged. Default is off.
   */
  vtkSetMacro(ProgressiveStill, vtkTypeBool);
  vtkGetMacro(ProgressiveStill, vtkTypeBool);
  vtkBooleanMacro(ProgressiveStill, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Visibility score of what the last frame showed, S of Eq. (32), and of the base extinction in
   * the same view [length^2]. Zero without importance.
   */
  double GetVisibilityScore() const;
  double GetBaseVisibilityScore() const;
  ///@}

  ///@{
  /**
   * The same as shares: S over the integral of importance times extinction, in [0, 1].
   */
  double GetVisibleFraction() const;
  double GetBaseVisibleFraction() const;
  ///@}

  /**
   * Whether the last frame showed all that there is to show: at full resolution, the optimization
   * at its end.
   */
  bool GetConverged() const;

  /**
   * Iterations of the optimization at full resolution for the last frame.
   */
  int GetIterations() const;

  /**
   * The light of the last frame for a person to read: which one of the view, what kind of light.
   */
  const char* GetLightDescription() const;

  /**
   * What computed the last optimization: "CPU, 2 threads". Empty before.
   */
  const char* GetBackendName() const;

  /**
   * The errors and warnings of the last frame, one a line, also those that were given before and
   * are still true. Empty when all is well.
   */
  const char* GetMessages() const;

  /**
   * Makes a renderer draw its props from back to front, which this class can do for volumes of its
   * own only: by sorting in the renderer's vtkFrustumCoverageCuller, or in a new one if there is
   * none.
   */
  static void SortBackToFront(vtkRenderer* renderer);

  /**
   * Gives back the memory of everything that can be made again: fields, optimizations, pictures.
   * Happens by itself when the volume is made invisible.
   */
  void ReleaseMemory();

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  vtkMTimeType GetMTime() override;

protected:
  vtkTransmittanceVolumeMapper();
  ~vtkTransmittanceVolumeMapper() override;

private:
  vtkTransmittanceVolumeMapper(const vtkTransmittanceVolumeMapper&) = delete;
  void operator=(const vtkTransmittanceVolumeMapper&) = delete;

  int ScalarComponent = UNDECIDED;
  std::string ImportanceArray;
  int ImportanceArrayAssociation = 3; // vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS
  int ImportanceComponent = MAGNITUDE;
  vtkTypeBool UseImportanceFunction = 0;
  vtkPiecewiseFunction* ImportanceFunction = nullptr;

  int Method = OPTIMIZED;
  int Optimization = CONTINUOUS;
  vtkTypeBool PauseOptimization = 0;
  double RegularizationWeight = 1e-3;
  double ViewWeight = 10;
  double LightWeight = 1;
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
  vtkTypeBool RestrictToView = 1;
  int Backend = AUTO;

  int LightSource = SCENE;
  int LightType = POINT;
  double LightPosition[3] = { 0, 0, 1 };
  vtkTypeBool Shadows = 1;
  double ShadowStrength = 0.7;
  double Ambient = 0.35;
  double Anisotropy = 0.6;
  double Specular = 2;
  double SpecularPower = 20;
  double LightIntensity = 1;

  double SampleDistance = 1;
  vtkTypeBool Jitter = 0;
  double InteractiveFrameTime = 0.1;
  double EaseTime = 0.3;
  vtkTypeBool AdaptiveQuality = 1;
  vtkTypeBool ProgressiveStill = 0;

  struct Internals; // speaks to the core, so that no core type shows here
  std::unique_ptr<Internals> State;
};

#endif
