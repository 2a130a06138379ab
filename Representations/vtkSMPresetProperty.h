// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkSMPresetProperty
 * @brief   sets properties of its proxy to the values of a preset
 *
 * To set it to the name of a preset of vtkVisibilitySettings is to set the properties that the
 * preset has a value for. It has no value of its own, so it is in no state; another name is an
 * error and changes nothing.
 */

#ifndef vtkSMPresetProperty_h
#define vtkSMPresetProperty_h

#include "vtkLimpidRepresentationsModule.h" // for export macro
#include "vtkSMStringVectorProperty.h"

class VTKLIMPIDREPRESENTATIONS_EXPORT vtkSMPresetProperty : public vtkSMStringVectorProperty
{
public:
  static vtkSMPresetProperty* New();
  vtkTypeMacro(vtkSMPresetProperty, vtkSMStringVectorProperty);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSMPresetProperty();
  ~vtkSMPresetProperty() override;

private:
  vtkSMPresetProperty(const vtkSMPresetProperty&) = delete;
  void operator=(const vtkSMPresetProperty&) = delete;

  void OnChosen();
};

#endif
