// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Memory.h"

#include "vtkImageData.h"

#include <iomanip>
#include <new>
#include <sstream>

namespace limpid
{
std::string MessageOf(const std::exception& error, const int points[3], const MemoryNeed& need)
{
  if (!dynamic_cast<const std::bad_alloc*>(&error))
  {
    return error.what();
  }
  const double count = double(points[0]) * points[1] * points[2];
  std::ostringstream text;
  text << "There is not enough memory for " << points[0] << " x " << points[1] << " x " << points[2]
       << " points (about " << std::setprecision(3) << need.bytesPerPoint * count / (1 << 30)
       << " GiB are needed). " << need.advice;
  return text.str();
}

std::string MessageOf(const std::exception& error, vtkImageData* image, const MemoryNeed& need)
{
  return image ? MessageOf(error, image->GetDimensions(), need) : error.what();
}
}
