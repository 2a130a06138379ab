// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidPresets.h"

#include "vtkSMSettings.h"
#include "vtkSMTransferFunctionPresets.h"

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

namespace
{
// Priority of these settings, below those of users and administrators.
const double LEAST_PRIORITY = 0;
}

LimpidPresets::LimpidPresets(QObject* parentObject)
  : QObject(parentObject)
{
}

void LimpidPresets::onStartup()
{
  QFile file(":/Limpid/Presets.json");
  if (!file.open(QIODevice::ReadOnly))
  {
    return;
  }
  vtkSMTransferFunctionPresets* presets = vtkSMTransferFunctionPresets::GetInstance();
  const QJsonArray added = QJsonDocument::fromJson(file.readAll()).array();
  for (const QJsonValue preset : added) // Qt 6 returns references of its own type here
  {
    const std::string name = preset.toObject().value("Name").toString().toStdString();
    if (!presets->HasPreset(name.c_str()))
    {
      presets->AddPreset(name.c_str(), QJsonDocument(preset.toObject()).toJson().toStdString());
    }
  }
  // The mode is "Clamp and update on Apply": the range becomes that of the data.
  vtkSMSettings::GetInstance()->AddCollectionFromString(
    R"({ "standard_presets": {
      "NormalizedScore": "Limpid Viewpoint Score",
      "VisibilityScore": "Limpid Viewpoint Score" },
    "array_lookup_tables": {
      "NormalizedScore": { "PVLookupTable": { "AutomaticRescaleRangeMode": 2 } },
      "VisibilityScore": { "PVLookupTable": { "AutomaticRescaleRangeMode": 2 } } } })",
    LEAST_PRIORITY);
}
