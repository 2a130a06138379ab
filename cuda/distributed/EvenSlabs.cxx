// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed/EvenSlabs.h"

namespace limpid
{
namespace
{
Slab SlabOf(const Communicator& ranks, int rank, const Int3& nodes)
{
  const auto begin = [&](int number)
  { return static_cast<int>(Index(nodes.z) * number / ranks.Size()); };
  return { nodes, { begin(rank), begin(rank + 1) } };
}
}

std::vector<NodeBox> EvenSlabs(const Communicator& ranks, const Int3& nodes)
{
  std::vector<NodeBox> boxes;
  boxes.reserve(std::size_t(ranks.Size()));
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    boxes.push_back(SlabOf(ranks, rank, nodes).Box());
  }
  return boxes;
}

Slab OwnSlab(const Communicator& ranks, const Int3& nodes)
{
  return SlabOf(ranks, ranks.Rank(), nodes);
}
}
