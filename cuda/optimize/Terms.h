// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Terms_h
#define limpid_optimize_Terms_h

#include "energy/VisibilityTerm.h"
#include "optimize/Differences.h"
#include "optimize/ProblemFields.h"
#include "optimize/TermsOnRanks.h"

#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace limpid
{
/// What an extinction is worth; zero where there is no such term.
struct TermSums
{
  Seen camera;       ///< the first
  Seen light;        ///< what is kept does not matter
  Differences moved; ///< from the base extinction and from the last iterate
};

/// The terms of a problem's energy, of each camera and the light; a visibility term of weight zero
/// is not there and costs nothing. Fields are addresses on the device, one value per node each.
template <class AnyDevice>
class Terms
{
public:
  Terms(std::shared_ptr<AnyDevice> device, const Problem& problem);

  /// Lets the cameras see the base extinction, of which scores are shares, once, if iterations tell
  /// scores. Waits.
  void SeeBase();

  /// The energy and the score of an extinction, once the base was seen; leaves the optical depths
  /// of all rays in the terms.
  IterationRecord Measure(const float* extinction);

  /// The same of the base extinction, seen on the way; before any other extinction is seen.
  IterationRecord MeasureBase();

  /// Of the base extinction, once it was seen; 0 where iterations do not tell scores.
  Score BaseScore() const;

  /// The fields of a term's sweep. What is kept matters to scores alone.
  TermFields FieldsOf(const VisibilityTerm<AnyDevice>& term, const float* extinction) const;

  /// Adds the derivative of the visibility terms, Eqs. (27) and (28) with their weights, to zeros,
  /// and sees the extinction for the next record along the way. Ranks have it in their slabs, and
  /// need no zeros.
  void Differentiate(const float* extinction, float* gradient);

  /// Differentiate, in place of what `gradient` has.
  void FillGradient(const float* extinction, DeviceArray<AnyDevice, float>& gradient);

  /// Where ranks share the problem, brings the derivative that a term was added to last to those
  /// who add another one, or into slabs. `from`: null: none was added; `to`: null: slabs.
  void Pass(float* derivative, const VisibilityTerm<AnyDevice>* from,
    const VisibilityTerm<AnyDevice>* to) const;

  /// Finds the derivative of one visibility term with its weight, added to `kept` times what was
  /// there, and sees the extinction for the next record along the way. Only voxels that it depends
  /// on are written, always the same ones.
  void DifferentiateTerm(
    VisibilityTerm<AnyDevice>& term, const float* extinction, float kept, float* gradient);

  /// The derivative of DifferentiateTerm by an extinction that the term's rays have seen last.
  void DifferentiateSeen(
    VisibilityTerm<AnyDevice>& term, const float* extinction, float kept, float* gradient);

  /// Sees the extinction for the next record as DifferentiateTerm does, and leaves the optical
  /// depths of the term's rays.
  void MeasureTerm(VisibilityTerm<AnyDevice>& term, const float* extinction);

  /// q of Eq. (23), shared by all cameras, or r of Eq. (24).
  double WeightOf(const VisibilityTerm<AnyDevice>& term) const;

  /// Whether a term is a camera's, to which it matters what is kept of the base extinction.
  bool IsOfCamera(const VisibilityTerm<AnyDevice>& term) const
  {
    return !this->light || &term != &*this->light;
  }

  /// The next record is to tell what a term's rays have seen in their last sweep until then.
  void TakeSeen(VisibilityTerm<AnyDevice>& term, Kept kept);

  /// ... how far an extinction is from the base and, if not null, from `last`.
  void TakeMoved(const float* extinction, const float* last);

  /// Sums the sizes of changes at once, for the next record.
  void SumChanges(const float* changes);

  /// Energy and score of the extinction that all terms have seen, Eqs. (21)-(24) and (32), once the
  /// base was seen. Waits.
  IterationRecord Record();

  /// Mean change of the extinction, of the next record [majorant]. Waits.
  double MeanChange()
  {
    this->Sum();
    return this->Given->MeanChange(this->ReadSums().moved.changes);
  }

  /// The sums of the next record, on the device.
  TermSums* Sums() { return this->Found.Data(); }

  const ProblemFields<AnyDevice>& Fields() const { return *this->Scene; }

  /// Where the ranks that share the problem have the fields; null: there is one.
  const TermsOnRanks* OnRanks() const { return this->Shared.get(); }

  /// An extinction on the device, of this rank's slab where ranks share the problem: these have it
  /// wherever they need it then.
  DeviceArray<AnyDevice, float> Everywhere(const std::vector<float>& extinction) const;

  /// Brings what ranks have changed of an extinction in their slabs to all who need it.
  void ShareSlabs(float* extinction) const;

  /// What the extinction is to stay near; null: nothing.
  const float* Previous() const { return this->Before.Empty() ? nullptr : this->Before.Data(); }
  const std::shared_ptr<ProblemFields<AnyDevice>>& SharedFields() const { return this->Scene; }

  std::deque<VisibilityTerm<AnyDevice>> cameras; ///< where they stay; none without a weight
  std::optional<VisibilityTerm<AnyDevice>> light;

  /// All of them.
  std::vector<VisibilityTerm<AnyDevice>*> All();

private:
  /// What was taken for the next record and is not summed yet.
  struct Taken
  {
    struct OfTerm
    {
      VisibilityTerm<AnyDevice>* term;
      Kept kept;
    };
    std::vector<OfTerm> seen;
    const float* extinction = nullptr; ///< null: nothing was moved
    const float* last = nullptr;
  };

  /// Sums what was taken; a device does it in one launch.
  void Sum();

  /// The sums. Wait.
  TermSums ReadSums();
  std::vector<Seen> ReadCameras(const TermSums& sums);

  /// Where what a term's rays have seen is summed, on the device.
  Seen* SumOf(const VisibilityTerm<AnyDevice>& term);

  /// Brings the fields of the problem to the ranks that share it.
  void ShareFields();

  /// The derivative of a visibility term by an extinction.
  void DifferentiateOne(VisibilityTerm<AnyDevice>& term, const float* extinction,
    const GradientTarget& target, float* gradient);

  const Problem* Given;
  std::shared_ptr<AnyDevice> Device;
  std::shared_ptr<ProblemFields<AnyDevice>> Scene;
  BorrowedArray<AnyDevice, float> Before;     ///< see Problem::previous; empty: null
  std::unique_ptr<const TermsOnRanks> Shared; ///< on processors only
  SumOnDevice<AnyDevice> Add;
  DeviceArray<AnyDevice, TermSums> Found;
  DeviceArray<AnyDevice, Seen> FoundByOthers; ///< by all cameras but the first
  Taken Unsummed;
  std::vector<Visible> Base; ///< by camera; empty: not seen yet, or iterations do not tell scores
};
}

#endif
