// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A function of VTK in pieces between neighbouring nodes.

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
 * vtkPiecewiseFunction and vtkColorTransferFunction visit their nodes from the first one on for
 * every value that they are asked for, so a table takes the product of its entries and of the
 * nodes. Here each value is asked of a function with its two neighbouring nodes alone, which has
 * the same formulas and so the same bits.
 */
template <class Function>
class FunctionPieces
{
public:
  /// `newPiece`: makes a function with the settings of the whole one, and without nodes.
  /// `addNode`: adds a node, as GetNodeValue has it, to such a function.
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

  /// The function that has the value at a position: with at most two nodes.
  Function* At(double position) const
  {
    if (this->Pieces.empty())
    {
      return this->Whole; // with one node or none
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
  std::vector<vtkSmartPointer<Function>> Pieces; ///< from every node to the next one
};
}

#endif
