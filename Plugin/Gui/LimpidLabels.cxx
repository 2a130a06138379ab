// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidLabels.h"

#include "LimpidDataArray.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkTable.h"
#include "vtkType.h"
#include "vtkVariant.h"

#include <QCoreApplication>

#include <cmath>
#include <cstring>

namespace
{
// Arrays with more values than this are hardly labels.
const int MOST_LABELS = 4096;
const double WIDEST = 65536; // range of labels

using Looks = limpid::StructureLooks;

// Returns what the table of structures of a source says, see vtkAddStructures.
Looks LooksOfTable(vtkSMSourceProxy* source)
{
  Looks looks;
  for (unsigned int port = 0; port < source->GetNumberOfOutputPorts(); ++port)
  {
    const char* name = source->GetOutputPortName(port);
    if (!name || std::strcmp(name, "Structures") != 0)
    {
      continue;
    }
    const auto data = BringToClient(source, port, VTK_TABLE, std::nullopt);
    auto* table = vtkTable::SafeDownCast(data);
    const bool isKnown = table && table->GetColumnByName("Label") && table->GetColumnByName("Name");
    const bool hasColors = isKnown && table->GetColumnByName("Red") &&
      table->GetColumnByName("Green") && table->GetColumnByName("Blue");
    for (vtkIdType row = 0; isKnown && row < table->GetNumberOfRows(); ++row)
    {
      const auto number = [&](const char* column)
      { return table->GetValueByName(row, column).ToDouble(); };
      limpid::StructureLook& look = looks[table->GetValueByName(row, "Label").ToTypeInt64()];
      look.name = table->GetValueByName(row, "Name").ToString();
      look.color = hasColors
        ? limpid::ColorOf({ number("Red"), number("Green"), number("Blue") }, 1)
        : std::nullopt;
    }
  }
  return looks;
}

// Returns the names of values in the color map of an array, and the colours of categories.
Looks LooksOfColors(vtkSMSessionProxyManager* proxies, const std::string& array)
{
  Looks looks;
  const QString wanted = QString::fromStdString(array) + ".PVLookupTable";
  for (unsigned int i = 0; i < proxies->GetNumberOfProxies("lookup_tables"); ++i)
  {
    const char* name = proxies->GetProxyName("lookup_tables", i);
    vtkSMProxy* map =
      name && QString(name).endsWith(wanted) ? proxies->GetProxy("lookup_tables", name) : nullptr;
    if (!map)
    {
      continue;
    }
    const vtkSMPropertyHelper annotations(map, "Annotations");
    const vtkSMPropertyHelper colors(map, "IndexedColors");
    const bool isCategorical = vtkSMPropertyHelper(map, "IndexedLookup").GetAsInt() != 0;
    for (unsigned int j = 0; j + 1 < annotations.GetNumberOfElements(); j += 2)
    {
      bool isNumber = false;
      const double value = QString(annotations.GetAsString(j)).toDouble(&isNumber);
      const std::string text = annotations.GetAsString(j + 1);
      if (isNumber && value == std::floor(value) && !text.empty())
      {
        limpid::StructureLook& look = looks[static_cast<std::int64_t>(value)];
        look.name = text;
        const unsigned int first = 3 * (j / 2);
        if (isCategorical && first + 2 < colors.GetNumberOfElements())
        {
          look.color = limpid::ColorOf({ colors.GetAsDouble(first), colors.GetAsDouble(first + 1),
                                         colors.GetAsDouble(first + 2) },
            1);
        }
      }
    }
  }
  return looks;
}

QString Say(const char* text)
{
  return QCoreApplication::translate("LimpidStructures", text);
}
}

LimpidLabels LabelsOf(vtkSMProxy* proxy)
{
  LimpidLabels labels;
  const LimpidDataArray array = StructureArrayOf(proxy);
  const std::array<double, 2> range = array.Range();
  if (!array || range[0] > range[1])
  {
    labels.Problem = Say("There are no data yet. Apply the source, and choose a structure array.");
    return labels;
  }
  const QString name = QString::fromStdString(array.Name);
  if (range[1] - range[0] >= WIDEST)
  {
    labels.Problem =
      Say("The values of \"%1\" go from %2 to %3. Choose an array of labels, which are small whole "
          "numbers, or type them.")
        .arg(name)
        .arg(range[0])
        .arg(range[1]);
    return labels;
  }
  // A bin for each whole number.
  const double first = std::floor(range[0]);
  const int bins = static_cast<int>(std::floor(range[1]) - first) + 1;
  const auto counts = array.Histogram({ first - 0.5, first + bins - 0.5 }, bins);
  Looks given = LooksOfTable(array.Source);
  if (given.empty())
  {
    given = LooksOfColors(proxy->GetSessionProxyManager(), array.Name);
  }
  for (vtkIdType bin = 0; counts && bin < counts->GetNumberOfRows(); ++bin)
  {
    const auto label = static_cast<std::int64_t>(first) + bin;
    if (label != 0 && counts->GetValue(bin, 1).ToDouble() > 0)
    {
      limpid::StructureLook& look = given[label];
      look.name = look.name.empty() ? Say("label %1").arg(label).toStdString() : look.name;
      labels.Looks[label] = look;
    }
  }
  if (labels.Looks.empty() || labels.Looks.size() > MOST_LABELS)
  {
    labels.Problem = Say("\"%1\" has %2 labels other than 0. Choose an array of labels.")
                       .arg(name)
                       .arg(labels.Looks.size());
    labels.Looks.clear();
  }
  return labels;
}
