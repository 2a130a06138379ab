// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkTransmittanceVolumeMapper
 * @brief   draw a volume so that its important structures are visible
 *
 * A volume mapper, to be used with vtkVolume::SetMapper. It computes the extinction of Eq. (21) in
 * [HG24] for the camera and one light of the view in which it draws, and renders with it by Eqs.
 * (1)-(6): single scattering, with the light's transmittance from a shadow volume. Backend is where
 * it computes; AUTO is a graphics card if there is one, else all cores of the CPU.
 *
 * Input port 0: vtkImageData with a point or cell array of any numeric type, chosen with
 * SelectScalarArray and SetScalarMode as for all volume mappers. Cell arrays are averaged to the
 * points first. Points with a NaN or an infinite value and hidden (blanked) points are empty.
 * Extents, spacing, and direction matrices of either handedness are honoured. A second array has
 * the importance, see SetImportanceArray; a third one may have the extinction, see
 * SetExtinctionSource. The reference for ReferencePull is chosen with SetInputArrayToProcess, at
 * index 4.
 *
 * Colours, opacities and the unit distance are those of the first component of vtkVolumeProperty.
 * Scalars are always interpolated linearly. The volume is lit if Shadows or the property's Shade is
 * on: with Shadows by single scattering with the transmittance of the light, with Shade alone by
 * single scattering with a transmittance of 1. With both off it emits and absorbs light; without
 * optimization, this picture equals that of VTK's own mappers without shading. Gradient opacity,
 * two-dimensional transfer functions, and blend modes other than composite are not supported; they
 * cause a warning.
 *
 * The state of the optimization belongs to a renderer and a volume, so two views of a volume are
 * independent. A still frame (the render window's DesiredUpdateRate is below 1) has full resolution
 * and a completed optimization, and does not depend on earlier frames. A frame during interaction
 * takes about InteractiveFrameTime: it makes one pass of the optimization on a coarser grid,
 * computes shadows on a grid, has as many pixels as the time allows, and changes ease in.
 *
 * A still frame that is not made in steps (ProgressiveStill) invokes ProgressEvent with the share
 * of its rays that have been cast. Its observers may abort it with SetAbortExecute(1), as observers
 * of the render window's AbortCheckEvent may with SetAbortRender(1) in any frame. The window then
 * keeps what it shows, and the next frame starts anew. The picture is kept, up to 7680 x 4320
 * pixels in several tiles: if only what is behind the volume has changed, it is drawn without
 * casting rays.
 *
 * Opaque geometry and the volume hide each other correctly. Translucent geometry is correct behind
 * a volume; elsewhere it is if the renderer peels volumes (UseDepthPeeling,
 * UseDepthPeelingForVolumes), where rays are cast from surface to surface. Without peeling, VTK
 * draws it before all volumes, and overlapping volumes cannot be drawn correctly; there is a
 * warning for both. Volumes that do not overlap are drawn in the right order if this class draws
 * them; see also SortBackToFront.
 *
 * Clipping planes and the box of a cropping region cut the picture exactly; at most 16 planes, of
 * which a box takes 6. Cropping regions that are not a box are cut between points. Points outside
 * are ignored by the optimization and the score, and cast no shadow.
 *
 * With several MPI processes, each has its own piece of the image. With SharesImage on, they draw
 * the volume together; the picture is within 1/255 of that of one process. With it off, each
 * process draws its piece without optimization and light, with a warning, and there is no score.
 *
 * The unit of length is that of the input's spacing, even if the volume is scaled.
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
class vtkTable;

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

  /// For SetDrawOn, beside AUTO and CUDA of Backend.
  enum DrawingDevices
  {
    PROCESSOR = 1,
    OPENGL = 3
  };

  enum ExtinctionSources
  {
    OPACITY_FUNCTION = 0,
    ARRAY = 1
  };

  LIMPID_VISIBILITY_CHOICES();

  ///@{
  /**
   * The settings of importance, weights, own light and solver. Null changes nothing. By default,
   * ScalarComponent is UNDECIDED here, which means MAGNITUDE, with a warning if there are several
   * components, and RestrictToView is on.
   */
  virtual void SetVisibilitySettings(vtkVisibilitySettings* settings);
  vtkVisibilitySettings* GetVisibilitySettings() { return this->Settings; }
  ///@}

  /**
   * The methods of vtkVisibilitySettings, see there. For SetMethod: VIOLA_2004 clips every ray of a
   * picture separately, while the filter samples the clip at the points. It and MARCHESIN_2010 are
   * drawn without shadows and need whole rays: with translucent geometry in the volume, or in
   * several processes, the volume is drawn as with ORDINARY, with a message.
   */
  LIMPID_FORWARD_VISIBILITY_SETTINGS();

  /**
   * Applies a preset, see vtkVisibilitySettings::SetPreset.
   */
  virtual bool SetPreset(const char* name) { return this->Settings->SetPreset(name); }

  ///@{
  /**
   * Name of the array with the importance, dimensionless, or with the argument of
   * ImportanceFunction. Empty: the array "Importance", or, if there is none, the scalar array.
   * Default is empty.
   */
  void SetImportanceArray(const char* name);
  const char* GetImportanceArray() const;
  ///@}

  ///@{
  /**
   * Function from the scalars to importance that is used if importance is not specified. This is so
   * if UseImportanceFunction is off and either ImportanceArray is empty and there is no array
   * "Importance", or the importance array is the scalar array. Null: if ImportanceArray is empty,
   * importance is assumed to rise over the largest scalars, from their 95th to their 99th
   * percentile, or above these if they lie in noise, with a warning. Default is null.
   */
  void SetAssumedImportance(vtkPiecewiseFunction* function);
  vtkPiecewiseFunction* GetAssumedImportance() { return this->AssumedImportance; }
  ///@}

  ///@{
  /**
   * Whether the importance array is a point or cell array: vtkDataObject::FIELD_ASSOCIATION_POINTS,
   * _CELLS, or _POINTS_THEN_CELLS. Default is FIELD_ASSOCIATION_POINTS_THEN_CELLS.
   */
  LIMPID_SET_CLAMPED(ImportanceArrayAssociation, int, vtkDataObject::FIELD_ASSOCIATION_POINTS,
    vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS);
  vtkGetMacro(ImportanceArrayAssociation, int);
  ///@}

  ///@{
  /**
   * Source of the base extinction. OPACITY_FUNCTION: that of the scalar array and its unit
   * distance. ARRAY: the extinction array, interpolated linearly; the scalars then define the
   * colours only. Scores refer to this base extinction as well: what was removed from the array
   * before does not count. Default is OPACITY_FUNCTION.
   */
  LIMPID_SET_CLAMPED(ExtinctionSource, int, OPACITY_FUNCTION, ARRAY);
  vtkGetMacro(ExtinctionSource, int);
  ///@}

  ///@{
  /**
   * Name of the array with the extinction [1/length], one number per point or cell. Points where it
   * is negative, NaN or infinite are empty. Empty: the array "Extinction", which
   * vtkExtinctionOptimizer creates. Default is empty.
   */
  void SetExtinctionArray(const char* name);
  const char* GetExtinctionArray() const;
  ///@}

  ///@{
  /**
   * Whether the extinction array is a point or cell array, as for SetImportanceArrayAssociation.
   * Default is FIELD_ASSOCIATION_POINTS_THEN_CELLS.
   */
  LIMPID_SET_CLAMPED(ExtinctionArrayAssociation, int, vtkDataObject::FIELD_ASSOCIATION_POINTS,
    vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS);
  vtkGetMacro(ExtinctionArrayAssociation, int);
  ///@}

  ///@{
  /**
   * When to optimize. OFF: never; the base extinction is shown and scored. ONCE: for the camera and
   * the light of the first still frame; the result is kept until Reset is called or the data
   * change, while changes of transfer functions and settings are followed. CONTINUOUS: for every
   * frame. Default is CONTINUOUS.
   */
  LIMPID_SET_CLAMPED(Optimization, int, OFF, CONTINUOUS);
  vtkGetMacro(Optimization, int);
  ///@}

  ///@{
  /**
   * Whether the extinction is kept while cameras and lights move. Changes of transfer functions are
   * followed. Default is off.
   */
  vtkSetMacro(PauseOptimization, vtkTypeBool);
  vtkGetMacro(PauseOptimization, vtkTypeBool);
  vtkBooleanMacro(PauseOptimization, vtkTypeBool);
  ///@}

  /**
   * Discards the optimization of all views. With ONCE, the next still frame counts as the first.
   */
  void Reset();

  ///@{
  /**
   * The light that casts the shadow and is optimized for. SCENE: the strongest of the renderer's
   * lights that are switched on, by colour and intensity. Other lights are ignored. Its strength is
   * only used to choose it: it is drawn in white, so that colours can be read off a scalar bar, and
   * LightIntensity sets its brightness. OWN: the light of LightType and LightPosition. Default is
   * SCENE.
   */
  LIMPID_SET_CLAMPED(LightSource, int, SCENE, OWN);
  vtkGetMacro(LightSource, int);
  ///@}

  ///@{
  /**
   * Whether the volume is lit by single scattering and casts shadows on itself by T_L of Eq. (4).
   * Default is on.
   */
  vtkSetMacro(Shadows, vtkTypeBool);
  vtkGetMacro(Shadows, vtkTypeBool);
  vtkBooleanMacro(Shadows, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Strength of the shadow, in [0, 1]: 0 draws none, 1 all of it. Default is 0.7.
   */
  LIMPID_SET_CLAMPED(ShadowStrength, double, 0, 1);
  vtkGetMacro(ShadowStrength, double);
  ///@}

  ///@{
  /**
   * Share of ambient light, which comes from all sides and is not attenuated, in [0, 1]. Default is
   * 0.35.
   */
  LIMPID_SET_CLAMPED(Ambient, double, 0, 1);
  vtkGetMacro(Ambient, double);
  ///@}

  ///@{
  /**
   * Parameter a of the Henyey-Greenstein phase function, in (-1, 1); other values are an error.
   * Towards -1 light is scattered backwards, towards 1 forwards. Default is 0.6.
   */
  vtkSetMacro(Anisotropy, double);
  vtkGetMacro(Anisotropy, double);
  ///@}

  ///@{
  /**
   * Weight k_s of the Blinn-Phong term of Eq. (5) where the gradient of the base extinction is
   * steepest; elsewhere it is proportional to the gradient. At least zero. Default is 2.
   */
  LIMPID_SET_CLAMPED(Specular, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Specular, double);
  ///@}

  ///@{
  /**
   * Exponent of the Blinn-Phong term, at least zero. Default is 20.
   */
  LIMPID_SET_CLAMPED(SpecularPower, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(SpecularPower, double);
  ///@}

  ///@{
  /**
   * Brightness of the light, at least zero. At 1, a surface that faces both light and camera has
   * the colour of the transfer function, and nothing is brighter. Above 1, colours that are too
   * bright keep their hue: no channel is clipped by itself. Default is 1.
   */
  LIMPID_SET_CLAMPED(LightIntensity, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(LightIntensity, double);
  ///@}

  ///@{
  /**
   * Distance between samples along a ray, in units of the smallest spacing; above zero. Default is
   * 1.
   */
  vtkSetMacro(SampleDistance, double);
  vtkGetMacro(SampleDistance, double);
  ///@}

  ///@{
  /**
   * What computes the pictures. AUTO: CUDA if there is a GPU for it and Backend is not CPU; else
   * OpenGL if that is hardware; else the processor. LIMPID_DRAW_ON=Processor or OpenGL in the
   * environment decides for AUTO. Where the choice cannot draw a volume, the
   * processor does; GetDrawnBy tells. Pictures differ by rounding only. Default is AUTO.
   */
  LIMPID_SET_CLAMPED(DrawOn, int, AUTO, OPENGL);
  vtkGetMacro(DrawOn, int);
  ///@}

  ///@{
  /**
   * Whether the samples of each ray are shifted by a fixed pseudo-random amount, which turns rings
   * into noise. Default is off.
   */
  vtkSetMacro(Jitter, vtkTypeBool);
  vtkGetMacro(Jitter, vtkTypeBool);
  vtkBooleanMacro(Jitter, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether pixels that miss important structures are painted over with MissedColor. Structures
   * that were removed are painted. Hidden ones are painted only if they could be seen in that pixel
   * without less important structures in front of them; so the inside and the back of a visible
   * structure, and what it hides of its own kind, are not painted. Visible important structures
   * cover the paint of what is behind them. At most 70 % of a pixel's colour is painted, and little
   * where little is missed, so that noise is not painted.
   *
   * This also works during interaction: the paint is accumulated along the rays of the same
   * picture, from the extinction that it shows, so it always belongs to the same view. It takes
   * about as long as the rays again. Opaque geometry ends the rays; translucent geometry does not
   * count as hiding anything. Default is off.
   */
  vtkSetMacro(ShowMissed, vtkTypeBool);
  vtkGetMacro(ShowMissed, vtkTypeBool);
  vtkBooleanMacro(ShowMissed, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Red, green and blue of the paint of missed structures, in [0, 1]. Default is magenta, (1, 0,
   * 1).
   */
  virtual void SetMissedColor(double red, double green, double blue);
  virtual void SetMissedColor(const double color[3]);
  vtkGetVector3Macro(MissedColor, double);
  ///@}

  ///@{
  /**
   * How far the colors of samples are moved to those of their structures, in [0, 1]: 0 leaves those
   * of the transfer function, 1 shows those of structures alone, lit like any other. What is in no
   * structure keeps the color of the transfer function. A point between points of the image is in
   * the structure that has most of them by trilinear weights, so borders are sharp at any zoom.
   * Structures are the rows of AddStructure, and the labels are input array 3; without rows, all
   * labels but 0 are one structure with one color. Default is 0.
   */
  LIMPID_SET_CLAMPED(StructureColors, double, 0, 1);
  vtkGetMacro(StructureColors, double);
  ///@}

  ///@{
  /**
   * Gives the structure with a label a color: red, green and blue, in [0, 1]. Structures without
   * one take colors of a fixed palette of 64 in the order of their rows. Default is none.
   */
  void AddLabelColor(double label, double red, double green, double blue);
  void RemoveAllLabelColors();
  int GetNumberOfLabelColors() const;
  ///@}

  ///@{
  /**
   * Time limit of a frame during interaction [s]; above zero. If a graphics card draws by OpenGL,
   * it is 1/60 at most. Default is 0.1.
   */
  vtkSetMacro(InteractiveFrameTime, double);
  vtkGetMacro(InteractiveFrameTime, double);
  ///@}

  ///@{
  /**
   * Time constant with which changes of the extinction ease in while the view moves [s], at least
   * zero. Zero: changes are shown at once. Default is 0.3.
   */
  LIMPID_SET_CLAMPED(EaseTime, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(EaseTime, double);
  ///@}

  ///@{
  /**
   * Whether frames during interaction are made coarser to meet InteractiveFrameTime. Off: they are
   * like still frames, however long these take. Default is on.
   */
  vtkSetMacro(AdaptiveQuality, vtkTypeBool);
  vtkGetMacro(AdaptiveQuality, vtkTypeBool);
  vtkBooleanMacro(AdaptiveQuality, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether a still frame makes only one step of the optimization, so that a program with a window
   * stays responsive. The program must render until GetConverged returns true. Default is off.
   */
  vtkSetMacro(ProgressiveStill, vtkTypeBool);
  vtkGetMacro(ProgressiveStill, vtkTypeBool);
  vtkBooleanMacro(ProgressiveStill, vtkTypeBool);
  ///@}

  ///@{
  /**
   * With ProgressiveStill, whether still frames are made like frames during interaction, which
   * leaves the rest to later frames; useful while the user is likely to move on at once. Default is
   * off.
   */
  vtkSetMacro(DeferStill, vtkTypeBool);
  vtkGetMacro(DeferStill, vtkTypeBool);
  vtkBooleanMacro(DeferStill, vtkTypeBool);
  ///@}

  /**
   * Computes a part of the unoptimized picture of the view that the last frames showed, so that the
   * first frame with the method ORDINARY can show it. To be called with ProgressiveStill, while the
   * program is idle and once the frames have converged. A call takes about InteractiveFrameTime
   * and, once per picture, the time of a shadow. Returns whether work is left; false also if there
   * is nothing to prepare. The optimized picture is kept without this.
   */
  bool PrepareOriginal();

  ///@{
  /**
   * Whether all processes of the global controller draw the volume together. The input of each is a
   * piece of the image, or an image without points, and WholeExtent is the extent of all pieces.
   * All processes must render the same frames, even if they do not see their piece: the bounds of
   * the mapper are those of the whole image. A process draws the pixels in which its piece is
   * foremost, including what is behind. Frames during interaction show the extinction that was
   * found last. Default is off.
   */
  vtkSetMacro(SharesImage, vtkTypeBool);
  vtkGetMacro(SharesImage, vtkTypeBool);
  vtkBooleanMacro(SharesImage, vtkTypeBool);
  bool DrawsOnSeveralRanks() const; ///< SharesImage, and there are other processes
  vtkSetVector6Macro(WholeExtent, int);
  vtkGetVector6Macro(WholeExtent, int);
  ///@}

  ///@{
  /**
   * Visibility score S of Eq. (32) of the extinction that the last frame showed, and of the base
   * extinction in this view [length^2]. Zero without importance. What is behind opaque geometry
   * drawn before is not visible; the optimization ignores such geometry.
   */
  double GetVisibilityScore() const;
  double GetBaseVisibilityScore() const;
  ///@}

  /**
   * Whether scores and fractions were measured for the last frame. If so, zero means that nothing
   * important is in view; if not, they are zero because they are unknown. Without optimization they
   * are not measured if importance is not specified and no frame before has assumed it.
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
   * The share of the important structures that the optimization removed to show other parts, in [0,
   * 1].
   */
  double GetSacrificedFraction() const;

  ///@{
  /**
   * Upper bounds that no extinction within its limits could exceed in the view of the last frame:
   * for GetVisibleFraction, for GetVisibilityScore [length^2], and for the score of the light
   * [length^2]. Zero without importance, for methods other than OPTIMIZED, and until the frame has
   * converged.
   */
  double GetAttainableFraction() const;
  double GetAttainableScore() const;
  double GetAttainableLightScore() const;
  ///@}

  /**
   * The important structures that have names, the most important ones first, and their colors in
   * the last frame: a table with the columns Name, Red, Green and Blue, in [0, 1]. Without
   * StructureColors, it has no rows.
   */
  vtkTable* GetStructureLegendTable();

  /**
   * What the camera of the last frame sees of each structure: the third output of
   * vtkExtinctionOptimizer, see there, for this camera and, of several, only for it. It has no
   * shares until the frame has converged; then the first call computes them, which takes about ten
   * times as long as a score and may be aborted like a frame. With opaque geometry, which hides
   * what is behind it, it takes twice as long. With SharesImage, all processes call it together.
   * Without a structure array, the table is empty.
   */
  vtkTable* GetStructureTable();

  ///@{
  /**
   * GetKnownStructureTable returns that table as far as it is known, without computing anything.
   * GetStructuresMeasured: whether that is all there is.
   */
  vtkTable* GetKnownStructureTable();
  bool GetStructuresMeasured() const;
  ///@}

  /**
   * Returns the row in that table, from 0 on, of the structure that the last frame shows most at a
   * place of its renderer, in [0, 1] from the lower left corner; -1 if there is none. Opaque
   * geometry is ignored. With SharesImage, it is -1 in several processes.
   */
  vtkIdType PickStructure(double x, double y) const;

  /**
   * Tells the mapper that nothing is shown: scores and fractions are zero until the next frame. For
   * owners that hide the volume because there is nothing to draw.
   */
  void ClearResults();

  /**
   * Whether the last frame was complete: at full resolution, with a completed optimization.
   */
  bool GetConverged() const;

  /**
   * Whether the optimization of a converged frame ended because another iteration would change next
   * to nothing, rather than at MaximumIterations or MaximumSeconds.
   */
  bool GetSettled() const;

  /**
   * Number of iterations of the optimization at full resolution for the last frame.
   */
  int GetIterations() const;

  /**
   * A readable description of the light of the last frame: which light of the view, and its kind.
   */
  const char* GetLightDescription() const;

  /**
   * The backend of the last optimization, for instance "CPU, 2 threads". Empty before the first.
   */
  const char* GetBackendName() const;

  /**
   * The resolution at which the change of the extinction was found, for instance "half resolution",
   * or if MemoryLimit asks for it, "half resolution: 8.1 of 10 GB". Empty if it is that of the
   * data. See ControlResolution.
   */
  const char* GetOptimizedAt() const;

  /**
   * What computed the last picture, for instance "OpenGL, AMD Radeon 680M", and if it is the
   * processor, why. Empty before the first.
   */
  const char* GetDrawnBy() const;

  /**
   * Bytes of fields, tables and depths that were copied to OpenGL for the last picture; 0 if it did
   * not draw that.
   */
  vtkIdType GetUploadedBytes() const;

  /**
   * The name of Method in panels, for instance "Ament 2017". Empty if there is no such method.
   */
  const char* GetMethodName();

  /**
   * The errors and warnings of the last frame, one per line, including earlier ones that still
   * apply. Empty if there are none.
   */
  const char* GetMessages() const;

  /**
   * Makes a renderer draw its props from back to front, as far as this class can ensure it: for its
   * own volumes. It sorts in the renderer's vtkFrustumCoverageCuller, or in a new one if there is
   * none.
   */
  static void SortBackToFront(vtkRenderer* renderer);

  /**
   * Whether translucent geometry is in front of or inside a volume, which only a renderer that
   * peels volumes draws correctly. Without a volume: of any visible volume, whichever mapper draws
   * it.
   */
  static bool NeedsDepthPeeling(vtkRenderer* renderer, vtkVolume* volume);
  static bool NeedsDepthPeeling(vtkRenderer* renderer);

  /**
   * Frees the memory of everything that can be computed again: fields, optimizations, pictures.
   * Called automatically when the volume is made invisible.
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
  int ExtinctionArrayAssociation = 3; // vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS

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
  int DrawOn = AUTO;
  vtkTypeBool Jitter = 0;
  vtkTypeBool ShowMissed = 0;
  double MissedColor[3] = { 1, 0, 1 };
  double StructureColors = 0;
  double InteractiveFrameTime = 0.1;
  double EaseTime = 0.3;
  vtkTypeBool AdaptiveQuality = 1;
  vtkTypeBool ProgressiveStill = 0;
  vtkTypeBool DeferStill = 0;
  vtkTypeBool SharesImage = 0;
  int WholeExtent[6] = { 0, -1, 0, -1, 0, -1 };

  struct Internals; // hides core types from this header
  std::unique_ptr<Internals> State;
};

#endif
