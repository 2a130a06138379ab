// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The scene of the optimisation of a volume.

#include "VolumeData.h"

#include "AllCores.h"
#include "Memory.h"

#include <algorithm>

namespace limpid
{
// Computes the base extinction of layers of points along the third axis.
void VolumeData::FillBaseExtinction(const Range<int>& layers, float* base) const
{
  const Int3 nodes = this->Nodes().nodes;
  const Index perLayer = Index(nodes.x) * nodes.y;
  const Index first = layers.begin * perLayer;
  const Index count = layers.Length() * perLayer;
  LookUpExtinction(this->Tables, this->Exact, this->Unit, this->Scalars().From(first), count, base);
  if (const float* shares = this->Shares())
  {
    std::transform(shares + first, shares + first + count, base, base,
      [](float share, float value) { return share * value; });
  }
  if (this->Crop.planes.empty())
  {
    return;
  }
  ForOnAllCores(Index(layers.Length()) * nodes.y,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        const Index layer = layers.begin + row / nodes.y;
        const Vec3 start(0, double(row % nodes.y), double(layer));
        float* values = base + row * nodes.x;
        for (int i = 0; i < nodes.x; ++i)
        {
          const bool inside = this->Crop.Contains(this->Nodes(), start + Vec3(i, 0, 0), 0);
          values[i] = inside ? values[i] : 0.0F;
        }
      }
    });
}

void VolumeData::UpdateBaseExtinction()
{
  if (this->BaseVersion != this->FunctionChanges || !this->Arrays.baseExtinction)
  {
    const Grid& grid = this->Nodes();
    const auto base = NewArray<vtkFloatArray>("BaseExtinction", grid.NodeCount());
    this->FillBaseExtinction({ 0, grid.nodes.z }, base->GetPointer(0));
    this->Arrays.baseExtinction = base;
    this->BaseVersion = this->FunctionChanges;
  }
}

// Keeps the base extinction and the importance of the data only for whom needs them. `coarser`:
// whether the optimisation has another grid.
void VolumeData::UpdateScene(bool coarser, ImportanceSmoothing smoothing, bool drawn)
{
  if (!coarser)
  {
    this->Control.Leave();
  }
  else if (!this->Control.Are(this->DataSceneVersion(), smoothing))
  {
    this->MakeControlFields(smoothing);
  }
  if (coarser && !drawn)
  {
    this->Arrays.importance = nullptr;
  }
  if (!this->Crop.planes.empty() || (this->HasImportance() && !coarser))
  {
    this->UpdateBaseExtinction();
  }
  else
  {
    this->Arrays.baseExtinction = nullptr;
  }
}

// Makes the fields of another grid, without a base extinction of the data.
void VolumeData::MakeControlFields(ImportanceSmoothing smoothing)
{
  const float* importances = this->Importance();
  const Int3 nodes = this->Nodes().nodes;
  this->Control.Make(this->DataSceneVersion(), this->DataScene(), smoothing,
    this->Labelled() ? this->StructureRows() : nullptr,
    [&](const NodeBox& box, float* base, float* importance)
    {
      const Range<int>& layers = box.along[2];
      const Index perLayer = Index(nodes.x) * nodes.y;
      this->FillBaseExtinction(layers, base);
      std::copy(
        importances + perLayer * layers.begin, importances + perLayer * layers.end, importance);
    });
}

// Returns the scene at the points of the data; without a base extinction if there is none.
SceneFields VolumeData::DataScene() const
{
  SceneFields scene;
  scene.grid = this->Whole();
  scene.piece = this->Part.Piece();
  const auto& base = this->Arrays.baseExtinction;
  scene.baseExtinction = base ? base->GetPointer(0) : nullptr;
  scene.importance = this->Arrays.importance->GetPointer(0);
  scene.majorant = this->Majorant;
  SetReferences(this->Given, scene);
  scene.despeckled = this->Labelled() ? scene.importance : nullptr; // labels have no noise
  return scene;
}

SceneFields VolumeData::Scene() const
{
  return this->Control.IsThere() ? this->Control.Fields() : this->DataScene();
}

std::shared_ptr<const void> VolumeData::SceneOwner() const
{
  if (this->Control.IsThere())
  {
    return this->Control.Owner();
  }
  return std::make_shared<vtkSmartPointer<vtkFloatArray>>(this->Arrays.baseExtinction);
}

// The sum is unique, since each change increases it.
std::uint64_t VolumeData::DataSceneVersion() const
{
  return this->ScalarChanges + this->FunctionChanges + this->ImportanceChanges +
    this->ReferenceChanges;
}

std::uint64_t VolumeData::SceneVersion() const
{
  return this->DataSceneVersion() + this->Control.Version();
}
}
