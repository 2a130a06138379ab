// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkOptimizedVolumeRepresentation
 * @brief   shows image data so that important structures inside can be seen
 *
 * The representation type "Optimized Volume" of ParaView: a vtkTransmittanceVolumeMapper with the
 * display's color map, opacity function, unit distance, transformation and cropping, and a text in
 * the view that says how much of the important structures can be seen.
 *
 * Each view has its own representation of a data set, so each has an optimisation of its own.
 *
 * The properties without a comment are those of the mapper, which says what they mean.
 *
 * Several processes draw the volume together, each its piece of the image, within 1/255 of the
 * picture of one (see SharesImage of the mapper). What the mapper says they cannot do together is
 * left out, with a message; so is what of translucent geometry is not wholly behind the volume.
 *
 * @sa vtkTransmittanceVolumeMapper
 */

#ifndef vtkOptimizedVolumeRepresentation_h
#define vtkOptimizedVolumeRepresentation_h

#include "vtkImageVolumeRepresentation.h"
#include "vtkLimpidRepresentationsModule.h" // for export macro
#include "vtkVisibilitySettings.h"          // for the methods that are passed on

#include <memory>  // for the hidden state
#include <string>  // for messages
#include <utility> // for times and components
#include <vector>  // for messages

class vtkColorTransferFunction;
class vtkDataArray;
class vtkImageData;
class vtkMultiProcessController;
class vtkPiecewiseFunction;

namespace limpid
{
class SharedArray;
struct ScalarChoice;
}

class VTKLIMPIDREPRESENTATIONS_EXPORT vtkOptimizedVolumeRepresentation
  : public vtkImageVolumeRepresentation
{
public:
  static vtkOptimizedVolumeRepresentation* New();
  vtkTypeMacro(vtkOptimizedVolumeRepresentation, vtkImageVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void SetVisibility(bool visible) override;

  /**
   * What is important: an array by association and name, as SetInputArrayToProcess takes it. The
   * name "(Color Array)" stands for the array that the volume is colored by. Default is
   * "Importance", or the color array if there is none of that name.
   */
  void SetImportanceArray(int index, int port, int connection, int association, const char* name);

  /**
   * What is assumed where nothing says what is important, and where to start from otherwise: four
   * values of the importance array, or of the array that stands for it. Between the inner two
   * importance rises from 0 to 1; the outer two are the range of the array. All are 0 if there are
   * no data yet, if all values are alike, and if they are importance themselves: of an array that
   * was chosen, and from 0 to 1.
   */
  double* GetSuggestedImportance() VTK_SIZEHINT(4);

  ///@{
  /**
   * Where the extinction comes from, and the array with it, by association and name as for
   * SetImportanceArray. Default is the opacity function, and "Extinction".
   */
  void SetExtinctionSource(int);
  void SetExtinctionArray(int index, int port, int connection, int association, const char* name);
  ///@}

  /**
   * Those of the mapper: importance, weights, own light and solver. ScalarComponent is that of the
   * color map.
   */
  vtkVisibilitySettings* GetVisibilitySettings();

  /// The methods of vtkVisibilitySettings, documented there.
  LIMPID_FORWARD_VISIBILITY_SETTINGS();

  /**
   * When something is done about what is important.
   */
  void SetOptimization(int);

  ///@{
  /**
   * How it is lit. The names differ from the mapper's where vtkImageVolumeRepresentation has a
   * method of that name for the volume's property.
   */
  void SetShadows(int);
  void SetShadowStrength(double);
  void SetLightSource(int);
  void SetLightIntensity(double);
  void SetVolumeAmbient(double);
  void SetVolumeSpecular(double);
  void SetVolumeSpecularPower(double);
  void SetScatteringAnisotropy(double);
  ///@}

  ///@{
  /**
   * Color map and opacity function; none: ParaView's default colors and a straight line from 0 to 1
   * over the range of the array that is shown.
   */
  void SetColor(vtkColorTransferFunction*);
  void SetScalarOpacity(vtkPiecewiseFunction*);
  ///@}

  ///@{
  /**
   * Not available, nor values that are colors themselves, nor interpolation other than linear:
   * there is a message if it is asked for, and the volume is drawn without.
   */
  void SetUseSeparateOpacityArray(bool);
  void SetUseTransfer2D(bool);
  void SetMapScalars(bool);
  void SetMultiComponentsMapping(bool);
  void SetInterpolationType(int);
  ///@}

  ///@{
  /**
   * How it is drawn.
   */
  void SetSampleDistance(double);
  void SetJitter(int);
  void SetShowMissed(int);
  void SetMissedColor(double red, double green, double blue);
  void SetAdaptiveQuality(int);
  void SetInteractiveFrameTime(double);
  void SetEaseTime(double);
  ///@}

  /**
   * Keep the extinction as it is, whatever moves. Default is off.
   */
  void SetPauseOptimization(int);

  /**
   * Forget what was optimised; begin anew with the next picture.
   */
  void ResetOptimization();

  /**
   * Whether the following still renders make one step each, for a client that goes on rendering
   * until Converged. Set for each render by that client, part of no state. Default is off.
   */
  void SetProgressiveStill(int);

  /**
   * Whether the following still renders are made like interactive ones, likewise.
   */
  void SetDeferStill(int);

  /**
   * Makes a part of the picture without optimization while a client shows the finished one with it;
   * likewise. Returns whether something is left to be done.
   */
  int PrepareOriginal();

  /**
   * Whether the view shows how much of the important structures can be seen. Default is on.
   */
  void SetShowScore(int);

  /**
   * Whether saved pictures show it, too. Default is off.
   */
  void SetScoreInScreenshots(int);

  /**
   * What the score is called where a view shows several optimised volumes. Set for each render by
   * the client, part of no state. Default is an empty name, which is not shown.
   */
  void SetSourceName(const char*);

  ///@{
  /**
   * What came of the last picture, on the process that drew it.
   */
  double GetVisibilityScore();
  double GetBaseVisibilityScore();
  double GetVisibleFraction();
  double GetBaseVisibleFraction();
  double GetSacrificedFraction();
  double GetAttainableFraction();
  double GetAttainableScore();
  double GetAttainableLightScore();
  int GetConverged();
  int GetIterations();
  const char* GetLightDescription();
  const char* GetBackendName();
  ///@}

  /**
   * What could not be done for the last picture as it was asked for, and what to do about it, one a
   * line. Empty if all is well.
   */
  const char* GetMessages();

protected:
  vtkOptimizedVolumeRepresentation();
  ~vtkOptimizedVolumeRepresentation() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void UpdateMapperParameters() override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  bool HasSomethingToDraw();
  void BeginFrame(vtkObject* renderer, unsigned long event, void* data);
  void EndFrame(vtkObject* renderer, unsigned long event, void* data);
  vtkDataArray* ApplyScalars(vtkImageData* image, std::vector<std::string>& messages);
  vtkMultiProcessController* Others() const;
  limpid::SharedArray Shared(const limpid::ScalarChoice& choice, vtkImageData* image) const;
  void ApplyComponent(vtkDataArray* scalars);
  std::pair<vtkMTimeType, int> TimeAndComponentOf(vtkDataArray* scalars) const;
  void ApplyFunctions(const limpid::ScalarChoice& scalars, vtkImageData* image);
  void AssumeImportance(const limpid::ScalarChoice& scalars, vtkImageData* image);
  void ApplyImportance(vtkImageData* image, const limpid::ScalarChoice& colors);
  void AddUnavailable(int components, std::vector<std::string>& messages) const;
  void Say(const std::vector<std::string>& messages);

  vtkOptimizedVolumeRepresentation(const vtkOptimizedVolumeRepresentation&) = delete;
  void operator=(const vtkOptimizedVolumeRepresentation&) = delete;

  struct Internals;
  std::unique_ptr<Internals> State;
};

#endif
