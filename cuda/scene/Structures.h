// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_Structures_h
#define limpid_scene_Structures_h

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace limpid
{
/// A labelled part of a volume, such as an organ in a segmentation.
struct Structure
{
  std::int64_t label = 0;
  std::string name;             ///< empty: the label stands for it
  double importance = 1;        ///< of all its points [0, 1]
  std::optional<double> target; ///< share that should be visible [0, 1]; none: any

  std::string NameOrLabel() const { return name.empty() ? std::to_string(label) : name; }
};

/// Reads a structure from four texts: label, name, importance, and target, which may be empty.
/// Throws Error if one is not a number.
Structure ParseStructure(const std::string& label, const std::string& name,
  const std::string& importance, const std::string& target);

/// Row of a structure, from 1 on; 0: a label that is not among the structures.
using StructureRow = std::uint16_t;

/// The structures of a scene. Other labels have no importance.
class Structures
{
public:
  /// Throws Error if two have the same label or name, or if a number is outside its range.
  explicit Structures(std::vector<Structure> all);

  /// Returns one structure that has all labels but 0, and is important.
  static Structures AnyLabel();

  bool HasAnyLabel() const { return this->IsAny; }
  bool HasTargets() const;
  std::size_t Count() const { return this->All.size(); }
  const Structure& At(StructureRow row) const { return this->All[row - std::size_t(1)]; }
  StructureRow RowOf(std::int64_t label) const;
  double ImportanceOf(StructureRow row) const { return row > 0 ? this->At(row).importance : 0.0; }

private:
  std::vector<Structure> All;
  std::unordered_map<std::int64_t, StructureRow> Rows; ///< by label
  bool IsAny = false;                                  ///< see AnyLabel
};
}

#endif
