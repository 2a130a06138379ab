// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ControlFields.h"

#include "distributed/FieldResampling.h"
#include "optimize/SceneStructures.h"

#include <array>
#include <sstream>
#include <utility>

namespace limpid
{
namespace
{
// Memory of a display beside its input and fields of its points: what gradients and pictures take,
// and what the optimisation and shadows take. Measured by Testing/Benchmarks/large_display.py at
// 512^3 points: 17.6 bytes a point at half and 10.2 at quarter resolution.
constexpr NeedPerNode Need{ 10, 64 };

// Returns a reference on another grid; empty if there is none.
std::vector<float> ReferenceOn(
  const SceneFields& data, const float* values, const Grid& grid, const ScenePiece& piece)
{
  return values ? ResampledIn(*ScenePiece::Whole(data.grid), data.grid, values, grid, piece.boxes)
                : std::vector<float>();
}

// Fields of a process alone.
struct OwnFields
{
  CoarseFields fields;
  std::array<std::vector<float>, givenReferences> references;
};
}

const ControlGrid& ControlFields::Choose(
  const Settings& settings, const DrawnPart& part, double ofFields)
{
  const Int3& nodes = part.Whole().nodes;
  std::ostringstream what;
  what << nodes.x << ' ' << nodes.y << ' ' << nodes.z << ' ' << part.Nodes().NodeCount() << ' '
       << int(settings.controlResolution) << ' ' << settings.memoryLimit << ' ' << ofFields;
  if (what.str() != this->ChosenFor)
  {
    NeedPerNode need = Need;
    need.ofData += ofFields;
    this->Control = ChooseControlGrid(settings, part.Whole(), *part.Piece(), need);
    this->ChosenFor = what.str();
  }
  return this->Control;
}

bool ControlFields::Are(std::uint64_t version, ImportanceSmoothing smoothing) const
{
  return this->IsThere() && this->AreOf(version, smoothing);
}

// Returns whether the fields that were made last are those of a version of the scene.
bool ControlFields::AreOf(std::uint64_t version, ImportanceSmoothing smoothing) const
{
  return version == this->SceneVersion && smoothing == this->Smoothing &&
    this->Control.factor == this->Factor;
}

void ControlFields::Make(std::uint64_t version, const SceneFields& data,
  ImportanceSmoothing smoothing, const StructureRow* rows, const FieldsOfBox& ofBox)
{
  const bool same = this->AreOf(version, smoothing);
  this->Release();
  const Grid grid = CoarseGrid(data.grid, this->Control.factor);
  const std::shared_ptr<const ScenePiece> piece = ScenePiece::Whole(grid);
  auto own = std::make_shared<OwnFields>();
  own->fields = MakeCoarseFields(data.grid, grid,
    data.despeckled ? ImportanceSmoothing::Off : smoothing, ofBox, NodesAtATime(data.grid));
  this->Scene = own->fields.Scene();
  this->Scene.majorant = data.majorant;
  for (std::size_t i = 0; i < givenReferences; ++i)
  {
    own->references[i] = ReferenceOn(data, data.references[i], grid, *piece);
    this->Scene.references[i] = data.references[i] ? own->references[i].data() : nullptr;
  }
  this->Owned = std::move(own);
  if (data.despeckled == data.importance) // labels have no noise
  {
    this->Scene.despeckled = this->Scene.importance;
  }
  this->Place = grid;
  if (rows)
  {
    this->RowsHere = RowsOn(*ScenePiece::Whole(data.grid), data.grid, rows, *piece, grid);
  }
  this->SceneVersion = version;
  this->Smoothing = smoothing;
  this->Factor = this->Control.factor;
  this->Changes += same ? 0 : 1;
}

void ControlFields::Leave()
{
  this->Changes += this->SceneVersion != 0 ? 1 : 0;
  this->SceneVersion = 0;
  this->Release();
}

void ControlFields::Release()
{
  this->Owned = nullptr;
  this->Scene = SceneFields();
  this->RowsHere = {};
}
}
