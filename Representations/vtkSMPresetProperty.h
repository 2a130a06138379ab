// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkSMPresetProperty
 * @brief   sets properties of its proxy to the values of a preset
 *
 * To set it to the number of a preset of vtkVisibilitySettings, from 1 on, is to set the properties
 * that the preset has a value for. It is 0 again afterwards, so it is in no state. Its domain has
 * the names: in Python, another one raises and changes nothing.
 */

#ifndef vtkSMPresetProperty_h
#define vtkSMPresetProperty_h

#include "vtkLimpidRepresentationsModule.h" // for export macro
#include "vtkSMIntVectorProperty.h"

class VTKLIMPIDREPRESENTATIONS_EXPORT vtkSMPresetProperty : public vtkSMIntVectorProperty
{
public:
  static vtkSMPresetProperty* New();
  vtkTypeMacro(vtkSMPresetProperty, vtkSMIntVectorProperty);
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
