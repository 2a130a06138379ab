// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Headers of image files that are lines of text.

#ifndef limpid_TextHeader_h
#define limpid_TextHeader_h

#include "VoxelFile.h"

#include "math/Vec.h"

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace limpid
{
constexpr const char* blanks = " \t\r"; ///< that separate words on a line

/// Returns a text without the blanks around it.
std::string Trimmed(const std::string& text);

/// The fields of a header. A field may have several names, of which the first that is there counts.
class TextHeader
{
public:
  using Names = std::initializer_list<const char*>;

  /// Reads lines "name DELIMITER value" up to the field `last`, or up to an empty one if that is
  /// "".
  TextHeader(const std::string& path, char delimiter, const std::string& last);

  /// Returns whether there is a field. Names are in lower case.
  bool Has(const std::string& name) const { return this->Fields.count(name) != 0; }

  /// Returns the number of fields.
  std::size_t Count() const { return this->Fields.size(); }

  /// Returns a field; empty: there is none.
  std::string Text(Names names) const;

  /// Returns a field in lower case.
  std::string Lower(Names names) const;

  ///@{
  /// Returns the numbers of a field; if there are none, `otherwise`, which says how many there must
  /// be. Throws Error for anything else.
  std::vector<double> Numbers(Names names) const;
  std::vector<double> Numbers(Names names, const std::vector<double>& otherwise) const;
  ///@}

  /// Returns the whole number of a field; if there is none, `otherwise`. Throws Error unless it is
  /// `least` or more.
  std::int64_t WholeNumber(Names names, std::int64_t otherwise, double least) const;

  /// Returns the vectors of a field such as (1,0,0) none (0,1,0); null for "none". Throws Error for
  /// anything else.
  std::vector<std::optional<Vec3>> Vectors(const char* name) const;

  /// Returns the number of bytes up to the values.
  std::int64_t Length() const { return this->Bytes; }

private:
  std::map<std::string, std::string> Fields;
  std::int64_t Bytes = 0;
};

/// Returns the number of points along three axes, from axis `first` on. Throws Error if it is none.
Int3 NodesOf(const std::vector<double>& sizes, std::size_t first);

/// Returns VTK's type for a name in a table. Throws Error if it is not there.
int TypeOf(const std::map<std::string, int>& types, const std::string& name);

/// Sets where the values are: behind the header, or in a file that it names.
void SetVoxels(const std::string& path, const std::string& dataFile, std::int64_t headerLength,
  VoxelFile& voxels);
}

#endif
