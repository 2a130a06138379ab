// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Problem_h
#define limpid_optimize_Problem_h

#include "distributed/DistributedFields.h"
#include "optimize/FoundExtinction.h"
#include "optimize/Pulls.h"
#include "optimize/Settings.h"
#include "scene/FieldView.h"
#include "scene/Grid.h"
#include "scene/NodeValues.h"
#include "scene/Occupancy.h"
#include "scene/RaySource.h"
#include "scene/Slab.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace limpid
{
struct PermutedFields;

/// Data that solvers cache for all problems of a scene.
struct Resident
{
  ResidentCopy fields; ///< ProblemFields of a GPU
  std::mutex access;
  std::shared_ptr<const PermutedFields> permuted; ///< cached by the processor's solver
};

/// What looks at the volume in a visibility term of the energy: Eq. (23) or (24).
enum class SourceKind
{
  Camera,
  Light
};

/// The source of a visibility term.
struct TermSource
{
  SourceKind kind;
  RaySource rays;
};

/// Returns the sources of all visibility terms: the camera, the other cameras of the settings, and
/// the light.
std::vector<TermSource> SourcesOf(
  const Camera& camera, const Light& light, const Settings& settings, const Grid& grid);

/// Fields derived from a scene, which live as long as someone uses them; null: not made.
struct DerivedFields
{
  std::shared_ptr<const NodeValues> importance;     ///< see Despeckle [0, 1]
  std::shared_ptr<const NodeValues> nodeImportance; ///< see NodeImportanceOfFilled [0, 1]
};

/// The minimisation problem: Eq. (21) for one extinction field. The caller owns the fields.
struct Problem
{
  Grid grid;
  const float* baseExtinction = nullptr;      ///< [1/length]
  const float* importance = nullptr;          ///< [0, 1]
  const float* nodeImportance = nullptr;      ///< see NodeImportanceOfFilled [0, 1]; may be null
                                              ///< where only scores and ceilings are computed
  std::shared_ptr<const Occupancy> occupancy; ///< of base extinction and node importance
  std::shared_ptr<Resident> resident;         ///< null if nothing can be cached
  DerivedFields derived;                      ///< owners of both importances, if they have one
  /// The distribution of the fields, see Use.
  std::shared_ptr<const DistributedFields> shared = std::make_shared<const DistributedFields>();
  float majorant = 0;              ///< upper bound of the extinction [1/length]
  std::vector<Pull> furtherPulls;  ///< beside the regularisation
  std::vector<TermSource> sources; ///< of the visibility terms, see SourcesOf
  bool forLight =
    false; ///< whether a method that distinguishes them should compute the extinction for the light
  Settings settings;
  bool fine = false;           ///< whether scores and ceilings resolve layers by FineCuts
  bool tellsScores = true;     ///< whether iterations measure scores, see SeesWhatScoresAreOf
  bool isMeasuredOnly = false; ///< whether there are no iterations: other axes would not pay

  const RaySource& Camera() const { return this->sources.front().rays; } ///< the main camera
  const RaySource& Light() const { return this->sources.back().rays; }
  double NumberOfCameras() const { return double(this->sources.size()) - 1.0; }

  /// Weight of a source's term: q of Eq. (23), shared by all cameras, or r of Eq. (24).
  double WeightOf(const TermSource& source) const;

  /// p of Eq. (22): the regularisation weight, or its value from Settings::clearingThreshold.
  double NormalisedRegularization() const;

  /// p of Eq. (22) in world units: the normalised energy times R^2 has p R / 2 (mu - mu-bar)^2.
  double RegularizationWeight() const
  {
    return this->NormalisedRegularization() * this->grid.Radius();
  }

  /// Returns all pulls: first the regularisation, which pulls to the base extinction.
  std::vector<Pull> Pulls() const;

  /// Sets the further pulls. `pulls` must outlive their use.
  void DrawTo(
    const std::vector<PullWithReferences>& pulls, bool forTheLight, bool onDevice = false);

  /// Lets go of both importances. It can then only be asked for what does not need them.
  void DropImportance()
  {
    this->importance = this->nodeImportance = nullptr;
    this->derived = {};
  }

  /// Replaces the fields by distributed ones.
  void Use(const std::shared_ptr<const DistributedFields>& fields);

  /// Returns the slab in which this process does work on voxels that needs no rays.
  Slab OwnSlab() const;

  /// Sums over all processes that share the fields.
  void SumOverAll(ExactSum* sums, std::size_t count) const;

  /// Sums ofRow(y, z) over all rows of voxels. The result is bit-identical for any number of
  /// threads and processes.
  double SumOverRows(const std::function<double(int y, int z)>& ofRow) const;

  /// Redistributes a field, given in the owned slab, to the subdomain (DistributedFields::wanted).
  void SlabToPiece(const float* values, const FieldView& piece) const;

  /// Returns the sum over all voxels of (mu - other)^2, where `other` differs from the base
  /// extinction in filled voxels only [1/length^2].
  double SquaresFrom(const float* other, const float* extinction) const;

  /// Whether the volume has fewer than 44^3 nodes, so that extra rays and iterations cost little.
  bool IsSmall() const;

  /// Whether a sweep may meet layers that it resolves because of their optical depth, see
  /// UsualCuts.
  bool MayHaveThickLayers() const;

  /// Whether the sweep of a source may.
  bool MayHaveThickLayers(const RaySource& source) const;

  /// Whether an extinction within its bounds can stop much of the light between two nodes. The
  /// sign of the derivative at a node then does not tell what is best, and policy sweeps are
  /// followed by resilient steps (Documentation/Method.md, section on thick media).
  bool IsThick() const;

  /// Edge length of a cube with the volume of a cell [length].
  double NodeDistance() const;

  /// Optical depth of the majorant over NodeDistance().
  double MostNodeDepth() const;

  /// sigma of SmoothedChange in world units [length]. With smoothness 1, neighbours pull a voxel
  /// through its whole range as strongly as all visibility does.
  double SmoothingStrength() const;

  /// Returns the energy of a pull, 1/2 weight sum (mu - reference)^2 dx [length^2], given the sum.
  /// That of the regularisation is F_p of Eq. (22) in world units.
  double EnergyOf(const Pull& pull, double squares) const;

  /// Clamps an extinction to its bounds, see ExtinctionBounds, and sets it to 0 where the scene is
  /// empty.
  void TakeIntoBounds(std::vector<float>& extinction) const;

  /// Returns the mean change of voxels that may change [majorant], given the sum of all changes.
  double MeanChange(double changes) const;

private:
  /// Returns the weight of a pull at which moving a voxel through its whole range costs the given
  /// share of the visibility terms [length].
  double WeightOfRange(double share) const;
};

/// The start of iterations, one value per node of Problem::OwnSlab [1/length]; empty for the base
/// extinction.
using StartingExtinction = std::optional<std::vector<float>>;

/// An iterative method for a problem.
class Minimizer
{
public:
  virtual ~Minimizer() = default;

  /// Performs an iteration and returns its record; the caller sets `seconds` and `iteration`.
  virtual IterationRecord Iterate() = 0;

  /// Returns the record of the starting extinction. Call it first.
  virtual IterationRecord Start() = 0;

  /// Returns the score of the base extinction from the camera; 0 if the method has no camera term.
  virtual Score BaseScore() const = 0;

  /// Performs a sweep from the best iterate that smooths changes between neighbours, see
  /// SmoothedChange. Its result becomes the best iterate. After it, only further calls of Smooth
  /// are allowed.
  virtual IterationRecord Smooth() = 0;

  /// Whether further iterations would gain nothing.
  virtual bool Converged() const = 0;

  /// Whether smoothing sweeps would gain as much as further iterations.
  virtual bool IsNear() const { return this->Converged(); }

  virtual int IterationLimit() const = 0;

  /// Returns the best iterate so far [1/length].
  virtual const std::vector<float>& Best() const = 0;

  /// Returns the values of Best(), possibly without a copy; valid until the next iteration.
  virtual const float* BestValues() const { return this->Best().data(); }

  /// Redistributes the best iterate to the subdomains (DistributedFields::wanted).
  virtual void BestToPiece(const FieldView&) const {}

  /// Returns the best iterate on the computing device, valid until the next iteration; null
  /// pointers if it is on the host.
  virtual ExtinctionOnDevice BestOnDevice() const { return {}; }

  /// Returns the best iterate where it can be read without a transfer; valid until the next
  /// iteration.
  ExtinctionInPlace BestInPlace() const
  {
    const ExtinctionOnDevice there = this->BestOnDevice();
    return there.extinction ? ExtinctionInPlace(there) : this->BestValues();
  }

  /// Whether it has copies of the problem's fields, which nothing it does needs any more.
  virtual bool HasOwnFields() const { return false; }

  /// Frees what only further iterations need. Afterwards, only the best iterate can be requested.
  virtual void KeepOnlyBest() {}

  /// Moves the best iterate out; this object must not be used afterwards.
  virtual std::vector<float> TakeBest() = 0;

  /// Moves the best iterate out without a transfer from its device.
  virtual FoundExtinction TakeResult() { return this->TakeBest(); }
};
}

#endif
