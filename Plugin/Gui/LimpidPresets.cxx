// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidPresets.h"

#include "pqApplicationCore.h"
#include "pqRepresentation.h"
#include "pqServerManagerModel.h"
#include "pqView.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSettings.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionPresets.h"
#include "vtkSMTransferFunctionProxy.h"

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <string>

namespace
{
// Priority of these settings, below those of users and administrators.
const double LEAST_PRIORITY = 0;

// Returns the color map of a representation that is colored by visibility scores, if the range of
// the map is that of the data; null otherwise.
vtkSMProxy* MapOfScores(vtkSMProxy* display)
{
  if (!display->GetProperty("ColorArrayName") || !display->GetProperty("LookupTable"))
  {
    return nullptr;
  }
  const char* array = vtkSMPropertyHelper(display, "ColorArrayName").GetInputArrayNameToProcess();
  const std::string name = array ? array : "";
  vtkSMProxy* map = vtkSMPropertyHelper(display, "LookupTable").GetAsProxy();
  const bool isOfScores = map && (name == "NormalizedScore" || name == "VisibilityScore");
  return isOfScores &&
      vtkSMPropertyHelper(map, "AutomaticRescaleRangeMode").GetAsInt() ==
        vtkSMTransferFunctionManager::RESET_ON_APPLY
    ? map
    : nullptr;
}
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
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::viewAdded, this, &LimpidPresets::addView);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->addView(view);
  }
}

void LimpidPresets::addView(pqView* view)
{
  this->connect(view, &pqView::representationAdded, this, &LimpidPresets::keepRange);
}

// In this mode, ParaView gives a color map the range of what is shown last, and that of everything
// shown only with Apply.
void LimpidPresets::keepRange(pqRepresentation* representation)
{
  vtkSMProxy* map = MapOfScores(representation->getProxy());
  double range[2];
  if (map && vtkSMTransferFunctionProxy::ComputeDataRange(map, range))
  {
    vtkSMTransferFunctionProxy::RescaleTransferFunction(map, range, /*extend=*/true);
  }
}
