// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkSMRegularizationProperty
 * @brief   the regularisation weight, beside the clearing threshold that can take its place
 *
 * To change it, as scripts of earlier versions do, sets the property ClearingThreshold of the same
 * proxy to 0, so that the weight counts; vtkVisibilitySettings does the same.
 *
 * State files of versions that had no ClearingThreshold and no Emphasis keep their pictures: these
 * get the values that were the only ones then, 0 and 1.
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

  bool IsRestored = false; // with all others, by a state or by undo
};

#endif
