// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is drawn: the fields of an image and the functions of a property as the core wants them.
// Each part is made anew only when what it is made of has changed.

#ifndef limpid_VolumeData_h
#define limpid_VolumeData_h

#include "ArrayExtinction.h"
#include "CropRegion.h"
#include "SceneConversion.h"
#include "SharedVolume.h"
#include "TransferTables.h"

#include "optimize/Solver.h"
#include "render/Renderer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkImageData;
class vtkVolumeProperty;

namespace limpid
{
class VolumeData
{
public:
  /// The processes that share the image from now on, with its whole extent; null: this one has all.
  void ShareAmong(std::shared_ptr<const Communicator> ranks, const std::array<int, 6>& wholeExtent);

  /// The scalar field, and the base extinction if that comes from an array, too; an array of null:
  /// it comes from the functions. Throws when the image or an array cannot be worked with.
  /// `property`: whose functions say which values count where some are huge.
  void UpdateScalars(vtkImageData* image, const FieldSource& source, const FieldSource& extinction,
    const CropRegion& crop, vtkVolumeProperty* property);

  /// The transfer functions, for the present scalars. Throws when they make no sense.
  void UpdateFunctions(vtkVolumeProperty* property);

  /// The importance at the points of the image; an array of null: there is none. `functionTime`:
  /// when the source's mapping was changed last.
  void UpdateImportance(vtkImageData* image, const FieldSource& source, vtkMTimeType functionTime);

  /// Gives the memory back.
  void Release();

  const Grid& Nodes() const { return this->NodeGrid; } ///< that are here

  /// Those of all processes, and what of these is here; null: all.
  const Grid& Whole() const { return this->Shared ? this->Shared->Whole() : this->NodeGrid; }
  std::shared_ptr<const ScenePiece> Piece() const
  {
    return this->Shared ? this->Shared->Drawn() : nullptr;
  }

  const float* Scalars() const { return this->ScalarValues->GetPointer(0); } ///< NaN: empty
  const CropRegion& Cropped() const { return this->Crop; }

  /// The part of the functions' extinction that is left at each point [0, 1]; null: all of it.
  const float* Shares() const
  {
    return this->ScalarShares.empty() ? nullptr : this->ScalarShares.data();
  }

  const TransferFunctions& Functions() const { return this->Tables; }
  bool HasImportance() const { return this->Arrays.importance != nullptr; }

  /// At each point [0, 1]. HasImportance() must be true.
  const float* Importance() const { return this->Arrays.importance->GetPointer(0); }

  /// The scene for the optimisation. HasImportance() must be true.
  SceneFields Scene() const;

  /// Whose base extinction outlives this object's for those who hold it.
  vtkSmartPointer<vtkFloatArray> BaseExtinction() const { return this->Arrays.baseExtinction; }

  /// What casts shadows, if that is less than what the scalars have, because planes cut between
  /// points; else null.
  const float* ShadowCaster() const
  {
    return this->Crop.planes.empty() ? nullptr : this->Arrays.baseExtinction->GetPointer(0);
  }

  /// Grows with every change of the scalars that is more than making them again.
  std::uint64_t DataVersion() const { return this->DataChanges; }

  /// Grows with every change of the scalars to those of another time step.
  std::uint64_t TimeVersion() const { return this->TimeChanges; }

  /// They grow with every change of a part; a change of the scalars changes the scene, too.
  std::uint64_t ScalarsVersion() const { return this->ScalarChanges; }
  std::uint64_t FunctionsVersion() const { return this->FunctionChanges; }
  std::uint64_t ImportanceVersion() const { return this->ImportanceChanges; }
  std::uint64_t SceneVersion() const;

  /// What a user has to know about values that could not be taken as they are; may be nothing.
  std::string Warning() const;

private:
  /// What an array was when it was converted. MTimes are unique, so nothing else has them.
  struct ArrayKey
  {
    vtkMTimeType array = 0;
    vtkMTimeType ghosts = 0;
    vtkMTimeType mapping = 0;
    int component = 0;
    bool onCells = false;
    bool operator==(const ArrayKey& other) const;
  };

  bool AnyRank(bool here) const { return limpid::AnyRank(this->Ranks.get(), here); }
  vtkIdType CountOfAll(vtkIdType here) const;
  bool Owns(const Vec3& index) const;
  vtkImageData* Here(vtkImageData* image) const;
  static ArrayKey KeyOf(vtkImageData* image, const FieldSource& source, vtkMTimeType mapping);
  ValueUnit ChooseUnit(const FieldSource& source, const FunctionRange& functions);
  vtkIdType EmptyScalars(const CropRegion& crop, const float* shares, float* values) const;
  void TakeExtinction(vtkImageData* image, const FieldSource& source, float* scalars);
  void TakeImportance(vtkImageData* here, const FieldSource& source);
  void CorrectImportance(const std::vector<float>& shares);
  void UpdateBaseExtinction();

  std::shared_ptr<const Communicator> Ranks; ///< null: there is one
  std::array<int, 6> WholeExtent{ { 0, -1, 0, -1, 0, -1 } };
  std::optional<SharedVolume> Shared;

  Grid NodeGrid;
  Grid InputGrid;
  ArrayKey ScalarsKey;
  CropRegion Crop;
  ValueUnit Unit;
  FunctionRange UnitFunctions;    ///< that there were when it was chosen
  bool UnitIsOfFunctions = false; ///< whether others make another one
  double Low = 0;                 ///< smallest value of the data
  double High = 0;                ///< largest value of the data
  vtkSmartPointer<vtkFloatArray> ScalarValues;
  std::vector<float> ScalarShares; ///< see Shares
  ArrayKey ExtinctionKey;
  std::optional<float> ArrayUnit; ///< see ArrayExtinction; none: the functions have the extinction
  float ArrayMajorant = 0;        ///< likewise
  vtkIdType InvalidScalars = 0;   ///< or extinctions of the array
  vtkIdType NegativeExtinctions = 0;
  std::uint64_t DataChanges = 0;
  std::optional<double> Time; ///< of the time step; none: the data knows of none
  std::uint64_t TimeChanges = 0;
  std::uint64_t ScalarChanges = 0;

  vtkVolumeProperty* Property = nullptr; // only to tell one from another
  vtkMTimeType PropertyTime = 0;
  std::uint64_t FunctionsScalars = 0; ///< version of the scalars that they were sampled for
  TransferFunctions Tables;
  ExactExtinction Exact;
  float Majorant = 0; ///< of the opacity function, wherever it has it, or of the array [1/length]
  std::uint64_t FunctionChanges = 0;

  ArrayKey ImportanceKey;
  std::uint64_t ImportanceScalars = 0; ///< version of the scalars that it was made for
  SceneArrays Arrays;                  ///< base extinction and importance
  std::uint64_t BaseVersion = 0;       ///< version of the functions that the base was made with
  std::uint64_t ImportanceChanges = 0;
};
}

#endif
