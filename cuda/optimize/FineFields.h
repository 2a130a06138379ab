// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_FineFields_h
#define limpid_optimize_FineFields_h

#include "optimize/CarriedChange.h"
#include "optimize/CoarseFields.h"
#include "optimize/ExtinctionBounds.h"
#include "scene/AxisFilter.h"
#include "scene/NodeValues.h"
#include "scene/Occupancy.h"
#include "sweep/MadeFields.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace limpid
{
/// The fields of a scene at the resolution of the data, made box by box for a sweep that starts
/// from a change on a coarser grid. The importance is that which the optimisation sees, see
/// ImportanceSmoothing.
class FineFields : public MadeFields
{
public:
  /// `ofBox` and `change` must outlive it. `majorant`: upper bound of the extinction [1/length].
  FineFields(
    const Grid& data, const FieldsOfBox& ofBox, const CarriedChange& change, float majorant);

  // What stands for the fields:
  const float* Base() const { return this->Name(Field::Base); }   ///< [1/length]
  const float* Given() const { return this->Name(Field::Given); } ///< importance of scores [0, 1]
  const float* Importance() const { return this->Name(Field::Importance); }         ///< [0, 1]
  const float* NodeImportance() const { return this->Name(Field::NodeImportance); } ///< [0, 1]

  /// The extinction that results from the change, within its bounds [1/length].
  const float* Changed() const { return this->Name(Field::Changed); }

  /// The lower bound of the extinction, see ExtinctionBounds [1/length].
  const float* Least() const { return this->Name(Field::Least); }

  /// `derivative` minus the pull of neighbours upon the changed extinction, see SmoothedNode;
  /// `derivative` has all nodes and is 0 if it is null.
  const float* Pulled() const { return this->Name(Field::Pulled); }
  void SetPull(const float* derivative, double strength);

  /// Surveys the scene, before anything else. Finds where it is not empty, for the importance that
  /// the optimisation sees and for that of scores.
  void Survey();
  const std::shared_ptr<const Occupancy>& Occupied() const { return this->Seen; }
  const std::shared_ptr<const Occupancy>& OccupiedByGiven() const { return this->OfGiven; }

  /// Writes one of the fields at all nodes.
  void Fill(const float* field, float* values);

  bool Has(const float* field) const override;
  void MoveTo(const NodeBox& box, const std::vector<const float*>& fields) override;
  FieldView Values(const float* field) override;

private:
  enum class Field
  {
    Base,
    Given,
    Importance,
    NodeImportance,
    NodeImportanceOfGiven,
    Changed,
    Pulled,
    Least,
    Count
  };

  const float* Name(Field field) const { return &this->Names[std::size_t(field)]; }
  std::vector<float>& Of(Field field) { return this->Made[std::size_t(field)]; }

  template <class What>
  void ForLayers(const std::vector<const float*>& fields, const What& what);

  void FindImportance(const Grid& here);
  void RecallImportance();
  std::uint8_t NeighborTaken(int x, int y, int z);
  void FindNodeImportance(const Grid& here, const std::vector<float>& importance, Field result);
  void FindChanged();
  void FindPulled();
  void FindLeast();
  bool Despeckles() const;

  Grid Data;
  const FieldsOfBox* OfBox;
  const CarriedChange* Change;
  GridFilter Filter;
  ChangedNode ChangeAt;
  ExtinctionBounds<float> Bounds;
  const float* Derivative = nullptr;
  float PullStrength = 0;
  /// [node]: the neighbour whose importance the node takes when it is despeckled (Neighbor), which
  /// takes longer to find than all else; empty: not known yet, or nothing is despeckled.
  std::vector<std::uint8_t> Taken;
  NodeBox Here; ///< of the values
  std::array<float, std::size_t(Field::Count)> Names{};
  std::array<std::vector<float>, std::size_t(Field::Count)> Made;
  std::shared_ptr<const Occupancy> Seen;
  std::shared_ptr<const Occupancy> OfGiven;
};
}

#endif
