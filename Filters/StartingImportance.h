// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Where importance comes from, and what is taken for it where nobody has said what is important.

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

/// What may be important of an array that nobody has said anything about; not known where its
/// values are all alike.
VTKLIMPIDFILTERS_EXPORT ImportanceRamp StartingImportance(const SharedArray& array);

/// Importance as the ramp has it, for scalars that stand in for it, and what to tell the user.
/// MappingOf throws Error where the ramp is not known.
VTKLIMPIDFILTERS_EXPORT ScalarMapping MappingOf(const ImportanceRamp& ramp);
VTKLIMPIDFILTERS_EXPORT std::string WarningOf(const ImportanceRamp& ramp);

/**
 * What says what is important, in mappers and filters alike: an array, or else, if nobody has
 * chosen one, the scalars. Values are mapped by ImportanceFunction where UseImportanceFunction is
 * on. Where it is off, those of an array are importance, and scalars that stand in get what is
 * assumed of them: their largest values are important.
 */
struct VTKLIMPIDFILTERS_EXPORT ImportanceChoice
{
  FieldSource array;     ///< of that name; null: there is none
  std::string name;      ///< of the array that is wanted
  bool isChosen = false; ///< by a user; else the scalars may stand in
  FieldSource scalars;   ///< null: there are none

  bool IsOfScalars() const { return !this->array.array && !this->isChosen && this->scalars.array; }

  /// Whether MappingOf(StartingImportance) is needed.
  bool IsAssumed(vtkVisibilitySettings* settings) const;

  /// The values and how they become importance. Throws Error where nothing says what is important;
  /// `image`: whose arrays the message names.
  FieldSource Source(
    vtkVisibilitySettings* settings, const ScalarMapping& assumed, vtkImageData* image) const;
};
}

#endif
