// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/CameraPath.h"

#include "math/Angle.h"
#include "viewpoint/SphereCurve.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace limpid
{
namespace
{
constexpr double infinite = std::numeric_limits<double>::infinity();

/// For each direction, the best score reachable by always going to the best neighbour.
class Hills
{
public:
  Hills(const std::vector<std::vector<int>>& neighbours, const std::vector<double>& scores)
    : Top(scores.size(), -1)
  {
    for (std::size_t start = 0; start < scores.size(); ++start)
    {
      std::vector<int> way{ int(start) };
      while (this->Top[std::size_t(way.back())] < 0)
      {
        const int here = way.back();
        int next = here;
        for (const int other : neighbours[std::size_t(here)])
        {
          next = scores[std::size_t(other)] > scores[std::size_t(next)] ? other : next;
        }
        if (next == here)
        {
          this->Top[std::size_t(here)] = here;
          break;
        }
        way.push_back(next);
      }
      for (const int passed : way)
      {
        this->Top[std::size_t(passed)] = this->Top[std::size_t(way.back())];
      }
    }
  }

  int TopOf(int direction) const { return this->Top[std::size_t(direction)]; }

private:
  std::vector<int> Top;
};

std::vector<int> AllowedOf(const DirectionMesh& mesh, const AllowedViews& allowed)
{
  std::vector<int> numbers;
  for (std::size_t i = 0; i < mesh.directions.size(); ++i)
  {
    if (allowed.Contains(mesh.directions[i]))
    {
      numbers.push_back(int(i));
    }
  }
  return numbers;
}

/// Returns the best allowed directions in descending order, none too close to another. Local
/// maxima with high scores come first, as they differ more from each other than the surroundings
/// of the global maximum.
std::vector<int> KeysOf(const DirectionMesh& mesh, const std::vector<double>& scores,
  const CameraPathSettings& settings, const Hills& hills, std::vector<int> candidates)
{
  constexpr double much = 0.5; // relative to the best score
  const auto scoreOf = [&scores](int direction) { return scores[std::size_t(direction)]; };
  std::stable_sort(
    candidates.begin(), candidates.end(), [&](int a, int b) { return scoreOf(a) > scoreOf(b); });
  if (!candidates.empty())
  {
    const double enough = much * scoreOf(candidates[0]);
    std::stable_partition(candidates.begin(), candidates.end(),
      [&](int direction)
      { return hills.TopOf(direction) == direction && scoreOf(direction) >= enough; });
  }
  std::vector<int> keys;
  for (const int candidate : candidates)
  {
    const Vec3& direction = mesh.directions[std::size_t(candidate)];
    const bool apart = std::all_of(keys.begin(), keys.end(),
      [&](int key) {
        return AngleBetween(mesh.directions[std::size_t(key)], direction) >= settings.separation;
      });
    if (apart && int(keys.size()) < settings.keyViews)
    {
      keys.push_back(candidate);
    }
  }
  return keys;
}

/// Orders keys, keeping the first one, into a short round trip: nearest neighbour first, then
/// reversal of segments as long as that shortens the trip.
void ShortenRoundTrip(const std::vector<Vec3>& directions, std::vector<int>& keys)
{
  const auto between = [&](int a, int b)
  { return AngleBetween(directions[std::size_t(a)], directions[std::size_t(b)]); };
  for (std::size_t i = 1; i < keys.size(); ++i)
  {
    const auto nearest = std::min_element(keys.begin() + std::ptrdiff_t(i), keys.end(),
      [&](int a, int b) { return between(keys[i - 1], a) < between(keys[i - 1], b); });
    std::iter_swap(keys.begin() + std::ptrdiff_t(i), nearest);
  }
  bool shorter = true;
  while (shorter)
  {
    shorter = false;
    for (std::size_t i = 1; i + 1 < keys.size(); ++i)
    {
      for (std::size_t j = i + 1; j < keys.size(); ++j)
      {
        const int after = keys[(j + 1) % keys.size()];
        const double now = between(keys[i - 1], keys[i]) + between(keys[j], after);
        const double then = between(keys[i - 1], keys[j]) + between(keys[i], after);
        if (then < now - 1e-12)
        {
          std::reverse(keys.begin() + std::ptrdiff_t(i), keys.begin() + std::ptrdiff_t(j) + 1);
          shorter = true;
        }
      }
    }
  }
}

/// Returns the cheapest path between two directions over neighbours, without the first direction.
/// The cost of an angle rises as less is seen, and is high for directions that are not allowed.
std::vector<int> WayBetween(const DirectionMesh& mesh,
  const std::vector<std::vector<int>>& neighbours, const std::vector<double>& costs, int from,
  int to)
{
  std::vector<double> reached(costs.size(), infinite);
  std::vector<int> before(costs.size(), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
  reached[std::size_t(from)] = 0;
  open.emplace(0.0, from);
  while (!open.empty())
  {
    const auto [length, here] = open.top();
    open.pop();
    if (here == to)
    {
      break;
    }
    if (length > reached[std::size_t(here)])
    {
      continue;
    }
    for (const int next : neighbours[std::size_t(here)])
    {
      const double angle =
        AngleBetween(mesh.directions[std::size_t(here)], mesh.directions[std::size_t(next)]);
      const double cost = 0.5 * (costs[std::size_t(here)] + costs[std::size_t(next)]);
      if (length + angle * cost < reached[std::size_t(next)])
      {
        reached[std::size_t(next)] = length + angle * cost;
        before[std::size_t(next)] = here;
        open.emplace(reached[std::size_t(next)], next);
      }
    }
  }
  std::vector<int> way;
  for (int here = to; here != from; here = before[std::size_t(here)])
  {
    way.push_back(here);
  }
  std::reverse(way.begin(), way.end());
  return way;
}

/// Returns a round trip over neighbours through all keys.
std::vector<Vec3> WayThrough(const DirectionMesh& mesh,
  const std::vector<std::vector<int>>& neighbours, const std::vector<double>& costs,
  const std::vector<int>& keys)
{
  std::vector<Vec3> way;
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    for (const int passed :
      WayBetween(mesh, neighbours, costs, keys[i], keys[(i + 1) % keys.size()]))
    {
      way.push_back(mesh.directions[std::size_t(passed)]);
    }
  }
  // The last direction is the first key.
  if (way.empty())
  {
    way.push_back(mesh.directions[std::size_t(keys[0])]);
  }
  std::rotate(way.begin(), way.end() - 1, way.end());
  return way;
}

/// Restricts the neighbours of allowed directions to allowed ones.
std::vector<std::vector<int>> Within(
  const std::vector<std::vector<int>>& neighbours, const std::vector<int>& allowed)
{
  std::vector<std::vector<int>> within(neighbours.size());
  for (const int direction : allowed)
  {
    for (const int other : neighbours[std::size_t(direction)])
    {
      if (std::binary_search(allowed.begin(), allowed.end(), other))
      {
        within[std::size_t(direction)].push_back(other);
      }
    }
  }
  return within;
}

std::size_t FrameNext(const std::vector<Vec3>& path, const Vec3& direction)
{
  const auto nearest = std::min_element(path.begin(), path.end(),
    [&](const Vec3& a, const Vec3& b)
    { return AngleBetween(a, direction) < AngleBetween(b, direction); });
  return std::size_t(nearest - path.begin());
}

/// Returns the cost of an angle at each direction, depending on its score.
std::vector<double> CostsOf(
  const DirectionMesh& mesh, const std::vector<double>& scores, const AllowedViews& allowed)
{
  constexpr double ofNothingSeen = 5; // cost where nothing is seen, relative to that at the best
                                      // score
  constexpr double ofNotAllowed = 1000;
  const double best = *std::max_element(scores.begin(), scores.end());
  std::vector<double> costs;
  costs.reserve(scores.size());
  for (std::size_t i = 0; i < scores.size(); ++i)
  {
    const double seen = best > 0 ? scores[i] / best : 1.0;
    costs.push_back(
      allowed.Contains(mesh.directions[i]) ? seen + (1 - seen) * ofNothingSeen : ofNotAllowed);
  }
  return costs;
}

/// Smooths a curve as much as possible while `isGood(point, index)` holds for every point.
template <class IsGood>
std::vector<Vec3> SmoothedWhile(
  const std::vector<Vec3>& wanted, const AllowedViews& allowed, bool closed, const IsGood& isGood)
{
  constexpr double least = 1e-4; // bends extend over about ten points
  constexpr double most = 1e6;   // points hardly move
  std::vector<double> weights(wanted.size(), least);
  std::vector<Vec3> found;
  bool changed = true;
  while (changed)
  {
    changed = false;
    found = Smoothed(wanted, weights, closed);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      found[i] = allowed.WithElevation(found[i]);
      const bool ruled = allowed.Contains(wanted[i]) && !allowed.Contains(found[i]);
      if ((ruled || !isGood(found[i], i)) && weights[i] < most)
      {
        weights[i] *= 8;
        changed = true;
      }
    }
  }
  return found;
}

template <class Scores>
void AddScores(const DirectionMesh& mesh, const Scores& scoresAt, CameraPath& path)
{
  for (std::size_t i = 0; i < path.directions.size(); ++i)
  {
    path.scores.push_back(mesh.At(scoresAt(i), path.directions[i]));
  }
}

/// A possible direction at a time step.
struct Candidate
{
  int direction;
  double loss; ///< fraction of the best score at that time that is lost
};

std::vector<Candidate> CandidatesOf(const std::vector<double>& scores,
  const std::vector<int>& allowed, const Hills& hills, double leastShare)
{
  double best = 0;
  for (const int direction : allowed)
  {
    best = std::max(best, scores[std::size_t(direction)]);
  }
  std::vector<Candidate> candidates;
  for (const int direction : allowed)
  {
    const double score = scores[std::size_t(direction)];
    if (score >= leastShare * scores[std::size_t(hills.TopOf(direction))])
    {
      candidates.push_back({ direction, best > 0 ? 1 - score / best : 0.0 });
    }
  }
  return candidates;
}

/// Selects one candidate per time step that minimises the sum of squared angles [radians^2] and
/// losses, by backward dynamic programming. Losing everything costs as much as turning by one
/// radian at once.
std::vector<int> LeastTurns(
  const DirectionMesh& mesh, const std::vector<std::vector<Candidate>>& candidates)
{
  const auto directionOf = [&mesh](const Candidate& candidate)
  { return mesh.directions[std::size_t(candidate.direction)]; };
  std::vector<std::vector<double>> left(candidates.size());
  std::vector<std::vector<std::size_t>> nexts(candidates.size());
  for (std::size_t step = candidates.size(); step-- > 0;)
  {
    for (const Candidate& here : candidates[step])
    {
      double least = step + 1 < candidates.size() ? infinite : 0.0;
      std::size_t best = 0;
      for (std::size_t i = 0; step + 1 < candidates.size() && i < candidates[step + 1].size(); ++i)
      {
        const double angle = AngleBetween(directionOf(here), directionOf(candidates[step + 1][i]));
        const double all = angle * angle + left[step + 1][i];
        best = all < least ? i : best;
        least = std::min(least, all);
      }
      left[step].push_back(least + here.loss);
      nexts[step].push_back(best);
    }
  }
  std::vector<int> chosen;
  auto at = std::size_t(std::min_element(left[0].begin(), left[0].end()) - left[0].begin());
  for (std::size_t step = 0; step < candidates.size(); ++step)
  {
    chosen.push_back(candidates[step][at].direction);
    at = nexts[step][at];
  }
  return chosen;
}
}

CameraPath RoundTrip(
  const DirectionMesh& mesh, const std::vector<double>& scores, const CameraPathSettings& settings)
{
  CameraPath path;
  path.closed = true;
  const std::vector<std::vector<int>> neighbours = mesh.Neighbours();
  const std::vector<int> allowed = AllowedOf(mesh, settings.allowed);
  const Hills hills(Within(neighbours, allowed), scores);
  std::vector<int> keys = KeysOf(mesh, scores, settings, hills, allowed);
  if (keys.empty())
  {
    return path;
  }
  ShortenRoundTrip(mesh.directions, keys);
  std::vector<Vec3> wanted = SpreadEvenly(
    WayThrough(mesh, neighbours, CostsOf(mesh, scores, settings.allowed), keys), settings.frames);
  std::vector<double> enough;
  enough.reserve(wanted.size());
  for (const Vec3& direction : wanted)
  {
    enough.push_back(settings.leastShare * mesh.At(scores, direction));
  }
  constexpr double anywhere = 4;  // radians
  constexpr double atKey = 0.035; // 2 degrees: with broad maxima, more would shrink the trip
  std::vector<double> farthest(wanted.size(), anywhere);
  for (const int key : keys)
  {
    const std::size_t frame = FrameNext(wanted, mesh.directions[std::size_t(key)]);
    wanted[frame] = mesh.directions[std::size_t(key)];
    enough[frame] = settings.leastShare * scores[std::size_t(hills.TopOf(key))];
    farthest[frame] = atKey;
  }
  const std::vector<Vec3> smooth = SmoothedWhile(wanted, settings.allowed, true,
    [&](const Vec3& point, std::size_t frame)
    {
      return mesh.At(scores, point) >= enough[frame] &&
        AngleBetween(point, wanted[frame]) <= farthest[frame];
    });
  path.directions = SpreadEvenly(smooth, settings.frames);
  for (const int key : keys)
  {
    path.keyViews.push_back(int(FrameNext(path.directions, mesh.directions[std::size_t(key)])));
  }
  AddScores(
    mesh, [&](std::size_t) -> const std::vector<double>& { return scores; }, path);
  return path;
}

CameraPath PathThroughTime(const DirectionMesh& mesh,
  const std::vector<std::vector<double>>& scores, const CameraPathSettings& settings)
{
  CameraPath path;
  const std::vector<int> allowed = AllowedOf(mesh, settings.allowed);
  if (allowed.empty() || scores.empty())
  {
    return path;
  }
  const std::vector<std::vector<int>> neighbours = Within(mesh.Neighbours(), allowed);
  std::vector<std::vector<Candidate>> candidates;
  std::vector<Hills> hills;
  for (const std::vector<double>& atTime : scores)
  {
    hills.emplace_back(neighbours, atTime);
    candidates.push_back(CandidatesOf(atTime, allowed, hills.back(), settings.leastShare));
  }
  const std::vector<int> chosen = LeastTurns(mesh, candidates);
  std::vector<Vec3> wanted;
  std::vector<double> enough;
  for (std::size_t step = 0; step < chosen.size(); ++step)
  {
    wanted.push_back(mesh.directions[std::size_t(chosen[step])]);
    enough.push_back(
      settings.leastShare * scores[step][std::size_t(hills[step].TopOf(chosen[step]))]);
    path.keyViews.push_back(int(step));
  }
  path.directions = SmoothedWhile(wanted, settings.allowed, false,
    [&](const Vec3& point, std::size_t step)
    { return mesh.At(scores[step], point) >= enough[step]; });
  AddScores(
    mesh, [&](std::size_t step) -> const std::vector<double>& { return scores[step]; }, path);
  return path;
}
}
