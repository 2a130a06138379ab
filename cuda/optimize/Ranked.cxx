// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Ranked.h"

#include "backend/LargePages.h"
#include "math/Require.h"
#include "optimize/Permuted.h"

#include <utility>

namespace limpid
{
namespace
{
NodeBox InOrder(const NodeBox& box, const AxisPermutation& order)
{
  NodeBox permuted;
  for (int axis = 0; axis < 3; ++axis)
  {
    permuted.along[std::size_t(axis)] = box.along[std::size_t(order.axes[axis])];
  }
  return permuted;
}

FieldView InOrder(const FieldView& view, const AxisPermutation& order)
{
  FieldView permuted{ view.values, {} };
  for (int axis = 0; axis < 3; ++axis)
  {
    permuted.stride[std::size_t(axis)] = view.stride[std::size_t(order.axes[axis])];
  }
  return permuted;
}

class RankedMinimizer : public Minimizer
{
public:
  RankedMinimizer(const Problem& problem, const AxisPermutation& order)
    : Given(&problem)
    , Order(order)
    , Inside(problem)
  {
    this->Inside.grid = order.Of(problem.grid);
    this->Inside.camera = order.Of(problem.camera);
    for (RaySource& other : this->Inside.otherCameras)
    {
      other = order.Of(other);
    }
    this->Inside.light = order.Of(problem.light);
    this->Inside.resident = nullptr;
    this->Inside.shared = this->MakeFields();
    this->Inside.piece = nullptr;
  }

  const Problem& ProblemInside() const { return this->Inside; }

  void Use(std::unique_ptr<Minimizer> minimizer) { this->Inner = std::move(minimizer); }

  IterationRecord Start() override
  {
    const SmallPages small;
    return this->Inner->Start();
  }

  IterationRecord Iterate() override
  {
    const SmallPages small;
    this->IsRestored = false;
    return this->Inner->Iterate();
  }

  IterationRecord Smooth() override
  {
    const SmallPages small;
    this->IsRestored = false;
    return this->Inner->Smooth();
  }

  Score BaseScore() const override { return this->Inner->BaseScore(); }
  bool Converged() const override { return this->Inner->Converged(); }
  bool IsNear() const override { return this->Inner->IsNear(); }
  int IterationLimit() const override { return this->Inner->IterationLimit(); }

  const std::vector<float>& Best() const override
  {
    if (!this->IsRestored)
    {
      // What no sweep comes to stays as it is.
      const float* base = this->Given->baseExtinction;
      this->Restored.assign(base, base + this->Given->piece->nodes.Count());
      this->Inner->BestToPiece(this->PieceOf(this->Restored.data()));
      this->IsRestored = true;
    }
    return this->Restored;
  }

  std::vector<float> TakeBest() override
  {
    this->Best();
    return std::move(this->Restored);
  }

private:
  /// A field of this rank's piece, in the order inside.
  FieldView PieceOf(const float* field) const
  {
    return InOrder(
      FieldView::Part(const_cast<float*>(field), this->Given->piece->nodes), this->Order);
  }

  std::shared_ptr<FieldsOfRanks> MakeFields()
  {
    const SmallPages small;
    const ScenePiece& piece = *this->Given->piece;
    auto fields = std::make_shared<FieldsOfRanks>();
    fields->ranks = piece.ranks;
    for (const NodeBox& box : piece.ofRanks)
    {
      fields->pieces.push_back({ InOrder(box, this->Order) });
    }
    const auto make = [this](FieldsOfRanks::Field& field, const float* values)
    {
      field.piece = this->PieceOf(values);
      field.values = NodeValues(this->Given->grid.NodeCount());
    };
    make(fields->base, this->Given->baseExtinction);
    make(fields->importance, this->Given->importance);
    make(fields->nodeImportance, this->Given->nodeImportance);
    this->Inside.baseExtinction = fields->base.values.Data();
    this->Inside.importance = fields->importance.values.Data();
    this->Inside.nodeImportance = fields->nodeImportance.values.Data();
    this->Inside.occupancy = this->FindOccupancy(*fields);
    return fields;
  }

  std::shared_ptr<const Occupancy> FindOccupancy(const FieldsOfRanks& fields) const
  {
    const ScenePiece& piece = *this->Given->piece;
    const NodeBox box = InOrder(piece.nodes, this->Order);
    const auto inOrder = [&box](const FieldView& view)
    {
      std::vector<float> values(std::size_t(box.Count()));
      CopyNodes(box, view, FieldView::Part(values.data(), box));
      return values;
    };
    const std::vector<float> base = inOrder(fields.base.piece);
    const std::vector<float> importance = inOrder(fields.nodeImportance.piece);
    return std::make_shared<const Occupancy>(*piece.ranks, this->Inside.grid, box, base.data(),
      importance.data(), this->Given->settings.skipUnneeded);
  }

  const Problem* Given;
  AxisPermutation Order;
  Problem Inside; ///< the problem in that order
  std::unique_ptr<Minimizer> Inner;
  mutable std::vector<float> Restored; ///< the best iterate of the piece, if asked
  mutable bool IsRestored = false;
};
}

std::unique_ptr<Minimizer> MakeRanked(const Problem& problem,
  const std::function<std::unique_ptr<Minimizer>(const Problem&)>& make)
{
  auto minimizer = std::make_unique<RankedMinimizer>(problem, OrderFor(problem));
  const SmallPages small;
  minimizer->Use(make(minimizer->ProblemInside()));
  return minimizer;
}
}
