// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Splits a function of VTK into pieces between neighbouring nodes.

#ifndef limpid_FunctionPieces_h
#define limpid_FunctionPieces_h

#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace limpid
{
/**
 * vtkPiecewiseFunction and vtkColorTransferFunction search their nodes from the first one on for
 * every value, so that a table takes time proportional to entries times nodes. Here each value is
 * computed by a function that has only the two neighbouring nodes. It has the same formulas, hence
 * the same bits.
 */
template <class Function>
class FunctionPieces
{
public:
  /// `newPiece`: creates a function with the settings of the whole one, without nodes. `addNode`:
  /// adds a node in the format of GetNodeValue to such a function.
  template <class NewPiece, class AddNode>
  FunctionPieces(Function* whole, const NewPiece& newPiece, const AddNode& addNode)
    : Whole(whole)
  {
    std::vector<Node> nodes(static_cast<std::size_t>(whole->GetSize()));
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      whole->GetNodeValue(static_cast<int>(i), nodes[i].data());
      this->Positions.push_back(nodes[i][0]);
    }
    for (std::size_t last = 1; last < nodes.size(); ++last)
    {
      vtkSmartPointer<Function> piece = newPiece();
      addNode(piece, nodes[last - 1]);
      addNode(piece, nodes[last]);
      this->Pieces.push_back(piece);
    }
  }

  /// Returns a function, with at most two nodes, that has the value at this position.
  Function* At(double position) const
  {
    if (this->Pieces.empty())
    {
      return this->Whole; // which has at most one node
    }
    const auto behind = std::lower_bound(this->Positions.begin(), this->Positions.end(), position);
    const auto nodesBefore = static_cast<std::size_t>(behind - this->Positions.begin());
    const std::size_t last = std::min(std::max<std::size_t>(nodesBefore, 1), this->Pieces.size());
    return this->Pieces[last - 1];
  }

private:
  using Node = std::array<double, 6>; ///< position, values, midpoint, sharpness

  vtkSmartPointer<Function> Whole;
  std::vector<double> Positions;
  std::vector<vtkSmartPointer<Function>> Pieces; ///< one from every node to the next one
};
}

#endif
