// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkSMRegularizationProperty.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <string>

vtkStandardNewMacro(vtkSMRegularizationProperty);

namespace
{
const char* const THRESHOLD = "ClearingThreshold";
const char* const EMPHASIS = "Emphasis";

// Returns whether the state of a proxy, an element with properties, has a property of that name.
bool HasProperty(vtkPVXMLElement* state, const std::string& name)
{
  for (unsigned int i = 0; i < state->GetNumberOfNestedElements(); ++i)
  {
    if (state->GetNestedElement(i)->GetAttributeOrEmpty("name") == name)
    {
      return true;
    }
  }
  return false;
}
}

vtkSMRegularizationProperty::vtkSMRegularizationProperty()
{
  this->AddObserver(vtkCommand::ModifiedEvent, this, &vtkSMRegularizationProperty::OnModified);
}

vtkSMRegularizationProperty::~vtkSMRegularizationProperty() = default;

void vtkSMRegularizationProperty::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMRegularizationProperty::OnModified()
{
  vtkSMProxy* proxy = this->GetParent();
  // While the proxy is created, properties get their defaults one after the other.
  if (!this->IsRestored && proxy && proxy->GetObjectsCreated() && proxy->GetProperty(THRESHOLD))
  {
    vtkSMPropertyHelper(proxy, THRESHOLD).Set(0.0);
  }
}

void vtkSMRegularizationProperty::ReadFrom(
  const vtkSMMessage* message, int offset, vtkSMProxyLocator* locator)
{
  this->IsRestored = true;
  this->Superclass::ReadFrom(message, offset, locator);
  this->IsRestored = false;
}

int vtkSMRegularizationProperty::LoadState(vtkPVXMLElement* element, vtkSMProxyLocator* loader)
{
  this->IsRestored = true;
  const int result = this->Superclass::LoadState(element, loader);
  this->IsRestored = false;
  // Pushed after the weight, even if its value equals that of the state.
  this->GetParent()->GetProperty(THRESHOLD)->Modified();
  vtkPVXMLElement* state = element->GetParent();
  if (state && !HasProperty(state, THRESHOLD) && !HasProperty(state, EMPHASIS))
  {
    vtkSMPropertyHelper(this->GetParent(), THRESHOLD).Set(0.0);
    vtkSMPropertyHelper(this->GetParent(), EMPHASIS).Set(1.0);
  }
  return result;
}
