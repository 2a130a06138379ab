// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkScoreAnnotation
 * @brief   text in the upper left corner about the last picture of a volume mapper
 *
 * The text is requested when overlays are drawn, which is after the volumes of the same frame. It
 * has a dark, translucent background plate, so that it is readable on any picture. Plates of their
 * own below it have the legends of a colour and of structures. Several annotations in a renderer
 * are placed below each other.
 */

#ifndef vtkScoreAnnotation_h
#define vtkScoreAnnotation_h

#include "vtkLimpidRepresentationsModule.h" // for export macro
#include "vtkNew.h"                         // for the drawing of the text
#include "vtkProp.h"

#include <functional> // for the source of the text
#include <string>     // for the text

class vtkRenderer;
class vtkTable;
class vtkTextActor;

class VTKLIMPIDREPRESENTATIONS_EXPORT vtkScoreAnnotation : public vtkProp
{
public:
  static vtkScoreAnnotation* New();
  vtkTypeMacro(vtkScoreAnnotation, vtkProp);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Function that returns the text of a frame. Nothing is drawn if it is null or if the text is
  /// empty.
  void SetTextSource(std::function<std::string()> source);

  /// Function that returns the legend of a colour, which is drawn in that colour on a plate of its
  /// own below the text. Nothing is drawn if it is null or if the legend is empty.
  void SetLegendSource(std::function<std::string()> source);
  void SetLegendColor(const double color[3]);

  /// Function that returns structures to list with their colours, see
  /// vtkTransmittanceVolumeMapper::GetStructureLegendTable. As many are listed as have room, at
  /// most twelve. Nothing is drawn if it is null or returns null or no rows.
  void SetStructureSource(std::function<vtkTable*()> source);

  /// Claims the whole view of a renderer for the present frame, or nothing. If processes compose a
  /// frame, only the parts claimed by props are taken from each process.
  void ClaimView(vtkRenderer* renderer);
  void ClaimNothing() { this->UseBoundsOff(); }
  double* GetBounds() VTK_SIZEHINT(6) override { return this->UseBounds ? this->Bounds : nullptr; }

  int RenderOverlay(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkScoreAnnotation();
  ~vtkScoreAnnotation() override;

private:
  vtkScoreAnnotation(const vtkScoreAnnotation&) = delete;
  void operator=(const vtkScoreAnnotation&) = delete;

  std::string CurrentText();
  std::string CurrentLegend();
  vtkTable* CurrentStructures();
  double LowestOtherAnnotation(vtkViewport* viewport);
  int DrawPlate(vtkViewport* viewport, const std::string& text, vtkTextActor* actor, double left);
  int DrawStructures(vtkViewport* viewport, vtkTable* structures);

  std::function<std::string()> TextSource;
  std::function<std::string()> LegendSource;
  std::function<vtkTable*()> StructureSource;
  double Bounds[6] = {};
  double Bottom = 1; // lower end of the plates in the last frame, as a share of the viewport's
                     // height
  vtkNew<vtkTextActor> Actor;
  vtkNew<vtkTextActor> Legend;
  vtkNew<vtkTextActor> Names; // of structures
};

#endif
