// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkSMPresetProperty.h"

#include "Presets.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkSMProxy.h"

#include <string>

vtkStandardNewMacro(vtkSMPresetProperty);

vtkSMPresetProperty::vtkSMPresetProperty()
{
  this->AddObserver(vtkCommand::ModifiedEvent, this, &vtkSMPresetProperty::OnChosen);
}

vtkSMPresetProperty::~vtkSMPresetProperty() = default;

void vtkSMPresetProperty::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMPresetProperty::OnChosen()
{
  const char* value = this->GetNumberOfElements() == 1 ? this->GetElement(0) : nullptr;
  const std::string name = value ? value : "";
  if (name.empty())
  {
    return;
  }
  this->SetElement(0, "");
  const std::vector<limpid::Preset> presets = limpid::PresetsFor(this->GetParent());
  if (const limpid::Preset* preset = limpid::FindPreset(presets, name))
  {
    limpid::Apply(*preset, this->GetParent());
  }
  else
  {
    vtkErrorMacro("There is no preset \""
      << name << "\" (nothing is changed). Choose one of these: " << limpid::NamesOf(presets)
      << ".");
  }
}
