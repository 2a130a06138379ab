// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkScoreAnnotation
 * @brief   text in the upper left corner about what a volume mapper has just drawn
 *
 * The text is asked for when overlays are drawn, which is after the volumes of the same frame. It
 * stands on a dark, half transparent plate, so that it can be read on any background. Several
 * annotations in a renderer stand below each other.
 */

#ifndef vtkScoreAnnotation_h
#define vtkScoreAnnotation_h

#include "vtkLimpidRepresentationsModule.h" // for export macro
#include "vtkNew.h"                         // for the drawing of the text
#include "vtkProp.h"

#include <functional> // for the source of the text
#include <string>     // for the text

class vtkRenderer;
class vtkTextActor;

class VTKLIMPIDREPRESENTATIONS_EXPORT vtkScoreAnnotation : public vtkProp
{
public:
  static vtkScoreAnnotation* New();
  vtkTypeMacro(vtkScoreAnnotation, vtkProp);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What says the text of a frame; an empty text is not drawn. None: nothing is drawn.
  void SetTextSource(std::function<std::string()> source);

  /// What says what a colour means, on a plate of its own below, in that colour. Likewise.
  void SetLegendSource(std::function<std::string()> source);
  void SetLegendColor(const double color[3]);

  /// Claims all of a renderer's view for the present frame, or nothing. Where processes put a frame
  /// together, only what props claim is taken from each.
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
  double BottomOfOthers(vtkViewport* viewport);
  int DrawPlate(vtkViewport* viewport, const std::string& text, vtkTextActor* actor);

  std::function<std::string()> TextSource;
  std::function<std::string()> LegendSource;
  double Bounds[6] = {};
  double Bottom = 1; // of the plates in the last frame, share of the viewport's height
  vtkNew<vtkTextActor> Actor;
  vtkNew<vtkTextActor> Legend;
};

#endif
