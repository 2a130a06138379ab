// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkSMOptimizedVolumeRepresentationProxy.h"

#include "DisplayColoring.h"
#include "FoundExtinction.h"
#include "ImportancePoints.h"
#include "RestoredFunction.h"

#include "vtkClientServerStream.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPVSession.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSession.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMOptimizedVolumeRepresentationProxy);

namespace
{
const char* const TYPE = "Optimized Volume"; // text in LimpidRepresentations.xml

const char* const COLOR_ARRAY = "(Color Array)"; // none_string there

// Points of a transfer function for values that are importance themselves.
const std::vector<double> WHOLE_RANGE{ 0, 0, 0.5, 0, 1, 1, 0.5, 0 };

std::vector<double> PointsOf(vtkSMProxy* function)
{
  return function ? vtkSMPropertyHelper(function, "Points").GetDoubleArray()
                  : std::vector<double>();
}
}

vtkSMOptimizedVolumeRepresentationProxy::vtkSMOptimizedVolumeRepresentationProxy() = default;

vtkSMOptimizedVolumeRepresentationProxy::~vtkSMOptimizedVolumeRepresentationProxy()
{
  if (this->Registry)
  {
    this->Registry->RemoveObserver(this->RegistryTag);
  }
}

void vtkSMOptimizedVolumeRepresentationProxy::CreateVTKObjects()
{
  this->Superclass::CreateVTKObjects();
  if (!this->WatchesOwn)
  {
    this->WatchesOwn = true;
    for (const char* name : { "ImportanceArray", "UseImportanceFunction" })
    {
      this->GetProperty(name)->AddObserver(vtkCommand::ModifiedEvent, this,
        &vtkSMOptimizedVolumeRepresentationProxy::OnImportanceChosen);
    }
  }
  if (!this->Registry)
  {
    this->Registry = this->GetSessionProxyManager();
    this->RegistryTag = this->Registry->AddObserver(
      vtkCommand::RegisterEvent, this, &vtkSMOptimizedVolumeRepresentationProxy::OnRegistered);
  }
  vtkSMProxy* display = this->GetParentProxy();
  vtkSMProperty* type = display ? display->GetProperty("Representation") : nullptr;
  // For types other than "Volume", the row of Shade is an advanced one; its group is shown only for
  // types of volumes. This makes it a basic row for all of them.
  if (vtkSMProperty* shade = display ? display->GetProperty("Shade") : nullptr)
  {
    shade->SetPanelVisibility("default");
  }
  if (type && !this->WatchesType)
  {
    this->WatchesType = true;
    type->AddObserver(
      vtkCommand::ModifiedEvent, this, &vtkSMOptimizedVolumeRepresentationProxy::OnTypeChanged);
  }
}

// Returns whether its display shows this representation.
bool vtkSMOptimizedVolumeRepresentationProxy::IsActive()
{
  vtkSMProxy* display = this->GetParentProxy();
  return display && display->GetProperty("Representation") &&
    std::string(vtkSMPropertyHelper(display, "Representation").GetAsString()) == TYPE;
}

// Returns whether changes come from a user or a script, and not from a state or another client.
bool vtkSMOptimizedVolumeRepresentationProxy::IsEdited()
{
  return !this->GetSessionProxyManager()->GetInLoadXMLState() &&
    !this->GetSession()->IsMultiClients();
}

void vtkSMOptimizedVolumeRepresentationProxy::OnTypeChanged()
{
  auto* display = vtkSMPVRepresentationProxy::SafeDownCast(this->GetParentProxy());
  if (!display || !this->IsActive() || !this->IsEdited())
  {
    return;
  }
  if (this->Suggested.empty())
  {
    limpid::ShowFoundExtinction(this, display);
    this->Starts = vtkSMPropertyHelper(this, "UseImportanceFunction").GetAsInt() == 0;
    this->Suggested = PointsOf(vtkSMPropertyHelper(this, "ImportanceFunction").GetAsProxy());
  }
  const char* importance = vtkSMPropertyHelper(this, "ImportanceArray").GetAsString(4);
  limpid::ColorByAnArray(
    display, limpid::ScalarsOfOptimizer(display), importance ? importance : "");
}

// Sets the points of the function to the suggestion, or else to their initial values, unless they
// were changed. Returns whether there is a suggestion.
bool vtkSMOptimizedVolumeRepresentationProxy::TakeSuggestion()
{
  vtkSMProxy* function = vtkSMPropertyHelper(this, "ImportanceFunction").GetAsProxy();
  if (!function)
  {
    return false;
  }
  const std::vector<double> suggested =
    limpid::ImportancePoints(vtkSMPropertyHelper(this, "SuggestedImportance").GetDoubleArray());
  const std::vector<double> points = PointsOf(function);
  const std::vector<double> wanted = suggested.empty() ? WHOLE_RANGE : suggested;
  const bool untouched = points == this->Suggested;
  if (untouched && points != wanted)
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", function);
    vtkSMPropertyHelper(function, "Points").Set(wanted.data(), unsigned(wanted.size()));
    function->UpdateVTKObjects();
  }
  this->Suggested = untouched ? wanted : this->Suggested;
  return !suggested.empty();
}

void vtkSMOptimizedVolumeRepresentationProxy::OnImportanceChosen()
{
  if (this->IsTaking || !this->ObjectsCreated || !this->IsActive() || !this->IsEdited())
  {
    return;
  }
  this->Starts = false;
  this->IsTaking = true;
  this->UpdateProperty("ImportanceArray");
  this->UpdatePropertyInformation();
  vtkSMPropertyHelper use(this, "UseImportanceFunction");
  const bool suggested = use.GetAsInt() != 0 && this->TakeSuggestion();
  if (use.GetAsInt() != 0 && !suggested && this->FunctionIsOn)
  {
    this->UseFunction(false); // the array's values are importance themselves
  }
  this->FunctionIsOn = this->FunctionIsOn && suggested;
  this->IsTaking = false;
}

void vtkSMOptimizedVolumeRepresentationProxy::UpdatePropertyInformationInternal(
  vtkSMProperty* property)
{
  // The state is pulled from one process that has the proxy, preferably the client.
  const vtkTypeUInt32 everywhere = this->Location;
  if (everywhere & vtkPVSession::RENDER_SERVER)
  {
    this->Location = vtkPVSession::RENDER_SERVER_ROOT;
  }
  this->Superclass::UpdatePropertyInformationInternal(property);
  this->Location = everywhere;
}

void vtkSMOptimizedVolumeRepresentationProxy::AddConsumer(
  vtkSMProperty* property, vtkSMProxy* proxy)
{
  this->Superclass::AddConsumer(property, proxy);
  if (vtkSMViewProxy::SafeDownCast(proxy) && this->Views.count(proxy) == 0)
  {
    this->Views[proxy] = { proxy->AddObserver(vtkCommand::StartEvent, this,
                             &vtkSMOptimizedVolumeRepresentationProxy::TellSourceName),
      proxy->AddObserver(
        vtkCommand::EndEvent, this, &vtkSMOptimizedVolumeRepresentationProxy::OnRendered) };
  }
}

void vtkSMOptimizedVolumeRepresentationProxy::RemoveConsumer(
  vtkSMProperty* property, vtkSMProxy* proxy)
{
  this->Superclass::RemoveConsumer(property, proxy);
  const auto view = this->Views.find(proxy);
  if (view != this->Views.end())
  {
    for (const unsigned long observer : view->second)
    {
      proxy->RemoveObserver(observer);
    }
    this->Views.erase(view);
  }
}

// Undo registers the objects that belong to a display after the display itself.
void vtkSMOptimizedVolumeRepresentationProxy::OnRegistered(vtkObject*, unsigned long, void*)
{
  this->RestoreFunction(limpid::MissingFunction::Waits);
}

void vtkSMOptimizedVolumeRepresentationProxy::RestoreFunction(limpid::MissingFunction missing)
{
  vtkSMProxy* display = this->GetParentProxy();
  const bool isShown = !this->Views.empty(); // false during initialisation
  if (display && isShown && this->ObjectsCreated && this->IsActive())
  {
    limpid::RestoreImportanceFunction(this, display, missing);
  }
}

// The name may change at any time without a render.
void vtkSMOptimizedVolumeRepresentationProxy::TellSourceName(vtkObject*, unsigned long, void*)
{
  if (!this->ObjectsCreated || !this->IsActive())
  {
    return;
  }
  this->RestoreFunction(limpid::MissingFunction::TakesDefault);
  vtkSMProxy* source = vtkSMPropertyHelper(this->GetParentProxy(), "Input").GetAsProxy();
  const char* registered = this->GetSessionProxyManager()->GetProxyName("sources", source);
  const std::string name = registered ? registered : "";
  if (name == this->AnnouncedName)
  {
    return;
  }
  this->AnnouncedName = name;
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(this) << "SetSourceName" << name
         << vtkClientServerStream::End;
  this->ExecuteStream(stream);
}

void vtkSMOptimizedVolumeRepresentationProxy::OnRendered(
  vtkObject*, unsigned long, void* interactive)
{
  vtkSMProxy* display = this->GetParentProxy();
  if (interactive && *static_cast<int*>(interactive) == 0 && this->IsActive() &&
    vtkSMPropertyHelper(display, "Visibility").GetAsInt() != 0)
  {
    this->UpdatePropertyInformation();
    this->Start();
  }
}

// The assumption of the first picture becomes a function that the user sees and can change.
void vtkSMOptimizedVolumeRepresentationProxy::Start()
{
  const char* structures = vtkSMPropertyHelper(this, "StructureArray").GetAsString(4);
  const bool hasStructures = structures && std::string(structures) != "(None)";
  if (!this->Starts || hasStructures) // these have their own importance
  {
    return;
  }
  const char* name = vtkSMPropertyHelper(this, "ImportanceArray").GetAsString(4);
  this->Starts = false;
  if (name && std::string(name) == COLOR_ARRAY &&
    vtkSMPropertyHelper(this, "UseImportanceFunction").GetAsInt() == 0 && this->TakeSuggestion())
  {
    this->IsTaking = true;
    this->UseFunction(true);
    this->FunctionIsOn = true;
    this->IsTaking = false;
  }
}

void vtkSMOptimizedVolumeRepresentationProxy::UseFunction(bool use)
{
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->GetParentProxy());
  vtkSMPropertyHelper(this, "UseImportanceFunction").Set(use ? 1 : 0);
  this->UpdateVTKObjects();
}

void vtkSMOptimizedVolumeRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
