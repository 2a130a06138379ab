// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkSMPresetProperty
 * @brief   sets properties of its proxy to the values of a preset
 *
 * Setting it to the number of a preset of vtkVisibilitySettings, counted from 1, sets the
 * properties for which the preset has a value. It then returns to 0, so it is not saved in states.
 * Its domain has the names of the presets: in Python, any other name raises an exception and
 * changes nothing.
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
