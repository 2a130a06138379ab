// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The data of a volume in the core's form: the fields of an image and the functions of a property.
// Each part is computed again only if its sources have changed.

#ifndef limpid_VolumeData_h
#define limpid_VolumeData_h

#include "ArrayExtinction.h"
#include "ControlFields.h"
#include "CropRegion.h"
#include "SceneConversion.h"
#include "SharedVolume.h"
#include "TransferTables.h"

#include "optimize/Solver.h"
#include "render/Renderer.h"
#include "scene/Structures.h"

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
  /// Sets the processes that share the image, with its whole extent; null: this process has all of
  /// it.
  void ShareAmong(std::shared_ptr<const Communicator> ranks, const std::array<int, 6>& wholeExtent);

  /// Updates the scalar field and, if it comes from an array, the base extinction; a null array:
  /// the functions define it. Throws if the image or an array cannot be used. `property`: its
  /// functions define which values matter if some are huge.
  void UpdateScalars(vtkImageData* image, const FieldSource& source, const FieldSource& extinction,
    const CropRegion& crop, vtkVolumeProperty* property);

  /// Updates the transfer functions for the present scalars. Throws if they are invalid.
  void UpdateFunctions(vtkVolumeProperty* property);

  /// Updates the reference extinctions at the points of the image. `sources`: see
  /// ReferenceSources.
  void UpdateReferences(vtkImageData* image, const std::vector<FieldSource>& sources);

  /// Updates the importance at the points of the image and, after everything else, the scene of the
  /// optimisation on the grid that settings ask for. A null array: there is no importance.
  /// `functionTime`: modification time of the source's mapping; `drawn`: whether pictures need the
  /// importance, too. If ranks share the image, all give the structures of the source, even those
  /// without points.
  void UpdateImportance(vtkImageData* image, const FieldSource& source, vtkMTimeType functionTime,
    const Settings& settings, bool drawn);

  /// Frees memory. What is computed again for the same sources keeps its version.
  void Release();

  /// Returns the part of the volume that is here; alone, a process has the whole.
  const DrawnPart& Drawn() const { return this->Part; }
  const Grid& Nodes() const { return this->Part.Nodes(); }
  const Grid& Whole() const { return this->Part.Whole(); }

  ScalarNodes Scalars() const; ///< NaN: empty
  const CropRegion& Cropped() const { return this->Crop; }

  /// Returns the share of the functions' extinction that is kept at each point [0, 1]; null:
  /// everything is kept.
  const float* Shares() const
  {
    return this->ScalarShares.empty() ? nullptr : this->ScalarShares.data();
  }

  const TransferFunctions& Functions() const { return this->Tables; }
  bool HasImportance() const { return this->IsImportant; }

  /// Returns the importance at each point [0, 1]. Requires HasImportance(), and that pictures need
  /// it.
  const float* Importance() const { return this->Arrays.importance->GetPointer(0); }

  /// Returns the structures that the importance is that of; null: there are none.
  const Structures* Labelled() const { return this->LabelledParts.get(); }

  /// Returns the row of the structure at each point. Requires Labelled().
  const StructureRow* StructureRows() const { return this->Arrays.structureRows->GetPointer(0); }

  /// Returns the scene of the optimisation: on the control grid, which may be that of the data.
  /// Requires HasImportance().
  SceneFields Scene() const;

  /// Returns the part of that grid that is here.
  const DrawnPart& ScenePart() const
  {
    return this->Control.IsThere() ? this->Control.Part() : this->Part;
  }

  /// Returns the row of the structure at each of its nodes. Requires Labelled().
  const StructureRow* SceneRows() const
  {
    return this->Control.IsThere() ? this->Control.Rows() : this->StructureRows();
  }

  /// Returns the resolution of that grid.
  const ControlGrid& SceneResolution() const { return this->Control.Chosen(); }

  /// Returns what owns the scene, which may outlive this object.
  std::shared_ptr<const void> SceneOwner() const;

  /// Returns the extinction that casts shadows, if it is less than that of the scalars because
  /// planes cut between points; else null.
  const float* ShadowCaster() const
  {
    return this->Crop.planes.empty() ? nullptr : this->Arrays.baseExtinction->GetPointer(0);
  }

  /// Returns a number that grows with every change of the scalars' values.
  std::uint64_t DataVersion() const { return this->DataChanges; }

  /// Returns a number that grows if the scalars change to another time step.
  std::uint64_t TimeVersion() const { return this->TimeChanges; }

  /// Numbers that grow with every change of a part; a change of any also changes the scene. That of
  /// the importance also grows when the field is made again.
  std::uint64_t ScalarsVersion() const { return this->ScalarChanges; }
  std::uint64_t FunctionsVersion() const { return this->FunctionChanges; }
  std::uint64_t ImportanceVersion() const { return this->ImportanceFields; }
  std::uint64_t SceneVersion() const;

  /// Returns a warning about values that were not used as they are; may be empty.
  std::string Warning() const;

private:
  /// Identifies the state of an array that was converted. MTimes are unique.
  struct ArrayKey
  {
    vtkMTimeType array = 0;
    vtkMTimeType ghosts = 0;
    vtkMTimeType mapping = 0;
    int component = 0;
    bool onCells = false;
    bool operator==(const ArrayKey& other) const;
  };

  bool AnyRank(bool here) const { return this->Ranks->AnyOf(here); }
  vtkIdType SumOverRanks(vtkIdType here) const;
  bool Owns(const Vec3& index) const;
  vtkImageData* Here(vtkImageData* image) const;
  static ArrayKey KeyOf(vtkImageData* image, const FieldSource& source, vtkMTimeType mapping);
  ValueUnit ChooseUnit(const FieldSource& source, const FunctionRange& functions);
  bool ReadsInPlace(
    const FieldSource& source, const FieldSource& extinction, const CropRegion& crop) const;
  vtkSmartPointer<vtkFloatArray> ConvertScalars(vtkImageData* here, const FieldSource& source,
    const FieldSource& extinction, const CropRegion& crop);
  vtkIdType EmptyScalars(const CropRegion& crop, const float* shares, float* values) const;
  void TakeExtinction(vtkImageData* image, const FieldSource& source, float* scalars);
  void TakeImportance(vtkImageData* here, const FieldSource& source);
  void CorrectImportance(const std::vector<float>& shares);
  void UpdateScene(bool coarser, ImportanceSmoothing smoothing, bool drawn);
  void UpdateBaseExtinction();
  void FillBaseExtinction(const Range<int>& layers, float* base) const;
  void MakeControlFields(ImportanceSmoothing smoothing);
  SceneFields DataScene() const;
  std::uint64_t DataSceneVersion() const;

  std::shared_ptr<const Communicator> Ranks = ThisProcess();
  std::array<int, 6> WholeExtent{ { 0, -1, 0, -1, 0, -1 } };
  std::optional<SharedVolume> Shared;

  DrawnPart Part;
  Grid InputGrid;
  ArrayKey ScalarsKey;
  CropRegion Crop;
  ValueUnit Unit;
  FunctionRange UnitFunctions;                ///< at the time when the unit was chosen
  bool UnitIsOfFunctions = false;             ///< whether other functions would change the unit
  double Low = 0;                             ///< smallest value of the data
  double High = 0;                            ///< largest value of the data
  vtkSmartPointer<vtkDataArray> ScalarValues; ///< the array of the image where that is possible
  bool HasOwnScalars = false;                 ///< whether it is not
  bool IsReleased = false;                    ///< whether the scalars were, and are not there again
  std::vector<float> ScalarShares;            ///< see Shares
  ArrayKey ExtinctionKey;
  std::optional<float> ArrayUnit; ///< see ArrayExtinction; none: the functions define the
                                  ///< extinction
  float ArrayMajorant = 0;        ///< see ArrayExtinction
  vtkIdType InvalidScalars = 0;   ///< points whose scalar or extinction is invalid
  vtkIdType NegativeExtinctions = 0;
  std::uint64_t DataChanges = 0;
  std::optional<double> Time; ///< of the data; none: the data have no time
  std::uint64_t TimeChanges = 0;
  std::uint64_t ScalarChanges = 0;

  vtkVolumeProperty* Property = nullptr; // only compared, to detect another property
  vtkMTimeType PropertyTime = 0;
  std::uint64_t FunctionsScalars = 0; ///< version of the scalars they were sampled for
  TransferFunctions Tables;
  ExactExtinction Exact;
  float Majorant = 0; ///< largest extinction of the opacity function or of the array [1/length]
  std::uint64_t FunctionChanges = 0;

  References Given;
  std::vector<ArrayKey> ReferenceKeys;
  std::uint64_t ReferenceScalars = 0; ///< version of the scalars they were computed for
  std::uint64_t ReferenceChanges = 0;
  ArrayKey ImportanceKey;
  std::uint64_t ImportanceScalars = 0; ///< version of the scalars it was computed for
  bool IsImportant = false;
  SceneArrays Arrays;    ///< base extinction and importance; null where only other grids need them
  ControlFields Control; ///< there if the optimisation has another grid
  std::shared_ptr<const Structures> LabelledParts; ///< see Labelled
  std::uint64_t BaseVersion = 0; ///< version of the functions the base was computed with
  std::uint64_t ImportanceChanges = 0;
  std::uint64_t ImportanceFields = 0; ///< how often the importance was taken
};
}

#endif
