// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidMovie
 * @brief   a dialog that makes a movie of the best views of an optimised volume
 *
 * The views of the volume are scored when it opens. What a CameraPath finds among them is previewed
 * in the view. To accept makes it the animation of the view's camera, which can be undone and which
 * the trace has; File > Save Animation writes it. Nothing else stays: the search and the path are
 * in no pipeline browser, and a cancelled preview leaves the camera where it was.
 */

#ifndef LimpidMovie_h
#define LimpidMovie_h

#include "scene/RaySource.h"
#include "vtkSmartPointer.h"

#include <QDialog>
#include <QPointer>
#include <QTimer>

#include <vector>

class pqRenderView;
class vtkSMSourceProxy;
class QIcon;
class QLabel;
class QPushButton;
class QSlider;
class QSpinBox;

class LimpidMovie : public QDialog
{
  Q_OBJECT

public:
  /// `search`: a ViewpointSearch that was executed for this view.
  LimpidMovie(vtkSMSourceProxy* search, pqRenderView* view, QWidget* parent);
  ~LimpidMovie() override;

  void accept() override;
  void reject() override;

private Q_SLOTS:
  void findPath();
  void showFrame(int number);
  void playOrStop();
  void playNext();

private:
  QSpinBox* addNumber(const char* name, int least, int most, int value);
  void createPreview();
  void close(const limpid::Camera& camera, int result);

  vtkSmartPointer<vtkSMSourceProxy> Path;
  QPointer<pqRenderView> View;
  limpid::Camera Before; // of the view, when the dialog opened
  std::vector<limpid::Camera> Frames;
  QSpinBox* KeyViews;
  QSpinBox* FrameCount;
  QLabel* Says;
  QSlider* Slider = nullptr;
  QPushButton* Play = nullptr;
  QPushButton* Make = nullptr;
  QTimer Playing;
};

/// Opens the dialog for the optimised volume of the active view, the active one if there are
/// several.
void MakeMovie();

/// What buttons for that look like, and say.
QIcon MovieIcon();
QString MovieToolTip();

#endif
