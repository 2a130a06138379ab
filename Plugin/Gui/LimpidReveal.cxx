// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidReveal.h"

#include "LimpidBestView.h"
#include "LimpidMovie.h"

#include "pqCoreUtilities.h"
#include "pqDoubleVectorPropertyWidget.h"
#include "pqPropertiesPanel.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMViewProxy.h"

#include <QComboBox>
#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QStandardItemModel>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace
{
const char* const THRESHOLD = "ClearingThreshold";
// The threshold is 10^-LEAST at one end of the slider, where almost nothing is cleared, and
// 10^-MOST at the other, where everything worth clearing is. With opacities that rise along a
// straight line, nearly all matter is much thinner than the densest, and thresholds far above 1
// keep it.
const double LEAST = -2;
const double MOST = 4;
const int STEPS = 100; // per power of ten

double Value(vtkSMProxy* volume, const char* name)
{
  return vtkSMPropertyHelper(volume, name).GetAsDouble();
}

// Sets the unchecked value of a property, which its row shows and Apply accepts.
void FillIn(vtkSMProxy* volume, const char* name, double value)
{
  vtkSMPropertyHelper helper(volume, name);
  helper.SetUseUnchecked(true);
  helper.Set(value);
}

void TakeOver(vtkSMProxy* volume, const char* name)
{
  vtkSMPropertyHelper helper(volume, name);
  helper.SetUseUnchecked(true);
  vtkSMPropertyHelper(volume, name).Set(helper.GetAsDouble());
}

// Rounds to three digits, as a person would type.
double Rounded(double threshold)
{
  return QString::number(threshold, 'g', 3).toDouble();
}
}

LimpidReveal::LimpidReveal(vtkSMProxy* display, vtkSMProperty* threshold, QWidget* parentWidget)
  : pqPropertyWidget(display, parentWidget)
  , Volume(threshold->GetParent())
  , Presets(limpid::PresetsFor(this->Volume))
  , PresetBox(new QComboBox(this))
  , Slider(new QSlider(Qt::Horizontal, this))
  , RowLabel(new QLabel(threshold->GetXMLLabel(), this))
  , Row(new pqDoubleVectorPropertyWidget(threshold, display, this))
  , Grid(new QGridLayout(this))
{
  this->setShowLabel(false);
  this->Row->setProperty(threshold);
  this->Row->setObjectName("Row");
  this->RowLabel->setWordWrap(true);
  this->createPresets();
  this->createSlider();
  for (QWidget* widget : std::initializer_list<QWidget*>{ this->PresetBox, this->Slider })
  {
    widget->setFocusPolicy(Qt::StrongFocus);
    widget->installEventFilter(this);
  }

  auto* ends = new QHBoxLayout();
  ends->addWidget(new QLabel(tr("Keep Context"), this));
  ends->addWidget(this->Slider, 1);
  ends->addWidget(new QLabel(tr("Reveal"), this));
  this->Grid->setContentsMargins(0, 0, 0, 0);
  this->Grid->setSpacing(pqPropertiesPanel::suggestedVerticalSpacing());
  this->Grid->setColumnStretch(1, 1);
  this->Grid->addWidget(new QLabel(tr("Preset"), this), 0, 0);
  this->Grid->addWidget(this->PresetBox, 0, 1);
  this->Grid->addLayout(ends, 1, 0, 1, 2);
  this->Grid->addWidget(this->RowLabel, 2, 0);
  this->Grid->addWidget(this->Row, 2, 1);
  this->Grid->addWidget(this->newButton("FindBestView", BestViewIcon(), tr("Find Best View"),
                          BestViewToolTip(), &FindBestView),
    3, 0, 1, 2);
  this->Grid->addWidget(
    this->newButton("MakeMovie", MovieIcon(), tr("Make Movie"), MovieToolTip(), &MakeMovie), 4, 0,
    1, 2);

  this->connect(
    this->Row, &pqPropertyWidget::changeAvailable, this, &pqPropertyWidget::changeAvailable);
  this->connect(
    this->Row, &pqPropertyWidget::changeFinished, this, &pqPropertyWidget::changeFinished);
  for (const auto& entry : this->Presets.front().values)
  {
    pqCoreUtilities::connect(this->Volume->GetProperty(entry.first.c_str()),
      vtkCommand::ModifiedEvent, this, SLOT(follow()));
  }
  this->follow();
}

void LimpidReveal::createPresets()
{
  for (const limpid::Preset& preset : this->Presets)
  {
    this->PresetBox->addItem(QString::fromStdString(preset.name));
  }
  // Shown if no preset matches; it cannot be chosen.
  this->PresetBox->addItem(tr("Custom"));
  auto* items = qobject_cast<QStandardItemModel*>(this->PresetBox->model());
  items->item(this->PresetBox->count() - 1)->setEnabled(false);
  this->PresetBox->setObjectName("Preset");
  this->PresetBox->setToolTip(getTooltip(this->Volume->GetProperty("Preset")));
  this->connect(this->PresetBox, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    &LimpidReveal::choosePreset);
}

void LimpidReveal::createSlider()
{
  this->Slider->setObjectName("Reveal");
  this->Slider->setToolTip(
    tr("How much of what hides important structures is cleared. On the left, everything stays as "
       "the transfer functions define it. Sets the Clearing Threshold."));
  this->Slider->setRange(0, static_cast<int>((MOST - LEAST) * STEPS));
  this->Slider->setSingleStep(STEPS / 10);
  this->Slider->setPageStep(STEPS / 2);
  this->connect(this->Slider, &QSlider::valueChanged, this, &LimpidReveal::moveSlider);
  this->connect(this->Slider, &QSlider::sliderPressed, this, &LimpidReveal::beginDrag);
  this->connect(this->Slider, &QSlider::sliderReleased, this, &LimpidReveal::endDrag);
}

QPushButton* LimpidReveal::newButton(
  const char* name, const QIcon& icon, const QString& text, const QString& toolTip, void (*act)())
{
  auto* button = new QPushButton(icon, text, this);
  button->setObjectName(name);
  button->setToolTip(toolTip);
  this->connect(button, &QPushButton::clicked, this, [act] { act(); });
  return button;
}

void LimpidReveal::apply()
{
  SCOPED_UNDO_SET(tr("Property Changed"));
  this->Row->apply();
  for (const auto& entry : this->Presets.front().values)
  {
    TakeOver(this->Volume, entry.first.c_str());
  }
  this->proxy()->UpdateVTKObjects();
  this->pqPropertyWidget::apply();
}

void LimpidReveal::reset()
{
  this->Row->reset();
  this->pqPropertyWidget::reset();
  this->follow();
}

void LimpidReveal::updateWidget(bool showingAdvanced)
{
  this->RowLabel->setVisible(showingAdvanced);
  this->Row->setVisible(showingAdvanced);
}

// Ignores the wheel, so that scrolling the panel changes nothing.
bool LimpidReveal::eventFilter(QObject* object, QEvent* event)
{
  if (event->type() == QEvent::Wheel && !qobject_cast<QWidget*>(object)->hasFocus())
  {
    event->ignore();
    return true;
  }
  return this->pqPropertyWidget::eventFilter(object, event);
}

// Aligns the labels with the panel's other rows.
void LimpidReveal::resizeEvent(QResizeEvent* event)
{
  this->pqPropertyWidget::resizeEvent(event);
  if (auto* panel = qobject_cast<QGridLayout*>(this->parentWidget()->layout()))
  {
    this->Grid->setColumnMinimumWidth(0, panel->cellRect(0, 0).width());
  }
}

void LimpidReveal::follow()
{
  this->followPreset();
  this->followThreshold();
}

void LimpidReveal::followPreset()
{
  const limpid::Preset* preset = limpid::FindPreset(this->Presets, this->Volume);
  const QSignalBlocker blocker(this->PresetBox);
  this->PresetBox->setCurrentIndex(
    static_cast<int>(preset ? preset - this->Presets.data() : this->Presets.size()));
}

void LimpidReveal::followThreshold()
{
  // If the threshold is 0, the regularisation weight is used, which the slider does not show.
  const double threshold = Value(this->Volume, THRESHOLD);
  const double power = threshold > 0 ? -std::log10(threshold) : MOST;
  const double steps = (std::clamp(power, LEAST, MOST) - LEAST) * STEPS;
  const QSignalBlocker blocker(this->Slider);
  this->Slider->setValue(static_cast<int>(std::lround(steps)));
  const bool optimises =
    Value(this->Volume, "ViewWeight") > 0 || Value(this->Volume, "LightWeight") > 0;
  this->Slider->setEnabled(optimises);
}

void LimpidReveal::choosePreset()
{
  const std::string name = this->PresetBox->currentText().toStdString();
  if (const limpid::Preset* preset = limpid::FindPreset(this->Presets, name))
  {
    for (const auto& entry : preset->values)
    {
      FillIn(this->Volume, entry.first.c_str(), entry.second);
    }
    Q_EMIT this->changeAvailable();
    Q_EMIT this->changeFinished();
  }
}

double LimpidReveal::chosenThreshold() const
{
  return Rounded(std::pow(10.0, -LEAST - double(this->Slider->value()) / STEPS));
}

void LimpidReveal::moveSlider()
{
  if (!this->Slider->isSliderDown())
  {
    FillIn(this->Volume, THRESHOLD, this->chosenThreshold());
    Q_EMIT this->changeAvailable();
    Q_EMIT this->changeFinished();
    return;
  }
  this->setAtOnce(this->chosenThreshold());
  if (this->view())
  {
    this->view()->getViewProxy()->InteractiveRender(); // as fast as while the volume is rotated
  }
}

void LimpidReveal::beginDrag()
{
  this->ThresholdBeforeDrag = Value(this->Volume, THRESHOLD);
}

// Makes the whole drag a single change for undo and trace.
void LimpidReveal::endDrag()
{
  const int end = this->Slider->value();
  if (Value(this->Volume, THRESHOLD) != this->ThresholdBeforeDrag)
  {
    this->setAtOnce(this->ThresholdBeforeDrag);
    this->Slider->setValue(end);
  }
  if (this->view())
  {
    this->view()->render();
  }
}

void LimpidReveal::setAtOnce(double threshold)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(this->Volume, THRESHOLD).Set(threshold);
  this->proxy()->UpdateVTKObjects();
}
