// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidRows.h"

#include "LimpidImportanceEditor.h"
#include "pqCoreUtilities.h"
#include "pqPropertyWidget.h"
#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <algorithm>
#include <cstring>

namespace
{
// Returns whether the row's function is there.
bool AddEditor(pqPropertyWidget* row)
{
  vtkSMPropertyHelper functions(row->property());
  if (functions.GetNumberOfElements() == 0 || !functions.GetAsProxy())
  {
    return false;
  }
  if (row->layout())
  {
    new LimpidImportanceEditor(row, functions.GetAsProxy());
  }
  return true;
}
}

LimpidRows::LimpidRows(QObject* parentObject)
  : QObject(parentObject)
{
}

void LimpidRows::createDefaultWidgetDecorators(pqPropertyWidget* row)
{
  vtkSMProperty* property = row->property();
  if (!property || !property->GetXMLName() ||
    std::strcmp(property->GetXMLName(), "ImportanceFunction") != 0)
  {
    return;
  }
  if (!AddEditor(row))
  {
    // Undo makes rows of a display before it is complete.
    this->Waiting.append(row);
    pqCoreUtilities::connect(property, vtkCommand::ModifiedEvent, this, SLOT(addEditors()));
  }
}

void LimpidRows::addEditors()
{
  const auto isOver = [](const QPointer<pqPropertyWidget>& row) { return !row || AddEditor(row); };
  this->Waiting.erase(
    std::remove_if(this->Waiting.begin(), this->Waiting.end(), isOver), this->Waiting.end());
}
