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
/// Notices values that a program has written into an array in place, after which it modified the
/// image alone: the array's own time does not say so, and with it ranges and fields would be stale.
class VTKLIMPIDFILTERS_EXPORT ArrayContents
{
public:
  /// Modifies those of an image's arrays whose values are others than at the last call, though
  /// their time is not. Reads values only where the image's time is another one. Nulls are left
  /// out.
  void Notice(vtkImageData* image, const std::vector<vtkDataArray*>& arrays);

private:
  struct Seen
  {
    vtkMTimeType time = 0;
    std::uint64_t checksum = 0;
  };

  vtkMTimeType ImageTime = 0;
  std::map<vtkDataArray*, Seen> Last; ///< MTimes are unique, so that no other array has these
};
}

#endif
