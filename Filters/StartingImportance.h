// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The source of importance, and the assumption if nobody has specified what is important.

#ifndef limpid_StartingImportance_h
#define limpid_StartingImportance_h

#include "SceneConversion.h"

#include "vtkLimpidFiltersModule.h" // for export macro

#include "scene/StartingImportance.h"

#include <string>

class vtkVisibilitySettings;

namespace limpid
{
class SharedArray;

/// Returns the ramp of values of an array that are assumed to be important; unknown if its values
/// are all alike.
VTKLIMPIDFILTERS_EXPORT ImportanceRamp StartingImportance(const SharedArray& array);

/// MappingOf returns the mapping of a ramp for scalars that stand in for importance, and throws
/// Error if the ramp is unknown. Others return the warning for the user.
VTKLIMPIDFILTERS_EXPORT ScalarMapping MappingOf(const ImportanceRamp& ramp);
VTKLIMPIDFILTERS_EXPORT std::string WarningOf(const ImportanceRamp& ramp);

/**
 * The source of importance, for mappers and filters alike: labels of structures, an array, or, if
 * neither was chosen, the scalars. ImportanceFunction maps the values if UseImportanceFunction is
 * on. If it is off, the values of an array are the importance, and for scalars the largest values
 * are assumed to be important.
 */
struct VTKLIMPIDFILTERS_EXPORT ImportanceChoice
{
  FieldSource array;     ///< null: there is no array of that name
  std::string name;      ///< name of the requested array
  bool isChosen = false; ///< whether a user chose it; if not, the scalars may stand in
  FieldSource scalars;   ///< null: there are no scalars
  FieldSource labels;    ///< of structures, which replace the array; null: not chosen

  bool IsOfScalars() const
  {
    return !this->labels.array && !this->array.array && !this->isChosen && this->scalars.array;
  }

  /// Returns whether MappingOf(StartingImportance) is needed.
  bool IsAssumed(vtkVisibilitySettings* settings) const;

  /// Returns the array of importance, and its mapping. Throws Error if there is no source of
  /// importance. `image`: the message names its arrays.
  FieldSource Source(
    vtkVisibilitySettings* settings, const ScalarMapping& assumed, vtkImageData* image) const;
};
}

#endif
