// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Presets.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"

#include <algorithm>

namespace limpid
{
namespace
{
std::vector<vtkPVXMLElement*> Children(vtkPVXMLElement* parent, const std::string& name)
{
  std::vector<vtkPVXMLElement*> children;
  for (unsigned int i = 0; i < parent->GetNumberOfNestedElements(); ++i)
  {
    if (parent->GetNestedElement(i)->GetName() == name)
    {
      children.push_back(parent->GetNestedElement(i));
    }
  }
  return children;
}

double Value(vtkSMProxy* proxy, const std::string& property)
{
  return vtkSMPropertyHelper(proxy, property.c_str()).GetAsDouble();
}

// Defaults of all properties of a volume that presets name.
std::map<std::string, double> Defaults(
  vtkSMProxy* volume, const std::vector<vtkPVXMLElement*>& presets)
{
  vtkSMProxy* prototype = volume->GetSessionProxyManager()->GetPrototypeProxy(
    volume->GetXMLGroup(), volume->GetXMLName());
  std::map<std::string, double> defaults;
  for (vtkPVXMLElement* preset : presets)
  {
    for (vtkPVXMLElement* entry : Children(preset, "Value"))
    {
      const std::string property = entry->GetAttributeOrEmpty("property");
      if (prototype->GetProperty(property.c_str()))
      {
        defaults[property] = Value(prototype, property);
      }
    }
  }
  return defaults;
}
}

std::vector<Preset> ReadPresets(vtkSMProxy* volume)
{
  const std::vector<vtkPVXMLElement*> elements =
    Children(volume->GetProperty("Preset")->GetHints(), "Preset");
  const std::map<std::string, double> defaults = Defaults(volume, elements);
  std::vector<Preset> presets;
  for (vtkPVXMLElement* element : elements)
  {
    Preset preset{ element->GetAttributeOrEmpty("name"), defaults };
    for (vtkPVXMLElement* entry : Children(element, "Value"))
    {
      const auto value = preset.values.find(entry->GetAttributeOrEmpty("property"));
      if (value != preset.values.end())
      {
        entry->GetScalarAttribute("value", &value->second);
      }
    }
    presets.push_back(preset);
  }
  return presets;
}

const Preset* FindPreset(const std::vector<Preset>& presets, vtkSMProxy* volume)
{
  const auto isThere = [volume](const Preset& preset)
  {
    return std::all_of(preset.values.begin(), preset.values.end(),
      [volume](const auto& entry) { return Value(volume, entry.first) == entry.second; });
  };
  const auto found = std::find_if(presets.begin(), presets.end(), isThere);
  return found == presets.end() ? nullptr : &*found;
}

const Preset* FindPreset(const std::vector<Preset>& presets, const std::string& name)
{
  const auto found = std::find_if(
    presets.begin(), presets.end(), [&name](const Preset& preset) { return preset.name == name; });
  return found == presets.end() ? nullptr : &*found;
}

std::string NamesOf(const std::vector<Preset>& presets)
{
  std::string names;
  for (const Preset& preset : presets)
  {
    names += (names.empty() ? "" : ", ") + preset.name;
  }
  return names;
}

void Apply(const Preset& preset, vtkSMProxy* volume)
{
  for (const auto& [property, value] : preset.values)
  {
    vtkSMPropertyHelper(volume, property.c_str()).Set(value);
  }
  volume->UpdateVTKObjects();
}
}
