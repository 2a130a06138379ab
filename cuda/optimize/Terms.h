// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Terms_h
#define limpid_optimize_Terms_h

#include "energy/VisibilityTerm.h"
#include "optimize/Differences.h"
#include "optimize/FieldDistribution.h"
#include "optimize/ProblemFields.h"

#include <deque>
#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
/// The sums from which energy and score of an extinction follow, one per visibility term.
struct TermSums
{
  Seen seen;         ///< by the term's source; for a light, kept base extinction is not counted
  Differences moved; ///< distances from the references of pulls and from the last iterate; with the
                     ///< first term
};

/// A visibility term of the energy, with its weight in it.
template <class AnyDevice>
class EnergyTerm : public VisibilityTerm<AnyDevice>
{
public:
  EnergyTerm(const std::shared_ptr<AnyDevice>& device, const Problem& problem,
    const TermSource& source, std::size_t number)
    : VisibilityTerm<AnyDevice>(
        device, problem.grid, *problem.occupancy, source.rays, problem.settings.rayDensity)
    , Source(&source)
    , Share(problem.WeightOf(source))
    , Position(number)
  {
  }

  /// Whether it is a camera's, for which kept base extinction is counted.
  bool IsOfCamera() const { return this->Source->kind == SourceKind::Camera; }

  const RaySource& Rays() const { return this->Source->rays; }
  double Weight() const { return this->Share; }         ///< see Problem::WeightOf
  std::size_t Number() const { return this->Position; } ///< in Terms::all

private:
  const TermSource* Source;
  double Share;
  std::size_t Position;
};

/// The visibility terms of a problem's energy, one per camera and one for the light. Terms of
/// weight zero are omitted and cost nothing. Fields are device addresses, one value per node each.
template <class AnyDevice>
class Terms
{
public:
  using Term = EnergyTerm<AnyDevice>;

  Terms(std::shared_ptr<AnyDevice> device, const Problem& problem);

  /// Sweeps the base extinction once for all cameras, if iterations record scores, which are
  /// relative to it. Waits.
  void SeeBase();

  /// Returns energy and score of an extinction, after SeeBase. Leaves the optical depths of all
  /// rays in the terms.
  IterationRecord Measure(const float* extinction);

  /// Measures the base extinction, including SeeBase; before any other extinction is measured.
  IterationRecord MeasureBase();

  /// Score of the base extinction, after SeeBase; 0 if iterations do not record scores.
  Score BaseScore() const;

  /// The fields of a term's sweep. Kept base extinction matters to scores only.
  TermFields FieldsOf(const Term& term, const float* extinction) const;

  /// Computes the derivative of the weighted visibility terms, Eqs. (27) and (28), in the owned
  /// slab. Also measures the extinction for the next record.
  void Differentiate(const float* extinction, float* gradient);

  /// Computes `kept` times `gradient` plus the weighted derivative of one visibility term. Also
  /// measures the extinction for the next record. Only voxels that the term depends on are
  /// written, the same ones each time.
  void DifferentiateTerm(Term& term, const float* extinction, float kept, float* gradient);

  /// DifferentiateTerm for an extinction that the term's rays have met in their last sweep.
  void DifferentiateSeen(Term& term, const float* extinction, float kept, float* gradient);

  /// Measures the extinction for the next record like DifferentiateTerm, and leaves the optical
  /// depths of the term's rays.
  void MeasureTerm(Term& term, const float* extinction);

  /// Includes the last sweep of a term's rays in the next record.
  void TakeSeen(Term& term, Kept kept);

  /// Includes the policy sweep of a term from `last` to `next`, and redistributes `next`. `moved`:
  /// see SweepPolicy.
  void TakeSwept(Term& swept, Kept kept, ExactDifferences& moved, const float* last, float* next);

  /// Includes the distances of an extinction from all references and, if not null, from `last`.
  void TakeMoved(const float* extinction, const float* last);

  /// Sums the magnitudes of changes immediately, for the next record.
  void SumChanges(const float* changes);

  /// Returns energy and score of the extinction that all terms have measured, Eqs. (21)-(24) and
  /// (32), after SeeBase. Waits.
  IterationRecord Record();

  /// Mean change of the extinction in the next record [majorant]. Waits.
  double MeanChange()
  {
    this->Sum();
    return this->Given->MeanChange(this->ReadSums().front().moved.changes);
  }

  /// The distances of the next record, on the device.
  Differences* Moved() { return &this->Found.Data()->moved; }

  const ProblemFields<AnyDevice>& Fields() const { return *this->Scene; }

  /// The distribution of the fields.
  const DistributionOn<AnyDevice>& Distribution() const { return this->Shared; }

  /// Uploads an extinction, given in the owned slab, and redistributes it to all that need it.
  DeviceArray<AnyDevice, float> Everywhere(const std::vector<float>& extinction) const;

  /// All pulls of the problem, with references on the device.
  const std::vector<Pull>& Pulls() const { return this->Drawn.All(); }

  const std::shared_ptr<ProblemFields<AnyDevice>>& SharedFields() const { return this->Scene; }

  std::deque<Term> all; ///< those of cameras first, at fixed addresses

private:
  /// What the next record includes but was not summed yet.
  struct Taken
  {
    struct OfTerm
    {
      Term* term;
      Kept kept;
    };
    std::vector<OfTerm> seen;
    const float* extinction = nullptr; ///< null: nothing was moved
    const float* last = nullptr;
  };

  /// Sums what was included, on a device in one launch.
  void Sum();
  template <std::size_t... Numbers>
  void SumOnGpu(const Taken& taken, std::index_sequence<Numbers...> numbersOfPulls);

  /// Returns the sums of all terms, at least one. Waits.
  std::vector<TermSums> ReadSums() const;

  /// Address of the sum over a term's rays, on the device.
  Seen* SumOf(const Term& term) { return &this->Found.Data()[term.Number()].seen; }

  /// Computes the derivative of one visibility term.
  void DifferentiateOne(
    Term& term, const float* extinction, const GradientTarget& target, float* gradient);

  const Problem* Given;
  std::shared_ptr<AnyDevice> Device;
  std::shared_ptr<ProblemFields<AnyDevice>> Scene;
  PullsOnDevice<AnyDevice> Drawn;
  DistributionOn<AnyDevice> Shared;
  SumOnDevice<AnyDevice> Add;
  DeviceArray<AnyDevice, TermSums> Found;
  Taken Unsummed;
  std::vector<Visible> Base; ///< [camera]; empty before SeeBase or if iterations record no scores
};
}

#endif
