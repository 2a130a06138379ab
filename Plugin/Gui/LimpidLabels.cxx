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

using Names = std::map<std::int64_t, QString>;

// Returns the names in the table of structures of a source, see vtkAddStructures.
Names NamesOfTable(vtkSMSourceProxy* source)
{
  Names names;
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
    for (vtkIdType row = 0; isKnown && row < table->GetNumberOfRows(); ++row)
    {
      names[table->GetValueByName(row, "Label").ToTypeInt64()] =
        QString::fromStdString(table->GetValueByName(row, "Name").ToString());
    }
  }
  return names;
}

// Returns the names of values in the color map of an array.
Names NamesOfColors(vtkSMSessionProxyManager* proxies, const std::string& array)
{
  Names names;
  const QString wanted = QString::fromStdString(array) + ".PVLookupTable";
  for (unsigned int i = 0; i < proxies->GetNumberOfProxies("lookup_tables"); ++i)
  {
    const char* name = proxies->GetProxyName("lookup_tables", i);
    vtkSMProxy* colors =
      name && QString(name).endsWith(wanted) ? proxies->GetProxy("lookup_tables", name) : nullptr;
    if (!colors)
    {
      continue;
    }
    const vtkSMPropertyHelper annotations(colors, "Annotations");
    for (unsigned int j = 0; j + 1 < annotations.GetNumberOfElements(); j += 2)
    {
      bool isNumber = false;
      const double value = QString(annotations.GetAsString(j)).toDouble(&isNumber);
      const QString text(annotations.GetAsString(j + 1));
      if (isNumber && value == std::floor(value) && !text.isEmpty())
      {
        names[static_cast<std::int64_t>(value)] = text;
      }
    }
  }
  return names;
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
  Names given = NamesOfTable(array.Source);
  if (given.empty())
  {
    given = NamesOfColors(proxy->GetSessionProxyManager(), array.Name);
  }
  for (vtkIdType bin = 0; counts && bin < counts->GetNumberOfRows(); ++bin)
  {
    const auto label = static_cast<std::int64_t>(first) + bin;
    if (label != 0 && counts->GetValue(bin, 1).ToDouble() > 0)
    {
      const auto found = given.find(label);
      labels.Names[label] = found != given.end() ? found->second : Say("label %1").arg(label);
    }
  }
  if (labels.Names.empty() || labels.Names.size() > MOST_LABELS)
  {
    labels.Problem = Say("\"%1\" has %2 labels other than 0. Choose an array of labels.")
                       .arg(name)
                       .arg(labels.Names.size());
    labels.Names.clear();
  }
  return labels;
}
