// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ImageFile.h"

#include "Memory.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"

#include <vtksys/SystemTools.hxx>

#include "math/Require.h"
#include "scene/ImageGrid.h"

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

// Returns one of `layers` values of each point.
template <class Value>
std::unique_ptr<Value[]> ValuesIn(const std::vector<char>& bytes, const ImageFile& file, int layer)
{
  const auto count = static_cast<std::size_t>(file.grid.NodeCount());
  const std::size_t step = static_cast<std::size_t>(file.layers) * sizeof(Value);
  const char* stored = bytes.data() + static_cast<std::size_t>(layer) * sizeof(Value);
  std::unique_ptr<Value[]> values(new Value[count]);
  for (std::size_t i = 0; i < count; ++i)
  {
    values[i] = NumberAt<Value>(stored + i * step, file.voxels.isBigEndian);
  }
  return values;
}

template <class Value>
vtkSmartPointer<vtkDataArray> Read(const ImageFile& file, int layer)
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
  std::unique_ptr<Value[]> values = ValuesIn<Value>(bytes, file, layer);
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

vtkSmartPointer<vtkDataArray> ReadValues(const ImageFile& file, int layer)
{
  vtkSmartPointer<vtkDataArray> values;
  switch (file.type)
  {
    vtkTemplateMacro(values = Read<VTK_TT>(file, layer));
  }
  const bool isScaled = file.slope != 1 || file.intercept != 0;
  values = isScaled ? Rescaled(values, file) : values;
  values->SetName("Values");
  return values;
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
