// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed/ExchangePlan.h"

#include <gtest/gtest.h>

#include <vector>

using namespace limpid;

/// Views of parts may have the same origin by chance, once in thousands of runs.
TEST(ExchangePlan, CopiesBetweenFieldsWhoseOriginsCoincide)
{
  const NodeBox box{ { { { 1, 3 }, { 1, 3 }, { 1, 3 } } } };
  std::vector<float> memory(128, 0.0f);
  const FieldView from{ memory.data(), { { 1, 4, 16 } } };
  const FieldView to{ memory.data(), { { 1, 10, 50 } } };
  FillNodes(box, 0.5f, from);

  ExchangePlan(*ThisProcess(), { { box } }, { { box } }).Bring({ { from, to } });

  for (int k = 1; k < 3; ++k)
  {
    for (int j = 1; j < 3; ++j)
    {
      for (int i = 1; i < 3; ++i)
      {
        EXPECT_EQ(0.5f, to.values[to.At(i, j, k)]) << i << ' ' << j << ' ' << k;
      }
    }
  }
}
