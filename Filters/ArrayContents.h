// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_ArrayContents_h
#define limpid_ArrayContents_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkType.h"

#include <cstdint>
#include <map>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace limpid
{
/// Detects that a program has changed the values of an array in place and has modified only the
/// image. The modification time of the array is unchanged then, so that ranges and fields would be
/// stale.
class VTKLIMPIDFILTERS_EXPORT ArrayContents
{
public:
  /// Calls Modified() on the arrays whose values have changed since the last call although their
  /// modification time has not. Reads values only if the modification time of the image has
  /// changed. Null arrays are skipped.
  void Notice(vtkImageData* image, const std::vector<vtkDataArray*>& arrays);

private:
  struct Seen
  {
    vtkMTimeType time = 0;
    std::uint64_t checksum = 0;
  };

  vtkMTimeType ImageTime = 0;
  std::map<vtkDataArray*, Seen> Last; ///< by array; MTimes are unique, so that another array at the
                                      ///< same address is recognised
};
}

#endif
