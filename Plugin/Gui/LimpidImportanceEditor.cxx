// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidImportanceEditor.h"

#include "ImportancePoints.h"
#include "LimpidDataArray.h"
#include "LimpidProperties.h"
#include "pqCoreUtilities.h"
#include "pqLineEdit.h"
#include "pqPropertyWidget.h"
#include "pqTransferFunctionWidget.h"
#include "pqUndoStack.h"
#include "vtkCommand.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkTable.h"

#include <QAction>
#include <QDoubleValidator>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>

#include <algorithm>
#include <array>

namespace
{
const int CHART_HEIGHT = 110; // pixels
const int BINS = 128;

const char* const FUNCTION = "ImportanceFunction"; // the row's property

// Numbers per point of a piecewise function in the property Points.
const std::size_t POINT_SIZE = 4;

pqLineEdit* NewField(const char* name, const QString& toolTip, QWidget* parent)
{
  auto* field = new pqLineEdit(parent);
  field->setObjectName(name);
  field->setToolTip(toolTip);
  field->setValidator(new QDoubleValidator(field));
  return field;
}

// The cursor is moved to the start; otherwise a narrow field would show the end of a number: 521.64
// of 1521.64.
void Fill(QLineEdit* field, const QString& text)
{
  field->setText(text);
  field->setCursorPosition(0);
}
}

LimpidImportanceEditor::LimpidImportanceEditor(pqPropertyWidget* row, vtkSMProxy* function)
  : QWidget(row)
  , Row(row)
  , Function(function)
  , Chart(new pqTransferFunctionWidget(this))
  , Value(
      NewField("PointValue", tr("Value of the point of the curve that was last clicked."), this))
  , Importance(NewField("PointImportance", tr("How important that value is, from 0 to 1."), this))
{
  this->setObjectName("ImportanceEditor");
  this->Chart->setObjectName("Chart");
  this->Chart->setFixedHeight(CHART_HEIGHT);
  this->Chart->setToolTip(
    tr("Importance over the values of the array, and how often each occurs (logarithmic). Drag a "
       "point; click on the curve to add one; Delete removes it."));
  this->Chart->initialize(nullptr, false, this->curve(), true);

  auto* fields = new QHBoxLayout();
  fields->addWidget(new QLabel(tr("Value"), this));
  fields->addWidget(this->Value);
  fields->addWidget(new QLabel(tr("Importance"), this));
  fields->addWidget(this->Importance);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->Chart);
  column->addLayout(fields);
  this->takeOverRow();

  this->connect(this->Chart, &pqTransferFunctionWidget::controlPointsModified, this,
    &LimpidImportanceEditor::takeCurve);
  this->connect(this->Chart, &pqTransferFunctionWidget::currentPointChanged, this,
    &LimpidImportanceEditor::followPoint);
  for (pqLineEdit* field : { this->Value, this->Importance })
  {
    this->connect(
      field, &pqLineEdit::textChangedAndEditingFinished, this, &LimpidImportanceEditor::takeFields);
  }
  pqCoreUtilities::connect(
    function->GetProperty("Points"), vtkCommand::ModifiedEvent, this, SLOT(follow()));

  this->Counting.setSingleShot(true);
  this->connect(&this->Counting, &QTimer::timeout, this, &LimpidImportanceEditor::count);
  for (const char* name : { "ImportanceArray", "ImportanceComponent", "ColorArrayName" })
  {
    if (vtkSMProperty* property = row->proxy()->GetProperty(name))
    {
      pqCoreUtilities::connect(property, vtkCommand::ModifiedEvent, this, SLOT(outdate()));
      pqCoreUtilities::connect(
        property, vtkCommand::UncheckedPropertyModifiedEvent, this, SLOT(outdate()));
    }
  }
  if (vtkSMProxy* source = vtkSMPropertyHelper(row->proxy(), "Input").GetAsProxy())
  {
    pqCoreUtilities::connect(source, vtkCommand::UpdateDataEvent, this, SLOT(outdate()));
  }
  this->follow();
}

// Hides the row's button for a dialog, and connects the one for resetting to the suggestion.
void LimpidImportanceEditor::takeOverRow()
{
  this->Row->layout()->addWidget(this);
  if (auto* edit = this->Row->findChild<QWidget*>("editButton"))
  {
    edit->hide();
  }
  auto* reset = this->Row->findChild<QToolButton*>("resetButton");
  if (QAction* action = reset ? reset->defaultAction() : nullptr)
  {
    action->disconnect(this->Row);
    action->setToolTip(tr(
      "Treat the largest values of the data as important: from the 95th to the 99th percentile."));
    this->connect(action, &QAction::triggered, this, &LimpidImportanceEditor::suggest);
  }
}

vtkPiecewiseFunction* LimpidImportanceEditor::curve() const
{
  return vtkPiecewiseFunction::SafeDownCast(this->Function->GetClientSideObject());
}

std::vector<double> LimpidImportanceEditor::points() const
{
  return PointsOf(this->Row->proxy(), FUNCTION);
}

void LimpidImportanceEditor::setPoints(const std::vector<double>& points)
{
  if (points.empty() || points == this->points())
  {
    return;
  }
  SCOPED_UNDO_SET(tr("Importance Function"));
  SetPoints(this->Row->proxy(), FUNCTION, points);
  Q_EMIT this->Row->changeAvailable();
  Q_EMIT this->Row->changeFinished();
}

void LimpidImportanceEditor::showEvent(QShowEvent* event)
{
  this->QWidget::showEvent(event);
  this->Counting.start(0);
}

void LimpidImportanceEditor::follow()
{
  const std::vector<double> points = this->points();
  this->followPoint();
  if (points.size() < POINT_SIZE)
  {
    return;
  }
  const std::array<double, 2> range{ points.front(), points[points.size() - POINT_SIZE] };
  const std::array<const char*, 2> names{ "rangeMin", "rangeMax" };
  for (std::size_t end = 0; end < 2; ++end)
  {
    if (auto* field = this->Row->findChild<QLineEdit*>(names[end]))
    {
      Fill(field, QString::number(range[end]));
    }
  }
  if (range != this->Range) // the histogram does not depend on the curve
  {
    this->Range = range;
    this->outdate();
  }
}

void LimpidImportanceEditor::followPoint()
{
  const std::vector<double> points = this->points();
  const vtkIdType current = this->Chart->currentPoint();
  const std::size_t begin = POINT_SIZE * static_cast<std::size_t>(std::max<vtkIdType>(current, 0));
  const bool isThere = current >= 0 && begin < points.size();
  const bool isEnd = begin == 0 || begin + POINT_SIZE >= points.size();
  Fill(this->Value, isThere ? QString::number(points[begin]) : QString());
  Fill(this->Importance, isThere ? QString::number(points[begin + 1]) : QString());
  this->Value->setEnabled(isThere && !isEnd); // the ends have fields of their own
  this->Importance->setEnabled(isThere);
}

void LimpidImportanceEditor::outdate()
{
  this->Outdated = true;
  if (this->isVisible())
  {
    this->Counting.start(0);
  }
}

void LimpidImportanceEditor::count()
{
  if (this->Outdated)
  {
    this->Outdated = false;
    this->Chart->setHistogramTable(
      ImportanceArrayOf(this->Row->proxy()).Histogram(this->Range, BINS));
  }
}

void LimpidImportanceEditor::takeCurve()
{
  vtkPiecewiseFunction* curve = this->curve();
  std::vector<double> points(POINT_SIZE * static_cast<std::size_t>(curve->GetSize()));
  for (int i = 0; i < curve->GetSize(); ++i)
  {
    curve->GetNodeValue(i, &points[POINT_SIZE * static_cast<std::size_t>(i)]);
  }
  this->setPoints(points);
}

void LimpidImportanceEditor::takeFields()
{
  std::vector<double> points = this->points();
  const vtkIdType current = this->Chart->currentPoint();
  const std::size_t begin = POINT_SIZE * static_cast<std::size_t>(std::max<vtkIdType>(current, 0));
  if (current < 0 || begin >= points.size())
  {
    return;
  }
  if (begin > 0 && begin + POINT_SIZE < points.size())
  {
    points[begin] = std::clamp(
      this->Value->text().toDouble(), points[begin - POINT_SIZE], points[begin + POINT_SIZE]);
  }
  points[begin + 1] = std::clamp(this->Importance->text().toDouble(), 0., 1.);
  this->setPoints(points);
}

void LimpidImportanceEditor::suggest()
{
  vtkSMProxy* proxy = this->Row->proxy();
  const std::vector<double> suggested = proxy->GetProperty("SuggestedImportance")
    ? vtkSMPropertyHelper(proxy, "SuggestedImportance").GetDoubleArray()
    : ImportanceArrayOf(proxy).SuggestedImportance();
  this->setPoints(limpid::ImportancePoints(suggested));
}
