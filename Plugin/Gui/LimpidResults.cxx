// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidResults.h"

#include "pqCoreUtilities.h"
#include "vtkCommand.h"
#include "vtkSMIntVectorProperty.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMStringVectorProperty.h"

#include <QFormLayout>
#include <QLabel>

#include <cstring>

namespace
{
const int DIGITS = 5;

QString TextOf(vtkSMProperty* property)
{
  const vtkSMPropertyHelper helper(property);
  if (helper.GetNumberOfElements() == 0)
  {
    return {};
  }
  if (vtkSMStringVectorProperty::SafeDownCast(property))
  {
    return helper.GetAsString();
  }
  if (vtkSMIntVectorProperty::SafeDownCast(property))
  {
    return QString::number(helper.GetAsInt());
  }
  const bool isShare = QString(property->GetXMLName()).endsWith("Fraction");
  return isShare ? QString("%1 %").arg(100 * helper.GetAsDouble(), 0, 'f', 1)
                 : QString::number(helper.GetAsDouble(), 'g', DIGITS);
}
}

LimpidResults::LimpidResults(vtkSMProxy* display, vtkSMPropertyGroup* group, QWidget* parentWidget)
  : pqPropertyWidget(display, parentWidget)
{
  this->setShowLabel(false);
  auto* rows = new QFormLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  for (unsigned int i = 0; i < group->GetNumberOfProperties(); ++i)
  {
    vtkSMProperty* property = group->GetProperty(i);
    const bool isTable = property->GetRepeatable() != 0; // LimpidStructures shows it
    if (isTable || std::strcmp(property->GetPanelVisibility(), "never") == 0)
    {
      continue;
    }
    auto* text = new QLabel(this);
    text->setObjectName(property->GetXMLName());
    text->setToolTip(getTooltip(property));
    text->setWordWrap(true);
    text->setTextInteractionFlags(Qt::TextSelectableByMouse);
    rows->addRow(property->GetXMLLabel(), text);
    this->Rows.emplace_back(property, text);
    pqCoreUtilities::connect(property, vtkCommand::ModifiedEvent, this, SLOT(follow()));
  }
  this->follow();
}

void LimpidResults::follow()
{
  for (const auto& [property, text] : this->Rows)
  {
    text->setText(TextOf(property));
  }
}
