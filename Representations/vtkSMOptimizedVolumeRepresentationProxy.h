// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkSMOptimizedVolumeRepresentationProxy
 * @brief   client side of vtkOptimizedVolumeRepresentation
 *
 * Information properties (VisibleFraction, Converged, ...) are fetched from the process that draws,
 * and after every still render of a view that shows the representation, so that they match the
 * visible picture. By default, ParaView asks the client, which has no volume if a server draws.
 *
 * If a display without scalar coloring changes to the type "Optimized Volume", an array to color by
 * is chosen, as ParaView does for the type "Volume". If a display of the image of the filter
 * Extinction Optimizer changes to it for the first time, it shows the optimised extinction
 * (FoundExtinction.h).
 *
 * If importance is not specified, the importance function is switched on after the first picture,
 * with the ramp that was assumed for it. As long as nobody has changed its points, they follow the
 * importance array (SuggestedImportance).
 *
 * When Undo restores a deleted display, ParaView omits the importance function; this class sets it
 * again (RestoredFunction.h).
 *
 * Before every render, the process that draws gets the name of the source in the pipeline browser
 * (SetSourceName).
 */

#ifndef vtkSMOptimizedVolumeRepresentationProxy_h
#define vtkSMOptimizedVolumeRepresentationProxy_h

#include "vtkLimpidRepresentationsModule.h" // for export macro
#include "vtkSMRepresentationProxy.h"
#include "vtkWeakPointer.h" // for a member

#include <array>  // for observers
#include <map>    // for the views
#include <string> // for a name
#include <vector> // for points

namespace limpid
{
enum class MissingFunction;
}

class VTKLIMPIDREPRESENTATIONS_EXPORT vtkSMOptimizedVolumeRepresentationProxy
  : public vtkSMRepresentationProxy
{
public:
  static vtkSMOptimizedVolumeRepresentationProxy* New();
  vtkTypeMacro(vtkSMOptimizedVolumeRepresentationProxy, vtkSMRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMOptimizedVolumeRepresentationProxy();
  ~vtkSMOptimizedVolumeRepresentationProxy() override;

  void CreateVTKObjects() override;
  void UpdatePropertyInformationInternal(vtkSMProperty* property = nullptr) override;
  void AddConsumer(vtkSMProperty* property, vtkSMProxy* proxy) override;
  void RemoveConsumer(vtkSMProperty* property, vtkSMProxy* proxy) override;

private:
  vtkSMOptimizedVolumeRepresentationProxy(const vtkSMOptimizedVolumeRepresentationProxy&) = delete;
  void operator=(const vtkSMOptimizedVolumeRepresentationProxy&) = delete;

  bool IsActive();
  bool IsEdited();
  void OnTypeChanged();
  void OnImportanceChosen();
  bool TakeSuggestion();
  void Start();
  void UseFunction(bool use);
  void OnRegistered(vtkObject* manager, unsigned long event, void* information);
  void RestoreFunction(limpid::MissingFunction missing);
  void TellSourceName(vtkObject* view, unsigned long event, void* interactive);
  void OnRendered(vtkObject* view, unsigned long event, void* interactive);

  bool WatchesType = false;
  bool WatchesOwn = false;            // whether it observes its own properties
  vtkWeakPointer<vtkObject> Registry; // that reports registrations of proxies
  unsigned long RegistryTag = 0;      // tag of the observer of Registry
  bool Starts = false;                // whether to switch the function on after the first picture
  bool FunctionIsOn = false;          // whether the suggestion switched the function on
  bool IsTaking = false;
  std::vector<double> Suggested; // points of the function as suggested
  std::string AnnouncedName;     // name of the source that the drawing process has
  // Views that show it, with the tags of their observers.
  std::map<vtkSMProxy*, std::array<unsigned long, 2>> Views;
};

#endif
