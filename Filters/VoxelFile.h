// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The bytes of a file, which may be compressed.

#ifndef limpid_VoxelFile_h
#define limpid_VoxelFile_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace limpid
{
/// Where the values of an image are.
struct VoxelFile
{
  static constexpr std::int64_t atEnd = -1;

  std::string path;
  std::int64_t offset = 0;   ///< where the data begin in the file; atEnd: they are its last bytes
  bool isCompressed = false; ///< from there on, as gzip or zlib do
  std::int64_t skip = 0;     ///< bytes before the values, once decompressed
  bool isBigEndian = false;
};

/// Returns the number at the beginning of some bytes, which have the order of a file.
template <class Value>
Value NumberAt(const char* stored, bool isBigEndian)
{
  const std::uint16_t one = 1;
  const bool hostIsBigEndian = *reinterpret_cast<const unsigned char*>(&one) == 0;
  std::array<char, sizeof(Value)> bytes;
  std::copy_n(stored, sizeof(Value), bytes.data());
  if (isBigEndian != hostIsBigEndian)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  Value value;
  std::memcpy(&value, bytes.data(), sizeof(Value));
  return value;
}

/// Returns whether a file begins like one of gzip. Throws Error if it cannot be opened.
bool IsGzip(const std::string& path);

/// Reads the first bytes of the values, `count` of them or as many as there are, and returns how
/// many these are. Throws Error if the file cannot be opened or decompressed.
std::int64_t ReadBytes(const VoxelFile& file, char* bytes, std::int64_t count);

/// Throws Error if a file is too small to have so many bytes of values.
void RequireBytes(const VoxelFile& file, std::int64_t count);
}

#endif
