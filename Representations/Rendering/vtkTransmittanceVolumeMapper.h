// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkTransmittanceVolumeMapper
 * @brief   draw a volume so that its important regions are seen
 *
 * A volume mapper, to be used with vtkVolume::SetMapper. It finds the extinction of Eq. (21) in
 * [HG24] for the camera and a light of the view in which it draws, and renders with it by Eqs.
 * (1)-(6): single scattering, with the transmittance of the light from a shadow volume. Backend
 * says what computes; with AUTO a graphics card where there is one, else all cores of the CPU.
 *
 * Input port 0: vtkImageData with an array of its points or its cells (cell arrays are averaged to
 * the points first), of any numeric type, chosen as for all volume mappers with SelectScalarArray
 * and SetScalarMode. Points with a NaN or an infinite value and hidden (blanked) points are empty.
 * Extents, spacing and direction matrices of either handedness are honoured. A second array has the
 * importance, see SetImportanceArray; a third one may have the extinction, see SetExtinctionSource.
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
 * Opaque geometry hides and is hidden correctly. Translucent geometry does behind a volume, and
 * anywhere if the renderer peels volumes (UseDepthPeeling, UseDepthPeelingForVolumes): rays are
 * cast from surface to surface then. Without that it is drawn by VTK before any volume, and volumes
 * that overlap cannot be drawn right; there is a warning for both. Volumes that do not overlap are
 * drawn in the right order if this class draws them; see also SortBackToFront.
 *
 * Clipping planes and the box of a cropping region cut the picture where they are, 16 planes at
 * most with 6 of a box; cropping regions that are no box end between points. Points outside do not
 * count in the optimization and the score and cast no shadow.
 *
 * With several processes of MPI, each has its own piece of the image. With SharesImage on they draw
 * the volume together, within 1/255 of the picture of one process; else there is a warning, and
 * each draws its piece without optimization and light, and there is no score.
 *
 * The unit of length is that of the input's spacing, also where the volume is scaled.
 *
 * @sa vtkExtinctionOptimizer
 */

#ifndef vtkTransmittanceVolumeMapper_h
#define vtkTransmittanceVolumeMapper_h

#include "vtkLimpidRenderingModule.h" // for export macro
#include "vtkPiecewiseFunction.h"     // for the smart pointer
#include "vtkSmartPointer.h"          // for the settings
#include "vtkVisibilitySettings.h"    // for the methods that are passed on
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

  enum ExtinctionSources
  {
    OPACITY_FUNCTION = 0,
    ARRAY = 1
  };

  LIMPID_VISIBILITY_CHOICES();

  ///@{
  /**
   * Importance, weights, own light and solver, see vtkVisibilitySettings; null changes nothing.
   * By default, ScalarComponent is UNDECIDED here, which is MAGNITUDE with a warning if there are
   * several components, and RestrictToView is on.
   */
  virtual void SetVisibilitySettings(vtkVisibilitySettings* settings);
  vtkVisibilitySettings* GetVisibilitySettings() { return this->Settings; }
  ///@}

  /**
   * The methods of vtkVisibilitySettings, documented there. Of SetMethod: VIOLA_2004 clips every
   * ray of a picture by itself, where the filter samples the clip to the points; it and
   * MARCHESIN_2010 are drawn without shadows, and need whole rays: with translucent geometry in the
   * volume, or in several processes, the volume is drawn as with ORDINARY, with a message.
   */
  LIMPID_FORWARD_VISIBILITY_SETTINGS();

  /**
   * Settings for a purpose, see vtkVisibilitySettings::SetPreset.
   */
  virtual bool SetPreset(const char* name) { return this->Settings->SetPreset(name); }

  ///@{
  /**
   * Name of the array with the importance, dimensionless, or with what ImportanceFunction maps to
   * it. Empty: the array "Importance", or if there is none, the scalar array. Default is empty.
   */
  void SetImportanceArray(const char* name);
  const char* GetImportanceArray() const;
  ///@}

  ///@{
  /**
   * Function from the scalars to importance that stands in where nothing says what is important:
   * UseImportanceFunction is off, and ImportanceArray is empty and there is none of the name
   * "Importance", or it is the scalar array. Null: a ramp over the largest scalars, from their 95th
   * to their 99th percentile, or above where these are in noise, with a warning, where
   * ImportanceArray is empty. Default is null.
   */
  void SetAssumedImportance(vtkPiecewiseFunction* function);
  vtkPiecewiseFunction* GetAssumedImportance() { return this->AssumedImportance; }
  ///@}

  ///@{
  /**
   * Where the array with the importance is: vtkDataObject::FIELD_ASSOCIATION_POINTS, _CELLS, or
   * _POINTS_THEN_CELLS. Default is FIELD_ASSOCIATION_POINTS_THEN_CELLS.
   */
  LIMPID_SET_CLAMPED(ImportanceArrayAssociation, int, vtkDataObject::FIELD_ASSOCIATION_POINTS,
    vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS);
  vtkGetMacro(ImportanceArrayAssociation, int);
  ///@}

  ///@{
  /**
   * Where the base extinction comes from: OPACITY_FUNCTION of the scalar array and its unit
   * distance, or ARRAY, the extinction array, interpolated linearly; with that the scalars say the
   * colours alone. Scores, too, are of what the array has: what was removed from it before does not
   * count. Default is OPACITY_FUNCTION.
   */
  LIMPID_SET_CLAMPED(ExtinctionSource, int, OPACITY_FUNCTION, ARRAY);
  vtkGetMacro(ExtinctionSource, int);
  ///@}

  ///@{
  /**
   * Name of the array with the extinction [1/length], one number per point or cell: not negative,
   * else the point is empty, as where it is NaN or infinite. Empty: the array "Extinction", as
   * vtkExtinctionOptimizer makes it. Default is empty.
   */
  void SetExtinctionArray(const char* name);
  const char* GetExtinctionArray() const;
  ///@}

  ///@{
  /**
   * Where the array with the extinction is: as SetImportanceArrayAssociation.
   * Default is FIELD_ASSOCIATION_POINTS_THEN_CELLS.
   */
  LIMPID_SET_CLAMPED(ExtinctionArrayAssociation, int, vtkDataObject::FIELD_ASSOCIATION_POINTS,
    vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS);
  vtkGetMacro(ExtinctionArrayAssociation, int);
  ///@}

  ///@{
  /**
   * OFF: the base extinction, and the score is that of it. ONCE: optimized
   * for camera and light of the first still frame, and kept until Reset is called or the data
   * change; changed functions and settings are followed. CONTINUOUS: optimized for every frame.
   * Default is CONTINUOUS.
   */
  LIMPID_SET_CLAMPED(Optimization, int, OFF, CONTINUOUS);
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
   * Which light casts the shadow and drives the optimization. SCENE: the strongest of the
   * renderer's lights that are switched on, by colour and intensity; other lights are not drawn,
   * and the strength of this one only tells which it is: how bright it is comes from
   * LightIntensity, and it is white, so that colours can be read off a scalar bar. OWN: that of
   * LightType and LightPosition.
   * Default is SCENE.
   */
  LIMPID_SET_CLAMPED(LightSource, int, SCENE, OWN);
  vtkGetMacro(LightSource, int);
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
  LIMPID_SET_CLAMPED(ShadowStrength, double, 0, 1);
  vtkGetMacro(ShadowStrength, double);
  ///@}

  ///@{
  /**
   * Share of the light that comes from all sides and reaches everything, in [0, 1]. Default is
   * 0.35.
   */
  LIMPID_SET_CLAMPED(Ambient, double, 0, 1);
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
  LIMPID_SET_CLAMPED(Specular, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Specular, double);
  ///@}

  ///@{
  /**
   * Exponent of the Blinn-Phong term, not below zero. Default is 20.
   */
  LIMPID_SET_CLAMPED(SpecularPower, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(SpecularPower, double);
  ///@}

  ///@{
  /**
   * Brightness of the light, not below zero. At 1, a surface that faces light and camera has the
   * colour of the transfer function, and nothing is brighter; above, no channel is clipped alone.
   * Default is 1.
   */
  LIMPID_SET_CLAMPED(LightIntensity, double, 0, VTK_DOUBLE_MAX);
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
   * Whether the picture is painted over, in MissedColor, where it misses something important. What
   * was removed is painted, and of what is hidden, that which could be seen in the same pixel if
   * what is less important were not in front of it: the inside and the back of something that is
   * seen, or what it hides of its own kind, is not. What is important itself and seen covers the
   * paint of what is behind it. At most 70 % of a pixel are painted, and little
   * where little is missed, so that noise paints nothing.
   *
   * Moving frames have it, too: it is gathered along the rays of the very picture that it is
   * painted over, from the extinction shown there, so it cannot be of another view. It takes about
   * the time of the rays once more. Opaque geometry ends the rays; translucent geometry does not
   * count as something that hides. Default is off.
   */
  vtkSetMacro(ShowMissed, vtkTypeBool);
  vtkGetMacro(ShowMissed, vtkTypeBool);
  vtkBooleanMacro(ShowMissed, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Red, green and blue of what is missed, in [0, 1]. Default is magenta, (1, 0, 1).
   */
  virtual void SetMissedColor(double red, double green, double blue);
  virtual void SetMissedColor(const double color[3]);
  vtkGetVector3Macro(MissedColor, double);
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
  LIMPID_SET_CLAMPED(EaseTime, double, 0, VTK_DOUBLE_MAX);
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
   * Whether still frames are made like moving ones, so that they leave something to do: for such a
   * program while its user is likely to move on at once. Default is off.
   */
  vtkSetMacro(DeferStill, vtkTypeBool);
  vtkGetMacro(DeferStill, vtkTypeBool);
  vtkBooleanMacro(DeferStill, vtkTypeBool);
  ///@}

  /**
   * Makes a part of the picture without optimization of what the last frames showed, once they have
   * converged with ProgressiveStill, so that the first frame of the method ORDINARY shows it. For
   * such a program while nothing else happens: a call takes about InteractiveFrameTime, and once
   * per picture the time of a shadow. Returns whether something is left to be done; false also
   * where there is nothing to prepare. The picture with optimization is kept by itself.
   */
  bool PrepareOriginal();

  ///@{
  /**
   * Whether all processes of the global controller draw the volume together, each of which has a
   * piece of the image as its input, or an image without points, and WholeExtent is that of all
   * pieces. All of them have to render the same frames, whether or not they see their piece: the
   * bounds of the mapper are those of the whole image. A process draws the pixels in which its
   * piece is foremost, of all that lies behind it, too. Moving frames show what was found last.
   * Default is off.
   */
  vtkSetMacro(SharesImage, vtkTypeBool);
  vtkGetMacro(SharesImage, vtkTypeBool);
  vtkBooleanMacro(SharesImage, vtkTypeBool);
  bool DrawsWithOthers() const; ///< whether there are any, too
  vtkSetVector6Macro(WholeExtent, int);
  vtkGetVector6Macro(WholeExtent, int);
  ///@}

  ///@{
  /**
   * Visibility score of what the last frame showed, S of Eq. (32), and of the base extinction in
   * the same view [length^2]. Zero without importance. What is behind opaque geometry that was
   * drawn before is not seen; the optimization does not take it into account.
   */
  double GetVisibilityScore() const;
  double GetBaseVisibilityScore() const;
  ///@}

  /**
   * Whether scores and fractions were measured in the last frame: zero then says that nothing
   * important is in view. Else they are zero because nobody knows.
   */
  bool GetMeasured() const;

  ///@{
  /**
   * The visible fraction of the important structures in [0, 1], with the optimized and with the
   * base extinction: the share of the integral of importance times base extinction whose light
   * reaches the camera. Matter that was removed is not seen, added matter does not count, and what
   * is behind opaque geometry is not seen.
   */
  double GetVisibleFraction() const;
  double GetBaseVisibleFraction() const;
  ///@}

  /**
   * The share of it that the optimization removed to show other parts, in [0, 1].
   */
  double GetSacrificedFraction() const;

  ///@{
  /**
   * What no extinction within the bounds could exceed in the view of the last frame:
   * GetVisibleFraction, GetVisibilityScore, and the score of the light. Zero without importance,
   * for methods other than OPTIMIZED, and as long as the frame has not converged.
   */
  double GetAttainableFraction() const;
  double GetAttainableScore() const;
  double GetAttainableLightScore() const;
  ///@}

  /**
   * Says that nothing is shown: scores and fractions are zero until the next frame. For owners that
   * hide the volume because there is nothing to be drawn.
   */
  void ClearResults();

  /**
   * Whether the last frame showed all that there is to show: at full resolution, the optimization
   * at its end.
   */
  bool GetConverged() const;

  /**
   * Whether the optimization of a converged frame ended because another iteration would change next
   * to nothing, and not at MaximumIterations or MaximumSeconds.
   */
  bool GetSettled() const;

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
   * What Method is called in panels: "Ament 2017". Empty if there is no such method.
   */
  const char* GetMethodName();

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
   * Whether there is translucent geometry in front of a volume or reaching into it, which is drawn
   * right only by a renderer that peels volumes; without a volume: of any visible one, whatever
   * draws it.
   */
  static bool NeedsDepthPeeling(vtkRenderer* renderer, vtkVolume* volume);
  static bool NeedsDepthPeeling(vtkRenderer* renderer);

  /**
   * Gives back the memory of everything that can be made again: fields, optimizations, pictures.
   * Happens by itself when the volume is made invisible.
   */
  void ReleaseMemory();

  double* GetBounds() VTK_SIZEHINT(6) override;
  using vtkVolumeMapper::GetBounds;

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  vtkMTimeType GetMTime() override;

protected:
  vtkTransmittanceVolumeMapper();
  ~vtkTransmittanceVolumeMapper() override;

private:
  vtkTransmittanceVolumeMapper(const vtkTransmittanceVolumeMapper&) = delete;
  void operator=(const vtkTransmittanceVolumeMapper&) = delete;

  vtkSmartPointer<vtkVisibilitySettings> Settings;
  std::string ImportanceArray;
  vtkSmartPointer<vtkPiecewiseFunction> AssumedImportance;
  int ImportanceArrayAssociation = 3; // vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS
  int ExtinctionSource = OPACITY_FUNCTION;
  std::string ExtinctionArray;
  int ExtinctionArrayAssociation = 3; // likewise

  int Optimization = CONTINUOUS;
  vtkTypeBool PauseOptimization = 0;
  int LightSource = SCENE;
  vtkTypeBool Shadows = 1;
  double ShadowStrength = 0.7;
  double Ambient = 0.35;
  double Anisotropy = 0.6;
  double Specular = 2;
  double SpecularPower = 20;
  double LightIntensity = 1;

  double SampleDistance = 1;
  vtkTypeBool Jitter = 0;
  vtkTypeBool ShowMissed = 0;
  double MissedColor[3] = { 1, 0, 1 };
  double InteractiveFrameTime = 0.1;
  double EaseTime = 0.3;
  vtkTypeBool AdaptiveQuality = 1;
  vtkTypeBool ProgressiveStill = 0;
  vtkTypeBool DeferStill = 0;
  vtkTypeBool SharesImage = 0;
  int WholeExtent[6] = { 0, -1, 0, -1, 0, -1 };

  struct Internals; // speaks to the core, so that no core type shows here
  std::unique_ptr<Internals> State;
};

#endif
