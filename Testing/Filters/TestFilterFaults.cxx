// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Every allocation of a field that the filters' own code makes fails once: no exception leaves the
// filter, there is one error and no output, and the next run is right.

#include "FailingAllocations.h"
#include "OneOf.h"
#include "PhantomFilters.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"

#include <gtest/gtest.h>

#include <functional>

using namespace limpid;

namespace
{
/// VTK's small objects may end up half made where their memory fails.
constexpr FailingAllocations::Scope ownFields{ "vtkLimpidFilters", 1024 };

void Count(vtkObject*, unsigned long, void* count, void*)
{
  ++*static_cast<int*>(count);
}

void ExpectToSurvive(vtkAlgorithm* filter, int every)
{
  int errors = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&errors);
  counter->SetCallback(Count);
  filter->AddObserver(vtkCommand::ErrorEvent, counter);
  vtkNew<vtkCallbackCommand> silence;
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silence);
  filter->Update();
  const std::vector<double> expected = OutcomeOf(filter);
  ASSERT_FALSE(expected.empty());

  bool failed = true;
  for (std::int64_t number = 1; failed; number += every * OneOf())
  {
    errors = 0;
    filter->Modified();
    {
      const FailingAllocations failing(number, FailingAllocations::Which::One, ownFields);
      ASSERT_NO_THROW(filter->Update());
      failed = failing.Failed();
    }
    ASSERT_LE(errors, failed ? 1 : 0) << "allocation " << number;
    // Some can do without what they did not get.
    ASSERT_EQ(OutcomeOf(filter), errors > 0 ? std::vector<double>() : expected)
      << "allocation " << number;
    filter->Modified();
    filter->Update();
    ASSERT_EQ(OutcomeOf(filter), expected) << "after allocation " << number;
  }
}
}

TEST(FilterFaults, OfTheOptimizer)
{
  const auto image = Phantom(8, 0);
  ExpectToSurvive(Optimizer(image), 1);
}

TEST(FilterFaults, OfTheOptimizerOfTheViewpoint)
{
  const auto image = Phantom(8, 0);
  const auto filter = Optimizer(image);
  filter->SetOptimizeViewpoint(1);
  ExpectToSurvive(filter, 401);
}

TEST(FilterFaults, OfTheSearch)
{
  const auto image = Phantom(8, 0);
  for (const int field : { 0, 3 })
  {
    const auto filter = Search(image);
    filter->SetField(field);
    ExpectToSurvive(filter, 401);
  }
}

TEST(FilterFaults, OfThePhantom)
{
  vtkNew<vtkOcclusionPhantom> source;
  source->SetResolution(8);
  ExpectToSurvive(source, 1);
}
