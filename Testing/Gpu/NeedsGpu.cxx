// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Every test of this program needs a GPU; without one all are skipped.

#include "backend/Choice.h"

#include <gtest/gtest.h>

#include <iostream>

namespace
{
class Gpu : public ::testing::Environment
{
public:
  void SetUp() override
  {
    if (!limpid::FindCuda().usable)
    {
      std::cout << "[  SKIPPED ] all tests\n"; // ctest looks for it
      GTEST_SKIP() << limpid::FindCuda().reason;
    }
  }
};

[[maybe_unused]] const auto* const needed = ::testing::AddGlobalTestEnvironment(new Gpu);
}
