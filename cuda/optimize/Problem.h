// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Problem_h
#define limpid_optimize_Problem_h

#include "optimize/FoundExtinction.h"
#include "optimize/Settings.h"
#include "scene/Grid.h"
#include "scene/NodeValues.h"
#include "scene/RaySource.h"
#include "scene/ScenePiece.h"
#include "scene/Slab.h"
#include "sweep/Occupancy.h"
#include "sweep/RankRegions.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace limpid
{
struct PermutedFields;
struct FieldsOfRanks;

/// What engines keep for all problems of a scene.
struct Resident
{
  std::mutex access;
  std::shared_ptr<void> fields;                   ///< of a type that only the GPU's engine knows
  std::shared_ptr<const PermutedFields> permuted; ///< of the processor's
};

/// What is to be minimised: Eq. (21) for one extinction field. The fields belong to the caller.
struct Problem
{
  Grid grid;
  const float* baseExtinction = nullptr;      ///< [1/length]
  const float* importance = nullptr;          ///< [0, 1]
  const float* nodeImportance = nullptr;      ///< see NodeImportanceOfFilled [0, 1]
  std::shared_ptr<const Occupancy> occupancy; ///< of base extinction and node importance
  std::shared_ptr<Resident> resident;         ///< null: nothing can be kept
  std::shared_ptr<const ScenePiece> piece;    ///< null: the fields have the values of all nodes
  std::shared_ptr<FieldsOfRanks> shared;      ///< null: they have all values
  float majorant = 0;                         ///< upper bound of the extinction [1/length]
  double nearness = 1;                        ///< see CarriedChange::NearnessTo
  const float* previous =
    nullptr; ///< what the extinction is to stay near [1/length]; null: nothing
  RaySource camera;
  std::vector<RaySource> otherCameras; ///< see Settings::otherCameras
  RaySource light;
  bool forLight =
    false; ///< whether the extinction for the light is wanted of a method that has one
  Settings settings;
  bool fine = false;       ///< whether scores and ceilings resolve layers by FineCuts
  bool tellsScores = true; ///< whether iterations see what scores are of, see SeesWhatScoresAreOf

  double NumberOfCameras() const { return 1.0 + double(this->otherCameras.size()); }

  /// p of Eq. (22): the regularisation weight, or what Settings::clearingThreshold makes it.
  double NormalisedRegularization() const;

  /// p of Eq. (22) in world units: the normalised energy times R^2 has p R / 2 (mu - mu-bar)^2.
  double RegularizationWeight() const
  {
    return this->NormalisedRegularization() * this->grid.Radius();
  }

  /// t of Settings::temporalCoherence in world units [length]: with 1, a voxel moves through its
  /// whole range for all visibility. 0 where there is nothing to stay near.
  double CoherenceWeight() const;

  /// Takes fields that ranks share for its own.
  void Use(const std::shared_ptr<FieldsOfRanks>& fields);

  /// What this rank has of work on voxels that needs no rays; all, where no ranks share the
  /// problem.
  Slab OwnSlab() const;

  /// The sum of what ofRow(y, z) says of all rows of voxels, of all ranks, see SumOverRows.
  double SumOverRows(const std::function<double(int y, int z)>& ofRow) const;

  /// Sum over all voxels of (mu - other)^2, where `other` differs from the base extinction in
  /// filled voxels only [1/length^2].
  double SquaresFrom(const float* other, const float* extinction) const;

  /// Whether the volume is so small that it may take as long as one of 44^3 voxels.
  bool IsSmall() const;

  /// Whether a sweep may meet layers that it resolves for their depth, see UsualCuts.
  bool MayHaveThickLayers() const;

  /// Whether an extinction within its bounds can stop so much light from one node to the next that
  /// the sign of a derivative at a node does not tell what is best there: policy sweeps are
  /// followed by resilient steps then (Documentation/Method.md, section on thick media).
  bool IsThick() const;

  /// Edge of a cube of the same volume as a cell [length].
  double NodeDistance() const;

  /// Optical depth of the majorant over that distance, from node to node.
  double MostNodeDepth() const;

  /// sigma of SmoothedChange in world units [length]: with smoothness 1, neighbours move a voxel
  /// through its whole range as all visibility does.
  double SmoothingStrength() const;

  /// 1/2 weight sum (mu - other)^2 dx [length^2], from that sum: F_p of Eq. (22) in world units
  /// with the weight of the regularisation and the base extinction.
  double Regularization(double weight, double squares) const;

  /// Moves an extinction into its bounds, see ExtinctionBounds, and to 0 where the scene is empty.
  void TakeIntoBounds(std::vector<float>& extinction) const;

  /// The lower bound of the extinction, of this rank's piece where ranks share the scene, see
  /// ExtinctionBounds [1/length]; empty: 0.
  NodeValues LeastExtinction() const;

  /// Copies an extinction where the scene is filled.
  void CopyFilled(const float* from, float* to) const;

  /// Mean change over the voxels that may change [majorant], from the sum of all changes.
  double MeanChange(double changes) const;

private:
  /// Weight of a squared difference of extinctions that moves a voxel through its whole range where
  /// that share of the visibility terms is at stake [length].
  double WeightOfRange(double share) const;
};

/// What iterations start from, one value per node, of this rank's slab where ranks share the
/// problem [1/length]; not there: the base extinction.
using StartingExtinction = std::optional<std::vector<float>>;

/// An iterative method for a problem.
class Minimizer
{
public:
  virtual ~Minimizer() = default;

  /// One more iteration. Returns its record; `seconds` and `iteration` are the caller's business.
  virtual IterationRecord Iterate() = 0;

  /// The record of the extinction that the iterations start from; to be called first.
  virtual IterationRecord Start() = 0;

  /// What the camera sees of the base extinction; 0 without a term of its own.
  virtual Score BaseScore() const = 0;

  /// A sweep that draws the changes of neighbours together, see SmoothedChange, from the best
  /// iterate so far; the result is the best then. Nothing but this may follow.
  virtual IterationRecord Smooth() = 0;

  /// Whether another iteration can still gain something.
  virtual bool Converged() const = 0;

  /// Whether what iterations still gain, sweeps that smooth gain as well.
  virtual bool IsNear() const { return this->Converged(); }

  virtual int IterationLimit() const = 0;

  /// Best iterate so far [1/length].
  virtual const std::vector<float>& Best() const = 0;

  /// Its values, which may be there without a copy; until the next iteration.
  virtual const float* BestValues() const { return this->Best().data(); }

  /// Brings the best iterate so far to the pieces of the ranks that share the problem
  /// (Problem::shared).
  virtual void BestToPiece(const FieldView&) const {}

  /// The best iterate so far on the device that computes, until the next iteration; nulls: it is on
  /// the host.
  virtual ExtinctionOnDevice BestOnDevice() const { return {}; }

  /// The same, given away: nothing else can be asked any more.
  virtual std::vector<float> TakeBest() = 0;

  /// The same where it is.
  virtual FoundExtinction TakeResult() { return this->TakeBest(); }
};
}

#endif
