// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The fields of the optimisation of a volume on a grid that is coarser than the data.

#ifndef limpid_ControlFields_h
#define limpid_ControlFields_h

#include "optimize/CoarseFields.h"
#include "optimize/ControlGrid.h"
#include "render/DrawnPart.h"
#include "scene/Structures.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace limpid
{
/// For a process that has all of the volume.
class ControlFields
{
public:
  /// Returns the grid that settings ask for. It is chosen again only if what it depends on has
  /// changed, since the memory that is left changes all the time. `part`: of the data; `ofFields`:
  /// bytes of a point in fields that pictures need.
  const ControlGrid& Choose(const Settings& settings, const DrawnPart& part, double ofFields);
  const ControlGrid& Chosen() const { return this->Control; }

  /// Returns whether the fields of a version of the scene on the chosen grid are here.
  bool Are(std::uint64_t version, ImportanceSmoothing smoothing) const;

  /// Makes the fields from those of the data. `rows`: of structures at the points of the data;
  /// null: there are none; `ofBox`: base extinction and importance, instead of those in `data`.
  void Make(std::uint64_t version, const SceneFields& data, ImportanceSmoothing smoothing,
    const StructureRow* rows, const FieldsOfBox& ofBox);

  // After Make:
  const SceneFields& Fields() const { return this->Scene; }
  const DrawnPart& Part() const { return this->Place; }
  const StructureRow* Rows() const { return this->RowsHere.data(); }

  /// Returns what owns the fields, which may outlive this object.
  std::shared_ptr<const void> Owner() const { return this->Owned; }

  bool IsThere() const { return this->Owned != nullptr; }

  /// Returns a number that grows with every change of the fields, and if there are none any more.
  std::uint64_t Version() const { return this->Changes; }

  /// The optimisation has the data's own grid.
  void Leave();

  /// Frees memory. What is made again of the same fields keeps its version.
  void Release();

private:
  bool AreOf(std::uint64_t version, ImportanceSmoothing smoothing) const;

  ControlGrid Control;
  std::string ChosenFor;          ///< what the grid depends on
  std::uint64_t SceneVersion = 0; ///< of what they were last made of; 0: the data's grid is used
  int Factor = 1;                 ///< of the grid that they were last made for
  ImportanceSmoothing Smoothing = ImportanceSmoothing::Off;
  std::shared_ptr<const void> Owned;
  SceneFields Scene;
  DrawnPart Place;
  std::vector<StructureRow> RowsHere;
  std::uint64_t Changes = 0;
};
}

#endif
