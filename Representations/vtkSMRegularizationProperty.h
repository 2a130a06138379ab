// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkSMRegularizationProperty
 * @brief   the regularisation weight, which ClearingThreshold may replace
 *
 * Changing it, as scripts for earlier versions do, sets the property ClearingThreshold of the same
 * proxy to 0, so that the weight is used; vtkVisibilitySettings does the same.
 *
 * State files of versions without ClearingThreshold and Emphasis keep their pictures: these
 * properties get the values 0 and 1, which match those versions.
 */

#ifndef vtkSMRegularizationProperty_h
#define vtkSMRegularizationProperty_h

#include "vtkLimpidRepresentationsModule.h" // for export macro
#include "vtkSMDoubleVectorProperty.h"

class VTKLIMPIDREPRESENTATIONS_EXPORT vtkSMRegularizationProperty : public vtkSMDoubleVectorProperty
{
public:
  static vtkSMRegularizationProperty* New();
  vtkTypeMacro(vtkSMRegularizationProperty, vtkSMDoubleVectorProperty);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMRegularizationProperty();
  ~vtkSMRegularizationProperty() override;

  void ReadFrom(const vtkSMMessage*, int offset, vtkSMProxyLocator*) override;
  int LoadState(vtkPVXMLElement* element, vtkSMProxyLocator* loader) override;

private:
  vtkSMRegularizationProperty(const vtkSMRegularizationProperty&) = delete;
  void operator=(const vtkSMRegularizationProperty&) = delete;

  void OnModified();

  bool IsRestored = false; // together with all properties, by a state or by undo
};

#endif
