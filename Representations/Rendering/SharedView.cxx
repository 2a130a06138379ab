// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SharedView.h"

#include <type_traits>
#include <vector>

namespace limpid
{
namespace
{
// Broadcasts all numbers that are passed to visit(number) from the first rank.
template <class VisitAll>
void TakeFirstNumbers(const Communicator& ranks, const VisitAll& visitAll)
{
  std::vector<double> numbers;
  visitAll([&numbers](const auto& number) { numbers.push_back(static_cast<double>(number)); });
  ranks.TakeFirst(numbers.data(), numbers.size());
  auto next = numbers.begin();
  visitAll(
    [&next](auto& number) { number = static_cast<std::decay_t<decltype(number)>>(*next++); });
}

template <class Visit>
void VisitVector(Vec3& vector, const Visit& visit)
{
  visit(vector.x);
  visit(vector.y);
  visit(vector.z);
}
}

void TakeFirstOf(const Communicator& ranks, ViewGeometry& geometry)
{
  auto corners = static_cast<double>(geometry.camera.corners.size());
  ranks.TakeFirst(&corners, 1);
  geometry.camera.corners.resize(static_cast<std::size_t>(corners));
  TakeFirstNumbers(ranks,
    [&geometry](const auto& visit)
    {
      for (int& end : geometry.covered)
      {
        visit(end);
      }
      visit(geometry.nearest);
      visit(geometry.farthest);
      for (int column = 0; column < 4; ++column)
      {
        for (int row = 0; row < 4; ++row)
        {
          visit(geometry.clipToData[column][row]);
        }
      }
      Camera& camera = geometry.camera;
      for (Vec3* vector : { &camera.position, &camera.focalPoint, &camera.viewUp })
      {
        VisitVector(*vector, visit);
      }
      visit(camera.viewAngle);
      visit(camera.parallel);
      visit(camera.parallelScale);
      visit(camera.aspect);
      for (Vec3& corner : camera.corners)
      {
        VisitVector(corner, visit);
      }
    });
}

void TakeFirstOf(const Communicator& ranks, ChosenLight& light)
{
  TakeFirstNumbers(ranks,
    [&light](const auto& visit)
    {
      visit(light.found);
      VisitVector(light.light.position, visit);
      VisitVector(light.light.focalPoint, visit);
      visit(light.movesWithCamera);
    });
}
}
