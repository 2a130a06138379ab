// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_NodeValues_h
#define limpid_scene_NodeValues_h

#include "math/Vec.h"

#include <memory>

namespace limpid
{
/// One value per node of a grid, initially 0. Zeros need not be written, and parts of a large field
/// that are never written take no memory.
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
