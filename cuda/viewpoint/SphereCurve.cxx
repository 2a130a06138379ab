// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/SphereCurve.h"

#include "math/Angle.h"

#include <functional>
#include <numeric>

namespace limpid
{
std::vector<Vec3> SpreadEvenly(const std::vector<Vec3>& way, int count)
{
  std::vector<double> along{ 0.0 };
  for (std::size_t i = 0; i < way.size(); ++i)
  {
    along.push_back(along.back() + AngleBetween(way[i], way[(i + 1) % way.size()]));
  }
  std::vector<Vec3> points;
  points.reserve(std::size_t(count));
  std::size_t at = 0;
  for (int i = 0; i < count; ++i)
  {
    const double wanted = along.back() * i / count;
    while (at + 1 < way.size() && along[at + 1] <= wanted)
    {
      ++at;
    }
    const double step = along[at + 1] - along[at];
    const double share = step > 0 ? (wanted - along[at]) / step : 0;
    points.push_back(glm::normalize((1 - share) * way[at] + share * way[(at + 1) % way.size()]));
  }
  return points;
}

std::vector<Vec3> Smoothed(
  const std::vector<Vec3>& wanted, const std::vector<double>& weights, bool closed)
{
  const int count = int(wanted.size());
  if (count < 3)
  {
    return wanted;
  }
  const auto apply = [&](const std::vector<Vec3>& x)
  {
    std::vector<Vec3> result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      result[i] = weights[i] * x[i];
    }
    for (int i = closed ? 0 : 1; i < (closed ? count : count - 1); ++i)
    {
      const auto here = std::size_t(i);
      const auto last = std::size_t((i + count - 1) % count);
      const auto next = std::size_t((i + 1) % count);
      const Vec3 bend = x[last] - 2.0 * x[here] + x[next];
      result[last] += bend;
      result[here] -= 2.0 * bend;
      result[next] += bend;
    }
    return result;
  };
  const auto dot = [](const std::vector<Vec3>& a, const std::vector<Vec3>& b)
  {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
      [](const Vec3& x, const Vec3& y) { return glm::dot(x, y); });
  };
  std::vector<Vec3> x = wanted;
  std::vector<Vec3> residual = apply(x);
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    residual[i] = weights[i] * wanted[i] - residual[i];
  }
  std::vector<Vec3> way = residual;
  double square = dot(residual, residual);
  const double enough = 1e-20 * count;
  for (int step = 0; step < 20 * count && square > enough; ++step)
  {
    const std::vector<Vec3> image = apply(way);
    const double length = square / dot(way, image);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      x[i] += length * way[i];
      residual[i] -= length * image[i];
    }
    const double next = dot(residual, residual);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      way[i] = residual[i] + next / square * way[i];
    }
    square = next;
  }
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    x[i] = glm::length(x[i]) > 1e-6 ? glm::normalize(x[i]) : wanted[i];
  }
  return x;
}
}
