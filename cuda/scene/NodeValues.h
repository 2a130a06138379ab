// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_NodeValues_h
#define limpid_scene_NodeValues_h

#include "math/Vec.h"

#include <memory>

namespace limpid
{
/// A value per node of a grid, 0 at first. What stays 0 need not be written, and where it is not,
/// a large field takes no memory.
class NodeValues
{
public:
  NodeValues() = default;
  explicit NodeValues(Index count);

  bool Empty() const { return !this->Memory; }
  float* Data() { return this->Memory.get(); }
  const float* Data() const { return this->Memory.get(); }

private:
  struct Free
  {
    void operator()(float* memory) const noexcept;
  };

  std::unique_ptr<float[], Free> Memory;
};
}

#endif
