// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkAddStructures.h"

#include "Abort.h"
#include "Choices.h"
#include "ImageFile.h"
#include "InputArrays.h"
#include "LabelResampling.h"
#include "Memory.h"
#include "OwnArrays.h"
#include "PropertyPrinter.h"
#include "StructureLooks.h"
#include "StructureTableFile.h"
#include "WholeRequest.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "backend/Interruption.h"
#include "math/Require.h"
#include "scene/Grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkAddStructures);

namespace
{
using Looks = limpid::StructureLooks;

const limpid::MemoryNeed NeedOfAdding{ 2 * sizeof(std::int64_t), limpid::fewerPoints };

// Adds the numeric arrays of the points or the cells of an image.
void AddArrays(
  vtkDataSetAttributes* attributes, bool onCells, std::vector<limpid::FieldSource>& all)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = attributes->GetArray(i);
    const bool isGhosts = array && array->GetName() &&
      std::strcmp(array->GetName(), vtkDataSetAttributes::GhostArrayName()) == 0;
    if (array && !isGhosts)
    {
      all.push_back({ array, onCells, 0 });
    }
  }
}

// Returns all numeric arrays of an image, those of the points first.
std::vector<limpid::FieldSource> AllArraysOf(vtkImageData* image)
{
  std::vector<limpid::FieldSource> all;
  AddArrays(image->GetPointData(), false, all);
  AddArrays(image->GetCellData(), true, all);
  LIMPID_REQUIRE(!all.empty(),
    "The structures have no numeric arrays (one has the labels, or each is a mask). Give an image "
    "with labels or masks.");
  return all;
}

std::vector<limpid::FieldSource> ComponentsOf(const std::vector<limpid::FieldSource>& arrays)
{
  std::vector<limpid::FieldSource> components;
  for (limpid::FieldSource source : arrays)
  {
    for (source.component = 0; source.component < source.array->GetNumberOfComponents();
         ++source.component)
    {
      components.push_back(source);
    }
  }
  return components;
}

std::string NameOfMask(const limpid::FieldSource& mask)
{
  std::string array = limpid::NameOf(mask.array);
  if (mask.array->GetNumberOfComponents() == 1)
  {
    return array;
  }
  const char* component = mask.array->GetComponentName(mask.component);
  return component ? component : array + "_" + std::to_string(mask.component);
}

// Returns where the points of an image are according to the file that it was read from.
limpid::Grid GridInFile(vtkImageData* image, const std::string& path)
{
  const limpid::Grid here = limpid::GridOfImage(image);
  limpid::Grid there;
  try
  {
    there = limpid::ReadImageHeader(path).grid;
  }
  catch (const limpid::Error& error)
  {
    throw limpid::Error(
      "The image file \"" + path + "\" cannot be read. " + std::string(error.what()));
  }
  const int* extent = image->GetExtent();
  const limpid::Int3 first(extent[0], extent[2], extent[4]);
  const limpid::Int3 last = first + here.nodes;
  for (int axis = 0; axis < 3; ++axis)
  {
    constexpr double rounding = 1e-3; // of headers that are text
    const bool isInside = first[axis] >= 0 && last[axis] <= there.nodes[axis];
    const double ratio = here.spacing[axis] / there.spacing[axis];
    LIMPID_REQUIRE(isInside && std::abs(ratio - 1) < rounding,
      "The image has points " << first[axis] << " to " << last[axis] - 1 << ", "
                              << here.spacing[axis] << " apart, along axis " << axis
                              << ", and the file \"" << path << "\" has " << there.nodes[axis]
                              << ", " << there.spacing[axis]
                              << " apart (the image was not read from it). Correct ImageFile, or "
                                 "leave it empty.");
  }
  there.origin = there.PointToWorld(limpid::Vec3(first));
  there.nodes = here.nodes;
  return there;
}

limpid::Grid GridOfLabels(vtkImageData* image)
{
  try
  {
    return limpid::GridOfImage(image);
  }
  catch (const limpid::Error& error)
  {
    throw limpid::Error("The structures cannot be placed. " + std::string(error.what()));
  }
}

// Returns the names of labels 1, 2 and so on.
Looks LooksOf(const std::vector<limpid::FieldSource>& masks)
{
  Looks looks;
  for (const limpid::FieldSource& mask : masks)
  {
    looks[static_cast<std::int64_t>(looks.size() + 1)] = { NameOfMask(mask), {} };
  }
  return looks;
}

bool HasAny(const Looks& looks, const std::map<std::int64_t, vtkIdType>& labels)
{
  return std::any_of(
    looks.begin(), looks.end(), [&labels](const auto& entry) { return labels.count(entry.first); });
}

// Adds the columns Red, Green and Blue, NaN where a label has no colour; none if no label has one.
void AddColors(const std::map<std::int64_t, vtkIdType>& labels, const Looks& looks, vtkTable* table)
{
  const std::array<const char*, 3> names{ "Red", "Green", "Blue" };
  for (std::size_t channel = 0; channel < names.size(); ++channel)
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(names[channel]);
    bool hasAny = false;
    for (const auto& entry : labels)
    {
      const auto look = looks.find(entry.first);
      const bool hasColor = look != looks.end() && look->second.color;
      column->InsertNextValue(
        hasColor ? (*look->second.color)[channel] : std::numeric_limits<double>::quiet_NaN());
      hasAny = hasAny || hasColor;
    }
    if (hasAny)
    {
      table->AddColumn(column);
    }
  }
}
}

// Reads the inputs, and writes the outputs.
struct vtkAddStructures::Internals
{
  // What port 1 has.
  struct Labels
  {
    vtkSmartPointer<vtkDataArray> values;
    bool onCells = false;
    Looks masks; // all of them, also those that are empty
    Looks looks; // of labels, of which the data need not have all
  };

  static vtkImageData* RequireImage(vtkInformationVector* input, const std::string& subject);
  limpid::FieldSource ChosenArray(vtkImageData* image) const;
  Labels Read(vtkImageData* image) const;
  Labels ReadMasks(vtkImageData* image, const std::vector<limpid::FieldSource>& masks) const;
  void AddLooks(const std::map<std::int64_t, vtkIdType>& labels, Looks& looks) const;
  void Write(const Labels& labels, vtkDataArray* structure, vtkTable* table) const;
  void Run(vtkInformationVector** inputVector, vtkImageData* output, vtkTable* table) const;

  vtkAddStructures* Self;
};

vtkImageData* vtkAddStructures::Internals::RequireImage(
  vtkInformationVector* input, const std::string& subject)
{
  const std::string refusal =
    limpid::RefusalOf(vtkDataObject::GetData(input), "this filter needs", subject);
  LIMPID_REQUIRE(refusal.empty(), refusal);
  vtkImageData* image = vtkImageData::GetData(input);
  LIMPID_REQUIRE(image && image->GetNumberOfPoints() > 0,
    subject << " has no points (there is nothing to process). Give it an image with data.");
  return image;
}

limpid::FieldSource vtkAddStructures::Internals::ChosenArray(vtkImageData* image) const
{
  const std::string name = limpid::ChosenName(this->Self, 0);
  if (name.empty())
  {
    const std::vector<limpid::FieldSource> all = AllArraysOf(image);
    const auto scalars = std::find_if(all.begin(), all.end(),
      [image](const auto& source)
      {
        return source.array ==
          (source.onCells ? image->GetCellData()->GetScalars()
                          : image->GetPointData()->GetScalars());
      });
    return scalars == all.end() ? all.front() : *scalars;
  }
  limpid::FieldSource source = limpid::FindField(
    image, name, this->Self->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_ASSOCIATION()));
  LIMPID_REQUIRE(source.array,
    "The label array \"" << name
                         << "\" is not among the numeric arrays of the structures (it says which "
                            "points belong to which structure). Choose one of these: "
                         << limpid::ArrayNames(image) << ".");
  return source;
}

vtkAddStructures::Internals::Labels vtkAddStructures::Internals::ReadMasks(
  vtkImageData* image, const std::vector<limpid::FieldSource>& masks) const
{
  for (const limpid::FieldSource& mask : masks)
  {
    limpid::RequireOneEach(image, mask);
  }
  const limpid::MaskLabels read = limpid::LabelsOfMasks(masks);
  if (read.overlaps > 0)
  {
    vtkWarningWithObjectMacro(this->Self, << "Masks overlap at " << read.overlaps
                                          << (masks.front().onCells ? " cells" : " points")
                                          << " of the structures (each belongs to one structure): "
                                             "the last mask counts. If it should be "
                                             "another one, order the arrays accordingly.");
  }
  return { read.labels, masks.front().onCells, LooksOf(masks), {} };
}

vtkAddStructures::Internals::Labels vtkAddStructures::Internals::Read(vtkImageData* image) const
{
  if (this->Self->MasksToLabels)
  {
    const std::vector<limpid::FieldSource> all = AllArraysOf(image);
    LIMPID_REQUIRE(all.front().onCells == all.back().onCells,
      "There are masks of points and masks of cells, "
        << limpid::ArrayNames(image)
        << " (they have different grids). Remove one kind of arrays with Pass Arrays.");
    return this->ReadMasks(image, ComponentsOf(all));
  }
  const limpid::FieldSource chosen = this->ChosenArray(image);
  if (chosen.array->GetNumberOfComponents() > 1)
  {
    return this->ReadMasks(image, ComponentsOf({ chosen }));
  }
  limpid::RequireOneEach(image, chosen);
  return { limpid::WholeLabels(chosen.array), chosen.onCells, {}, limpid::StructureLooksOf(image) };
}

// Adds the names and colours of TableFile.
void vtkAddStructures::Internals::AddLooks(
  const std::map<std::int64_t, vtkIdType>& labels, Looks& looks) const
{
  const std::string& path = this->Self->TableFile;
  if (path.empty())
  {
    return;
  }
  const limpid::StructureTableFile file = limpid::ReadStructureTable(path);
  if (!file.warning.empty())
  {
    vtkWarningWithObjectMacro(this->Self, << file.warning);
  }
  else if (!HasAny(file.looks, labels))
  {
    vtkWarningWithObjectMacro(this->Self,
      << "The table file \"" << path << "\" names " << file.looks.size()
      << " labels, and none of them is in the data (names stay empty). Give the table that belongs "
         "to these structures.");
  }
  for (const auto& [label, look] : file.looks)
  {
    looks[label] = look;
  }
}

void vtkAddStructures::Internals::Write(
  const Labels& labels, vtkDataArray* structure, vtkTable* table) const
{
  std::map<std::int64_t, vtkIdType> given = limpid::CountLabels(labels.values);
  for (const auto& entry : labels.masks)
  {
    given.emplace(entry.first, 0);
  }
  given.erase(0);
  Looks looks = labels.masks.empty() ? labels.looks : labels.masks;
  this->AddLooks(given, looks);
  std::map<std::int64_t, vtkIdType> points = limpid::CountLabels(structure);
  vtkNew<vtkIdTypeArray> labelColumn;
  vtkNew<vtkStringArray> nameColumn;
  vtkNew<vtkIdTypeArray> pointColumn;
  labelColumn->SetName("Label");
  nameColumn->SetName("Name");
  pointColumn->SetName("Points");
  vtkIdType inside = 0;
  for (const auto& entry : given)
  {
    const std::int64_t label = entry.first;
    labelColumn->InsertNextValue(static_cast<vtkIdType>(label));
    nameColumn->InsertNextValue(looks[label].name);
    pointColumn->InsertNextValue(points[label]);
    inside += points[label];
  }
  table->AddColumn(labelColumn);
  table->AddColumn(nameColumn);
  table->AddColumn(pointColumn);
  AddColors(given, looks, table);
  if (inside == 0)
  {
    vtkWarningWithObjectMacro(this->Self,
      << (given.empty()
             ? "All labels are 0 (there are no structures). Choose another array, or check the "
               "file."
             : "No point of the input is in a structure (the two images are at different places, "
               "or structures are smaller than the spacing). Compare their bounds and directions "
               "in "
               "the Information tab: some readers ignore directions or shift origins."));
  }
}

void vtkAddStructures::Internals::Run(
  vtkInformationVector** inputVector, vtkImageData* output, vtkTable* table) const
{
  vtkImageData* input = RequireImage(inputVector[0], "The input");
  vtkImageData* structures = RequireImage(inputVector[1], "The input Structures");
  const std::string& file = this->Self->ImageFile;
  const limpid::Grid image = file.empty() ? limpid::GridOfImage(input) : GridInFile(input, file);
  const limpid::Grid labelled = GridOfLabels(structures);
  const Labels labels = this->Read(structures);
  const vtkSmartPointer<vtkDataArray> structure = limpid::ResampleLabels(image, labelled,
    labels.values, labels.onCells,
    this->Self->Resampling == NEAREST ? limpid::Resampling::Nearest : limpid::Resampling::Majority);
  output->ShallowCopy(input);
  output->GetPointData()->AddArray(structure);
  this->Write(labels, structure, table);
  if (!limpid::MarkResults(input->GetPointData(), output->GetPointData()).empty())
  {
    vtkWarningWithObjectMacro(this->Self,
      "The input has an array \"Structure\" (array names are unique, so the output has the result "
      "instead). Rename it before this filter if you need it after it.");
  }
}

vtkAddStructures::vtkAddStructures()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkAddStructures::~vtkAddStructures() = default;

vtkTable* vtkAddStructures::GetStructureTable()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkAddStructures::FillInputPortInformation(int, vtkInformation* info)
{
  // Data of other types are reported by this filter, as by vtkVisibilityAlgorithm.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

int vtkAddStructures::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkAddStructures::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  // A point may be anywhere in the label image, of which all is requested.
  limpid::RequestWhole(inputVector[1]->GetInformationObject(0));
  return 1;
}

int vtkAddStructures::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* output = vtkImageData::GetData(outputVector, 0);
  vtkTable* table = vtkTable::GetData(outputVector, 1);
  const auto clear = [output, table] // no partial result
  {
    output->Initialize();
    table->Initialize();
  };
  try
  {
    const limpid::Interruptible interruptible(
      [this](double share)
      {
        this->UpdateProgress(share);
        return !limpid::IsAborted(this);
      });
    clear();
    Internals{ this }.Run(inputVector, output, table);
    return 1;
  }
  catch (const limpid::Interrupted&)
  {
    clear();
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< limpid::MessageOf(error, vtkImageData::GetData(inputVector[0]), NeedOfAdding));
    clear();
    return 0;
  }
}

void vtkAddStructures::PrintSelf(ostream& os, vtkIndent indent)
{
  const limpid::PropertyPrinter print{ os, indent };

  this->Superclass::PrintSelf(os, indent);
  print("Resampling", this->Resampling);
  print("MasksToLabels", this->MasksToLabels);
  print("TableFile", this->TableFile);
  print("ImageFile", this->ImageFile);
}
