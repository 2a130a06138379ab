// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidReveal
 * @brief   presets of an Optimized Volume, a slider from keeping context to revealing, and buttons
 *          that go to the best view and make movies of it and of others
 *
 * For the property ClearingThreshold of a display, with panel_widget="LimpidReveal". The slider is
 * logarithmic: it sets the threshold from 100 down to 0.0001. Presets (Presets.h) and slider only
 * set properties and follow their changes, so that undo, trace and state contain these. The volume
 * follows the slider while it is dragged; the drag is one undo step. The plain row of the property
 * is advanced.
 */

#ifndef LimpidReveal_h
#define LimpidReveal_h

#include "Presets.h"
#include "pqPropertyWidget.h"

class QComboBox;
class QGridLayout;
class QIcon;
class QLabel;
class QPushButton;
class QSlider;

class LimpidReveal : public pqPropertyWidget
{
  Q_OBJECT

public:
  LimpidReveal(vtkSMProxy* proxy, vtkSMProperty* threshold, QWidget* parent = nullptr);

  void apply() override;
  void reset() override;
  void updateWidget(bool showingAdvanced) override;
  bool eventFilter(QObject* object, QEvent* event) override;

protected:
  void resizeEvent(QResizeEvent* event) override;

private Q_SLOTS:
  void follow(); // shows changes of the properties
  void choosePreset();
  void moveSlider();
  void beginDrag();
  void endDrag();

private:
  void createPresets();
  void createSlider();
  QPushButton* newButton(const char* name, const QIcon& icon, const QString& text,
    const QString& toolTip, void (*act)());
  void followPreset();
  void followThreshold();
  double chosenThreshold() const; // by the position of the slider
  void setAtOnce(double threshold);

  vtkSMProxy* Volume; // owner of the properties, which the display exposes
  const std::vector<limpid::Preset> Presets;
  QComboBox* PresetBox;
  QSlider* Slider;
  QLabel* RowLabel;
  pqPropertyWidget* Row; // the plain row of the property
  QGridLayout* Grid;
  double ThresholdBeforeDrag = 0;
};

#endif
