// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "UpstreamErrors.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"

#include <algorithm>

namespace limpid
{
namespace
{
// Returns the text without "ERROR: In FILE, line NUMBER\nCLASS (ADDRESS): " and trailing line ends.
std::string MessageOf(const std::string& text)
{
  const std::size_t lead = text.find("): ");
  const std::size_t begin = lead == std::string::npos ? 0 : lead + 3;
  const std::size_t end = text.find_last_not_of(" \n");
  return end == std::string::npos || end < begin ? text : text.substr(begin, end + 1 - begin);
}

void Keep(vtkObject* caller, unsigned long, void* text, void* message)
{
  auto& kept = *static_cast<std::string*>(text);
  // The error of an executive says only that its algorithm failed.
  if (kept.empty() && message && vtkAlgorithm::SafeDownCast(caller))
  {
    kept = MessageOf(static_cast<const char*>(message));
  }
}
}

UpstreamErrors::UpstreamErrors(vtkAlgorithm* filter)
  : Command(vtkSmartPointer<vtkCallbackCommand>::New())
{
  this->Command->SetCallback(Keep);
  this->Command->SetClientData(&this->Text);
  this->ObserveInputsOf(filter);
}

UpstreamErrors::~UpstreamErrors()
{
  for (const auto& [object, tag] : this->Observed)
  {
    object->RemoveObserver(tag);
  }
}

bool UpstreamErrors::IsObserved(vtkObject* object) const
{
  return std::any_of(this->Observed.begin(), this->Observed.end(),
    [object](const auto& each) { return each.first == object; });
}

void UpstreamErrors::Observe(vtkObject* object)
{
  this->Observed.emplace_back(object, object->AddObserver(vtkCommand::ErrorEvent, this->Command));
}

void UpstreamErrors::ObserveInputsOf(vtkAlgorithm* filter)
{
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      vtkAlgorithm* input = filter->GetInputAlgorithm(port, i);
      if (!this->IsObserved(input))
      {
        this->Observe(input);
        this->Observe(input->GetExecutive());
        this->ObserveInputsOf(input);
      }
    }
  }
}
}
