// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Functions in pieces: the values of VTK, at a cost that does not grow with the number of nodes.

#include "FunctionPieces.h"
#include "ScalarMapping.h"

#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{
/// Any x: the positions of the nodes, values between them, and beyond both ends.
std::vector<double> Positions(vtkPiecewiseFunction* function)
{
  std::vector<double> positions{ -1e300, -1, 0, 1e300 };
  for (int i = 0; i < function->GetSize(); ++i)
  {
    double node[4];
    function->GetNodeValue(i, node);
    for (const double share : { 0.7, 0.999999, 1.0, 1.000001, 1.3 })
    {
      positions.push_back(share * node[0]);
    }
  }
  return positions;
}

void ExpectTheValuesOf(vtkPiecewiseFunction* function)
{
  const limpid::ScalarMapping mapping = limpid::Evaluate(function);
  for (const double position : Positions(function))
  {
    const double expected = function->GetValue(position);
    const double found = mapping(position);
    EXPECT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected)))
      << position << ": " << found << " for " << expected;
  }
}

void AddNodes(vtkPiecewiseFunction* function, int count)
{
  for (int i = 0; i < count; ++i)
  {
    const double height = 0.5 + 0.4 * std::sin(i);
    function->AddPoint(
      std::pow(10.0, -6 + 12.0 * i / count), height, 0.3 + 0.1 * (i % 5), 0.2 * (i % 6));
  }
}

/// A function that counts how often its nodes are read, with as much of one as pieces need.
class CountedFunction : public vtkObject
{
public:
  static CountedFunction* New();

  int GetSize() const { return static_cast<int>(this->Nodes.size()); }

  void GetNodeValue(int i, double* node)
  {
    ++this->Reads;
    node[0] = this->Nodes[static_cast<std::size_t>(i)];
  }

  std::vector<double> Nodes;
  int Reads = 0;
};

vtkStandardNewMacro(CountedFunction);
}

TEST(FunctionPieces, HaveTheBitsOfTheWholeFunction)
{
  for (const int count : { 0, 1, 2, 3, 40 })
  {
    for (const bool log : { false, true })
    {
      for (const bool clamps : { false, true })
      {
        vtkNew<vtkPiecewiseFunction> function;
        AddNodes(function, count);
        function->SetUseLogScale(log);
        function->SetClamping(clamps);
        SCOPED_TRACE(testing::Message() << count << " nodes, log " << log << ", clamps " << clamps);
        ExpectTheValuesOf(function);
      }
    }
  }
}

TEST(FunctionPieces, HaveStepsWhereTwoNodesAreAtOnePosition)
{
  vtkNew<vtkPiecewiseFunction> function;
  function->AllowDuplicateScalarsOn();
  for (const double position : { 1, 2, 3 })
  {
    function->AddPoint(position, 0.1 * position);
    function->AddPoint(position, 0.2 * position);
  }
  ExpectTheValuesOf(function);
}

TEST(FunctionPieces, ReadEveryNodeOnceAndThenTwoForAValue)
{
  for (const int count : { 2, 256, 4096 })
  {
    vtkNew<CountedFunction> whole;
    for (int i = 0; i < count; ++i)
    {
      whole->Nodes.push_back(i);
    }
    const limpid::FunctionPieces<CountedFunction> pieces(
      whole, [] { return vtkSmartPointer<CountedFunction>::New(); },
      [](CountedFunction* piece, const auto& node) { piece->Nodes.push_back(node[0]); });

    for (double position = -1; position < count + 1; position += 0.25)
    {
      ASSERT_EQ(pieces.At(position)->GetSize(), 2);
    }
    EXPECT_EQ(whole->Reads, count);
  }
}
