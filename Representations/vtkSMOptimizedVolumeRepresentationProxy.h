// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkSMOptimizedVolumeRepresentationProxy
 * @brief   what a client does for vtkOptimizedVolumeRepresentation
 *
 * Information properties (VisibleFraction, Converged, ...) are fetched from the process that draws,
 * and after every still render of a view that shows the representation: they are those of the
 * picture that one sees. By itself ParaView asks the client, which has no volume when a server
 * draws.
 *
 * When a display without scalar coloring changes to the type "Optimized Volume", an array to color
 * by is chosen, as ParaView does for the type "Volume". When one changes to it for the first time
 * that shows the image of the filter Extinction Optimizer, it shows the extinction that was found
 * there (FoundExtinction.h).
 *
 * Where nothing says what is important, the importance function is switched on after the first
 * picture, with what was assumed for that; and as long as nobody has changed its points, they
 * follow the importance array (SuggestedImportance).
 *
 * Where Undo brings back a display that was deleted, ParaView leaves the importance function out:
 * the volume takes it again (RestoredFunction.h).
 *
 * Before every render the process that draws is told what the source is called in the pipeline
 * browser (SetSourceName).
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
  bool WatchesOwn = false;            // properties
  vtkWeakPointer<vtkObject> Registry; // that tells what is registered
  unsigned long RegistryTag = 0;      // of the observer there
  bool Starts = false;       // with what is assumed to be important, after the first picture
  bool FunctionIsOn = false; // because of what was suggested
  bool IsTaking = false;
  std::vector<double> Suggested; // points of the function that nobody has chosen
  std::string ToldName;          // of the source, to the process that draws
  // Views that show it, and the tags of the observers there.
  std::map<vtkSMProxy*, std::array<unsigned long, 2>> Views;
};

#endif
