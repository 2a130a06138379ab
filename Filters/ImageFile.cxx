// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ImageFile.h"

#include "Memory.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"

#include <vtksys/SystemTools.hxx>

#include "math/Require.h"
#include "scene/ImageGrid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

namespace limpid
{
namespace
{
bool HasEnd(const std::string& path, const char* end)
{
  return vtksys::SystemTools::StringEndsWith(vtksys::SystemTools::LowerCase(path), end);
}

// Where the values of an image are in a file, in steps of one value.
struct Layout
{
  Layout(const ImageFile& file, int layer, const AxisOrder& order)
    : nodes(InOrder(file.grid, order).nodes)
    , first(layer)
  {
    const Int3& stored = file.grid.nodes;
    const std::array<Index, 3> strides{ file.layers, Index(file.layers) * stored.x,
      Index(file.layers) * stored.x * stored.y };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto from = static_cast<std::size_t>(order.from[axis]);
      this->step[axis] = order.isBackwards[axis] ? -strides[from] : strides[from];
      this->first += order.isBackwards[axis] ? strides[from] * (stored[order.from[axis]] - 1) : 0;
    }
  }

  Int3 nodes;
  Index first;
  std::array<Index, 3> step{};
};

template <class Value>
std::unique_ptr<Value[]> Arranged(
  const std::vector<char>& bytes, const Layout& layout, bool isBigEndian)
{
  const Int3& nodes = layout.nodes;
  std::unique_ptr<Value[]> values(
    new Value[static_cast<std::size_t>(Index(nodes.x) * nodes.y * nodes.z)]);
  Value* value = values.get();
  for (int z = 0; z < nodes.z; ++z)
  {
    for (int y = 0; y < nodes.y; ++y)
    {
      const Index row = layout.first + z * layout.step[2] + y * layout.step[1];
      for (int x = 0; x < nodes.x; ++x)
      {
        const auto at = static_cast<std::size_t>(row + x * layout.step[0]);
        *value++ = NumberAt<Value>(bytes.data() + at * sizeof(Value), isBigEndian);
      }
    }
  }
  return values;
}

template <class Value>
vtkSmartPointer<vtkDataArray> Read(const ImageFile& file, const Layout& layout)
{
  const Index count = file.grid.NodeCount();
  const std::int64_t size = count * file.layers * static_cast<std::int64_t>(sizeof(Value));
  RequireBytes(file.voxels, size);
  // One byte more: if there is none, a checksum has been reached.
  const std::int64_t wanted = size + (file.voxels.isCompressed ? 1 : 0);
  std::vector<char> bytes(static_cast<std::size_t>(wanted));
  const std::int64_t read = ReadBytes(file.voxels, bytes.data(), wanted);
  LIMPID_REQUIRE(read == size,
    "There are " << (read > size ? "more bytes of values than " : "fewer bytes of values than ")
                 << size
                 << " (the file is cut short or damaged, or its header is wrong). Copy or write it "
                    "again.");
  std::unique_ptr<Value[]> values = Arranged<Value>(bytes, layout, file.voxels.isBigEndian);
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(file.type));
  array->SetVoidArray(values.release(), count, 0, vtkAbstractArray::VTK_DATA_ARRAY_DELETE);
  return array;
}

vtkSmartPointer<vtkDataArray> Rescaled(vtkDataArray* stored, const ImageFile& file)
{
  const auto array = NewArray<vtkFloatArray>("", stored->GetNumberOfTuples());
  for (vtkIdType i = 0; i < stored->GetNumberOfTuples(); ++i)
  {
    array->SetValue(
      i, static_cast<float>(file.slope * stored->GetComponent(i, 0) + file.intercept));
  }
  return array;
}
}

ImageFile ReadImageHeader(const std::string& path)
{
  LIMPID_REQUIRE(vtksys::SystemTools::FileExists(path, true),
    "There is no such file (it has the image). Correct FileName.");
  if (HasEnd(path, ".nii") || HasEnd(path, ".nii.gz"))
  {
    return ReadNiftiHeader(path);
  }
  if (HasEnd(path, ".nrrd") || HasEnd(path, ".nhdr"))
  {
    return ReadNrrdHeader(path);
  }
  LIMPID_REQUIRE(HasEnd(path, ".mha") || HasEnd(path, ".mhd"),
    "Its name has none of the known endings (they tell the format). Name it .nii, .nii.gz, .nrrd, "
    ".nhdr, .mha or .mhd.");
  return ReadMetaHeader(path);
}

vtkSmartPointer<vtkDataArray> ReadValues(const ImageFile& file, int layer, const AxisOrder& order)
{
  const Layout layout(file, layer, order);
  vtkSmartPointer<vtkDataArray> values;
  switch (file.type)
  {
    vtkTemplateMacro(values = Read<VTK_TT>(file, layout));
  }
  const bool isScaled = file.slope != 1 || file.intercept != 0;
  values = isScaled ? Rescaled(values, file) : values;
  values->SetName("Values");
  return values;
}

AxisOrder::AxisOrder(const Grid& file)
  : from{ 0, 1, 2 }
{
  const auto nearness = [&file](const std::array<int, 3>& axes)
  {
    return std::abs(file.direction[axes[0]].x) + std::abs(file.direction[axes[1]].y) +
      std::abs(file.direction[axes[2]].z);
  };
  for (std::array<int, 3> axes{ 0, 1, 2 }; std::next_permutation(axes.begin(), axes.end());)
  {
    constexpr double rounding = 1e-9;
    this->from = nearness(axes) > nearness(this->from) + rounding ? axes : this->from;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto at = static_cast<std::size_t>(axis);
    this->isBackwards[at] = file.direction[this->from[at]][axis] < 0;
  }
}

Grid InOrder(const Grid& file, const AxisOrder& order)
{
  Grid image = file;
  Vec3 first(0.0); // point of the file
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto at = static_cast<std::size_t>(axis);
    const int from = order.from[at];
    const bool isBackwards = order.isBackwards[at];
    image.nodes[axis] = file.nodes[from];
    image.spacing[axis] = file.spacing[from];
    image.direction[axis] = isBackwards ? -file.direction[from] : file.direction[from];
    first[from] = isBackwards ? file.nodes[from] - 1 : 0;
  }
  image.origin = file.PointToWorld(first);
  return image;
}

Grid GridOfSteps(const Int3& nodes, const Vec3& origin, const Mat3& steps)
{
  const Vec3 spacing(glm::length(steps[0]), glm::length(steps[1]), glm::length(steps[2]));
  LIMPID_REQUIRE(spacing.x > 0 && spacing.y > 0 && spacing.z > 0,
    "The points are " << spacing.x << ", " << spacing.y << " and " << spacing.z
                      << " apart along the axes (the image has no volume). Correct its header.");
  const Mat3 direction(steps[0] / spacing.x, steps[1] / spacing.y, steps[2] / spacing.z);
  return ImageGrid(nodes, origin, spacing, direction);
}
}
