// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidReveal
 * @brief   presets of an Optimized Volume, a slider from keeping context to revealing, and buttons
 *          that look from the best view and make a movie of it and others
 *
 * For the property ClearingThreshold of a display, with panel_widget="LimpidReveal". The slider is
 * logarithmic: it sets the threshold from 1 down to a ten-thousandth. Presets (Presets.h) and
 * slider are but a way to set properties, and follow them: undo, trace and state have these. The
 * volume follows the slider while it is dragged, which is one step of undo. The plain row of the
 * property is among the advanced ones.
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
  void follow(); // the properties
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
  double chosenThreshold() const; // for the slider's position
  void setAtOnce(double threshold);

  vtkSMProxy* Volume; // has the properties, which the display exposes
  const std::vector<limpid::Preset> Presets;
  QComboBox* PresetBox;
  QSlider* Slider;
  QLabel* RowLabel;
  pqPropertyWidget* Row; // the plain row of the property
  QGridLayout* Grid;
  double ThresholdBeforeDrag = 0;
};

#endif
