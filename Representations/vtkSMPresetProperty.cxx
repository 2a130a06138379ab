// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkSMPresetProperty.h"

#include "Presets.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkSMProxy.h"

#include <cstddef>
#include <vector>

namespace
{
constexpr int NONE = 0; // also the value of an uninitialised property
}

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
  const int chosen = this->GetNumberOfElements() == 1 ? this->GetElement(0) : NONE;
  if (chosen == NONE)
  {
    return;
  }
  this->SetElement(0, NONE);
  const std::vector<limpid::Preset> presets = limpid::PresetsFor(this->GetParent());
  if (chosen > 0 && chosen <= static_cast<int>(presets.size()))
  {
    limpid::Apply(presets[static_cast<std::size_t>(chosen - 1)], this->GetParent());
  }
  else
  {
    vtkErrorMacro("There is no preset number "
      << chosen << " (no setting was changed). Choose one of these by its name: "
      << limpid::NamesOf(presets) << ".");
  }
}
