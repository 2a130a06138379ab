// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidRows.h"

#include "LimpidImportanceEditor.h"
#include "pqPropertyWidget.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <cstring>

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
  vtkSMPropertyHelper functions(row->property());
  if (functions.GetNumberOfElements() > 0 && functions.GetAsProxy() && row->layout())
  {
    new LimpidImportanceEditor(row, functions.GetAsProxy());
  }
}
