// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkOptimizedVolumeRepresentation
 * @brief   shows volumes so that important structures inside are visible
 *
 * The representation type "Optimized Volume" of ParaView: a vtkTransmittanceVolumeMapper with the
 * display's color map, opacity function, unit distance, transformation and cropping, and a text in
 * the view that says how much of the important structures can be seen.
 *
 * Data that are no image are sampled, see SetImageDimensions: what is in no cell is empty. Each
 * process samples what it has.
 *
 * Each view has its own representation of a data set, hence its own optimisation.
 *
 * The properties without a comment are those of the mapper and documented there.
 *
 * Several processes draw the volume together, each its piece of the image, within 1/255 of the
 * picture of one process (see SharesImage of the mapper). What the mapper does not support in
 * distributed runs is left out, with a message; so is translucent geometry that is not wholly
 * behind the volume.
 *
 * @sa vtkTransmittanceVolumeMapper
 */

#ifndef vtkOptimizedVolumeRepresentation_h
#define vtkOptimizedVolumeRepresentation_h

#include "vtkImageVolumeRepresentation.h"
#include "vtkLimpidRepresentationsModule.h" // for export macro
#include "vtkVisibilitySettings.h"          // for the methods that are passed on

#include <memory>  // for the hidden state
#include <set>     // for names of arrays
#include <string>  // for messages
#include <utility> // for times and components
#include <vector>  // for messages

class vtkColorTransferFunction;
class vtkDataArray;
class vtkDataObject;
class vtkDoubleArray;
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
   * The importance array, by association and name, as SetInputArrayToProcess takes it. The name
   * "(Color Array)" stands for the array that the volume is colored by. Default is "Importance", or
   * the color array if there is none of that name.
   */
  void SetImportanceArray(int index, int port, int connection, int association, const char* name);

  /**
   * Suggested ramp of importance: four values of the importance array, or of the array that stands
   * in for it. Importance rises from 0 to 1 between the inner two; the outer two are the range of
   * the array. The ramp is assumed if importance is not specified, and is a starting point
   * otherwise. All values are 0 if there are no data yet, if the array is constant, or if its
   * values are importance themselves: an array that was chosen, with values in [0, 1].
   */
  double* GetSuggestedImportance() VTK_SIZEHINT(4);

  ///@{
  /**
   * Source of the extinction, and its array by association and name as for SetImportanceArray.
   * Defaults are the opacity function and "Extinction".
   */
  void SetExtinctionSource(int);
  void SetExtinctionArray(int index, int port, int connection, int association, const char* name);
  ///@}

  /**
   * The mapper's settings of importance, weights, own light and solver. ScalarComponent is that of
   * the color map.
   */
  vtkVisibilitySettings* GetVisibilitySettings();

  /// The methods of vtkVisibilitySettings, see there.
  LIMPID_FORWARD_VISIBILITY_SETTINGS();

  /**
   * Number of points along each axis at which input that is not an image is sampled; 0: as many as
   * make the image as fine as the data, or as fit into memory. Default is 0, 0, 0. Images are not
   * sampled. GetSampledAt returns what was chosen, as a text; empty for images.
   */
  void SetImageDimensions(int x, int y, int z);
  const char* GetSampledAt();

  /**
   * When and how to optimise.
   */
  void SetOptimization(int);

  ///@{
  /**
   * Lighting. The names differ from the mapper's where vtkImageVolumeRepresentation has a method of
   * that name for the volume's property.
   */
  void SetShadows(int);
  void SetShadowStrength(double);
  void SetLightSource(int);
  void SetDrawOn(int);
  void SetLightIntensity(double);
  void SetVolumeAmbient(double);
  void SetVolumeSpecular(double);
  void SetVolumeSpecularPower(double);
  void SetScatteringAnisotropy(double);
  ///@}

  ///@{
  /**
   * Color map and opacity function. Null: ParaView's default colors and a straight line from 0 to 1
   * over the range of the array that is shown.
   */
  void SetColor(vtkColorTransferFunction*);
  void SetScalarOpacity(vtkPiecewiseFunction*);
  ///@}

  ///@{
  /**
   * A separate opacity array, values that are colors, and interpolation other than linear are not
   * supported: if one is requested, there is a message, and the volume is drawn without.
   */
  void SetUseSeparateOpacityArray(bool);
  void SetUseTransfer2D(bool);
  void SetMapScalars(bool);
  void SetMultiComponentsMapping(bool);
  void SetInterpolationType(int);
  ///@}

  ///@{
  /**
   * Quality of the picture and time limits.
   */
  void SetSampleDistance(double);
  void SetJitter(int);
  void SetShowMissed(int);
  void SetMissedColor(double red, double green, double blue);
  void SetStructureColors(double);
  void AddLabelColor(double label, double red, double green, double blue);
  void RemoveAllLabelColors();
  void SetAdaptiveQuality(int);
  void SetInteractiveFrameTime(double);
  void SetEaseTime(double);
  ///@}

  /**
   * Whether to keep the extinction while cameras and lights move. Default is off.
   */
  void SetPauseOptimization(int);

  /**
   * Discards the optimisation; the next picture starts a new one.
   */
  void ResetOptimization();

  /**
   * Whether each of the following still renders makes one step, for a client that renders until
   * Converged. The client sets it for each render; it is not saved in states. Default is off.
   */
  void SetProgressiveStill(int);

  /**
   * Whether the following still renders are made like interactive ones. The client sets it for each
   * render; it is not saved in states. Default is off.
   */
  void SetDeferStill(int);

  /**
   * Computes a part of the unoptimized picture while a client shows the converged optimized one.
   * Returns whether work is left.
   */
  int PrepareOriginal();

  /**
   * Whether the view shows how much of the important structures can be seen. Default is on.
   */
  void SetShowScore(int);

  /**
   * Whether screenshots show this text, too. Default is off.
   */
  void SetScoreInScreenshots(int);

  /**
   * Whether the view lists the important structures that have names with their colors, while
   * StructureColors is above 0. Default is on.
   */
  void SetStructureLegend(int);

  /**
   * Name of this volume in the text, if a view shows several optimised volumes. The client sets it
   * for each render; it is not saved in states. Default is empty: no name is shown.
   */
  void SetSourceName(const char*);

  ///@{
  /**
   * Results for the last picture, on the process that drew it; see the mapper.
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
  const char* GetOptimizedAt();
  const char* GetDrawnBy();
  ///@}

  /**
   * Shares of what the data have of each structure, for the last picture: visible, visible before,
   * removed, attainable (see the filter), one row after the other in the order of the structures;
   * as far as known. They are measured for the text in the view, and by MeasureStructures.
   */
  vtkDoubleArray* GetStructureShares();

  ///@{
  /**
   * Measures these shares if the last picture has converged. It may take as long as the picture.
   * If processes draw together, all of them call it. GetStructuresMeasured returns whether there is
   * nothing to measure.
   */
  void MeasureStructures();
  int GetStructuresMeasured();
  ///@}

  /**
   * Returns the row of the structure that the last picture shows most at a place of the view, in
   * [0, 1] from its lower left corner; -1 if there is none.
   */
  int PickStructure(double x, double y);

  /**
   * What could not be drawn as requested in the last picture, and what to do about it, one per
   * line. Empty if there is nothing.
   */
  const char* GetMessages();

protected:
  vtkOptimizedVolumeRepresentation();
  ~vtkOptimizedVolumeRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void UpdateMapperParameters() override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  bool HasSomethingToDraw();
  std::string Sample(vtkDataObject* input);
  std::set<std::string> ArraysUsed();
  bool HasSampled(const std::set<std::string>& names) const;
  void SampleFurther();
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
