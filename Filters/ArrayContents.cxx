// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ArrayContents.h"

#include "AllCores.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <algorithm>
#include <cstring>

namespace limpid
{
namespace
{
constexpr std::uint64_t Prime = 0x9E3779B97F4A7C15ULL; // odd, with bits everywhere

std::uint64_t Mixed(std::uint64_t sum, std::uint64_t word)
{
  const std::uint64_t mixed = (sum ^ word) * Prime;
  return mixed ^ (mixed >> 29);
}

std::uint64_t ChecksumOf(const char* bytes, std::size_t count)
{
  std::uint64_t sum = count;
  std::uint64_t word = 0;
  for (; count >= sizeof(word); count -= sizeof(word), bytes += sizeof(word))
  {
    std::memcpy(&word, bytes, sizeof(word));
    sum = Mixed(sum, word);
  }
  word = 0;
  std::memcpy(&word, bytes, count);
  return Mixed(sum, word);
}

// A checksum of the values of an array. Returns 0 if they are not stored in contiguous memory:
// arrays that compute their values have no others until they are modified.
std::uint64_t ChecksumOf(vtkDataArray* array)
{
  const auto size = static_cast<std::size_t>(array->GetDataTypeSize());
  const auto count = static_cast<std::size_t>(array->GetNumberOfValues()) * size;
  if (!array->HasStandardMemoryLayout() || count == 0)
  {
    return 0;
  }
  constexpr std::size_t part = 1 << 18;
  const auto* bytes = static_cast<const char*>(array->GetVoidPointer(0));
  std::vector<std::uint64_t> sums((count + part - 1) / part);
  ForOnAllCores(static_cast<vtkIdType>(sums.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      {
        sums[i] = ChecksumOf(bytes + i * part, std::min(part, count - i * part));
      }
    });
  std::uint64_t sum = 0;
  for (const std::uint64_t next : sums)
  {
    sum = Mixed(sum, next);
  }
  return sum;
}
}

void ArrayContents::Notice(vtkImageData* image, const std::vector<vtkDataArray*>& arrays)
{
  const bool isSame = image->GetMTime() == this->ImageTime;
  std::map<vtkDataArray*, Seen> now;
  for (vtkDataArray* array : arrays)
  {
    if (!array)
    {
      continue;
    }
    const auto last = this->Last.find(array);
    const bool isKnown = last != this->Last.end() && last->second.time == array->GetMTime();
    if (isKnown && isSame)
    {
      now[array] = last->second;
      continue;
    }
    const std::uint64_t checksum = ChecksumOf(array);
    if (isKnown && checksum != last->second.checksum)
    {
      array->Modified();
    }
    now[array] = { array->GetMTime(), checksum };
  }
  this->Last = std::move(now);
  this->ImageTime = image->GetMTime(); // includes the modifications made here
}
}
