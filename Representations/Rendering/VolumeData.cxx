// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "VolumeData.h"

#include "AllCores.h"
#include "Blanking.h"
#include "Memory.h"
#include "SharedImage.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace limpid
{
namespace
{
constexpr float Empty = std::numeric_limits<float>::quiet_NaN();

std::optional<double> TimeOf(vtkImageData* image)
{
  vtkInformation* information = image->GetInformation();
  return information->Has(vtkDataObject::DATA_TIME_STEP())
    ? std::optional(information->Get(vtkDataObject::DATA_TIME_STEP()))
    : std::nullopt;
}

bool HaveSameNodes(const Grid& a, const Grid& b)
{
  return a.nodes == b.nodes && a.origin == b.origin && a.spacing == b.spacing &&
    a.direction == b.direction;
}

bool HaveSameTables(const TransferFunctions& a, const TransferFunctions& b)
{
  return a.low == b.low && a.high == b.high && a.extinction == b.extinction && a.color == b.color;
}

// Returns whether single precision can represent values as they are.
bool IsPlain(double low, double high)
{
  const double largest = std::max(std::abs(low), std::abs(high));
  return largest < 1e30 && (largest == 0 || largest > 1e-30);
}

ValueUnit UnitOf(double low, double high)
{
  ValueUnit unit;
  const double width = high - low;
  const double largest = std::max(std::abs(low), std::abs(high));
  if (width > 0 && (!IsPlain(low, high) || width < 1e-3 * largest))
  {
    unit.offset = low;
    unit.scale = 1 / width;
  }
  return unit;
}

// Returns the unit for a range outside which all values are treated alike.
ValueUnit UnitWithin(double low, double high)
{
  ValueUnit unit = UnitOf(low, high);
  unit.limit = unit.IsPlain() ? 1e30 : 1e6;
  return unit;
}

// Returns the values of an array that the core can read; none for other types and layouts.
ScalarNodes InPlace(vtkDataArray* array)
{
  if (!array->HasStandardMemoryLayout() || array->GetNumberOfComponents() != 1)
  {
    return {};
  }
  switch (array->GetDataType())
  {
    case VTK_FLOAT:
      return static_cast<const float*>(array->GetVoidPointer(0));
    case VTK_CHAR:
      return ScalarNodes(static_cast<const char*>(array->GetVoidPointer(0)));
    case VTK_SIGNED_CHAR:
      return ScalarNodes(static_cast<const signed char*>(array->GetVoidPointer(0)));
    case VTK_UNSIGNED_CHAR:
      return ScalarNodes(static_cast<const unsigned char*>(array->GetVoidPointer(0)));
    case VTK_SHORT:
      return ScalarNodes(static_cast<const short*>(array->GetVoidPointer(0)));
    case VTK_UNSIGNED_SHORT:
      return ScalarNodes(static_cast<const unsigned short*>(array->GetVoidPointer(0)));
    default:
      return {};
  }
}

bool AreFinite(const ScalarNodes& values, vtkIdType count)
{
  std::atomic<bool> finite{ true };
  if (values.Bits() == 32)
  {
    ForOnAllCores(count,
      [&](vtkIdType begin, vtkIdType end)
      {
        const float* floats = values.Floats();
        if (!std::all_of(
              floats + begin, floats + end, [](float value) { return std::isfinite(value); }))
        {
          finite = false;
        }
      });
  }
  return finite;
}

// Calls body(node, its position in data coordinates, count), which returns whether to count the
// node. Returns the count.
template <class Body>
vtkIdType CountNodes(const Grid& grid, const Body& body)
{
  std::atomic<vtkIdType> counted{ 0 };
  const vtkIdType rows = vtkIdType(grid.nodes.y) * grid.nodes.z;
  ForOnAllCores(rows,
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkIdType count = 0;
      for (vtkIdType row = begin; row < end; ++row)
      {
        const vtkIdType first = row * grid.nodes.x;
        for (int i = 0; i < grid.nodes.x; ++i)
        {
          const auto j = static_cast<double>(row % grid.nodes.y);
          const vtkIdType k = row / grid.nodes.y;
          count += body(first + i, Vec3(i, j, k)) ? 1 : 0;
        }
      }
      counted += count;
    });
  return counted;
}
}

bool VolumeData::ArrayKey::operator==(const ArrayKey& other) const
{
  return std::tie(this->array, this->ghosts, this->mapping, this->component, this->onCells) ==
    std::tie(other.array, other.ghosts, other.mapping, other.component, other.onCells);
}

VolumeData::ArrayKey VolumeData::KeyOf(
  vtkImageData* image, const FieldSource& source, vtkMTimeType mapping)
{
  ArrayKey key;
  if (!source.array)
  {
    return key;
  }
  key.array = source.array->GetMTime();
  key.mapping = mapping;
  key.component = source.component;
  key.onCells = source.onCells;
  key.ghosts = Blanking(image).MTime();
  return key;
}

// Single precision has seven digits. That is enough unless values are huge, or differ from each
// other by far less than from zero. Huge values may be fill values for missing data; then the range
// of the functions tells which values matter.
ValueUnit VolumeData::ChooseUnit(const FieldSource& source, const FunctionRange& functions)
{
  double range[2] = { std::nan(""), std::nan("") };
  if (source.array)
  {
    FiniteRange(source.array, source.component, range[0], range[1]);
  }
  if (!this->Ranks->IsAlone())
  {
    const bool isRange = range[0] <= range[1];
    range[0] = isRange ? range[0] : std::nan("");
    range[1] = isRange ? range[1] : std::nan("");
    JoinRange(*this->Ranks, range[0], range[1]);
  }
  this->Low = range[0] <= range[1] ? range[0] : 0;
  this->High = range[0] <= range[1] ? range[1] : 0;
  this->UnitIsOfFunctions = !IsPlain(this->Low, this->High) && functions.constantOutside &&
    std::min(this->High, functions.high) > std::max(this->Low, functions.low);
  return this->UnitIsOfFunctions
    ? UnitWithin(std::max(this->Low, functions.low), std::min(this->High, functions.high))
    : UnitOf(this->Low, this->High);
}

ScalarNodes VolumeData::Scalars() const
{
  return InPlace(this->ScalarValues);
}

// Returns whether the scalars are the values of the image's array, none of which is empty.
bool VolumeData::ReadsInPlace(
  const FieldSource& source, const FieldSource& extinction, const CropRegion& crop) const
{
  return this->Ranks->IsAlone() && source.array && !source.onCells && !extinction.array &&
    this->Unit.IsPlain() && this->ScalarShares.empty() && crop.IsEverything() &&
    source.array->GetNumberOfTuples() == this->Nodes().NodeCount() &&
    InPlace(source.array).IsThere() &&
    AreFinite(InPlace(source.array), source.array->GetNumberOfTuples());
}

// Makes blanked points empty, and points outside of the crop region except those of cells that its
// planes cut. Returns the number of NaN values.
vtkIdType VolumeData::EmptyScalars(const CropRegion& crop, const float* shares, float* values) const
{
  const vtkIdType invalidScalars = CountNodes(this->Nodes(),
    [=](vtkIdType node, const Vec3&)
    {
      const bool blanked = shares && shares[node] == 0;
      const bool invalid = !blanked && std::isnan(values[node]);
      values[node] = blanked ? Empty : values[node];
      return invalid;
    });
  if (!crop.IsEverything())
  {
    const Grid& grid = this->Nodes();
    CountNodes(grid,
      [=, &crop, &grid](vtkIdType node, const Vec3& index)
      {
        const bool inside = crop.Contains(grid, index, 1);
        values[node] = inside ? values[node] : Empty;
        return false;
      });
  }
  return invalidScalars;
}

// Converts the extinction array to shares of a function with the same extinction for all scalars.
void VolumeData::TakeExtinction(vtkImageData* image, const FieldSource& source, float* scalars)
{
  this->ArrayUnit.reset();
  this->NegativeExtinctions = 0;
  if (this->AnyRank(source.array != nullptr))
  {
    ArrayExtinction extinction(image, source, scalars, *this->Ranks);
    this->ScalarShares = std::move(extinction.shares);
    this->ArrayUnit = extinction.unit;
    this->ArrayMajorant = extinction.largest;
    this->InvalidScalars += extinction.invalidPoints;
    this->NegativeExtinctions = extinction.negativePoints;
  }
}

// Returns the number of points of all processes; a point on several processes counts for each.
vtkIdType VolumeData::SumOverRanks(vtkIdType here) const
{
  std::int64_t count = here;
  this->Ranks->Sum(&count, 1);
  return static_cast<vtkIdType>(count);
}

// Returns whether this process owns a node.
bool VolumeData::Owns(const Vec3& index) const
{
  const Int3 node = this->Part.Box().First() + Int3(index);
  bool owns = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    owns = owns && this->Part.Owned().along[std::size_t(axis)].Contains(node[axis]);
  }
  return owns;
}

// Returns the image without flags that matter only to a single process.
vtkImageData* VolumeData::Here(vtkImageData* image) const
{
  return this->Shared ? this->Shared->Here() : image;
}

void VolumeData::ShareAmong(
  std::shared_ptr<const Communicator> ranks, const std::array<int, 6>& wholeExtent)
{
  if (ranks != this->Ranks || wholeExtent != this->WholeExtent)
  {
    this->Release();
    this->IsReleased = false; // pieces have changed
    this->Shared.reset();
    this->Part = this->Nodes();
    this->Ranks = std::move(ranks);
    this->WholeExtent = wholeExtent;
  }
}

void VolumeData::UpdateScalars(vtkImageData* image, const FieldSource& source,
  const FieldSource& extinction, const CropRegion& crop, vtkVolumeProperty* property)
{
  const Grid grid = image->GetNumberOfPoints() > 0 ? GridOfImage(image) : Grid();
  const ArrayKey key = KeyOf(image, source, 0);
  const ArrayKey extinctionKey = KeyOf(image, extinction, 0);
  const FunctionRange functions = RangeOfFunctions(property, extinction.array == nullptr);
  const bool same = !this->AnyRank(!(key == this->ScalarsKey) ||
    !(extinctionKey == this->ExtinctionKey) || !HaveSameNodes(grid, this->InputGrid) ||
    !(crop == this->Crop) || (this->UnitIsOfFunctions && !(functions == this->UnitFunctions)));
  if (same && !this->AnyRank(!this->ScalarValues))
  {
    return;
  }
  const bool released = !this->AnyRank(!std::exchange(this->IsReleased, false));
  this->DataChanges += same ? 0 : 1;
  const std::optional<double> before = std::exchange(this->Time, TimeOf(image));
  this->TimeChanges += this->AnyRank(before && this->Time && *before != *this->Time) ? 1 : 0;
  this->ScalarValues = nullptr;
  this->Shared.reset();
  if (!this->Ranks->IsAlone())
  {
    this->Shared.emplace(this->Ranks, image, this->WholeExtent);
  }
  vtkImageData* here = this->Here(image);
  this->Unit = this->ChooseUnit(source, functions);
  this->UnitFunctions = functions;
  FieldSource scaled = source;
  if (!this->Unit.IsPlain())
  {
    scaled.mapping = [unit = this->Unit](double value) { return unit.Of(value); };
  }
  this->InputGrid = grid;
  this->Part = grid;
  this->ScalarShares = Blanking(here).Shares(source.onCells);
  this->HasOwnScalars = !this->ReadsInPlace(source, extinction, crop);
  vtkSmartPointer<vtkDataArray> values = source.array;
  if (this->HasOwnScalars)
  {
    values = this->ConvertScalars(here, scaled, extinction, crop);
  }
  else
  {
    this->InvalidScalars = 0;
    this->TakeExtinction(here, {}, nullptr);
  }
  this->ScalarValues = values; // completely or not at all
  this->ScalarsKey = key;
  this->ExtinctionKey = extinctionKey;
  this->Crop = crop;
  this->ScalarChanges += same && released ? 0 : 1;
}

// Returns the scalars as floats, with NaN where there is nothing to see.
vtkSmartPointer<vtkFloatArray> VolumeData::ConvertScalars(vtkImageData* here,
  const FieldSource& source, const FieldSource& extinction, const CropRegion& crop)
{
  vtkSmartPointer<vtkFloatArray> values =
    source.array ? ConvertField(here, source, "Scalars") : NewArray<vtkFloatArray>("Scalars", 0);
  this->InvalidScalars = this->EmptyScalars(crop, this->Shares(), values->GetPointer(0));
  this->TakeExtinction(here, extinction, values->GetPointer(0));
  this->InvalidScalars = this->SumOverRanks(this->InvalidScalars);
  this->NegativeExtinctions = this->SumOverRanks(this->NegativeExtinctions);
  if (this->Shared)
  {
    values = this->Shared->Extended(values, Empty);
    this->ScalarShares = this->Shared->Extended(this->ScalarShares);
    this->Part = this->Shared->Drawn();
  }
  return values;
}

void VolumeData::UpdateFunctions(vtkVolumeProperty* property)
{
  // Functions that are created on demand modify the property: get its time afterwards.
  property->GetScalarOpacity(0);
  property->GetColorChannels(0) == 1 ? static_cast<void>(property->GetGrayTransferFunction(0))
                                     : static_cast<void>(property->GetRGBTransferFunction(0));
  const vtkMTimeType time = property->GetMTime();
  const bool sameScalars = this->FunctionsScalars == this->ScalarChanges;
  if (property == this->Property && time == this->PropertyTime && sameScalars &&
    !this->Tables.extinction.empty())
  {
    return;
  }
  const TransferFunctions before = std::exchange(this->Tables, TransferFunctions());
  const float majorant = std::exchange(
    this->Majorant, this->ArrayUnit ? this->ArrayMajorant : LargestExtinction(property));
  const std::uint64_t exactBefore = std::exchange(this->Exact, ExactExtinction()).time;
  this->Tables = this->ArrayUnit
    ? SampleColors(property, this->Low, this->High, this->Unit, *this->ArrayUnit)
    : SampleFunctions(property, this->Low, this->High, this->Unit, this->Exact);
  this->Property = property;
  this->PropertyTime = time;
  this->FunctionsScalars = this->ScalarChanges;
  // A property also changes for other reasons than its functions, and VTK changes it during
  // drawing.
  const bool same = HaveSameTables(before, this->Tables) && majorant == this->Majorant &&
    exactBefore == this->Exact.time;
  this->FunctionChanges += sameScalars && same ? 0 : 1;
}

// Clamps importance to [0, 1], and sets it to 0 where it has no value or nothing can be seen.
// `shares`: what is kept of it at each point; empty: everything.
void VolumeData::CorrectImportance(const std::vector<float>& shares)
{
  const ScalarNodes scalars = this->Scalars();
  float* importance = this->Arrays.importance->GetPointer(0);
  const bool isCut = !this->Crop.planes.empty();
  this->Arrays.unusable.invalid = this->InvalidScalars +
    this->SumOverRanks(CountNodes(this->Nodes(),
      [=, &shares](vtkIdType node, const Vec3& index)
      {
        const bool blanked = !shares.empty() && shares[std::size_t(node)] == 0;
        const bool outside = isCut && !this->Crop.Contains(this->Nodes(), index, 0);
        const bool empty = blanked || outside || std::isnan(scalars.At(node));
        const bool invalid = !empty && std::isnan(importance[node]);
        importance[node] = empty || invalid ? 0.0F : importance[node];
        return invalid && this->Owns(index);
      }));
  this->Arrays.unusable.clamped = this->SumOverRanks(CountNodes(this->Nodes(),
    [=](vtkIdType node, const Vec3& index)
    {
      const float value = importance[node];
      importance[node] = std::min(std::max(value, 0.0F), 1.0F);
      return importance[node] != value && this->Owns(index);
    }));
  TakeShares(shares, this->Arrays.importance);
}

void VolumeData::UpdateImportance(vtkImageData* image, const FieldSource& source,
  vtkMTimeType functionTime, const Settings& settings, bool drawn)
{
  if (!this->AnyRank(source.array != nullptr))
  {
    const vtkSmartPointer<vtkFloatArray> base = this->Arrays.baseExtinction;
    this->IsImportant = false;
    this->Arrays = SceneArrays();
    this->LabelledParts = nullptr;
    this->Arrays.baseExtinction = base;
    this->UpdateScene(false, settings.importanceSmoothing, drawn);
    return;
  }
  const ArrayKey key = KeyOf(image, source, functionTime);
  const bool current = this->IsImportant && key == this->ImportanceKey &&
    this->ImportanceScalars == this->ScalarChanges;
  if (this->AnyRank(!current))
  {
    this->IsImportant = false;
    this->Arrays.importance = nullptr;
    ++this->ImportanceChanges;
  }
  const double ofFields = (this->HasOwnScalars ? sizeof(float) : 0) + (drawn ? sizeof(float) : 0);
  const bool coarser =
    this->Part.IsWhole() && this->Control.Choose(settings, this->Part, ofFields).factor > 1;
  const bool needed =
    !coarser || drawn || !this->Control.Are(this->DataSceneVersion(), settings.importanceSmoothing);
  if (this->AnyRank(needed && !this->Arrays.importance))
  {
    this->IsImportant = false; // in case one of the next lines throws
    if (this->Shared)
    {
      this->Shared.emplace(this->Ranks, image, this->WholeExtent);
    }
    this->TakeImportance(this->Here(image), source);
    this->ImportanceKey = key;
    this->ImportanceScalars = this->ScalarChanges;
    this->IsImportant = true;
    ++this->ImportanceFields;
  }
  this->UpdateScene(coarser, settings.importanceSmoothing, drawn);
}

void VolumeData::TakeImportance(vtkImageData* here, const FieldSource& source)
{
  SceneArrays taken;
  taken.importance = NewArray<vtkFloatArray>("Importance", 0);
  taken.structureRows = NewArray<vtkUnsignedShortArray>("Structure", 0);
  if (source.array)
  {
    ConvertImportance(here, source, taken);
  }
  std::vector<float> shares = Blanking(here).Shares(source.onCells);
  if (this->Shared)
  {
    taken.importance = this->Shared->Extended(taken.importance, 0.0F);
    shares = this->Shared->Extended(shares);
    if (source.structures)
    {
      taken.structureRows = this->Shared->Extended(taken.structureRows);
    }
  }
  this->Arrays.importance = taken.importance;
  this->Arrays.structureRows = taken.structureRows;
  this->LabelledParts = source.structures;
  this->CorrectImportance(shares);
}

void VolumeData::UpdateReferences(vtkImageData* image, const std::vector<FieldSource>& sources)
{
  std::vector<ArrayKey> keys;
  keys.reserve(sources.size());
  for (const FieldSource& source : sources)
  {
    keys.push_back(KeyOf(image, source, 0));
  }
  const bool same = keys == this->ReferenceKeys && this->ReferenceScalars == this->ScalarChanges;
  const bool changed = this->AnyRank(!same);
  bool released = false;
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    released = released || (sources[i].array && !this->Given[i]);
  }
  if (!this->AnyRank(changed || released))
  {
    return;
  }
  std::size_t number = 0;
  for (vtkSmartPointer<vtkFloatArray>& reference : this->Given)
  {
    const FieldSource& source = sources[number];
    ++number;
    reference = nullptr;
    if (this->AnyRank(source.array != nullptr))
    {
      reference = source.array ? ConvertField(this->Here(image), source, "Reference")
                               : NewArray<vtkFloatArray>("Reference", 0);
      reference = this->Shared ? this->Shared->Extended(reference, 0.0F) : reference;
    }
  }
  this->ReferenceKeys = keys;
  this->ReferenceScalars = this->ScalarChanges;
  this->ReferenceChanges += changed ? 1 : 0;
}

std::string VolumeData::Warning() const
{
  UnusablePoints unusable = this->Arrays.unusable;
  unusable.invalid = std::max(unusable.invalid, this->InvalidScalars);
  unusable.negative = this->NegativeExtinctions;
  return this->Arrays.baseExtinction || this->ScalarValues
    ? unusable.Warning(this->Whole().NodeCount())
    : std::string();
}

void VolumeData::Release()
{
  this->ScalarValues = nullptr;
  this->IsReleased = true;
  this->ScalarShares = {};
  this->Arrays = SceneArrays();
  this->Control.Release();
  this->LabelledParts = nullptr;
  this->Given = {};
}
}
